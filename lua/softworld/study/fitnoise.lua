-- SPDX-License-Identifier: GPL-3.0-or-later
--- Tests whether residuals are noise: their sum of squares over sigma, and how often they change sign.
-- @module softworld.study.fitnoise
local core = require "softworld.core"
local counted = require "softworld.output.number".count

local fitnoise = {}

local RARE = 0.01  -- chance below which a remark is made
local SHORTEST = 12 -- shortest list whose signs are counted

--- Returns the chance of so few runs of equal signs, with a and b signs of each kind in random order
-- (A. Wald and J. Wolfowitz 1940): the sum of the probabilities up to `runs`.
function fitnoise.runs_chance(a, b, runs)
  if a == 0 or b == 0 then return 1 end
  local function log_choose(n, k)
    if k < 0 or k > n then return -math.huge end
    local sum = 0
    for i = 1, k do sum = sum + math.log((n - k + i) / i) end
    return sum
  end
  local all, chance = log_choose(a + b, a), 0
  for r = 2, runs do
    local k = r // 2
    if r % 2 == 0 then
      chance = chance + 2 * math.exp(log_choose(a - 1, k - 1) + log_choose(b - 1, k - 1) - all)
    else
      chance = chance + math.exp(log_choose(a - 1, k) + log_choose(b - 1, k - 1) - all)
        + math.exp(log_choose(a - 1, k - 1) + log_choose(b - 1, k) - all)
    end
  end
  return math.min(1, chance)
end

-- Returns the numbers of positive and other residuals, and of runs of equal signs.
local function runs_of(list)
  local a, b, runs, last = 0, 0, 0, nil
  for _, x in ipairs(list) do
    local up = x > 0
    if up then a = a + 1 else b = b + 1 end
    if up ~= last then runs = runs + 1 end
    last = up
  end
  return a, b, runs
end

--- Returns a remark on the signs of an item's residuals, in their order; nil if they may be noise.
function fitnoise.signs(name, residuals)
  if #residuals < SHORTEST then return nil end
  local a, b, runs = runs_of(residuals)
  local chance = fitnoise.runs_chance(a, b, runs)
  if chance >= RARE then return nil end
  return ("the residuals of %s are not random: they change sign %s in %d (chance %.1g); the model "
    .. "lacks an effect, and intervals are too narrow"):format(name, counted(runs - 1, "time"),
    #residuals, chance)
end

--- Returns the chance of a sum of squares as large, and a remark or nil.
function fitnoise.sum(chi2, freedom)
  if freedom < 1 then return nil end
  local chance = core.chi2_above(chi2, freedom)
  local times = math.sqrt(chi2 / freedom)
  if chance < RARE then
    return chance, ("residuals are %.3g times as large as sigma (chance %.1g): the model or sigma is wrong, "
      .. "and intervals are too narrow"):format(times, chance)
  elseif 1 - chance < RARE then
    return chance, ("residuals are only %.2g times sigma (chance %.1g): sigma is too large, and so are "
      .. "intervals"):format(times, 1 - chance)
  end
  return chance
end

return fitnoise
