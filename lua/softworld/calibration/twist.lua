-- SPDX-License-Identifier: GPL-3.0-or-later
--- Measurements that determine GJ: the twist at which a straight wire buckles (with its EI), or a torsional
-- pendulum.
-- @module softworld.calibration.twist
local fitdata = require "softworld.study.fitdata"
local readings = require "softworld.calibration.readings"
local rows = require "softworld.rows"
local twisted = require "softworld.calibration.twisted"

local twist = { name = "twist" }

local WHAT = "sw.calibration: twist"
local LEAST, LARGEST = fitdata.LEAST_SIGMA, fitdata.MOST_SIGMA
local MOST = 1e4 -- largest angle at which a wire buckles [rad]

twist.rows = rows.list{
  { "length", "number", "m", "of the straight wire between its ends", min = 0, above = true,
    required = true },
  { "ends", "choice", "-", "clamped in line, or hinged", choices = { "clamped", "hinged" },
    default = "clamped" },
  { "angle", "number", "rad", "angle of one end at which the wire buckles", min = 0, max = MOST,
    above = true },
  { "tension", "number", "N", "tension during the test", default = 0 },
  { "file", "text", "-", "CSV with columns tension [N], angle [deg], instead of angle" },
  { "points", "list of {tension, angle}", "-", "the same as a table [N], [rad]" },
  { "period", "number", "s", "full period of a torsional pendulum; give inertia too", min = 0, above = true },
  { "inertia", "number", "kg m2", "of the pendulum's weight about the wire", min = 0, above = true },
  { "sigma", "number", "-", "standard deviation of the angles [rad], or of the period [s]", min = LEAST,
    max = LARGEST, required = true },
}

local function fail(text, ...) error((WHAT .. ": " .. text):format(...), 0) end

-- Checks which of the three ways was measured.
local function check(o)
  local ways = (o.angle and 1 or 0) + (o.period and 1 or 0) + ((o.file ~= nil or o.points ~= nil) and 1 or 0)
  if ways ~= 1 then
    fail("give one of angle [rad] (it buckles), file or points (at several tensions) and period [s] (a "
      .. "torsional pendulum)")
  end
  if (o.period ~= nil) ~= (o.inertia ~= nil) then
    fail("period and inertia go together: GJ = 4 pi^2 inertia length / period^2")
  end
end

local function pendulum(o)
  return { name = "twist", sigma = o.sigma, unit = "s", values = { o.period }, options = o,
    source = "torsional pendulum",
    predict = function(p) return { twisted.period(o, p.GJ) } end }
end

--- Reads the measurement: returns a group, with needs_EI if GJ is determined together with EI.
function twist.read(o)
  check(o)
  if o.period then return pendulum(o) end
  local list = o.angle and { { o.tension, o.angle } }
    or readings.read(WHAT, o, { { name = "tension", unit = "N" }, { name = "angle", unit = "rad" } }, 1)
  local values = {}
  for k, point in ipairs(list) do
    values[k] = point[2]
    if point[2] <= 0 or point[2] > MOST then
      fail("%s: the angle is %.4g rad; it must be above 0 and up to %g rad", list.where(k), point[2], MOST)
    end
  end
  local group = { name = "twist", sigma = o.sigma, unit = "rad", values = values, points = list, options = o,
    needs_EI = true,
    source = ("twist that buckles it, %d reading%s"):format(#list, #list == 1 and "" or "s") }
  function group.predict(p)
    local angles = {}
    for k, point in ipairs(list) do angles[k] = twisted.angle(o, point[1], p.EI, p.GJ) end
    return angles
  end
  --- Returns the sum of squares of residuals over sigma with an EI, and with a GJ or the best one; math.huge
  -- if a compression buckles the wire.
  function group.sum(EI, GJ)
    local up, down, sum = 0, 0, 0
    for _, point in ipairs(list) do
      local fine, angle = pcall(twisted.angle, o, point[1], EI, 1)
      if not fine then return math.huge end
      up, down, sum = up + angle * angle, down + angle * point[2], sum + point[2] ^ 2
    end
    local x = GJ and 1 / GJ or down / up
    return (sum - 2 * x * down + x * x * up) / o.sigma ^ 2
  end
  --- Returns the GJ of the reading with the largest tension, for an EI.
  function group.GJ(EI)
    local most = list[1]
    for _, point in ipairs(list) do most = point[1] > most[1] and point or most end
    return twisted.angle(o, most[1], EI, 1) / most[2]
  end
  --- Returns the reading with the largest compression, and the EI that just bears it; nil without one.
  function group.compressed()
    local which, most = nil, 0
    for k, point in ipairs(list) do
      if -point[1] > most then which, most = k, -point[1] end
    end
    return which, which and most / twisted.limit(o, 1)
  end
  --- Raises an error: this reading's compression buckles a wire of the EI without a twist; why: which EI.
  function group.refuse(k, EI, why)
    fail("%s: the compression of %.4g N buckles the wire without a twist: it bears %.4g N = %s pi^2 EI / "
      .. "length^2, with EI = %.4g N m2 (%s); leave this reading out, or measure with a tension",
      list.where and list.where(k) or "tension", -list[k][1], twisted.limit(o, EI),
      o.ends == "hinged" and "1" or "4", EI, why)
  end
  return group
end

return twist
