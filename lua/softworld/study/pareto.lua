-- SPDX-License-Identifier: GPL-3.0-or-later
--- Pareto front of two or three results that cannot all be smallest at once: the evaluations of which none is
-- better in all of them.
-- @module softworld.study.pareto
local campaign = require "softworld.study.campaign"
local checks = require "softworld.checks"
local design = require "softworld.study.design"
local judge = require "softworld.study.judge"
local minimum = require "softworld.study.minimum"
local nsga2 = require "softworld.study.search.nsga2"
local counted = require "softworld.output.number".count
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"
local turns = require "softworld.study.turns"

local pareto = {}

local SHOWN = 8 -- rows of a front that print shows

--- Returns the names args[1], args[2] and perhaps args[3], and the rest of args.
function pareto.names(what, args)
  local names, rest = {}, {}
  if type(args) ~= "table" then
    error(("%s: results are wanted, such as %s { 'time', 'peak' }, got %s"):format(what, what,
      checks.got(args)), 0)
  end
  for key, value in pairs(args) do
    if math.type(key) == "integer" then names[key] = value else rest[key] = value end
  end
  if #names < 2 or #names > 3 then
    error(("%s: two or three results are wanted, such as %s { 'time', 'peak' }, got %d"):format(what, what,
      #names), 0)
  end
  for i, name in ipairs(names) do
    if type(name) ~= "string" then
      error(("%s: result %d must be a name, got %s"):format(what, i, checks.got(name)), 0)
    end
    for j = 1, i - 1 do
      if names[j] == name then error(("%s: '%s' is there twice"):format(what, name), 0) end
    end
  end
  return names, rest
end

local function outcome_of(own, names, record)
  if not record.results then return { failed = true } end
  local values = {}
  for k, name in ipairs(names) do values[k] = judge.value(own, name, record) end
  return { values = values, broken = judge.violation(own, record) }
end

-- True if a is not above b in any value.
local function covers(a, b)
  for k, v in ipairs(a) do
    if v > b[k] then return false end
  end
  return true
end

-- Returns the records that meet the constraints and that no other one dominates, by the first result. With
-- two results, the last record of the front so far has the smallest second one.
local function front_of(own, names, records)
  local list, front = {}, {}
  for _, record in ipairs(records) do
    local outcome = outcome_of(own, names, record)
    if not outcome.failed and outcome.broken <= 0 then list[#list + 1] = { record, outcome } end
  end
  table.sort(list, function(a, b)
    for k = 1, #names do
      local va, vb = a[2].values[k], b[2].values[k]
      if va ~= vb then return va < vb end
    end
    if a[1].part ~= b[1].part then return a[1].part < b[1].part end
    return a[1].number < b[1].number
  end)
  for _, one in ipairs(list) do
    local beaten = false
    for k = #front, 1, -1 do -- equal ones count once
      beaten = beaten or covers(front[k][2].values, one[2].values)
      if beaten or #names == 2 then break end
    end
    if not beaten then front[#front + 1] = one end
  end
  return front
end

-- Returns the one farthest from the straight line (or plane) through the ends, relative to the front's
-- extent.
local function knee_of(front)
  local low, high = {}, {}
  for _, one in ipairs(front) do
    for k, v in ipairs(one[2].values) do
      low[k], high[k] = math.min(low[k] or v, v), math.max(high[k] or v, v)
    end
  end
  local knee, least
  for _, one in ipairs(front) do
    local sum = 0
    for k, v in ipairs(one[2].values) do
      if high[k] > low[k] then sum = sum + (v - low[k]) / (high[k] - low[k]) end
    end
    if not least or sum < least then knee, least = one, sum end
  end
  return knee
end

-- --- what was found -----------------------------------------------------------------------------

local Front = { __name = "front" }
local unknown = checks.fields("front", "names rows knee evaluations failed")

function Front.__index(f, key)
  if key == "knee" then return nil end -- of an empty front
  return unknown(f, key)
end

local function line_of(f, row)
  local texts = {}
  for k, name in ipairs(f.names) do texts[k] = ("%s = %.6g"):format(name, row[name]) end
  local event = type(row.events) == "string" and row.events:match "^[^:]*"
  return ("evaluation %d.%d: %s%s"):format(row.part, row.number, table.concat(texts, ", "),
    event and (" (its run had an event: %s)"):format(event) or "")
end

function Front.__tostring(f)
  local lines = { ("front of %s: %d of %s, %d failed"):format(table.concat(f.names, ", "),
    #f.rows, counted(f.evaluations, "evaluation"), f.failed) }
  local every = math.max(1, math.ceil(#f.rows / SHOWN))
  for i = 1, #f.rows do
    if i == #f.rows or (i - 1) % every == 0 then lines[#lines + 1] = "  " .. line_of(f, f.rows[i]) end
  end
  if f.knee then lines[#lines + 1] = "  knee: " .. line_of(f, f.knee) end
  return table.concat(lines, "\n")
end

--- Returns the front of records.
function pareto.of(own, names, records)
  local front, failed, rows, knee = front_of(own, names, records), 0, {}, nil
  for _, record in ipairs(records) do failed = failed + (record.results and 0 or 1) end
  for i, one in ipairs(front) do rows[i] = output.row(own, one[1]) end
  if #front > 0 then
    local best = knee_of(front)[1]
    for i, one in ipairs(front) do
      if one[1] == best then knee = rows[i] end
    end
  end
  return setmetatable({ names = names, rows = rows, knee = knee, evaluations = #records, failed = failed },
    Front)
end

--- Returns the front of everything that the study has.
function pareto.front(own, names)
  local list = output.records(own)
  for _, name in ipairs(names) do output.check_name(own, "study:front", name, list) end
  return pareto.of(own, names, list)
end

-- --- the search ----------------------------------------------------------------------------------

-- Returns the first generation: the parameters' start, then points that fill the ranges.
local function first_of(own, o)
  local places = design.places(#own.parameters, o.population, own.seed)
  return function(k)
    local place = places(k)
    for i, p in ipairs(own.parameters) do
      if k == 1 then place[i] = parameters.start(p) or place[i] end
    end
    return place
  end
end

--- Runs the search; o: evaluations, population, workers.
function pareto.run(own, names, o)
  o.population = o.population or 20 * #names
  o.evaluations = o.evaluations or 40 * o.population
  if o.evaluations < o.population then
    error(("study:pareto: evaluations = %d are fewer than one generation of %d"):format(o.evaluations,
      o.population), 0)
  end
  o.side, o.each = 1, o.evaluations
  local runs = { turns.run(1, nsga2.begin { n = #own.parameters, seed = own.seed, size = o.population,
    first = first_of(own, o) }) }
  local records = campaign.run(own, "pareto " .. table.concat(names, " "), {
    workers = o.workers, population = o.population }, {
    next = function() return turns.next(own, o, runs) end,
    done = function(record)
      for _, name in ipairs(names) do
        if not own.by_name[name] then judge.has(record, name, "study:pareto") end
      end
      turns.hear(runs, o, record.number, outcome_of(own, names, record))
    end })
  judge.some(own, records)
  local list = judge.sorted(records)
  local found = pareto.of(own, names, list)
  if #found.rows == 0 then minimum.never_met(own, list) end
  own.asked[own.part].says = tostring(found)
  return found
end

return pareto
