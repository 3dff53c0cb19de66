-- SPDX-License-Identifier: GPL-3.0-or-later
--- The script's own checks: checks = { { name =, unit =, of = function(run), max =, min = } }.
-- @module softworld.check.own
local checks = require "softworld.checks"
local limits = require "softworld.check.limits"
local reading = require "softworld.run.reading"
local rows = require "softworld.rows"

local own = {}

own.rows = rows.list{
  { "name", "text", "-", "of its row", required = true },
  { "unit", "text", "-", "of its value, '-' for none", required = true },
  { "of", "function", "-", "function(run) that returns the value, and optionally place [m] and time [s]",
    required = true },
  { "max", "number", "its own", "the value must not be above it" },
  { "min", "number", "its own", "the value must not be below it" },
  { "source", "text", "-", "source of the limit", usual = "the script" },
  { "doubted", "boolean", "-", "false: no event of the run doubts the value", usual = "true" },
  { "sure", "boolean", "-", "true: accept the limit, however far it is from the value", usual = "false" },
}

local function check_list(given)
  if checks.kind(given) ~= "table" then
    error("run:check: checks must be a list of tables { name =, unit =, of =, max = }, got "
      .. checks.got(given), 0)
  end
  for key in pairs(given) do
    if math.type(key) ~= "integer" or key < 1 then
      error(("run:check: checks must be a list of tables, without the key '%s'"):format(checks.shown(key)), 0)
    end
  end
  rows.whole("run:check: checks", given)
end

-- Limits have the unit that the check itself names, which its row cannot know.
local function check_limits(one, what)
  local unit = checks.field(one, "unit")
  unit = type(unit) == "string" and unit ~= "-" and " " .. unit or ""
  for _, side in ipairs{ "min", "max" } do
    local value = checks.field(one, side)
    if type(value) == "number" then checks.number(what .. ": " .. side, value, -math.huge, unit, 0) end
  end
end

--- Returns their checked list. taken: names of other checks.
function own.read(given, taken)
  local list, seen = {}, {}
  if given == nil then return list end
  check_list(given)
  for i, one in ipairs(given) do
    local what = ("run:check: checks[%d]"):format(i)
    check_limits(one, what)
    list[i] = own.rows:read(one, what)
    if seen[list[i].name] or taken[list[i].name] then
      error(("%s: there is another check '%s'"):format(what, list[i].name), 0)
    end
    seen[list[i].name] = true
    limits.consistent(("%s, '%s'"):format(what, list[i].name), list[i])
  end
  return list
end

-- Returns a finite number, or nil.
local function finite(x) return x and x - x == 0 and x or nil end

-- Returns why the second and third value are not a place and a time, or nil.
local function misplaced(s, time)
  if s ~= nil and type(s) ~= "number" then
    return "its function must return a place along the wire [m] as its second value, or nil, got "
      .. checks.got(s)
  end
  if time ~= nil and type(time) ~= "number" then
    return "its function must return a time [s] as its third value, or nil, got " .. checks.got(time)
  end
end

--- Returns the value, or nil and why there is none.
function own.value(one, run, scene)
  local _, fine, value, s, time = reading.call(scene, ("the check '%s'"):format(one.name),
    "read the run that is passed to it: of = function(run)", one.of, run)
  if not fine then
    if checks.is_interrupt(value) then error(value, 0) end
    return nil, "its function raised: " .. checks.shown(value)
  end
  if type(value) ~= "number" then
    return nil, "its function must return a number, got " .. checks.got(value)
  end
  local why = misplaced(s, time)
  if why then return nil, why end
  local doubt = value == -math.huge and "the value is -inf, as the largest of no values is" or nil
  return { value = value, s = finite(s), time = finite(time), doubt = doubt }
end

return own
