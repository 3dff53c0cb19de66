-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fast or gentle? A gripper lifts a hanging wire over an edge. Height and duration of the lift determine
-- time and peak force, which cannot both be small. The study finds the Pareto front of time and force.
--
--   softworld examples/21_pareto.lua [front.svg]
local sw = require "softworld"
local wire, hand

local study = sw.study { name = "over the edge",
  parameters = { height = { 0.1, 0.5, unit = "m" }, duration = { 0.2, 1.5, unit = "s" } },
  setup = function()
    local scene = sw.scene { name = "over the edge" }
    wire = scene:wire { cable = "GXL 1.5", from = { 0, 0, 0.4 }, to = { 0.01, 0, 0 }, segments = 10 }
    hand = scene:gripper { name = "hand" }
    return scene
  end,
  evaluate = function(p, scene)
    scene:process(function()
      hand:grasp(wire, { s = 0 })
      hand:move { by = { 0, 0, p.height }, duration = p.duration }
    end)
    local run = scene:run { dt = 0.002, duration = p.duration }
    assert(run.ok, run.reason)
    local mass, most = wire.beam.mass_per_length * wire.length, 10 / math.sqrt(3) * p.height / p.duration ^ 2
    return { time = p.duration, peak = hand.peak_force, rigid = mass * (9.81 + most),
      clear = wire:position(wire.length)[3] }
  end,
  constraints = { clear = { min = 0.25, unit = "m" } } }

local front = study:pareto { "time", "peak", evaluations = 400 }
print(front)
for k = 1, #front.rows, math.max(1, #front.rows // 24) do
  local row = front.rows[k]
  print(("%.3f s: %.4f N, lifted by %.3f m; a rigid body would pull with %.4f N"):format(row.time, row.peak,
    row.height, row.rigid))
end
if arg[1] then study:chart { kind = "front", x = "time", y = "peak", path = arg[1] } end
