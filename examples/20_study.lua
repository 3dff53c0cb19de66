-- SPDX-License-Identifier: GPL-3.0-or-later
-- How fast may a gripper lift a wire, and how hard must it hold it? A study looks for the least grip force
-- at which nothing slips, then tells how often that force is enough when the friction is not known well.
-- Started again it goes on from its journal.
--
--   softworld examples/20_study.lua [journal]
local sw = require "softworld"
local mm = sw.units.mm

local wire, hand

-- Built once, before the workers are forked; restored before each evaluation.
local function setup()
  local scene = sw.scene { name = "least force" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  scene:force { kind = "damping", mass = 8 }
  wire = scene:wire { cable = "GXL 1.5", from = mm { 0, 0, 1.2 }, to = mm { 300, 0, 1.2 } }
  hand = scene:gripper { name = "hand", pads = { width = mm(15), friction = 0.4, opening = mm(4) },
    slip_tolerance = mm(0.2) }
  return scene
end

local study = sw.study { name = "least force", file = arg[1], setup = setup,
  parameters = { force = { 0.01, 1, unit = "N", log = true } },
  evaluate = function(p, scene)
    scene:process(function(q)
      hand:grasp(wire, { s = mm(150), approach = "plates", force = p.force, on_slip = "stop" })
      hand:move { by = mm { 0, 0, 250 }, duration = 0.5 }
      q:wait(0.3)
    end)
    local run = scene:run { dt = 0.005 }
    assert(run.ok, run.reason)
    return { grip = p.force, margin = hand:over().peak_margin, slips = hand.slip_event ~= nil }
  end,
  constraints = { slips = { max = 0 } } }

local found = study:minimise("grip", { starts = 2, tolerance = 1e-3 })
print(study)
print(("least force %.4f N per finger"):format(found.value))
