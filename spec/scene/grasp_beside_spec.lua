-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that close above a wire and only touch it with their rims do not crush it.
local sw = require "softworld"

-- Returns the message of a grasp of a cable that a clamp 100 mm away holds, and the gripper.
local function grasped(cable, force)
  local scene = sw.scene{ name = "beside" }
  local wire = scene:wire{ name = "wire", cable = cable, from = { 0, 0, 0.05 }, to = { 0.4, 0, 0.05 },
    segments = 100 }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.001 }
  scene:clamp(wire, { s = 0.2 })
  local hand, why = scene:gripper{ name = "hand", pads = { width = 0.01 } }, nil
  scene:process(function()
    why = select(2, pcall(hand.grasp, hand, wire, { s = 0.3, approach = "plates", force = force }))
  end)
  assert.is_true(scene:run{ dt = 0.01 }.ok)
  return why, hand
end

describe("pads that close while the wire sags", function()
  it("say that they closed on nothing, or beside it", function()
    local said = grasped("GXL 1.5", 40)
    assert.matches("closed on nothing: wire 'wire' is 5%.%d+ mm from the tool centre", said)
    for _, force in ipairs{ 5, 40 } do
      local why, hand = grasped("H07V-K 10", force)
      assert.matches("gripper 'hand' closed beside the wire: its pads touch it with their rims at "
        .. "0%.0%d+ N per finger; " .. force .. " N is not reached: "
        .. "wire 'wire' is 6%.%d+ mm from the tool centre", why)
      assert.equal("missed", hand.events[1].kind)
      assert.is_nil(hand.wire)
    end
  end)
end)
