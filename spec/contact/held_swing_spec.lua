-- SPDX-License-Identifier: GPL-3.0-or-later
-- A soft wire, held at one end, lies on a table that swings along it. Each time the slip turns round, the
-- friction mu m g does so too, along the whole wire, and waves run to the hold. Its force is then up to 2.5
-- mu m g. Reference: a bar of masses, springs and dashpots with friction, integrated here in short steps. It
-- has the same peaks as the program in steps of 0.2 ms, within 1.5 %.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local MU, G, LENGTH, RADIUS, DENSITY, DURATION, WINDOW = 0.3, 9.81, 0.3, 0.002, 1200, 0.35, 0.01
local DAMPED = 1e-3 -- dashpots: this time times the stiffness [s]

-- Largest mean over the window of the force on the bar's end, over mu m g. speed: the table's
-- velocity at a time.
local function bar(E, speed)
  local n = E > 1e7 and 15 or 20
  local dx, mass = LENGTH / n, DENSITY * LENGTH / n -- of an area of 1 m2
  -- h below dx^2 / (2 c^2 DAMPED), the limit of the dashpots in explicit steps
  local h = math.min(0.3 * dx ^ 2 / (E / DENSITY * DAMPED), 0.3 * dx / (E / DENSITY) ^ 0.5)
  local steps, back = math.floor(DURATION / h), math.floor(WINDOW / h)
  local u, v, sums, most = {}, {}, { [0] = 0 }, 0
  for i = 0, n do u[i], v[i] = 0, 0 end
  local pull = {}
  for k = 1, steps do
    local table_v = speed(k * h)
    for i = 1, n do pull[i] = E / dx * (u[i] - u[i - 1] + DAMPED * (v[i] - v[i - 1])) end
    pull[n + 1] = 0
    for i = 1, n do
      local share = i == n and 0.5 or 1
      local slip = v[i] + h / (share * mass) * (pull[i + 1] - pull[i]) - table_v
      v[i] = table_v + (slip > 0 and 1 or -1) * math.max(0, math.abs(slip) - MU * G * h)
      u[i] = u[i] + h * v[i]
    end
    sums[k] = sums[k - 1] + pull[1]
    if k >= back then most = math.max(most, math.abs(sums[k] - sums[k - back]) / back) end
  end
  return most / (MU * G * DENSITY * LENGTH)
end

local function swung(o, at, dt, tolerance)
  local scene = sw.scene{}
  local c, s = math.cos(o.turn or 0), math.sin(o.turn or 0)
  local plate = scene:obstacle{ shape = "plane", friction = MU }
  local from, to = { 0, 0, RADIUS }, { LENGTH * c, LENGTH * s, RADIUS }
  if o.swap then from, to = to, from end
  local wire = scene:wire{ E = o.E, density = DENSITY, radius = RADIUS, segments = o.segments or 30,
    from = from, to = to }
  scene:force{ kind = "damping", mass = 0, stiffness = DAMPED }
  local hold = scene:clamp(wire, { s = o.swap and LENGTH or 0 })
  plate:follow(function(time) return { c * at(time), s * at(time), 0 } end)
  local run = t.fine(scene:run{ dt = dt, tolerance = tolerance, duration = DURATION, window = WINDOW })
  t.near(0, #run.events, 0, "events")
  return hold:over().peak_force / (MU * G * wire.beam.mass_per_length * LENGTH), run.steps
end

-- Velocity of the swing and place at a time.
local function swing(amplitude, often)
  local omega = 2 * math.pi * often
  return function(time) return amplitude * omega * math.sin(omega * time) end,
    function(time) return time <= 0 and 0 or amplitude * (1 - math.cos(omega * time)) end
end

-- With a step of 5 ms for each turn of the slip, the window of 10 ms cannot lie exactly at the peak: 5 %.
local function same(o, amplitude, often)
  local speed, at = swing(amplitude, often)
  local due = bar(o.E, speed)
  for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3 } do
    local peak, steps = swung(o, at, dt)
    local what = ("%g MPa%s, %g ms"):format(o.E / 1e6, o.turn and ", turned" or "", 1e3 * dt)
    print(("measured: %s peak %.3f of %.3f mu m g, %d steps"):format(what, peak, due, steps))
    t.share(due, peak, 0.07, "peak, " .. what)
  end
  t.share(due, (swung(o, at, nil, 1e-4)), 0.11, "peak by tolerance")
end

describe("a soft wire held on a table that swings", function()
  -- Before: up to 35 % too small at 10 and 20 ms; by tolerance up to 34 %.
  for _, o in ipairs{ { E = 1e6 }, { E = 3e6, turn = 1.1 },
    { E = 1e7, turn = 2.5, swap = true, segments = 37 }, { E = 2e7, swap = true }, { E = 5e7 } } do
    for _, s in ipairs{ { 0.006, 3 }, { 0.01, 5 }, { 0.02, 12 } } do
      it(("with %g MPa by %g mm at %g Hz: its hold"):format(o.E / 1e6, 1e3 * s[1], s[2]), function()
        same(o, s[1], s[2])
      end)
    end
  end

  -- Waves run through it in 0.7 ms. Its hold has the same mean force in whole steps.
  it("takes no shorter steps if it is stiff", function()
    local _, at = swing(0.01, 5)
    for _, E in ipairs{ 2.5e8, 1e10 } do
      local peak, steps = swung({ E = E }, at, 1e-2)
      t.near(35, steps, 0, "steps")
      t.share(1, peak, 0.05, "peak")
    end
  end)
end)
