-- SPDX-License-Identifier: GPL-3.0-or-later
--- How often a model meets its constraints when its parameters vary: drawn at random, evenly over their
-- ranges (of log ones over the logarithm), or normally about start where sigma is given, within the range.
-- @module softworld.study.spread
local checks = require "softworld.checks"
local design = require "softworld.study.design"
local judge = require "softworld.study.judge"
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"

local spread = {}

local Z = 1.959963984540054 -- of the normal distribution, 97.5 % lie below it
local WORST = 5             -- rows that are told
local TRIES = 1000          -- for a normal number within the range

-- Box and Muller 1958.
local function normal(random)
  return math.sqrt(-2 * math.log(1 - random())) * math.cos(2 * math.pi * random())
end

local function draw(p, random)
  if not p.sigma then return parameters.at(p, random()) end
  local mean = p.start or 0.5 * (p.low + p.high)
  for _ = 1, TRIES do
    local value = mean + p.sigma * normal(random)
    if value >= p.low and value <= p.high then return value end
  end
  return mean
end

--- A function from the number of an evaluation to its values, which depend on nothing else.
function spread.drawing(own)
  return function(number)
    local random, values = design.generator(own.seed, own.stream, number), {}
    for i, p in ipairs(own.parameters) do values[i] = draw(p, random) end
    return values
  end
end

--- The interval that holds a probability in 95 of 100 cases, when passed of count trials passed (E. B. Wilson
-- 1927): low, high.
function spread.wilson(passed, count)
  if count == 0 then return 0, 1 end
  local share, z2 = passed / count, Z * Z / count
  local middle, half = share + z2 / 2, Z * math.sqrt((share * (1 - share) + z2 / 4) / count)
  return passed == 0 and 0 or (middle - half) / (1 + z2), passed == count and 1 or (middle + half) / (1 + z2)
end

local Spread = { __name = "spread" }
Spread.__index = checks.fields("spread", "probability low high count passed broken failed left_out worst")

function Spread.__tostring(s)
  local shape = "%.2f %% pass (95 %% interval %.2f to %.2f %%): %d of %d; %d break constraints, %d failed"
  local lines = { shape:format(100 * s.probability, 100 * s.low, 100 * s.high, s.passed, s.count, s.broken,
    s.failed) }
  if s.left_out > 0 then
    lines[2] = ("  %d ended by the machine are left out"):format(s.left_out)
  end
  return table.concat(lines, "\n")
end

-- The rows that come nearest to the limits or break them most, worst first.
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

--- What the records say. Those that failed did not pass; what the machine ended says nothing.
function spread.result(own, records)
  local list = judge.sorted(records)
  local s = { passed = 0, broken = 0, failed = 0, left_out = 0 }
  for _, record in ipairs(list) do
    local kind = record.machine and "left_out" or not record.results and "failed"
      or judge.pass(own, record) and "passed" or "broken"
    s[kind] = s[kind] + 1
  end
  s.count = #list - s.left_out
  s.probability = s.passed / s.count
  s.low, s.high = spread.wilson(s.passed, s.count)
  s.worst = worst_of(own, list)
  setmetatable(s, Spread)
  own.asked[own.part].says = tostring(s)
  return s
end

return spread
