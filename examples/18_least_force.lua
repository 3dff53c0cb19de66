-- SPDX-License-Identifier: GPL-3.0-or-later
-- What is the smallest gripping force with which a gripper lifts a wire without slip? A study finds the
-- smallest force that meets the constraint. Its scene is built once and restored before each evaluation.
local sw = require "softworld"
local mm, friction = sw.units.mm, 0.4
local wire, hand

local study = sw.study { name = "least force", constraints = { slips = { max = 0 } },
  parameters = { force = { 0.01, 1, unit = "N", log = true } },
  setup = function()
    local scene = sw.scene { name = "least force" }
    scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
    scene:force { kind = "damping", mass = 8 }
    wire = scene:wire { cable = "GXL 1.5", from = mm { 0, 0, 1.5 }, to = mm { 300, 0, 1.5 } }
    hand = scene:gripper { name = "hand", slip_tolerance = mm(0.2),
      pads = { width = mm(15), friction = friction, opening = mm(4) } }
    return scene
  end,
  evaluate = function(p, scene)
    scene:process(function(q)
      hand:grasp(wire, { s = mm(150), approach = "plates", force = p.force, on_slip = "stop" })
      hand:move { by = mm { 0, 0, 250 }, duration = 0.5 }
      q:wait(0.3)
    end)
    local run = scene:run { dt = 0.005 }
    assert(run.ok, run.reason)
    return { slips = hand.slip_event ~= nil, rest = wire.beam.mass_per_length * 9.81 * wire.length
      / (2 * friction) }
  end }

local found = study:minimise("force", { starts = 1, tolerance = 1e-3 })
for _, row in ipairs(study:table()) do
  print(("%7.4f N: %s"):format(row.force, row.pass and "holds" or "slips"))
end
print(("least force %.4f N per finger; held at rest it would be weight / (2 mu) = %.4f N"):format(found.value,
  found.best.rest))
