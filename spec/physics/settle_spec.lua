-- SPDX-License-Identifier: GPL-3.0-or-later
-- Finding rest: from a straight start, with contact, through snaps and off ridges.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

describe("settling from straight", function()
  it("takes at most 16 iterations, whatever the mesh", function()
    for _, gamma in ipairs{ { 1, 6 }, { 10, 10 }, { 100, 14 } } do
      for _, n in ipairs{ 2, 3, 5, 10, 30, 100, 300, 1000 } do
        local c = cases.droop{ gamma = gamma[1], segments = n }
        local r = t.fine(c.run())
        assert.is_false(r.transient)
        assert.are.equal(0, r.unstable)
        t.below(gamma[2] + 2, r.iterations, ("iterations, %d segments, gamma %g"):format(n, gamma[1]))
      end
    end
  end)

  it("takes few in any direction and at any axial stiffness", function()
    local random = t.random(23)
    for _, axial in ipairs{ 1e4, 1e6, 1e8, 1e9 } do
      for _ = 1, 3 do
        local c = cases.droop{ axial = axial, rotation = t.turn(random), at = { 1, -2, 0.5 } }
        -- at 1e9 the rounding of lengths is felt, and now and then the slower way is taken
        t.below(axial < 1e9 and 14 or 150, t.fine(c.run()).iterations,
          ("iterations at EA = %g EI/L^2"):format(axial))
        -- true stretch of the soft ones: w L/(2 EA) or less
        t.below(1e-4 + 10 / axial, c.error(), "tip error")
      end
    end
  end)

  it("lets strings hang that hardly stretch", function()
    for _, ratio in ipairs{ 1e6, 1e8, 1e10 } do
      local s = sw.scene{}
      local w = s:wire{ model = "string", EA = ratio * 0.02 * 9.81, EI = 0, mass_per_length = 0.02,
        radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 100 }
      local other = s:pin(w, { s = 0 })
      local hand = s:pin(w, { s = 1 })
      hand:follow{ points = { { 0, 0, 0 }, { -0.3, 0, 0.1 } }, duration = 1, relative = true }
      local run = s:run{ duration = 1, dt = 0.01 }
      t.fine(run)
      assert.equal(0, run.rejected)
      local rest = s:settle()
      t.fine(rest)
      assert.is_true(rest.iterations < 20, rest.iterations)
      -- both pins together bear the weight
      t.share(0.02 * 9.81, hand:force()[3] + other:force()[3], 1e-6, "weight")
    end
  end)

  it("ends where many small steps of a damped motion end", function()
    local c = cases.droop{ segments = 20 }
    c.scene:force{ kind = "drag", on = c.wire, linear = 0.3 }
    t.fine(c.scene:run{ duration = 20, dt = 0.02 })
    local tip = c.wire:position(1)
    t.fine(c.scene:settle())
    t.below(1e-6, t.distance(tip, c.wire:position(1)), "tips differ by")
  end)

  it("starts from where the wire is and takes no more than a few iterations there", function()
    local c = cases.droop{}
    t.fine(c.run())
    t.below(2, t.fine(c.scene:settle()).iterations, "iterations at rest")
    c.scene:gravity{ 0, 0, -9 }
    t.below(6, t.fine(c.scene:settle()).iterations, "iterations after a small change")
  end)

  it("prints what it found", function()
    local c = cases.droop{ segments = 20 }
    assert.matches("^at rest after %d+ iterations$", tostring(c.scene:settle()))
    c = cases.catenary{}
    assert.matches("^not at rest after 1 iteration:", tostring(c.scene:settle{ max_iterations = 1 }))
  end)

  it("fails with a reason when max_iterations is too small", function()
    local c = cases.catenary{}
    local r = c.scene:settle{ max_iterations = 1 }
    assert.is_false(r.ok)
    assert.is_true(#r.reason > 10)
  end)
end)

describe("settling where Newton alone fails", function()
  it("lets a level string fall until it hangs", function()
    local scene = sw.scene{}
    local wire = scene:wire{ EA = 500, EI = 0, mass_per_length = 0.05, radius = 0.001,
      from = { 0, 0, 0 }, to = { 1, 0, 0 }, model = "string" }
    scene:pin(wire, { s = 0 })
    local r = t.fine(scene:settle())
    assert.is_true(r.transient)
    t.near(0, wire:position(1)[1], 1e-5, "tip x")
    t.near(-1, wire:position(1)[3], 1e-3, "tip z")
  end)

  -- The bow may turn about the push without effort; that is no instability.
  it("bows a column that is pushed straight beyond its load, to a stable rest", function()
    for _, P in ipairs{ 3, 4, 5, 8 } do -- 2.47 N buckle it
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ EA = 1e4, EI = 1, mass_per_length = 0.1, radius = 0.01,
        from = { 0, 0, 0 }, to = { 1, 0, 0 } }
      scene:clamp(wire, { s = 0 })
      scene:force{ kind = "point", on = wire, s = 1, force = { -P, 0, 0 } }
      local r = t.fine(scene:settle())
      assert.is_true(r.transient)
      assert.are.equal(0, r.unstable, ("%g N"):format(P))
      local tip = wire:position(1)
      t.above(0.3, (tip[2] ^ 2 + tip[3] ^ 2) ^ 0.5, "bow")
    end
  end)

  it("finds the standing wire's collapse beyond 7.837 w L^3/EI and none below", function()
    for _, row in ipairs{ { 7.5, false }, { 8.2, true } } do
      local scene = sw.scene{}
      local EI = 0.1 * 9.81 / row[1]
      local wire = scene:wire{ EA = 1e6 * EI, EI = EI, mass_per_length = 0.1, radius = 0.005,
        from = { 0, 0, 0 }, to = { 0, 0, 1 } }
      scene:clamp(wire, { s = 0 })
      t.fine(scene:settle())
      local tip = wire:position(1)
      local bow = (tip[1] ^ 2 + tip[2] ^ 2) ^ 0.5
      if row[2] then t.above(0.1, bow, "bow of a wire too tall") else t.below(1e-6, bow, "bow") end
    end
  end)

  it("snaps a bow through when its middle is pushed over", function()
    local c = cases.column{ ends = "clamped", d = 0.05 }
    t.fine(c.run())
    local up = c.measured().w
    t.above(0.1, up, "bow")
    local P = 300 * c.EI
    local push = c.scene:force{ kind = "point", on = c.wire, s = c.wire.length / 2,
      force = { 0, 0, -P } }
    t.fine(c.scene:settle())
    t.below(0, c.measured().w, "bow under the push")
    push:release()
    t.fine(c.scene:settle())
    t.share(-up, c.measured().w, 1e-4, "bow on the other side")
  end)
end)

