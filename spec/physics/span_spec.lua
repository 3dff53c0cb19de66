-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires held at both ends: catenaries, stiff catenaries, columns.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

describe("a string between two pins", function()
  for _, ratio in ipairs{ 1.05, 1.5 } do
    it(("hangs as a catenary at L/span = %g"):format(ratio), function()
      local c = cases.catenary{ ratio = ratio }
      t.fine(c.run())
      local m = c.measured()
      t.share(c.exact.sag, m.sag, 0.002, "sag")
      t.share(c.exact.H, m.H, 0.002, "force along")
      t.share(c.exact.T, m.T, 0.002, "end force")
      t.share(c.weight / 2, m.V, 1e-6, "half the weight")
    end)

    it(("is second order at L/span = %g"):format(ratio), function()
      t.order_at_least(1.8, { 25, 50, 100, 200 }, function(n)
        local c = cases.catenary{ ratio = ratio, segments = n, axial = 1e7 }
        t.fine(c.run())
        return c.error()
      end, "sag and forces")
    end)
  end

  it("is the limit of a rod whose bending stiffness goes to zero", function()
    local before = math.huge
    for _, EI in ipairs{ 1e-3, 1e-4, 1e-5, 1e-6 } do
      local scene = sw.scene{}
      local c = cases.catenary{ ratio = 1.5 }
      local path = {}
      local x = c.wire:positions()
      for i = 1, #x, 3 do path[#path + 1] = { x[i], x[i + 1], x[i + 2] } end
      local wire = scene:wire{ EA = 1e6 * c.weight, EI = EI, mass_per_length = 0.05, radius = 0.001,
        path = path, segments = 50 }
      local left = scene:pin(wire, { s = 0 })
      scene:pin(wire, { s = wire.length })
      t.fine(scene:settle())
      local off = math.abs(left:force()[1] / c.exact.H + 1)
      t.below(before, off, ("difference of the force along at EI = %g"):format(EI))
      before = off
    end
    -- the rest is the string's mesh error
    t.below(0.002, before, "difference at EI = 1e-6")
  end)

  it("hangs straight down when held at one end only", function()
    local scene = sw.scene{}
    local wire = scene:wire{ EA = 1e4, EI = 0, mass_per_length = 0.05, radius = 0.001,
      from = { 0, 0, 0 }, to = { 1, 0, 0 }, model = "string" }
    local pin = scene:pin(wire, { s = 0 })
    t.fine(scene:settle())
    local tip = wire:position(wire.length)
    t.near(0, tip[1], 1e-6, "tip x")
    -- stretched by w L^2/(2 EA)
    t.share(-(1 + 0.05 * 9.81 / (2 * 1e4)), tip[3], 1e-6, "tip z")
    t.share(0.05 * 9.81, pin:force()[3], 1e-6, "weight")
    t.share(0.05 * 9.81, wire:tension(0), 1e-3, "tension at the pin")
  end)
end)

describe("a rod between two level clamps", function()
  for _, row in ipairs{ { 10, 0.003 }, { 100, 0.01 }, { 1000, 0.08 } } do
    for _, ratio in ipairs{ 1.05, 1.5 } do
      it(("meets the stiff catenary, gamma %g, L/span %g"):format(row[1], ratio), function()
        local c = cases.catenary{ model = "rod", ratio = ratio, gamma = row[1] }
        t.fine(c.run())
        local m, e = c.measured(), c.exact
        t.share(e.sag, m.sag, 0.002, "sag")
        t.near(e.H / c.weight, m.H / c.weight, 0.01, "force along over weight")
        t.share(e.M0, m.M0, row[2], "clamp moment")
        t.share(c.weight / 2, m.V, 1e-6, "half the weight")
      end)
    end
  end
end)

describe("a column", function()
  for _, kind in ipairs{ "pinned", "clamped" } do
    for _, d in ipairs{ 0.01, 0.05, 0.2 } do
      it(("with %s ends pushed together by %g L"):format(kind, d), function()
        local c = cases.column{ ends = kind, d = d }
        t.fine(c.run())
        local m, e = c.measured(), c.exact
        t.share(e.P, m.P, 0.003, "end force")
        t.share(e.w, m.w, 0.003, "deflection")
        if kind == "clamped" then t.share(e.M, math.abs(m.M), 0.003, "end moment") end
        t.near(0, m.side, 1e-5 * m.P, "force across")
      end)
    end

    it(("with %s ends is second order"):format(kind), function()
      t.order_at_least(1.8, { 25, 50, 100, 200 }, function(n)
        local c = cases.column{ ends = kind, segments = n }
        t.fine(c.run())
        return c.error()
      end, "end force")
    end)
  end

  -- A straight pinned column with a tiny push to the side bows out above the Euler load
  -- and stays straight below it.
  local function bow(share)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e4, EI = 1, mass_per_length = 0.1, radius = 0.01,
      from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 40 }
    scene:clamp(wire, { s = 0 })
    scene:force{ kind = "point", on = wire, s = wire.length,
      force = { -share * math.pi ^ 2 / 4, 0, 1e-6 } }
    t.fine(scene:settle())
    return wire:position(wire.length)[3]
  end

  it("stays straight 2 % below the Euler load and bows 2 % above", function()
    t.below(1e-3, bow(0.98), "deflection below")
    t.above(0.1, bow(1.02), "deflection above")
  end)
end)
