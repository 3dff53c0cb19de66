-- SPDX-License-Identifier: GPL-3.0-or-later
-- Twist of a straight wire between two holds: torque, buckling, post-buckling,
-- closed rings, many turns.
local core = require "softworld.core"

local PI = math.pi

local function twisted(options)
  local o = options or {}
  local s = core.scene{ gravity = o.gravity or { 0, 0, 0 } }
  local w = s:wire{ EA = o.EA or 1e6, EI = o.EI or 1, GJ = o.GJ or 0.7, mass_per_length = 1,
    radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = o.segments or 50 }
  local a, b = s:clamp(w, { s = 0 }), s:clamp(w, { s = 1 })
  return s, w, a, b
end

local function turn(clamp, x, angle) clamp:pose({ x, 0, 0 }, { axis = { 1, 0, 0 }, angle = angle }) end

local function bow(w)
  local p = w:position(0.5)
  return (p[2] ^ 2 + p[3] ^ 2) ^ 0.5
end

describe("a straight wire turned at one end", function()
  it("resists with GJ times the angle over the length", function()
    local s, w, a, b = twisted()
    for _, angle in ipairs{ 0.5, 3, 6, 4, 1, -1.5 } do -- a pose goes the shorter way round
      turn(b, 1, angle)
      local r = s:settle()
      assert.is_true(r.ok, r.reason)
      assert.is_true(math.abs(w:twist_moment(0.3) - 0.7 * angle) < 1e-9)
      assert.is_true(math.abs(b:moment()[1] - 0.7 * angle) < 1e-9)
      assert.is_true(math.abs(a:moment()[1] + 0.7 * angle) < 1e-9)
      assert.is_true(math.abs(s:energy().twist - 0.35 * angle ^ 2) < 1e-8)
    end
  end)

  it("has no torque with one end free", function()
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e6, EI = 1, GJ = 0.7, mass_per_length = 1, radius = 0.001,
      from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 20 }
    local a = s:clamp(w, { s = 0 })
    turn(a, 0, 2)
    assert.is_true(s:settle().ok)
    assert.are.equal(0, w:twist_moment(0.5))
  end)

  it("counts fifty turns without a branch error when it is stretched", function()
    local s, w, _, b = twisted{ EI = 1e-3, GJ = 1e-3 }
    turn(b, 1.001, 0)
    s:settle()
    for i = 1, 50 do
      turn(b, 1.001, 2 * PI * i)
      -- a pose does not count turns: go round in four parts
      for k = 1, 4 do
        turn(b, 1.001, 2 * PI * (i - 1) + k * PI / 2)
        assert.is_true(s:settle().ok)
      end
    end
    assert.is_true(math.abs(w:twist_moment(0.5) - 1e-3 * 100 * PI) < 1e-8)
  end)

  it("gets the same torque in motion, where a trajectory counts turns", function()
    local s, w, _, b = twisted{ EI = 1e-3, GJ = 1e-3 }
    s:force{ kind = "damping", mass = 5 }
    b:follow{ points = { { 0, 0, 0 }, { 0.001, 0, 0 } }, relative = true, duration = 1 }
    assert.is_true(s:advance({ dt = 0.01 }, 1).ok)
    b:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true, duration = 4,
      turn = { axis = { 1, 0, 0 }, angle = 6 * PI } }
    assert.is_true(s:advance({ dt = 0.01 }, 7).ok)
    assert.is_true(math.abs(w:twist_moment(0.5) - 1e-3 * 6 * PI) < 1e-6)
  end)

  it("counts more than half a turn per step, in motion and from pose to pose", function()
    for _, quasistatic in ipairs{ false, true } do
      for _, rest in ipairs{ "straight", "path" } do
        local s = core.scene{ gravity = { 0, 0, 0 } }
        local w = s:wire{ EA = 1e4, EI = 1e-3, GJ = 7e-4, mass_per_length = 0.02, radius = 1e-3,
          from = { 0, 0, 0 }, to = { 1, 0, 0 }, rest = rest, segments = 20 }
        s:clamp(w, { s = 0 })
        local hand = s:clamp(w, { s = 1 })
        hand:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, duration = 0.2, relative = true,
          law = "linear", turn = { axis = { 1, 0, 0 }, angle = 20 * PI } }
        assert.is_true(s:advance({ dt = 0.02, quasistatic = quasistatic }, 0.2).ok)
        local M = hand:moment()
        assert.is_true(math.abs(math.abs(M[1]) / (7e-4 * 20 * PI) - 1) < 1e-4, M[1])
      end
    end
  end)

  it("splits its twist when it is grasped in the middle, and evens it out when let go", function()
    local s, w, _, b = twisted()
    for _, angle in ipairs{ 2, 4 } do
      turn(b, 1, angle)
      s:settle()
    end
    local middle = s:clamp(w, { s = 0.4 })
    assert.is_true(s:settle().ok)
    assert.is_true(math.abs(w:twist_moment(0.2) - 2.8) < 1e-9)
    assert.is_true(math.abs(w:twist_moment(0.7) - 2.8) < 1e-9)
    middle:pose({ 0.4, 0, 0 }, { axis = { 1, 0, 0 }, angle = 1 })
    assert.is_true(s:settle().ok)
    assert.is_true(math.abs(w:twist_moment(0.2) - 0.7 * (1.6 + 1) / 0.4) < 1e-8)
    assert.is_true(math.abs(w:twist_moment(0.7) - 0.7 * (2.4 - 1) / 0.6) < 1e-8)
    middle:release()
    assert.is_true(s:settle().ok)
    assert.is_true(math.abs(w:twist_moment(0.5) - 2.8) < 1e-9)
  end)

  it("keeps its twist exactly in snapshots", function()
    local s, w, _, b = twisted()
    turn(b, 1, 3)
    s:settle()
    local snapshot = s:snapshot()
    turn(b, 1, -2)
    s:settle()
    s:restore(snapshot)
    assert.are.equal(3 * 0.7, w:twist_moment(0.5))
    s:settle()
    assert.is_true(math.abs(w:twist_moment(0.5) - 2.1) < 1e-12)
  end)
