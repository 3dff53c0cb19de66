-- SPDX-License-Identifier: GPL-3.0-or-later
-- The ring: its queries are compared with sampling where it is thin or nearly closed. A wire is wound
-- around its tube, one hangs through it, one is taken along by it.
local core = require "softworld.core"
local tools = require "shape.tools"
local vec = require "softworld.vec"

local near = tools.near

describe("a torus", function()
  it("has the distance of its formula, on its axis and circle too", function()
    local ring = core.shape { shape = "torus", radius = 0.3, tube = 0.1 }
    local random = tools.random(71)
    for _ = 1, 2000 do
      local p = random.vector(0.6)
      local rho = (p[1] ^ 2 + p[2] ^ 2) ^ 0.5
      near(((rho - 0.3) ^ 2 + p[3] ^ 2) ^ 0.5 - 0.1, (ring:distance(p)), 1e-15)
    end
    near(0.2, (ring:distance { 0, 0, 0 }), 1e-15)
    near(0.4, (ring:distance { 0, 0, 0.4 }), 1e-15)
    near(-0.1, (ring:distance { 0, 0.3, 0 }), 1e-15)
    local low, high = ring:bounds()
    assert.same({ -0.4, -0.4, -0.1 }, low)
    assert.same({ 0.4, 0.4, 0.1 }, high)
  end)

  -- Sampled at n places, a minimum is found to (length/n)^2/8 times the curvature of the distance, which is
  -- below 1/distance to the circle: 1e-4 here. Both minima of a segment over the ring must be found.
  it("finds every place along a segment that is nearer than those beside it", function()
    local random, n, twice, once = tools.random(72), 600, 0, 0
    for _, tube in ipairs { 0.005, 0.15, 0.49 } do
      local ring = core.shape { shape = "torus", radius = 0.5, tube = tube }
      for i = 1, 300 do
        local a, b = random.vector(1), random.vector(1)
        if i % 3 == 0 then b = tools.scale(a, -1) end -- through the middle of the hole
        if i % 9 == 0 then a[3], b[3] = 0, 0 end -- and through the circle
        local gaps, want = {}, {}
        for k = 0, n do gaps[k] = ring:distance(tools.lerp(a, b, k / n)) end
        local length = tools.norm(tools.sub(b, a))
        for k = 1, n - 1 do
          local line = gaps[0] + k / n * (gaps[n] - gaps[0])
          if gaps[k] < gaps[k - 1] and gaps[k] <= gaps[k + 1] and gaps[k] < line - 1e-3 then
            want[#want + 1] = k
          end
        end
        local found = ring:segment(a, b, 10)
        for _, k in ipairs(want) do
          local best = math.huge
          for _, c in ipairs(found) do best = math.min(best, math.abs(c.at - k / n)) end
          assert.is_true(best <= 1.5 / n, ("tube %g, pair %d: missed at %g"):format(tube, i, k / n))
        end
        for j, c in ipairs(found) do
          local p = tools.lerp(a, b, c.at)
          near(c.gap, (ring:distance(p)), 1e-12)
          assert.is_true(math.abs(tools.dot(c.normal, tools.sub(b, a))) < 1e-6 * length, "across the segment")
          near(c.gap, tools.dot(c.normal, tools.sub(p, c.point)), 1e-12, "gap along the normal")
          assert.is_true(j == 1 or c.gap >= found[1].gap, "nearest first")
        end
        if #found == 2 then twice = twice + 1 elseif #found == 1 then once = once + 1 end
      end
    end
    assert.is_true(twice > 100 and once > 100, twice .. " " .. once)
  end)

  it("lets a segment through its hole, and none through its tube", function()
    local ring, random = core.shape { shape = "torus", radius = 0.2, tube = 1e-3 }, tools.random(73)
    for i = 1, 400 do
      local way = random.vector(1)
      way = tools.scale(way, 10 ^ (1 + random.number()) / tools.norm(way))
      local turn = math.pi * random.number()
      local at = { 0.2 * math.cos(turn), 0.2 * math.sin(turn), 0 }
      local along = tools.scale(random.vector(1), 0.05) -- some place of it meets the circle
      local mid = tools.sub(at, tools.scale(way, 0.4))
      local a, b = tools.sub(mid, tools.scale(along, 0.3)), tools.add(mid, tools.scale(along, 0.7))
      assert.is_not_nil(ring:sweep(a, b, tools.add(a, way), tools.add(b, way), 0), "pair " .. i)
    end
    for i = 1, 100 do -- along the axis, however fast
      local x, y = 0.1 * random.number(), 0.1 * random.number()
      local far = 10 ^ (1 + random.number())
      local a0, b0, a1, b1 = { x, y, -far }, { x, y, -far - 0.1 }, { x, y, far }, { x, y, far - 0.1 }
      assert.is_nil(ring:sweep(a0, b0, a1, b1, 0), i)
    end
  end)
end)

-- Returns the ratio of the pulls at both ends of a wire drawn around the tube, through the hole.
local function capstan(mu, degrees, radius)
  local T, RADIUS, IN = 0.05, 0.0005, 1
  local angle, path, Rw = math.rad(degrees), {}, T + RADIUS
  local first, last = math.pi + angle / 2, math.pi - angle / 2 -- the middle is towards the axis
  local function place(a) return { Rw * math.cos(a), 0, Rw * math.sin(a) } end
  local function along(a) return { math.sin(a), 0, -math.cos(a) } end
  local p, t, q, u = place(first), along(first), place(last), along(last)
  for i = 10, 1, -1 do path[#path + 1] = { p[1] - 0.01 * i * t[1], 0, p[3] - 0.01 * i * t[3] } end
  for i = 0, 200 do path[#path + 1] = place(first + (last - first) * i / 200) end
  for i = 1, 10 do path[#path + 1] = { q[1] + 0.01 * i * u[1], 0, q[3] + 0.01 * i * u[3] } end
  local s = core.scene{ gravity = { 0, 0, 0 } }
  local w = s:wire{ model = "string", EA = 1e4, EI = 1e-9, mass_per_length = 0.1, radius = RADIUS,
    path = path, segments = 120 }
  s:obstacle{ shape = "torus", radius = radius, tube = T, friction = mu, at = { radius, 0, 0 } }
  s:force{ kind = "point", on = w, s = 0, force = { -IN * t[1], 0, -IN * t[3] } }
  s:force{ kind = "damping", mass = 20, on = w }
  local c = s:pin(w, { s = w.length })
  s:advance({ dt = 0.002 }, 0.2)
  c:follow{ points = { { 0, 0, 0 }, { 0.02 * u[1], 0, 0.02 * u[3] } }, relative = true, speed = 0.02,
    law = "linear" }
  local sum = 0
  for i = 1, 20 do
    assert.is_true(s:advance({ dt = 0.002 }, 0.6 + 0.01 * i).ok)
    local f = c:force()
    sum = sum + (f[1] ^ 2 + f[3] ^ 2) ^ 0.5 / 20
  end
  return sum / IN
end

describe("a wire and a ring", function()
  -- As around a cylinder (2 % there too): chords of 120 segments, pulls averaged over the slide. The wire
  -- lies in the hole; nowhere does it pass the outside of a ring of this radius.
  for _, case in ipairs{ { 0.3, 90, 0.2 }, { 0.3, 180, 0.2 }, { 0.5, 180, 1 } } do
    it(("wound around the tube is drawn with exp(mu angle): mu %g, %d degrees"):format(case[1], case[2]),
      function()
        local theory = math.exp(case[1] * math.rad(case[2]))
        near(1, capstan(table.unpack(case)) / theory, 0.02, "share of the theory")
      end)
  end

  -- The ring stands upright with the lowest place of its hole at `at`; everything is turned by q. Returns
  -- the force on the ring in the turned axes, the wire's weight, and a function that carries the ring on.
  local function hung(at, q)
    local s, path = core.scene{ gravity = vec.rotate(q, { 0, 0, -9.80665 }) }, {}
    local function put(y, z) path[#path + 1] = vec.add(at, vec.rotate(q, { 0, y, z })) end
    for i = 0, 10 do put(-0.011, -0.2 + 0.02 * i) end
    for i = 1, 20 do
      local a = math.pi * (1 - i / 20)
      put(0.011 * math.cos(a), 0.011 * math.sin(a))
    end
    for i = 1, 10 do put(0.011, -0.02 * i) end
    local w = s:wire{ model = "string", EA = 1e4, EI = 1e-7, mass_per_length = 0.05, radius = 0.001,
      path = path, segments = 60 }
    local ring = s:obstacle{ shape = "torus", radius = 0.05, tube = 0.01, friction = 0.3,
      at = vec.add(at, vec.rotate(q, { 0, 0, 0.05 })),
      rotation = vec.multiply(q, vec.turn({ 1, 0, 0 }, math.pi / 2)) }
    s:force{ kind = "damping", mass = 30, on = w }
    assert.is_true(s:advance({ dt = 0.002 }, 1).ok)
    local function turned(v) return vec.rotate(vec.conjugate(q), v) end
    return turned(ring:force()), 0.05 * w.length * 9.80665, function(by) -- moves by that and half round
      ring:follow{ points = { { 0, 0, 0 }, vec.rotate(q, by) }, relative = true, speed = 0.5,
        turn = { axis = vec.rotate(q, { 0, 0, 1 }), angle = math.pi } }
      assert.is_true(s:advance({ dt = 0.005 }, 2).ok)
      local place = turned(vec.sub(w:position(w.length / 2), (ring:pose())))
      assert.is_true(s:advance({ dt = 0.005 }, 6).ok) -- it swings for three seconds after the way
      return place, turned(ring:force())
    end
  end

  it("hung through it loads it with its weight", function()
    local f, weight = hung({ 0, 0, 0 }, { 1, 0, 0, 0 })
    near(-weight, f[3], 1e-3 * weight, "weight")
    near(0, f[2], 1e-3)
  end)

  -- Rounding of places at 1 km, 1e-13 m, grows with slides and touches to 1e-5 m after a second. While the
  -- wire slides, 1e-7 m are EA 1e-7 m / 0.4 m = 3e-3 N, so forces are compared at rest, where they are the
  -- weight.
  it("do the same a kilometre away, turned, and carried on by a trajectory", function()
    local f0, weight, carry0 = hung({ 0, 0, 0 }, { 1, 0, 0, 0 })
    local place0, after0 = carry0{ 0.3, 0, 0.2 }
    near(-weight, after0[3], 1e-4 * weight, "the weight, after the way")
    for _, case in ipairs{ { { 1000, -500, 300 }, { 1, 0, 0, 0 } }, { { 3, 4, 5 }, { 0.5, 0.5, 0.5, 0.5 } },
      { { -20, 4, 5 }, vec.turn({ 0.6, 0, 0.8 }, 1.1) } } do
      local f, _, carry = hung(table.unpack(case))
      local place, after = carry{ 0.3, 0, 0.2 }
      for k = 1, 3 do
        near(f0[k], f[k], 1e-5 * weight, "force at rest")
        near(place0[k], place[k], 1e-5, "place of the wire's middle in the ring")
        near(after0[k], after[k], 1e-4 * weight, "force after the way")
      end
    end
  end)

  it("threaded through it is taken along, at 20 m/s in steps of 10 ms too", function()
    for _, speed in ipairs{ 0.5, 20 } do
      local s = core.scene{ gravity = { 0, 0, 0 } }
      local w = s:wire{ EA = 1e3, EI = 1e-4, mass_per_length = 0.02, radius = 0.001, from = { 0, 0, -0.2 },
        to = { 0, 0, 0.2 }, segments = 20 }
      local ring = s:obstacle{ shape = "torus", radius = 0.02, tube = 0.004, friction = 0.1 }
      ring:follow{ points = { { 0, 0, 0 }, { 0.5, 0.1, 0 } }, speed = speed, law = "linear" }
      local duration = 0.5099 / speed
      local last, threaded = 0, 0
      while last < duration do
        last = math.min(duration, last + 0.01)
        assert.is_true(s:advance({ dt = 0.01 }, last).ok)
        local at, inside = ring:pose(), 0
        for i = 1, 2000 do -- where it goes through the ring's plane
          local p, q = w:position((i - 1) * w.length / 2000), w:position(i * w.length / 2000)
          if (p[3] < 0) ~= (q[3] < 0) then
            local off = ((p[1] - at[1]) ^ 2 + (p[2] - at[2]) ^ 2) ^ 0.5
            inside = inside + (off < 0.02 and 1 or 0)
          end
        end
        threaded = threaded + inside % 2
        if last == duration then assert.equal(1, inside % 2, speed .. " m/s") end
      end
      assert.is_true(threaded > 0)
      assert.is_true(w:position(0.2)[1] > 0.3, "taken along")
    end
  end)
end)
