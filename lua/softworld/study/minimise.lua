-- SPDX-License-Identifier: GPL-3.0-or-later
--- The smallest value of a result: the simplex of Nelder and Mead (GSL) from several starts, side by side.
--
-- The simplex only asks which of two values is the smaller one. So an evaluation that breaks constraints is
-- worse than all that meet them, and the worse the more it breaks; one that failed is the worst of all. The
-- search goes over places from 0 to 1 in each range and is reflected at the ends.
--
-- GSL asks for one value after the other and cannot be left in between. So each start is searched anew with
-- the values that are known, which takes no time beside an evaluation, up to the first that is not: that one
-- is evaluated next. Which ones these are depends on nothing but the values.
-- @module softworld.study.minimise
local campaign = require "softworld.study.campaign"
local checks = require "softworld.checks"
local core = require "softworld.core"
local judge = require "softworld.study.judge"
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"

local minimise = {}

local STEP = 0.2           -- of the first simplex, as a share of each range
local BROKEN, FAILED = 1e200, 1e290
local MOST = 32            -- parameters
local NEAR = 1e-3          -- so near to a bound it is told, as a share of the range

local ASKED = {} -- raised to leave the simplex

local function fold(x)
  x = math.abs(x) % 2
  return x > 1 and 2 - x or x
end

local function values_at(own, x)
  local places = {}
  for i, u in ipairs(x) do places[i] = fold(u) end
  return parameters.all_at(own.parameters, places)
end

-- Where each start begins: at the parameters' start or in the middle, then at points of Halton's sequence.
local function first_places(own, starts)
  local list, n, all = own.parameters, #own.parameters, { {} }
  for i, p in ipairs(list) do
    all[1][i] = p.start and math.max(0, math.min(1, parameters.place(p, p.start))) or 0.5
  end
  local flat = core.quasi("halton", n, starts)
  for k = 2, starts do all[k] = table.move(flat, (k - 1) * n + 1, k * n, 1, {}) end
  return all
end

-- The next place that a start wants to know, or nil and why it has ended.
local function ask(search, o)
  if #search.values >= o.each then return nil, "evaluations used up" end
  local at, steps, x = 0, {}, nil
  for i, u in ipairs(search.start) do steps[i] = u > 0.5 and -STEP or STEP end
  local fine, found = pcall(core.minimise, { start = search.start, step = steps,
    tolerance = o.tolerance / STEP, max_iterations = 1000000, f = function(place)
      at = at + 1
      if search.values[at] then return search.values[at] end
      x = place
      error(ASKED, 0)
    end })
  if fine then return nil, found.reason end
  if found ~= ASKED then error(found, 0) end
  return x
end

-- The value of a result, or of a parameter: the least force at which nothing slips.
local function value_of(own, result, record)
  for i, p in ipairs(own.parameters) do
    if p.name == result then return record.values[i] end
  end
  return record.results[result]
end

-- How bad an evaluation is, as a finite number.
local function badness(own, result, record)
  if not record.results then return FAILED end
  local broken = judge.violation(own, record)
  if broken > 0 then return BROKEN * (1 + math.min(broken, 1e80)) end
  return math.max(-BROKEN, math.min(BROKEN, value_of(own, result, record)))
end

-- Starts take turns: evaluation k of start j has number (k - 1) * starts + j.
local function source_of(own, result, o, searches)
  local function next_of(search)
    if search.waits or search.ended then return nil end
    local x, why = ask(search, o)
    if x then
      search.waits = true
      return #search.values * o.starts + search.number, values_at(own, x)
    end
    search.ended = why
  end
  local function next_one()
    local order = table.move(searches, 1, #searches, 1, {})
    table.sort(order, function(a, b)
      if #a.values == #b.values then return a.number < b.number end
      return #a.values < #b.values
    end)
    for _, search in ipairs(order) do
      local number, values = next_of(search)
      if number then return number, values end
    end
  end
  local function done(record)
    if not own.by_name[result] then judge.has(record, result, "study:minimise") end
    local search = searches[(record.number - 1) % o.starts + 1]
    search.values[#search.values + 1] = badness(own, result, record)
    search.waits = nil
  end
  return { next = next_one, done = done }
end

-- The best of the records, and the one that breaks constraints the least.
local function best_of(own, result, list)
  local best, least_value, nearest, least
  for _, record in ipairs(list) do
    if record.results then
      local broken = judge.violation(own, record)
      if broken <= 0 then
        local value = value_of(own, result, record)
        if not least_value or value < least_value then best, least_value = record, value end
      elseif not least or broken < least then
        nearest, least = record, broken
      end
    end
  end
  return best, nearest
end

-- Which constraints nothing meets, with what came nearest.
local function never_met(own, list, nearest)
  local texts = {}
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
  if #texts == 0 then texts[1] = "each is met by some, but never all together" end
  error(("study '%s': no evaluation meets the constraints (%s); the nearest is evaluation %d with %s"):format(
    own.name, table.concat(texts, "; "), nearest.number, output.values(own, nearest)), 0)
end

local Found = { __name = "minimum" }
Found.__index = checks.fields("minimum", "name best value ok reason evaluations failed at_bound starts")

function Found.__tostring(f)
  local lines = { ("%s = %.6g (%s, %d evaluations, %d failed)"):format(f.name, f.value, f.reason,
    f.evaluations, f.failed) }
  for _, p in ipairs(f.at_bound) do lines[#lines + 1] = ("  %s is at the end of its range"):format(p) end
  return table.concat(lines, "\n")
end

local function at_bound(own, values)
  local names = {}
  for i, p in ipairs(own.parameters) do
    local u = parameters.place(p, values[i])
    if u < NEAR or u > 1 - NEAR then names[#names + 1] = p.name end
  end
  return names
end

local function result_of(own, result, list, searches)
  local best, nearest = best_of(own, result, list)
  if not best then never_met(own, list, nearest) end
  local failed, starts = 0, {}
  for _, record in ipairs(list) do failed = failed + (record.results and 0 or 1) end
  for i, search in ipairs(searches) do
    local least = math.huge
    for _, value in ipairs(search.values) do least = math.min(least, value) end
    starts[i] = { value = least < BROKEN and least or nil, reason = search.ended,
      evaluations = #search.values }
  end
  local won = searches[(best.number - 1) % #searches + 1]
  return setmetatable({ name = result, best = output.row(own, best), value = value_of(own, result, best),
    ok = won.ended == "as near as wanted", reason = won.ended, evaluations = #list, failed = failed,
    at_bound = at_bound(own, best.values), starts = starts }, Found)
end

local function check(own)
  for _, p in ipairs(own.parameters) do
    if p.kind == "choice" then
      error(("study:minimise: the simplex cannot choose '%s' among choices; sweep it, or fix it"):format(
        p.name), 0)
    end
  end
  if #own.parameters > MOST then
    error(("study:minimise: the simplex is for 1 to %d parameters, not %d"):format(MOST, #own.parameters), 0)
  end
end

--- Look for it; o: starts, evaluations, tolerance, workers.
function minimise.run(own, result, o)
  check(own)
  o.evaluations = o.evaluations or 100 * o.starts * #own.parameters
  o.starts = math.min(o.starts, o.evaluations)
  o.each = o.evaluations // o.starts
  local searches = {}
  for k, places in ipairs(first_places(own, o.starts)) do
    searches[k] = { number = k, start = places, values = {} }
  end
  local records = campaign.run(own, "minimise " .. result, o, source_of(own, result, o, searches))
  judge.some(own, records)
  local found = result_of(own, result, judge.sorted(records), searches)
  own.asked[own.part].says = tostring(found)
  return found
end

return minimise
