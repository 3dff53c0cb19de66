-- SPDX-License-Identifier: GPL-3.0-or-later
--- Error bars of the rows of a check: scene:run{ check = {...} } computes the run level by level until edges
-- and steps decide every row.
-- @module softworld.check.bars
local check = require "softworld.check.check"
local checks = require "softworld.checks"
local inherited = require "softworld.inherited"
local registry = require "softworld.check.registry"

local bars = {}

local NONE = 0 / 0 -- value of a row with nothing to measure

-- Returns how far a row's value may be off without changing the verdict, in its unit; infinite if no verdict
-- depends on it, because no limit is known or the data leave it open.
local function room(row)
  if not row.side then return math.huge end
  local low, high = row.low or row.value, row.high or row.value
  local least, most = row.limit_low or row.limit, row.limit_high or row.limit
  local kept, broken = least - high, low - most
  if row.side == "min" then kept, broken = low - most, least - high end
  local share = math.max(kept, broken)
  return share >= 0 and share or math.huge
end

-- Returns rows by name, those with two limits as one, and the names in order.
local function gather(rows)
  local found, names = {}, {}
  for _, row in ipairs(rows) do
    local one = found[row.name]
    if type(row.value) == "number" and not one then
      found[row.name] = { value = row.value, where = row.s, when = row.time, unit = row.unit,
        room = room(row) }
      names[#names + 1] = row.name
    elseif one then
      one.room = math.min(one.room, room(row))
    end
  end
  return found, names
end

-- Adds a row that did not exist on earlier levels.
local function add(job, name, unit)
  local values = {}
  for k = 1, job.known or 0 do values[k] = NONE end
  local member = registry.by_name[name]
  local q = { name = name, unit = unit == "-" and "" or unit, row = true, plain = true,
    vanishes = member and member.vanishes }
  job.values[name], job.quantities[#job.quantities + 1] = values, q
  return q
end

-- True if the script asks for data that only wear = true records.
local function wears(args)
  if args.fatigue or args.abrasion then return true end
  for name in pairs(type(args.limits) == "table" and args.limits or {}) do
    local word = type(name) == "string" and name:match "[^.]*$"
    if word == "friction_work" or word == "wear_depth" or word == "fatigue" then return true end
  end
  return false
end

--- Takes check out of the arguments of a run and checks it. Sets job.rows(result), to be called with each
-- level's run, which reads values and tolerances of the rows.
function bars.take(job, args)
  local given = args.check
  args.check = nil
  if checks.kind(given) ~= "table" then
    error("scene:run: check must be a table of what run:check takes, such as { use = 'movement' }, got "
      .. checks.got(given), 0)
  end
  job.check = inherited.copy(given)
  check.early(job.scene, job.check)
  if args.wear == nil and wears(job.check) then args.wear = true end
  local taken, rows = {}, {}
  for _, q in ipairs(job.quantities) do taken[q.name] = true end
  function job.rows(result)
    local found, names = gather(check.rows(result, job.check))
    for _, name in ipairs(names) do
      if not taken[name] then
        taken[name] = true
        rows[#rows + 1] = add(job, name, found[name].unit)
      end
    end
    for _, q in ipairs(rows) do
      q.sample = found[q.name] or { value = NONE }
      q.tolerance = q.sample.room or math.huge
    end
  end
end

return bars
