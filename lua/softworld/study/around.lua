-- SPDX-License-Identifier: GPL-3.0-or-later
--- Explores the surroundings of a minimum: second differences of the result show flat directions, and
-- repeated evaluations of the same place, with other random numbers, show the noise.
-- @module softworld.study.around
local core = require "softworld.core"
local judge = require "softworld.study.judge"
local minimum = require "softworld.study.minimum"
local parameters = require "softworld.study.parameters"

local around = {}
around.__index = around

local STEP = 0.02     -- of a difference, over the range
local CROSSED = 10    -- most parameters for mixed differences
local REPEATS = 8     -- further evaluations of the same place, if the first one shows noise
local FLAT = 1e-4     -- largest curvature of a flat direction over the strongest
local SAME = 1e-9     -- relative change of a value that counts as none
local NEAR = 1e-3     -- relative distance from a limit that counts as reached

-- --- what is evaluated ---------------------------------------------------------------------------

-- Returns the parameters that are moved: { index, place, two steps of the place in units of STEP }.
local function axes_of(own, values)
  local axes = {}
  for i, p in ipairs(own.parameters) do
    if p.kind == "number" then
      local u = parameters.place(p, values[i])
      axes[#axes + 1] = { index = i, name = p.name, place = u,
        steps = u < STEP and { 1, 2 } or u > 1 - STEP and { -1, -2 } or { 1, -1 } }
    end
  end
  return axes
end

