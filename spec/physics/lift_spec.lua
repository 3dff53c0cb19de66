-- SPDX-License-Identifier: GPL-3.0-or-later
-- Laying: a wire lifted off a frictionless table by its end.
package.path = "./?.lua;" .. package.path
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

describe("a wire lifted from a table", function()
  for _, kind in ipairs{ "pinned", "horizontal" } do
    for _, h in ipairs{ 0.1, 0.5, 2 } do
      it(("by a %s end to h = %g meets the reference"):format(kind, h), function()
        local c = cases.lift{ hold = kind, h = h }
        t.fine(c.run())
        local m, e = c.measured(), c.exact
        t.share(e.P, m.P, 0.003, "end force")
        if kind == "horizontal" then t.share(-e.M, math.abs(m.M), 0.01, "end moment")
        else t.near(e.angle, m.angle, 0.01, "end angle") end
        t.near(e.a, m.a, 1.5 * c.segment, "free length")
        t.near(e.x_g, m.x_g, 1.5 * c.segment, "distance of lift-off")
        t.near(0, m.H, 1e-6 * m.P, "force along the table")
      end)
    end
  end

  it("by a level end keeps M^2 = 2 w h EI at any height", function()
    for _, h in ipairs{ 0.3, 0.7, 1.3, 3 } do
      local c = cases.lift{ hold = "horizontal", h = h, total = 8, segments = 80 }
      t.fine(c.run())
      t.share((2 * c.weight * c.h * c.EI) ^ 0.5, math.abs(c.measured().M), 0.01, "moment")
    end
  end)

  it("by a pinned end keeps P sin(angle) = w h at any height", function()
    for _, h in ipairs{ 0.3, 0.7, 1.3, 3 } do
      local c = cases.lift{ hold = "pinned", h = h, total = 8, segments = 80 }
      t.fine(c.run())
      local m = c.measured()
      t.share(c.weight * c.h, m.P * math.sin(m.angle), 0.006, "P sin(angle)")
    end
  end)

  it("is second order on average over the lift-off's place in its segment", function()
    -- l = 5 m, so that sinking in by micrometres is nothing compared with the height
    for _, kind in ipairs{ "pinned", "horizontal" } do
      for _, h in ipairs{ 0.1, 0.5, 2 } do
        t.order_at_least(1.8, { 25, 50, 100, 200 }, function(n)
          local sum, shifts = 0, 8
          for k = 0, shifts - 1 do
            local c = cases.lift{ hold = kind, h = h, segments = n, shift = k / shifts, l = 5 }
            t.fine(c.run())
            sum = sum + (c.measured().P / c.exact.P - 1) ^ 2
          end
          return (sum / shifts) ^ 0.5
        end, ("%s, h = %g"):format(kind, h))
      end
    end
  end)

  it("carries a part of the weight at its end", function()
    local c = cases.lift{ hold = "pinned", h = 0.5 }
    local plane = c.scene:obstacle{ shape = "sphere", radius = 0.01, at = { 9, 9, 9 } }
    t.fine(c.run())
    assert.are.same({ 0, 0, 0 }, plane:force())
    local m = c.measured()
    t.above(0, m.P, "end force")
    t.below(c.weight * c.wire.length, m.P, "end force")
  end)

  it("has the same end force in a turned scene", function()
    local random = t.random(13)
    local usual = cases.lift{ hold = "horizontal" }
    t.fine(usual.run())
    for _ = 1, 3 do
      local c = cases.lift{ hold = "horizontal", rotation = t.turn(random), at = { 1, 2, 3 } }
      t.fine(c.run())
      -- different paths to rest; the same rest up to settle's tolerance
      t.share(usual.measured().P, c.measured().P, 1e-5, "end force")
    end
  end)
end)
