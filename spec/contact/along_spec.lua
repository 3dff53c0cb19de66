-- SPDX-License-Identifier: GPL-3.0-or-later
-- A straight wire lies lengthwise on a cylinder, off the top, and slides down like a point on a circle. All
-- its places are equally near, so the nearest ones change with the last nanometre.
local scenes = require "spec.contact.scenes"
local core = require "softworld.core"

local R, RADIUS, G = 0.05, 0.0025, 9.81

-- Returns the angle from the top of a point that slides from rest at angle a, after time t.
local function slid(a, mu, t)
  local n, rho = 2000, R + RADIUS
  local h, w = t / 2000, 0
  local function turn(angle, rate)
    return G / rho * (math.sin(angle) - mu * (math.cos(angle) - rho * rate ^ 2 / G))
  end
  for _ = 1, n do -- the midpoint rule
    local half, rate = a + 0.5 * h * w, w + 0.5 * h * turn(a, w)
    a, w = a + h * rate, w + h * turn(half, rate)
  end
  return a
end

local function run(o)
  local s = core.scene{}
  s:obstacle{ shape = "cylinder", radius = R, length = 1, friction = o.friction,
    rotation = { axis = { 0, 1, 0 }, angle = math.pi / 2 } }
  local y, z = 0.02, ((R + RADIUS) ^ 2 - 0.02 ^ 2) ^ 0.5 + (o.drop or 0)
  local w = scenes.add_wire(s, { -0.25, y, z }, { 0.25, y, z }, o.segments)
  local r = s:advance({ dt = o.dt }, o.duration)
  assert.is_true(r.ok, r.reason)
  return w, r, s
end

describe("a wire lying lengthwise along a cylinder", function()
  for _, dt in ipairs{ 0.01, 0.005, 0.002 } do
    for _, n in ipairs{ 24, 60 } do
      it(("slides down as a point does: dt %g s, %d segments"):format(dt, n), function()
        local w, r, s = run{ friction = 0.3, segments = n, dt = dt, duration = 0.2 }
        local exact = slid(math.asin(0.02 / (R + RADIUS)), 0.3, 0.2)
        for _, at in ipairs{ 0, 0.25, 0.5 } do
          local p = w:position(at)
          -- first order in dt, because the slide begins with the first step
          local angle = math.atan(p[2], p[3])
          assert.is_true(math.abs(angle - exact) < 0.5 * dt, angle .. " for " .. exact)
        end
        assert.is_true(s:penetration() < 5e-5)
        assert.is_true(r.rejected <= 2, r.rejected .. " steps rejected")
      end)
    end
  end

  it("lands there with few refused steps", function()
    for _, n in ipairs{ 24, 60 } do
      local _, r = run{ friction = 0.3, segments = n, dt = 0.01, duration = 0.2, drop = 0.02 }
      assert.is_true(r.rejected <= 20, r.rejected .. " steps rejected")
    end
  end)
end)
