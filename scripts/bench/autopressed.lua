-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes for bench.auto in which wires are squeezed. Their fixed models are lines and meshes. The true
-- values are from far finer, independent computations (reference case 11).
-- @module bench.autopressed
local sw = require "softworld"
local core = sw.core
local flat = require "softworld.model.flat"
local mesh = require "softworld.model.mesh"

local autopressed = {}

local ERROR = 0.005 -- relative error of the references [-]
local LEVELS = 3    -- levels of a fixed model
local SEEN = 5      -- steps from which the cost of the finest model is estimated
local COARSE = 0.04 -- time step of the coarsest level [s]

local function pick(random, list) return list[1 + math.floor(random() * #list)] end

-- A piece of a long wire between two long plates, in plane strain; share: approach over the diameter.
local function between(section, share, friction, duration)
  return function(options)
    local scene = sw.scene { name = "plates", gravity = { 0, 0, 0 } }
    local r = section.radius
    local args = { name = "w", from = { 0, 0, 0 }, to = { r, 0, 0 }, segments = 4,
      model = options.auto and "auto" or nil }
    for key, value in pairs(section) do args[key] = value end
    local w = scene:wire(args)
    scene:force { kind = "plane_strain", on = w, direction = { 1, 0, 0 } }
    for k, name in ipairs { "low", "top" } do
      local side = 2 * k - 3
      scene:obstacle { name = name, shape = "box", size = { 10 * r, 10 * r, 2 * r }, friction = friction,
        at = { r / 2, 0, 2 * side * r } }:follow { relative = true, duration = duration,
        points = { { 0, 0, 0 }, { 0, 0, -side * share * r } } }
    end
    scene:force { kind = "damping", mass = 50 }
    return scene, { "top.force" }, duration
  end
end

-- Approach over diameter, force per length over E R; nu = 0.3, no sliding on the plates.
local solid = { { 0.05, 0.03478504828 }, { 0.1, 0.08485878573 }, { 0.2, 0.2240633922 } }
-- The same for a tube with an inner radius of 0.7 R, without friction.
local tube = { { 0.02, 0.000869108883 }, { 0.05, 0.002121184817 }, { 0.1, 0.004049114355 },
  { 0.2, 0.007463310733 } }

local function force(E, r, per) return { ["top.force"] = { value = { 0, 0, per * E * r * r },
  error = ERROR * per * E * r * r } } end

autopressed.scenes = {
  { name = "plates", pressed = true, of = function(random)
    local E, r = pick(random, { 5e5, 1e6, 5e6 }), pick(random, { 0.0025, 0.005, 0.01 })
    local row, duration = pick(random, solid), pick(random, { 0.4, 0.8 })
    local section = { E = E, nu = 0.3, density = 1200, radius = r }
    return between(section, row[1], 2, duration), false, force(E, r, row[2])
  end },
  { name = "hose", pressed = true, of = function(random)
    local E, r = pick(random, { 1e6, 5e6, 20e6 }), pick(random, { 0.004, 0.006, 0.01 })
    local row, duration = pick(random, tube), pick(random, { 0.4, 0.8 })
    local inner = 0.7 * r
    local EI, area = E * math.pi / 4 * (r ^ 4 - inner ^ 4), math.pi * (r ^ 2 - inner ^ 2)
    local section = { EA = E * area, EI = EI, GJ = EI / 1.3, mass_per_length = 1200 * area, radius = r }
    return between(section, row[1], 0.05, duration), false, force(E, r, row[2])
  end },
}

autopressed.fixed = { "phno", "dhno", "phns", "dhns", "phne", "dhne" }

-- Runs a mesh on level k; returns value, time [s] and name of the quantity, or nil.
local function computed(build, word, k)
  local scene, names, duration = build {}
  local wire = core.data(scene).wires[1].object
  local why = mesh.make({ object = wire, body = flat.body(wire), share = 0.1 },
    word:sub(4) == "s" and mesh.springs or mesh.elements, k)
  if why then return nil end
  local static = word:sub(1, 1) == "p" or nil
  local fine, run = pcall(scene.run, scene, { duration = duration, quasistatic = static,
    dt = COARSE / 2 ^ (k - 1) * (static and 4 or 1) })
  if not fine or not run.ok then return nil end
  return core.data(scene).obstacles[2].object:force()[3], run.cpu, names[1]
end

--- Returns whether a fixed model of a mesh suffices, and its time [s]. The levels are run here, because runs
-- with error bars work with lines only.
function autopressed.suffices(build, word, share, truth)
  local total, last, before, name, value = 0, nil, nil, nil, nil
  for k = 1, LEVELS do
    local cpu
    value, cpu, name = computed(build, word, k)
    if not value then return false, total end
    total, before, last = total + cpu, last and math.abs(value - last) or before, value
  end
  local t = truth[name]
  return math.abs(value - t.value[3]) <= share * math.abs(t.value[3]) + before + t.error, total
end

-- Makes the whole wire a mesh of solid elements; of springs if elements cannot have its EA, EI and GJ.
local function fill(wire)
  local segments = math.max(2, math.ceil(wire.length / wire.radius))
  local filled = pcall(wire.remodel, wire, { model = "radial", body = "solid", particles = 12, layers = 2,
    segments = segments })
  if not filled then wire:remodel { model = "radial", segments = 3 * segments } end
end

--- Returns a lower bound for the cost of the finest model everywhere [s]: its coarsest level, with all wires
-- as meshes, estimated from a few steps. nil: it cannot be computed.
function autopressed.finest(build, moves)
  local scene, _, duration = build {}
  local fine, run = pcall(function()
    if not moves then scene:settle() end
    for _, w in ipairs(core.data(scene).wires) do fill(w.object) end
    return scene:run { duration = SEEN * COARSE, dt = COARSE, parts = false }
  end)
  return fine and run.ok and run.cpu * duration / (SEEN * COARSE) or nil
end

return autopressed
