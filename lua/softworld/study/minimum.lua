-- SPDX-License-Identifier: GPL-3.0-or-later
--- The result of a search, and how certain it is.
-- @module softworld.study.minimum
local checks = require "softworld.checks"
local judge = require "softworld.study.judge"
local counted = require "softworld.output.number".count
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"

local minimum = {}

local NEAR = 1e-3    -- relative distance from a bound or limit below which it is reported
local REASONS = 3    -- most reasons of failures shown
local SMALL = 0.1    -- parts of a direction below this are not shown

--- Returns the best record, and the one that breaks constraints the least. Of equal values the first by
-- number counts, in whatever order they came.
function minimum.best(own, result, list)
  local best, least_value, nearest, least
  for _, record in ipairs(list) do
    if record.results then
      local broken, number = judge.violation(own, record), record.number
      local value = broken <= 0 and judge.value(own, result, record)
      if value then
        if not best or value < least_value or value == least_value and number < best.number then
          best, least_value = record, value
        end
      elseif not least or broken < least or broken == least and number < nearest.number then
        nearest, least = record, broken
      end
    end
  end
  return best, nearest
end

--- Raises an error with the constraints that nothing meets, and what came nearest.
function minimum.never_met(own, list)
  local texts, _, nearest = {}, minimum.best(own, own.parameters[1].name, list)
  for _, c in ipairs(own.constraints) do
    local value, least
    for _, record in ipairs(list) do
      local excess = record.results and judge.excess(c, record.results[c.name])
      if excess and (not least or excess < least) then value, least = record.results[c.name], excess end
    end
    if least > 0 then
      texts[#texts + 1] = ("%s is %.6g at best, allowed is %s %.6g"):format(c.name, value,
        c.max and value > c.max and "at most" or "at least", c.max and value > c.max and c.max or c.min)
    end
  end
  if #texts == 0 then texts[1] = "each constraint is met by some evaluation, but never all together" end
  error(("study '%s': no evaluation meets the constraints (%s); the nearest is evaluation %d with %s"):format(
    own.name, table.concat(texts, "; "), nearest.number, output.values(own, nearest)), 0)
end

-- --- failures --------------------------------------------------------------------------------------

local function widen(own, box, record)
  for i, p in ipairs(own.parameters) do
    if p.kind ~= "choice" then
      local v, b = record.values[i], box[p.name]
      box[p.name] = b and { math.min(b[1], v), math.max(b[2], v) } or { v, v }
    end
  end
end

