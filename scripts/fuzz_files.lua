-- SPDX-License-Identifier: GPL-3.0-or-later
local usage = [[
usage: build/softworld scripts/fuzz_files.lua [options]
Damages files of meshes, tables, trajectories and saved scenes, and reads them: each must give what
it is for or an error that names it, within seconds, without a leak and without a crash.
  --bytes N      of damaged files in all (default 1e7)
  --seed N       which damage (default 1)
  --kind KIND    only mesh, csv, trajectory or save
  --case N       only this one, and keep its file as fuzz_case.*
  --quiet        no progress
Each case is made from the seed and its number alone. The exit status is 1 when something was
found; the last line is "N cases, N bytes, N refused, N found".]]

local sw = require "softworld"
local core = sw.core
local csv = require "softworld.csv"
local sink = require "softworld.output.sink"

local o = { bytes = 1e7, seed = 1, first = 1 }
do
  local numbers = { bytes = true, seed = true, case = true, first = true }
  local i = 1
  while arg[i] do
    local name = arg[i]:match "^%-%-(%a+)$"
    if numbers[name] then
      o[name], i = tonumber(arg[i + 1]), i + 1
      if not o[name] then name = nil end
    elseif name == "kind" then
      o.kind, i = arg[i + 1], i + 1
    elseif name == "quiet" or name == "worker" then
      o[name] = true
    else
      name = nil
    end
    if not name then
      io.stderr:write(usage, "\n")
      os.exit(2)
    end
    i = i + 1
  end
end
local seed = math.tointeger(o.seed) or math.floor(o.seed)

-- --- what is damaged --------------------------------------------------------------------

