-- SPDX-License-Identifier: GPL-3.0-or-later
--- Displacement over force as a straight line: a pull gives EA, a squeeze between plates the section's
-- stiffness. The line's zero is not known, so it is fitted too.
-- @module softworld.calibration.slope
local fitdata = require "softworld.study.fitdata"
local readings = require "softworld.calibration.readings"
local rows = require "softworld.rows"

local slope = {}

local LEAST, MOST = fitdata.LEAST_SIGMA, fitdata.MOST_SIGMA

local function options(way, length)
  return rows.list{
    { "file", "text", "-", ("CSV with columns force [N], %s [mm]"):format(way) },
    { "points", ("list of {force, %s}"):format(way), "-", "the same as a table [N], [m]" },
    { "length", "number", "m", length, min = 0, above = true, required = true },
    { "sigma", "number", "m", ("standard deviation of the %s"):format(way), min = LEAST, max = MOST,
      usual = "estimated" },
  }
end

slope.kinds = {
  pull = { name = "pull", stiffness = "EA", way = "elongation", words = "pull test",
    rows = options("elongation", "over which the elongation is measured") },
  squeeze = { name = "plates", stiffness = "squeeze", way = "approach", words = "squeeze between plates",
    rows = options("approach", "of wire between the plates") },
}

-- Returns the displacement at a force: pull F L / EA, plates F / (L K) with K the line force over the
-- approach [Pa].
local function way(kind, o, force, stiffness)
  if kind.stiffness == "EA" then return force * o.length / stiffness end
  return force / (o.length * stiffness)
end

-- Returns the regression line, for ranges and starts: displacement per force, and at zero force.
local function regression(list)
  local n, mf, mw, ff, fw = #list, 0, 0, 0, 0
  for _, p in ipairs(list) do mf, mw = mf + p[1] / n, mw + p[2] / n end
  for _, p in ipairs(list) do
    ff, fw = ff + (p[1] - mf) ^ 2, fw + (p[1] - mf) * (p[2] - mw)
  end
  return ff > 0 and fw / ff or 0, mw - (ff > 0 and fw / ff or 0) * mf
end

--- Reads the points: returns a group with the ranges of its two parameters.
function slope.read(kind_name, o)
  local kind = slope.kinds[kind_name]
  local what = "sw.calibration: " .. kind_name
  local list = readings.read(what, o, { { name = "force", unit = "N" }, { name = kind.way, unit = "m" } }, 3)
  local give, first = regression(list)
  if give <= 0 then
    local shape = "%s: the %s does not grow with the force; are the columns in order, and pulls positive?"
    error(shape:format(what, kind.way), 0)
  end
  local values, span = {}, 0
  for k, p in ipairs(list) do
    values[k] = p[2]
    span = math.max(span, math.abs(p[2] - list[1][2]))
  end
  local middle = kind.stiffness == "EA" and o.length / give or 1 / (o.length * give)
  return { name = kind.name, sigma = o.sigma, unit = "m", values = values, points = list, options = o,
    kind = kind, stiffness = kind.stiffness, offset = kind.name .. "_offset",
    source = ("%s of %d points"):format(kind.words, #list),
    range = { middle / 100, middle * 100 }, offset_range = { first - span, first + span },
    predict = function(p)
      local ways = {}
      for k, point in ipairs(list) do
        ways[k] = way(kind, o, point[1], p[kind.stiffness]) + p[kind.name .. "_offset"]
      end
      return ways
    end }
end

return slope
