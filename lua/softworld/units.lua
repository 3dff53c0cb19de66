-- SPDX-License-Identifier: GPL-3.0-or-later
--- Units: `units.mm(5)` is 5 mm in metres, `units.to.mm(0.005)` converts back.
-- Arguments are numbers or (nested) tables of numbers: `units.mm{300, 0, 2}`.
-- Everything in SoftWorld is in SI units: m, kg, s, rad, N, Pa.
-- @module softworld.units
local checks = require "softworld.checks"
local place = require "softworld.place"
local vector = require "softworld.vector"

local units = {}
local to = {}

-- name = { SI unit, times, by }: x in the unit is x * times / by in the SI unit.
-- Dividing by a whole number keeps 5 mm exactly the number 0.005.
local known = {
  m = { "m", 1, 1 }, km = { "m", 1000, 1 }, cm = { "m", 1, 100 }, mm = { "m", 1, 1000 },
  um = { "m", 1, 1000000 }, inch = { "m", 254, 10000 },
  mm2 = { "m2", 1, 1000000 }, mm4 = { "m4", 1, 1e12 },
  kg = { "kg", 1, 1 }, g = { "kg", 1, 1000 },
  kg_per_m = { "kg/m", 1, 1 }, g_per_m = { "kg/m", 1, 1000 }, kg_per_km = { "kg/m", 1, 1000 },
  kg_per_m3 = { "kg/m3", 1, 1 }, g_per_cm3 = { "kg/m3", 1000, 1 },
  s = { "s", 1, 1 }, ms = { "s", 1, 1000 }, us = { "s", 1, 1000000 }, min = { "s", 60, 1 },
  h = { "s", 3600, 1 },
  rad = { "rad", 1, 1 }, deg = { "rad", math.pi, 180 }, turns = { "rad", 2 * math.pi, 1 },
  rad_per_s = { "rad/s", 1, 1 }, deg_per_s = { "rad/s", math.pi, 180 },
  rpm = { "rad/s", 2 * math.pi, 60 },
  m_per_s = { "m/s", 1, 1 }, mm_per_s = { "m/s", 1, 1000 }, m_per_min = { "m/s", 1, 60 },
  mm_per_s2 = { "m/s2", 1, 1000 }, gravities = { "m/s2", 980665, 100000 },
  N = { "N", 1, 1 }, kN = { "N", 1000, 1 }, mN = { "N", 1, 1000 },
  Nm = { "N m", 1, 1 }, Nmm = { "N m", 1, 1000 }, Nmm2 = { "N m2", 1, 1000000 },
  N_per_m = { "N/m", 1, 1 }, N_per_mm = { "N/m", 1000, 1 },
  Pa = { "Pa", 1, 1 }, kPa = { "Pa", 1000, 1 }, MPa = { "Pa", 1000000, 1 },
  GPa = { "Pa", 1000000000, 1 }, bar = { "Pa", 100000, 1 },
  J = { "J", 1, 1 }, mJ = { "J", 1, 1000 },
  Hz = { "Hz", 1, 1 }, kHz = { "Hz", 1000, 1 },
}

local DEEPEST = 100 -- deepest nesting of tables

-- Raises an error at the line of the script that calls.
local function fail(...)
  local at = place.of_caller()
  error((at and at .. ": " or "") .. ("units." .. (...)):format(select(2, ...)), 0)
end

local function convert(value, times, by, name, depth)
  if type(value) == "number" then return value * times / by end
  if type(value) ~= "table" then
    fail("%s takes a number or a table of numbers, got %s", name, type(value))
  end
  if depth > DEEPEST then
    fail("%s: the table holds itself, or more than %d tables within each other", name, DEEPEST)
  end
  local out = vector.kind(value) == "vector" and vector.of{} or {}
  for key, item in next, value do out[key] = convert(item, times, by, name, depth + 1) end
  return out
end

local function one(name, ...)
  for k = 1, select("#", ...) do
    local more = select(k, ...)
    if more ~= nil then
      fail("%s takes (value), got %s too, as argument %d; several values are a table: %s{ 1, 2, 3 }", name,
        checks.got(more), k + 1, name)
    end
  end
end

local function conversion(name, times, by)
  return function(value, ...)
    one(name, ...)
    return convert(value, times, by, name, 0)
  end
end

for name, unit in pairs(known) do
  units[name] = conversion(name, unit[2], unit[3])
  to[name] = conversion("to." .. name, unit[3], unit[2])
end

-- Returns the number of edits (insert, delete, replace) that turn a into b.
local function distance(a, b)
  local row = {}
  for j = 0, #b do row[j] = j end
  for i = 1, #a do
    local corner = row[0]
    row[0] = i
    for j = 1, #b do
      local same = a:sub(i, i):lower() == b:sub(j, j):lower()
      local best = math.min(row[j] + 1, row[j - 1] + 1, corner + (same and 0 or 1))
      corner, row[j] = row[j], best
    end
  end
  return row[#b]
end

local function unknown(prefix)
  return function(_, name)
    local names, nearest, least = checks.sorted(known), nil, 3
    for _, other in ipairs(names) do
      local steps = distance(checks.shown(name), other)
      if other:sub(1, 1) ~= checks.shown(name):sub(1, 1) then steps = steps + 0.5 end
      if steps < least and steps < #other then nearest, least = other, steps end
    end
    local hint = nearest and ("did you mean '%s'?"):format(nearest)
      or "known are " .. table.concat(names, " ")
    error(("%s: there is no unit '%s'; %s"):format(prefix, checks.shown(name), hint), 2)
  end
end

--- Returns the SI unit, factor and divisor of a unit by name; nil if it is not known.
function units.find(name)
  local unit = known[name]
  if unit then return unit[1], unit[2], unit[3] end
end

units.to = setmetatable(to, { __index = unknown "units.to" })
return setmetatable(units, { __index = unknown "units" })
