-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires joined at a point, as in a harness.
local sw = require "softworld"

local EA, EI, MASS, G = 1e5, 1e-3, 0.02, 9.81

local function wire(s, a, b, segments, more)
  local args = { EA = EA, EI = EI, GJ = 1e-3, mass_per_length = MASS, radius = 1e-3, from = a, to = b,
    segments = segments }
  for k, v in pairs(more or {}) do args[k] = v end
  return s:wire(args)
end

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
  -- Two halves joined end to end are the same equations as one wire, up to the stretch of the
  -- join, 1e-2 of a segment's, and the angle law of its hinge beyond second order.
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
    it("and in motion, with " .. integrator, function()
      local one, two = sw.scene{}, sw.scene{}
      local w, b = whole(one), halves(two)
      for _, s in ipairs{ one, two } do
        assert.is_true(s:run{ duration = 0.3, dt = 2e-3, integrator = integrator }.ok)
      end
      for i = 1, 3 do assert.is_near(w:position(0.5)[i], b:position(0.25)[i], 1e-6) end
      assert.is_near(one:energy().total, two:energy().total, 1e-6 * 0.5 * MASS * G * 0.5)
    end)
  end

  it("tells the force and moment it puts on its ends", function()
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
    -- the hinge's moment is that of the middle between both half edges: at the node
    assert.is_near(sum, math.abs(moment[2]), 1e-3 * sum)
  end)

  -- A corner, free or not, in small deflections: for a cantilever of length L and, at its end
  -- and an angle to it, a branch of length h with a force P across it at the tip, by beam theory.
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

  -- A branch in mid-wire: both sides bear its moment in halves; second order in the mesh.
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

  it("keeps momentum, angular momentum and energy of what flies", function()
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
      -- by lumped masses and of second order in time
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

describe("joins in a scene", function()
  local function harness(s)
    local t = wire(s, { -0.3, 0, 0.2 }, { 0, 0, 0.2 }, 30, { name = "trunk" })
    local b = wire(s, { 0, 0, 0.2 }, { 0.25, 0.12, 0.2 }, 30, { name = "b" })
    local c = wire(s, { 0, 0, 0.2 }, { 0.25, -0.12, 0.2 }, 30, { name = "c" })
    local join = s:join{ ends = { { t, s = t.length }, { b, s = 0 }, { c, s = 0 } }, name = "Y" }
    s:clamp(t, { s = 0 })
    return t, b, c, join
  end

  it("leave what touches elsewhere to wire_contact and obstacles", function()
    local s = sw.scene{}
    local _, b, c, join = harness(s)
    s:wire_contact{ friction = 0.2 }
    s:obstacle{ shape = "plane", friction = 0.3 }
    local hand = s:clamp(b, { s = b.length })
    assert.is_true(s:settle().ok)
    for _, touch in ipairs(s:touches()) do assert.is_true(touch.s[1] > 0.01) end
    hand:follow{ points = { { 0, 0, 0 }, { -0.1, -0.25, 0.02 } }, duration = 0.5, relative = true }
    local run = s:run{ duration = 0.7, dt = 5e-3 }
    assert.is_true(run.ok, run.reason)
    assert.is_true(s:penetration() < 1e-3)
    local sum = { 0, 0, 0 }
    for k = 1, 3 do
      local f = join:force(k)
      for i = 1, 3 do sum[i] = sum[i] + f[i] end
    end
    for i = 1, 3 do assert.is_near(0, sum[i], 1e-6) end
    assert.is_true(c:position(c.length)[3] < 0.01) -- lies on the table
  end)

  it("come apart when released", function()
    local s = sw.scene{}
    local t, b, _, join = harness(s)
    s:settle()
    local before = s:snapshot()
    s:run{ duration = 0.1, dt = 5e-3 }
    local there = b:position(0.2)
    join:release()
    assert.is_false(join.held)
    assert.matches("released", tostring(join))
    s:run{ duration = 0.2, dt = 5e-3 }
    assert.is_true(t:position(t.length)[3] - b:position(0)[3] > 0.05) -- falls freely
    for i = 1, 3 do assert.are.equal(0, join:force(1)[i]) end
    s:restore(before)
    assert.is_true(join.held)
    s:run{ duration = 0.1, dt = 5e-3 }
    for i = 1, 3 do assert.are.equal(there[i], b:position(0.2)[i]) end
  end)

  it("made after a snapshot go with it", function()
    local s = sw.scene{}
    local w = wire(s, { 0, 0, 0 }, { 0.3, 0, 0 }, 20)
    local v = wire(s, { 0.3, 0, 0 }, { 0.5, 0, 0 }, 20)
    s:clamp(w, { s = 0 })
    local before = s:snapshot()
    local join = s:join{ ends = { { w, s = 0.3 }, { v, s = 0 } } }
    s:run{ duration = 0.05, dt = 5e-3 }
    s:restore(before)
    assert.matches("taken back", tostring(join))
    assert.has_error(function() join:force(1) end)
    s:run{ duration = 0.1, dt = 5e-3 }
    assert.is_near(-0.5 * G * 0.01, v:position(0)[3], 1e-4)
  end)

  it("are meshed anew for error bars", function()
    local s = sw.scene{}
    local function make(segments)
      local a = wire(s, { 0, 0, 0 }, { 0.25, 0, 0 }, segments)
      local b = wire(s, { 0.1, 0, 0 }, { 0.1, 0, -0.1 }, segments // 2)
      s:join{ ends = { { a, s = 0.1 }, { b, s = 0 } } }
      s:clamp(a, { s = 0 })
      return a, b
    end
    local a = make(12)
    local run = s:settle{ tolerance = { { name = "tip", value = 1e-4, unit = "m",
      of = function() return a:position(0.25)[3] end } } }
    assert.is_true(run.ok, run.reason)
    -- by the same, finely
    local fine = sw.scene{}
    s = fine
    local exact = make(200)
    fine:settle()
    local tip = run.quantities.tip
    assert.is_true(math.abs(tip.value - exact:position(0.25)[3]) <= tip.error + 2e-6)
  end)

  it("hold many branches and chains of wires", function()
    local s = sw.scene{}
    local chain, last = {}, nil
    for k = 1, 12 do
      local w = wire(s, { 0.1 * (k - 1), 0, 0 }, { 0.1 * k, 0, 0 }, 8)
      if last then s:join{ ends = { { last, s = 0.1 }, { w, s = 0 } } } end
      chain[k], last = w, w
    end
    s:clamp(chain[1], { s = 0 })
    s:clamp(last, { s = 0.1 })
    assert.is_true(s:settle().ok)
    local one = sw.scene{}
    local w = wire(one, { 0, 0, 0 }, { 1.2, 0, 0 }, 96)
    one:clamp(w, { s = 0 })
    one:clamp(w, { s = 1.2 })
    one:settle()
    -- the joins stretch by 11 hundredths of a segment's, of 96
    assert.is_near(w:position(0.6)[3], chain[6]:position(0.1)[3], 5e-6)
  end)

  describe("refuse", function()
    local s, a, b
    before_each(function()
      s = sw.scene{}
      a = wire(s, { 0, 0, 0 }, { 0.3, 0, 0 }, 20, { name = "a" })
      b = wire(s, { 0.3, 0, 0.01 }, { 0.5, 0, 0.01 }, 20, { name = "b" })
    end)

    local function refuses(pattern, args)
      local ok, message = pcall(s.join, s, args)
      assert.is_false(ok)
      assert.matches(pattern, message)
      assert.are.equal(21, a.segments + 1)
    end

    it("ends that do not meet", function()
      refuses("'b' at s = 0 m is 0.01 m away from 'a'", { ends = { { a, s = 0.3 }, { b, s = 0 } } })
    end)
    it("places beside the wire", function()
      refuses("s = 0.4 m is not on wire 'a', which goes from 0 to 0.3 m",
        { ends = { { a, s = 0.4 }, { b, s = 0 } } })
    end)
    it("one end, nine ends, none", function()
      refuses("it must be from 2 to 8", { ends = { { a, s = 0.3 } } })
      local nine = {}
      for k = 1, 9 do nine[k] = { a, s = 0.3 } end
      refuses("lists 9 wires", { ends = nine })
      refuses("ends is required", {})
      refuses("ends is required", { ends = a })
    end)
    it("what is no end", function()
      refuses("ends%[2%] must be { wire, s = arc length }, got number 3", { ends = { { a, s = 0.3 }, 3 } })
      refuses("ends%[1%]", { ends = { { s = 0.3 }, { b, s = 0 } } })
      refuses("s is required", { ends = { { a }, { b, s = 0 } } })
      refuses("S.*did you mean 's'", { ends = { { a, S = 0.3 }, { b, s = 0 } } })
      refuses("did you mean 'rigid'", { ends = { { a, s = 0.3 }, { b, s = 0 } }, rigit = true })
    end)
    it("a wire joined to its own neighbourhood", function()
      refuses("less than three segments apart", { ends = { { a, s = 0.1 }, { a, s = 0.12 } } })
    end)
    it("a wire of another scene", function()
      local other = sw.scene{}
      local c = wire(other, { 0.3, 0, 0 }, { 0.5, 0, 0 }, 5)
      refuses("scene", { ends = { { a, s = 0.3 }, { c, s = 0 } } })
    end)

    it("explicit integrators, feeds and frequencies of joined wires", function()
      local c = wire(s, { 0.3, 0, 0 }, { 0.5, 0, 0 }, 20, { name = "c" })
      s:join{ ends = { { a, s = 0.3 }, { c, s = 0 } }, name = "splice" }
      s:clamp(a, { s = 0 })
      local function fails(pattern, f, ...)
        local ok, message = pcall(f, ...)
        assert.is_false(ok)
        assert.matches(pattern, message)
      end
      fails("'splice', which joins wires, needs an implicit", s.run, s,
        { duration = 0.1, dt = 1e-6, integrator = "rk4" })
      local join = s:join{ ends = { { a, s = 0 }, { wire(s, { 0, 0, 0 }, { 0, 1, 0 }, 5), s = 0 } } }
      fails("from 1; got", join.force, join)
      fails("from 1; got number 0", join.force, join, 0)
      fails("end 3 is not one of its 2", join.moment, join, 3)
      join:release()
      fails("wire 'c' is joined to others by 'splice'", s.feed, s, c, { s = 0.2 })
      s:settle()
      fails("'a' is joined to others by 'splice'", a.frequencies, a)
      local d = wire(s, { 0.5, 1, 0 }, { 0.7, 1, 0 }, 20, { name = "d" })
      s:feed(d, { s = 0, speed = 0, name = "spool" })
      fails("wire 'd' is fed by 'spool'", s.join, s, { ends = { { c, s = 0.2 }, { d, s = 0 } } })
    end)
  end)
end)
