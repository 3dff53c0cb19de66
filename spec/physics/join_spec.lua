-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires joined at a point, as in a harness.
local sw = require "softworld"
local joined = require "spec.physics.joined"

local wire = joined.wire
local EI, MASS, G = 1e-3, 0.02, 9.81

local function circle(radius, count)
  local path = {}
  for i = 0, count do
    local a = 2 * math.pi * i / count
    path[#path + 1] = { radius * math.sin(a), 0, radius * (math.cos(a) - 1) }
  end
  path[#path] = { 0, 0, 0 }
  return path
end

describe("a rigid join", function()
  -- Two halves joined end to end have the equations of one wire, except for the stretch of the join, 1e-2
  -- of a segment's, and the angle law of its hinge beyond second order.
  local function halves(s, more, turned)
    local a = wire(s, { 0, 0, 0 }, { 0.25, 0, 0 }, 20, more)
    local from, to = { 0.25, 0, 0 }, { 0.5, 0, 0 }
    if turned then from, to = to, from end
    local b = wire(s, from, to, 20, more)
    local join = s:join{ ends = { { a, s = 0.25 }, { b, s = turned and 0.25 or 0 } } }
    s:clamp(a, { s = 0 })
    return b, join
  end

  local function whole(s, more)
    local w = wire(s, { 0, 0, 0 }, { 0.5, 0, 0 }, 40, more)
    s:clamp(w, { s = 0 })
    return w
  end

  for _, case in ipairs{ { "plain", {} }, { "framed", { EI = { 1e-3, 2e-3 }, normal = { 0, 0, 1 } } } } do
    it("makes one wire of two " .. case[1] .. " halves at rest", function()
      for _, turned in ipairs{ false, true } do
        local one, two = sw.scene{}, sw.scene{}
        local w, b = whole(one, case[2]), halves(two, case[2], turned)
        local at = turned and 0 or 0.25
        assert.is_true(one:settle().ok)
        assert.is_true(two:settle().ok)
        for i = 1, 3 do
          assert.is_near(w:position(0.5)[i], b:position(at)[i], 1e-7)
          assert.is_near(w:position(0.35)[i], b:position(turned and 0.15 or 0.1)[i], 1e-7)
        end
        one:close()
        two:close()
      end
    end)
  end

  for _, integrator in ipairs{ "tr-bdf2", "sdirk2", "bdf2", "implicit-euler", "implicit-midpoint" } do
    it("makes one wire of two halves in motion, with " .. integrator, function()
      local one, two = sw.scene{}, sw.scene{}
      local w, b = whole(one), halves(two)
      for _, s in ipairs{ one, two } do
        -- whole steps: parts (substeps) would depend on the length of a wire
        assert.is_true(s:run{ duration = 0.3, dt = 2e-3, integrator = integrator, parts = false }.ok)
      end
      for i = 1, 3 do assert.is_near(w:position(0.5)[i], b:position(0.25)[i], 1e-6) end
      assert.is_near(one:energy().total, two:energy().total, 1e-6 * 0.5 * MASS * G * 0.5)
    end)
  end

  it("reports the force and moment on its ends", function()
    local s = sw.scene{}
    local b, join = halves(s)
    s:settle()
    local force, other, moment = join:force(2), join:force(1), join:moment(2)
    assert.is_near(0.25 * MASS * G, force[3], 1e-6)
    for i = 1, 3 do assert.is_near(0, force[i] + other[i], 1e-9) end
    local sum = 0 -- of the weights of b's segments about the join
    for k = 1, 20 do
      local x = 0.5 * (b:position((k - 1) / 80)[1] + b:position(k / 80)[1]) - b:position(0)[1]
      sum = sum + MASS * G * x / 80
    end
    -- the hinge's moment belongs to the middle between both half edges: to the node
    assert.is_near(sum, math.abs(moment[2]), 1e-3 * sum)
  end)

  -- A corner in small deflections, by beam theory: a cantilever of length L and, at its end and at an angle
  -- to it, a branch of length h with a force P across its tip.
  local L, h, P = 0.3, 0.2, 1e-7
  for _, degrees in ipairs{ 4, 20, 45, 90, 110, 150, 174 } do
    it(("bends like a corner of %d degrees"):format(degrees), function()
      local c, d = math.cos(math.rad(degrees)), math.sin(math.rad(degrees))
      local s = sw.scene{ gravity = { 0, 0, 0 } }
      local a = wire(s, { 0, 0, 0 }, { L, 0, 0 }, 40)
      local b = wire(s, { L, 0, 0 }, { L + h * c, 0, h * d }, 30)
      s:join{ ends = { { a, s = L }, { b, s = 0 } } }
      s:clamp(a, { s = 0 })
      s:force{ kind = "point", on = b, s = h, force = { -P * d, 0, P * c } }
      assert.is_true(s:settle().ok)
      local turn = P * h * L / EI + P * c * L ^ 2 / (2 * EI)
      local rise = P * h * L ^ 2 / (2 * EI) + P * c * L ^ 3 / (3 * EI)
      local exact = P * h ^ 3 / (3 * EI) + turn * h + rise * c
      local p = b:position(h)
      local across = -(p[1] - L - h * c) * d + (p[3] - h * d) * c
      -- second order in the mesh, and rounding of a deflection of 1e-6 m
      assert.is_near(1, across / exact, 1e-3)
    end)
  end

  -- A branch in mid-wire: each side bears half of its moment; second order in the mesh.
  it("hands a branch's moment to both sides of a trunk", function()
    local function turn_of(segments)
      local s = sw.scene{ gravity = { 0, 0, 0 } }
      local t = wire(s, { 0, 0, 0 }, { 0.4, 0, 0 }, segments)
      local b = wire(s, { 0.2, 0, 0 }, { 0.2, 0, 0.2 }, segments // 2)
      s:join{ ends = { { t, s = 0.2 }, { b, s = 0 } } }
      s:clamp(t, { s = 0 })
      s:clamp(t, { s = 0.4 })
      s:force{ kind = "point", on = b, s = 0.2, force = { P, 0, 0 } }
      assert.is_true(s:settle().ok)
      -- moment M in the middle of a beam clamped at both ends turns it by M L / (16 EI)
      local exact = P * 0.2 ^ 3 / (3 * EI) + P * 0.2 * 0.4 / (16 * EI) * 0.2
      return (b:position(0.2)[1] - 0.2) / exact - 1
    end
    local coarse, fine = turn_of(40), turn_of(80)
    assert.is_near(0, coarse, 2.5e-3)
    assert.is_near(0.25, fine / coarse, 0.02)
  end)

  -- Castigliano: a ring pulled by P at opposite points grows by (pi/4 - 2/pi) P R^3/EI along it,
  -- and gets narrower by (2/pi - 1/2) P R^3/EI across.
  it("closes a wire to a ring without a seam", function()
    local R = 0.1
    local function pulled(force)
      local s = sw.scene{ gravity = { 0, 0, 0 } }
      local w = wire(s, nil, nil, 80, { path = circle(R, 400) })
      local n = w.length
      s:join{ ends = { { w, s = 0 }, { w, s = n } } }
      s:pin(w, { s = n / 8 }) -- off the seam
      s:force{ kind = "point", on = w, s = n / 8, force = { 0, 0, 0 } }
      local from, to = w:position(n / 8), w:position(5 * n / 8)
      local l = math.sqrt((to[1] - from[1]) ^ 2 + (to[3] - from[3]) ^ 2)
      s:force{ kind = "point", on = w, s = 5 * n / 8,
        force = { force * (to[1] - from[1]) / l, 0, force * (to[3] - from[3]) / l } }
      assert.is_true(s:settle().ok)
      local function width(a, b)
        local p, q = w:position(a), w:position(b)
        return math.sqrt((p[1] - q[1]) ^ 2 + (p[3] - q[3]) ^ 2)
      end
      return width(n / 8, 5 * n / 8), width(3 * n / 8, 7 * n / 8)
    end
    local force = 1e-2
    local a0, b0 = pulled(0)
    local a1, b1 = pulled(force)
    local unit = force * R ^ 3 / EI
    assert.is_near(math.pi / 4 - 2 / math.pi, (a1 - a0) / unit, 2e-3)
    assert.is_near(2 / math.pi - 0.5, (b0 - b1) / unit, 2e-3)
  end)

  it("keeps momentum, angular momentum and energy of flying wires", function()
    local s = sw.scene{ gravity = { 0, 0, 0 } }
    local t = wire(s, { 0, 0, 0 }, { 0.3, 0, 0 }, 30)
    local b = wire(s, { 0.15, 0, 0 }, { 0.15, 0.1, 0.1 }, 14)
    local c = wire(s, { 0.15, 0, 0 }, { 0.15, 0.1, -0.1 }, 14)
    s:join{ ends = { { t, s = 0.15 }, { b, s = 0 }, { c, s = 0 } } }
    local push = s:force{ kind = "point", on = b, s = 0.1, force = { 0.2, 0, 0.1 } }
    s:run{ duration = 0.02, dt = 5e-4 }
    push:release()
    local function motion()
      local p, l = { 0, 0, 0 }, { 0, 0, 0 }
      for _, w in ipairs{ t, b, c } do
        local n, e = w.segments, w.length / w.segments
        for i = 0, n do
          local m = MASS * e * ((i == 0 or i == n) and 0.5 or 1)
          local at = math.min(i * e, w.length)
          local x, v = w:position(at), w:velocity(at)
          for k = 1, 3 do
            local k1, k2 = k % 3 + 1, (k + 1) % 3 + 1
            p[k] = p[k] + m * v[k]
            l[k] = l[k] + m * (x[k1] * v[k2] - x[k2] * v[k1])
          end
        end
      end
      return p, l
    end
    local p0, l0 = motion()
    local e0 = s:energy().total
    assert.is_true(s:run{ duration = 0.3, dt = 2.5e-4 }.ok)
    local p1, l1 = motion()
    for k = 1, 3 do
      assert.is_near(p0[k], p1[k], 1e-6 * 0.2 * 0.02)
      -- with lumped masses, second order in time
      assert.is_near(l0[k], l1[k], 5e-3 * math.sqrt(l0[1] ^ 2 + l0[2] ^ 2 + l0[3] ^ 2))
    end
    assert.is_true(s:energy().total <= e0 * (1 + 1e-6))
    assert.is_near(e0, s:energy().total, 2e-3 * e0) -- the fastest bending waves are damped
  end)
end)

describe("a join that turns freely", function()
  it("carries forces and no moment", function()
    local s = sw.scene{}
    local a = wire(s, { 0, 0, 0 }, { 0.3, 0, 0 }, 30)
    local b = wire(s, { 0.3, 0, 0 }, { 0.6, 0, 0 }, 30)
    local join = s:join{ ends = { { a, s = 0.3 }, { b, s = 0 } }, rigid = false }
    s:clamp(a, { s = 0 })
    assert.is_true(s:settle().ok)
    local f, m = join:force(2), join:moment(2)
    assert.is_near(0.3 * MASS * G, f[3], 1e-6)
    for i = 1, 3 do assert.are.equal(0, m[i]) end
    -- b hangs straight down
    assert.is_near(b:position(0)[1], b:position(0.3)[1], 1e-5)
    assert.is_near(b:position(0)[3] - 0.3, b:position(0.3)[3], 1e-5)
  end)

  it("balances three strings by the parallelogram of forces", function()
    local s = sw.scene{}
    local function string_to(x, z)
      local w = s:wire{ model = "string", EA = 1e4, EI = 0, mass_per_length = 1e-4, radius = 1e-3,
        from = { 0, 0, 0 }, to = { x, 0, z }, segments = 20 }
      return w
    end
    local left, right, down = string_to(-0.3, 0.4), string_to(0.4, 0.3), string_to(0, -0.2)
    local join = s:join{ ends = { { left, s = 0 }, { right, s = 0 }, { down, s = 0 } } }
    s:pin(left, { s = left.length })
    s:pin(right, { s = right.length })
    s:force{ kind = "point", on = down, s = down.length, force = { 0, 0, -10 } }
    assert.is_true(s:settle().ok)
    local sum = { 0, 0, 0 }
    local size = {}
    for k = 1, 3 do
      local f = join:force(k)
      for i = 1, 3 do sum[i] = sum[i] + f[i] end
      size[k] = math.sqrt(f[1] ^ 2 + f[2] ^ 2 + f[3] ^ 2)
    end
    for i = 1, 3 do assert.is_near(0, sum[i], 1e-6) end
    -- at right angles to each other: 10 N times the cosines 0.8 and 0.6; strings stretch by 1e-3
    assert.is_near(8, size[1], 0.02)
    assert.is_near(6, size[2], 0.02)
    assert.is_near(10, size[3], 1e-2)
  end)
end)