-- A tetrahedron and a ball of n rings as points and triangles.
local function solids()
  local ball, faces = { 0, 0, 1 }, {}
  for i = 1, 5 do
    for k = 0, 7 do
      local a, b = math.pi * i / 6, math.pi * k / 4
      local p = { math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a) }
      table.move(p, 1, 3, #ball + 1, ball)
    end
  end
  table.move({ 0, 0, -1 }, 1, 3, #ball + 1, ball)
  for k = 0, 7 do
    local n = (k + 1) % 8
    faces[#faces + 1] = { 1, 2 + k, 2 + n }
    for i = 0, 3 do
      faces[#faces + 1] = { 2 + 8 * i + k, 10 + 8 * i + k, 10 + 8 * i + n }
      faces[#faces + 1] = { 2 + 8 * i + k, 10 + 8 * i + n, 2 + 8 * i + n }
    end
    faces[#faces + 1] = { 42, 34 + n, 34 + k }
  end
  return { { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, { { 1, 3, 2 }, { 1, 2, 4 }, { 1, 4, 3 }, { 2, 3, 4 } } },
    { ball, faces } }
end

local function rows(points, format)
  local list = {}
  for i = 1, #points, 3 do list[#list + 1] = format:format(points[i], points[i + 1], points[i + 2]) end
  return table.concat(list)
end

local function each_face(faces, f)
  local list = {}
  for i, t in ipairs(faces) do list[i] = f(t[1], t[2], t[3]) end
  return table.concat(list)
end

local function ply(points, faces, format, body)
  return ("ply\nformat %s 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
    .. "element face %d\nproperty list uchar int vertex_indices\nend_header\n"):format(format, #points // 3,
    #faces) .. body
end

local function floats(points, mark) return (mark .. ("f"):rep(#points)):pack(table.unpack(points)) end

local function gltf(points, faces, binary)
  local index = each_face(faces, function(a, b, c) return ("<I2I2I2"):pack(a - 1, b - 1, c - 1) end)
  local data = floats(points, "<") .. index .. ("\0"):rep(-#index % 4)
  local code = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
  local base64 = data:gsub("..?.?", function(three)
    local a, b, c = three:byte(1, 3)
    local n = a << 16 | (b or 0) << 8 | (c or 0)
    local text = ""
    for k = 3, 0, -1 do
      local digit = (n >> 6 * k & 63) + 1
      text = text .. code:sub(digit, digit)
    end
    return text:sub(1, #three + 1) .. ("="):rep(3 - #three)
  end)
  local json = ('{"asset":{"version":"2.0"},"buffers":[{%s"byteLength":%d}],"bufferViews":[{"buffer":0,'
    .. '"byteLength":%d},{"buffer":0,"byteOffset":%d,"byteLength":%d}],"accessors":[{"bufferView":0,'
    .. '"componentType":5126,"count":%d,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":%d,'
    .. '"type":"SCALAR"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"nodes":'
    .. '[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}'):format(binary and ""
      or '"uri":"data:application/octet-stream;base64,' .. base64 .. '",', #data, 4 * #points, 4 * #points,
    #index, #points // 3, 3 * #faces)
  if not binary then return json end
  json = json .. (" "):rep(-#json % 4)
  return ("<c4I4I4I4c4"):pack("glTF", 2, 28 + #json + #data, #json, "JSON") .. json
    .. ("<I4c4"):pack(#data, "BIN\0") .. data
end

local function mesh_files()
  local list = {}
  for _, solid in ipairs(solids()) do
    local p, f = solid[1], solid[2]
    local function add(extension, text) list[#list + 1] = { text, extension } end
    local index = function(a, b, c) return ("3 %d %d %d\n"):format(a - 1, b - 1, c - 1) end
    add("obj", "# by hand\no it\n" .. rows(p, "v %.6g %.6g %.6g\n")
      .. each_face(f, function(a, b, c) return ("f %d %d/1 %d//1\n"):format(a, b, c) end))
    add("off", ("OFF\n%d %d 0\n"):format(#p // 3, #f) .. rows(p, "%.6g %.6g %.6g\n") .. each_face(f, index))
    add("ply", ply(p, f, "ascii", rows(p, "%.6g %.6g %.6g\n") .. each_face(f, index)))
    for word, mark in pairs { little = "<", big = ">" } do
      add("ply", ply(p, f, "binary_" .. word .. "_endian", floats(p, mark)
        .. each_face(f, function(a, b, c) return (mark .. "Bi4i4i4"):pack(3, a - 1, b - 1, c - 1) end)))
    end
    local function corner(k) return p[3 * k - 2], p[3 * k - 1], p[3 * k] end
    add("stl", (" "):rep(80) .. ("<I4"):pack(#f) .. each_face(f, function(a, b, c)
      local x, y, z = corner(a)
      local u, v, w = corner(b)
      local i, j, k = corner(c)
      return ("<ffffffffffffI2"):pack(0, 0, 0, x, y, z, u, v, w, i, j, k, 0)
    end))
    add("stl", "solid it\n" .. each_face(f, function(a, b, c)
      local text = "facet normal 0 0 1\nouter loop\n"
      for _, k in ipairs { a, b, c } do text = text .. ("vertex %.6g %.6g %.6g\n"):format(corner(k)) end
      return text .. "endloop\nendfacet\n"
    end) .. "endsolid it\n")
    add("gltf", gltf(p, f, false))
    add("glb", gltf(p, f, true))
  end
  return list
end

local function csv_files()
  local numbers = { "a,b_mm,c\n" }
  for i = 1, 60 do numbers[#numbers + 1] = ("%d,%.17g,%.3e\n"):format(i, math.sin(i), math.exp(-i)) end
  return { { table.concat(numbers), "csv" },
    { '"first ""name""";second\n# a comment\n"1.5";2e-3\n\n3;4\n', "csv" },
    { "x\ty\r\n1\t2\r\n3\t4\r\n", "csv" }, { "\239\187\191t,v\n0,1\n1,2\n", "csv" } }
end

local function trajectory_files()
  local path, plain = { "t,x_mm,y [mm],z,qw,qx,qy,qz,_note\n" }, {}
  for i = 0, 40 do
    path[#path + 1] = ("%.6g,%.6g,%.6g,%.6g,%.17g,0,0,%.17g,w%d\n"):format(0.1 * i, 10 * i, 5 * math.sin(i),
      0.01 * i, math.cos(0.1 * i), math.sin(0.1 * i), 7)
    plain[#plain + 1] = ("%.6g %.6g %.6g\n"):format(0.01 * i, 0.02 * math.sin(i), 0.1):gsub(" ", ";")
  end
  return { { (table.concat(path):gsub(",_note", ""):gsub(",w7", "")), "csv" }, { table.concat(plain), "csv" },
    { "x,y,z,rx_deg,ry_deg,rz_deg\n0,0,0,0,0,0\n0.1,0,0.2,10,0,45\n0.3,0,0,0,90,0\n", "csv" } }
end

-- The scene that is saved, loaded and resumed.
local function scene_of()
  local scene = sw.scene { name = "fuzzed" }
  scene:obstacle { shape = "plane", friction = 0.3 }
  scene:obstacle { shape = "mesh", data = mesh_files()[1][1], format = "obj", scale = 0.1,
    at = { 0.3, 0.2, 0 } }
  local wire = scene:wire { cable = "GXL 1.5", from = { 0, 0, 0.0015 }, to = { 0.2, 0, 0.0015 },
    segments = 12 }
  local other = scene:wire { E = 1e7, density = 1e3, radius = 1e-3, from = { 0, 0.1, 0.1 },
    to = { 0.1, 0.1, 0.1 }, segments = 4 }
  scene:clamp(other, { s = 0 })
  scene:tie(wire, { s = 0.2, to = { 0.2, 0, 0.05 }, slack = 0.01 })
  local hand = scene:gripper { name = "hand" }
  scene:process(function(p)
    p:step("grasp", function() hand:grasp(wire, { s = 0.03 }) end)
    p:step("lift", function() hand:move { by = { 0, 0, 0.01 }, speed = 0.5 } end)
  end)
  return scene
end

local RUN = { dt = 0.005, frame = 0.01 }

-- The checksum of a saved scene made right again, so that what is behind it is looked at too.
local function sealed(text)
  if #text < 48 then return text end
  local sum = -3750763034362895579
  for i = 41, #text do sum = (sum ~ text:byte(i)) * 1099511628211 end
  return text:sub(1, 24) .. ("<I8i8"):pack(#text, sum) .. text:sub(41)
end

-- The same bytes whenever it is made: a run's computing times set to 1.
local function timeless(text)
  for _, key in ipairs { "cpu", "wall" } do
    local mark = ("<s4"):pack(key) .. "d"
    local from, to = text:find(mark, 1, true)
    if from then text = text:sub(1, to) .. ("<d"):pack(1) .. text:sub(to + 9) end
  end
  return sealed(text)
end

local function save_files()
  local list = {}
  local path = sink.scratch()
  local scene <close> = scene_of()
  local function add() list[#list + 1] = { timeless(sink.read_file(path)), "sws" } end
  local write = sink.write_file
  sink.write_file = function(...) -- every step's file
    local written = write(...)
    add()
    return written
  end
  local ok, why = pcall(scene.run, scene, { dt = RUN.dt, frame = RUN.frame, save = path })
  sink.write_file = write
  assert(ok, why)
  scene:save(path)
  add()
  sink.discard(path)
  return list
end

-- --- damage ----------------------------------------------------------------------------

local random = math.random
local NUMBERS = { "-1", "0", "1e308", "nan", "inf", "-0", "99999999999999999999", "2147483648", "4294967295",
  "1,5", "0x10", "", "1e-320", "-2147483649", "100000000" }
local WORDS = { "\0\0\0\0", "\255\255\255\255", "\255\255\255\127", "\0\0\0\128", "\0\0\128\127",
  "\0\0\192\127", "\1\0\0\0", ("<d"):pack(0 / 0), ("<d"):pack(1 / 0), ("<d"):pack(-1e300),
  ("<I8"):pack(1 << 40) }

local function pieces(text)
  local a, b = random(1, #text), random(1, #text)
  if a > b then a, b = b, a end
  if random() < 0.7 then b = math.min(b, a + random(1, 40)) end
  return a, b
end

local function replaced(text, a, b, by) return text:sub(1, a - 1) .. by .. text:sub(b + 1) end

local function bytes(n)
  local list = {}
  for i = 1, n do list[i] = string.char(random(0, 255)) end
  return table.concat(list)
end

local damages = {
  function(text) return text:sub(1, random(0, #text)) end,
  function(text)
    local at = random(1, #text)
    return replaced(text, at, at, string.char(text:byte(at) ~ 1 << random(0, 7)))
  end,
  function(text)
    local at = random(1, #text)
    return replaced(text, at, at, string.char(random(0, 255)))
  end,
  false, -- below
  function(text)
    local a, b = pieces(text)
    return replaced(text, a, b, "")
  end,
  function(text)
    local a, b = pieces(text)
    return replaced(text, a, a - 1, text:sub(a, b):rep(random(1, 3)))
  end,
  function(text)
    local at = random(1, #text)
    return replaced(text, at, at - 1, bytes(random(1, 20)))
  end,
  function(text)
    local word, at = WORDS[random(#WORDS)], random(1, #text)
    return replaced(text, at, at + #word - 1, word)
  end,
  function(text) -- one of its numbers
    local count = select(2, text:gsub("%d+", ""))
    local which, k = random(1, math.max(1, count)), 0
    return (text:gsub("%d+", function(digits)
      k = k + 1
      return k == which and NUMBERS[random(#NUMBERS)] or digits
    end))
  end,
}
damages[4] = function(text, other)
  local a, b = pieces(text)
  local c, d = pieces(other)
  return replaced(text, a, b, other:sub(c, d))
end

local in_place = { 2, 3, 8 } -- what follows stays where it was

local function damage(text, other, kept_in_place)
  for _ = 1, random(1, 4) do
    if #text == 0 then break end
    local which = kept_in_place and in_place[random(#in_place)] or random(#damages)
    text = damages[which](text, other)
  end
  return text
end

-- --- reading ----------------------------------------------------------------------------

local function use(scene)
  scene:names()
  for _, name in ipairs(scene:names()) do tostring(scene:find(name)) end
  pcall(scene.energy, scene)
  pcall(scene.run, scene, { duration = 2 * RUN.dt, dt = RUN.dt })
end

local kinds = {
  mesh = { mesh_files, function(path)
    local scene <close> = sw.scene {}
    scene:obstacle { shape = "mesh", file = path, scale = 0.1 }
  end },
  csv = { csv_files, function(path) csv.read(path) end },
  trajectory = { trajectory_files, function(path)
    local t = sw.trajectory { path = path, speed = 0.2 }
    t:sample(5)
  end },
  save = { save_files, function(path, number)
    if number % 2 == 0 then
      local scene <close> = sw.load(path)
      use(scene)
    else
      local scene <close> = scene_of()
      local before = table.concat(scene:find("wire1"):positions(), " ")
      local ok, why = pcall(scene.resume, scene, path)
      if ok then return use(scene) end
      if before ~= table.concat(scene:find("wire1"):positions(), " ") then
        error("HALF DONE: " .. tostring(why), 0)
      end
      error(why, 0)
    end
  end },
}
-- In turn: files of scenes are twenty times as large as the others.
local names = { "mesh", "csv", "mesh", "trajectory", "mesh", "csv", "mesh", "save", "mesh",
  "trajectory", "mesh" }
if o.kind and not kinds[o.kind] then
  io.stderr:write(usage, "\n")
  os.exit(2)
end

local function kind_of(number)
  if o.kind then return o.kind end
  return names[number % #names + 1]
end

local corpora = {}
local function file_of(number)
  local kind = kind_of(number)
  corpora[kind] = corpora[kind] or kinds[kind][1]()
  math.randomseed(seed, number)
  local from, other = corpora[kind][random(#corpora[kind])], corpora[kind][random(#corpora[kind])]
  local text = damage(from[1], other[1], kind == "save" and random() < 0.6)
  if kind == "save" and random() < 0.7 then text = sealed(text) end
  return kind, text, from[2]
end

local RAW = { "attempt to ", "bad argument", "stack overflow", "no integer representation", "HALF DONE" }

-- Why an error will not do, or nil.
local function complaint(message, path)
  if type(message) ~= "string" then return "an error that is a " .. type(message) end
  if not message:find(sink.base(path), 1, true) then return "does not name the file: " .. message end
  for _, raw in ipairs(RAW) do
    if message:find(raw, 1, true) then return "an error of Lua's own: " .. message end
  end
end

local function run_case(number, path)
  local kind, text, extension = file_of(number)
  path = path .. "." .. extension
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
  local start = os.clock()
  local ok, message = pcall(kinds[kind][2], path, number)
  local took = os.clock() - start
  local found = not ok and complaint(message, path)
  if took > 10 then found = ("took %.1f s"):format(took) end
  if o.case then print(ok and "read" or message) else os.remove(path) end
  return #text, ok, found or nil
end

-- --- worker: cases one after the other, told before they begin -----------------------------

local CHUNK = 400

local function leaks(before)
  for _ = 1, 3 do collectgarbage() end
  return core.allocated() > before and ("%d bytes are not given back"):format(core.allocated() - before)
end

local function work()
  local folder = sink.temporary((os.getenv "TMPDIR" or "/tmp") .. "/softworld_fuzz", true)
  local path = folder .. "/case"
  for number = o.first, o.first + CHUNK - 1 do
    io.stdout:write("case ", number, "\n")
    io.stdout:flush()
    for _ = 1, number % 20 == 0 and 2 or 0 do collectgarbage() end
    file_of(number)
    collectgarbage()
    local before = core.allocated()
    local size, ok, found = run_case(number, path)
    if not found and (number % 20 == 0 or core.allocated() > before) then found = leaks(before) end
    io.stdout:write(("done %d %s %s\n"):format(size, ok, (found or ""):gsub("\n", "\\n")))
    io.stdout:flush()
  end
  sink.remove_folder(folder, {})
end

-- --- supervisor -------------------------------------------------------------------------

local function report(number, what)
  print(("FOUND --seed %d --case %d%s (%s): %s"):format(seed, number, o.kind and " --kind " .. o.kind or "",
    kind_of(number), what))
  io.stdout:flush()
end

-- One worker's cases from the first: bytes, cases, refused, found; the next case.
local function chunk(first, most)
  local words = { "ulimit -S -c 0; exec", sink.quote(arg[-1]), sink.quote(arg[0]), "--worker --seed", seed,
    "--first", first, o.kind and "--kind " .. o.kind or "" }
  local pipe = assert(io.popen(table.concat(words, " "), "r"))
  local t = { bytes = 0, cases = 0, refused = 0, found = 0, next = first }
  local running
  for line in pipe:lines() do
    local size, ok, found = line:match "^done (%d+) (%a+) ?(.*)$"
    if size and running then
      t.bytes, t.cases, t.next, running = t.bytes + tonumber(size), t.cases + 1, running + 1, nil
      if ok == "false" then t.refused = t.refused + 1 end
      if found ~= "" then
        t.found = t.found + 1
        report(t.next - 1, found)
      end
      if t.bytes >= most then break end
    elseif line:match "^case %d+$" then
      running = math.tointeger(line:match "%d+")
    end
  end
  local enough = t.bytes >= most
  local _, how, code = pipe:close()
  if not enough and (running or t.next < first + CHUNK) then
    report(running or t.next, ("the program ended with %s %s"):format(how, code))
    t.found, t.next = t.found + 1, (running or t.next) + 1
  end
  return t
end

local function supervise()
  local sum, first = { bytes = 0, cases = 0, refused = 0, found = 0 }, 1
  while sum.bytes < o.bytes do
    local t = chunk(first, o.bytes - sum.bytes)
    for key in pairs(sum) do sum[key] = sum[key] + t[key] end
    first = t.next
    if not o.quiet then
      io.stderr:write(("seed %d: %d cases, %.3g of %.3g bytes, %d refused, %d found\n"):format(seed,
        sum.cases, sum.bytes, o.bytes, sum.refused, sum.found))
    end
  end
  print(("%d cases, %d bytes, %d refused, %d found"):format(sum.cases, sum.bytes, sum.refused, sum.found))
  return sum.found == 0
end

if o.worker then
  work()
elseif o.case then
  local size, ok, found = run_case(math.tointeger(o.case), "fuzz_case")
  print(("%d bytes, %s%s"):format(size, ok and "read" or "refused", found and ", FOUND: " .. found or ""))
  os.exit(not found)
else
  os.exit(supervise())
end
