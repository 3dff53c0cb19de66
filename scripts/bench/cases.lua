-- SPDX-License-Identifier: GPL-3.0-or-later
--- The benchmarked scenes: those of softworld.cases with a known result, and laying over thin walls,
-- where the penetration depth is the result.
--
-- A case: name, title, static; make(config) returns a state with `scene` and `duration`; run(state,
-- options) computes it and returns a report; judge(state, row) sets the row's error.
-- @module bench.cases
local cases = require "softworld.cases"

local benchcases = {}

local function known(name, title, static, unit)
  if not package.searchpath("softworld.cases." .. name, package.path) then return end
  benchcases[name] = { name = name, title = title, static = static, unit = unit,
    make = function(config)
      return cases[name]{ segments = config.segments, model = config.model }
    end,
    run = function(state, run_options) return state.run(run_options) end,
    judge = function(state, row) row.error = 100 * state.error() end,
  }
end

known("droop", "S1: a cantilever's droop, Gamma = 10", true)
known("release", "S2: release of a cantilever, Gamma = 10, 1 s", false)
known("transport", "Transport of a hanging wire, 2 s", false)
known("catenary", "Catenary, L/span = 1.5", true, "%")
known("arc", "A curved wire's droop out of its plane, w L^3/EI = 20", true)
known("lift", "One end lifted from a table", true, "%")
-- Restoring a snapshot of a wire that lies exactly on a table and was never run does not restore its contact.
if benchcases.lift then benchcases.lift.remake = true end

-- Wires that are meshes -------------------------------------------------------

local thick = 0.0125 -- radius of a wire whose length (1 m) is 40 times its diameter [m]

--- The models that charts compare, by their names in rows.
benchcases.meshes = { "rod", "tube", "radial", "cubic", "composite", "radial, solid", "cubic, solid" }

local function of_meshes(name, title, static)
  local case = {}
  for key, value in pairs(benchcases[name]) do case[key] = value end
  case.name, case.title, case.static = "mesh_" .. name, title, static
  function case.make(config)
    local model, section = config.model:match "^([^,]+),? ?(.*)$"
    return cases[name]{ segments = config.segments, model = model, radius = thick,
      section = section ~= "" and section or nil }
  end
  benchcases[case.name] = case
end

of_meshes("droop", "A wire of length 40 times its diameter: droop, Gamma = 10", true)
of_meshes("release", "A wire of length 40 times its diameter, released, 1 s", false)

-- Laying over three walls -----------------------------------------------------

local walls = { x = { 0.4, 0.9, 1.4 }, high = 0.1 } -- as in softworld.cases.laying [m]
local looks = 50 -- checks of the state per second

-- Counts where the wire passes the walls' middle planes: all passes, and passes below the top.
local function count_crossings(state)
  local p = state.wire:positions()
  for _, x in ipairs(walls.x) do
    for i = 1, #p - 5, 3 do
      local a, b = p[i] - x, p[i + 3] - x
      if (a < 0) ~= (b < 0) then
        local z = p[i + 2] + (p[i + 5] - p[i + 2]) * a / (a - b)
        state.looked = state.looked + 1
        if z < walls.high then state.crossings = state.crossings + 1 end
      end
    end
  end
end

benchcases.walls = { name = "walls", title = "S3: laying over three walls, 5 s", static = false,
  unit = "mm deep" }

function benchcases.walls.make(config)
  local c = cases.laying{ segments = config.segments, model = config.model }
  c.clamp:follow{ points = { { 0, 0, 0.15 }, { 2, 0, 0.15 } }, duration = 5, law = "minimum-jerk" }
  return { scene = c.scene, wire = c.wire, duration = config.duration or c.duration, depth = 0,
    crossings = 0, looked = 0 }
end

function benchcases.walls.run(state, options)
  local total = { steps = 0, rejected = 0, iterations = 0, evaluations = 0, ok = true, reason = "" }
  local count = math.max(1, math.ceil(math.min(looks, 1 / (options.dt or 1 / looks)) * state.duration - 1e-9))
  for k = 1, count do
    local r = state.scene:advance(options, state.duration * k / count)
    for _, key in ipairs{ "steps", "rejected", "iterations", "evaluations" } do
      total[key] = total[key] + r[key]
    end
    total.ok, total.reason = r.ok, r.reason
    if not r.ok then return total end
    state.depth = math.max(state.depth, (state.scene:penetration()))
    count_crossings(state)
  end
  return total
end

function benchcases.walls.judge(state, row)
  row.penetration, row.crossings, row.looked = state.depth, state.crossings, state.looked
  row.error = 1e3 * state.depth
end

-- Cost of a node -----------------------------------------------------------------

local edge, node_steps, least_steps = 0.01, 1e6, 20 -- [m], [-], [-]

-- A wavy wire between two pins starts to fall, so that no part of it is straight or at rest.
local function wavy(config, changes)
  local sw = require "softworld"
  local n, points = config.segments, {}
  for i = 0, n do
    local s = i * edge
    points[i + 1] = { s * 0.99, 0, 0.02 * math.sin(4 * s) }
  end
  local scene = sw.scene{ name = "scale" }
  local wanted = { model = config.model, segments = n, E = 9.4176e8, density = 1500, radius = 0.0025,
    path = points }
  for key, value in pairs(changes) do wanted[key] = value end
  local wire = scene:wire(wanted)
  scene:pin(wire, { s = 0 })
  scene:pin(wire, { s = wire.length })
  local steps = math.min(1000, math.max(least_steps, node_steps / n))
  return { scene = scene, wire = wire, duration = steps * config.dt }
end

local function weighed(name, title, changes)
  benchcases[name] = { name = name, title = "Cost of a node, 10 mm edges" .. title, static = false,
    unit = "", weigh = true,
    make = function(config) return wavy(config, changes) end,
    run = function(state, options) return state.scene:advance(options, state.duration) end,
    judge = function(_, row) row.error = "" end,
  }
end

weighed("scale", "", {})
weighed("curved", ", curved at rest", { rest = "path" })
weighed("flat", ", two values of EI", { EI = { 0.0289, 0.0280 }, GJ = 0.02, normal = { 0, 1, 0 } })
weighed("rolling", ", that rolls", { rolls = true })

return benchcases
