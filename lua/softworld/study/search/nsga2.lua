-- SPDX-License-Identifier: GPL-3.0-or-later
--- NSGA-II (K. Deb, A. Pratap, S. Agarwal, T. Meyarivan 2002): a population that spreads along the front of
-- two or three results. It only compares: failures are worst, then broken constraints, by how much. So it
-- tolerates steps, failures, integers and choices; its generations are evaluated whole. Weighted sums would
-- need a search for each point, and would miss the concave parts of a front.
--
-- An outcome has `values`, one per result, instead of a value.
-- @module softworld.study.search.nsga2
local design = require "softworld.study.design"

local nsga2 = {}

local CROSS, CROSS_SHAPE = 0.9, 15 -- share of pairs that are mixed, and the nearness to their parents
local MUTATE_SHAPE = 20            -- of a mutation: larger means smaller steps

local Run = {}
Run.__index = Run

--- True if a is better than b: in at least one value, and worse in none. A failure or broken constraint is
-- never better than a result without.
function nsga2.dominates(a, b)
  if a.failed or b.failed then return not a.failed end
  if a.broken > 0 or b.broken > 0 then return a.broken < b.broken end
  local better = false
  for k, v in ipairs(a.values) do
    if v > b.values[k] then return false end
    better = better or v < b.values[k]
  end
  return better
end

--- Returns the fronts of a list of { outcome = }, best first, each a list; sets the rank of each.
function nsga2.fronts(list)
  local beaten, by, fronts = {}, {}, { {} }
  for i in ipairs(list) do beaten[i], by[i] = {}, 0 end
  for i, a in ipairs(list) do
    for j = 1, i - 1 do
      local b = list[j]
      if nsga2.dominates(a.outcome, b.outcome) then
        beaten[i][#beaten[i] + 1], by[j] = j, by[j] + 1
      elseif nsga2.dominates(b.outcome, a.outcome) then
        beaten[j][#beaten[j] + 1], by[i] = i, by[i] + 1
      end
    end
  end
  local now = {}
  for i, count in ipairs(by) do
    if count == 0 then now[#now + 1] = i end
  end
  for rank = 1, #list do
    local after = {}
    fronts[rank] = {}
    for _, i in ipairs(now) do
      list[i].rank = rank
      table.insert(fronts[rank], list[i])
      for _, j in ipairs(beaten[i]) do
        by[j] = by[j] - 1
        if by[j] == 0 then after[#after + 1] = j end
      end
    end
    if #after == 0 then break end
    table.sort(after)
    now = after
  end
  return fronts
end

-- Sets how lonely each member of a front is: the sum of its neighbours' distances, relative to the front's
-- extent.
local function crowd(front)
  for _, one in ipairs(front) do one.lonely = 0 end
  if front[1].outcome.failed then return end
  for m = 1, #front[1].outcome.values do
    local order = table.move(front, 1, #front, 1, {})
    table.sort(order, function(a, b)
      local va, vb = a.outcome.values[m], b.outcome.values[m]
      if va == vb then return a.number < b.number end
      return va < vb
    end)
    local first, last = order[1], order[#order]
    local extent = last.outcome.values[m] - first.outcome.values[m]
    first.lonely, last.lonely = math.huge, math.huge
    for i = 2, #order - 1 do
      local gap = order[i + 1].outcome.values[m] - order[i - 1].outcome.values[m]
      if extent > 0 then order[i].lonely = order[i].lonely + gap / extent end
    end
  end
end

local function is_better(a, b)
  if a.rank ~= b.rank then return a.rank < b.rank end
  if a.lonely ~= b.lonely then return a.lonely > b.lonely end
  return a.number < b.number
end

-- Keeps the best by front, and of the last front the loneliest.
local function survive(self, all)
  local left = {}
  for _, front in ipairs(nsga2.fronts(all)) do
    crowd(front)
    table.sort(front, is_better)
    for _, one in ipairs(front) do
      if #left < self.size then left[#left + 1] = one end
    end
  end
  return left
end

local function pick(self)
  local people, random = self.people, self.random
  local a, b = people[1 + math.floor(random() * #people)], people[1 + math.floor(random() * #people)]
  return is_better(a, b) and a or b
end

-- Simulated binary crossover within bounds 0 and 1 (Deb, Agrawal 1995): one coordinate of two children.
local function mixed(a, b, random)
  local low, high = math.min(a, b), math.max(a, b)
  if high - low < 1e-14 then return a, b end
  local u = random()
  local function spread(room)
    local alpha = 2 - (1 + 2 * room / (high - low)) ^ -(CROSS_SHAPE + 1)
    return u <= 1 / alpha and (u * alpha) ^ (1 / (CROSS_SHAPE + 1))
      or (1 / (2 - u * alpha)) ^ (1 / (CROSS_SHAPE + 1))
  end
  local c = 0.5 * (low + high - spread(low) * (high - low))
  local d = 0.5 * (low + high + spread(1 - high) * (high - low))
  c, d = math.max(0, math.min(1, c)), math.max(0, math.min(1, d))
  if random() < 0.5 then return d, c end
  return c, d
end

-- Polynomial mutation within bounds 0 and 1.
local function mutated(x, random)
  local u, power = random(), 1 / (MUTATE_SHAPE + 1)
  local step = u < 0.5 and (2 * u + (1 - 2 * u) * (1 - x) ^ (MUTATE_SHAPE + 1)) ^ power - 1
    or 1 - (2 * (1 - u) + (2 * u - 1) * x ^ (MUTATE_SHAPE + 1)) ^ power
  return math.max(0, math.min(1, x + step))
end

local function children(self)
  local one, two, random = {}, {}, self.random
  local a, b = pick(self).place, pick(self).place
  local cross = random() < CROSS
  for i = 1, self.problem.n do
    local x, y = a[i], b[i]
    if cross and random() < 0.5 then x, y = mixed(x, y, random) end
    if random() < 1 / self.problem.n then x = mutated(x, random) end
    if random() < 1 / self.problem.n then y = mutated(y, random) end
    one[i], two[i] = x, y
  end
  return one, two
end

function Run:ask()
  local places = {}
  if not self.people then
    for k = 1, self.size do places[k] = self.problem.first(k) end
    return places
  end
  while #places < self.size do
    local one, two = children(self)
    places[#places + 1] = one
    if #places < self.size then places[#places + 1] = two end
  end
  return places
end

function Run:tell(outcomes, places)
  local all = self.people or {}
  for k, outcome in ipairs(outcomes) do
    self.count = self.count + 1
    all[#all + 1] = { place = places[k], outcome = outcome, number = self.count }
  end
  self.people = survive(self, all)
end

--- problem: n, seed, size = of the population, first = function from 1..size to the first places.
function nsga2.begin(problem)
  return setmetatable({ problem = problem, size = problem.size, count = 0,
    random = design.generator(problem.seed, 2002) }, Run)
end

return nsga2
