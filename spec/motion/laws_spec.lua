-- SPDX-License-Identifier: GPL-3.0-or-later
-- Each law against its formula, timing, corners and turns.
package.path = "./?.lua;" .. package.path
local core = require "softworld.core"
local d = require "spec.motion.differences"
local make = core.trajectory

local function near(expected, actual, tolerance)
  assert.is_true(math.abs(expected - actual) <= (tolerance or 1e-12),
    ("expected %.15g, got %.15g"):format(expected, actual))
end

local straight = { { 0, 0, 0 }, { 0.6, 0, 0 } }

describe("linear", function()
  it("has the given speed from the first moment", function()
    local m = make { points = straight, speed = 0.2, law = "linear" }
    near(3, m:duration())
    near(0.2 * 1.3, m:position(1.3)[1])
    near(0.2, m:velocity(0)[1])
    near(0.2, m:velocity(2.999)[1])
  end)

  it("passes through timed way-points", function()
    local m = make { points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, times = { 1, 3, 3.5 },
      law = "linear" }
    near(0.5, m:velocity(2.9)[1])
    near(2, m:velocity(3.1)[2])
    near(0.2, m:position(3.1)[2])
  end)
end)

-- Legs end where the sum of their times says, rounded. A time just before that end may lie behind the leg's
-- own end by a rounding; with corners of no width this was a corner of 0/0.
describe("way-points without a blend", function()
  it("are passed at any time", function()
    for _, o in ipairs{ { law = "linear" }, { law = "trapezoidal", blend = 0 },
      { law = "linear", blend = 0.001 } } do
      for count = 2, 60 do
        local points = {}
        for k = 0, count do
          points[k + 1] = { 0.25, 0.052 * math.sin(k / count), -0.052 * math.cos(k / count) }
        end
        local m = make{ points = points, duration = 1, law = o.law, blend = o.blend,
          turn = { axis = { 1, 0, 0 }, angle = 1 } }
        for k = 0, count do
          for ulp = -3, 3 do
            local p = m:position(k / count * (1 + ulp * 2 ^ -53))
            local far = (p[2] ^ 2 + p[3] ^ 2) ^ 0.5
            assert.is_true(far > 0.04 and far < 0.0521, ("%s, %d legs, at %d: %g"):format(o.law,
              count, k, far))
          end
        end
      end
    end
  end)
end)

describe("trapezoidal", function()
  it("speeds up, cruises and brakes", function()
    local m = make { points = straight, speed = 0.2, acceleration = 0.1, law = "trapezoidal" }
    near(0.6 / 0.2 + 0.2 / 0.1, m:duration())
    near(0.5 * 0.1 * 1.5 ^ 2, m:position(1.5)[1])
    near(0.2, m:velocity(2.5)[1])
    near(-0.1, m:acceleration(4.5)[1])
    near(0.6 - 0.5 * 0.1 * 0.5 ^ 2, m:position(4.5)[1])
  end)

  it("does not cruise on a short way", function()
    local m = make { points = straight, speed = 2, acceleration = 0.6, law = "trapezoidal" }
    near(2, m:duration())
    near(0.6, m:velocity(1 - 1e-15)[1])
    near(0.3, m:position(1)[1])
  end)

  it("without an acceleration speeds up and brakes for a third each", function()
    local m = make { points = straight, speed = 0.2, law = "trapezoidal" }
    near(1.5 * 0.6 / 0.2, m:duration())
    near(0.2, m:velocity(1.5)[1])
    near(0.2 / 1.5, m:acceleration(1.4)[1])
  end)

  it("finds the speed for a duration and an acceleration", function()
    local m = make { points = straight, duration = 5, acceleration = 0.1, law = "trapezoidal" }
    near(0.2, m:velocity(2.5)[1])
    near(0.1, m:acceleration(0.5)[1])
    assert.has_error(function()
      make { points = straight, duration = 4, acceleration = 0.1, law = "trapezoidal" }
    end, "trajectory: duration = 4 s is too short for the acceleration; it takes at least 4.89898 s")
  end)

  it("divides a duration among several legs", function()
    local m = make { points = { { 0, 0, 0 }, { 0.3, 0, 0 }, { 0.3, 0.1, 0 } }, stop = true, duration = 4,
      law = "trapezoidal" }
    near(0.3, m:position(3)[1])
    near(0, d.norm(m:velocity(3)), 1e-9)
    near(0.15, m:velocity(1.5)[1])
    near(0.15, m:velocity(3.5)[2])
  end)
end)

