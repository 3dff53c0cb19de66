-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C takes effect within a second of processor time, wherever large scenes spend theirs.
local program = require "host.program"

local LIMIT = os.getenv "SOFTWORLD_PRELOAD" and 10 or 1 -- sanitizers are slow [s]

local function wire(segments, more)
  return ("local w = s:wire{ EA = 6000, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = %d,"
    .. " from = { 0, 0, 0 }, to = { 1, 0, 0 }%s }\n s:clamp(w, { s = 0 })\n"):format(segments, more or "")
end

-- Cube of n x n x n particles.
local CUBE = [[
local n, p, l = 30, {}, {}
local function id(i, j, k) return (i * n + j) * n + k + 1 end
for i = 0, n - 1 do for j = 0, n - 1 do for k = 0, n - 1 do
  p[id(i, j, k)] = { i * 1e-3, j * 1e-3, k * 1e-3 }
  if i > 0 then l[#l + 1] = { id(i, j, k), id(i - 1, j, k), k = 100 } end
  if j > 0 then l[#l + 1] = { id(i, j, k), id(i, j - 1, k), k = 100 } end
  if k > 0 then l[#l + 1] = { id(i, j, k), id(i, j, k - 1), k = 100 } end
end end end
]]

local SPHERE = [[
local p = {}
for i = 1, 200000 do
  local a, b = 2.4 * i, math.acos(1 - 2 * i / 200001)
  p[i] = { math.sin(b) * math.cos(a), math.sin(b) * math.sin(a), math.cos(b) }
end
]]

-- A mesh of 320000 triangles as a file's text.
local SHEET = [[
local n, t = 400, {}
t[1] = ("OFF\n%d %d 0\n"):format((n + 1) ^ 2, 2 * n * n)
for i = 0, n do for j = 0, n do t[#t + 1] = ("%g %g %g\n"):format(i, j, math.sin(i * j)) end end
for i = 0, n - 1 do for j = 0, n - 1 do
  local a = i * (n + 1) + j
  t[#t + 1] = ("3 %d %d %d\n3 %d %d %d\n"):format(a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2)
end end
local data = table.concat(t)
]]

-- A wire that a hold draws along a table by a slow function, which steps also ask whether it stops.
local DRAWN = [[
s:obstacle{ shape = "plane", at = { 0, 0, -0.005 }, friction = 0.3 }
local w = s:wire{ EA = 6000, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 20,
  from = { 0, 0, 0 }, to = { -1, 0, 0 } }
s:clamp(w, { s = 0 }):follow(function(t)
  for i = 1, 20000 do math.sin(i) end
  return { 0.1 * t, 0.02 * math.sin(t), 0 }
end)
]]

-- What is made first, what is interrupted, and after which processor times of it [s].
local CASES = {
  ["a settling of 2e5 nodes"] = { wire(200000), "s:settle{}", 0.1, 1 },
  ["a run of 1e6 nodes"] = { wire(1000000), "s:run{ duration = 1, dt = 1e-3 }", 0, 0.4, 1.5 },
  ["an explicit run of 1e6 nodes"] = { wire(1000000),
    "s:run{ duration = 1, dt = 1e-9, integrator = 'rk4', unstable = true }", 0.8 },
  ["settling of a mesh of many particles"] = {
    wire(2000) .. "w:remodel{ model = 'tube', segments = 8000 }\n", "s:settle{}", 0.2, 1 },
  ["a wire of 1e5 segments that touches itself"] = { wire(100000) .. "s:wire_contact{ self = true }\n",
    "s:run{ duration = 1, dt = 1e-3 }", 0.3 },
  ["a wire of frames"] = { wire(200000, ", rolls = true, GJ = 0.01"),
    "s:run{ duration = 1, dt = 1e-3 }", 0.5 },
  ["a cube of particles"] = { CUBE .. "s:particles{ positions = p, masses = 1e-4, links = l }\n",
    "s:run{ duration = 1, dt = 1e-3 }", 0.1, 1.5 },
  ["the hull of 2e5 points"] = { SPHERE, "s:obstacle{ shape = 'hull', points = p }", 0.1, 0.8 },
  ["a mesh's tree and edges"] = { SHEET,
    "for _ = 1, 50 do s:obstacle{ shape = 'mesh', data = data, format = 'off' } end", 0.7, 1.3 },
  ["a hold's function"] = { DRAWN, "s:run{ duration = 1e4, dt = 0.01 }", 0.2, 0.25, 0.3, 0.35, 0.4, 0.45 },
  ["a calibration"] = { "", "s:wire{ model = 'cubic', across = 8, E = 1e7, nu = 0.3, density = 1000, "
    .. "radius = 0.005, from = { 0, 0, 0 }, to = { 1, 0, 0 } }\n s:run{ duration = 10, dt = 1e-4 }", 0.3 },
}

local ticks

-- Processor time of a process so far, or nil when it has ended [s].
local function used(pid)
  local file <close> = io.open(("/proc/%d/stat"):format(pid))
  local text = file and file:read "a"
  local state, rest = (text or ""):match "%) (%S) (.*)"
  if not state or state == "Z" then return nil end
  local fields = {}
  for word in rest:gmatch "%S+" do fields[#fields + 1] = tonumber(word) end
  if not ticks then
    local pipe <close> = assert(io.popen "getconf CLK_TCK")
    ticks = pipe:read "n"
  end
  return (fields[11] + fields[12]) / ticks
end

local function wait() os.execute "sleep 0.02" end

-- Sends Ctrl-C after this much processor time of the body; returns the processor time from then to its end
-- [s].
local function stop(made, body, after)
  local folder = program.folder()
  local name = program.write(folder .. "/script.lua", ([[
    local sw = require "softworld"
    sw.remarks = false -- of meshes of very many particles
    local s = sw.scene{}
    %s
    local mark = assert(io.open(%q, "w"))
    mark:write(os.clock())
    mark:close()
    local ok, message = pcall(function() %s end)
    local clock = os.clock()
    print(ok) print(clock) print(message)
  ]]):format(made, folder .. "/mark.part", body))
  local command = ("env --default-signal=INT %s %s >%s/out 2>&1 </dev/null & echo $!"):format(
    program.quote(program.path), program.quote(name), folder)
  local pipe = assert(io.popen(command))
  local pid = pipe:read "n"
  pipe:close()
  local base
  while used(pid) and not base do
    wait()
    local file <close> = io.open(folder .. "/mark.part")
    base = file and file:read "n"
  end
  local before = used(pid)
  while before and before < base + after do
    wait()
    before = used(pid)
  end
  assert.is_not_nil(before, "it ended by itself: " .. program.read(folder .. "/out"))
  os.execute("kill -INT " .. pid)
  local begun = os.time()
  while used(pid) do
    wait()
    if os.time() - begun > 120 then os.execute("kill -KILL " .. pid) end
  end
  local ok, clock, message = program.read(folder .. "/out"):match "^(%a+)\n([%d.]+)\n(.*)"
  assert.equal("false", ok)
  assert.matches("interrupted", message)
  return tonumber(clock) - before
end

local names = {}
for name in pairs(CASES) do names[#names + 1] = name end
table.sort(names)

describe("Ctrl-C within a second of processor time", function()
  after_each(program.clean)

  for _, name in ipairs(names) do
    it("ends " .. name, function()
      local case = CASES[name]
      for i = 3, #case do
        local more = stop(case[1], case[2], case[i])
        assert.is_true(more < LIMIT, ("%.2f s after %g s"):format(more, case[i]))
      end
    end)
  end
end)