describe("settling on a table", function()
  local function lying(friction, slope)
    local a = math.rad(slope or 0)
    local scene = sw.scene{ gravity = { 9.81 * math.sin(a), 0, -9.81 * math.cos(a) } }
    local plane = scene:obstacle{ shape = "plane", friction = friction }
    local wire = scene:wire{ E = 1e8, density = 1500, radius = 0.0025, segments = 20,
      from = { 0, 0, 0.0025 }, to = { 0.5, 0, 0.0025 } }
    return scene, wire, plane, wire.beam.mass_per_length * 0.5 * 9.81
  end

  it("carries the weight", function()
    for _, friction in ipairs{ 0, 0.3 } do
      local scene, wire, plane, weight = lying(friction)
      t.fine(scene:settle())
      t.share(-weight, plane:force()[3], 1e-6, "force on the table")
      t.below(2e-5, math.abs(wire:position(0.25)[3] - 0.0025), "penetration")
    end
  end)

  it("holds a wire on a slope that is rough enough, and says when there is no rest", function()
    local scene, _, plane, weight = lying(0.3, 10)
    t.fine(scene:settle())
    t.share(weight * math.sin(math.rad(10)), plane:force()[1], 1e-4, "friction")
    local steep = lying(0.1, 20)
    assert.is_false(steep:settle{ max_iterations = 500 }.ok)
  end)

  it("drapes a wire over a wall", function()
    local scene = sw.scene{}
    local plane = scene:obstacle{ shape = "plane", friction = 0.3 }
    local wall = scene:obstacle{ shape = "box", size = { 0.01, 1, 0.1 }, at = { 0.5, 0, 0.05 },
      friction = 0.3 }
    local wire = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 80,
      from = { 0, 0, 0.11 }, to = { 1, 0, 0.11 } }
    t.fine(scene:settle())
    local weight = wire.beam.mass_per_length * 9.81
    t.share(-weight, plane:force()[3] + wall:force()[3], 1e-4, "weight")
    t.above(0.1, wire:position(0.5)[3], "height over the wall")
    t.near(wire:position(0.2)[3], wire:position(0.8)[3], 1e-4, "left and right")
  end)
end)
