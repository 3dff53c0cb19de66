-- SPDX-License-Identifier: GPL-3.0-or-later
--- Cost of crowds: many obstacles, many nodes that land at once, many wires, a bundle of wires.
-- @module bench.crowds
local sw = require "softworld"

local benchcrowds = {}

local function wire(scene, from, to, segments)
  return scene:wire{ E = 5e6, density = 1500, radius = 0.0025, from = from, to = to, segments = segments }
end

-- Returns the CPU time of a run of the scene [s], and its report.
local function cost(scene, duration)
  local start = os.clock()
  local row = scene:advance({ dt = 0.01 }, scene.time + duration)
  return os.clock() - start, row
end

-- Small boxes in a square on a table, and a wire of 500 segments over them. Returns the time to make them
-- and the time of a step [s].
function benchcrowds.boxes(count)
  local scene, side, start = sw.scene{}, math.ceil(math.sqrt(count)), os.clock()
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i = 0, count - 1 do
    scene:obstacle{ shape = "box", size = { 0.01, 0.01, 0.02 }, friction = 0.3,
      at = { i % side * 0.03, i // side * 0.03, 0.01 } }
  end
  local made = os.clock() - start
  wire(scene, { 0, 0.5, 0.05 }, { 2, 0.5, 0.05 }, 500)
  cost(scene, 0.01)
  local time, row = cost(scene, 0.3)
  scene:close()
  return made, time / row.steps
end

-- A straight wire of so many segments falls flat on a table. Returns the time of the most expensive step, and
-- of a step in which the wire lies at rest [s].
function benchcrowds.landing(nodes)
  local scene, most, last = sw.scene{}, 0, 0
  scene:obstacle{ shape = "plane", friction = 0.3 }
  wire(scene, { 0, 0, 0.01 }, { 0.01 * nodes, 0, 0.01 }, nodes)
  for _ = 1, 10 do
    last = cost(scene, 0.01)
    most = math.max(most, last)
  end
  scene:close()
  return most, last
end

-- count wires of 50 segments fall on a table at an angle. Returns the time per node and 10 ms while they land
-- and while they lie [s]. touching: they may touch each other; "crossed": and another wire, moved by its end,
-- falls across two of them.
function benchcrowds.wires(count, touching)
  local scene, draw = sw.scene{}, 1
  local function height()
    draw = draw * 16807 % 2147483647
    return 0.01 + 0.01 * draw / 2147483647
  end
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i = 1, count do
    wire(scene, { 0, 0.02 * i, height() }, { 0.5, 0.02 * i, height() }, 50)
  end
  if touching then scene:wire_contact{ friction = 0.3 } end
  if touching == "crossed" then
    local across = wire(scene, { 0, -0.02, 0.03 }, { 0.5, 0.03, 0.03 }, 50)
    scene:clamp(across, { s = 0 }):follow(function(t) return { 0, -0.02 + 0.01 * math.sin(6 * t), 0.03 } end)
  end
  local landing, lying = cost(scene, 0.3), cost(scene, 0.3)
  scene:close()
  return landing / 30 / (51 * count), lying / 30 / (51 * count)
end

-- A cable is laid on a table beside count others that lie there, clamped by one end, with dashpots. Returns
-- the CPU time of the laying [s].
function benchcrowds.board(count)
  local scene, r = sw.scene{}, sw.cable("GXL 1.5").outer_diameter.value / 2
  local function cable(y, z)
    return scene:wire{ cable = "GXL 1.5", from = { 0, y, z }, to = { 0.6, y, z }, segments = 60 }
  end
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i = 1, count do scene:clamp(cable(0.03 * i, r), { s = 0 }) end
  scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
  scene:clamp(cable(-0.05, 0.05), { s = 0 }):follow{ relative = true, duration = 1.5,
    points = { { 0, 0, 0 }, { 0.1, 0, -0.045 }, { 0.3, -0.1, -0.045 } } }
  local time = cost(scene, 2)
  scene:close()
  return time
end

-- count wires fall on a table in a bundle, then lie there. Returns the time per simulated second of the first
-- 0.2 s and of the next 0.2 s [s/s], the solves per step in both, and the time of the first whole second [s].
-- cable: an entry of the catalogue; apart: the wires do not touch each other.
function benchcrowds.bundle(count, cable, apart)
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i = 0, count - 1 do
    local row, y = i // 4, i % 4 * 0.0052 + i // 4 % 2 * 0.0026
    local from, to = { 0, y, 0.0035 + 0.0055 * row }, { 0.5, y, 0.0035 + 0.0055 * row }
    if cable then
      scene:wire{ cable = cable, from = from, to = to, segments = 50 }
    else
      wire(scene, from, to, 50)
    end
  end
  if not apart then scene:wire_contact{ friction = 0.3 } end
  local falling, fell = cost(scene, 0.2)
  local lying, lay = cost(scene, 0.2)
  local rest = cost(scene, 0.6)
  scene:close()
  return falling / 0.2, lying / 0.2, fell.iterations / fell.steps, lay.iterations / lay.steps,
    falling + lying + rest
end

return benchcrowds
