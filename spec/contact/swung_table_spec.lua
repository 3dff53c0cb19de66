-- SPDX-License-Identifier: GPL-3.0-or-later
-- A free wire on a table that swings, harder than friction can follow. Its slip turns round twice in each
-- period, within steps. Reference: a block whose velocity changes by mu g t towards the table's, integrated
-- here in steps of 2 us.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local MU, G, LENGTH, DURATION = 0.3, 9.81, 0.3, 0.35

-- Way [m] and heat over the mass [J/kg] of the block.
local function block(speed)
  local h, v, x, heat = 2e-6, 0, 0, 0
  for i = 1, math.floor(DURATION / h + 0.5) do
    local to, from, most = speed(i * h), v, MU * G * h
    v = from + math.max(-most, math.min(most, to - from))
    x = x + 0.5 * (v + from) * h
    heat = heat + MU * G * math.abs(speed((i - 0.5) * h) - 0.5 * (v + from)) * h
  end
  return x, heat
end

local function swung(o, table_at, dt, tolerance)
  local scene = sw.scene{}
  local c, s = math.cos(o.turn or 0), math.sin(o.turn or 0)
  local r = o.cable and sw.cable(o.cable).outer_diameter.value / 2 or 0.002
  local plate = scene:obstacle{ shape = "plane", friction = MU }
  local ends = { { -LENGTH / 2 * c, -LENGTH / 2 * s, r }, { LENGTH / 2 * c, LENGTH / 2 * s, r } }
  local args = { segments = o.segments or 30, from = ends[o.swap and 2 or 1], to = ends[o.swap and 1 or 2] }
  if o.cable then args.cable = o.cable else args.E, args.density, args.radius = 1e7, 1200, r end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
  plate:follow(function(time) return { table_at(time), 0, 0 } end)
  local before = wire:position(LENGTH / 2)[1]
  local run = t.fine(scene:run{ dt = dt, tolerance = tolerance, duration = DURATION })
  local books = run:ledger()
  return wire:position(LENGTH / 2)[1] - before,
    books.lost.friction / (wire.beam.mass_per_length * LENGTH), books.gap / books.play, run.steps
end

describe("a free wire on a table that swings", function()
  -- Before: up to 0.7 mu g dt of velocity for each turn of the slip, 1.3 mm at 10 ms, 2.5 mm at 5 ms.
  for _, swing in ipairs{ { 0.01, 5 }, { 0.006, 8 } } do
    local amplitude, often = table.unpack(swing)
    local omega = 2 * math.pi * often
    local function table_at(time) return time <= 0 and 0 or amplitude * (1 - math.cos(omega * time)) end
    local function speed(time) return time <= 0 and 0 or amplitude * omega * math.sin(omega * time) end
    local way, heat = block(speed)

    it(("of %g mm at %g Hz goes as far as a block"):format(1e3 * amplitude, often), function()
      for _, o in ipairs{ { cable = "GXL 1.5" }, { turn = 1.5 },
        { cable = "H07V-K 10", turn = 0.7, swap = true, segments = 31 } } do
        for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 1e-3 } do
          local x, q, gap, steps = swung(o, table_at, dt)
          local what = ("%s, %g ms"):format(o.cable or "soft", 1e3 * dt)
          print(("measured: %s way %.3f of %.3f mm, heat %.4f, %d steps"):format(what, 1e3 * x, 1e3 * way,
            q / heat, steps))
          t.near(way, x, 3e-4, "way [m], " .. what)
          t.share(heat, q, 0.02, "heat, " .. what)
          t.below(0.005, math.abs(gap), "from nowhere over what is in play, " .. what)
        end
        local x, q = swung(o, table_at, nil, 1e-4)
        t.near(way, x, 6e-4, "way [m] by tolerance")
        t.share(heat, q, 0.02, "heat by tolerance")
      end
    end)
  end
end)
