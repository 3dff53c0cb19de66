-- SPDX-License-Identifier: GPL-3.0-or-later
--- CRS2 (Kaelo, Ali 2006, by NLopt): a crowd of 10 (n + 1) places, of which the worst is replaced. It only
-- compares values. It is as near as wanted when the whole crowd is within the tolerance.
-- @module softworld.study.search.crs2
local guided = require "softworld.study.search.guided"
local search = require "softworld.study.search"

local crs2 = { doc = "a crowd of random places that draws together: the lowest valley", each = 500,
  step = 0.2, most = 32, kinds = { integer = true } }

-- Adds a place to the crowd, which keeps the best `size` places, worst first.
local function keep(crowd, size, place, outcome)
  if outcome.failed then return end
  local value, at = search.rank(outcome), #crowd + 1
  if at > size and value >= crowd[1].value then return end
  table.insert(crowd, { place = place, value = value })
  table.sort(crowd, function(a, b) return a.value > b.value end)
  if at > size then table.remove(crowd, 1) end
end

local function is_near(crowd, size, tolerance)
  if #crowd < size then return false end
  for i = 1, #crowd[1].place do
    local low, high = 1, 0
    for _, c in ipairs(crowd) do
      low, high = math.min(low, c.place[i]), math.max(high, c.place[i])
    end
    if high - low > tolerance then return false end
  end
  return true
end

function crs2.begin(problem)
  local run, crowd = guided.begin("crs2", problem, { ranks = true }), {}
  local size, ask = 10 * (problem.n + 1), run.ask
  function run.heard(place, outcome) keep(crowd, size, place, outcome) end
  function run:ask()
    if is_near(crowd, size, problem.tolerance) then return nil, "the wanted accuracy was reached", true end
    return ask(self)
  end
  return run
end

return crs2
