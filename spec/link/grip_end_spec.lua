-- SPDX-License-Identifier: GPL-3.0-or-later
-- A grip of a wire's end, whose s is the length that the wire was drawn with. By rounding the wire may be
-- shorter by 1e-17 m: the grip's centre was then the other end of the grip.
local sw = require "softworld"

local function gripped(length, segments, angle, s)
  local scene = sw.scene {}
  local wire = scene:wire { cable = "GXL 1.5", from = { 0, 0, 0 }, segments = segments,
    to = { length * math.cos(angle), length * math.sin(angle), 0 } }
  local hand = scene:gripper { name = "hand" }
  hand:grasp(wire, { s = s or wire.length })
  assert.is_true(scene:settle().ok)
  return hand, wire
end

describe("a grip of a wire's end", function()
  it("has its centre there, and its moment about it, if rounding makes the wire shorter than s", function()
    local shorter = 0
    for _, length in ipairs { 0.123, 0.18, 0.2 } do
      for segments = 10, 24, 2 do
        local hand, wire = gripped(length, segments, 0.7, length)
        shorter = shorter + (wire.length < length and 1 or 0)
        local p, e = hand:position(), wire:position(wire.length)
        for k = 1, 3 do assert.is_near(e[k], p[k], 1e-12) end
        local m, same = hand:moment(), gripped(length, segments, 0.7):moment()
        for k = 1, 3 do assert.is_near(same[k], m[k], 1e-8) end
      end
    end
    assert.is_true(shorter > 3) -- else this tests nothing
  end)

  -- "s = 0.2 m is not allowed; it must be at least 0 m and at most 0.2 m"
  it("may be one by pads, or the goal of an approach", function()
    local scene, radius = sw.scene {}, 1.5e-3
    scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
    local wire = scene:wire { cable = "GXL 1.5", from = { 0, 0, radius }, segments = 20,
      to = { 0.2 * math.cos(0.7), 0.2 * math.sin(0.7), radius } }
    assert.is_true(wire.length < 0.2)
    local hand = scene:gripper { name = "hand", pads = { width = 0.01, friction = 0.6, opening = 0.004 } }
    local other = scene:gripper { name = "other", at = { 0, 0, 0.1 } }
    scene:process(function()
      hand:grasp(wire, { s = 0.2, approach = "plates", force = 3 })
      other:approach(wire, { s = 0.2 })
    end)
    local run = scene:run { dt = 0.005 }
    assert.is_true(run.ok, run.reason)
    local p, q, e = hand:position(), other:position(), wire:position(wire.length)
    for k = 1, 3 do
      assert.is_near(e[k], p[k], 1e-4)
      assert.is_near(e[k], q[k], 1e-4)
    end
    hand:release()
    local fine, why = pcall(hand.grasp, hand, wire, { s = 0.21, approach = "plates", force = 3 })
    assert.is_false(fine)
    local text = "s = 0.21 m is not allowed; it must be at least 0 m and at most 0.2 m"
    assert.truthy(why:find(text, 1, true), why)
    assert.truthy(why:find("grip_end_spec.lua", 1, true), why) -- the script's line
  end)
end)
