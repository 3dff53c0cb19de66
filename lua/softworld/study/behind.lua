-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows behind parameters of a study: { 0.1, 1, of = "obstacle.friction" } takes the row's unit and checks
-- its range against the row; { of = "obstacle.friction" } also takes the row's range.
-- @module softworld.study.behind
local checks = require "softworld.checks"
local core = require "softworld.core"

local behind = {}

local WIDEST = 1e3 -- largest end of a range that is taken; larger ones only limit what can be computed
local FAMILIES = { "holds", "shapes", "forces" }

local function fail(text, ...) error(text:format(...), 0) end

-- Returns all tables of rows by the name of their call or object.
local function groups()
  local r, list = core.registry(), {}
  for name, rows in pairs(r.params) do list[name] = rows end
  local wire = table.move(list.wire, 1, #list.wire, 1, {}) -- with its section
  list.wire = table.move(list.section, 1, #list.section, #wire + 1, wire)
  for _, family in ipairs(FAMILIES) do
    for _, entry in ipairs(r[family]) do list[entry.name] = list[entry.name] or entry.params end
  end
  return list
end

local function told(names, name)
  table.sort(names)
  local near = core.nearest(name, names)
  return near and (" did you mean '%s'?"):format(near) or " known are: " .. table.concat(names, " ")
end

local function row_of(what, of)
  local group, name = (type(of) == "string" and of or ""):match "^([%w_]+)%.([%w_]+)$"
  if not group then
    fail("%s: of = %s; it must be the name of a row, such as 'obstacle.friction'", what, checks.got(of))
  end
  local list, names, found = groups(), {}, nil
  if not list[group] then
    for known in pairs(list) do names[#names + 1] = known end
    fail("%s: of: nothing takes '%s';%s", what, of, told(names, group))
  end
  for _, row in ipairs(list[group]) do
    names[#names + 1] = row.name
    if row.name == name then found = row end
  end
  if not found then fail("%s: of: '%s' has no '%s';%s", what, group, name, told(names, name)) end
  if found.type ~= "number" and found.type ~= "integer" then
    fail("%s: of: '%s' is a %s; only numbers have a range", what, of, found.type)
  end
  return found
end

local function range(row)
  return ("%s%.6g, %.6g%s %s"):format(row.above and "(" or "[", row.min or -math.huge, row.max or math.huge,
    row.below and ")" or "]", row.unit)
end

local function is_inside(row, value)
  if type(value) ~= "number" then return true end -- reported elsewhere
  if row.min and (value < row.min or row.above and value == row.min) then return false end
  return not (row.max and (value > row.max or row.below and value == row.max))
end

local function has_ends(row)
  for _, key in ipairs { "min", "max" } do
    if not row[key] or math.abs(row[key]) > WIDEST then return false end
  end
  return not (row.above or row.below)
end

--- Returns a copy of a parameter with the data of its row; a parameter without `of` is returned itself.
function behind.read(what, given)
  if given.of == nil then return given end
  local row, copy = row_of(what, given.of), {}
  for key, value in pairs(given) do copy[key] = value end
  if copy.choices then fail("%s: choices go without of", what) end
  if copy.unit ~= nil and copy.unit ~= row.unit then
    fail("%s: unit = %s, and %s is in %s", what, checks.got(copy.unit), given.of, row.unit)
  end
  if copy[1] == nil and copy[2] == nil then
    if not has_ends(row) then
      fail("%s: %s may be in %s, which is not a range to search in; give { lowest, highest, of = '%s' }",
        what,
        given.of, range(row), given.of)
    end
    copy[1], copy[2] = row.min, row.max
  end
  for i = 1, 2 do
    if not is_inside(row, copy[i]) then
      fail("%s: %s is not allowed; %s is in %s", what, checks.got(copy[i]), given.of, range(row))
    end
  end
  copy.unit, copy.of = row.unit, nil
  if row.type == "integer" then copy.integer = true end
  return copy
end

return behind
