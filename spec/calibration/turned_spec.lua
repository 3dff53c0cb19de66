-- SPDX-License-Identifier: GPL-3.0-or-later
-- sw.calibration of cantilevers whose photograph or clamp is not level, without `directions`.
local sw = require "softworld"
local sagged = require "softworld.calibration.sagged"

local G, MASS, RADIUS, LENGTH = 9.81, 0.03, 0.002, 0.6 -- [m/s2], [kg/m], [m], [m]

local function normal()
  return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

-- Returns n points with noise of a cantilever whose clamp is tilted, in a picture that is turned [rad].
local function photo(EI, n, turn, tilt, noise)
  local o = { ends = "cantilever", from = { 0, 0 }, length = LENGTH, radius = RADIUS,
    directions = { { math.cos(tilt), math.sin(tilt) } } }
  local list, points = sagged.curve(o, EI, 1e5, MASS), {}
  local c, s = math.cos(turn), math.sin(turn)
  for k = 1, n do
    local at = list[1 + math.floor((#list - 1) * (k - 0.3) / n + 0.5)]
    points[k] = { at[1] * c - at[2] * s + noise * normal(), at[1] * s + at[2] * c + noise * normal() }
  end
  return points
end

local function calibrate(points, more)
  local sag = { ends = "cantilever", length = LENGTH, points = points }
  for key, value in pairs(more or {}) do sag[key] = value end
  return sw.calibration { mass_per_length = MASS, outer_diameter = 2 * RADIUS, sag = sag }
end

local function holds(q, EI) return q.low <= EI and EI <= q.high end

describe("sw.calibration of a cantilever without directions", function()
  -- Taken as exactly level: EI was 5 to 26 % off, with a narrow interval and no remark.
  it("has an interval with the truth in it, and says by which angle the picture is turned", function()
    math.randomseed(11)
    for _, EI in ipairs { 0.01, 0.1 } do
      for _, degrees in ipairs { 1, 2, 5 } do
        for _, n in ipairs { 8, 11 } do
          local found = calibrate(photo(EI, n, math.rad(degrees), 0, 5e-4))
          assert.is_true(holds(found.EI, EI), ("%g, %g degrees: %g to %g"):format(EI, degrees, found.EI.low,
            found.EI.high))
          local p, told = found.fit.parameters, table.concat(found.remarks, "\n")
          assert.is_true(math.abs(math.deg(p.turn.value + p.tilt.value) - degrees) < 0.8)
          assert.truthy(told:find("their angles, fitted, add up to", 1, true), told)
        end
      end
    end
  end)

  -- Angles of the picture and of the clamp with a deviation of 2 degrees each. 38 of 40 intervals hold the
  -- truth; fewer than 34 have a probability of 3e-3 (binomial).
  it("has intervals that hold the truth, also for tilted clamps", function()
    math.randomseed(12)
    local held = 0
    for _ = 1, 40 do
      local EI = MASS * G * LENGTH ^ 3 / (0.5 * 40 ^ math.random())
      local angle = math.rad(2)
      local points = photo(EI, math.random(5, 14), angle * normal(), angle * normal(), 5e-4)
      if holds(calibrate(points).EI, EI) then held = held + 1 end
    end
    assert.is_true(held >= 34, held)
  end)

  it("has a wider interval than with directions, which count as exact", function()
    math.randomseed(13)
    local points = photo(0.01, 11, 0, 0, 5e-4)
    local function half(found) return 0.5 * (found.EI.high / found.EI.low - 1) end
    local free, level = calibrate(points, { sigma = 5e-4 }),
      calibrate(points, { sigma = 5e-4, directions = { { 1, 0 } } })
    assert.is_true(half(free) > 0.06 and half(free) < 0.08, half(free))
    assert.is_true(half(level) > 0.001 and half(level) < 0.003, half(level))
    assert.is_nil(level.fit.parameters.turn)
    local told = { table.concat(free.remarks, "\n"), table.concat(level.remarks, "\n") }
    assert.truthy(told[1]:find("count as level within 3 degrees each; if both", 1, true), told[1])
    assert.falsy(told[2]:find("level", 1, true))
  end)

  it("counts as level with fewer than four points, and says so", function()
    local found = calibrate(photo(0.01, 3, 0, 0, 0), { sigma = 1e-3 })
    assert.is_nil(found.fit.parameters.turn)
    assert.truthy(found.remarks[1]:find("count as exactly level", 1, true), found.remarks[1])
  end)

  it("is refused if x is mirrored", function()
    local points = photo(0.01, 8, 0, 0, 0)
    for _, p in ipairs(points) do p[1] = -p[1] end
    local fine, why = pcall(calibrate, points)
    assert.is_false(fine)
    assert.truthy(tostring(why):find("the points lie at x < 0 m, behind the clamp, from which the wire "
      .. "points along x; is x mirrored?", 1, true), why)
    local found = calibrate(points, { directions = { { -1, 0 } }, sigma = 5e-4 })
    assert.is_true(holds(found.EI, 0.01))
  end)
end)
