-- SPDX-License-Identifier: GPL-3.0-or-later
-- A move that goes nowhere is refused in the words of the script, which has no way-points.
local sw = require "softworld"

describe("a move that goes nowhere", function()
  it("is refused and names by or to", function()
    local scene = sw.scene{ name = "nowhere" }
    local wire = scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.2, 0, 0.1 } }
    local hand, said = scene:gripper{ name = "hand" }, {}
    scene:process(function()
      hand:grasp(wire, { s = 0.1 })
      for i, move in ipairs{ { by = { 0, 0, 0 }, speed = 0.1 }, { by = { 0, 1e-12, 0 }, duration = 1 },
        { to = { 0.1, 0, 0.1 }, speed = 0.1 }, { points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true,
          speed = 0.1 } } do
        said[i] = select(2, pcall(hand.move, hand, move))
      end
      hand:move{ by = { 0, 0, 0 }, turn = { axis = { 0, 0, 1 }, angle = 0.1 }, duration = 0.1 }
    end)
    local run = scene:run{ dt = 0.01 }
    assert.is_true(run.ok, run.reason)
    for i, text in ipairs{ "by = (0, 0, 0) m moves nowhere; leave the move out",
      "by = (0, 1e-12, 0) m moves nowhere", "to = (0.1, 0, 0.1) m is the place where it is",
      "way-point 2 (0, 0, 0) m repeats the one before it" } do
      assert.truthy(said[i]:find("gripper:move: " .. text, 1, true), said[i])
    end
  end)
end)
