-- SPDX-License-Identifier: GPL-3.0-or-later
-- The sparse solver: solutions against dense products for chains with links, pivot
-- signs against those of dominant diagonals, sparsity of the factor.
local probe = require "softworld.probe"

-- A chain with two neighbours each way and `links` more random pairs, or the pairs that links(pair) gives.
-- Returns the blocks as flat lists and the whole matrix as dense rows.
local function random_matrix(n, b, links, sign)
  local dense, own, pairs, values = {}, {}, {}, {}
  for i = 1, b * n do
    dense[i] = {}
    for j = 1, b * n do dense[i][j] = 0 end
  end
  for node = 0, n - 1 do
    for i = 1, b do
      for j = i, b do
        local value = i == j and sign(node) * (12 + math.random()) or math.random() - 0.5
        dense[b * node + i][b * node + j], dense[b * node + j][b * node + i] = value, value
      end
    end
    for i = 1, b do
      for j = 1, b do own[#own + 1] = dense[b * node + i][b * node + j] end
    end
  end
  local function pair(p, q)
    pairs[#pairs + 1], pairs[#pairs + 2] = p, q
    for i = 1, b do
      for j = 1, b do
        local value = 0.4 * (math.random() - 0.5)
        values[#values + 1] = value
        dense[b * p + i][b * q + j] = dense[b * p + i][b * q + j] + value
        dense[b * q + j][b * p + i] = dense[b * q + j][b * p + i] + value
      end
    end
  end
  for i = 0, n - 2 do
    pair(i, i + 1)
    if i + 2 < n then pair(i, i + 2) end
  end
  if type(links) == "function" then links(pair) end
  for _ = 1, tonumber(links) or 0 do -- both ways round, and some twice
    local p, q = math.random(0, n - 1), math.random(0, n - 1)
    if p ~= q then pair(p, q) end
  end
  return dense, own, pairs, values
end

local function check(n, b, links, sign)
  local dense, own, pairs, values = random_matrix(n, b, links, sign)
  local x, right = {}, {}
  for i = 1, b * n do x[i] = math.random() - 0.5 end
  for i = 1, b * n do
    right[i] = 0
    for j = 1, b * n do right[i] = right[i] + dense[i][j] * x[j] end
  end
  local solved, negative, fill = probe.sparse(b, own, pairs, values, right)
  for i = 1, b * n do assert.is_true(math.abs(solved[i] - x[i]) < 1e-11, "n = " .. n) end
  return negative, fill
end

describe("sparse", function()
  it("solves chains with links", function()
    math.randomseed(3)
    for _, b in ipairs{ 3, 4 } do
      for _, n in ipairs{ 1, 2, 3, 10, 40 } do
        for _, links in ipairs{ 0, 1, n } do
          assert.are.equal(0, (check(n, b, n > 1 and links or 0, function() return 1 end)))
        end
      end
    end
  end)

  -- A wire aslant to the axes, 1e7 times as stiff along itself as its mass is across.
  it("solves for a stiff wire in any direction", function()
    local n, stiff, bend, mass = 60, 1e9, 1e3, 1e2
    local d = { 0.48, 0.6, 0.64 }
    local dense = {}
    for i = 1, 3 * n do
      dense[i] = {}
      for j = 1, 3 * n do dense[i][j] = i == j and mass or 0 end
    end
    local function add(weights, first, k)
      for a, wa in ipairs(weights) do
        for b, wb in ipairs(weights) do
          for i = 1, 3 do
            for j = 1, 3 do
              local row, column = 3 * (first + a - 1) + i, 3 * (first + b - 1) + j
              dense[row][column] = dense[row][column] + wa * wb * k(i, j)
            end
          end
        end
      end
    end
    for e = 0, n - 2 do
      add({ -1, 1 }, e, function(i, j)
        return stiff * d[i] * d[j] + 30 * ((i == j and 1 or 0) - d[i] * d[j])
      end)
      if e < n - 2 then
        add({ 1, -2, 1 }, e, function(i, j) return bend * ((i == j and 1 or 0) - d[i] * d[j]) end)
      end
    end
    local own, pairs, values, x, right = {}, {}, {}, {}, {}
    local function block(p, q, into)
      for i = 1, 3 do
        for j = 1, 3 do into[#into + 1] = dense[3 * p + i][3 * q + j] end
      end
    end
    for p = 0, n - 1 do
      block(p, p, own)
      for q = p + 1, math.min(p + 2, n - 1) do
        pairs[#pairs + 1], pairs[#pairs + 2] = p, q
        block(p, q, values)
      end
    end
    for i = 1, 3 * n do x[i] = math.sin(i) end
    for i = 1, 3 * n do
      right[i] = 0
      for j = 1, 3 * n do right[i] = right[i] + dense[i][j] * x[j] end
    end
    local solved, negative = probe.sparse(3, own, pairs, values, right)
    assert.are.equal(0, negative)
    -- rounding of the right-hand side alone: 1e-16 * 1e9 / 1e2 = 1e-9
    for i = 1, 3 * n do assert.is_near(x[i], solved[i], 1e-7) end
  end)

  it("counts negative directions", function()
    math.randomseed(5)
    for _, b in ipairs{ 3, 4 } do
      local negative = check(21, b, 10, function(node) return node % 3 == 0 and -1 or 1 end)
      assert.are.equal(7 * b, negative)
    end
  end)

  -- Wires beside each other, coupled all along: elimination goes from end to end, with dense fronts.
  it("solves bundles and counts their negative directions", function()
    math.randomseed(7)
    local wires, long = 12, 16
    local function across(pair) -- nodes of a wire are numbered one after another
      for i = 0, long - 1 do
        for a = 0, wires - 2 do
          for b = a + 1, math.min(a + 4, wires - 1) do
            for to = i, math.min(i + 1, long - 1) do pair(long * a + i, long * b + to) end
          end
        end
      end
    end
    local function all(sign) return check(wires * long, 3, across, sign) end
    local negative, fill = all(function() return 1 end)
    assert.are.equal(0, negative)
    assert.is_true(fill > 12 * wires * long, fill) -- from this fill on fronts are used
    assert.are.equal(3 * long, (all(function(node) return node < long and -1 or 1 end)))
  end)

  it("keeps the factor of a chain with few links sparse", function()
    math.randomseed(9)
    local _, plain = check(60, 3, 0, function() return 1 end)
    local _, linked = check(60, 3, 5, function() return 1 end)
    assert.is_true(plain <= 2.2 * 60, plain) -- in any good order: 2 blocks a node and few more
    assert.is_true(linked <= plain + 5 * 60, linked)
  end)

  it("refuses a singular matrix and one that is not finite", function()
    local own, zeros = {}, { 0, 0, 0, 0, 0, 0, 0, 0, 0 }
    for i = 1, 18 do own[i] = 0 end
    assert.has_error(function() probe.sparse(3, own, { 0, 1 }, zeros, { 1, 1, 1, 1, 1, 1 }) end)
    for i = 0, 1 do for k = 0, 2 do own[9 * i + 4 * k + 1] = 1 end end
    probe.sparse(3, own, { 0, 1 }, zeros, { 1, 1, 1, 1, 1, 1 })
    own[1] = 0 / 0
    assert.has_error(function() probe.sparse(3, own, { 0, 1 }, zeros, { 1, 1, 1, 1, 1, 1 }) end)
  end)
end)
