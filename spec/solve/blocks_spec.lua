-- SPDX-License-Identifier: GPL-3.0-or-later
-- Matrices of blocks, in rings and with pairs of nodes: solutions, products and the count of
-- negative directions against dense arithmetic.
local core = require "softworld.core"
local sw = require "softworld"
local probe = require "softworld.probe"

local function rings(count, per_ring) return { rings = count, per_ring = per_ring } end

-- Returns the nodes of rings given by pairs: some pairs turned, some given twice.
local function as_pairs(layout)
  local m, pairs = layout.per_ring, {}
  for i = 0, layout.rings * m - 1 do
    for j = math.max(0, (i // m - 1) * m), i - 1 do
      local turned = (i + j) % 3 == 0
      for _ = 1, (i * j) % 5 == 1 and 2 or 1 do
        pairs[#pairs + 1], pairs[#pairs + 2] = turned and j or i, turned and i or j
      end
    end
  end
  return { nodes = layout.rings * m, pairs = pairs }
end

-- Returns a flat dense matrix of n rows from f(i, j), i >= j.
local function symmetric(n, f)
  local a = {}
  for i = 1, n * n do a[i] = 0 end
  for i = 1, n do
    for j = 1, i do
      local value = f(i, j)
      a[(i - 1) * n + j], a[(j - 1) * n + i] = value, value
    end
  end
  return a
end

-- Returns L D L' with L's blocks where those of the rings are, and D's signs as given. The number of
-- negative directions is known, although D does not hold the pivots that the solver meets.
local function with_signs(layout, sign)
  local m = 3 * layout.per_ring
  local n = layout.rings * m
  local l, d = {}, {}
  for i = 1, n do
    l[i], d[i] = {}, sign(i) * (1 + math.random())
    for j = math.max(1, ((i - 1) // m - 1) * m + 1), i - 1 do
      l[i][j] = 2 / m * (math.random() - 0.5)
    end
    l[i][i] = 1
  end
  return symmetric(n, function(i, j)
    local sum = 0
    for k = math.max(1, ((i - 1) // m - 1) * m + 1), j do
      sum = sum + l[i][k] * d[k] * (l[j][k] or 0)
    end
    return sum
  end)
end

local function times(a, x)
  local n, y = #x, {}
  for i = 1, n do
    local sum, row = 0, (i - 1) * n
    for j = 1, n do sum = sum + a[row + j] * x[j] end
    y[i] = sum
  end
  return y
end

local function random_vector(n)
  local x = {}
  for i = 1, n do x[i] = math.random() - 0.5 end
  return x
end

-- Gaussian elimination with row exchanges.
local function eliminate(a, b)
  local n, rows = #b, {}
  for i = 1, n do
    rows[i] = table.move(a, (i - 1) * n + 1, i * n, 1, {})
    rows[i][n + 1] = b[i]
  end
  for k = 1, n do
    local best = k
    for i = k + 1, n do if math.abs(rows[i][k]) > math.abs(rows[best][k]) then best = i end end
    rows[k], rows[best] = rows[best], rows[k]
    for i = k + 1, n do
      local f = rows[i][k] / rows[k][k]
      for j = k, n + 1 do rows[i][j] = rows[i][j] - f * rows[k][j] end
    end
  end
  local x = {}
  for i = n, 1, -1 do
    local sum = rows[i][n + 1]
    for j = i + 1, n do sum = sum - rows[i][j] * x[j] end
    x[i] = sum / rows[i][i]
  end
  return x
end

local function difference(a, b)
  local most = 0
  for i = 1, math.max(#a, #b) do most = math.max(most, math.abs(a[i] - b[i])) end
  return most
end

local function plus() return 1 end
local function mixed(i) return (i * i) % 7 < 2 and -1 or 1 end

local function negatives(n, sign)
  local count = 0
  for i = 1, n do if sign(i) < 0 then count = count + 1 end end
  return count
end

local SHAPES = { { 1, 1 }, { 2, 1 }, { 7, 1 }, { 1, 2 }, { 2, 2 }, { 7, 2 }, { 1, 3 }, { 3, 3 }, { 1, 9 },
  { 2, 9 }, { 7, 9 }, { 1, 12 }, { 2, 12 }, { 7, 12 }, { 1, 25 }, { 2, 25 }, { 7, 25 }, { 5, 16 } }

for kind, layout_of in pairs { rings = function(layout) return layout end, pairs = as_pairs } do
  describe("blocks of " .. kind, function()
    for name, sign in pairs { definite = plus, indefinite = mixed } do
      it("solve, count and multiply what is " .. name, function()
        math.randomseed(11)
        for _, shape in ipairs(SHAPES) do
          local layout = rings(shape[1], shape[2])
          local n = 3 * shape[1] * shape[2]
          local a, x = with_signs(layout, sign), random_vector(n)
          local b = times(a, x)
          local label = shape[1] .. " rings of " .. shape[2]
          local solved, negative, product, rows = probe.blocks(layout_of(layout), a, b)
          assert.is_true(difference(solved, x) < 1e-10, label .. ": " .. difference(solved, x))
          assert.are.equal(negatives(n, sign), negative, label)
          local expected = times(a, b)
          assert.is_true(difference(product, expected) < 1e-12, label)
          assert.is_true(difference(rows, expected) < 1e-12, label)
        end
      end)
    end

    -- More nodes than are taken up at once, in rows and in columns.
    it("solve with many nodes in a ring", function()
      math.randomseed(23)
      for _, shape in ipairs { { 2, 70 }, { 3, 67 } } do
        local m = 3 * shape[2]
        local n = m * shape[1]
        local a = symmetric(n, function(i, j)
          if i == j then return 20 * mixed(i) end
          return (i - 1) // m - (j - 1) // m < 2 and math.random() - 0.5 or 0
        end)
        local x = random_vector(n)
        local solved, negative = probe.blocks(layout_of(rings(shape[1], shape[2])), a, times(a, x))
        assert.is_true(difference(solved, x) < 1e-11, difference(solved, x))
        assert.are.equal(negatives(n, mixed), negative)
      end
    end)

    it("agree with dense elimination", function()
      math.randomseed(13)
      for _, sign in ipairs { plus, mixed } do
        local layout = rings(4, 5)
        local a, b = with_signs(layout, sign), random_vector(60)
        assert.is_true(difference(probe.blocks(layout_of(layout), a, b), eliminate(a, b)) < 1e-12)
      end
    end)

    -- Fixed nodes: the factor holds the others only, whatever was factorised before; products ignore
    -- fixing.
    it("take fixed nodes out of the factor, not out of products", function()
      math.randomseed(17)
      for _, shape in ipairs { { 1, 2 }, { 4, 1 }, { 5, 4 }, { 3, 9 } } do
        local layout, nodes = rings(shape[1], shape[2]), shape[1] * shape[2]
        local n = 3 * nodes
        local a, b, fixed, before = with_signs(layout, mixed), random_vector(n), {}, {}
        for i = 1, nodes do
          fixed[i], before[i] = (i == 1 or i % 4 == 0) and 1 or 0, i % 3 == 0 and 1 or 0
        end
        for i = 1, n do if fixed[(i + 2) // 3] == 1 then b[i] = 0 end end
        local reduced = symmetric(n, function(i, j)
          if fixed[(i + 2) // 3] == 1 or fixed[(j + 2) // 3] == 1 then return i == j and 1 or 0 end
          return a[(i - 1) * n + j]
        end)
        local solved, negative, product, rows = probe.blocks(layout_of(layout), a, b, fixed, before)
        local _, expected = probe.blocks(layout_of(layout), reduced, b)
        assert.is_true(difference(solved, eliminate(reduced, b)) < 1e-10)
        assert.are.equal(expected, negative)
        assert.is_true(difference(product, times(a, b)) < 1e-12)
        assert.is_true(difference(rows, times(a, b)) < 1e-12)
        for i = 1, n do if b[i] == 0 then assert.are.equal(0, solved[i]) end end
      end
    end)

    -- Links along a tube, aslant to the axes, 1e8 times as stiff as the others.
    it("keep the residual small for stiff and soft springs", function()
      math.randomseed(19)
      local count, m = 8, 6
      local n = 3 * count * m
      local a = symmetric(n, function(i, j) return i == j and 1 or 0 end)
      for i = 0, count * m - 1 do
        for j = math.max(0, (i // m - 1) * m), i - 1 do
          local k = i % m == j % m and 1e8 or 1
          local d = { math.random() - 0.5, math.random() - 0.5, 1 }
          local length = math.sqrt(d[1] ^ 2 + d[2] ^ 2 + d[3] ^ 2)
          for p = 1, 3 do
            for q = 1, 3 do
              local value = k * d[p] * d[q] / length ^ 2
              for _, at in ipairs { { i, i, 1 }, { j, j, 1 }, { i, j, -1 }, { j, i, -1 } } do
                local place = (3 * at[1] + p - 1) * n + 3 * at[2] + q
                a[place] = a[place] + at[3] * value
              end
            end
          end
        end
      end
      local b = random_vector(n)
      local solved, negative = probe.blocks(layout_of(rings(count, m)), a, b)
      assert.are.equal(0, negative)
      local most = 0 -- rounding of the product alone: 1e-16 * 1e8 * |x|
      for i = 1, n do most = math.max(most, math.abs(solved[i])) end
      assert.is_true(difference(times(a, solved), b) < 1e-7 * math.max(1, most))
    end)

    it("refuse matrices that are singular or not finite", function()
      local layout = layout_of(rings(2, 3))
      local n = 18
      local function try(f) return probe.blocks(layout, symmetric(n, f), random_vector(n)) end
      local function unit(i, j) return i == j and 1 or 0 end
      try(unit)
      assert.has_error(function() try(function() return 0 end) end, "singular matrix")
      for _, value in ipairs { 0, 0 / 0, 1 / 0, -1 / 0 } do
        for _, place in ipairs { 1, 9, 18 } do
          assert.has_error(function()
            try(function(i, j) return i == place and j == place and value or unit(i, j) end)
          end, "singular matrix")
        end
      end
      assert.has_error(function()
        try(function(i, j) return i == 17 and j == 2 and 0 / 0 or unit(i, j) end)
      end, "singular matrix")
    end)

    it("leave nothing behind when memory runs out", function()
      local layout = layout_of(rings(3, 2))
      local a, b = symmetric(18, function(i, j) return i == j and 4 or 0.1 end), random_vector(18)
      probe.blocks(layout, a, b)
      collectgarbage()
      local before, n, failures = core.allocated(), 0, 0
      repeat
        n = n + 1
        core.fail_allocation(n)
        local ok, message = pcall(probe.blocks, layout, a, b)
        core.fail_allocation(0)
        if not ok then
          failures = failures + 1
          assert.is_truthy(tostring(message):find "memory", message)
        end
        assert.are.equal(before, (core.allocated()))
      until ok
      assert.is_true(failures >= 4)
    end)
  end)
end

describe("blocks", function()
  it("exist for neighbours in rings and for given pairs", function()
    local _, _, _, _, count = probe.blocks(rings(3, 2), symmetric(18, function(i, j)
      return i == j and 1 or 0
    end), random_vector(18))
    assert.are.equal(3 * 3 + 2 * 4, count)
    _, _, _, _, count = probe.blocks({ nodes = 4, pairs = { 0, 3, 2, 3, 3, 0 } },
      symmetric(12, function(i, j) return i == j and 1 or 0 end), random_vector(12))
    assert.are.equal(4 + 2, count)
  end)

  it("refuse nodes that do not exist", function()
    local a, b = symmetric(6, function(i, j) return i == j and 1 or 0 end), random_vector(6)
    probe.blocks({ nodes = 2, pairs = {} }, a, b)
    assert.has_error(function() probe.blocks({ nodes = 2, pairs = { 0, 2 } }, a, b) end)
    assert.has_error(function() probe.blocks({ nodes = 2, pairs = { 1, 1 } }, a, b) end)
    assert.has_error(function() probe.blocks({ nodes = 0, pairs = {} }, {}, {}) end)
    assert.has_error(function() probe.blocks(rings(0, 2), {}, {}) end)
  end)
end)

-- Products of an elimination of single rows: row number k, counted from the last one eliminated, has
-- held(k) columns among the rows that stay, and changes the lower half of their square.
local function products(n, held)
  local sum = 0
  for k = 1, n do sum = sum + held(k) * (held(k) + 1) / 2 end
  return sum
end

describe("the work of blocks", function()
  it("is that of rows eliminated one by one", function()
    for _, shape in ipairs { { 1, 20 }, { 5, 30 }, { 40, 8 } } do
      local layout, m = rings(shape[1], shape[2]), 3 * shape[2]
      -- all earlier rows of its own ring, and the ring before
      local exact = products(shape[1] * m, function(k) return (k - 1) % m + (k > m and m or 0) end)
      local work, before = probe.blocks_work(layout)
      assert.are.equal(before, work)
      -- The formula leaves out terms of the order of m^2 beside m^3: at m = 24 about 1.5 / m.
      assert.near(1, work / exact, 0.1)
      -- As pairs the same blocks are coupled: no order can be much shorter.
      assert.is_true(probe.blocks_work(as_pairs(layout)) > 0.5 * work)
    end
  end)

  it("is far less where nodes of a wide ring are joined to few others", function()
    -- Short tubes of n nodes round, joined to their neighbours. Cut along, a tube is a band 2 nodes wide: the
    -- work grows with n, by nested cuts with n log n. Full rings need n^3, so that a doubling takes 8 times.
    local last
    for _, n in ipairs { 50, 100, 200 } do
      local pairs = {}
      for i = 0, n - 1 do
        for _, p in ipairs { { i, n + i }, { i, (i + 1) % n }, { n + i, n + (i + 1) % n } } do
          pairs[#pairs + 1], pairs[#pairs + 2] = p[1], p[2]
        end
      end
      local work, full = probe.blocks_work { nodes = 2 * n, pairs = pairs, rings = 2, per_ring = n }
      assert.is_true(work < full / 10, work / full)
      assert.is_true(work < 3 * (last or work), work / (last or work))
      last = work
    end
  end)
end)

describe("the matrix of a wire", function()
  it("is no full rings where these are wide", function()
    for _, particles in ipairs { 24, 32 } do
      local before = core.allocated()
      local scene = sw.scene { gravity = { 0, 0, 0 } }
      local w = scene:wire { model = "radial", body = "solid", particles = particles, layers = 4,
        segments = 2, E = 1e6, nu = 0.3, density = 1000, radius = 0.01,
        from = { 0, 0, 0 }, to = { 0.01, 0, 0 } }
      scene:clamp(w, { s = 0 })
      scene:run { duration = 0.01, dt = 0.01 }
      local n = 3 * (1 + 4 * particles)
      -- Full: values and factor of 3 rings, with each row's columns in its own ring and the one before.
      local full = 2 * 3 * n * 2 * n * 8
      assert.is_true(core.allocated() - before < full / 2, core.allocated() - before)
    end
  end)
end)
