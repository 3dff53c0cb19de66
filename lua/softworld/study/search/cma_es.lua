-- SPDX-License-Identifier: GPL-3.0-or-later
--- CMA-ES (N. Hansen, The CMA evolution strategy: a tutorial, 2016, with active update): a normal
-- distribution of places whose mean, size and shape follow the better ones. It only compares values.
-- Generations are evaluated whole, side by side.
--
-- Bounds: coordinates near a bound are mapped by a parabola (as in N. Hansen's pycma). Integers are drawn
-- widely enough to reach their neighbours. Restarts: each with twice the population from a random place
-- (IPOP; Auger, Hansen 2005). Noise: some places of a generation are evaluated twice; if their order changes
-- too much (study/unrest), each place becomes the mean of more evaluations (Hansen, Niederberger, Guzzella,
-- Koumoutsakos 2009).
-- @module softworld.study.search.cma_es
local core = require "softworld.core"
local design = require "softworld.study.design"
local quadratic = require "softworld.study.quadratic"
local search = require "softworld.study.search"
local unrest = require "softworld.study.unrest"

local MARGIN = 0.05     -- width of the parabola beside each bound, over the range
local MOST_REPEATS = 30 -- most evaluations of a place, if values are noisy
local FITTED = 15       -- most parameters of a polynomial
local REACH = 0.25      -- least spread of an integer, in its steps
local WIDEST = 1e14     -- most of the covariance: longest axis over shortest, squared
local exp, log, max, min, sqrt = math.exp, math.log, math.max, math.min, math.sqrt

local normal = design.normal

local Run = {}
Run.__index = Run

local function filled(n, value)
  local list = {}
  for i = 1, n do list[i] = value end
  return list
end

-- --- constants of the tutorial --------------------------------------------------------------------

-- Sets the weights of ranks: the better half counts positively, the others negatively.
local function weigh(c, n)
  local raw, sums = {}, { [true] = { 0, 0 }, [false] = { 0, 0 } }
  for i = 1, c.size do
    raw[i] = log((c.size + 1) / 2) - log(i)
    local s = sums[i <= c.parents]
    s[1], s[2] = s[1] + raw[i], s[2] + raw[i] ^ 2
  end
  local for_, against = sums[true], sums[false]
  c.effective = for_[1] ^ 2 / for_[2]
  local effective_against = against[1] ^ 2 / against[2]
  c.one = 2 / ((n + 1.3) ^ 2 + c.effective)
  c.many = min(1 - c.one - 1e-8,
    2 * (c.effective - 2 + 1 / c.effective) / ((n + 2) ^ 2 + c.effective))
  local least = min(1 + c.one / c.many, 1 + 2 * effective_against / (c.effective + 2),
    (1 - c.one - c.many) / (n * c.many))
  local above, below = 0, 0
  for _, w in ipairs(raw) do above, below = above + max(0, w), below + max(0, -w) end
  c.weights, c.sum = {}, 0
  for i, w in ipairs(raw) do
    c.weights[i] = w >= 0 and w / above or least * w / below
    c.sum = c.sum + c.weights[i]
  end
end

local function constants(n, size)
  local c = { size = size, parents = size // 2 }
  weigh(c, n)
  local m = c.effective
  c.path_size = (m + 2) / (n + m + 5)
  c.damping = 1 + 2 * max(0, sqrt((m - 1) / (n + 1)) - 1) + c.path_size
  c.path_shape = (4 + m / n) / (n + 4 + 2 * m / n)
  c.length = sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n)) -- mean length of a normal vector
  return c
end

-- --- a distribution ---------------------------------------------------------------------------------

local function begin_at(self, mean, size)
  local n = self.problem.n
  self.c, self.mean, self.sigma, self.generation = constants(n, size), mean, self.problem.step, 0
  self.seen = { places = {}, values = {}, counts = {}, level = math.huge }
  self.path_s, self.path_c, self.history = filled(n, 0), filled(n, 0), {}
  self.matrix = filled(n * n, 0)
  for i = 1, n do self.matrix[(i - 1) * n + i] = 1 end
  self.repeats, self.count = 1, 1 -- evaluations of a place: wanted, and in a generation
