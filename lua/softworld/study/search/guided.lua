-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs of the core's minimisers, which want one finite value after the other.
--
-- NaN and huge numbers alike mislead methods that fit a model through the values (measured with one NaN in 37
-- values: BOBYQA reports success 3.25 away from the minimum). They get the value plus WEIGHT times its first
-- size for broken constraints; a failure counts as somewhat worse than the worst value so far. They start at
-- the first place that does not fail, so that there is a value to compare with.
-- @module softworld.study.search.guided
local core = require "softworld.core"
local search = require "softworld.study.search"

local guided = {}

local WEIGHT = 10   -- penalty of a limit broken by its own size, in sizes of the first value
local WORSE = 0.1   -- excess of a failure over the worst value, relative to the range from best to worst
local LOOKS = 20    -- most places tried to find one that does not fail
local LARGEST = 1e100

local function fold(x)
  x = math.abs(x) % 2
  return x > 1 and 2 - x or x
end

local function folded(x)
  local places = {}
  for i, u in ipairs(x) do places[i] = fold(u) end
  return places
end

local function same(a, b)
  for i = 1, #a do
    if a[i] ~= b[i] then return false end
  end
  return true
end

-- --- values ------------------------------------------------------------------------------------

-- Grows slowly beyond 1: large excesses say little about the border.
local function squashed(broken) return broken <= 1 and broken or 1 + math.log(broken) end

local function penalised(self, outcome)
  local v = math.max(-LARGEST, math.min(LARGEST, outcome.value))
  if self.gives_sides then return v end
  if not self.weight then self.weight = WEIGHT * (v ~= 0 and math.abs(v) or 1) end
  return v + self.weight * squashed(outcome.broken)
end

local function finite(self, outcome)
  if outcome.failed then
    local between = math.max(self.worst - self.best, 1e-3 * math.abs(self.worst), 1e-12)
    return self.worst + WORSE * between
  end
  local v = penalised(self, outcome)
  self.worst, self.best = math.max(self.worst or v, v), math.min(self.best or v, v)
  return v
end

-- Returns by how much each limit is broken; for failures the largest excess so far.
local function sides_of(self, outcome)
  local list = {}
  for k = 1, self.problem.sides do
    self.most[k] = math.max(self.most[k] or 0, outcome.sides and outcome.sides[k] or 0)
    list[k] = outcome.failed and math.max(1, self.most[k]) or outcome.sides[k]
  end
  return list
end

-- --- runs --------------------------------------------------------------------------------------

local Run = {}
Run.__index = Run

local function start_minimiser(self, place)
  local p = self.problem
  self.minimiser = core.search(self.name, place, self.gives_sides and p.sides or 0, p.step, p.tolerance,
    p.seed & 0x7fffffff)
end

-- Returns a place to try: the start, then points of Halton's sequence, different ones for each start.
local function look(self)
  local p = self.problem
  self.looked = self.looked + 1
  if self.looked == 1 then return { p.start } end
  if self.looked > LOOKS then return nil, ("%d places failed, none to begin with"):format(LOOKS), false end
  local at = p.starts + (p.number - 1) * LOOKS + self.looked
  local flat = core.quasi("halton", p.n, at)
  return { table.move(flat, (at - 1) * p.n + 1, at * p.n, 1, {}) }
end

function Run:ask()
  if self.known == false then return look(self) end
  while true do
    local x, why, ok = self.minimiser:ask()
    if not x then return nil, why, ok end
    local known = self.known
    self.known = nil
    if not (known and same(x, known.place)) then
      if known then finite(self, known.outcome) end -- it starts elsewhere, but compares with this value
      self.place = self.folds and folded(x) or x
      return { self.place }
    end
    self:answer(known.outcome)
  end
end

function Run:answer(outcome)
  if self.ranks then return self.minimiser:tell(search.rank(outcome)) end
  self.minimiser:tell(finite(self, outcome), self.gives_sides and sides_of(self, outcome) or nil)
end

function Run:tell(outcomes, places)
  local outcome = outcomes[1]
  if self.known ~= false then
    if self.heard then self.heard(self.place, outcome) end
    return self:answer(outcome)
  end
  if outcome.failed then return end
  self.known = { place = places[1], outcome = outcome }
  start_minimiser(self, places[1])
end

function Run:close()
  if self.minimiser then self.minimiser:close() end
end

--- Starts a run of the core's minimiser `name`. o: ranks (it only compares), folds (its places leave the
-- cube), gives_sides (it gets constraints directly).
function guided.begin(name, problem, o)
  local self = setmetatable({ name = name, problem = problem, ranks = o.ranks, folds = o.folds,
    gives_sides = o.gives_sides, most = {}, looked = 0 }, Run)
  if o.ranks then start_minimiser(self, problem.start) else self.known = false end
  return self
end

return guided
