-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mixed grip is frozen, a second gripper grasps the wire too, and the first one lets go. The second grip
-- holds the wire's direction all the time: force and moment balance the weight. On the mesh of the first grip
-- it had no nodes at its ends, and the wire swung about it as about a pin.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local vec = require "softworld.vec"
local t = require "spec.physics.tools"

local LENGTH, FIRST, SECOND = 0.3, 0.1, 0.2

-- Returns the moment of the wire's weight about a point [N m].
local function moment_of_weight(wire, weight, about)
  local parts, sum = 300, { 0, 0, 0 }
  for k = 1, parts do
    local arm = vec.sub(wire:position(LENGTH * (k - 0.5) / parts), about)
    sum = vec.add(sum, vec.cross(arm, { 0, 0, -weight / parts }))
  end
  return sum
end

local function hand_over(cable)
  local scene = sw.scene{ name = "again" }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0.1 }, to = { LENGTH, 0, 0.1 }, segments = 60 }
  scene:force{ kind = "damping", on = wire, mass = 15 }
  local pads = { width = 0.02, height = 0.01, opening = 0.012, friction = 0.6 }
  local first = scene:gripper{ name = "first", pads = pads, at = { FIRST, 0, 0.1 } }
  local second = scene:gripper{ name = "second", pads = pads, at = { SECOND, 0, 0.1 } }
  local helper = scene:clamp(wire, { s = 0.15 })
  scene:process(function(p)
    first:grasp(wire, { s = FIRST, approach = "mixed", force = 8 })
    second:grasp(wire, { s = SECOND, approach = "mixed", force = 8 })
    helper:release()
    first:release()
    p:wait(0.8)
  end)
  return t.fine(scene:run{ dt = 0.005 }), wire, first, second
end

describe("a wire in two mixed grips, of which the first one lets go", function()
  for _, cable in ipairs{ "GXL 1.5", "H07V-K 4" } do
    it("stays held in its direction by the second: " .. cable, function()
      local _, wire, first, second = hand_over(cable)
      local weight = wire.beam.mass_per_length * LENGTH * 9.81
      t.share(weight, second:force()[3], 0.01, "force of the second grip [N]")
      local centre = wire:position(SECOND)
      local wanted = -moment_of_weight(wire, weight, centre)[2]
      t.share(wanted, second:moment{ at = centre }[2], 0.02, "moment of the second grip [N m]")
      local last = first.events[#first.events]
      assert.are.equal("thawed", last.kind)
      assert.are.equal("rod", last.on)
    end)
  end
end)
