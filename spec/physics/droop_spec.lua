-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cantilevers at rest: own weight and end load, against the elastica.
package.path = "./?.lua;" .. package.path
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

-- EA so large that the wire stretches by less than a tenth of any mesh error here.
local stiff = 1e9

-- gamma, tip error over L, relative error of the tip's drop over its reach, both at 50 segments: two to
-- three times the errors of a plain second-order rod.
local limits = { { 1, 2e-4, 0.0015 }, { 10, 7e-4, 0.0015 }, { 100, 2e-3, 0.006 },
  { 1000, 6e-3, 0.06 } }

describe("a wire drooping under its own weight", function()
  for _, limit in ipairs(limits) do
    it(("meets the elastica at gamma = %g"):format(limit[1]), function()
      local c = cases.droop{ gamma = limit[1], axial = stiff }
      t.fine(c.run())
      t.below(limit[2], c.error(), "tip error")
      local m = c.measured()
      t.share(c.exact.z / c.exact.x, m.z / m.x, limit[3], "drop over reach")
    end)
  end

  it("meets it for all gamma between 0.1 and 1000, with the exact clamp moment", function()
    for _, row in ipairs(cases.droop{}.all) do
      local c = cases.droop{ gamma = row[1], axial = stiff }
      t.fine(c.run())
      t.below(row[1] > 300 and 2e-3 or 2.5e-4, c.error(), ("tip error, gamma %g"):format(row[1]))
      -- the moment of the clamp: the weight's lever, so of the order of the tip error
      t.share(c.exact.M0, c.measured().M0, 4e-3, ("moment, gamma %g"):format(row[1]))
    end
  end)

  it("is second order in the segment's length", function()
    for _, gamma in ipairs{ 1, 10, 100, 1000 } do
      t.order_at_least(1.8, { 25, 50, 100, 200 }, function(n)
        local c = cases.droop{ gamma = gamma, segments = n, axial = stiff }
        t.fine(c.run())
        return c.error()
      end, ("gamma %g"):format(gamma))
    end
  end)

  it("loads the clamp with its whole weight, to rounding", function()
    for _, gamma in ipairs{ 0.1, 10, 1000 } do
      local c = cases.droop{ gamma = gamma }
      t.fine(c.run())
      local m = c.measured()
      t.share(c.exact.weight, m.force[3], 1e-9, "force")
      t.near(0, m.force[1], 1e-9 * c.exact.weight, "force across")
      t.near(0, m.force[2], 1e-9 * c.exact.weight, "force across")
    end
  end)

  it("balances the moment of the weight about the clamp, to rounding", function()
    local c = cases.droop{ gamma = 100 }
    t.fine(c.run())
    local x, s = c.wire:positions()
    local w, lever = c.parameters.mass_per_length * 9.81, 0
    for i = 1, #s - 1 do lever = lever + w * (s[i + 1] - s[i]) * (x[3 * i - 2] + x[3 * i + 1]) / 2 end
    t.share(lever, c.measured().M0, 1e-8, "moment")
  end)

  it("depends on gamma only, whatever the gravity", function()
    local usual = cases.droop{ gamma = 10 }
    t.fine(usual.run())
    local m = usual.measured()
    for _, g in ipairs{ 1.62, 24.8, 1e-3, 1e3 } do
      local c = cases.droop{ gamma = 10, gravity = { 0, 0, -g } }
      t.fine(c.run())
      local n = c.measured()
      t.near(m.x, n.x, 1e-9, "tip x")
      t.near(m.z, n.z, 1e-9, "tip z")
    end
  end)

  it("does not change when the whole scene is turned and moved", function()
    local random = t.random(7)
    local usual = cases.droop{ gamma = 100 }
    t.fine(usual.run())
    local m = usual.measured()
    for _ = 1, 8 do
      local c = cases.droop{ gamma = 100, rotation = t.turn(random),
        at = { 5 * random(), 5 * random(), 5 * random() } }
      t.fine(c.run())
      local n = c.measured()
      -- rounding of coordinates of some metres, magnified by the wire's slackness
      t.below(1e-8, t.distance({ m.x, m.y, m.z }, { n.x, n.y, n.z }), "tip moved by")
      t.below(1e-8, t.distance(m.moment, n.moment), "moment changed by")
    end
  end)

  it("meets the elastica with gravity in any direction", function()
    local random = t.random(3)
    for _ = 1, 6 do
      local q = t.turn(random)
      local c = cases.droop{ gamma = 10, axial = stiff,
        gravity = { 9.81 * q[1], 20 * q[2], 3 * q[3] } }
      t.fine(c.run())
      t.below(7e-4, c.error(), "tip error")
    end
  end)

  it("bends the same with the string model while hinge angles are small", function()
    -- the string's linear hinge is too soft by phi^2/8: 2e-4 at 50 segments and gamma 10
    local c = cases.droop{ gamma = 10, model = "string", axial = stiff }
    t.fine(c.run())
    t.below(2e-3, c.error(), "tip error")
  end)
end)

describe("a cantilever with an end load", function()
  for _, limit in ipairs{ { 1, 2e-4 }, { 10, 6e-4 } } do
    it(("meets elliptic integrals at P L^2/EI = %g"):format(limit[1]), function()
      local c = cases.end_load{ load = limit[1] }
      t.fine(c.run())
      t.below(limit[2], c.error(), "tip error")
      local m = c.measured()
      t.near(c.exact.angle, m.angle, 1e-3, "tip angle")
      t.share(c.exact.M0, m.M0, 1e-3, "clamp moment")
      t.share(c.exact.P, m.force[3], 1e-9, "clamp force")
    end)
  end

  it("is second order in the segment's length", function()
    for _, load in ipairs{ 0.5, 1, 4, 10 } do
      t.order_at_least(1.8, { 25, 50, 100, 200 }, function(n)
        local c = cases.end_load{ load = load, segments = n, axial = stiff }
        t.fine(c.run())
        return c.error()
      end, ("load %g"):format(load))
    end
  end)

  it("meets them in a turned scene", function()
    local random = t.random(11)
    for _ = 1, 4 do
      local c = cases.end_load{ load = 2, rotation = t.turn(random) }
      t.fine(c.run())
      t.below(3e-4, c.error(), "tip error")
    end
  end)
end)
