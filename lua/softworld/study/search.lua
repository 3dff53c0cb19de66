-- SPDX-License-Identifier: GPL-3.0-or-later
--- Methods that look for the smallest value: one file each in study/search, and its name here.
--
-- A method: { doc =, starts = (number of starts side by side, if any), each = (evaluations of a start for
-- each parameter), step =, most = (parameters), kinds = (besides "number"), noise = (true if it tolerates
-- noise), restarts = (its starts come one after the other), fewest = (evaluations, a function of the
-- parameters), begin = }.
-- begin(problem) -> run; problem: { n =, start = places, number =, starts =, seed =, step =, tolerance =,
-- sides = (limits of constraints), levels = (of integers, by parameter), noise = }.
-- run:ask() -> a list of places, lists of numbers from 0 to 1, which may all be evaluated at once; or nil,
-- the reason of the end, and whether it is as near as wanted. run:tell(outcomes) answers that list. Optional:
-- run:close(), and run:center() -> the place the run would take if values are noisy, or nil.
-- An outcome: { value =, broken = sum of excesses over limits, sides = by how much each limit is broken,
-- failed = }.
-- @module softworld.study.search
local search = {}

search.names = { "simplex", "bobyqa", "cobyla", "direct", "crs2", "cma-es" }

--- Returns one line about a method.
function search.about(name)
  return name == "auto" and "by the parameters and constraints: found.method and found.why tell"
    or search.of(name).doc
end

local BROKEN, FAILED = 1e200, 1e290

--- Returns the method with this name.
function search.of(name) return require("softworld.study.search." .. name:gsub("-", "_")) end

--- Returns a rank for methods that only compare: an evaluation that breaks constraints is worse than all that
-- meet them, and the worse the more it breaks; a failed one is the worst.
function search.rank(outcome)
  if outcome.failed then return FAILED end
  if outcome.broken > 0 then return BROKEN * (1 + math.min(outcome.broken, 1e80)) end
  return math.max(-BROKEN, math.min(BROKEN, outcome.value))
end

--- Returns the method for "auto", and why: from the parameters, the number of constraints, and noise.
function search.auto(parameters, constraints, noise)
  local n = #parameters
  for _, p in ipairs(parameters) do
    if p.kind == "choice" then return "cma-es", ("'%s' has choices"):format(p.name) end
  end
  if noise then return "cma-es", "values are noisy" end
  if n == 1 then return "simplex", "one parameter" end
  if n > 32 then return "cma-es", ("%d parameters"):format(n) end
  if constraints > 0 then return "cma-es", "constraints may be steps, and runs may fail at them" end
  for _, p in ipairs(parameters) do
    if p.kind == "integer" then return "simplex", ("'%s' is an integer"):format(p.name) end
  end
  return "bobyqa", "several numbers without constraints"
end

return search
