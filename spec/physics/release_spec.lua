-- SPDX-License-Identifier: GPL-3.0-or-later
-- Motion: the released cantilever and the load carried by a moving clamp.
package.path = "./?.lua;" .. package.path
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

-- Returns a function: the change of total energy over what gravity can give, m g L/2.
local function drift(c)
  local scale = c.parameters.mass_per_length * c.frame.g / 2
  local e0 = c.scene:energy().total
  return function() return math.abs(c.scene:energy().total - e0) / scale end
end

describe("a released cantilever", function()
  for _, limit in ipairs{ { 10, 1.5e-3, 5e-3 }, { 100, 5e-3, 1.2e-2 } } do
    it(("follows the reference at gamma = %g and keeps its energy"):format(limit[1]), function()
      local c = cases.release{ gamma = limit[1], every = 0.05 }
      local lost = drift(c)
      t.fine(c.run{ dt = 1e-3 })
      t.below(limit[2], c.largest(0.5), "tip error to 0.5 s [m]")
      t.below(limit[3], c.largest(1), "tip error to 1 s [m]")
      t.below(1e-3, lost(), "energy drift")
    end)
  end

  it("is second order in the segment's length", function()
    -- steps of 0.25 ms: error 1e-6; the reference is good to 5e-6 m, so no finer mesh
    for _, gamma in ipairs{ 10, 100 } do
      t.order_at_least(1.8, { 25, 50, 100 }, function(n)
        local c = cases.release{ gamma = gamma, segments = n }
        t.fine(c.run{ dt = 2.5e-4 })
        return c.error()
      end, ("gamma %g"):format(gamma))
    end
  end)

  it("is within 2.5 mm with few segments and long steps", function()
    local c = cases.release{ segments = 10 }
    t.fine(c.run{ dt = 0.01 })
    t.below(2.5e-3, c.error(), "tip error, 10 segments, 10 ms")
    c = cases.release{ segments = 20 }
    t.fine(c.run{ dt = 0.005 })
    t.below(1e-3, c.error(), "tip error, 20 segments, 5 ms")
  end)

  it("moves the same in a turned and moved scene", function()
    local random = t.random(5)
    local usual = cases.release{ segments = 20 }
    t.fine(usual.run{ dt = 5e-3 })
    for _ = 1, 4 do
      local c = cases.release{ segments = 20, rotation = t.turn(random), at = { 3, -2, 1 } }
      t.fine(c.run{ dt = 5e-3 })
      for i, sample in ipairs(c.samples) do
        -- rounding, grown by a motion that doubles small differences every 0.1 s or so
        t.below(1e-8, t.distance(sample.tip, usual.samples[i].tip), "tip differs by")
      end
    end
  end)

  it("depends on gamma only: gravity scales time by sqrt(L/g)", function()
    local usual, heavy = cases.release{ segments = 20 }, cases.release{ segments = 20,
      gravity = { 0, 0, -4 * 9.81 } }
    t.fine(usual.scene:run{ duration = 0.6, dt = 4e-3 })
    t.fine(heavy.scene:run{ duration = 0.3, dt = 2e-3 })
    t.below(1e-9, t.distance(usual.wire:position(1), heavy.wire:position(1)), "tips differ by")
  end)

  it("gives the clamp the rate of change of momentum", function()
    local c = cases.release{ segments = 30 }
    local dt, T = 1e-3, 0.5
    t.fine(c.scene:run{ duration = T, dt = dt })
    local rows, n = c.clamp:log()
    local sum, before, fx, fz = { 0, 0 }, 0, rows[2], rows[4]
    for i = 0, n - 1 do
      local time, x, z = rows[10 * i + 1], rows[10 * i + 2], rows[10 * i + 4]
      sum[1], sum[2] = sum[1] + (time - before) * (x + fx) / 2, sum[2] + (time - before) * (z + fz) / 2
      before, fx, fz = time, x, z
    end
    local p = t.momentum(c.wire)
    local weight = c.parameters.mass_per_length * 9.81
    -- a trapezoid over 500 rows of a force that rings axially: second order in dt
    t.near(p[1], sum[1], 1e-4 * weight * T, "impulse along")
    t.near(p[3], sum[2] - weight * T, 1e-4 * weight * T, "impulse up")
  end)
end)

describe("a load carried by a clamp", function()
  it("follows the reference", function()
    local c = cases.transport{ every = 0.05 }
    t.fine(c.run{ dt = 1e-3 })
    t.below(0.002, c.largest(1) / c.length, "tip error to 1 s over L")
    t.below(0.01, c.largest(2) / c.length, "tip error to 2 s over L")
  end)

  it("follows it in long steps, too", function()
    local c = cases.transport{ every = 0.05 }
    t.fine(c.run{ dt = 1e-2 })
    t.below(0.002, c.largest(1) / c.length, "tip error to 1 s over L")
  end)

  it("converges at second order", function()
    -- up to 50 segments the error is below its asymptote (2e-4 of L at 25 segments), so
    -- the order is read off the change from mesh to mesh beyond
    local tips = {}
    local function tip(n)
      if not tips[n] then
        local c = cases.transport{ segments = n }
        t.fine(c.run{ dt = 5e-4 })
        tips[n] = c.samples
      end
      return tips[n]
    end
    t.order_at_least(1.8, { 100, 200, 400 }, function(n)
      local sum, a, b = 0, tip(n), tip(2 * n)
      for i = 1, 10 do sum = sum + t.distance(a[i].tip, b[i].tip) ^ 2 end
      return sum ^ 0.5
    end, "change from n to 2n segments")
  end)

  it("loads the clamp with its weight at first, and with the rate of momentum later", function()
    local c = cases.transport{ segments = 30 }
    t.fine(c.scene:settle())
    local weight = c.parameters.mass_per_length * c.length * 9.81
    t.share(weight, c.clamp:force()[3], 1e-9, "weight")
    t.fine(c.run{ dt = 1e-3 })
    local rows, n = c.clamp:log()
    local sum, before, f = 0, 0, 0
    for i = 0, n - 1 do
      local time, x = rows[10 * i + 1], rows[10 * i + 2]
      if time > before then
        sum = sum + (time - before) * (x + f) / 2
        before, f = time, x
      end
    end
    t.near(t.momentum(c.wire)[1], sum, 2e-4 * weight, "impulse along")
  end)
end)
