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
