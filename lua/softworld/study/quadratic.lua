-- SPDX-License-Identifier: GPL-3.0-or-later
--- Fits a polynomial of degree 2 through values at places, by least squares.
-- @module softworld.study.quadratic
local core = require "softworld.core"

local quadratic = {}

local RIDGE = 1e-12 -- regularisation of directions that the values do not determine, over the largest

-- Returns 1, the coordinates, and their products.
local function terms(x)
  local row = { 1 }
  for i = 1, #x do row[#row + 1] = x[i] end
  for i = 1, #x do
    for j = 1, i do row[#row + 1] = x[i] * x[j] end
  end
  return row
end

--- Returns the number of coefficients in n dimensions.
function quadratic.count(n) return (n + 1) * (n + 2) // 2 end

-- Solves with a symmetric matrix, positive except for rounding, by its eigenvectors.
local function solve(matrix, n, right)
  local values, vectors = core.eigen(matrix, n)
  local x = {}
  for i = 1, n do x[i] = 0 end
  for k, vector in ipairs(vectors) do
    local along = 0
    for i, v in ipairs(vector) do along = along + v * right[i] end
    along = along / (math.max(values[k], 0) + RIDGE * values[n])
    for i, v in ipairs(vector) do x[i] = x[i] + along * v end
  end
  return x
end

--- Returns the coefficients; places: lists of coordinates, values: numbers, weights: one each, default 1.
function quadratic.fit(places, values, weights)
  local n = quadratic.count(#places[1])
  local matrix, right = {}, {}
  for k = 1, n * n do matrix[k] = 0 end
  for k = 1, n do right[k] = 0 end
  for r, place in ipairs(places) do
    local row, weight = terms(place), weights and weights[r] or 1
    for i = 1, n do
      local wi = weight * row[i]
      right[i] = right[i] + wi * values[r]
      for j = 1, n do matrix[(i - 1) * n + j] = matrix[(i - 1) * n + j] + wi * row[j] end
    end
  end
  return solve(matrix, n, right)
end

--- Returns the polynomial's value at a place.
function quadratic.at(coefficients, place)
  local sum = 0
  for i, t in ipairs(terms(place)) do sum = sum + coefficients[i] * t end
  return sum
end

--- Returns the place of the smallest value; nil if there is none.
function quadratic.lowest(coefficients, n)
  local matrix, at = {}, n + 1
  for i = 1, n do
    for j = 1, i do
      at = at + 1
      local h = i == j and 2 * coefficients[at] or coefficients[at]
      matrix[(i - 1) * n + j], matrix[(j - 1) * n + i] = h, h
    end
  end
  local values, vectors = core.eigen(matrix, n)
  local x = {}
  for i = 1, n do x[i] = 0 end
  if values[1] <= 1e-6 * math.abs(values[n]) then return nil end
  for k, vector in ipairs(vectors) do
    local along = 0
    for i, v in ipairs(vector) do along = along - v * coefficients[1 + i] end
    for i, v in ipairs(vector) do x[i] = x[i] + along / values[k] * v end
  end
  return x
end

return quadratic
