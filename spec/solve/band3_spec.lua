-- SPDX-License-Identifier: GPL-3.0-or-later
-- The block band solver: solutions against the product, pivot signs against the
-- signs of a matrix that is diagonal in a known basis.
local probe = require "softworld.probe"

-- Round-off of a solve with condition numbers up to about 1e3.
local TOLERANCE = 1e-11

local upper = { { 1, 2, 3 }, { 2, 4, 5 }, { 3, 5, 6 } }

-- A random symmetric block band matrix: rows as the solver wants them. The
-- diagonal dominates, with the sign that sign(i) gives node i.
local function random_rows(n, sign)
  local rows = {}
  for i = 0, n - 1 do
    for k = 1, 24 do rows[24 * i + k] = 0.4 * (math.random() - 0.5) end
    local signed = sign(i)
    for k = 1, 3 do rows[24 * i + upper[k][k]] = signed * (4 + math.random()) end
    for k = 1, 9 do
      if i + 1 >= n then rows[24 * i + 6 + k] = 0 end
      if i + 2 >= n then rows[24 * i + 15 + k] = 0 end
    end
  end
  return rows
end

local function largest_difference(a, b)
  local d = 0
  for i = 1, #a do d = math.max(d, math.abs(a[i] - b[i])) end
  return d
end

describe("band3", function()
  it("inverts its product, for every small count of nodes and a large one", function()
    math.randomseed(7)
    for _, n in ipairs{ 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 33, 1000 } do
      local x = {}
      for i = 1, 3 * n do x[i] = math.random() - 0.5 end
      local rows = random_rows(n, function() return 1 end)
      local _, _, right = probe.band3(rows, x)
      local solved, negative = probe.band3(rows, right)
      assert.is_true(largest_difference(solved, x) < TOLERANCE, "n = " .. n)
      assert.are.equal(0, negative)
    end
  end)

  -- A wire aslant to the axes, 1e7 times as stiff along itself as its mass is across. The error that
  -- remains is rounding of the right-hand side, 1e-16 * 1e9 / 1e2.
  it("solves for a stiff wire in any direction", function()
    local stiff, bend, mass, d = 1e9, 1e3, 1e2, { 0.48, 0.6, 0.64 }
    for _, n in ipairs{ 20, 61, 400 } do
      local rows, x = {}, {}
      for i = 1, 24 * n do rows[i] = 0 end
      local function add(i, k, along, across)
        for r = 1, 3 do
          for c = 1, 3 do
            local value = along * d[r] * d[c] + across * ((r == c and 1 or 0) - d[r] * d[c])
            local at = 24 * i + (k == 0 and upper[r][c] or 6 + 9 * (k - 1) + 3 * (r - 1) + c)
            if k > 0 or c >= r then rows[at] = rows[at] + value end
          end
        end
      end
      for i = 0, n - 1 do
        add(i, 0, mass, mass)
        for e = i - 1, i do
          if e >= 0 and e < n - 1 then add(i, 0, stiff, 30) end
        end
        if i + 1 < n then add(i, 1, -stiff, -30) end
      end
      for i = 1, n - 2 do
        for k, w in ipairs{ 1, 4, 1 } do add(i + k - 2, 0, 0, w * bend) end
        add(i - 1, 1, 0, -2 * bend)
        add(i, 1, 0, -2 * bend)
        add(i - 1, 2, 0, bend)
      end
      for i = 1, 3 * n do x[i] = math.sin(i) end
      local _, _, right = probe.band3(rows, x)
      local solved, negative = probe.band3(rows, right)
      assert.are.equal(0, negative)
      assert.is_true(largest_difference(solved, x) < 1e-7, n .. ": " .. largest_difference(solved, x))
    end
  end)

  it("counts negative directions", function()
    math.randomseed(11)
    for _, n in ipairs{ 2, 3, 4, 7, 10, 25 } do
      for _, every in ipairs{ 1, 2, 3 } do
        local wanted = 0
        local rows = random_rows(n, function(i)
          if i % every == 0 then wanted = wanted + 3 return -1 end
          return 1
        end)
        local x = {}
        for i = 1, 3 * n do x[i] = math.random() end
        local _, _, right = probe.band3(rows, x)
        local solved, negative = probe.band3(rows, right)
        assert.are.equal(wanted, negative, ("n = %d, every %d"):format(n, every))
        assert.is_true(largest_difference(solved, x) < TOLERANCE)
      end
    end
  end)

  it("refuses a singular matrix and one that is not finite", function()
    local rows, right = {}, { 1, 1, 1, 1, 1, 1, 1, 1, 1 }
    for i = 1, 72 do rows[i] = 0 end
    assert.has_error(function() probe.band3(rows, right) end)
    for i = 0, 2 do for k = 1, 3 do rows[24 * i + upper[k][k]] = 1 end end
    probe.band3(rows, right)
    rows[1] = 0 / 0
    assert.has_error(function() probe.band3(rows, right) end)
  end)
end)
