-- SPDX-License-Identifier: GPL-3.0-or-later
-- The band solver with four unknowns a node: solutions against the product, pivot
-- signs against those of dominant diagonals.
local probe = require "softworld.probe"

-- Returns a dense matrix in the solver's form.
local function rows_of(dense, n)
  local rows = {}
  for node = 0, n - 1 do
    for block = 0, 2 do
      for i = 1, 4 do
        for j = 1, 4 do
          local row = dense[4 * node + i]
          rows[48 * node + 16 * block + 4 * (i - 1) + j] = row[4 * (node + block) + j] or 0
        end
      end
    end
  end
  return rows
end

-- A random symmetric matrix as dense rows.
local function random_matrix(n, sign)
  local size, dense = 4 * n, {}
  for i = 1, size do dense[i] = {} end
  for i = 1, size do
    for j = i, size do
      local apart = (j - 1) // 4 - (i - 1) // 4
      local value = apart > 2 and 0 or 0.4 * (math.random() - 0.5)
      if i == j then value = sign((i - 1) // 4) * (4 + math.random()) end
      dense[i][j], dense[j][i] = value, value
    end
  end
  return dense
end

local function check(n, dense, wanted, tolerance)
  local x, right = {}, {}
  for i = 1, 4 * n do x[i] = math.random() - 0.5 end
  for i = 1, 4 * n do
    right[i] = 0
    for j = 1, 4 * n do right[i] = right[i] + dense[i][j] * x[j] end
  end
  local solved, negative = probe.band4(rows_of(dense, n), right)
  for i = 1, 4 * n do
    assert.is_true(math.abs(solved[i] - x[i]) < (tolerance or 1e-11), "n = " .. n)
  end
  assert.are.equal(wanted, negative)
end

describe("band4", function()
  it("inverts a product", function()
    math.randomseed(7)
    for _, n in ipairs{ 2, 3, 4, 5, 10, 33 } do
      check(n, random_matrix(n, function() return 1 end), 0)
    end
  end)

  -- A wire aslant to the axes, 1e7 times as stiff along itself as its mass is across, with spins that go
  -- with it. The error that remains is rounding of the right-hand side, 1e-16 * 1e9 / 1e2.
  it("solves for a stiff wire in any direction", function()
    local stiff, bend, mass, d = 1e9, 1e3, 1e2, { 0.48, 0.6, 0.64 }
    for _, n in ipairs{ 20, 61 } do
      local dense = {}
      for i = 1, 4 * n do
        dense[i] = {}
        for j = 1, 4 * n do dense[i][j] = i == j and mass or 0 end
      end
      local function add(weights, first, along, across, spin)
        for a, wa in ipairs(weights) do
          for b, wb in ipairs(weights) do
            for i = 1, 4 do
              for j = 1, 4 do
                local value = i < 4 and j < 4
                    and along * d[i] * d[j] + across * ((i == j and 1 or 0) - d[i] * d[j])
                  or i == 4 and j == 4 and spin or spin * 0.1
                local row, column = dense[4 * (first + a - 1) + i], 4 * (first + b - 1) + j
                row[column] = row[column] + wa * wb * value
              end
            end
          end
        end
      end
      for e = 0, n - 2 do
        add({ -1, 1 }, e, stiff, 30, 50)
        if e < n - 2 then add({ 1, -2, 1 }, e, 0, bend, 0) end
      end
      check(n, dense, 0, 1e-7)
    end
  end)

  it("counts negative directions", function()
    math.randomseed(11)
    for _, n in ipairs{ 2, 3, 7, 10 } do
      check(n, random_matrix(n, function(node) return node % 2 == 0 and -1 or 1 end),
        4 * ((n + 1) // 2))
    end
  end)

  it("refuses a singular matrix and one that is not finite", function()
    local rows, right = {}, { 1, 1, 1, 1, 1, 1, 1, 1 }
    for i = 1, 96 do rows[i] = 0 end
    assert.has_error(function() probe.band4(rows, right) end)
    for i = 0, 1 do for k = 0, 3 do rows[48 * i + 5 * k + 1] = 1 end end
    probe.band4(rows, right)
    rows[1] = 0 / 0
    assert.has_error(function() probe.band4(rows, right) end)
  end)
end)
