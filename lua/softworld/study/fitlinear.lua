-- SPDX-License-Identifier: GPL-3.0-or-later
--- How well residuals determine parameters: covariance from the singular values of their derivatives, and the
-- directions that they do not determine.
--
-- Derivatives are over places u from 0 to 1 in each range, residuals over their standard deviation. Each
-- column is scaled to length 1. A direction with a singular value below 1e-4 of the largest, about ten times
-- the error of differences, counts as without effect on the measured data.
-- @module softworld.study.fitlinear
local core = require "softworld.core"

local fitlinear = {}

local LEAST = 1e-4  -- least singular value that counts, over the largest
local SHARE = 0.01  -- least part of a parameter in a direction, over the largest part

local function length(column)
  local sum = 0
  for k = 1, #column do sum = sum + column[k] * column[k] end
  return math.sqrt(sum)
end

-- Reduces directions (a list of lists) so that each has a parameter which no other has. This shows which
-- parameters belong together.
local function reduce(list, n)
  local row = 1
  for _ = 1, #list do
    local at, most, from = nil, 0, nil
    for j = row, #list do
      for i = 1, n do
        local size = math.abs(list[j][i])
        if size > most * (1 + 1e-9) then at, most, from = i, size, j end
      end
    end
    if not at then break end
    list[row], list[from] = list[from], list[row]
    for j, other in ipairs(list) do
      local share = j ~= row and other[at] / list[row][at] or 0
      for i = 1, n do other[i] = other[i] - share * list[row][i] end
    end
    row = row + 1
  end
  return list
end

-- Removes parts that are only errors of differences.
local function clean(direction)
  local most = 0
  for _, part in ipairs(direction) do most = math.max(most, math.abs(part)) end
  for i, part in ipairs(direction) do
    if math.abs(part) < SHARE * most then direction[i] = 0 end
  end
  return direction
end

local function decompose(columns)
  local n, rows, norms, matrix, most = #columns, #columns[1], {}, {}, 0
  for i, column in ipairs(columns) do
    norms[i] = length(column)
    most = math.max(most, norms[i])
  end
  for i = 1, n do norms[i] = norms[i] > LEAST * LEAST * most and norms[i] or 0 end
  for k = 1, rows do
    for i = 1, n do matrix[#matrix + 1] = norms[i] > 0 and columns[i][k] / norms[i] or 0 end
  end
  local s, v = core.singular(matrix, rows, n)
  return norms, s, v
end

--- columns: lists, one per parameter, with at least as many rows. Returns the covariance C[i][j] of u for
-- residuals of deviation 1 (of determined directions), and the undetermined directions as a list of lists of
-- u.
function fitlinear.covariance(columns)
  local n = #columns
  local norms, s, v = decompose(columns)
  local C, lost = {}, {}
  for i = 1, n do
    C[i] = {}
    for j = 1, n do C[i][j] = 0 end
  end
  for k = 1, n do
    local direction = {} -- in u
    for i = 1, n do direction[i] = v[(i - 1) * n + k] / (norms[i] > 0 and norms[i] or 1) end
    if s[k] > LEAST * s[1] then
      for i = 1, n do
        for j = 1, n do C[i][j] = C[i][j] + direction[i] * direction[j] / s[k] ^ 2 end
      end
    else
      for i = 1, n do direction[i] = norms[i] > 0 and direction[i] or v[(i - 1) * n + k] end
      lost[#lost + 1] = direction
    end
  end
  reduce(lost, n)
  for _, direction in ipairs(lost) do clean(direction) end
  return C, lost
end

--- Returns the remaining Gauss-Newton step, -C J' r.
function fitlinear.step(columns, r, C)
  local g, step = {}, {}
  for i, column in ipairs(columns) do
    g[i] = 0
    for k = 1, #r do g[i] = g[i] + column[k] * r[k] end
  end
  for i = 1, #columns do
    step[i] = 0
    for j = 1, #columns do step[i] = step[i] - C[i][j] * g[j] end
  end
  return step
end

return fitlinear
