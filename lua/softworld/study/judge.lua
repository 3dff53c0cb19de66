-- SPDX-License-Identifier: GPL-3.0-or-later
--- Decides whether an evaluation meets the constraints, and by how much.
-- @module softworld.study.judge
local checks = require "softworld.checks"
local core = require "softworld.core"
local counted = require "softworld.output.number".count
local parameters = require "softworld.study.parameters"

local judge = {}

local function fail(text, ...) error(text:format(...), 0) end

--- Returns constraints { name = { min =, max =, unit = } } as a list in the order of names.
function judge.read(given, by_name)
  local list = {}
  for i, name in ipairs(checks.sorted(given or {}, checks.by_text)) do
    parameters.check_name("sw.study: constraint", name)
    local what, c = ("sw.study: constraint '%s'"):format(name), given[name]
    checks.keys(what, c, { min = true, max = true, unit = true }, 0)
    if by_name[name] then
      fail("%s is a limit of a parameter; use its range for that, constraints are for results", what)
    end
    parameters.check_unit(what, c.unit)
    for _, key in ipairs { "min", "max" } do
      if c[key] ~= nil then checks.number(what .. ": " .. key, c[key], -math.huge, "", 0) end
    end
    if c.min == nil and c.max == nil then fail("%s has neither min nor max", what) end
    if c.min and c.max and c.min > c.max then
      fail("%s: min = %.9g is above max = %.9g", what, c.min, c.max)
    end
    list[i] = { name = name, min = c.min, max = c.max, unit = c.unit }
  end
  return list
end

--- Raises an error unless there are constraints.
function judge.needed(own, what)
  if #own.constraints == 0 then fail("%s: study '%s' has no constraints to be met", what, own.name) end
end

local function scale(limit) return limit ~= 0 and math.abs(limit) or 1 end

--- Returns by how much a constraint is broken, over its limit; below 0 it is met.
function judge.excess(c, value)
  local above = c.max and (value - c.max) / scale(c.max) or -math.huge
  local below = c.min and (c.min - value) / scale(c.min) or -math.huge
  return math.max(above, below)
end

--- Returns the sum of excesses above 0, which is 0 if all constraints are met, and the largest excess.
function judge.violation(own, record)
  local sum, most = 0, -math.huge
  for _, c in ipairs(own.constraints) do
    local excess = judge.excess(c, record.results[c.name])
    sum, most = sum + math.max(0, excess), math.max(most, excess)
  end
  return sum, most
end

--- Returns by how much each limit is broken, below 0 if it is kept; a max and a min are a limit each.
function judge.sides(own, record)
  local list = {}
  for _, c in ipairs(own.constraints) do
    local value = record.results[c.name]
    if c.max then list[#list + 1] = (value - c.max) / scale(c.max) end
    if c.min then list[#list + 1] = (c.min - value) / scale(c.min) end
  end
  return list
end

--- Returns the number of limits.
function judge.count_sides(own)
  local count = 0
  for _, c in ipairs(own.constraints) do count = count + (c.max and 1 or 0) + (c.min and 1 or 0) end
  return count
end

--- Returns the name of the first constraint that some results break, or nil; results: those known so far.
function judge.broken(own, results)
  if type(results) ~= "table" then
    fail("p.broken takes results, such as p.broken { peak = 12 }, got %s", checks.got(results))
  end
  local known = {}
  for _, c in ipairs(own.constraints) do known[c.name] = true end
  checks.keys("p.broken: constraints", results, known, 0)
  for _, c in ipairs(own.constraints) do
    local value = results[c.name]
    if value ~= nil then checks.number("p.broken: " .. c.name, value, -math.huge, "", 0) end
    if value and judge.excess(c, value) > 0 then return c.name end
  end
end

--- Returns the value of a result or of a parameter; for choices the number of the choice.
function judge.value(own, name, record)
  for i, p in ipairs(own.parameters) do
    if p.name == name then return record.values[i] end
  end
  return record.results[name]
end

--- Returns whether an evaluation meets all constraints; nil if it failed.
function judge.pass(own, record)
  if not record.results then return nil end
  return judge.violation(own, record) <= 0
end

--- Marks an evaluation as failed if it lacks a wanted result; in the first evaluation this is an
-- error.
function judge.has(record, name, who)
  local results = record.results
  if not results or results[name] then return end
  local names = checks.sorted(results)
  if record.number == 1 then
    local near = core.nearest(name, names)
    fail("%s: evaluate returns no '%s'; %s", who, name, near and ("did you mean '%s'?"):format(near)
      or "it returns: " .. table.concat(names, " "))
  end
  record.results = nil
  record.failed = ("evaluate returned no '%s', only: %s"):format(name, table.concat(names, " "))
end

--- Same for the results of all constraints.
function judge.complete(own, record)
  for _, c in ipairs(own.constraints) do
    judge.has(record, c.name, ("study '%s': constraints"):format(own.name))
  end
end

local function sorted(records)
  local list = {}
  for _, record in pairs(records) do list[#list + 1] = record end
  table.sort(list, function(a, b) return a.number < b.number end)
  return list
end
judge.sorted = sorted

--- The first success defines the results; marks evaluations with other results as failed.
function judge.alike(records)
  local names, first
  for _, record in ipairs(sorted(records)) do
    if record.results then
      local own = table.concat(checks.sorted(record.results), " ")
      names, first = names or own, first or record.number
      if own ~= names then
        record.results = nil
        record.failed = ("evaluate returned %s, and %s before (evaluation %d)"):format(own, names, first)
      end
    end
  end
end

--- Raises an error if no evaluation of a part succeeded.
function judge.some(own, records)
  judge.alike(records)
  local list = sorted(records)
  for _, record in ipairs(list) do
    if record.results then return end
  end
  if #list == 0 then return end
  fail("study '%s': none of %s succeeded; the first: %s", own.name, counted(#list, "evaluation"),
    list[1].failed)
end

return judge
