-- SPDX-License-Identifier: GPL-3.0-or-later
-- Where the acceleration of a hold jumps, its force jumps too. The impulse of any time is the change of the
-- wire's momentum all the same, and the mean of an even acceleration is m a.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L, A = 0.06, 8

-- A hand accelerates a cable in space by A for a while, then brakes it evenly. Returns the hand, the start
-- [s] and the mass [kg].
local function moved(cable, dt)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 24 }
  scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
  local hand, start = scene:gripper{}, nil
  scene:process(function(p)
    hand:grasp(wire, { s = L / 2 })
    p:wait(0.1)
    start = scene.time
    hand:move{ by = { 0, 0, 0.2 }, duration = 0.4, law = "trapezoidal", acceleration = A }
    p:wait(0.1)
  end)
  t.fine(scene:run{ dt = dt, frames = false })
  return hand, start, wire.beam.mass_per_length * L
end

describe("a hand whose acceleration jumps", function()
  -- Regression: in steps of 20 and 10 ms 0.5 and 0.76 of the impulse of the first 20 ms; the whole was not 0.
  for _, cable in ipairs{ "GXL 1.5", "H07V-K 4" } do
    it(("gives the momentum of any time: %s"):format(cable), function()
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
        local hand, start, m = moved(cable, dt)
        local name = ("at %g s"):format(dt)
        for _, T in ipairs{ 0.02, 0.04, 0.06 } do
          local first = hand:over(start, start + T)
          t.share(m * A * T, first.impulse[3], 0.01, ("impulse of %g s %s"):format(T, name))
          t.share(m * A, first.mean_force, 0.01, ("mean force of %g s %s"):format(T, name))
        end
        t.below(0.01 * m * A * 0.07, math.abs(hand:over().impulse[3]), "impulse of all " .. name)
      end
    end)
  end
end)
