-- SPDX-License-Identifier: GPL-3.0-or-later
--- Intervals of EI and GJ where the sum of squares is no parabola of their logarithms: every value belongs to
-- the interval whose smallest sum, over the other parameters, is within the quantile of the best one (the
-- profile likelihood). The data may then bound the value on one side only.
-- @module softworld.calibration.profile
local core = require "softworld.core"

local profile = {}

local WITHIN = 0.95  -- share of cases in which an interval holds the truth [-]
local NARROW = 0.5   -- half width of a logarithm up to which the interval of the fit is right [-]
local FIRST = 0.25   -- first step from the best value, of the logarithm [-]
local BETTER = 0.01  -- least fall below the best sum that counts, over the rise to the interval's ends [-]
local LEVEL = 0.3    -- least rise at the ends of the fit's interval, over the right one [-]
local BETWEEN, SHARP = 8, 1e-4 -- parts of the way between two known values, and the finest share of it [-]
local NEAR = 0.01    -- the end of an interval is found within this, of the logarithm [-]

--- Returns the sum of squares of residuals over sigma, of 1 if a group has none. residuals: lists by name.
function profile.sum(groups, residuals)
  local sum = 0
  for _, group in ipairs(groups) do
    for k, r in ipairs(residuals[group.name]) do
      local sigma = type(group.sigma) == "table" and group.sigma[k] or group.sigma or 1
      sum = sum + (r / sigma) ^ 2
    end
  end
  return sum
end

-- Returns the largest sum of squares inside the interval; nil if there is nothing to estimate sigma from.
local function limit(found, groups)
  local best = profile.sum(groups, found.residuals)
  if found.sigma == "given" then return best + core.student((1 + WITHIN) / 2, math.huge) ^ 2 end
  if found.freedom < 1 then return nil end
  return best * (1 + core.student((1 + WITHIN) / 2, found.freedom) ^ 2 / found.freedom)
end

-- Returns the end of the interval between the best value and `stop`, an end of the range; nil if the range
-- ends before.
local function ending(sum_at, most, best, stop)
  local inside, step = math.log(best), stop > best and FIRST or -FIRST
  local last = math.log(stop)
  while true do
    local outside = inside + step
    if (outside - last) * step >= 0 then outside = last end
    if sum_at(math.exp(outside)) > most then
      while math.abs(outside - inside) > NEAR do
        local middle = 0.5 * (inside + outside)
        if sum_at(math.exp(middle)) > most then outside = middle else inside = middle end
      end
      return math.exp(outside) -- outwards, so that the interval is not too narrow
    end
    if outside == last then return nil end
    inside, step = outside, 2 * step
  end
end

--- True if the fit's own interval of a parameter is not to be used. range {low, high}: of the search;
-- sum_at(value): the sum of squares with this value and the others of the fit, which is too small where the
-- differences of the fit went over a jump of the model.
function profile.is_wide(found, groups, name, range, sum_at)
  local q = found.parameters[name]
  if not found.ok then return true end
  for _, held in ipairs(found.at_bound) do
    if held == name then return true end
  end
  if not q.low or q.told == false then return false end
  if q.low <= range[1] or q.high >= range[2] or math.log(q.high / q.low) > 2 * NARROW then return true end
  local best, most = profile.sum(groups, found.residuals), limit(found, groups)
  local least = most and best + LEVEL * (most - best) or 0
  return sum_at(q.low) < least or sum_at(q.high) < least
end

--- Replaces the interval of a parameter in the result of a fit. range {low, high}: of the search;
-- sum_at(value): the smallest sum of squares with this value. low is then 0 and high math.huge where the
-- data give no end; `told` is false if one of them is missing, and `profiled` is set. Returns a value with a
-- smaller sum than the fit's, or nil. Without anything to estimate sigma from, it leaves the interval.
function profile.widen(found, groups, name, range, sum_at)
  local q, best, value = found.parameters[name], profile.sum(groups, found.residuals), nil
  local most = limit(found, groups)
  if not most then return nil end
  local least = best - BETTER * (most - best)
  local function noted(at)
    local sum = sum_at(at)
    if sum < least then least, value = sum, at end
    return sum
  end
  q.low = q.value > range[1] and ending(noted, most, q.value, range[1]) or 0
  q.high = q.value < range[2] and ending(noted, most, q.value, range[2]) or math.huge
  q.profiled, q.told = true, q.low > 0 and q.high < math.huge
  return value
end

-- Returns the smallest value of f between two places, with one minimum between them.
local function smallest(f, a, b)
  while b - a > SHARP do
    local c, d = a + (b - a) / 3, b - (b - a) / 3
    if f(c) < f(d) then b = d else a = c end
  end
  return f(0.5 * (a + b))
end

--- Returns a function(EI) that gives the values of sum_at, and function(GJ): the smallest sum over EI of
-- these values, linear between the known ones, and twist(EI, GJ).
function profile.known(sum_at, twist)
  local list = {}
  local function at(EI)
    local k = 1
    while list[k] and list[k].EI < EI do k = k + 1 end
    if not list[k] or list[k].EI ~= EI then table.insert(list, k, { EI = EI, sum = sum_at(EI) }) end
    return list[k].sum
  end
  local function over(GJ)
    local function total(x) -- x - 1: number of a known value, and the share of the way to the next one
      local k = math.min(#list - 1, math.floor(x))
      local a, b, share = list[k], list[k + 1], x - k
      local sum = share == 0 and a.sum or share == 1 and b.sum or (1 - share) * a.sum + share * b.sum
      return sum + twist(a.EI * (b.EI / a.EI) ^ share, GJ)
    end
    local best, least = 1, math.huge
    for i = 0, (#list - 1) * BETWEEN do
      local sum = total(1 + i / BETWEEN)
      if sum < least then best, least = 1 + i / BETWEEN, sum end
    end
    return smallest(total, math.max(1, best - 1 / BETWEEN), math.min(#list, best + 1 / BETWEEN))
  end
  return at, over
end

return profile
