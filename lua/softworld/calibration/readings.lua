-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads measured points from a table of a script (in SI units) or from a CSV file whose columns name their
-- units:
--
--     x [mm], z [mm]
--     0, 0
--     41.5, -12.0
-- @module softworld.calibration.readings
local checks = require "softworld.checks"
local core = require "softworld.core"
local csv = require "softworld.csv"
local units = require "softworld.units"

local readings = {}

local MOST = 20000 -- most points

local function fail(text, ...) error(text:format(...), 0) end

-- Returns factor and divisor of a unit as people write it: "N/mm", "kg/m3"; nil if it has another dimension.
local function factor_of(text, unit)
  if unit == "px" or text == "px" then return text == unit and 1 or nil, 1 end
  local name = text:gsub("%s", ""):gsub("/", "_per_")
  local found, times, by = units.find(name)
  if found == unit then return times, by end
end

-- Returns the units that a column may have.
local function units_of(unit)
  local usual = { m = "m, mm, cm", N = "N, kN, mN", rad = "rad, deg, turns", s = "s, ms", px = "px" }
  return usual[unit] or unit
end

-- Splits "x [mm]" or "x_mm".
local function split(title)
  local name, unit = title:match "^%s*(.-)%s*%[%s*(.-)%s*%]%s*$"
  if not name then name, unit = title:match "^(%a+)_([%w_]+)$" end
  return name or title, unit
end

-- Returns the column of a name: { values, times, by }; nil if there is none.
local function find(what, data, column)
  for i, title in ipairs(data.names) do
    local name, unit = split(title)
    if name == column.name then
      local place = ("%s, line %d, place %d"):format(data.name, data.header, data.header_places[i])
      if not unit then
        fail("%s: %s: column '%s' does not tell its unit; write '%s [%s]' (of: %s)", what, place, name, name,
          column.unit, units_of(column.unit))
      end
      local times, by = factor_of(unit, column.unit)
      if not times then
        fail("%s: %s: column '%s' is in '%s'; allowed are %s", what, place, name, unit,
          units_of(column.unit))
      end
      return { title = title, values = data.columns[title], times = times, by = by }
    end
  end
end

local function missing(what, data, column)
  local names = {}
  for i, title in ipairs(data.names) do names[i] = split(title) end
  local near = core.nearest(column.name, names)
  fail("%s: %s, line %d: there is no column '%s [%s]'%s; it has: %s", what, data.name, data.header or 1,
    column.name, column.unit, near and (" (did you mean '%s'?)"):format(near) or "",
    table.concat(data.names, ", "))
end

-- Returns all columns of a file as rows in SI units, with the file's lines.
local function from_file(what, path, columns)
  if type(path) ~= "string" or path == "" or path:find "\n" then
    fail("%s: file must be the name of a CSV file, got %s", what, checks.got(path))
  end
  local fine, data = pcall(csv.read, path)
  if not fine then -- only the place in the file; the script's place comes before it
    fail("%s: %s", what, (tostring(data):gsub("^([^\n]-):(%d+):(%d+): ", "%1, line %2, place %3: ")))
  end
  local found, rows = {}, { name = data.name, lines = data.lines }
  for i, column in ipairs(columns) do
    found[i] = find(what, data, column) or missing(what, data, column)
  end
  for k = 1, data.count do
    rows[k] = {}
    for i, c in ipairs(found) do rows[k][i] = c.values[k] * c.times / c.by end
  end
  return rows
end

local function from_table(what, points, columns)
  local names, rows = {}, {}
  for i, column in ipairs(columns) do names[i] = ("%s [%s]"):format(column.name, column.unit) end
  local wanted = "{ " .. table.concat(names, ", ") .. " }"
  if type(points) ~= "table" then
    fail("%s: points must be a list of %s, got %s", what, wanted, checks.got(points))
  end
  checks.only(what .. ": points", points, nil, 0)
  for k = 1, #points do
    rows[k] = {}
    if type(points[k]) == "table" then checks.only(("%s: points[%d]"):format(what, k), points[k], nil, 0) end
    if type(points[k]) == "table" and rawlen(points[k]) > #columns then
      fail("%s: points[%d] must be %s, got %d numbers", what, k, wanted, rawlen(points[k]))
    end
    for i = 1, #columns do
      local value = checks.field(points[k], i)
      if type(value) ~= "number" or value - value ~= 0 then
        fail("%s: points[%d] must be %s, got %s as item %d", what, k, wanted, checks.got(value), i)
      end
      rows[k][i] = value
    end
  end
  return rows
end

--- Returns rows { {value, ...}, ... } of columns { { name =, unit = }, ... } in SI units; given has file or
-- points. least: least number of rows. rows.where(k): the place of row k, for messages.
function readings.read(what, given, columns, least)
  if (given.file ~= nil) == (given.points ~= nil) then
    fail("%s: give either file or points", what)
  end
  local rows = given.file ~= nil and from_file(what, given.file, columns)
    or from_table(what, given.points, columns)
  if #rows < least then
    fail("%s: %s has %d point%s, and at least %d are needed", what, rows.name or "points", #rows,
      #rows == 1 and "" or "s", least)
  end
  if #rows > MOST then fail("%s: %d points are too many; %d are allowed", what, #rows, MOST) end
  function rows.where(k)
    return rows.lines and ("%s, line %d"):format(rows.name, rows.lines[k]) or ("points[%d]"):format(k)
  end
  return rows
end

return readings
