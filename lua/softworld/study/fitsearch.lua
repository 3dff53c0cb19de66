-- SPDX-License-Identifier: GPL-3.0-or-later
--- Least squares from one start: Levenberg and Marquardt (GSL) over places from 0 to 1 in each range.
--
-- Bounds use an active set: a step is cut off at them. A parameter on a bound is held there if the sum of
-- squares falls beyond the bound. The search then starts again over the other parameters, and held parameters
-- are released at the end if the sum does not fall beyond their bounds any more. Derivatives are central
-- differences, or one-sided ones of the same order beside a bound, evaluated side by side. A place at which
-- the model fails is worse than all others.
--
-- GSL asks for one value after the other and cannot be interrupted. So the search is repeated with the known
-- values, which takes no time compared with an evaluation, until it needs an unknown value; this is evaluated
-- next.
-- @module softworld.study.fitsearch
local core = require "softworld.core"

local fitsearch = {}

local WORSE = 1e100   -- residuals if the model failed
local ROUNDS = 40     -- most rounds of the active set
local SMALLER = 1 / 16 -- factor on the step of differences if both sides failed

local ASKED, ENDED, MOVED = {}, {}, {} -- raised to leave the search

local Search = {}
Search.__index = Search

--- Returns a search from places; o: steps (of differences), tolerance, most (evaluations), residuals(record)
-- -> list or nil if the evaluation failed, loss (or nil).
function fitsearch.new(places, o) return setmetatable({ start = places, o = o, records = {} }, Search) end