end

local function axes(self)
  local values, vectors = core.eigen(self.matrix, self.problem.n)
  for k, v in ipairs(values) do values[k] = sqrt(max(v, 1e-30)) end
  self.lengths, self.vectors = values, vectors
end

-- Draws from the distribution. Returns the difference from the mean in units of sigma.
local function draw(self)
  local n, y = self.problem.n, {}
  for i = 1, n do y[i] = 0 end
  for k = 1, n do
    local z, vector = normal(self.random) * self.lengths[k], self.vectors[k]
    for i = 1, n do y[i] = y[i] + z * vector[i] end
  end
  for i = 1, n do
    local levels = self.problem.levels and self.problem.levels[i]
    local lacking = levels and (REACH / levels / self.sigma) ^ 2 - self.matrix[(i - 1) * n + i] or 0
    if lacking > 0 then y[i] = y[i] + normal(self.random) * sqrt(lacking) end
  end
  return y
end

-- Returns the place of an unbounded coordinate of the distribution: equal to it in the middle of the range, a
-- parabola near the ends, so that a result that falls towards a bound has a smooth valley there; mirrored
-- beyond.
local function bounded(x)
  local whole = 1 + 2 * MARGIN
  local u = (x + MARGIN) % (2 * whole)
  u = (u > whole and 2 * whole - u or u) - MARGIN
  if u < MARGIN then return (u + MARGIN) ^ 2 / (4 * MARGIN) end
  if u > 1 - MARGIN then return 1 - (1 + MARGIN - u) ^ 2 / (4 * MARGIN) end
  return u
end

-- Returns the coordinate of a place.
local function unbounded(u)
  if u < MARGIN then return sqrt(4 * MARGIN * u) - MARGIN end
  if u > 1 - MARGIN then return 1 + MARGIN - sqrt(4 * MARGIN * (1 - u)) end
  return u
end

-- Returns a draw, and its place.
local function sample(self)
  local y, x, place = draw(self), {}, {}
  for i, m in ipairs(self.mean) do
    x[i] = m + self.sigma * y[i]
    place[i] = bounded(x[i])
  end
  return x, place
end

-- --- ending -------------------------------------------------------------------------------------

local function is_small(self)
  local n, p = self.problem.n, self.problem
  for i = 1, n do
    local wanted = p.levels and p.levels[i] and REACH / p.levels[i] or p.tolerance
    if self.sigma * sqrt(self.matrix[(i - 1) * n + i]) > wanted then return false end
  end
  return true
end

