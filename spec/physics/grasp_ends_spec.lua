-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that squeeze a mesh on a table push it down by its widening sides, until they lift it. A script that
-- lifts at once goes on when the jaws have their force, not at the end of that step. The push lasted to the
-- end of the step: the mean over 10 ms was V t/10 ms, with the push V and the rest t of the step: 0.37 N
-- for 0.03 N at 10 ms and 0.12 N at 2.5 ms, of a cable of 0.02 N, and no event said so.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH = 0.06 -- [m]

-- Returns the gripper's and the table's peak force [N], and the time at which the grasp ended [s].
local function lifted(o, dt)
  local scene, turn, ended = sw.scene{}, o.turn or 0, nil
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 2, stiffness = o.stiffness }
  local r = sw.cable(o.cable).outer_diameter.value / 2
  local wire = scene:wire{ cable = o.cable, model = o.model, section = o.section, from = { 0, 0, r },
    to = { LENGTH * math.cos(turn), LENGTH * math.sin(turn), r } }
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.5,
    opening = 2 * r + 2e-4 } }
  scene:process(function(p)
    p:wait(o.later or 0)
    hand:grasp(wire, { s = o.s or 0.4 * LENGTH, approach = "plates", force = o.force,
      distance = o.distance and o.distance * 2 * r })
    ended = scene.time
    hand:move{ by = { 0, 0, 0.01 }, duration = 0.06 }
  end)
  t.fine(scene:run{ dt = dt })
  local peak, met = hand.peak_force, scene:find("table"):over().peak_force
  scene:close()
  return peak, met, ended
end

describe("a mesh that pads grasp on a table and lift at once", function()
  for k, o in ipairs{
    { cable = "GXL 1.5", model = "tube", force = 2, stiffness = 1e-3 },
    { cable = "GXL 1.5", model = "radial", force = 2 },
    { cable = "GXL 1.5", model = "tube", distance = 0.98, stiffness = 1e-3 }, -- 16, 9 and 5.9 N before
    { cable = "FLRY-B 2.5", model = "tube", force = 3, stiffness = 1e-3, turn = 1, s = 0.02, later = 0.0037 },
  } do
    it(("has the same peak at all steps: %d, %s"):format(k, o.cable), function()
      local fine, on_table, at = lifted(o, 5e-4)
      for _, dt in ipairs{ 0.01, 0.0025 } do
        local what = (" at %g ms"):format(1e3 * dt)
        local peak, met, ended = lifted(o, dt)
        -- The pads close in parts of 0.1 ms, and lift off the push within 1.5 ms of the window: 0.1/1.5
        t.share(fine, peak, 0.07, "peak" .. what)
        t.share(on_table, met, 0.07, "peak of the table" .. what)
        t.near(at, ended, 5e-4, "end of the grasp" .. what)
      end
    end)
  end
end)
