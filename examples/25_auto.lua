-- SPDX-License-Identifier: GPL-3.0-or-later
-- The same laying task is run with three tolerances: coarse, fine, and very fine. Each time the run selects
-- the cheapest model that is accurate enough, and prints why.
--
--   softworld examples/25_auto.lua
local sw = require "softworld"
local mm = sw.units.mm

local function lay(share)
  local scene = sw.scene { name = "lay" }
  scene:force { kind = "damping", mass = 5 }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local cable = scene:wire { name = "cable", model = "auto", E = 5e6, density = 1500, radius = mm(2.5),
    from = { 0, 0, mm(2.5) }, to = { 0.6, 0, mm(2.5) }, segments = 24 }
  scene:clamp(cable, { s = 0 })
  local hand = scene:gripper { name = "hand" }
  scene:process(function()
    hand:grasp(cable, { s = 0.6 })
    hand:move { by = { -0.1, 0.1, 0.1 }, duration = 16 }
    hand:move { by = { -0.05, 0.15, -0.1 }, duration = 16,
      turn = { axis = { 0, 0, 1 }, angle = math.pi / 2 } }
  end)
  return scene:run { progress = false, levels = 6,
    tolerance = { ["hand.peak_force"] = { relative = share }, min_bend_radius = { relative = share } } }
end

for _, share in ipairs { 0.3, 0.05, 0.005 } do
  local run = lay(share)
  print(("asked for %g %%: %s, %s"):format(100 * share, run.model.motion, run.model.twist))
  print(run:why())
  print()
end
