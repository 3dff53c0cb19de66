-- SPDX-License-Identifier: GPL-3.0-or-later
-- gripper:clip stops its tool 1/40 of the way over the lips from where the wire is seated. Where it stands
-- decides the pull on the wire from then on, which clip:ratio() gives. References are processes that go down
-- by twice as fine steps.
local sw = require "softworld"

local SPEED = 0.05

-- Returns the pull over the retention. press(hand, clip, way): presses the wire in.
local function ratio(o, press)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = o.cable, segments = 110, from = { 0, 0, 0.04 }, to = { 0.3, 0, 0.04 } }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 2e-3 }
  local clip = scene:clip{ at = { 0.12, 0, 0.02 }, width = 0.0138, insertion = o.insertion,
    retention = 2 * o.insertion, friction = 0.3 }
  local hand = scene:gripper{ pads = { width = 0.008 } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.137 })
    press(hand, clip, 1.5 * wire.radius)
    p:wait(0.1)
  end)
  assert.is_true(scene:run{ dt = 0.0025 }.ok)
  assert.is_true(clip:seated())
  local value = clip:ratio()
  scene:close()
  return value
end

local function by_clip(hand, clip)
  hand:clip{ into = clip, speed = SPEED, max_force = 40 * clip.insertion, overtravel = 0.01 }
end

local function by_hand(hand, clip, way)
  while not clip:seated() do
    hand:move{ by = { 0, 0, -way / 1280 }, speed = SPEED, law = "linear" }
  end
  hand:move{ by = { 0, 0, -way / 40 }, speed = SPEED, law = "linear" }
end

describe("the pull on a wire that a gripper has pressed into a clip", function()
  -- The tool went on to the end of a twentieth of the way: 0.084 and 0.050 instead of 0.092 and 0.062. 6 %: a
  -- step of 1/640 of the way, by which it may stand lower, changes the pull by 1/32 of what 1/20 changes it.
  for _, o in ipairs{ { cable = "GXL 0.5", insertion = 0.8 }, { cable = "GXL 1.5", insertion = 2 } } do
    it("is that of a tool that stops by finer steps: " .. o.cable, function()
      local exact = ratio(o, by_hand)
      assert.near(exact, ratio(o, by_clip), 0.06 * exact)
    end)
  end
end)