-- True if nothing has changed for a number of generations.
local function is_flat(self)
  local h, many = self.history, 10 + math.ceil(30 * self.problem.n / self.c.size)
  if #h < many then return false end
  local least, most = math.huge, -math.huge
  for k = #h - many + 1, #h do
    least, most = min(least, h[k][1]), max(most, h[k][k == #h and 2 or 1])
  end
  return most - least <= 1e-15 * max(math.abs(most), math.abs(least))
end

local function ended(self)
  local n = self.problem.n
  if self.generation == 0 then return nil end
  if is_small(self) then return "the wanted accuracy was reached", true end
  if is_flat(self) then return "the value no longer changes", true end
  if (self.lengths[n] / self.lengths[1]) ^ 2 > WIDEST then
    return "the distribution became a needle", false
  end
end

local function random_place(self)
  local x = {}
  for i = 1, self.problem.n do x[i] = self.random() end
  return x
end

-- Returns what the best start so far has seen: the one whose last generation has the best middle.
local function best_seen(self)
  local before = self.before
  return before and before.level < self.seen.level and before or self.seen
end

-- --- asking ---------------------------------------------------------------------------------------

-- Returns how many of a generation are evaluated again to measure the noise.
local function again_of(self) return self.problem.noise and max(2, math.ceil(0.1 * self.c.size)) or 0 end

function Run:ask()
  axes(self)
  local why, ok = ended(self)
  if why then
    if self.restarts <= 0 then return nil, why, ok end
    self.restarts = self.restarts - 1
    self.before = best_seen(self)
    begin_at(self, random_place(self), 2 * self.c.size)
    axes(self)
  end
  self.drawn, self.places = {}, {}
  for i = 1, self.c.size do self.drawn[i], self.places[i] = sample(self) end
  local list = {}
  for k = 1, self.c.size + again_of(self) do
    for _ = 1, self.count do list[#list + 1] = self.places[(k - 1) % self.c.size + 1] end
  end
  return list
end

-- --- telling --------------------------------------------------------------------------------------

-- Returns the mean of some outcomes; failed if most of them failed.
local function mean_of(outcomes, from, count)
  local value, broken, good = 0, 0, 0
  for k = from, from + count - 1 do
    local o = outcomes[k]
    if not o.failed then value, broken, good = value + o.value, broken + o.broken, good + 1 end
  end
  if 2 * good <= count then return { failed = true } end
  return { value = value / good, broken = broken / good }
end

local function hear_noise(self, ranks, outcomes)
  local again, size = {}, self.c.size
  for k = 1, again_of(self) do
    again[k] = search.rank(mean_of(outcomes, (size + k - 1) * self.count + 1, self.count))
  end
  if unrest(ranks, again) <= 0 then
    self.repeats = max(1, self.repeats / 1.5)
  elseif self.repeats < MOST_REPEATS then
    self.repeats = min(MOST_REPEATS, self.repeats * 1.5)
  else
    self.sigma = self.sigma * (1 + 2 / (self.problem.n + 10))
  end
end

-- Returns the places of this generation from best to worst, as differences in units of sigma.
local function ranked(self, ranks)
  local order, list = {}, {}
  for k = 1, #ranks do order[k] = k end
  table.sort(order, function(a, b)
    if ranks[a] == ranks[b] then return a < b end
    return ranks[a] < ranks[b]
  end)
  for k, which in ipairs(order) do
    local y = {}
    for i, m in ipairs(self.mean) do y[i] = (self.drawn[which][i] - m) / self.sigma end
    list[k] = y
  end
  return list
end

-- Returns C^(-1/2) y.
local function whitened(self, y)
  local out = filled(#y, 0)
  for k, vector in ipairs(self.vectors) do
    local along = 0
    for i, v in ipairs(vector) do along = along + v * y[i] end
    for i, v in ipairs(vector) do out[i] = out[i] + along / self.lengths[k] * v end
  end
  return out
end

local function square(y)
  local sum = 0
  for _, v in ipairs(y) do sum = sum + v * v end
  return sum
end

local function step_of(self, list)
  local step = filled(self.problem.n, 0)
  for k = 1, self.c.parents do
    for i, v in ipairs(list[k]) do step[i] = step[i] + self.c.weights[k] * v end
  end
  return step
end

-- Updates the paths of the mean. Returns 1, or 0 while the path is so long that the shape should wait.
local function lengthen(self, step)
  local c, white = self.c, whitened(self, step)
  local along = sqrt(c.path_size * (2 - c.path_size) * c.effective)
  for i, v in ipairs(white) do
    self.path_s[i] = (1 - c.path_size) * self.path_s[i] + along * v
  end
  local length = sqrt(square(self.path_s))
  local expected = sqrt(1 - (1 - c.path_size) ^ (2 * (self.generation + 1)))
  local heeded = length / expected < (1.4 + 2 / (self.problem.n + 1)) * c.length and 1 or 0
  along = heeded * sqrt(c.path_shape * (2 - c.path_shape) * c.effective)
  for i, v in ipairs(step) do self.path_c[i] = (1 - c.path_shape) * self.path_c[i] + along * v end
  return heeded, length
end

local function reshape(self, list, heeded)
  local c, n, m = self.c, self.problem.n, self.matrix
  local weights = {}
  for k, w in ipairs(c.weights) do
    weights[k] = c.many * (w >= 0 and w or w * n / (square(whitened(self, list[k])) + 1e-8))
  end
  local kept = 1 + c.one * (1 - heeded) * c.path_shape * (2 - c.path_shape) - c.one - c.many * c.sum
  for i = 1, n do
    for j = 1, i do
      local sum = kept * m[(i - 1) * n + j] + c.one * self.path_c[i] * self.path_c[j]
      for k, w in ipairs(weights) do sum = sum + w * list[k][i] * list[k][j] end
      m[(i - 1) * n + j], m[(j - 1) * n + i] = sum, sum
    end
  end
end

local function learn(self, ranks)
  local c, list = self.c, ranked(self, ranks)
  local step = step_of(self, list)
  for i, v in ipairs(step) do
    self.mean[i] = max(-MARGIN, min(1 + MARGIN, self.mean[i] + self.sigma * v))
  end
  self.generation = self.generation + 1
  local heeded, length = lengthen(self, step)
  reshape(self, list, heeded)
  self.sigma = min(1, self.sigma * exp(c.path_size / c.damping * (length / c.length - 1)))
end

function Run:tell(outcomes)
  local ranks, size, good = {}, self.c.size, 0
  for k = 1, size do
    local o = mean_of(outcomes, (k - 1) * self.count + 1, self.count)
    ranks[k], good = search.rank(o), good + (o.failed and 0 or 1)
    if self.problem.noise and not o.failed then
      local seen = self.seen
      local at = #seen.places + 1
      seen.places[at], seen.values[at], seen.counts[at] = self.places[k], o.value, self.count
    end
  end
  -- If all of a generation fail, the next is drawn wider.
  if good == 0 then
    self.sigma = min(0.5, 1.5 * self.sigma)
    return
  end
  learn(self, ranks)
  if self.problem.noise then hear_noise(self, ranks, outcomes) end
  self.count = math.floor(self.repeats + 0.5)
  table.sort(ranks)
  self.history[#self.history + 1] = { ranks[1], ranks[size] }
  self.seen.level = ranks[self.c.parents]
end

-- Returns the places that a start has seen, in units of their spread about their mean.
local function scaled(seen, n)
  local middle, spread, places = filled(n, 0), filled(n, 0), {}
  for _, place in ipairs(seen.places) do
    for i, u in ipairs(place) do middle[i] = middle[i] + u / #seen.places end
  end
  for _, place in ipairs(seen.places) do
    for i, u in ipairs(place) do spread[i] = spread[i] + (u - middle[i]) ^ 2 / #seen.places end
  end
  for i, s in ipairs(spread) do spread[i] = sqrt(s) + 1e-15 end
  for k, place in ipairs(seen.places) do
    places[k] = {}
    for i, u in ipairs(place) do places[k][i] = (u - middle[i]) / spread[i] end
  end
  return places, middle, spread
end

--- Returns a better centre if values are noisy: the smallest noisy value is small by luck. It is the lowest
-- place of a polynomial of degree 2 through everything that the best start has seen, weighted by the
-- evaluations. nil if they do not determine it.
function Run:center()
  local n, seen = self.problem.n, best_seen(self)
  if n > FITTED or #seen.places < 6 * quadratic.count(n) then return nil end
  local places, middle, spread = scaled(seen, n)
  local lowest = quadratic.lowest(quadratic.fit(places, seen.values, seen.counts), n)
  for i, u in ipairs(lowest or {}) do
    if math.abs(u) > 2 then return nil end
    lowest[i] = max(0, min(1, middle[i] + spread[i] * u))
  end
  return lowest
end

local function size_of(n) return 4 + math.floor(3 * log(n)) end

local function begin(problem)
  local self = setmetatable({ problem = problem, restarts = problem.starts - 1,
    random = design.generator(problem.seed, 20161) }, Run)
  local mean = {}
  for i, u in ipairs(problem.start) do mean[i] = unbounded(u) end
  begin_at(self, mean, size_of(problem.n))
  return self
end

return { doc = "CMA-ES: robust against steps, failures and noise, whole generations at once", each = 500,
  step = 0.3, most = 100, kinds = { integer = true, choice = true }, noise = true, restarts = true,
  fewest = function(parameters) return size_of(#parameters) end, begin = begin }
