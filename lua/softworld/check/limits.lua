-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads the limits that a script gives: limits = { max_tension = 80, ["left.peak_force"] = { max = 20,
-- source = "sheet" }, max_strain = false }. A number is a limit on the check's own side.
-- @module softworld.check.limits
local core = require "softworld.core"
local checks = require "softworld.checks"
local inherited = require "softworld.inherited"
local registry = require "softworld.check.registry"
local rows = require "softworld.rows"

local limits = {}

limits.rows = rows.list{
  { "max", "number", "its own", "the value must not be above it" },
  { "min", "number", "its own", "the value must not be below it" },
  { "source", "text", "-", "source of the limit", usual = "the script" },
  { "sure", "boolean", "-", "true: accept the limit, however unusual it is", usual = "false" },
}

-- Returns every name that a limit may have, those without an object first.
local function names_of(context)
  local names, known = {}, {}
  for _, member in ipairs(registry.list) do names[#names + 1] = member.name end
  for _, member in ipairs(registry.list) do
    for _, entry in ipairs(member.on ~= "run" and context.objects[member.on] or {}) do
      names[#names + 1] = entry.name .. "." .. member.name
    end
  end
  for _, name in ipairs(names) do known[name] = true end
  return names, known
end

--- Returns the set of all names of checks, those of objects too.
function limits.names(context)
  local _, known = names_of(context)
  return known
end

-- Returns true if all words of one text are words of the other: tension and max_tension.
local function shares(a, b)
  local function holds(outer, inner)
    local words = {}
    for word in outer:lower():gmatch "%a+" do words[word] = true end
    local all = false
    for word in inner:lower():gmatch "%a+" do
      if not words[word] then return false end
      all = true
    end
    return all
  end
  return holds(a, b) or holds(b, a)
end

-- Returns a phrase of the names that an unknown one may mean: one that differs by a typing error, else those
-- with the same words; nil if there are none.
local function meant(name, names, known)
  local near = core.nearest(name, names)
  if near then return ("did you mean '%s'?"):format(near) end
  local object, word = name:match "^(.*%.)(.-)$"
  local found = {}
  for _, member in ipairs(registry.list) do
    local full = (object or "") .. member.name
    if known[full] and shares(member.name, word or name) then found[#found + 1] = "'" .. full .. "'" end
  end
  local last = table.remove(found)
  if not last then return nil end
  return ("did you mean %s?"):format(#found > 0 and table.concat(found, ", ") .. " or " .. last or last)
end

local function finite(what, value)
  if value - value ~= 0 then
    error(("%s = %s is not allowed; it must be a finite number"):format(what, checks.got(value)), 0)
  end
end

--- Raises an error if a table of min and max contradicts itself, or a limit is not a finite number.
function limits.consistent(what, given)
  for _, side in ipairs{ "min", "max" } do
    if given[side] then finite(("%s: %s"):format(what, side), given[side]) end
  end
  if given.min and given.max and given.min > given.max then
    error(("%s: min = %g is above max = %g, so no value can pass"):format(what, given.min, given.max), 0)
  end
end

local function read(name, given)
  local what = ("run:check: limits['%s']"):format(name)
  if given == false then return false end
  if type(given) == "number" then
    finite(what, given)
    return { value = given }
  end
  if type(given) ~= "table" then
    error(("%s must be a number, false (to leave the check out) or { max =, min =, source =, sure = }, got "
      .. "%s")
      :format(what, checks.got(given)), 0)
  end
  local own = limits.rows:read(given, what)
  if not (own.max or own.min) then error(what .. ": neither max nor min is given", 0) end
  limits.consistent(what, own)
  return own
end

--- Returns the checked table: name -> false or { value = } or { max =, min =, source =, sure = }.
function limits.read(given, context)
  if given == nil then return {} end
  if checks.kind(given) ~= "table" then
    error("run:check: limits must be a table such as { max_tension = 80 }, got " .. checks.got(given), 0)
  end
  local names, known = names_of(context)
  local list = {}
  for name, value in pairs(inherited.flat(given)) do
    if not known[name] then
      error(("run:check: limits: there is no check '%s'; %s"):format(checks.shown(name),
        type(name) == "string" and meant(name, names, known) or "known are: " .. table.concat(names, " ")), 0)
    end
    list[name] = read(name, value)
  end
  return list
end

--- Returns the limits of one check of one object, by side: { max = { value, from, source, sure }, min = };
-- false if the check is left out; nil if the script gives none.
function limits.of(list, member, entry)
  local given = entry.name and list[entry.name .. "." .. member.name]
  if given == nil then given = list[member.name] end
  if not given then return given end
  local found = {}
  local function add(side, value)
    if value then
      found[side] = { value = value, from = "user", source = given.source or "the script", sure = given.sure }
    end
  end
  add("max", given.max)
  add("min", given.min)
  add(member.side, given.value)
  return found
end

--- True if two tables of arguments have the same fields. A run keeps a copy of the check that is given to it.
function limits.alike(a, b)
  if not (a and b) then return false end
  for key, value in pairs(a) do
    if not rawequal(b[key], value) then return false end
  end
  for key in pairs(b) do
    if a[key] == nil then return false end
  end
  return true
end

return limits
