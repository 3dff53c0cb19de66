-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire on a floor, pushed by a wall that gains speed steadily: struck once, it goes on with
-- the wall, which presses with m (a + mu g).
local scenes = require "spec.contact.scenes"
local core = require "softworld.core"

local MASS, G = 0.5 * 0.03, 9.81

local function pushed(o)
  local s = core.scene{}
  s:obstacle{ shape = "plane", friction = o.friction }
  local w = scenes.add_wire(s, { 0, -0.25, 0.0025 }, { 0, 0.25, 0.0025 }, 20)
  local wall = s:obstacle{ shape = "box", size = { 0.02, 1, 0.1 }, at = { -0.0125 - o.gap, 0, 0.05 } }
  assert.is_true(s:advance({ dt = o.dt }, 0.1).ok)
  wall:follow{ func = function(t) return { 0.5 * o.a * t * t, 0, 0 } end, relative = true }
  return s, w, wall
end

describe("a wall that gains speed", function()
  for _, a in ipairs{ 0.02, 0.1, 1 } do
    for _, dt in ipairs{ 0.01, 0.005, 0.002 } do
      it(("pushes steadily what it has struck: %g m/s2, dt %g s"):format(a, dt), function()
        local s, w, wall = pushed{ friction = 0.3, a = a, dt = dt, gap = 0.001 }
        local struck = 0.1 + (2 * 0.001 / a) ^ 0.5
        local exact = MASS * (a + 0.3 * G)
        assert.is_true(s:advance({ dt = dt }, struck + 10 * dt).ok)
        for _ = 1, 40 do
          assert.is_true(s:advance({ dt = dt }, s.time + dt).ok)
          local force, speed = -wall:force()[1], w:velocity(0.25)[1]
          assert.is_true(math.abs(force / exact - 1) < 0.01, force .. " N for " .. exact)
          assert.is_true(math.abs(speed - a * (s.time - 0.1)) < 0.05 * a * dt + 1e-5, "goes on with the wall")
        end
      end)
    end
  end

  it("strikes with the speed it has when it gets there", function()
    -- without friction it may leave the wall again, but not by more than a step's gain
    for _, dt in ipairs{ 0.01, 0.005 } do
      local s, w = pushed{ friction = 0, a = 1, dt = dt, gap = 0.001 }
      assert.is_true(s:advance({ dt = dt }, 0.15).ok)
      for _ = 1, 40 do
        assert.is_true(s:advance({ dt = dt }, s.time + dt).ok)
        local gap = w:position(0.25)[1] + 0.001 - 0.5 * (s.time - 0.1) ^ 2
        assert.is_true(gap > -1e-4 and gap < 2 * dt ^ 2, "gap " .. gap)
      end
    end
  end)
end)

-- A table is lifted by H in T, s(u) = 10 u^3 - 15 u^4 + 6 u^5 with u = t/T, and slows down by more than
-- G. What lies on it leaves where H s'' = -G T^2 and flies: its height when the table stops is that of a
-- throw. A wire that was held back by what it leaves would be lower, the more the smaller the steps: by
-- 1.3 mm of 6.8 once, at 0.4 ms.
describe("a wire on a table that stops", function()
  local H, T, START = 0.1, 0.2, 0.1

  local function thrown()
    local low, high = 0.5, 0.75
    for _ = 1, 60 do
      local u = (low + high) / 2
      if H / T ^ 2 * (60 * u - 180 * u ^ 2 + 120 * u ^ 3) > -G then low = u else high = u end
    end
    local u, left = low, (1 - low) * T
    local z, v = H * (10 * u ^ 3 - 15 * u ^ 4 + 6 * u ^ 5), H / T * (30 * u ^ 2 - 60 * u ^ 3 + 30 * u ^ 4)
    return z + v * left - G / 2 * left ^ 2
  end

  for _, radius in ipairs{ 0.0015, 0.003 } do
    for _, friction in ipairs{ 0, 0.4 } do
      it(("is thrown, radius %g mm, mu %g"):format(1e3 * radius, friction), function()
        for segments, steps in pairs{ [20] = { 1e-2, 2e-3, 5e-4, 4e-4, 3.125e-4, 1e-4 }, [150] = { 4e-4 } } do
          for _, dt in ipairs(steps) do
            local s = core.scene{ gravity = { 0, 0, -G } }
            local w = s:wire{ E = 3e9, density = 3000, radius = radius, from = { -0.3, 0, radius },
              to = { 0.3, 0, radius }, segments = segments }
            local plate = s:obstacle{ shape = "box", size = { 0.8, 0.4, 0.02 }, at = { 0, 0, -0.01 },
              friction = friction }
            assert.is_true(s:advance({ dt = dt }, START).ok)
            plate:follow{ points = { { 0, 0, 0 }, { 0, 0, H } }, relative = true, duration = T }
            assert.is_true(s:advance({ dt = dt }, START + T).ok)
            -- the step in which it leaves is known to h: 5 m/s2 h^2, and what it lay deep, 2 um
            local off = w:position(0.3)[3] - radius - thrown()
            local what = ("%d edges, %g s: off by %g m"):format(segments, dt, off)
            assert.is_true(math.abs(off) < 5 * dt ^ 2 + 2e-6, what)
          end
        end
      end)
    end
  end
end)
