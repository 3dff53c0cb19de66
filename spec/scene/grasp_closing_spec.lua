-- SPDX-License-Identifier: GPL-3.0-or-later
-- While its pads close a gripper holds nothing, and other processes see that.
local sw = require "softworld"
local t = require "spec.physics.tools"

local function closed(approach, force)
  local scene = sw.scene{ name = "closing" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, 0.0015 }, to = { 0.2, 0, 0.0015 },
    segments = 20 }
  scene:force{ kind = "damping", on = wire, mass = 5 }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, friction = 0.6, opening = 0.01 } }
  local seen = {}
  scene:process(function()
    hand:grasp(wire, { s = 0.1, approach = approach, force = force })
    seen[#seen + 1] = { hand.wire == wire, #hand.wires, tostring(hand) }
    hand:release()
    seen[#seen + 1] = { hand.wire == nil, #hand.wires, tostring(hand) }
  end)
  scene:process(function(p)
    p:wait(0.02)
    seen[#seen + 1] = { hand.wire == nil, #hand.wires, tostring(hand) }
  end)
  t.fine(scene:run{ dt = 0.005 })
  return seen
end

describe("a gripper whose pads close", function()
  it("holds no wire until the end of the grasp", function()
    for _, approach in ipairs{ "plates", "mixed" } do
      assert.same({ { true, 0, ("gripper 'hand' (closing on 'wire', %s)"):format(approach) },
        { true, 1, ("gripper 'hand' (holding 'wire', %s)"):format(approach) },
        { true, 0, "gripper 'hand' (open)" } }, closed(approach, 20))
    end
  end)
end)
