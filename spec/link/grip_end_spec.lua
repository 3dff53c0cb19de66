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
end)
