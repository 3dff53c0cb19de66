-- SPDX-License-Identifier: GPL-3.0-or-later
-- A drive with a force limit whose speed jumps: the wire slips until the limit has changed its speed.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local G, LENGTH, DAMPING = 9.81, 0.47, 2 -- [m/s2], [m], [1/s]

-- Length that slips out in 0.3 s, from the motion of an inextensible wire: L dv/dt = g L +- limit -
-- damping L v, all per mass and length. What enters at the guide has the wire's speed.
local function exact(speed)
  local L, v, step, out = LENGTH - 0.3 * speed, -speed, 1e-5, 0
  for _ = 1, 30000 do
    v = v + step * (G + (v < 0 and 0.5 or -0.5) * G * LENGTH / L - DAMPING * v)
    L, out = L + step * v, out + step * v
  end
  return out
end

-- A cable hangs from a feed that draws it in. The drive stops and from then on bears half of the weight.
-- Returns the length that slips out of it in 0.3 s [m].
local function slipped(cable, dt, speed, late)
  local scene = sw.scene{}
  local wire = scene:wire{ from = { 0, 0, 0 }, to = { 0, 0, -LENGTH }, segments = 15, cable = cable }
  scene:force{ kind = "damping", on = wire, mass = DAMPING, stiffness = 0.002 }
  local feed = scene:feed(wire, { s = 0, speed = -speed })
  local limit = 0.5 * wire.beam.mass_per_length * G * wire.length
  t.fine(scene:run{ duration = 0.3, dt = dt })
  local before = feed:fed()
  if late then
    feed:speed(0)
    feed:force_limit(limit)
  else
    feed:force_limit(limit)
    feed:speed(0)
  end
  t.fine(scene:run{ duration = 0.3, dt = dt })
  return feed:fed() - before
end

describe("a drive with a force limit", function()
  -- The force changes its sign within a step, for the rest of which the wire stands. Up to one
  -- step of fall is lost, 13 % of 0.3 s at 20 ms; measured 10, 2.8, 2.5, 1.0 %, and 0.2 % at 0.2 ms.
  -- Regression: the wire stopped at once, which no limited drive can do, and then sprang back.
  for _, cable in ipairs{ "FLRY-B 0.5", "H07V-K 2.5" } do
    it("brakes a wire no harder than its limit: " .. cable, function()
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
        for _, speed in ipairs{ 0.1, 0.3 } do
          local what = ("%g m/s, step %g ms"):format(speed, 1e3 * dt)
          t.share(exact(speed), slipped(cable, dt, speed), 0.02 + 5 * dt, what)
        end
      end
    end)
  end

  -- The limit comes after the sudden stop, whose blow the wire keeps: measured 0.151 m, and 0.150 m at
  -- 0.2 ms. Regression: half of the first change of speed was lost, because the drive's force had another
  -- sign before. The wire stuck in every second step, and 2 mm slipped out.
  it("lets go of a wire that stood with all of its speed", function()
    t.share(0.150, slipped("FLRY-B 0.5", 0.005, 0.3, true), 0.05, "slipped [m]")
  end)

  -- Nothing but the drive acts on the cable: speed = limit/mass time, and the mass grows by 1 %.
  -- Regression: the wire had the asked speed in the first step, with up to 500 times the limit, and a
  -- real cable failed with energy from nowhere.
  it("starts a wire no harder than its limit", function()
    for _, before in ipairs{ true, false } do
      for _, dt in ipairs{ 0.01, 0.002 } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local wire = scene:wire{ from = { 0, 0, 0 }, to = { LENGTH, 0, 0 }, segments = 15,
          cable = "FLRY-B 0.5" }
        scene:force{ kind = "damping", on = wire, stiffness = 0.002 }
        local mass = wire.beam.mass_per_length * LENGTH
        local limit = 3 * mass
        local feed = scene:feed(wire, { s = 0, force_limit = limit, speed = before and 0.3 or nil })
        if not before then feed:speed(0.3) end
        t.fine(scene:run{ duration = 0.05, dt = dt })
        t.share(0.15, wire:velocity(LENGTH)[1], 0.01, "speed [m/s]")
        t.share(0.00375, feed:fed(), 0.01, "fed [m]")
        t.below(limit * (1 + 1e-6), feed:over().raw_peak_force, "largest force of a step [N]")
        t.fine(scene:run{ duration = 0.1, dt = dt })
        t.share(0.3, feed:speed(), 1e-6, "speed at the end [m/s]")
      end
    end
  end)
end)
