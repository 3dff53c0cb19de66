-- SPDX-License-Identifier: GPL-3.0-or-later
--- Finds the smallest value of a result by one of the methods of study/search.
--
-- A method is asked for places and gets the results; its starts take turns (study/turns). When all starts
-- have ended, the surroundings of the best place are evaluated too (study/around).
-- @module softworld.study.minimise
local around = require "softworld.study.around"
local campaign = require "softworld.study.campaign"
local core = require "softworld.core"
local design = require "softworld.study.design"
local judge = require "softworld.study.judge"
local minimum = require "softworld.study.minimum"
local search = require "softworld.study.search"
local turns = require "softworld.study.turns"

local minimise = {}

local function fail(text, ...) error("study:minimise: " .. text:format(...), 0) end

-- Returns the steps of integers and choices, by parameter.
local function levels_of(own)
  local levels = {}
  for i, p in ipairs(own.parameters) do
    levels[i] = p.kind == "integer" and p.high - p.low + 1 or p.kind == "choice" and #p.choices or false
  end
  return levels
end

-- With integers and choices searches come to the same places again and again. Unless values are noisy, these
-- are computed once. o.total: number of all places, if they are finite; o.complete: the evaluations suffice
-- for all of them, and a search that finds no end computes those that it has left out.
local function begin_known(own, o)
  local total, discrete = 1, false
  for _, count in ipairs(levels_of(own)) do
    total, discrete = count and total and total * count, discrete or count
  end
  if not discrete or o.noise then return end
  o.known, o.total = {}, total
  o.complete = total and total <= o.evaluations - around.reserve(own, o)
end

local function begin(own, o, method)
  local runs, side = {}, method.starts and o.starts or 1
  begin_known(own, o)
  for k, places in ipairs(design.starts(own.parameters, side)) do
    local problem = { n = #own.parameters, start = places, number = k, starts = o.starts, noise = o.noise,
      seed = core.checksum(("%d %d"):format(own.seed, k)), step = o.step, tolerance = o.tolerance,
      sides = judge.count_sides(own), levels = levels_of(own) }
    runs[k] = turns.run(k, method.begin(problem))
    runs[k].least = math.huge
  end
  return runs
end

local function outcome_of(own, result, record)
  if not record.results then return { failed = true } end
  return { value = judge.value(own, result, record), broken = judge.violation(own, record),
    sides = judge.sides(own, record) }
end

-- Returns the source of evaluations: starts take turns; after them come the surroundings of the best place.
local function source_of(own, result, o, runs)
  local found, highest, list = nil, 0, {}
  local rest, searched, left -- values that the search has left out; its highest number; how many are open
  local function next_left()
    rest, searched, left = rest or turns.unknown(own, o, levels_of(own)), searched or highest, left or 0
    local values = rest()
    if not values then return nil end
    highest, left = highest + 1, left + 1
    return highest, values
  end
  local function next_one()
    if found then return found:next() end
    local number, values = turns.next(own, o, runs)
    if number then
      highest = math.max(highest, number)
      return number, values
    end
    if turns.wait(runs) then return nil end
    if searched or o.complete and not turns.some_ok(runs) then
      number, values = next_left()
      if number or left > 0 then return number, values end
    end
    local center = o.noise and runs[1].search.center and runs[1].search:center()
    found = around.begin(own, result, o, list, highest, center)
    o.found = found
    return found:next()
  end
  local function done(record)
    if not own.by_name[result] then judge.has(record, result, "study:minimise") end
    list[#list + 1] = record
    if found then return found:done(record) end
    local outcome, run = outcome_of(own, result, record), runs[1]
    if searched and record.number > searched then left = left - 1
    else
      run = turns.hear(runs, o, record.number, outcome)
    end
    turns.know(runs, o, record.values, outcome)
    if not outcome.failed and outcome.broken <= 0 then run.least = math.min(run.least, outcome.value) end
  end
  return { next = next_one, done = done }
end

local function check(own, name, method, o)
  for _, p in ipairs(own.parameters) do
    if p.kind ~= "number" and not method.kinds[p.kind] then
      fail("method = '%s' cannot %s; take 'cma-es', or sweep it, or fix it", name, p.kind == "choice"
        and ("choose '%s' among choices"):format(p.name) or ("vary '%s', which is an integer"):format(p.name))
    end
  end
  if #own.parameters > method.most then
    fail("method = '%s' is for 1 to %d parameters, not %d", name, method.most, #own.parameters)
  end
  if o.starts and not method.starts and not method.restarts then
    fail("starts does not go with method = '%s', which searches all of the ranges", name)
  end
  if o.noise and not method.noise then
    fail("noise = true does not go with method = '%s'; take 'cma-es'", name)
  end
end

-- Sets options as the method wants them.
local function settle(own, o)
  if o.method == "auto" then
    o.method, o.why = search.auto(own.parameters, #own.constraints, o.noise)
  end
  local method = search.of(o.method)
  check(own, o.method, method, o)
  local starts = o.starts or method.starts or 1
  o.evaluations = o.evaluations or method.each * starts * #own.parameters
  o.starts = method.starts and math.min(starts, o.evaluations) or starts
  o.side = method.starts and o.starts or 1
  o.each = (o.evaluations - around.reserve(own, o)) // o.side
  o.step = o.step or method.step
  if method.fewest and o.each < method.fewest(own.parameters) then
    fail("evaluations = %d are fewer than one generation of %d", o.evaluations, method.fewest(own.parameters))
  end
  return method
end

-- Returns the options that identify a search: those that change its places or their numbers.
local function options_of(o)
  return { workers = o.workers, method = o.method, side = o.side, step = o.step, noise = o.noise or nil }
end

--- Runs the search; o: method, starts, evaluations, tolerance, step, noise, around, workers.
function minimise.run(own, result, o)
  local runs = begin(own, o, settle(own, o))
  local _ <close> = setmetatable({}, { __close = function()
    for _, run in ipairs(runs) do
      if run.search.close then run.search:close() end
    end
  end })
  local records = campaign.run(own, "minimise " .. result, options_of(o), source_of(own, result, o, runs))
  judge.some(own, records)
  local found = minimum.of(own, result, judge.sorted(records), runs, o)
  own.asked[own.part].says = tostring(found)
  return found
end

return minimise
