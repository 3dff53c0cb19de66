-- SPDX-License-Identifier: GPL-3.0-or-later
-- Clamps anywhere on a wire, put on and taken off while it moves, and grips with a width.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local cases = require "softworld.cases"
local wires = require "softworld.cases.wire"
local t = require "spec.physics.tools"

local exact = cases.droop{}.exact -- gamma 10, free length 1 m

-- A wire of `before` + 1 m along x with segments of about 1/n; its last metre is free.
local function long(before, n)
  local p = wires.parameters{ gamma = 10, g = 9.81, axial = 1e8 }
  p.segments = math.floor(n * (1 + before) + 0.5)
  p.from, p.to = { -before, 0, 0 }, { 1, 0, 0 }
  local scene = sw.scene{}
  return scene, scene:wire(p), p
end

local function tip_error(wire)
  return t.distance({ exact.x, 0, exact.z }, wire:position(wire.length))
end

describe("a clamp", function()
  it("in mid-wire is as good as one at the end", function()
    for _, n in ipairs{ 50, 100 } do
      local c = cases.droop{ segments = n, axial = 1e8 }
      t.fine(c.run())
      local usual = c.error()
      for _, before in ipairs{ 0.5, 0.5 + 0.3 / n, 0.5 + 0.45 / n, 0.1234, 0.3 / n, 1 / n, 1.5 / n,
        0.005 } do
        local scene, wire, p = long(before, n)
        local clamp = scene:clamp(wire, { s = before })
        t.fine(scene:settle())
        -- the segments differ a little in length from those of the droop
        t.below(1.3 * usual, tip_error(wire), ("tip error, clamp at %g m"):format(before))
        t.share(p.mass_per_length * 9.81 * (1 + before), clamp:force()[3], 1e-9, "weight")
      end
    end
  end)

  it("holds exactly the given place, whatever the mesh", function()
    for _, s in ipairs{ 0.0031, 0.2, 0.2077, 0.5, 0.9999 } do
      local scene, wire = long(0, 50)
      local clamp = scene:clamp(wire, { s = s })
      t.fine(scene:settle())
      t.below(1e-12, t.distance({ s, 0, 0 }, wire:position(s)), "held point off by")
      t.below(1e-12, t.distance({ s, 0, 0 }, (clamp:pose())), "pose off by")
      t.below(1e-9, t.distance({ 1, 0, 0 }, wire:tangent(s)), "tangent off by")
    end
  end)

  it("near the free end bears the moment of both sides", function()
    local scene, wire, p = long(0.5, 50)
    local clamp = scene:clamp(wire, { s = 1.497 })
    t.fine(scene:settle())
    local w, x = p.mass_per_length * 9.81, wire:position(0)
    t.share(w * 1.5, clamp:force()[3], 1e-9, "force")
    assert.is_true(x[3] < -0.9)
  end)

  it("with a width (a grip) keeps its interval rigid and is exact outside", function()
    for _, width in ipairs{ 0.005, 0.02, 0.1 } do
      local scene, wire, p = long(0.3, 50)
      local grip = scene:grip(wire, { s = 0.3 - width / 2, width = width })
      t.fine(scene:settle())
      t.below(5e-5, tip_error(wire), ("tip error, width %g"):format(width))
      t.share(p.mass_per_length * 9.81 * 1.3, grip:force()[3], 1e-9, "weight")
      for _, s in ipairs{ 0.3 - width, 0.3 - width / 2, 0.3 } do
        t.below(1e-9, t.distance({ s - 0.3, 0, 0 }, wire:position(s)), "held place off by")
      end
    end
  end)

  it("with a width has the same nodes from whichever end arc length counts", function()
    for _, s in ipairs{ 0.033, 0.23, 0.351, 0.449, 0.5, 0.578 } do
      for _, width in ipairs{ 0.005, 0.02, 0.13 } do
        local function nodes(place)
          local scene = sw.scene{}
          local wire = scene:wire{ E = 1e7, density = 1000, radius = 0.003, from = { 0, 0, 0 },
            to = { 1, 0, 0 }, segments = 10 }
          scene:grip(wire, { s = place, width = width })
          return select(2, wire:positions())
        end
        local list, back = nodes(s), nodes(1 - s)
        assert.equal(#list, #back)
        for i = 1, #list do t.near(list[i], 1 - back[#list + 1 - i], 1e-12, "node " .. i) end
      end
    end
  end)

  it("turns the wire with the stiffness of a beam between two clamps", function()
    for _, gap in ipairs{ 0.08, 0.1, 0.2, 0.5, 0.007, 0.019, 0.04, 0.06 } do
      local scene, wire, p = long(0.5, 50)
      scene:gravity{ 0, 0, 0 }
      local a, b = scene:clamp(wire, { s = 0.5 - gap }), scene:clamp(wire, { s = 0.5 })
      local angle = 1e-6
      b:pose((b:pose()), { math.cos(angle / 2), 0, math.sin(angle / 2), 0 })
      t.fine(scene:settle{ tolerance = 1e-15 })
      -- second order in the number of edges between the clamps, at least four: 2.3 %
      local tolerance = 0.025
      t.share(4 * p.EI / gap * angle, b:moment()[2], tolerance, ("near moment, gap %g"):format(gap))
      t.share(2 * p.EI / gap * angle, a:moment()[2], 2 * tolerance, ("far moment, %g"):format(gap))
      t.share(6 * p.EI / gap ^ 2 * angle, math.abs(b:force()[3]), 2 * tolerance, ("force, %g"):format(gap))
    end
  end)

  it("close to another one leaves the free side alone", function()
    for _, gap in ipairs{ 0.006, 0.016, 0.02, 0.03, 0.05 } do
      local scene, wire, p = long(0.5, 50)
      local a, b = scene:clamp(wire, { s = 0.5 - gap }), scene:clamp(wire, { s = 0.5 })
      t.fine(scene:settle())
      t.below(6e-5, tip_error(wire), ("tip error, gap %g"):format(gap))
      t.share(p.mass_per_length * 9.81 * 1.5, a:force()[3] + b:force()[3], 1e-9, "weight")
    end
  end)

  it("at both ends shares the weight and the moments evenly", function()
    local scene, wire, p = long(0.5, 40)
    local width = 0.03
    local a = scene:grip(wire, { s = width / 2, width = width })
    local b = scene:grip(wire, { s = wire.length - width / 2, width = width })
    t.fine(scene:settle())
    local w = p.mass_per_length * 9.81 * 1.5
    t.share(w / 2, a:force()[3], 1e-7, "left force")
    t.share(w / 2, b:force()[3], 1e-7, "right force")
    t.share(-a:moment()[2], b:moment()[2], 1e-7, "moments")
    -- moments about one point add up to the weight's
    local left, right = a:moment{ at = { 0, 0, 0 } }, b:moment{ at = { 0, 0, 0 } }
    t.near(-w * 0.25, left[2] + right[2], 1e-7 * w, "sum of moments")
  end)

  it("follows a turn: the wire's weight stays, its moment goes round", function()
    local c = cases.droop{ segments = 40 }
    t.fine(c.run())
    local before = c.measured()
    c.clamp:pose({ 0, 0, 0 }, { math.cos(0.4), 0, 0, math.sin(0.4) }) -- about the vertical
    t.fine(c.scene:settle())
    local M = c.clamp:moment()
    t.near(before.moment[2] * math.cos(0.8), M[2], 1e-8, "moment")
    t.near(-before.moment[2] * math.sin(0.8), M[1], 1e-8, "moment")
  end)
end)

describe("a clamp put on in mid-run", function()
  -- The swinging cantilever at 0.3 s.
  local function swinging(n)
    local c = cases.release{ segments = n or 50 }
    t.fine(c.scene:run{ duration = 0.3, dt = 1e-3 })
    return c, c.parameters.mass_per_length * 9.81 / 2
  end

  it("leaves positions, velocities and energy alone", function()
    for _, s in ipairs{ 0.5, 0.503, 0.5077, 0.51, 0.9 } do
      local c, scale = swinging()
      local e, before = c.scene:energy(), {}
      local places = { 0.1, 0.3, 0.49, 0.7, 0.9, 1 }
      for i, u in ipairs(places) do before[i] = { c.wire:position(u), c.wire:velocity(u) } end
      -- A clamp lies k h^2/12 inside the curve, so that the hinges beside it have the wire's bend. Three
      -- nodes on each side make room for it.
      local inside = c.wire:curvature(s) * 0.02 ^ 2 / 12
      c.scene:clamp(c.wire, { s = s })
      for i, u in ipairs(places) do
        -- a node moves along the curve: the cubic between nodes differs by h^3 = 8e-6 times the change of
        -- curvature, which is about 1
        local near = math.abs(u - s) < 0.08 and 1.3 * inside or 0
        t.below(1e-5 + near, t.distance(before[i][1], c.wire:position(u)), "position changed by")
        t.below(2e-3, t.distance(before[i][2], c.wire:velocity(u)), "velocity changed by")
      end
      local now = c.scene:energy()
      t.near(e.kinetic, now.kinetic, 1e-4 * scale, "kinetic energy")
      t.near(e.stretch, now.stretch, 1e-5 * scale, "stretch energy")
      t.near(e.gravity, now.gravity, 1e-5 * scale, "gravity energy")
      t.near(e.total, now.total, 1e-3 * scale, "total energy")
    end
  end)

  it("stops the held point, and only it", function()
    local c = swinging()
    local tip = c.wire:velocity(1)
    local clamp = c.scene:clamp(c.wire, { s = 0.503 })
    local place = c.wire:position(0.503)
    -- before the axial wave, at 792 m/s, reaches the tip
    t.fine(c.scene:run{ duration = 2e-4, dt = 2e-5 })
    t.below(1e-9, t.distance(place, c.wire:position(0.503)), "held point moved by")
    t.below(0.05, t.distance(tip, c.wire:velocity(1)), "tip's velocity changed by")
    t.fine(c.scene:run{ duration = 0.2, dt = 1e-3 })
    t.below(1e-9, t.distance(place, c.wire:position(0.503)), "held point moved by")
    assert.is_true(t.norm(clamp:force()) > 0)
  end)

  it("never adds energy, and loses less in stopping with finer meshes", function()
    local losses = {}
    for i, n in ipairs{ 25, 100 } do
      local c, scale = swinging(n)
      local e = c.scene:energy().total
      local clamp = c.scene:clamp(c.wire, { s = 0.5 })
      t.fine(c.scene:run{ duration = 1e-3, dt = 1e-3 })
      losses[i] = (e - c.scene:energy().total) / scale
      t.above(0, losses[i], "loss")
      clamp:release()
      local released = c.scene:energy().total
      t.fine(c.scene:run{ duration = 0.3, dt = 1e-3 })
      t.below(released + 1e-4 * scale, c.scene:energy().total, "energy after the release")
    end
    t.below(losses[1], losses[2], "loss at 100 segments")
  end)

  it("at rest shifts the tip by no more than the mesh's error", function()
    for _, s in ipairs{ 0.5, 0.5063, 0.991 } do
      local shifts = {}
      for i, n in ipairs{ 50, 200 } do
        local c = cases.droop{ segments = n }
        t.fine(c.run())
        local tip = c.wire:position(1)
        local clamp = c.scene:clamp(c.wire, { s = s })
        t.fine(c.scene:settle())
        shifts[i] = t.distance(tip, c.wire:position(1))
        clamp:release()
        t.fine(c.scene:settle())
        -- the rest: a node that has moved
        t.below(1e-5, t.distance(tip, c.wire:position(1)), "tip moved by, after the release")
      end
      t.below(1.5e-4, shifts[1], "tip moved by, 50 segments")
      t.below(1e-5, shifts[2], "tip moved by, 200 segments")
    end
  end)

  -- A stub of a wire a hair longer than asked for must not stop the run.
  it("holds the end if it is asked for a hair beside it", function()
    for _, hair in ipairs{ 0, 1e-8, 1e-6, 7e-5, 2e-4, 1e-3 } do
      local s = sw.scene{}
      local w = s:wire{ EA = 1e5, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.02, radius = 1e-3,
        from = { 0, 0, 0 }, to = { 1 + hair, 0, 0 }, segments = 50 }
      s:clamp(w, { s = 0 })
      local hold = s:clamp(w, { s = 1 })
      hold:follow{ points = { { 0, 0, 0 }, { -0.7, 0.3, 0.2 } }, duration = 0.5, relative = true,
        turn = { axis = { 1, 0.3, 0 }, angle = 6 } }
      t.fine(s:run{ duration = 1, dt = 5e-3 })
      t.below(0.02, w.length - hold:pose()[1] - 0.7, "how far from the end it holds")
    end
  end)
end)
