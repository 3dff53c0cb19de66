-- SPDX-License-Identifier: GPL-3.0-or-later
--- Cost of wires that are meshes of particles: per simulated second, per ring, per model. Times are processor
-- times, the shortest of several repeats. Compare only times of the same run.
-- @module bench.meshes
local sw = require "softworld"

-- Repeats [-]; processor time after which repeats end early [s]; factorisations [-]; share of the simulated
-- times [-].
local benchmeshes = { repeats = 5, patience = 2, solves = 400, share = 1 }

--- The models with their sections; the others are compared with the first one.
benchmeshes.models = { { "rod" }, { "string" }, { "tube" }, { "radial" }, { "cubic" }, { "composite" },
  { "radial", "solid" }, { "cubic", "solid" }, { "composite", "solid" } }

-- Reference times { n, time to factor [us] } for a ring of n unknowns, measured with plain blocks of C. The
-- time to solve is 0.5 us for n = 24 and 2.1 us for n = 72; between, a power law in n.
local known = { { 24, 1.05 }, { 36, 3.9 }, { 48, 5.9 }, { 60, 15.6 }, { 72, 19.9 } }
local function known_solve(n) return 0.5 * (n / 24) ^ (math.log(2.1 / 0.5) / math.log(3)) end

local function name_of(entry) return entry[1] .. (entry[2] and ", " .. entry[2] or "") end

-- Returns the shortest processor time [s] of advance(options) through a duration in scenes from make(), and
-- the last report. A step before the measurement makes the system and touches its memory.
local function least_time(make, options, duration)
  local best, all, report = math.huge, 0, nil
  for _ = 1, benchmeshes.repeats do
    local scene = make()
    report = scene:advance(options, options.dt)
    local began = os.clock()
    if report.ok then report = scene:advance(options, options.dt + benchmeshes.share * duration) end
    local time = os.clock() - began
    best, all = math.min(best, time), all + time
    scene:close()
    if not report.ok or all > benchmeshes.patience then break end
  end
  return best, report
end

local function row_of(name, make, dt, duration)
  local time, r = least_time(make, { dt = dt, integrator = "tr-bdf2" }, duration)
  return { name = name, ok = r.ok, reason = r.reason, wall = time / (benchmeshes.share * duration),
    steps = r.steps, rejected = r.rejected, iterations = r.iterations, iteration = time / r.iterations }
end

-- A tube that droops from a clamp: 9 particles a ring, rings 10.1 mm apart.
local function tube(rings)
  local scene = sw.scene{}
  local wire = scene:wire{ model = "tube", E = 1e7, density = 1500, radius = 0.02, segments = rings - 1,
    from = { 0, 0, 0 }, to = { (rings - 1) / 99, 0, 0 } }
  scene:clamp(wire, { s = 0 })
  return scene
end

--- The design's tube: 100 rings, 1 s in steps of 10 ms; `wall` is the time per simulated second [s/s].
function benchmeshes.second()
  local row = row_of("tube, 100 rings of 9 particles, 10 ms", function() return tube(100) end, 0.01, 1)
  row.aim = 0.15
  return row
end

--- Times of the solver for a ring of n unknowns: factor and solve [s], ratio to the reference times.
function benchmeshes.blocks()
  local rows = {}
  for i, entry in ipairs(known) do
    local n = entry[1]
    local factor, solve = require("softworld.probe").blocks_time(100, n // 3, benchmeshes.solves)
    rows[i] = { n = n, factor = factor / 100, solve = solve / 100, aim = 1.5,
      ratio = 1e4 * (factor + solve) / (entry[2] + known_solve(n)) }
  end
  return rows
end

--- Cost of a ring in one Newton iteration, for tubes of increasing length; `ratio` to the first tube.
function benchmeshes.rings()
  local rows = {}
  for i, rings in ipairs{ 100, 400, 1600 } do
    local row = row_of(("%d rings"):format(rings), function() return tube(rings) end, 0.01, 0.1)
    row.rings, row.ring = rings, row.iteration / rings
    row.ratio = row.ring / (rows[1] or row).ring
    rows[i] = row
  end
  return rows
end

-- A thick wire of 20 rings between two plates; the upper plate moves down.
local function squeezed(body)
  local scene, r = sw.scene{ gravity = { 0, 0, 0 } }, 0.01
  scene:wire{ model = "radial", section = body, particles = 12, layers = 2, E = 1e7, density = 1200,
    radius = r, from = { 0, 0, 0 }, to = { 0.1, 0, 0 }, segments = 19 }
  local size = { 0.3, 0.1, 2 * r }
  scene:obstacle{ shape = "box", size = size, at = { 0.05, 0, -2 * r }, friction = 0.3 }
  local plate = scene:obstacle{ shape = "box", size = size, at = { 0.05, 0, 2 * r }, friction = 0.3 }
  plate:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.6 * r } }, duration = 1, relative = true, law = "linear" }
  return scene
end

--- Cost of a radial wire that is squeezed by 30 % in 1 s, in steps of 5 ms.
function benchmeshes.squeezes()
  local rows = {}
  for i, body in ipairs{ "springs", "solid" } do
    rows[i] = row_of("radial 12 x 2, " .. body, function() return squeezed(body) end, 0.005, 1)
    rows[i].aim = 1
  end
  return rows
end

local scenes = {}

-- A released cantilever.
function scenes.cantilever(entry)
  local scene = sw.scene{}
  local wire = scene:wire{ model = entry[1], section = entry[2], E = 1e7, density = 1200, radius = 0.01,
    from = { 0, 0, 0 }, to = { 0.5, 0, 0 } }
  scene:clamp(wire, { s = 0 })
  return scene, wire
end

-- One end is held; the wire falls over a low wall onto a table.
function scenes.wall(entry)
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  scene:obstacle{ shape = "box", size = { 0.02, 0.4, 0.04 }, at = { 0.25, 0, 0.02 }, friction = 0.3 }
  local wire = scene:wire{ model = entry[1], section = entry[2], E = 1e7, density = 1200, radius = 0.01,
    from = { 0, 0, 0.06 }, to = { 0.5, 0, 0.06 } }
  scene:clamp(wire, { s = 0 })
  return scene, wire
end

--- Cost of every model, with default meshes, in the scene "cantilever" or "wall"; `ratio` to the rod.
function benchmeshes.costs(what)
  local rows = {}
  for i, entry in ipairs(benchmeshes.models) do
    local particles
    local row = row_of(name_of(entry), function()
      local scene, wire = scenes[what](entry)
      particles = #wire:particles() // 3
      return scene
    end, 0.005, 1)
    row.particles, row.ratio = particles, row.wall / (rows[1] or row).wall
    rows[i] = row
  end
  return rows
end

--- Times to calibrate default meshes [s].
function benchmeshes.calibrations()
  local rows = {}
  for _, entry in ipairs(benchmeshes.models) do
    local mesh = entry[1]
    local best, ok, why = math.huge, mesh ~= "rod" and mesh ~= "string", nil
    for _ = 1, ok and benchmeshes.repeats or 0 do
      local began = os.clock()
      ok, why = pcall(sw.calibrate, { mesh = mesh, section = entry[2], E = 1e7, nu = 0.35, radius = 0.01 })
      best = math.min(best, os.clock() - began)
    end
    if best < math.huge then
      rows[#rows + 1] = { name = name_of(entry), ok = ok, reason = not ok and why or nil, wall = best,
        aim = 0.05 }
    end
  end
  return rows
end

return benchmeshes