end)

-- Greenhill's problem with clamped ends, no tension: M L/EI = 8.986819.
describe("a straight wire under torque", function()
  for _, GJ in ipairs{ 0.5, 0.7, 1 } do
    it(("leaves the straight line at M L/EI = 8.987 (GJ/EI = %g)"):format(GJ), function()
      for _, case in ipairs{ { 0.99, false }, { 1.01, true } } do
        local s, w, _, b = twisted{ GJ = GJ }
        local angle = case[1] * 8.986819 / GJ
        for i = 1, 10 do
          turn(b, 1, angle * i / 10)
          assert.is_true(s:settle().ok)
        end
        -- ends at fixed distance: it bows as far as its stretch lets it
        assert.are.equal(case[2], bow(w) > 1e-5, "bow " .. bow(w))
      end
    end)
  end
end)

-- Clamped ends are brought together by d, then turned by R [degrees]: axial force and torque.
-- Independent shooting solution, error 1e-7; units EI/L^2 and EI/L.
local post = {
  { GJ = 2 / 3, d = 0.1, R = 90, T = -40.44877829, M = 0.9282219291 },
  { GJ = 2 / 3, d = 0.1, R = 180, T = -37.39582745, M = 1.87872062 },
  { GJ = 2 / 3, d = 0.1, R = 360, T = -27.67369354, M = 3.851265222 },
  { GJ = 2 / 3, d = 0.1, R = 540, T = -15.27872242, M = 5.877583277 },
  { GJ = 1, d = 0.3, R = 90, T = -42.70384794, M = 0.6423256277 },
  { GJ = 1, d = 0.3, R = 180, T = -34.369798, M = 1.694956009 },
  { GJ = 1, d = 0.3, R = 360, T = -13.46239318, M = 4.352855371 },
}

local function post_buckled(row, n)
  local s, w, a, b = twisted{ GJ = row.GJ, segments = n, EA = 1e7 }
  local side = s:force{ kind = "line", on = w, force = { 0, 0.5, 0 } }
  turn(b, 1 - row.d, 0)
  assert.is_true(s:settle().ok)
  side:release()
  for angle = 30, row.R, 30 do
    turn(b, 1 - row.d, math.rad(angle))
    local r = s:settle()
    assert.is_true(r.ok, r.reason)
  end
  return -a:force()[1], w:twist_moment(0.5)
end

describe("the buckled wire, turned", function()
  for _, row in ipairs(post) do
    it(("has the force and torque of theory: GJ/EI %.2g, d %g, R %g"):format(row.GJ, row.d, row.R),
      function()
        local T, M = post_buckled(row, 50)
        -- the reference's own tolerances at N = 50: 1 % of the Euler load, 1 % of M
        assert.is_true(math.abs(T - row.T) < 0.01 * 39.5, ("T = %g instead of %g"):format(T, row.T))
        assert.is_true(math.abs(M - row.M) < 0.01 * row.M, ("M = %g instead of %g"):format(M, row.M))
      end)
  end

  it("is second order in the number of segments", function()
    local row = post[2]
    local errors = {}
    for i, n in ipairs{ 25, 50, 100 } do
      local T, M = post_buckled(row, n)
      errors[i] = math.max(math.abs(T - row.T) / 39.5, math.abs(M / row.M - 1))
    end
    local order = math.log(errors[1] / errors[3]) / math.log(4)
    assert.is_true(order > 1.8, "order " .. order)
  end)
end)

-- Michell 1889: a ring of a straight isotropic wire stays a plane circle up to the
-- total twist 2 pi sqrt(3) EI/GJ; then it jumps to a figure of eight (Zajac 1962).
describe("a closed ring", function()
  local function ring(share, GJ)
    local n, path = 60, {}
    local r = 1 / (2 * PI)
    for i = 0, 600 do
      local u = 2 * PI * i / 600
      path[#path + 1] = { r * math.sin(u), r * (1 - math.cos(u)), 0 }
    end
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e6, EI = 1, GJ = GJ, mass_per_length = 1, radius = 0.001, path = path,
      segments = n }
    s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
    local b = s:clamp(w, { s = w.length, direction = { 1, 0, 0 } })
    local r0 = s:settle()
    assert.is_true(r0.ok, r0.reason)
    local angle = share * 2 * PI * math.sqrt(3) / GJ
    local at = b:pose()
    for i = 1, 20 do
      b:pose(at, { axis = { 1, 0, 0 }, angle = angle * i / 20 })
      local result = s:settle()
      assert.is_true(result.ok, result.reason)
    end
    return w:twist_moment(0.5) * w.length / (GJ * angle)
  end

  for _, GJ in ipairs{ 0.77, 1 } do
    it(("jumps out of its plane at 2 pi sqrt(3) EI/GJ (GJ/EI = %g)"):format(GJ), function()
      local below, above = ring(0.98, GJ), ring(1.02, GJ)
      -- share of the twist that is left: a plane ring keeps it all, a figure of
      -- eight has taken up about one turn of it
      assert.is_true(math.abs(below - 1) < 0.01, "below: " .. below)
      assert.is_true(above < 0.8, "above: " .. above)
    end)
  end
end)
