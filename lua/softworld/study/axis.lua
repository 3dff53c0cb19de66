-- SPDX-License-Identifier: GPL-3.0-or-later
--- Handles one parameter of a study alone: round values over its range and about the present one, the slope
-- of a result with its error, and the search for the value from which something passes.
-- @module softworld.study.axis
local parameters = require "softworld.study.parameters"

local axis = {}

local STEP = 0.025 -- of a difference, over the range [-]
local FINE = 100   -- round values are multiples of a power of ten below this part of the range [-]
local T = { 12.71, 4.30, 3.18, 2.78 } -- Student's factor of 95 % by degrees of freedom [-]

-- --- values --------------------------------------------------------------------------------------

--- Returns a round value near the given one, within the range.
function axis.round(p, value)
  if p.kind ~= "number" then return math.tointeger(math.max(p.low, math.min(p.high, value // 1))) end
  local size = p.log and math.abs(value) or p.high - p.low
  local unit = math.floor(math.log(size / FINE, 10) + 1e-9)
  local text = ("%.12g"):format(math.floor(value / 10.0 ^ unit + 0.5) * 10.0 ^ unit)
  return math.max(p.low, math.min(p.high, tonumber(text) + 0.0))
end

--- Returns about `count` round values over the range, both ends included, in order; for choices all.
function axis.scan(p, count)
  local list, seen = {}, {}
  if p.kind == "choice" then count = #p.choices end
  for k = 1, count do
    local value = p.kind == "choice" and k or parameters.at(p, (k - 1) / (count - 1))
    if p.kind ~= "choice" and k > 1 and k < count then value = axis.round(p, value) end
    if not seen[value] then list[#list + 1] = value end
    seen[value] = true
  end
  return list
end

--- Returns values for differences about a value: four others, two on each side if the range has them.
function axis.around(p, value)
  if p.kind == "choice" then return {} end
  local here, step, list, seen = parameters.place(p, value), STEP, {}, { [value] = true }
  if p.kind == "integer" then step = math.max(STEP, 1 / (p.high - p.low)) end
  for _, k in ipairs{ 1, -1, 2, -2, 3, -3, 4, -4 } do
    local u = here + k * step
    if u >= -1e-12 and u <= 1 + 1e-12 and #list < 4 then
      local other = parameters.at(p, math.max(0, math.min(1, u)))
      if p.kind == "integer" and not p.log then other = math.tointeger(value + k * math.max(1,
        (STEP * (p.high - p.low)) // 1)) end
      if other and p.kind == "number" then other = axis.round(p, other) end
      if other and not seen[other] and other >= p.low and other <= p.high then list[#list + 1] = other end
      if other then seen[other] = true end
    end
  end
  return list
end

-- --- slopes --------------------------------------------------------------------------------------

-- Solves a 3 by 3 system by elimination with pivots, for two right sides; nil if it has no solution.
local function solve(a)
  for i = 1, 3 do
    local pivot = i
    for r = i + 1, 3 do
      if math.abs(a[r][i]) > math.abs(a[pivot][i]) then pivot = r end
    end
    a[i], a[pivot] = a[pivot], a[i]
    if a[i][i] == 0 then return nil end
    for r = 1, 3 do
      local factor = r ~= i and a[r][i] / a[i][i] or 0
      for c = i, 5 do a[r][c] = a[r][c] - factor * a[i][c] end
    end
  end
  return { a[1][4] / a[1][1], a[2][4] / a[2][2], a[3][4] / a[3][3] }, a[2][5] / a[2][2]
end

-- Returns the sums for least squares of y = c1 + c2 x + c3 x^2; the last column gives the inverse's second
-- one.
local function normal_equations(points)
  local a = { { 0, 0, 0, 0, 0 }, { 0, 0, 0, 0, 1 }, { 0, 0, 0, 0, 0 } }
  for _, p in ipairs(points) do
    for r = 1, 3 do
      for c = 1, 3 do a[r][c] = a[r][c] + p[1] ^ (r + c - 2) end
      a[r][4] = a[r][4] + p[1] ^ (r - 1) * p[2]
    end
  end
  return a
end

--- Returns the slope at x = 0 of the parabola that fits points { x, y } best, and its error from the
-- residuals (95 %) and from an error of each y. nil with fewer than 4 points.
function axis.slope(points, error_of_y)
  if #points < 4 then return nil end
  local size = 0
  for _, p in ipairs(points) do size = math.max(size, math.abs(p[1])) end
  local scaled = {}
  for i, p in ipairs(points) do scaled[i] = { p[1] / size, p[2] } end
  local c, variance = solve(normal_equations(scaled))
  if not c then return nil end
  local sum = 0
  for _, p in ipairs(scaled) do sum = sum + (p[2] - c[1] - c[2] * p[1] - c[3] * p[1] ^ 2) ^ 2 end
  local deviation = math.sqrt(sum / (#points - 3))
  return c[2] / size, (T[math.min(#points - 3, #T)] * deviation * math.sqrt(variance) + error_of_y) / size,
    deviation
end

-- --- where it begins to pass ---------------------------------------------------------------------

--- Returns the next value of a hunt { bad =, good = }, each { value =, lacks = what it lacks (below 0: what
-- it has to spare), or nil }; nil if the two are near enough. It alternates between linear interpolation and
-- the middle.
function axis.between(p, hunt)
  if p.kind == "choice" then return nil end
  local bad, good, share = hunt.bad, hunt.good, 0.5
  if bad.lacks and good.lacks and bad.lacks > 0 and good.lacks <= 0 and not hunt.halve then
    share = math.max(0.1, math.min(0.9, bad.lacks / (bad.lacks - good.lacks) + 0.02))
  end
  hunt.halve = not hunt.halve
  local from, to = parameters.place(p, bad.value), parameters.place(p, good.value)
  if math.abs(to - from) <= 1 / FINE then return nil end
  local value = axis.round(p, parameters.at(p, from + share * (to - from)))
  if value == bad.value or value == good.value then return nil end
  return value
end

return axis
