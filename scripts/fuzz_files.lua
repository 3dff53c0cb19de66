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
local corpus = dofile((arg[0]:match "^(.*/)" or "") .. "fuzz_corpus.lua")

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
  false, -- set below
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
  function(text) -- replaces one number
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

local in_place = { 2, 3, 8 } -- damages that keep the positions of the bytes behind

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
  pcall(scene.run, scene, { duration = 2 * corpus.RUN.dt, dt = corpus.RUN.dt })
end

local kinds = {
  mesh = { corpus.mesh, function(path)
    local scene <close> = sw.scene {}
    scene:obstacle { shape = "mesh", file = path, scale = 0.1 }
  end },
  csv = { corpus.csv, function(path) csv.read(path) end },
  trajectory = { corpus.trajectory, function(path)
    local t = sw.trajectory { path = path, speed = 0.2 }
    t:sample(5)
  end },
  save = { corpus.save, function(path, number)
    if number % 2 == 0 then
      local scene <close> = sw.load(path)
      use(scene)
    else
      local scene <close> = corpus.scene()
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
-- The order of kinds. Scenes are rare, because their files are twenty times as large as the others.
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
  if kind == "save" and random() < 0.7 then text = corpus.sealed(text) end
  return kind, text, from[2]
end

local RAW = { "attempt to ", "bad argument", "stack overflow", "no integer representation", "HALF DONE" }

-- Returns why an error message is not acceptable, or nil.
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

-- --- worker: runs cases in order and prints each one's number before it begins --------------

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

-- Runs one worker from case first on; returns its sums { bytes, cases, refused, found, next case }.
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