describe("minimum-jerk", function()
  it("is the quintic from rest to rest, at most at the speed given", function()
    local m = make { points = straight, speed = 0.2 }
    assert.are.equal("minimum-jerk", m:law())
    local T = 1.875 * 0.6 / 0.2
    near(T, m:duration())
    for _, u in ipairs { 0.1, 0.35, 0.5, 0.8 } do
      near(0.6 * (10 * u ^ 3 - 15 * u ^ 4 + 6 * u ^ 5), m:position(u * T)[1])
      near(0.6 / T * (30 * u ^ 2 - 60 * u ^ 3 + 30 * u ^ 4), m:velocity(u * T)[1])
      near(0.6 / T ^ 2 * (60 * u - 180 * u ^ 2 + 120 * u ^ 3), m:acceleration(u * T)[1])
    end
    near(0.2, m:velocity(T / 2)[1])
  end)

  it("takes longer to keep an acceleration limit", function()
    local m = make { points = straight, speed = 10, acceleration = 0.3 }
    near(math.sqrt(10 / math.sqrt(3) * 0.6 / 0.3), m:duration())
    near(0.3, m:acceleration(m:duration() * (0.5 - math.sqrt(3) / 6))[1])
  end)

  it("rests at every timed way-point", function()
    local m = make { points = { { 0, 0, 0, t = 0 }, { 1, 0, 0, t = 1 }, { 1, 1, 0, t = 3 } },
      law = "minimum-jerk" }
    near(0, d.norm(m:velocity(1)))
    near(0.5, m:position(0.5)[1])
    near(0.5, m:position(2)[2])
  end)
end)

describe("spline", function()
  local points = { { 0, 0, 0 }, { 0.2, 0.1, 0 }, { 0.3, 0.3, 0.1 }, { 0.1, 0.5, 0 } }

  it("passes its way-points with continuous acceleration", function()
    local times = { 0, 1, 1.7, 3 }
    local m = make { points = points, times = times }
    assert.are.equal("spline", m:law())
    for i, p in ipairs(points) do
      near(0, d.apart(m:position(times[i]), p))
      if i > 1 and i < 4 then
        near(0, d.apart(m:acceleration(times[i] - 1e-10), m:acceleration(times[i] + 1e-10)), 1e-8)
      end
    end
    near(0, d.norm(m:velocity(1e-12)), 1e-10)
  end)

  it("reaches the speed given and does not exceed it", function()
    local m, most = make { points = points, speed = 0.25, law = "spline" }, 0
    for i = 0, 100000 do most = math.max(most, d.norm(m:velocity(m:duration() * i / 100000))) end
    assert.is_true(most <= 0.25)
    near(0.25, most, 1e-8)
  end)

  it("keeps within a given acceleration", function()
    local m, most = make { points = points, speed = 5, acceleration = 0.8, law = "spline" }, 0
    for i = 0, 100000 do most = math.max(most, d.norm(m:acceleration(m:duration() * i / 100000))) end
    assert.is_true(most <= 0.8)
    near(0.8, most, 1e-4)
  end)

  it("between two points is the cubic at rest at both ends", function()
    local m = make { points = straight, duration = 2, law = "spline" }
    near(0.6 * (3 * 0.25 ^ 2 - 2 * 0.25 ^ 3), m:position(0.5)[1])
    near(0.6, m:length())
  end)
end)

describe("corners", function()
  local corner = { { 0, 0, 0 }, { 0.5, 0, 0 }, { 0.5, 0.5, 0 } }

  it("of a right angle are blended, 0.265 times the blend off the point", function()
    local m = make { points = corner, speed = 0.1, blend = 0.08, law = "linear" }
    near(0, d.apart(m:position(4.2), { 0.42, 0, 0 }))
    near(0, d.apart(m:position(5.8), { 0.5, 0.08, 0 }))
    near(0.08 * 3 / 8 * math.sqrt(0.5), 0.5 * d.norm({ 2 * (0.5 - m:position(5)[1]), 2 * m:position(5)[2] }))
    near(0.1 / math.sqrt(2), d.norm(m:velocity(5)))
    assert.is_true(m:length() < 1 and m:length() > 1 - 2 * 0.08 + 0.16 / math.sqrt(2))
  end)

  it("pass the point itself without a blend", function()
    local m = make { points = corner, speed = 0.1, blend = 0, law = "trapezoidal" }
    near(0, d.apart(m:position(m:duration() / 2), corner[2]))
    near(1, m:length())
  end)

  it("are blended over a tenth of the shorter leg by default", function()
    local m = make { points = corner, speed = 0.1 }
    local least = 1
    for i = 0, 10000 do
      local p = m:position(m:duration() * i / 10000)
      least = math.min(least, d.norm { p[1] - 0.5, p[2], p[3] })
    end
    near(0.05 * 3 / 8 * math.sqrt(0.5), least, 1e-7)
  end)

  it("come to rest where the path turns back", function()
    local m = make { points = { { 0, 0, 0 }, { 0, 0, -0.1 }, { 0, 0, 0 } }, speed = 0.1 }
    near(-0.1, m:position(m:duration() / 2)[3])
    near(0, d.norm(m:velocity(m:duration() / 2)))
    m = make { points = { { 0, 0, 0 }, { 0, 0, -0.1 }, { 0, 0, 0 } }, speed = 0.1, stop = false }
    assert.is_true(m:position(m:duration() / 2)[3] > -0.1)
  end)

  it("are blended at most to the middle of a leg", function()
    local m = make { points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0.1, 0.1, 0 }, { 0, 0.1, 0 } }, duration = 3,
      blend = 5, law = "linear" }
    near(0, d.apart(m:position(1.5), { 0.1, 0.05, 0 }))
  end)
