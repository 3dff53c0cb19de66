-- SPDX-License-Identifier: GPL-3.0-or-later
-- Lua functions whose acceleration jumps: the program finds the jumps from samples. What a stiff cable bears
-- along itself follows them at once, at any step.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local WAY, TIME, LENGTH = 0.2, 0.4, 0.3
local RATE = 4.5 * WAY / TIME ^ 2 -- a third of the time speeds up [m/s2]

-- Share of the way of a trapezoidal motion at a share u of its time.
local function share_at(u)
  if u > 0.5 then return 1 - share_at(1 - u) end
  return u < 0 and 0 or u < 1 / 3 and 2.25 * u ^ 2 or 1.5 * u - 0.25
end

-- A clamp draws a cable along itself by a function, from `wait` on. Returns the extremes of its force over
-- m a, and the number of steps.
local function drawn(o)
  local scene, c, s = sw.scene{ gravity = { 0, 0, 0 } }, math.cos(o.turn or 0), math.sin(o.turn or 0)
  local wire = scene:wire{ cable = o.cable or "GXL 1.5", segments = o.segments or 30,
    from = { -LENGTH * c, -LENGTH * s, 0 }, to = { 0, 0, 0 } }
  scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
  local way = o.way or function(time) return WAY * share_at((time - o.wait) / TIME) end
  scene:clamp(wire, { s = wire.length, name = "clamp" }):follow{ step = o.step, func = function(time)
    return { c * way(time), s * way(time), 0 }
  end }
  local run = t.fine(scene:run{ dt = o.dt, duration = TIME + 0.15, integrator = o.integrator,
    tolerance = o.tolerance })
  local low, high = 0, 0
  for _, column in ipairs(run:series().columns) do
    if column.name == "clamp.force_x" then
      for _, force in ipairs(column.values) do low, high = math.min(low, force), math.max(high, force) end
    end
  end
  local inert = wire.beam.mass_per_length * LENGTH * (o.rate or RATE) * c
  return low / inert, high / inert, run.steps
end

describe("a function whose acceleration jumps", function()
  -- As for trajectories: m a. Waves along the cable swing for a moment, in steps of 0.5 ms by 2 %.
  local function bears(o, what)
    local low, high = drawn(o)
    t.share(-1, low, 0.02, "force, slowing down, over m a: " .. what)
    t.share(1, high, 0.02, "force, speeding up, over m a: " .. what)
  end

  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 2.5", "H07V-K 10" } do
    it("gives a cable its inertia at once: " .. cable, function()
      for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 5e-4 } do
        bears({ cable = cable, dt = dt, wait = 0.063 }, ("%g ms"):format(1e3 * dt))
        bears({ cable = cable, dt = dt, wait = 0 }, ("%g ms, from the start"):format(1e3 * dt))
      end
    end)
  end

  -- Functions are sampled 0.1 ms beside a time. Corners lie at all places of a step, also nearer to its ends.
  it("does so wherever in a step the jumps are", function()
    for k = 0, 15 do
      local wait = 0.06 + 0.01 * k / 16 + 0.00013 * (k % 7)
      bears({ dt = 1e-2, wait = wait, segments = 15 }, ("from %g s"):format(wait))
    end
    for k = 0, 7 do
      local wait = 0.06 + 0.002 * k / 8
      bears({ dt = 2e-3, wait = wait, segments = 15 }, ("from %g s in steps of 2 ms"):format(wait))
    end
  end)

  it("does so for other methods, directions and difference steps", function()
    for _, method in ipairs{ "sdirk2", "bdf2", "generalized-alpha", "implicit-euler" } do
      for _, dt in ipairs{ 5e-3, 2e-3 } do
        bears({ dt = dt, wait = 0.063, integrator = method }, ("%s, %g ms"):format(method, 1e3 * dt))
      end
    end
    bears({ dt = 1e-2, wait = 0.063, segments = 31, turn = 0.7 }, "turned")
    bears({ dt = 1e-2, wait = 0.063, step = 2e-5 }, "difference step of 0.02 ms")
    bears({ dt = 1e-2, wait = 0.063, step = 5e-4 }, "difference step of 0.5 ms")
    bears({ dt = 1e-2, wait = 0.063, tolerance = 1e-4 }, "by tolerance")
  end)

  -- f = A (1 - cos w t) from a time on: the acceleration jumps to A w^2 and then changes evenly; in steps of
  -- 10 ms by 2 % next to its extremes.
  it("finds a jump before an uneven motion", function()
    for _, dt in ipairs{ 1e-2, 5e-3, 2e-3 } do
      for _, wait in ipairs{ 0.063, 0.0691 } do
        local low, high = drawn{ dt = dt, rate = 0.01 * 20 ^ 2, way = function(time)
          return time < wait and 0 or 0.01 * (1 - math.cos(20 * (time - wait)))
        end }
        t.share(-1, low, 0.03, ("smallest force over m a, %g ms"):format(1e3 * dt))
        t.share(1, high, 0.03, ("largest force over m a, %g ms"):format(1e3 * dt))
      end
    end
  end)

  -- Neither steady motion nor straight lines between samples have corners. Where the motion nearly rests,
  -- kinks between samples count as jumps of velocity: 7 steps more of 55, also without corners.
  it("takes no steps more where none does", function()
    for _, every in ipairs{ 0, 1e-3 } do
      local function sine(time) return 0.02 * math.sin(20 * time) - 0.4 * time end
      local function sampled(time)
        local u = time / every
        local low = math.floor(u)
        return sine(every * low) + (u - low) * (sine(every * (low + 1)) - sine(every * low))
      end
      for _, dt in ipairs{ 1e-2, 2e-3 } do
        local _, _, steps = drawn{ dt = dt, rate = 1, way = every > 0 and sampled or sine }
        t.below(every > 0 and 0.2 or 0, steps * dt / (TIME + 0.15) - 1 - 1e-9, "share of further steps")
      end
    end
  end)

  -- Where a smooth acceleration crosses zero, its change over a few difference steps is all of it; the
  -- slopes beside it explain that. Taken for jumps, such places cut 78 of 1200 steps.
  it("is not seen in smooth motions, in steps as short as a few difference steps", function()
    for _, dt in ipairs { 2e-3, 5e-4 } do
      local scene = sw.scene {}
      local wire = scene:wire { cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0, 0, -0.1 },
        segments = 20 }
      scene:force { kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
      scene:clamp(wire, { s = 0 }):follow { duration = 0.4, func = function(time)
        return { 0.06 * math.sin(2.5 * math.pi * time) ^ 2 * math.sin(10 * math.pi * time), 0, 0 }
      end }
      local run = scene:run { duration = 0.6, dt = dt }
      assert.is_true(run.steps <= 1.01 * 0.6 / dt, ("%d steps of %g s"):format(run.steps, dt))
    end
  end)
end)
