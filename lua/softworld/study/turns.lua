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
  if places and run.asked + #places > each then places, why = nil, "evaluations used up" end
  run.places, run.outcomes, run.next, run.before = places, {}, 1, run.asked
  if not places then run.ended, run.ok = why, ok or false end
end

-- Returns the next place of a run: number, values; nil if it waits or has ended.
local function next_of(own, o, run)
  if run.ended then return nil end
  refill(run, o.each)
  local place = run.places and run.places[run.next]
  if not place then return nil end
  run.next, run.asked = run.next + 1, run.asked + 1
  return (run.asked - 1) * o.side + run.number, parameters.all_at(own.parameters, place)
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

--- Takes the outcome of an evaluation; returns its run.
function turns.hear(runs, o, number, outcome)
  local run = runs[(number - 1) % o.side + 1]
  local k = (number - run.number) // o.side + 1
  run.told = run.told + 1
  run.outcomes[k - run.before] = outcome
  return run
end

return turns
