-- SPDX-License-Identifier: GPL-3.0-or-later
--- A polynomial of degree 2 through values at places, by least squares.
-- @module softworld.study.quadratic
local core = require "softworld.core"

local quadratic = {}

local RIDGE = 1e-12 -- against directions of which the values tell nothing, as a share of the largest

-- 1, coordinates, their products.
local function terms(x)
  local row = { 1 }
  for i = 1, #x do row[#row + 1] = x[i] end
  for i = 1, #x do
    for j = 1, i do row[#row + 1] = x[i] * x[j] end
  end
  return row
end

--- How many coefficients it has in n dimensions.
function quadratic.count(n) return (n + 1) * (n + 2) // 2 end

-- Solve a symmetric matrix, positive but for chance, by its eigenvectors.
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

--- Coefficients; places: lists of coordinates, values: numbers, weights: of each, 1 without.
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

--- The polynomial's value at a place.
function quadratic.at(coefficients, place)
  local sum = 0
  for i, t in ipairs(terms(place)) do sum = sum + coefficients[i] * t end
  return sum
end

--- Where it is smallest; nil where it has no smallest value.
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