end)

describe("turning", function()
  it("takes the shortest arc, exactly", function()
    local a, b = d.turn({ 1, 2, 3 }, 0.4), d.turn({ -1, 0.5, 1 }, 2.5)
    local flipped = { -b[1], -b[2], -b[3], -b[4] }
    for _, target in ipairs { b, flipped } do
      local m = make { points = { { 0, 0, 0, rotation = a }, { 0, 0, 0, rotation = target } }, duration = 2,
        law = "linear" }
      local dot = a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4]
      local sign, half = dot < 0 and -1 or 1, math.acos(math.abs(dot))
      for _, u in ipairs { 0, 0.3, 0.75, 1 } do
        local q, same = m:rotation(2 * u), 0
        for i = 1, 4 do
          local mix = math.sin((1 - u) * half) * a[i] + math.sin(u * half) * sign * b[i]
          same = same + q[i] * mix / math.sin(half)
        end
        near(1, math.abs(same), 1e-14)
      end
      near(half, d.norm(m:angular_velocity(1)))
    end
  end)

  it("goes round as often as given", function()
    local m = make { points = { { 0, 0, 0 }, { 0, 0, 1 } }, turn = { axis = { 0, 0, 2 },
      angle = 9 * math.pi },
      speed = 0.5, law = "linear" }
    near(4.5 * math.pi, m:angular_velocity(1)[3])
    near(1, math.abs(m:rotation(2)[4]))
    near(math.cos(9 * math.pi / 8), m:rotation(0.5)[1])
  end)

  it("can be given from way-point to way-point", function()
    local m = make { points = { { 0, 0, 0 }, { 1, 0, 0, turn = { axis = { 0, 0, 1 }, angle = 3 * math.pi } },
      { 2, 0, 0 }, { 3, 0, 0, turn = { axis = { 1, 0, 0 }, angle = -1 } } }, duration = 3, law = "linear" }
    near(3 * math.pi, m:angular_velocity(0.5)[3])
    near(0, d.norm(m:angular_velocity(1.5)))
    near(0, d.apart(m:angular_velocity(2.5), { -1, 0, 0 }))
  end)

  it("slows the move down to keep an angular speed", function()
    local m = make { points = { { 0, 0, 0 }, { 0.1, 0, 0, rotation = { axis = { 0, 1, 0 }, angle = 1 } } },
      speed = 1, angular_speed = 0.5, law = "linear" }
    near(2, m:duration())
    near(0.05, m:velocity(1)[1])
  end)
end)

describe("a displacement", function()
  it("begins at zero and is added in world axes", function()
    local m = make { points = { { 0, 0, 0.1 } }, relative = true, duration = 1 }
    assert.is_true(m:relative())
    near(0, d.norm(m:position(0)))
    local placed = m:placed({ 1, 0, 0 }, { axis = { 1, 0, 0 }, angle = 1 })
    near(0, d.apart(placed:position(2), { 1, 0, 0.1 }))
    near(0, d.apart(placed:rotation(2), d.turn({ 1, 0, 0 }, 1)))
  end)

  it("turns about the world's axes on the spot", function()
    local m = make { turn = { axis = { 0, 0, 1 }, angle = 10 }, relative = true, angular_speed = 2 }
    local placed = m:placed({ 1, 2, 3 }, { axis = { 1, 0, 0 }, angle = 1 })
    near(0, d.apart(placed:rotation(100), d.multiply(d.turn({ 0, 0, 1 }, 10), d.turn({ 1, 0, 0 }, 1))))
    near(2, placed:angular_velocity(placed:duration() / 2)[3])
  end)
end)

describe("bulk samples", function()
  it("equal single samples", function()
    local m = make { points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, turn = { axis = { 1, 0, 0 },
      angle = 2 },
      duration = 2, start = 1 }
    local s = m:sample(11)
    assert.are.equal(11, #s.t)
    assert.are.equal(33, #s.position)
    assert.are.equal(44, #s.rotation)
    for i = 1, 11 do
      assert.are.same(m:velocity(s.t[i]), { table.unpack(s.velocity, 3 * i - 2, 3 * i) })
      assert.are.same(m:rotation(s.t[i]), { table.unpack(s.rotation, 4 * i - 3, 4 * i) })
    end
    near(3, s.t[11], 0)
    assert.are.same({ 0, 1, 2 }, m:sample(3, 0, 2).t)
  end)
end)
