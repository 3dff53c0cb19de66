-- SPDX-License-Identifier: GPL-3.0-or-later
-- A gripper presses a wire into a clip: the gripper's peak force and impulse do not depend on the step. The
-- lips are 1.5 radii long; a gripper passes them in one step of usual size. It stops abruptly at the seat,
-- where the lips' dashpot still bears the force of the approach speed.
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
  -- Reference: steps of 0.1 ms, which agree with 0.05 ms within 0.7 %. Without parts (substeps) the peaks
  -- are off by a factor of 2.8, the impulses by 8.
  for _, cable in ipairs{ "GXL 0.5", "FLRY-B 0.5", "FLRY-B 10", "identified white", false } do
    it("has the peak and impulse of fine steps: " .. (cable or "soft"), function()
      local fine = pressed(cable, 1e-4)
      for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.001 } do
        local m, run = pressed(cable, dt)
        t.share(fine.peak_force, m.peak_force, 0.06, ("peak at %g s"):format(dt))
        t.share(fine.impulse_size, m.impulse_size, 0.08, ("impulse at %g s"):format(dt))
        assert.is_true(run.steps < 0.1 / dt + 60, ("%d steps"):format(run.steps))
      end
    end)
  end

  it("needs parts (substeps) only where it passes the lips, at any speed", function()
    for _, speed in ipairs{ 0.3, 1 } do
      local fine = pressed("GXL 1.5", 1e-4, { speed = speed })
      local m, run = pressed("GXL 1.5", 0.005, { speed = speed })
      t.share(fine.peak_force, m.peak_force, 0.1, "peak")
      assert.is_true(run.steps < 90, ("%d steps"):format(run.steps))
    end
  end)

  it("has the peak of fine steps with other methods and edges", function()
    local fine = pressed("GXL 1.5", 1e-4)
    -- bdf2 uses the steps before: it has no mean over the step in which the gripper stops
    for method, allowed in pairs{ sdirk2 = 0.06, ["generalized-alpha"] = 0.06, bdf2 = 0.15 } do
      local m = pressed("GXL 1.5", 0.005, { integrator = method })
      t.share(fine.peak_force, m.peak_force, allowed, method)
    end
    local edges = pressed("GXL 1.5", 1e-4, { segments = 33 })
    t.share(edges.peak_force, pressed("GXL 1.5", 0.01, { segments = 33 }).peak_force, 0.06, "33 segments")
  end)
end)