-- Returns reasons with count, first number and place: { reason =, count =, first =, where = { name = { low,
-- high } } }, the most common first.
local function failures_of(own, list)
  local all, by = {}, {}
  for _, record in ipairs(list) do
    local why = record.failed
    if why then
      if not by[why] then
        by[why] = { reason = why, count = 0, first = record.number, where = {} }
        all[#all + 1] = by[why]
      end
      by[why].count = by[why].count + 1
      widen(own, by[why].where, record)
    end
  end
  table.sort(all, function(a, b)
    if a.count == b.count then return a.first < b.first end
    return a.count > b.count
  end)
  return all
end

local function add_failures(lines, f)
  for k = 1, math.min(REASONS, #f.failures) do
    local why, places = f.failures[k], {}
    for _, name in ipairs(f.order) do
      local box = why.where[name]
      if box then places[#places + 1] = ("%s %.4g to %.4g"):format(name, box[1], box[2]) end
    end
    lines[#lines + 1] = ("  %d failed, the first %d (%s): %s"):format(why.count, why.first,
      table.concat(places, ", "), why.reason)
  end
end

-- --- the text ----------------------------------------------------------------------------------------

local Found = { __name = "minimum" }
local unknown = checks.fields("minimum", "name best value error ok reason method why evaluations failed "
  .. "failures at_bound at_limit room noise flat starts")
local MAY_LACK = checks.set "error why noise flat unchecked"

function Found.__index(f, key)
  if not MAY_LACK[key] then return unknown(f, key) end
end

local function add_noise(lines, f)
  local n = f.noise
  if not n then return end
  if not n.checked then lines[#lines + 1] = "  noise: not checked, because " .. f.unchecked end
  if n.mean and n.deviation ~= 0 then
    lines[#lines + 1] = ("  noisy: the mean of %s there is %.6g%s"):format(
      counted(n.repeats - n.failed, "more evaluation"), n.mean,
      n.error and (" +- %.2g"):format(n.error) or "")
  end
  if n.failed + n.broken > 0 then
    lines[#lines + 1] = ("  of %s there %d failed and %d break constraints"):format(
      counted(n.repeats, "more evaluation"), n.failed, n.broken)
  end
end

local function direction_text(f, direction)
  local parts = {}
  for _, name in ipairs(f.order) do
    local share = direction[name]
    if share and math.abs(share) >= SMALL then parts[#parts + 1] = ("%+.2f %s"):format(share, name) end
  end
  return table.concat(parts, " ")
end

local function add_flat(lines, f)
  for _, direction in ipairs(f.flat or {}) do
    local only = next(direction)
    lines[#lines + 1] = next(direction, only) == nil and ("  %s has no influence near it"):format(only)
      or ("  flat along %s (shares of the ranges): the result hardly changes in this direction"):format(
        direction_text(f, direction))
  end
end

-- Returns where it is: "speed = 0.2, kind = 'rod'".
local function place_text(f)
  local parts = {}
  for i, name in ipairs(f.order) do
    local value = f.best[name]
    parts[i] = ("%s = %s"):format(name, type(value) == "number" and ("%.6g"):format(value)
      or ("'%s'"):format(tostring(value)))
  end
  return table.concat(parts, ", ")
end

function Found.__tostring(f)
  local lines = { ("%s = %.6g%s at %s (%s: %s, %s, %d failed)"):format(f.name, f.value,
    f.error and (" +- %.2g"):format(f.error) or "", place_text(f), f.method, f.reason,
    counted(f.evaluations, "evaluation"), f.failed) }
  add_noise(lines, f)
  if type(f.best.events) == "string" then
    lines[#lines + 1] = "  its run had an event: " .. f.best.events
  end
  if #f.at_bound > 0 then
    lines[#lines + 1] = ("  at the end of the range: %s"):format(table.concat(f.at_bound, ", "))
  end
  if #f.at_limit > 0 then
    lines[#lines + 1] = ("  at the limit: %s"):format(table.concat(f.at_limit, ", "))
  end
  add_flat(lines, f)
  add_failures(lines, f)
  return table.concat(lines, "\n")
end

-- --- making it ----------------------------------------------------------------------------------------

-- Returns the parameters at an end of their range, and the distances of all to their ends.
local function bounds_of(own, values)
  local at_bound, room = {}, {}
  for i, p in ipairs(own.parameters) do
    if p.kind ~= "choice" then
      local u = parameters.place(p, values[i])
      if u < NEAR or u > 1 - NEAR then at_bound[#at_bound + 1] = p.name end
      room[p.name] = { below = values[i] - p.low, above = p.high - values[i] }
    end
  end
  return at_bound, room
end

local function at_limit(own, record)
  local names = {}
  for _, c in ipairs(own.constraints) do
    if judge.excess(c, record.results[c.name]) > -NEAR then names[#names + 1] = c.name end
  end
  return names
end

local function starts_of(runs)
  local starts = {}
  for i, run in ipairs(runs) do
    starts[i] = { value = run.least < math.huge and run.least or nil, reason = run.ended, ok = run.ok,
      evaluations = run.told }
  end
  return starts
end

-- Returns the start that found the best.
local function winner(runs)
  local won = runs[1]
  for _, run in ipairs(runs) do
    if run.least < won.least then won = run end
  end
  return won
end

--- Returns the minimum in a list of records sorted by number.
function minimum.of(own, result, list, runs, o)
  local best = minimum.best(own, result, list)
  if not best then minimum.never_met(own, list) end
  local noise = o.found and o.found:noise()
  local repeated = o.found and o.found.center and o.found:record()
  best = repeated or best
  local won, failed, order = winner(runs), 0, {}
  for _, record in ipairs(list) do failed = failed + (record.results and 0 or 1) end
  for i, p in ipairs(own.parameters) do order[i] = p.name end
  local at_bound, room = bounds_of(own, best.values)
  local value = repeated and noise.mean or judge.value(own, result, best)
  local f = { name = result, best = output.row(own, best), value = value,
    error = repeated and noise.error or best.results[result .. "_error"],
    ok = won.ok, reason = won.ended, method = o.method, why = o.why, evaluations = #list, failed = failed,
    failures = failures_of(own, list), at_bound = at_bound, at_limit = at_limit(own, best), room = room,
    starts = starts_of(runs), order = order }
  if o.found then f.noise, f.flat = noise, o.found:flat() end
  f.unchecked = o.around and "no evaluation was left for it" or "around = false"
  return setmetatable(f, Found)
end

return minimum
