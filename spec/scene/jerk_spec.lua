-- SPDX-License-Identifier: GPL-3.0-or-later
-- Holds that start abruptly: the impulse is the momentum that the wire gains, at any step. Through a window
-- longer than the jerk, the peak force is that impulse over the window.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local V, L = 0.4, 0.3

-- A damped wire in space. A hold at its middle draws it along its axis, abruptly at speed V. Axial waves
-- cross the wire in well under a millisecond.
local function drawn(cable, dt, integrator)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local args = { from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 30, cable = cable or nil }
  if not cable then args.E, args.density, args.radius = 5e7, 1500, 0.0025 end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
  local hand = scene:gripper{}
  scene:process(function(p)
    hand:grasp(wire, { s = L / 2 })
    p:wait(0.03)
    hand:move{ by = { 0.04, 0, 0 }, speed = V, law = "linear" }
  end)
  t.fine(scene:run{ dt = dt, duration = 0.09, integrator = integrator })
  -- three nodes get the hold's speed at once; the hold does not bear their momentum
  return hand, (1 - 3 / 30) * wire.beam.mass_per_length * L * V
end

describe("a hold that starts at once", function()
  for _, cable in ipairs{ false, "GXL 1.5", "FLRY-B 10" } do
    it(("gives its momentum and no more: %s"):format(cable or "soft"), function()
      for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.0005 } do
        local hand, momentum = drawn(cable, dt)
        local all = hand:over()
        -- forces at the steps' ends would add up to -5.8 times the momentum at 10 ms
        t.share(momentum, all.impulse[1], 0.03, ("impulse at %g s"):format(dt))
        -- a soft wire's waves run to and fro within the window
        if cable then t.share(momentum / 0.01, all.peak_force, 0.06, ("peak at %g s"):format(dt)) end
      end
    end)
  end

  it("gives the same momentum with other methods", function()
    for _, method in ipairs{ "implicit-euler", "implicit-midpoint", "sdirk2" } do
      local hand, momentum = drawn("GXL 1.5", 0.002, method)
      t.share(momentum, hand:over().impulse[1], 0.03, method)
    end
  end)
end)
