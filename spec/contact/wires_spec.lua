-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that touch each other: forces against formulas, impacts, nothing passes through.
local core = require "softworld.core"

local G = 9.81
local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

-- Returns the total momentum of free wires [N s], from the nodes' lumped masses.
local function momentum(wires, masses)
  local sum = { 0, 0, 0 }
  for k, w in ipairs(wires) do
    local n, l = w.segments, w.length / w.segments
    for i = 0, n do
      local m = masses[k] * l * ((i == 0 or i == n) and 0.5 or 1)
      local v = w:velocity(math.min(i * l, w.length))
      for c = 1, 3 do sum[c] = sum[c] + m * v[c] end
    end
  end
  return sum
end

describe("wires that cross", function()
  -- A light wire lies across two stiff ones, which carry its weight.
  it("carry a third one's weight in exactly equal shares", function()
    local s = core.scene{}
    local function rail(x)
      local w = s:wire{ E = 2e11, density = 7800, radius = 0.004, from = { x, -0.1, 0 },
        to = { x, 0.1, 0 }, segments = 8 }
      s:clamp(w, { s = 0 })
      s:clamp(w, { s = w.length })
      return w
    end
    rail(-0.15)
    rail(0.15)
    local w = s:wire{ E = 1e9, density = 1300, radius = 0.002, from = { -0.2, 0, 0.006 },
      to = { 0.2, 0, 0.006 }, segments = 31 }
    s:wire_contact{ friction = 0.3 }
    assert.is_true(s:settle().ok)
    local touches, up = s:touches(), { 0, 0 }
    for _, t in ipairs(touches) do -- one or two a crossing: a bent wire has corners
      assert.are.equal("wire3", t.wires[2])
      local under = t.wires[1] == "wire1" and 1 or 2
      up[under] = up[under] - t.force[3]
      assert.is_true(math.abs(t.point[3] - 0.004) < 2e-4)
    end
    assert.are.equal(#touches, s:contacts())
    local weight = 1300 * math.pi * 0.002 ^ 2 * w.length * G
    assert.is_true(math.abs(up[1] + up[2] - weight) < 1e-6 * weight)
    assert.is_true(math.abs(up[1] - up[2]) < 1e-3 * weight) -- by symmetry; places are solved to 1e-9 m
    assert.is_true((s:penetration()) < 5e-5)
  end)
end)

describe("a wire in the groove between two others", function()
  -- All radii are r, the rails' axes are `apart` radii from each other. Normals lean by sin(lean) =
  -- apart/4, so both together press with weight/cos(lean).
  local function slide(mu, degrees, apart, turn)
    local a, r = math.rad(degrees), 0.003
    local along, across = { math.cos(turn), math.sin(turn), 0 }, { -math.sin(turn), math.cos(turn), 0 }
    local s = core.scene{ gravity = { G * math.sin(a) * along[1], G * math.sin(a) * along[2],
      -G * math.cos(a) } }
    local function at(x, y, z)
      return { x * along[1] + y * across[1], x * along[2] + y * across[2], z }
    end
    for _, y in ipairs{ -apart * r / 2, apart * r / 2 } do -- nearly rigid
      local w = s:wire{ E = 2e12, density = 100, radius = r, from = at(-0.5, y, 0),
        to = at(0.5, y, 0), segments = 40 }
      s:clamp(w, { s = 0 })
      s:clamp(w, { s = w.length })
    end
    local lean = math.asin(apart / 4)
    local z = 2 * r * math.cos(lean)
    local w = s:wire{ E = 1e9, density = 1200, radius = r, from = at(-0.1053, 0, z),
      to = at(0.0971, 0, z), segments = 13 }
    s:wire_contact{ friction = mu }
    assert.is_true(s:advance({ dt = 0.005 }, 0.1).ok)
    local before = dot(w:velocity(0.1), along)
    assert.is_true(s:advance({ dt = 0.005 }, 0.3).ok)
    local measured = (dot(w:velocity(0.1), along) - before) / 0.2
    return measured, G * (math.sin(a) - mu * math.cos(a) / math.cos(lean)), before
  end

  it("slides with the acceleration of Coulomb friction", function()
    for _, c in ipairs{ { 0.3, 30, 2.2, 0 }, { 0.1, 20, 3, 0.7 }, { 0, 20, 2.5, 0 },
      { 0.5, 35, 2.05, 2 } } do
      local measured, theory = slide(table.unpack(c))
      -- the rails' own sag is a few micrometres: less than 1e-3 of g
      assert.is_true(math.abs(measured - theory) < 2e-3, measured .. " for " .. theory)
    end
  end)

  it("sticks below the threshold and slides above it", function()
    local lean = math.asin(2.2 / 4)
    local mu = math.tan(math.rad(15)) * math.cos(lean) -- just enough
    local stuck, _, creep = slide(1.02 * mu, 15, 2.2, 0)
    assert.is_true(math.abs(stuck) < 1e-4 and math.abs(creep) < 1e-4)
    local moving, theory = slide(0.98 * mu, 15, 2.2, 0)
    assert.is_true(moving > 0.7 * theory and theory > 0.04)
  end)
end)

describe("a wire over a thick one", function()
  -- The capstan with a thick wire as the cylinder; the rope's axis runs at R + r.
  it("is drawn with exp(mu angle) times the pull", function()
    local R, r, mu = 0.05, 0.0005, 0.3
    local path, Rw = {}, R + r
    local function place(a) return { Rw * math.cos(a), 0, Rw * math.sin(a) } end
    for i = 10, 1, -1 do path[#path + 1] = { -Rw, 0, -0.01 * i } end
    for i = 0, 200 do path[#path + 1] = place(math.pi * (1 - i / 200)) end
    for i = 1, 10 do path[#path + 1] = { Rw, 0, -0.01 * i } end
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local thick = s:wire{ EA = 1e8, EI = 1e6, mass_per_length = 10, radius = R,
      from = { 0, -0.5, 0 }, to = { 0, 0.5, 0 }, segments = 10 }
    s:clamp(thick, { s = 0 })
    s:clamp(thick, { s = 1 })
    local w = s:wire{ model = "string", EA = 1e4, EI = 1e-9, mass_per_length = 0.1, radius = r,
      path = path, segments = 100 }
    s:wire_contact{ between = { thick, w }, friction = mu, self = false }
    s:force{ kind = "point", on = w, s = 0, force = { 0, 0, -1 } }
    s:force{ kind = "damping", mass = 20, on = w }
    local c = s:pin(w, { s = w.length })
    s:advance({ dt = 0.002 }, 0.2)
    c:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.02 } }, relative = true, speed = 0.02,
      law = "linear" }
    local sum = 0
    for i = 1, 20 do
      assert.is_true(s:advance({ dt = 0.002 }, 0.6 + 0.01 * i).ok)
      sum = sum - c:force()[3] / 20
    end
    local theory = math.exp(mu * math.pi)
    assert.is_true(math.abs(sum / theory - 1) < 0.02, sum .. " instead of " .. theory)
  end)
end)

describe("an impact of two wires", function()
  -- Nearly rigid or soft wires. After the impact they move with their common speed at the place of impact.
  local function crash(EI, friction)
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local function wire(from, to, mass, speed)
      local w = s:wire{ from = from, to = to, mass_per_length = mass, EA = 1e6, EI = EI,
        radius = 0.002, segments = 9 }
      local k = mass / 0.01
      return w, s:force{ kind = "line", on = w,
        force = { k * speed[1], k * speed[2], k * speed[3] } }
    end
    local a, fa = wire({ -0.1, 0, 0 }, { 0.1, 0, 0 }, 0.1, { 0, 0, 0.5 })
    local b, fb = wire({ 0.01, -0.05, 0.05 }, { 0.01, 0.07, 0.05 }, 0.05, { 0.2, 0, -1.5 })
    s:wire_contact{ friction = friction }
    s:advance({ dt = 0.001, integrator = "sdirk2" }, 0.01)
    fa:release()
    fb:release()
    local before, energy = momentum({ a, b }, { 0.1, 0.05 }), s:energy().kinetic
    assert.is_true(s:advance({ dt = 0.001 }, 0.033).ok) -- they touch at 0.033 s
    local last, gain = s:energy().total, 0
    for i = 1, 20 do
      assert.is_true(s:advance({ dt = 0.001 }, 0.033 + 0.001 * i).ok)
      local total = s:energy().total
      last, gain = total, math.max(gain, total - last)
    end
    return { before = before, after = momentum({ a, b }, { 0.1, 0.05 }), energy = energy,
      left = last, gain = gain, a = a, b = b }
  end

  it("keeps the momentum and gains no energy", function()
    for _, case in ipairs{ { 1e-2, 0 }, { 1, 0.4 }, { 1e3, 0 }, { 1e3, 0.3 } } do
      local r = crash(case[1], case[2])
      for k = 1, 3 do
        assert.is_true(math.abs(r.after[k] - r.before[k]) < 1e-9, r.after[k] .. " from " .. r.before[k])
      end
      assert.is_true(math.abs(r.before[3]) > 5e-4)
      assert.is_true(r.gain < 1e-4 * r.energy, r.gain)
      assert.is_true(r.left < 0.8 * r.energy)
    end
  end)

  it("leaves rigid wires moving together and loses the energy of a plastic impact", function()
    local r = crash(1e3, 0)
    local away = r.b:velocity(0.05)[3] - r.a:velocity(0.11)[3]
    assert.is_true(math.abs(away) < 0.05, away)
    -- plastic impact of two rigid rods that touch at offsets d from their centres: the effective mass there
    -- is m/(1 + 12 d^2/L^2); the energy lost is half the reduced effective mass times the square of the
    -- approach speed of 2 m/s
    local function effective(m, L, d) return m / (1 + 12 * d * d / (L * L)) end
    local ma, mb = effective(0.02, 0.2, 0.01), effective(0.006, 0.12, 0.01)
    local loss = 0.5 * ma * mb / (ma + mb) * 4
    -- the allowance covers the loss of implicit Euler in the step of the impact: 2 %
    assert.is_true(math.abs((r.energy - r.left) / loss - 1) < 0.03, (r.energy - r.left) / loss)
  end)
end)

local function sub(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end

local function unit_cross(a, b)
  local c = { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
  local n = dot(c, c) ^ 0.5
  if n == 0 then return { 0, 0, 0 } end
  return { c[1] / n, c[2] / n, c[3] / n }
end

-- Gauss's linking number of two closed polygons, from the solid angles of their pairs of segments.
local function linking(p, q)
  local sum = 0
  for i = 1, #p do
    for j = 1, #q do
      local a, b, c, d = p[i], p[i % #p + 1], q[j], q[j % #q + 1]
      local r13, r14, r23, r24 = sub(c, a), sub(d, a), sub(c, b), sub(d, b)
      local n = { unit_cross(r13, r14), unit_cross(r14, r24), unit_cross(r24, r23),
        unit_cross(r23, r13) }
      local area = 0
      for k = 1, 4 do
        area = area + math.asin(math.max(-1, math.min(1, dot(n[k], n[k % 4 + 1]))))
      end
      local r12, r34 = sub(b, a), sub(d, c)
      local turn = { r34[2] * r12[3] - r34[3] * r12[2], r34[3] * r12[1] - r34[1] * r12[3],
        r34[1] * r12[2] - r34[2] * r12[1] }
      sum = sum + (dot(turn, r13) > 0 and area or -area)
    end
  end
  return sum / (4 * math.pi)
end

-- Returns a wire's nodes as a polygon, closed through points far away along x.
local function closed(w, x)
  local flat, list = w:positions(), {}
  for i = 1, #flat, 3 do list[#list + 1] = { flat[i], flat[i + 1], flat[i + 2] } end
  local first, last = list[1], list[#list]
  list[#list + 1] = { x, last[2], last[3] }
  list[#list + 1] = { x, first[2], first[3] }
  return list
end

describe("wires driven into each other at 30 m/s with 10 ms steps", function()
  -- Both are held at both ends, so one must stay hooked on the other.
  local function drive(o)
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local soft = { EA = 50, EI = 1e-4, mass_per_length = 0.02, radius = 0.001 }
    local function wire(from, to, n)
      local t = { from = from, to = to, segments = n }
      for k, v in pairs(soft) do t[k] = v end
      return s:wire(t)
    end
    local a = wire({ 0.2, -0.3, 0 }, { 0.2, 0.3, 0 }, o.n)
    local d = { 0, 0.3 * math.sin(o.tilt), 0.3 * math.cos(o.tilt) }
    local b = wire({ 0, o.y - d[2], -d[3] }, { 0.4 * o.skew, o.y + d[2], d[3] }, o.n + 3)
    for _, w in ipairs{ a, b } do
      for _, at in ipairs{ 0, w.length } do
        local c = s:clamp(w, { s = at })
        if w == b then
          c:follow{ points = { { 0, 0, 0 }, { 0.3, 0, 0 } }, relative = true, duration = 0.01,
            law = "linear" }
        end
      end
    end
    s:wire_contact{ friction = o.friction }
    assert.is_true(math.abs(math.abs(linking(closed(a, -10), closed(b, 10))) - 1) < 0.01)
    for i = 1, 6 do
      local r = s:advance({ dt = 0.01, integrator = o.integrator }, i * 0.01)
      if not r.ok then return r.reason end
    end
    -- closed far behind and far ahead, both are linked as long as b is hooked on a
    local linked = linking(closed(a, -10), closed(b, 10))
    if math.abs(math.abs(linked) - 1) > 0.01 then return "linking number " .. linked end
  end

  it("do not pass through each other", function()
    math.randomseed(5)
    for k = 1, 40 do
      local o = { n = math.random(8, 40), tilt = (math.random() - 0.5) * 1.6,
        y = (math.random() - 0.5) * 0.2, skew = (math.random() - 0.5) * 0.3, friction = 0.2 }
      assert.is_nil(drive(o), "case " .. k)
    end
  end)

  it("do not pass through each other with other implicit integrators", function()
    for _, integrator in ipairs{ "sdirk2", "implicit-euler", "bdf2" } do
      assert.is_nil(drive{ n = 20, tilt = 0.3, y = 0.05, skew = 0.1, friction = 0.2,
        integrator = integrator }, integrator)
    end
  end)
end)
