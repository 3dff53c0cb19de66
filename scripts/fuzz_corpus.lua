-- SPDX-License-Identifier: GPL-3.0-or-later
-- Makes the files that scripts/fuzz_files.lua damages: lists of { text, file extension }.
local sw = require "softworld"
local sink = require "softworld.output.sink"

local corpus = {}

-- Returns a tetrahedron and a ball of 5 rings as points and triangles.
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

function corpus.mesh()
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

function corpus.csv()
  local numbers = { "a,b_mm,c\n" }
  for i = 1, 60 do numbers[#numbers + 1] = ("%d,%.17g,%.3e\n"):format(i, math.sin(i), math.exp(-i)) end
  return { { table.concat(numbers), "csv" },
    { '"first ""name""";second\n# a comment\n"1.5";2e-3\n\n3;4\n', "csv" },
    { "x\ty\r\n1\t2\r\n3\t4\r\n", "csv" }, { "\239\187\191t,v\n0,1\n1,2\n", "csv" } }
end

function corpus.trajectory()
  local path, plain = { "t,x_mm,y [mm],z,qw,qx,qy,qz,_note\n" }, {}
  for i = 0, 40 do
    path[#path + 1] = ("%.6g,%.6g,%.6g,%.6g,%.17g,0,0,%.17g,w%d\n"):format(0.1 * i, 10 * i, 5 * math.sin(i),
      0.01 * i, math.cos(0.1 * i), math.sin(0.1 * i), 7)
    plain[#plain + 1] = ("%.6g %.6g %.6g\n"):format(0.01 * i, 0.02 * math.sin(i), 0.1):gsub(" ", ";")
  end
  return { { (table.concat(path):gsub(",_note", ""):gsub(",w7", "")), "csv" }, { table.concat(plain), "csv" },
    { "x,y,z,rx_deg,ry_deg,rz_deg\n0,0,0,0,0,0\n0.1,0,0.2,10,0,45\n0.3,0,0,0,90,0\n", "csv" } }
end

-- Returns the scene that is saved, loaded and resumed.
function corpus.scene()
  local scene = sw.scene { name = "fuzzed" }
  scene:obstacle { shape = "plane", friction = 0.3 }
  scene:obstacle { shape = "mesh", data = corpus.mesh()[1][1], format = "obj", scale = 0.1,
    at = { 0.3, 0.2, 0 } }
  local wire = scene:wire { cable = "GXL 1.5", from = { 0, 0, 0.0015 }, to = { 0.2, 0, 0.0015 },
    segments = 12 }
  local other = scene:wire { E = 1e7, density = 1e3, radius = 1e-3, from = { 0, 0.1, 0.1 },
    to = { 0.1, 0.1, 0.1 }, segments = 4 }
  scene:clamp(other, { s = 0 })
  scene:tie(wire, { s = 0.2, to = { 0.2, 0, 0.05 }, slack = 0.05 })
  local hand = scene:gripper { name = "hand" }
  scene:process(function(p)
    p:step("grasp", function() hand:grasp(wire, { s = 0.03 }) end)
    p:step("lift", function() hand:move { by = { 0, 0, 0.01 }, speed = 0.5 } end)
  end)
  return scene
end

corpus.RUN = { dt = 0.005, frame = 0.01 }

-- Corrects the checksum of a damaged saved scene, so that reading goes on past the checksum.
function corpus.sealed(text)
  if #text < 48 then return text end
  local sum = -3750763034362895579
  for i = 41, #text do sum = (sum ~ text:byte(i)) * 1099511628211 end
  return text:sub(1, 24) .. ("<I8i8"):pack(#text, sum) .. text:sub(41)
end

-- Sets a run's computing times to 1, so that the file always has the same bytes.
local function timeless(text)
  for _, key in ipairs { "cpu", "wall" } do
    local mark = ("<s4"):pack(key) .. "d"
    local from, to = text:find(mark, 1, true)
    if from then text = text:sub(1, to) .. ("<d"):pack(1) .. text:sub(to + 9) end
  end
  return corpus.sealed(text)
end

function corpus.save()
  local list = {}
  local path = sink.scratch()
  local scene <close> = corpus.scene()
  local function add() list[#list + 1] = { timeless(sink.read_file(path)), "sws" } end
  local write = sink.write_file
  sink.write_file = function(...) -- keep the file of every step
    local written = write(...)
    add()
    return written
  end
  local ok, why = pcall(scene.run, scene, { dt = corpus.RUN.dt, frame = corpus.RUN.frame, save = path })
  sink.write_file = write
  assert(ok, why)
  scene:save(path)
  add()
  sink.discard(path)
  return list
end

return corpus