local function moved(self, a, step_a, b, step_b)
  local values = table.move(self.values, 1, #self.values, 1, {})
  values[a.index] = parameters.at(self.own.parameters[a.index], a.place + step_a * STEP)
  if b then values[b.index] = parameters.at(self.own.parameters[b.index], b.place + step_b * STEP) end
  return values
end

local function add(self, key, values) self.list[#self.list + 1] = { key = key, values = values } end

local function repeat_it(self)
  for k = 2, math.min(1 + REPEATS, self.left - #self.list + 1) do
    add(self, "again " .. k, self.values)
  end
end

local function plan(self)
  add(self, "again 1", self.values)
  for i, a in ipairs(self.axes) do
    for k, step in ipairs(a.steps) do add(self, i .. " " .. k, moved(self, a, step)) end
  end
  for i, a in ipairs(#self.axes <= CROSSED and self.axes or {}) do
    for j = 1, i - 1 do
      local b = self.axes[j]
      add(self, i .. " x " .. j, moved(self, a, a.steps[1], b, b.steps[1]))
    end
  end
end

--- Returns how many evaluations to keep for this; a search with noisy values uses up all it is given.
function around.reserve(own, o)
  local n = #own.parameters
  local wanted = 1 + REPEATS + 2 * n + (n <= CROSSED and n * (n - 1) // 2 or 0)
  return o.around and o.noise and 4 * wanted <= o.evaluations and wanted or 0
end

--- Called after all starts. o.around, o.evaluations; list: records so far; highest: their highest number;
-- center: a place to use instead of the best one, for noisy values.
function around.begin(own, result, o, list, highest, center)
  local self = setmetatable({ own = own, result = result, list = {}, at = 0, told = 0, highest = highest,
    got = {} }, around)
  self.left = o.evaluations - #list
  self.best = o.around and minimum.best(own, result, list)
  if not self.best then return self end
  self.center, self.values = center or nil, self.best.values
  if center then self.values = parameters.all_at(own.parameters, center) end
  self.axes = axes_of(own, self.values)
  plan(self)
  if center then repeat_it(self) end
  if #self.list > self.left then self.list, self.center = {}, nil end
  return self
end

function around:next()
  local item = self.list[self.at + 1]
  if not item then return nil end
  self.at = self.at + 1
  return self.highest + self.at, item.values
end

function around:done(record)
  local item = self.list[record.number - self.highest]
  self.told = self.told + 1
  self.got[item.key] = record
  if item.key ~= "again 1" or self.center then return end
  local same = record.results and judge.value(self.own, self.result, record)
    == judge.value(self.own, self.result, self.best)
  if same then return end
  repeat_it(self)
end

--- Returns the record that stands for the place, once all are known: the best, or for a center the first that
-- passes; nil if less than half of them pass.
function around:record()
  if not self.center then return self.best end
  local first, passed, count = nil, 0, 0
  while self.got["again " .. count + 1] do
    count = count + 1
    local record = self.got["again " .. count]
    if judge.pass(self.own, record) then first, passed = first or record, passed + 1 end
  end
  return 2 * passed > count and first or nil
end

-- --- what it says --------------------------------------------------------------------------------

local function value_at(self, key)
  local record = self.got[key]
  return record and record.results and judge.value(self.own, self.result, record)
end

--- Returns the noise at the best place: { checked =, mean =, error = standard error, deviation =, repeats =,
-- failed =, broken = }; nil if the place has given the same value again. checked = false: it was not computed
-- again.
function around:noise()
  local values, n = {}, 0
  local noise = { checked = self.got["again 1"] ~= nil, repeats = 0, failed = 0, broken = 0 }
  while self.got["again " .. n + 1] do
    n = n + 1
    local record = self.got["again " .. n]
    if not record.results then noise.failed = noise.failed + 1
    else
      values[#values + 1] = judge.value(self.own, self.result, record)
      if not judge.pass(self.own, record) then noise.broken = noise.broken + 1 end
    end
  end
  if n == 0 then return noise end
  if n == 1 and values[1] == judge.value(self.own, self.result, self.best) then return nil end
  local sum, square = 0, 0
  for _, v in ipairs(values) do sum = sum + v end
  noise.repeats, noise.mean = n, #values > 0 and sum / #values or nil
  for _, v in ipairs(values) do square = square + (v - noise.mean) ^ 2 end
  noise.deviation = #values > 1 and math.sqrt(square / (#values - 1)) or nil
  noise.error = noise.deviation and noise.deviation / math.sqrt(#values)
  return noise
end

-- True if the axis changes neither the result nor a limit.
local function is_idle(self, i, center, borne)
  local sides, known = judge.sides(self.own, self:record()), false
  for k = 1, 2 do
    local record = self.got[i .. " " .. k]
    local value = value_at(self, i .. " " .. k)
    if record and not value then return false end
    if value then
      known = true
      if math.abs(value - center) > borne then return false end
      for s, side in ipairs(judge.sides(self.own, record)) do
        if math.abs(side - sides[s]) > SAME * math.max(1, math.abs(side)) then return false end
      end
    end
  end
  return known
end

-- Returns second differences over axes that are not idle, as a list of rows; nil if one is not known.
local function curvature(self, list, center)
  local h = {}
  for r, i in ipairs(list) do
    local a = self.axes[i]
    local one, two = value_at(self, i .. " 1"), value_at(self, i .. " 2")
    if not (one and two) then return nil end
    h[(r - 1) * #list + r] = a.steps[2] == -a.steps[1] and one - 2 * center + two or two - 2 * one + center
    for s = 1, r - 1 do
      local j = list[s]
      local both, other = value_at(self, i .. " x " .. j), value_at(self, j .. " 1")
      if not (both and other) then return nil end
      local mixed = (both - one - other + center) / (a.steps[1] * self.axes[j].steps[1])
      h[(r - 1) * #list + s], h[(s - 1) * #list + r] = mixed, mixed
    end
  end
  return h
end

-- True if the best place is away from all limits and bounds. Only there curvature alone decides.
local function is_inside(self, list)
  for _, side in ipairs(judge.sides(self.own, self:record())) do
    if side > -NEAR then return false end
  end
  for _, i in ipairs(list) do
    if self.axes[i].steps[2] ~= -self.axes[i].steps[1] then return false end
  end
  return true
end

--- Returns flat directions: a list of { name = share of its range, ... }, each of length 1; idle parameters
-- first.
function around:flat()
  local flat, rest = {}, {}
  if not self.best or self.told == 0 or not self:record() then return nil end
  local center, noise = judge.value(self.own, self.result, self:record()), self:noise()
  local borne = noise and noise.deviation and 2 * noise.deviation or SAME * math.abs(center)
  if noise and noise.mean then center = noise.mean end
  for i, a in ipairs(self.axes) do
    if is_idle(self, i, center, borne) then flat[#flat + 1] = { [a.name] = 1.0 } else rest[#rest + 1] = i end
  end
  local h = #rest > 1 and is_inside(self, rest) and curvature(self, rest, center)
  if not h then return flat end
  local values, vectors = core.eigen(h, #rest)
  local most = values[#rest]
  for k, value in ipairs(values) do
    if most > 4 * borne and math.abs(value) <= math.max(FLAT * most, 2 * borne) then
      local direction = {}
      for r, i in ipairs(rest) do direction[self.axes[i].name] = vectors[k][r] end
      flat[#flat + 1] = direction
    end
  end
  return flat
end

return around
