-- SPDX-License-Identifier: GPL-3.0-or-later
--- Calibrates known cables: measures the time, and how often the 95 % intervals contain the true values.
--
-- Each cable is drawn at random: its weight, weight L^3 / EI from 2 to 300, GJ / EI from 0.5 to 2, slack from
-- 3 to 40 %, ends at different heights. It hangs as a rod of 200 segments, a mesh that the calibration does
-- not use. 20 points along it (length 1 m) have normal noise of 0.5 mm; the twist at which it buckles has
-- noise of 2 %.
-- @module bench.calibration
local sw = require "softworld"
local twisted = require "softworld.calibration.twisted"

local calibration = {}

calibration.aims = { time = 1, low = 0.93, high = 0.97 } -- [s], range of the share of intervals [-]

local NOISE, POINTS, SEGMENTS = 5e-4, 20, 200 -- [m], [-], [-]

local function normal()
  return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

-- Returns a scene in which the wire hangs at rest; one clamp is moved to its place step by step.
local function hang(c)
  local scene = sw.core.scene{ gravity = { 0, 0, -9.81 } }
  local wire = scene:wire{ EA = 1e6 * c.mass * 9.81, EI = c.EI, GJ = c.EI, mass_per_length = c.mass,
    radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = SEGMENTS }
  scene:clamp(wire, { s = 0 })
  local far = scene:clamp(wire, { s = 1 })
  for i = 1, 20 do
    far:pose{ 1 + (c.to[1] - 1) * i / 20, 0, c.to[2] * i / 20 }
    local rest = scene:settle()
    assert(rest.ok, rest.reason)
  end
  return scene, wire
end

--- Draws a cable and its measurements.
function calibration.draw()
  local c = { mass = 0.01 * 5 ^ math.random() }
  c.EI = c.mass * 9.81 / (2 * 150 ^ math.random())
  c.GJ = c.EI * 0.5 * 4 ^ math.random()
  local chord = 1 / (1.03 + 0.37 * math.random())
  local tilt = 0.2 * (2 * math.random() - 1)
  c.to = { chord * math.cos(tilt), chord * math.sin(tilt) }
  local scene, wire = hang(c)
  local points = {}
  for k = 1, POINTS do
    local s = k / (POINTS + 1)
    local x = wire:position(s)
    points[k] = { x[1] + NOISE * normal(), x[3] + NOISE * normal() }
  end
  scene:close()
  local twist = { length = 0.5, tension = 20 * c.EI }
  local angle = twisted.angle(twist, twist.tension, c.EI, c.GJ)
  twist.sigma = 0.02 * angle
  twist.angle = angle + twist.sigma * normal()
  c.args = { mass_per_length = c.mass, outer_diameter = 0.003, twist = twist,
    sag = { points = points, length = 1, to = c.to, sigma = NOISE } }
  return c
end

--- Calibrates count cables. Returns the shares whose intervals contain EI and GJ, and the longest and mean
-- CPU time of a calibration [s]. estimated: the calibration estimates the sigma of the points itself.
function calibration.coverage(count, seed, estimated)
  math.randomseed(seed)
  local held, longest, sum, bad = { EI = 0, GJ = 0 }, 0, 0, 0
  for _ = 1, count do
    local c = calibration.draw()
    if estimated then c.args.sag.sigma = nil end
    local clock = os.clock()
    local found = sw.calibration(c.args)
    clock = os.clock() - clock
    longest, sum, bad = math.max(longest, clock), sum + clock, bad + (found.fit.ok and 0 or 1)
    for name in pairs(held) do
      local q = found[name]
      if q.low and q.low <= c[name] and c[name] <= q.high then held[name] = held[name] + 1 end
    end
  end
  return held.EI / count, held.GJ / count, longest, sum / count, bad
end

return calibration
