-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mixed grip in slow handling on a table with friction. While it is frozen its pads touch nothing; poses
-- took this for a wire that leaves its pads, and refused every step. Its release took minutes.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local mu = 0.3

-- Draws a cable along the table by 0.1 m, then lifts the gripper by 0.1 m. yaw: of the scene [rad]; turned:
-- the wire's ends are swapped. Returns the force along the way and upwards while it draws, and upwards after
-- the lift [N].
local function drawn(cable, dt, yaw, turned)
  local scene = sw.scene{}
  local c, s = math.cos(yaw), math.sin(yaw)
  local function at(x, z) return { c * x, s * x, z } end
  scene:obstacle{ shape = "plane", friction = mu }
  local r = sw.scene{}:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }.radius
  local from, to = at(0, r), at(0.4, r)
  if turned then from, to = to, from end
  local wire = scene:wire{ cable = cable, from = from, to = to, segments = 37 }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, height = 0.01 } }
  local along, up, lifted
  scene:process(function()
    hand:grasp(wire, { s = turned and 0.03 or 0.37, approach = "mixed", force = 10 })
    hand:move{ by = at(0.1, 0), duration = 2 }
    local f = hand:force()
    along, up = c * f[1] + s * f[2], f[3]
    hand:move{ by = at(-0.05, 0.1), duration = 2 }
    lifted = hand:force()[3]
    hand:move{ by = { 0, 0, -0.1 }, duration = 1 }
    hand:release() -- as a mesh that lies loose on the table the wire did not come to rest in minutes
    assert.equal("rod", wire.model)
  end)
  t.fine(scene:run{ dt = dt, quasistatic = true })
  assert.equal(2, #hand.events) -- frozen, thawed by the release
  t.below(1e-4, wire:position(0.2)[3] - r, "it lies on the table again")
  return along, up, lifted, 0.4 * wire:get().mass_per_length * 9.81
end

describe("a mixed grip in poses", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it(("draws %s along a table against its friction"):format(cable), function()
      local cases = { { 0.1, 0.7, true } }
      if cable == "GXL 1.5" then cases[2] = { 0.04, 0, false } end
      for _, case in ipairs(cases) do
        local along, up, lifted, weight = drawn(cable, table.unpack(case))
        t.share(mu * (weight - up), along, 0.01, cable .. ": friction of what lies on the table")
        t.above(0.3 * weight, lifted, cable .. ": lifted")
        t.below(weight, lifted, cable .. ": lifted")
      end
    end)
  end
end)
