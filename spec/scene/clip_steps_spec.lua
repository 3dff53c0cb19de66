-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that a gripper presses into a clip: the peak force and the impulse of the gripper do not depend
-- on the step. Lips are 1.5 radii long, which a gripper passes in one step of usual size; and it stops at
-- once at the seat, where the lips' dashpot still bears the force of the speed that it had.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local SPEED, HEIGHT = 0.2, 0.015

local function pressed(cable, dt, options)
  local o = options or {}
  local scene = sw.scene{}
  scene:clip{ at = { 0.1, 0, 0 }, width = 0.01, insertion = 2, retention = 5, friction = 0.25 }
  local args = { from = { 0, 0, HEIGHT }, to = { 0.2, 0, HEIGHT }, segments = o.segments or 20 }
  if cable then args.cable = cable else args.E, args.density, args.radius = 5e6, 1500, 0.0025 end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 1e-3 }
  local hand = scene:gripper{}
  scene:process(function(p)
    hand:grasp(wire, { s = 0.1 })
    hand:move{ by = { 0, 0, -HEIGHT }, speed = o.speed or SPEED, law = "linear" }
    p:wait(0.02)
  end)
  local run = scene:run{ duration = 0.1, dt = dt, integrator = o.integrator }
  t.fine(run)
  return hand:over(), run
end

describe("a wire pressed into a clip", function()
  -- Against steps of 0.1 ms, within 0.7 % of 0.05 ms. Without parts: peaks 2.8 times, impulses 8 times.
  for _, cable in ipairs{ "GXL 0.5", "FLRY-B 0.5", "FLRY-B 10", "identified white", false } do
    it("has peaks and impulses of fine steps: " .. (cable or "soft"), function()
      local fine = pressed(cable, 1e-4)
      for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.001 } do
        local m, run = pressed(cable, dt)
        t.share(fine.peak_force, m.peak_force, 0.06, ("peak at %g s"):format(dt))
        t.share(fine.impulse_size, m.impulse_size, 0.08, ("impulse at %g s"):format(dt))
        assert.is_true(run.steps < 0.1 / dt + 60, ("%d steps"):format(run.steps))
      end
    end)
  end

  it("needs parts only where it passes the lips, at any speed", function()
    for _, speed in ipairs{ 0.3, 1 } do
      local fine = pressed("GXL 1.5", 1e-4, { speed = speed })
      local m, run = pressed("GXL 1.5", 0.005, { speed = speed })
      t.share(fine.peak_force, m.peak_force, 0.1, "peak")
      assert.is_true(run.steps < 90, ("%d steps"):format(run.steps))
    end
  end)

  it("does so with other methods and edges", function()
    local fine = pressed("GXL 1.5", 1e-4)
    -- bdf2 looks back: it has no mean of the step in which the gripper stops
    for method, allowed in pairs{ sdirk2 = 0.06, ["generalized-alpha"] = 0.06, bdf2 = 0.15 } do
      local m = pressed("GXL 1.5", 0.005, { integrator = method })
      t.share(fine.peak_force, m.peak_force, allowed, method)
    end
    local edges = pressed("GXL 1.5", 1e-4, { segments = 33 })
    t.share(edges.peak_force, pressed("GXL 1.5", 0.01, { segments = 33 }).peak_force, 0.06, "33 segments")
  end)
end)
