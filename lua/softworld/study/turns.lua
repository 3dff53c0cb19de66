-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs of search methods that take turns: each is asked for places and gets the results.
--
-- Evaluation k of run j of `side` runs has number (k - 1) * side + j. So the evaluations depend only on the
-- values, and a journal can be continued.
-- @module softworld.study.turns
local parameters = require "softworld.study.parameters"

local turns = {}

--- Returns a run of a method: see study/search for ask and tell.
function turns.run(number, method) return { number = number, search = method, asked = 0, told = 0 } end

-- Gives a run its values and asks for more, once everything that it asked for is known.
local function refill(run, each)
  if run.told < run.asked then return end
  if run.places then
    if run.next <= #run.places then return end
    run.search:tell(run.outcomes, run.places)
  end
  local places, why, ok = run.search:ask()
  if places and run.asked + #places > each then
    places, why = nil, run.reused and "it came back to places that are known" or "evaluations used up"
  end
  run.places, run.outcomes, run.next, run.before = places, {}, 1, run.asked
  if not places then run.ended, run.ok = why, ok or false end
end

-- Gives the run the outcome of its evaluation k.
local function give(run, k, outcome)
  run.told = run.told + 1
  run.outcomes[k - run.before] = outcome
end

-- Returns the next place of a run: number, values; nil if it waits or has ended. With o.known a place that is
-- known already is not computed again.
local function next_of(own, o, run)
  while not run.ended do
    refill(run, o.each)
    local place = run.places and run.places[run.next]
    if not place then return nil end
    local values = parameters.all_at(own.parameters, place)
    local known = o.known and o.known[parameters.word(values)]
    if known == "asked" then return nil end -- it will be known
    run.next, run.asked = run.next + 1, run.asked + 1
    if not known then
      if o.known then o.known[parameters.word(values)] = "asked" end
      return (run.asked - 1) * o.side + run.number, values
    end
    run.reused = true
    give(run, run.asked, known)
  end
end

--- Returns the next evaluation of any run: number, values; nil if all wait or have ended. o: side = number of
-- runs, each = most evaluations of one.
function turns.next(own, o, runs)
  local order = table.move(runs, 1, #runs, 1, {})
  table.sort(order, function(a, b)
    if a.asked == b.asked then return a.number < b.number end
    return a.asked < b.asked
  end)
  for _, run in ipairs(order) do
    local number, values = next_of(own, o, run)
    if number then return number, values end
  end
end

--- True if a run has not ended.
function turns.wait(runs)
  for _, run in ipairs(runs) do
    if not run.ended then return true end
  end
  return false
end

--- True if a run has found what it looks for.
function turns.some_ok(runs)
  for _, run in ipairs(runs) do
    if run.ok then return true end
  end
  return false
end

--- Takes the outcome of an evaluation; returns its run.
function turns.hear(runs, o, number, outcome)
  local run = runs[(number - 1) % o.side + 1]
  give(run, (number - run.number) // o.side + 1, outcome)
  return run
end

--- Returns an iterator over the values that are not known yet, of parameters with o.total values together.
function turns.unknown(own, o, levels)
  local at = 0
  return function()
    while at < o.total do
      local rest, place = at, {}
      for i, count in ipairs(levels) do
        place[i], rest = (rest % count + 0.5) / count, rest // count
      end
      at = at + 1
      local values = parameters.all_at(own.parameters, place)
      if not o.known[parameters.word(values)] then return values end
    end
  end
end

--- Keeps the outcome of values. Once all values of all parameters are known (o.total), all runs end.
function turns.know(runs, o, values, outcome)
  if not o.known then return end
  o.known[parameters.word(values)] = outcome
  o.count = (o.count or 0) + 1
  if o.count ~= o.total then return end
  local why = o.total == 1 and "the only value is known" or ("all %d values are known"):format(o.total)
  for _, run in ipairs(runs) do run.ended, run.ok = why, true end
end

return turns