-- Returns the records of places if all are known; else raises ASKED and notes the unknown ones.
local function take(self, places)
  local first = self.at + 1
  self.at = self.at + #places
  if self.at > self.o.most then
    self.reason = "evaluations used up"
    error(ENDED, 0)
  end
  if self.records[self.at] == nil then
    self.wants = {}
    for k, u in ipairs(places) do
      if self.records[first + k - 1] == nil then self.wants[#self.wants + 1] = u end
    end
    error(ASKED, 0)
  end
  return table.move(self.records, first, self.at, 1, {})
end

local function sum_of(r)
  local sum = 0
  for i = 1, #r do sum = sum + r[i] * r[i] end
  return sum
end

-- Returns the residuals, or with a loss numbers whose squares are the loss.
local function for_solver(self, r)
  local loss = self.o.loss
  if not loss then return r end
  local out = {}
  for k = 1, #r do out[k] = loss.root(r[k]) end
  return out
end

-- Returns a record's residuals over the scale of the first residuals, so that tolerances do not depend on
-- units.
local function scaled(self, record)
  local r = self.o.residuals(record)
  if not r then return nil end
  if not self.scale then
    local size = math.sqrt(sum_of(r) / #r)
    self.scale = (self.o.known or size == 0) and 1 or 1 / size
  end
  for i = 1, #r do r[i] = r[i] * self.scale end
  return r
end

local function residuals_at(self, u)
  local record = take(self, { u })[1]
  local r = scaled(self, record)
  local sum = r and sum_of(for_solver(self, r))
  if r and (not self.best or sum < self.best.sum) then
    self.best = { u = u, r = r, sum = sum, record = record }
  end
  return r
end

local function moved(u, i, by)
  local v = table.move(u, 1, #u, 1, {})
  v[i] = v[i] + by
  return v
end

-- Returns two places for the differences of a parameter, as steps from u.
local function sides(u, h)
  if u + h > 1 then return -h, -2 * h end
  if u - h < 0 then return h, 2 * h end
  return h, -h
end

-- Returns d r / d u_i from two places beside u, of which either may have failed.
local function slope(r, a, ra, b, rb)
  if not ra and not rb then return nil end
  local column = {}
  for k = 1, #r do
    if not rb then column[k] = (ra[k] - r[k]) / a
    elseif not ra then column[k] = (rb[k] - r[k]) / b
    elseif a == -b then column[k] = (ra[k] - rb[k]) / (a - b)
    else column[k] = (4 * ra[k] - 3 * r[k] - rb[k]) / b end -- b = 2 a
  end
  return column
end

local function columns_at(self, u, r, list, share)
  local places, steps, columns = {}, {}, {}
  for _, i in ipairs(list) do
    local a, b = sides(u[i], self.o.steps[i] * share)
    places[#places + 1], places[#places + 2] = moved(u, i, a), moved(u, i, b)
    steps[#steps + 1], steps[#steps + 2] = a, b
  end
  local records = take(self, places)
  self.failure = records[1].failed
  for k, i in ipairs(list) do
    columns[i] = slope(r, steps[2 * k - 1], scaled(self, records[2 * k - 1]), steps[2 * k],
      scaled(self, records[2 * k]))
  end
  return columns
end

-- Returns all columns of the derivatives at the best place.
local function derivatives(self)
  local best, all, left = self.best, {}, {}
  if best.columns then return best.columns end
  for i = 1, #best.u do all[i] = i end
  local columns = columns_at(self, best.u, best.r, all, 1)
  for i = 1, #best.u do
    if not columns[i] then left[#left + 1] = i end
  end
  if #left > 0 then
    for i, column in pairs(columns_at(self, best.u, best.r, left, SMALLER)) do columns[i] = column end
  end
  for i = 1, #best.u do
    if not columns[i] then
      self.reason = "all evaluations near the best place failed: " .. tostring(self.failure)
      error(ENDED, 0)
    end
  end
  best.columns = columns
  return columns
end

-- Returns half the derivative of the sum by each parameter.
local function gradient(self)
  local g, r, loss = {}, self.best.r, self.o.loss
  for i, column in ipairs(self.best.columns) do
    g[i] = 0
    for k = 1, #column do
      g[i] = g[i] + column[k] * (loss and loss.root(r[k]) * loss.slope(r[k]) or r[k])
    end
  end
  return g
end

-- Returns the parameters on a bound beyond which the sum falls, as a set, and the others as a list.
local function held(self)
  local g, set, free = gradient(self), {}, {}
  for i, u in ipairs(self.best.u) do
    if u <= 0 and g[i] > 0 or u >= 1 and g[i] < 0 then set[i] = true else free[#free + 1] = i end
  end
  return set, free
end

local function same(a, b)
  for i in pairs(a) do
    if not b[i] then return false end
  end
  for i in pairs(b) do
    if not a[i] then return false end
  end
  return true
end

local function flat(self, free)
  local best, out, loss = self.best, {}, self.o.loss
  for k = 1, #best.r do
    local by = loss and loss.slope(best.r[k]) or 1
    for _, i in ipairs(free) do out[#out + 1] = best.columns[i][k] * by end
  end
  return out
end

-- Returns the function that GSL calls, over the free parameters from the best place.
local function asked(self, set, free)
  local begin, known, rows = self.best.u, self.best.r, #self.best.r
  return function(place, wanted)
    local u, cut = table.move(begin, 1, #begin, 1, {}), false
    for k, i in ipairs(free) do
      local v = place[k] - 1
      u[i] = math.max(0, math.min(1, v))
      cut = cut or u[i] ~= v
    end
    if wanted then -- at a place better than all before
      derivatives(self)
      if cut or not same(held(self), set) then error(MOVED, 0) end
      return flat(self, free)
    end
    local r = known or residuals_at(self, u)
    known = nil
    if r then return for_solver(self, r) end
    local worse = {}
    for k = 1, rows do worse[k] = WORSE end
    return worse
  end
end

-- Does one round; true when the search has ended.
local function round(self, set, free)
  local x = {}
  for k, i in ipairs(free) do x[k] = 1 + self.best.u[i] end -- offset, because steps are relative to x
  local fine, why, how = pcall(core.least_squares, x, asked(self, set, free), #self.best.r,
    self.o.tolerance, self.o.most)
  if not fine and why ~= MOVED then error(why, 0) end
  if not fine then return false end
  self.how = how
  derivatives(self)
  return same(held(self), set)
end

local REASONS = { near = "the wanted accuracy was reached", stuck = "nothing better was found near it",
  used = "evaluations used up" }

local function all(self)
  if not residuals_at(self, self.start) then
    self.reason = "its first evaluation failed"
    return
  end
  for _ = 1, ROUNDS do
    derivatives(self)
    local set, free = held(self)
    self.held = set
    if #free == 0 or self.best.sum == 0 then
      self.how, self.reason = "near", self.best.sum == 0 and "it fits exactly"
        or "all parameters are at the ends of their ranges"
      return
    end
    if round(self, set, free) then
      self.reason = REASONS[self.how]
      return
    end
  end
  self.reason = "it moves to and fro between the ends of ranges"
end

--- Returns the places to evaluate next, or nil when the search has ended. Then best has { u, r (over scale),
-- sum, record, columns }; further fields are scale, held, how, reason.
function Search:ask()
  self.at, self.best, self.scale, self.how, self.reason, self.held = 0, nil, nil, nil, nil, {}
  local fine, why = pcall(all, self)
  if fine or why == ENDED then return nil end
  if why ~= ASKED then error(why, 0) end
  return self.wants
end

return fitsearch
