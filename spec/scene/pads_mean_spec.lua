-- SPDX-License-Identifier: GPL-3.0-or-later
-- Means of pads are taken over the time in which they hold something, as those of imposed grips: time in
-- which they go to the wire, or stand open, does not count.
local sw = require "softworld"
local vec = require "softworld.vec"

local RADIUS, LENGTH = 0.0015, 0.2

-- Returns the gripper's loads, the wire's weight and the time from grasp to release; idle: time before and
-- after [s].
local function lifted(idle)
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  local wire = scene:wire{ cable = "GXL 1.5", segments = 20, from = { 0, 0, RADIUS },
    to = { LENGTH, 0, RADIUS } }
  scene:force{ kind = "damping", mass = 3, stiffness = 2e-3 }
  local hand = scene:gripper{ at = { LENGTH / 2, 0, RADIUS + 0.05 }, rotation = { 1, 0, 0, 0 },
    pads = { width = 0.01, friction = 0.7, opening = 5e-3 } }
  local from, to
  scene:process(function(p)
    p:wait(idle)
    hand:move{ by = { 0, 0, -0.0498 }, duration = 0.2 }
    from = p.time
    hand:grasp(wire, { approach = "plates", force = 5 })
    hand:move{ by = { 0, 0, 0.0498 }, duration = 0.3 }
    p:wait(0.5)
    hand:release()
    to = p.time
    p:wait(idle)
  end)
  assert.is_true(scene:run{ dt = 0.01 }.ok)
  return hand:over(), wire.beam.mass_per_length * LENGTH * 9.81, to - from
end

describe("the means of pads", function()
  -- Before, 1 s before and after the grasp made the mean force 1.8 times smaller. 2 %: the steps at whose
  -- ends the pads begin and end to hold count whole.
  it("do not depend on the time in which they hold nothing", function()
    local short, weight, held = lifted(0)
    local long = lifted(1)
    assert.near(short.mean_force, long.mean_force, 0.02 * short.mean_force)
    assert.near(short.mean_moment, long.mean_moment, 0.02 * short.mean_moment + 1e-6 * weight)
    assert.near(short.duration, long.duration, 0.021)
    assert.is_true(long.duration <= held + 0.02, long.duration)
    assert.near(0, vec.norm(vec.sub(short.impulse, long.impulse)), 1e-3 * weight)
    -- lifted from rest and held: the mean is the weight, but for the grasp and the release
    assert.near(weight, long.mean_force, 0.15 * weight)
  end)
end)
