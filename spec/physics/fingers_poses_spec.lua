-- SPDX-License-Identifier: GPL-3.0-or-later
-- Three and more fingers close in poses on a wire that sinks by its sag meanwhile, below their centre. They
-- lift it there with far less than their force, and then all press it: each with F, but for the wire's
-- bending and weight of some 0.1 N. In one pose with both parts, friction at the last fingers held the wire
-- off the centre, by up to the depth of touches: 0.9 to 8.6 N for 5 N each, and with no limit of steps. In
-- motion, too, fingers are off by up to 0.25 N (0.45 N: H07V-K 4 in three): they shake the wire a little.
local sw = require "softworld"
local t = require "spec.physics.tools"

local FORCE = 5

-- Returns the largest force of a finger off FORCE [N], and the hand's state. down: gravity [m/s2].
local function grasp(cable, pads, dt, down)
  local scene = sw.scene { gravity = down }
  local wire = scene:wire { cable = cable, segments = 40, from = { -0.1, 0, 0.3 }, to = { 0.1, 0, 0.3 } }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = 0.2 })
  local hand = scene:gripper { name = "hand", pads = pads }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.1, approach = "plates", force = FORCE })
    p:wait(0.1)
  end)
  local run = scene:run { dt = dt, quasistatic = true }
  assert.is_true(run.ok, run.reason)
  local off = 0
  for k = 1, pads.fingers do off = math.max(off, math.abs(hand:force { finger = k }:norm() - FORCE)) end
  return off, hand:state()
end

local DOWN, ASLANT = { 0, 0, -9.81 }, { 0, 9.81 * math.sin(0.5), -9.81 * math.cos(0.5) }
local THREE = { fingers = 3, shape = "round", width = 0.02 }
local FOUR = { fingers = 4, shape = "round", width = 0.02 }
local SIX = { fingers = 6, shape = "flat", width = 0.02, height = 0.002 }
local THREE_OFF = { ["GXL 1.5"] = 0.25, ["FLRY-B 0.5"] = 0.1, ["H07V-K 4"] = 0.5 }

describe("fingers that close in poses on a wire that sinks below their centre", function()
  for _, cable in ipairs { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    for _, dt in ipairs { 0.02, 0.005 } do
      it(("press with their force each, %s, %g s"):format(cable, dt), function()
        for _, down in ipairs { DOWN, dt > 0.01 and ASLANT or nil } do
          local off = grasp(cable, THREE, dt, down)
          t.below(THREE_OFF[cable], off, "three round ones")
          local four, state = grasp(cable, FOUR, dt, down)
          t.below(0.1, four, "four round ones")
          t.below(0.02, state.margin, "their margin")
        end
      end)
    end
    it("press with their force each, six flat ones, " .. cable, function()
      local off, state = grasp(cable, SIX, 0.02, DOWN)
      t.below(0.05, off, "their force")
      t.below(0.01, state.margin, "their margin")
    end)
  end
end)
