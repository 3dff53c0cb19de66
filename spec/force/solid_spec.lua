-- SPDX-License-Identifier: GPL-3.0-or-later
-- Solid elements one by one: derivatives, invariance to moving and turning, exact stress of homogeneous
-- strains, and return from inside out.
local core = require "softworld.core"
local tools = require "physics.tools"
local near, share = tools.near, tools.share

local MU, LAMBDA = 1.3, 2.1

-- Corners of a prism (6) or hexahedron (8), each moved by up to half of amount.
local function corners(nodes, amount, height)
  local base = nodes == 6 and { { 0, 0 }, { 1, 0 }, { 0.2, 0.9 } }
    or { { 0, 0 }, { 1, 0.1 }, { 1.1, 0.9 }, { 0.1, 1 } }
  local flat = {}
  for slice = 0, 1 do
    for _, p in ipairs(base) do
      for _, value in ipairs { p[1], p[2], slice * (height or 0.7) } do
        flat[#flat + 1] = value + amount * (math.random() - 0.5)
      end
    end
  end
  return flat
end

local function moved(x, amount)
  local out = {}
  for i, value in ipairs(x) do out[i] = value + amount * (math.random() - 0.5) end
  return out
end

-- x -> F x + (0.3, -2, 5)
local function mapped(F, x)
  local out, shift = {}, { 0.3, -2, 5 }
  for i = 1, #x, 3 do
    for j = 1, 3 do
      out[i + j - 1] = F[j][1] * x[i] + F[j][2] * x[i + 1] + F[j][3] * x[i + 2] + shift[j]
    end
  end
  return out
end

local function turn(axis, angle)
  local c, s, R = math.cos(angle), math.sin(angle), { {}, {}, {} }
  local i, j, k = axis, axis % 3 + 1, (axis + 1) % 3 + 1
  R[i][i], R[i][j], R[i][k] = 1, 0, 0
  R[j][i], R[j][j], R[j][k] = 0, c, -s
  R[k][i], R[k][j], R[k][k] = 0, s, c
  return R
end

-- Eigenvalues of a flat symmetric matrix in rising order, by Jacobi's rotations.
local function eigenvalues(H, n)
  local a = {}
  for i = 1, n do a[i] = table.move(H, (i - 1) * n + 1, i * n, 1, {}) end
  for _ = 1, 12 do
    for p = 1, n - 1 do
      for q = p + 1, n do
        if a[p][q] ~= 0 then
          local theta = (a[q][q] - a[p][p]) / (2 * a[p][q])
          local t = (theta >= 0 and 1 or -1) / (math.abs(theta) + math.sqrt(theta * theta + 1))
          local c = 1 / math.sqrt(t * t + 1)
          local s = t * c
          for k = 1, n do
            local u, v = a[k][p], a[k][q]
            a[k][p], a[k][q] = c * u - s * v, s * u + c * v
          end
          for k = 1, n do
            local u, v = a[p][k], a[q][k]
            a[p][k], a[q][k] = c * u - s * v, s * u + c * v
          end
        end
      end
    end
  end
  local values = {}
  for i = 1, n do values[i] = a[i][i] end
  table.sort(values)
  return values
end

describe("a solid element", function()
  it("has the derivatives of its energy, also far from rest and inside out", function()
    math.randomseed(3)
    local least = math.huge
    for _, nodes in ipairs { 6, 8 } do
      for _, amount in ipairs { 0.1, 0.3, 0.6, 1, 1.5, 2, 3, 4 } do
        local rest = corners(nodes, 0.2)
        local x, d = moved(rest, amount), 1e-5
        local _, g, H, J = core.solid(rest, MU, LAMBDA, x)
        least = math.min(least, J)
        local most_g, most_H, n = tools.largest(g), tools.largest(H), #x
        for i = 1, n do
          local side = {}
          for k = 1, 2 do
            local y = table.move(x, 1, n, 1, {})
            y[i] = y[i] + (k == 1 and d or -d)
            side[k] = { core.solid(rest, MU, LAMBDA, y) }
          end
          -- differences are good to d^2 of the third derivative, which grows with amount
          near((side[1][1] - side[2][1]) / (2 * d), g[i], 1e-7 * most_g, "gradient")
          for j = 1, n do
            near((side[1][2][j] - side[2][2][j]) / (2 * d), H[(i - 1) * n + j], 1e-7 * most_H, "second")
            near(H[(i - 1) * n + j], H[(j - 1) * n + i], 1e-14 * most_H, "symmetry")
          end
        end
      end
    end
    tools.below(0, least, "some are inside out")
  end)

  it("has a smooth energy where J is small", function()
    local rest = corners(8, 0)
    local function squeezed(J) return mapped({ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, J } }, rest) end
    local before = { core.solid(rest, MU, LAMBDA, squeezed(0.1 + 1e-9)) }
    local after = { core.solid(rest, MU, LAMBDA, squeezed(0.1 - 1e-9)) }
    share(before[1], after[1], 1e-7)
    for i, g in ipairs(before[2]) do near(g, after[2][i], 1e-6 * tools.largest(before[2])) end
    for i, H in ipairs(before[3]) do near(H, after[3][i], 1e-6 * tools.largest(before[3])) end
    for _, J in ipairs { 0, -1, -1e3, 1e6 } do
      assert.is_true(core.solid(rest, MU, LAMBDA, squeezed(J)) < math.huge)
    end
    local far = moved(rest, 1e30)
    local energy, g, H = core.solid(rest, MU, LAMBDA, far)
    assert.is_true(energy < math.huge and tools.largest(g) < math.huge and tools.largest(H) < math.huge)
  end)

  it("has no energy or force from being moved and turned", function()
    math.randomseed(4)
    for _, nodes in ipairs { 6, 8 } do
      local rest = corners(nodes, 0.3)
      for axis = 1, 3 do
        for _, angle in ipairs { 0.1, 1, 3 } do
          local energy, g = core.solid(rest, MU, LAMBDA, mapped(turn(axis, angle), rest))
          near(0, energy, 1e-13)
          near(0, tools.largest(g), 1e-12)
          -- its forces turn with it
          local x = moved(rest, 0.4)
          local E, force = core.solid(rest, MU, LAMBDA, x)
          local R = turn(axis, angle)
          local E2, force2 = core.solid(rest, MU, LAMBDA, mapped(R, x))
          share(E, E2, 1e-12)
          local expected = mapped(R, force)
          for i = 1, #force do
            near(expected[i] - ({ 0.3, -2, 5 })[(i - 1) % 3 + 1], force2[i], 1e-12)
          end
        end
      end
    end
  end)

  it("has the stress of a homogeneous strain", function()
    for _, nodes in ipairs { 6, 8 } do
      local rest = corners(nodes, 0.2)
      local a, g = 1.3, 0.4 -- F = diag(a, 1, 1) with shear g of x by y
      local F = { { a, g, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }
      local _, _, _, J, s, mises = core.solid(rest, MU, LAMBDA, mapped(F, rest))
      local p = LAMBDA * math.log(a)
      share(a, J, 1e-12)
      local expected = { (MU * (a * a + g * g - 1) + p) / a, MU * g / a, 0, p / a, 0, p / a }
      for i = 1, 6 do near(expected[i], s[i], 1e-12) end
      local xx = expected[1] - expected[4]
      share(math.sqrt(xx * xx + 3 * expected[2] ^ 2), mises, 1e-12)
    end
  end)

  it("passes the patch test in any shape: no force on a particle inside", function()
    math.randomseed(6)
    local F = { { 1.2, 0.3, -0.1 }, { 0.05, 0.8, 0.2 }, { 0.1, -0.2, 1.1 } }
    local at = {}
    for i = 0, 26 do
      local inside = i == 13
      for k, n in ipairs { i % 3, i // 3 % 3, i // 9 } do
        at[3 * i + k] = n + (inside and 0.4 * (math.random() - 0.5) or 0)
      end
    end
    for _, faces in ipairs { { { 0, 1, 4, 3 } }, { { 0, 1, 4 }, { 0, 4, 3 } } } do
      local sum, most = { 0, 0, 0 }, 0
      for i = 0, 7 do
        local first = i % 2 + i // 2 % 2 * 3 + i // 4 * 9
        for _, face in ipairs(faces) do
          local rest, here = {}, nil
          for slice = 0, 1 do
            for _, corner in ipairs(face) do
              local node = first + corner + 9 * slice
              if node == 13 then here = #rest end
              for k = 1, 3 do rest[#rest + 1] = at[3 * node + k] end
            end
          end
          local _, g = core.solid(rest, MU, LAMBDA, mapped(F, rest))
          most = math.max(most, tools.largest(g))
          for k = 1, here and 3 or 0 do sum[k] = sum[k] + g[here + k] end
        end
      end
      near(0, tools.largest(sum), 1e-13 * most + 1e-13)
    end
  end)

  it("resists everything but being moved and turned", function()
    math.randomseed(7)
    for _, nodes in ipairs { 6, 8 } do
      for _, amount in ipairs { 0, 0.3 } do
        for _, height in ipairs { 0.25, 1, 2 } do
          for _, nu in ipairs { 0, 0.3, 0.49 } do
            local mu, lambda = 0.5 / (1 + nu), nu / ((1 + nu) * (1 - 2 * nu))
            local rest = corners(nodes, amount * math.min(1, height), height)
            local _, _, H = core.solid(rest, mu, lambda, rest)
            local values = eigenvalues(H, 3 * nodes)
            near(0, values[1], 1e-13 * values[#values])
            near(0, values[6], 1e-13 * values[#values])
            tools.above(1e-3, values[7], "of modulus 1") -- bending of an element of height 1/4
            local _, _, same = core.solid(rest, mu, lambda, rest, true)
            for i = 1, #H do near(H[i], same[i], 1e-13 * values[#values]) end
          end
        end
      end
    end
  end)

  it("has a second derivative without negative eigenvalues on request", function()
    math.randomseed(8)
    local negative = 0
    for n = 1, 24 do
      local rest = corners(n % 2 == 0 and 6 or 8, 0.2)
      local x = moved(rest, n / 8)
      local _, _, H = core.solid(rest, MU, LAMBDA, x)
      local _, _, S = core.solid(rest, MU, LAMBDA, x, true)
      if eigenvalues(H, #x)[1] < -1e-6 then negative = negative + 1 end
      local values = eigenvalues(S, #x)
      tools.above(-1e-12 * values[#values], values[1], "eigenvalue")
    end
    tools.above(10, negative, "those that would have some")
  end)

  it("bends with the stiffness of a stretched bar", function()
    -- incompressible: d2W/dl2 of mu/2 (l^2 + 2/l) is mu (1 + 2/l^3), 3 mu at rest. The elements are nearly
    -- incompressible, and their stiffness follows 1/l^2
    local rest, nu = corners(6, 0), 0.4999
    local mu, lambda = 0.5 / (1 + nu), nu / ((1 + nu) * (1 - 2 * nu))
    for _, l in ipairs { 0.7, 1, 1.3 } do
      local across = 1 / math.sqrt(l)
      local F = { { across, 0, 0 }, { 0, across, 0 }, { 0, 0, l } }
      local x, bend = mapped(F, rest), {}
      local _, _, H = core.solid(rest, mu, lambda, x)
      for i = 1, 18 do bend[i] = 0 end
      for a, value in ipairs { -1, 1, 0 } do bend[3 * a], bend[3 * a + 9] = -value, value end
      local sum = 0
      for i = 1, 18 do
        for j = 1, 18 do sum = sum + bend[i] * H[(i - 1) * 18 + j] * bend[j] end
      end
      -- strain 2 (-1, 1, 0)/height at the corners, whose mean square over the triangle is 1/6 of
      -- 4/height^2; volume 0.45 height
      local E = sum / (0.45 * 0.7 * 4 / 0.7 ^ 2 / 6)
      near((1 + 2 / l ^ 3) / 3, E, 0.12 * (1 + 2 / l ^ 3) / 3, "at " .. l)
      if l == 1 then share(1, E, 1e-9) end
    end
  end)

  it("returns to its shape from inside out", function()
    math.randomseed(9)
    for _, nodes in ipairs { 6, 8 } do
      for case = 1, 3 do
        local rest = corners(nodes, 0.1)
        local x
        if case == 1 then -- flattened and beyond
          x = moved(mapped({ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, -0.3 } }, rest), 0.1)
        elseif case == 2 then -- one corner through the rest
          x = moved(rest, 0.05)
          x[3] = 3
        else
          x = moved(rest, 2)
        end
        local step, energy, g = 0.01, core.solid(rest, MU, LAMBDA, x)
        for _ = 1, 20000 do
          local y = {}
          for i = 1, #x do y[i] = x[i] - step * g[i] end
          local e2, g2 = core.solid(rest, MU, LAMBDA, y)
          if e2 < energy then
            x, energy, g, step = y, e2, g2, 1.2 * step
          else
            step = 0.5 * step
          end
          if energy < 1e-12 then break end
        end
        tools.below(1e-9, energy, ("energy of case %d"):format(case))
        local _, _, _, J = core.solid(rest, MU, LAMBDA, x)
        near(1, J, 1e-4)
      end
    end
  end)

  it("reports how far it may move with J above its bound", function()
    math.randomseed(10)
    local less = 0
    for n = 1, 80 do
      local rest = corners(n % 2 == 0 and 6 or 8, 0.2)
      local x, dx = moved(rest, 0.5), {}
      for i = 1, #rest do dx[i] = 3 * (math.random() - 0.5) end
      local _, _, _, J, _, _, portion = core.solid(rest, MU, LAMBDA, x, false, dx)
      local lowest = math.huge
      for k = 0, 100 do
        local y = {}
        for i = 1, #x do y[i] = x[i] + portion * k / 100 * dx[i] end
        lowest = math.min(lowest, (select(4, core.solid(rest, MU, LAMBDA, y))))
      end
      assert.is_true(portion > 0 and portion <= 1)
      local bound = 0.2 * math.min(J, 1)
      tools.above(bound - 1e-9, lowest, "J on the way")
      if portion < 1 then
        less = less + 1
        near(bound, lowest, 1e-6)
      end
    end
    tools.above(8, less, "moves that are cut")
  end)

  it("is refused without volume, inverted, or without a material", function()
    local good = corners(8, 0)
    local function refused(rest, mu, lambda)
      assert.has_error(function() core.solid(rest, mu or MU, lambda or LAMBDA, good) end)
    end
    refused(mapped({ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, -1 } }, good))
    refused(mapped({ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 } }, good))
    refused(good, 0)
    refused(good, 1, -1)
    refused(good, 1, 0 / 0)
    refused({ 1, 2, 3 })
    core.solid(good, 1, 0, good)
  end)
end)
