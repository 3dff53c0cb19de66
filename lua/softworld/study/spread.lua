-- SPDX-License-Identifier: GPL-3.0-or-later
--- How often a model meets its constraints when its parameters vary: drawn at random, uniformly over their
-- ranges (log ranges over the logarithm), or normally about start if sigma is given, within the range.
-- @module softworld.study.spread
local checks = require "softworld.checks"
local core = require "softworld.core"
local design = require "softworld.study.design"
local judge = require "softworld.study.judge"
local matters = require "softworld.study.matters"
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"

local spread = {}

local Z = 1.959963984540054 -- 97.5 % point of the normal distribution
local SETS = 8              -- of Sobol's sequence
local STUDENT = 2.3646242515927844 -- 97.5 % point of the t distribution with SETS - 1 degrees of freedom
local WORST = 5             -- rows shown
local TRIES = 1000          -- for a normal number within the range

local function draw(p, random)
  if not p.sigma then return parameters.at(p, random()) end
  local mean = p.start or 0.5 * (p.low + p.high)
  for _ = 1, TRIES do
    local value = mean + p.sigma * design.normal(random)
    if value >= p.low and value <= p.high then return value end
  end
  return mean
end

--- Returns a function from the number of an evaluation to its values, which depend on nothing else.
function spread.drawing(own)
  return function(number)
    local random, values = design.generator(own.seed, own.stream, number), {}
    for i, p in ipairs(own.parameters) do values[i] = draw(p, random) end
    return values
  end
end

-- Returns the value at a share of the distribution.
local function value_at(p, share)
  if not p.sigma then return parameters.at(p, share) end
  local mean = p.start or 0.5 * (p.low + p.high)
  local low = core.normal_below((p.low - mean) / p.sigma)
  local high = core.normal_below((p.high - mean) / p.sigma)
  share = low + share * (high - low)
  if share <= 0 or share >= 1 then return mean end -- the range is far out in a tail
  return math.max(p.low, math.min(p.high, mean + p.sigma * core.normal_at(share)))
end

--- Same by Sobol's sequence, SETS times, each shifted by random numbers (R. Cranley, T. N. L. Patterson
-- 1976): evaluation k is in set (k - 1) % SETS.
function spread.filling(own, count)
  local n, shifts, each = #own.parameters, {}, math.ceil(count / SETS)
  local flat, random = core.quasi("sobol", n, each), design.generator(own.seed, 1976)
  for k = 1, SETS * n do shifts[k] = random() end
  return function(number)
    local set, at, values = (number - 1) % SETS, (number - 1) // SETS, {}
    for i, p in ipairs(own.parameters) do
      values[i] = value_at(p, (flat[at * n + i] + shifts[set * n + i]) % 1)
    end
    return values
  end
end

-- Returns the interval of a probability from the shares of the independent sets (Student's t). nil if all are
-- equal, or a set is empty.
local function of_sets(own, list)
  local passed, count, sum, square = {}, {}, 0, 0
  for set = 1, SETS do passed[set], count[set] = 0, 0 end
  for _, record in ipairs(list) do
    local set = (record.number - 1) % SETS + 1
    if not record.machine then
      count[set], passed[set] = count[set] + 1, passed[set] + (judge.pass(own, record) and 1 or 0)
    end
  end
  for set = 1, SETS do
    if count[set] == 0 then return nil end
    passed[set] = passed[set] / count[set]
    sum = sum + passed[set] / SETS
  end
  for set = 1, SETS do square = square + (passed[set] - sum) ^ 2 end
  if square == 0 then return nil end
  local half = STUDENT * math.sqrt(square / (SETS - 1) / SETS)
  return math.max(0, sum - half), math.min(1, sum + half)
end

--- Returns the 95 % interval of a probability after `passed` of `count` trials (E. B. Wilson 1927): low,
-- high.
function spread.wilson(passed, count)
  if count == 0 then return 0, 1 end
  local share, z2 = passed / count, Z * Z / count
  local middle, half = share + z2 / 2, Z * math.sqrt((share * (1 - share) + z2 / 4) / count)
  return passed == 0 and 0 or (middle - half) / (1 + z2), passed == count and 1 or (middle + half) / (1 + z2)
end

local Spread = { __name = "spread" }
Spread.__index = checks.fields("spread", "probability low high count passed broken failed left_out worst "
  .. "matters")

function Spread.__tostring(s)
  local shape = "%.2f %% pass (95 %% interval %.2f to %.2f %%): %d of %d; %d break constraints, %d failed"
  local lines = { shape:format(100 * s.probability, 100 * s.low, 100 * s.high, s.passed, s.count, s.broken,
    s.failed) }
  if s.left_out > 0 then
    lines[2] = ("  %d ended by the machine are left out"):format(s.left_out)
  end
  for _, name in ipairs(checks.sorted(s.matters)) do
    lines[#lines + 1] = "  " .. matters.text(name, s.matters[name])
  end
  return table.concat(lines, "\n")
end

-- Returns the rows that come nearest to the limits or break them most, worst first.
local function worst_of(own, list)
  local order = {}
  for _, record in ipairs(list) do
    if record.results then
      local _, excess = judge.violation(own, record)
      order[#order + 1] = { record, excess }
    end
  end
  table.sort(order, function(a, b)
    if a[2] == b[2] then return a[1].number < b[1].number end
    return a[2] > b[2]
  end)
  local worst = {}
  for i = 1, math.min(WORST, #order) do worst[i] = output.row(own, order[i][1]) end
  return worst
end

--- Returns the result of the records. Failed ones did not pass; those ended by the machine do not count.
function spread.result(own, records, how)
  local list = judge.sorted(records)
  local s = { passed = 0, broken = 0, failed = 0, left_out = 0 }
  for _, record in ipairs(list) do
    local kind = record.machine and "left_out" or not record.results and "failed"
      or judge.pass(own, record) and "passed" or "broken"
    s[kind] = s[kind] + 1
  end
  s.count = #list - s.left_out
  s.probability = s.passed / s.count
  local low, high
  if how == "sobol" then low, high = of_sets(own, list) end
  if not low then low, high = spread.wilson(s.passed, s.count) end
  s.low, s.high = low, high
  s.worst = worst_of(own, list)
  s.matters = matters.all(own, list)
  setmetatable(s, Spread)
  own.asked[own.part].says = tostring(s)
  return s
end

return spread
