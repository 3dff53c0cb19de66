-- SPDX-License-Identifier: GPL-3.0-or-later
--- Cost of coupling distant nodes in the solver: a wire that touches itself, wires that are joined. Each is
-- compared with the same wire without coupling; both are measured alternately.
-- @module bench.links
local sw = require "softworld"

local length, radius, modulus = 1, 0.003, 1e8 -- [m], [m], [Pa]
local EI = modulus * math.pi * radius ^ 4 / 4 -- [N m2]

local benchlinks = { batches = 40, batch = 0.5, warm = 7 } -- [-], [s], [s] of simulated time

-- A wire with slack that is twisted at one end. If touching, it coils up on itself.
local function coiled(touching, turns)
  local scene, path = sw.scene{ gravity = { 0, 0, 0 } }, {}
  for i = 0, 200 do
    local u = i / 200
    local b = 0.03 * math.sin(math.pi * u) ^ 2
    path[i + 1] = { u * length, b * math.cos(2 * u), b * math.sin(3 * u) }
  end
  local wire = scene:wire{ EA = modulus * math.pi * radius ^ 2, EI = EI, GJ = EI / 1.3,
    mass_per_length = 0.03, radius = radius, path = path, segments = 99 }
  if touching then scene:wire_contact{ friction = 0.3 } end
  scene:clamp(wire, { s = 0 })
  local hand = scene:clamp(wire, { s = wire.length })
  scene:force{ kind = "damping", mass = 2 }
  hand:follow{ points = { { 0, 0, 0 }, { -0.3, 0, 0 } }, duration = 6, relative = true,
    turn = { axis = { 1, 0, 0 }, angle = 2 * math.pi * turns } }
  return scene
end

-- A cantilever of one piece, or of two joined pieces.
local function cantilever(pieces)
  local scene = sw.scene{}
  local last
  for k = 1, pieces do
    local wire = scene:wire{ E = modulus, density = 1200, radius = radius,
      from = { (k - 1) / pieces * length, 0, 0 }, to = { k / pieces * length, 0, 0 },
      segments = 100 // pieces }
    if last then
      scene:join{ ends = { { last, s = last.length }, { wire, s = 0 } } }
    else
      scene:clamp(wire, { s = 0 })
    end
    last = wire
  end
  return scene
end

-- Returns the shortest time of a Newton iteration of each scene [s], measured alternately.
local function iteration_times(scenes, dt)
  local best = {}
  for i, scene in ipairs(scenes) do
    best[i] = math.huge
    local run = scene:run{ duration = benchlinks.warm, dt = dt, frame = 1e9 }
    if not run.ok then return nil, run.reason end
  end
  for _ = 1, benchlinks.batches do
    for i, scene in ipairs(scenes) do
      local run = scene:run{ duration = benchlinks.batch, dt = dt, frame = 1e9 }
      if not run.ok then return nil, run.reason end
      best[i] = math.min(best[i], run.cpu / run.iterations)
    end
  end
  return best
end

local function row(name, scenes, aim, places)
  local times, reason = iteration_times(scenes, 0.005)
  local found = { name = name, ok = times ~= nil, reason = reason, aim = aim,
    places = times and places and places() or 0 }
  if times then found.plain, found.linked, found.ratio = times[1], times[2], times[2] / times[1] end
  for _, scene in ipairs(scenes) do scene:close() end
  return found
end

--- Returns rows { name, plain, linked [s per Newton iteration], ratio, places, aim, ok, reason }.
function benchlinks.rows()
  local coil = coiled(true, 6.5)
  return {
    row("self-contact", { coiled(false, 1), coil }, 3, function() return #coil:touches() end),
    row("two halves joined", { cantilever(1), cantilever(2) }),
  }
end

return benchlinks
