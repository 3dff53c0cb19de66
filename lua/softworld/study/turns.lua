-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs of search methods, which take turns: each is asked for places and told what came out.
--
-- Evaluation k of run j of so many side by side has number (k - 1) * side + j: so which evaluations there are
-- depends on nothing but the values, and a journal goes on.
-- @module softworld.study.turns
local parameters = require "softworld.study.parameters"

local turns = {}

--- A run of a method: see study/search for ask and tell.
function turns.run(number, method) return { number = number, search = method, asked = 0, told = 0 } end

-- Tell a run its values and ask for more, once all that it asked for are known.
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

-- The next place of a run: number, values; nil when it waits or has ended.
local function next_of(own, o, run)
  if run.ended then return nil end
  refill(run, o.each)
  local place = run.places and run.places[run.next]
  if not place then return nil end
  run.next, run.asked = run.next + 1, run.asked + 1
  return (run.asked - 1) * o.side + run.number, parameters.all_at(own.parameters, place)
end

--- The next evaluation of any run: number, values; nil when all wait or have ended. o: side = how many runs,
-- each = evaluations of one at most.
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

--- Is there one that has not ended?
function turns.wait(runs)
  for _, run in ipairs(runs) do
    if not run.ended then return true end
  end
  return false
end

--- What came out of an evaluation; gives its run.
function turns.hear(runs, o, number, outcome)
  local run = runs[(number - 1) % o.side + 1]
  local k = (number - run.number) // o.side + 1
  run.told = run.told + 1
  run.outcomes[k - run.before] = outcome
  return run
end

return turns
