-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sliders keep a place of a wire on a line or a curve. Exact cases are compared with their formulas; the
-- place is on the rail to rounding.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local beads = require "spec.link.beads"

local bead, circle = beads.bead, beads.circle
local G = 9.81
local METHODS = { "tr-bdf2", "sdirk2", "bdf2", "implicit-euler", "generalized-alpha", "implicit-midpoint" }
local function weight_of(wire) return wire.beam.mass_per_length * wire.length * G end

-- A string without bending stiffness, pinned at (0, 0, 0), with a slider at its other end.
local function hung(o)
  local scene = sw.scene{ gravity = { 0, 0, -G } }
  local wire = scene:wire{ model = "string", EI = 1e-10, EA = 1e5, mass_per_length = 0.05, radius = 0.002,
    from = { 0, 0, 0 }, to = { 0.6, 0, -0.8 }, segments = o.segments or 100 }
  scene:pin(wire, { s = 0 })
  return scene, wire, scene:slider(wire, { s = 1, direction = o.direction, friction = o.friction })
end

describe("a slider", function()
  for _, method in ipairs(METHODS) do
    -- a = g sin(slope) is constant: methods of second order have place and speed to rounding, methods of
    -- first order the speed.
    it("goes down a slope with g sin(slope), " .. method, function()
      local slope = math.rad(30)
      local scene, wire, slider = bead{ direction = { math.cos(slope), 0, -math.sin(slope) } }
      local run = scene:run{ duration = 0.5, dt = 0.01, integrator = method }
      assert.is_true(run.ok, run.reason)
      local place, speed = slider:place()
      local a = G * math.sin(slope)
      t.near(0.5 * a, speed, 1e-9)
      t.near(0.125 * a, place, method == "implicit-euler" and 0.5 * a * 0.5 * 0.01 + 1e-9 or 1e-9)
      local p = wire:position(0.05)
      t.near(0, p[1] * math.sin(slope) + p[3] * math.cos(slope), 1e-12, "off the rail")
    end)
  end

  -- The whole wire has the given velocity, the sliding place too. Nothing acts along the rail, so momentum
  -- stays. Regression: the place stood still at first, like a clamped node, and took its share from the
  -- others: an eighth of the speed with 8 segments, half with 2.
  for name, way in pairs{ before = "before the rail is there", after = "on the rail" } do
    it("keeps the velocity that a wire is given " .. way, function()
      for _, segments in ipairs{ 2, 8, 9 } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local wire = scene:wire{ E = 1e10, density = 1000, radius = 0.002, segments = segments,
          from = { 0, -0.05, 0 }, to = { 0, 0.05, 0 } }
        local slope = { 0.6, 0, 0.8 }
        if name == "before" then wire:set_velocity(slope) end
        local slider = scene:slider(wire, { s = 0.05, direction = slope })
        if name == "after" then wire:set_velocity(slope) end
        t.near(1, select(2, slider:place()), 1e-12, "speed before the first step")
        local before = scene:snapshot()
        local run = scene:run{ duration = 0.1, dt = 0.01 }
        assert.is_true(run.ok, run.reason)
        local place, speed = slider:place()
        t.near(1, speed, 1e-9, "speed")
        t.near(0.1, place, 1e-9, "place")
        scene:restore(before)
        scene:run{ duration = 0.1, dt = 0.01 }
        assert.are.same({ place, speed }, { (slider:place()), (select(2, slider:place())) })
      end
    end)
  end

  -- On a ring without weight the friction is mu m v^2 / R: 1/v grows by mu t / R.
  it("slows down on a ring by the friction of its centripetal force", function()
    local R, mu = 0.3, 0.3
    local scene, wire, slider = bead{ gravity = { 0, 0, 0 }, z = -R, path = circle(R, 128), closed = true,
      friction = mu }
    scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
    wire:set_velocity{ 1, 0, 0 }
    local run = scene:run{ duration = 0.5, dt = 1e-3 }
    assert.is_true(run.ok, run.reason)
    local place, speed = slider:place()
    t.share(1 + mu * 0.5 / R, 1 / speed, 1e-4)
    t.share(R / mu * math.log(1 + mu * 0.5 / R), place, 1e-3)
  end)

  -- On a rail that turns at w about its end, r = r0 cosh(w t). The rail's work is m (r'^2 + w^2 r^2)/2
  -- minus the bead's initial energy. Regression: the moment about the pose was missing at the start of each
  -- step, a fifth of the work.
  it("gives the work of a rail that turns", function()
    local w, r0 = 5, 0.1
    local scene, wire, slider = bead{ gravity = { 0, 0, 0 }, x = r0,
      path = { { 0, 0, 0 }, { r0, 0, 0 }, { 0.2, 0, 0 }, { 0.4, 0, 0 } } }
    slider:follow{ func = function(time)
      local c, s = math.cos(w * time), math.sin(w * time)
      return { r0 * c, 0, r0 * s }, { axis = { 0, -1, 0 }, angle = w * time }
    end }
    wire:set_velocity({ 0, 0, 0 }, { 0, -w, 0 })
    local run = scene:run{ duration = 0.3, dt = 1e-3 }
    assert.is_true(run.ok, run.reason)
    local place, speed = slider:place()
    local out, back = math.exp(0.3 * w), math.exp(-0.3 * w)
    t.share(r0 * (out + back) / 2, place, 1e-4)
    t.share(r0 * w * (out - back) / 2, speed, 1e-4)
    local books, m = run:ledger(), weight_of(wire) / G
    t.share(0.5 * m * (speed ^ 2 + w ^ 2 * (place ^ 2 - r0 ^ 2)), books.work.holds, 2e-3)
    t.below(1e-3, books.gap / books.play, "gap")
  end)

  it("keeps to its end and to the rail when the wire is given a velocity", function()
    local scene, wire, slider = bead{ gravity = { 0, 0, 0 }, direction = { 1, 0, 0 }, to = 0 }
    wire:set_velocity{ 1, 0, 2 }
    scene:observe{ call = function() -- the free ends swing, and may pull it back
      t.below(1e-12, (slider:place()), "place beyond the end")
      t.near(0, wire:position(0.05)[3], 1e-12, "off the rail")
    end }
    local run = scene:run{ duration = 0.01, dt = 0.001 }
    assert.is_true(run.ok, run.reason)
    t.below(1e-3, run:ledger().gained / run:ledger().play, "gained")
  end)

  -- A bead on a circle is a pendulum: period 2 pi sqrt(R/g) / agm(1, cos(amplitude/2)). After one period it
  -- is back, as exactly as the method allows.
  it("swings on a circle with a pendulum's period", function()
    local R, amplitude = 0.5, math.rad(60)
    local a, b = 1, math.cos(amplitude / 2)
    for _ = 1, 20 do a, b = (a + b) / 2, math.sqrt(a * b) end
    local x, z = R * math.sin(amplitude), -R * math.cos(amplitude)
    local scene, wire = bead{ x = x, z = z, path = circle(R, 128), closed = true }
    local run = scene:run{ duration = 2 * math.pi * math.sqrt(R / G) / a, dt = 2e-3 }
    assert.is_true(run.ok, run.reason)
    local p = wire:position(0.05)
    t.near(x, p[1], 1e-6)
    t.near(z, p[3], 1e-6)
    t.near(R, math.sqrt(p[1] ^ 2 + p[3] ^ 2), 1e-7, "off the circle: that of the spline")
    t.below(1e-4, run:ledger().gap / run:ledger().play, "gap")
  end)

  it("presses on a circle with m v^2 / R and its weight", function()
    local R = 0.5
    local scene, wire, slider = bead{ x = R, z = 0, path = circle(R, 128), closed = true }
    scene:run{ duration = 0.4, dt = 1e-3 }
    local p, f = wire:position(0.05), slider:force()
    local _, v = slider:place()
    local n = { -p[1] / R, 0, -p[3] / R } -- to the centre
    local m = weight_of(wire) / G
    t.near(m * v * v / R + m * G * n[3], f[1] * n[1] + f[3] * n[3], 5e-3 * m * G)
  end)

  -- L = a sinh(0.6/a) gives a. The pull H = m g a is level, and the end hangs a (cosh(0.6/a) - 1) lower.
  it("lets a string's end hang on a vertical rail as half a catenary", function()
    local scene, wire, slider = hung{ direction = { 0, 0, 1 } }
    assert.is_true(scene:settle().ok)
    local low, high = 0.05, 50
    for _ = 1, 100 do
      local a = (low + high) / 2
      if a * (math.exp(0.6 / a) - math.exp(-0.6 / a)) / 2 > 1 then low = a else high = a end
    end
    local drop = low * ((math.exp(0.6 / low) + math.exp(-0.6 / low)) / 2 - 1)
    local f, p = slider:force(), wire:position(1)
    t.share(0.05 * G * low, f[1], 1e-4)
    t.near(0, f[3], 1e-12)
    t.near(-drop, p[3], 1e-4)
    t.near(0.6, p[1], 1e-12)
  end)

  for name, direction in pairs{ tilted = { 1, 0, 1.5 }, level = { 1, 0, 0 }, aside = { 0, 1, 0.3 } } do
    it("bears force only across a rail that is " .. name, function()
      local scene, _, slider = hung{ direction = direction }
      assert.is_true(scene:settle().ok)
      local f, along = slider:force(), 0
      for k = 1, 3 do along = along + f[k] * direction[k] end
      t.near(0, along, 1e-9)
    end)
  end

  -- After the end has slid and come to rest, the force along the rail is friction times the force across.
  for _, friction in ipairs{ 0.1, 0.5 } do
    it("comes to rest at the friction limit, " .. friction, function()
      local scene, _, slider = hung{ direction = { 0, 0, 1 }, friction = friction }
      assert.is_true(scene:settle().ok)
      local f = slider:force()
      t.share(friction, math.abs(f[3]) / math.abs(f[1]), 1e-6)
    end)
  end

  it("stays where friction holds it", function()
    local scene, _, slider = hung{ direction = { 0, 0, 1 }, friction = 2 }
    assert.is_true(scene:settle().ok)
    assert.are.equal(0, (slider:place()))
    local f = slider:force()
    assert.is_true(math.abs(f[3]) < 2 * math.abs(f[1]))
  end)

  -- a = g (sin - mu cos); for tan(slope) < mu nothing moves.
  it("slides and sticks on a slope by Coulomb's law", function()
    local slope = math.rad(30)
    local direction = { math.cos(slope), 0, -math.sin(slope) }
    local scene, wire, slider = bead{ direction = direction, friction = 0.3 }
    local run = scene:run{ duration = 0.5, dt = 0.002 }
    local place, speed, force = slider:place()
    local a = G * (math.sin(slope) - 0.3 * math.cos(slope))
    t.near(0.125 * a, place, 1e-9)
    t.near(0.5 * a, speed, 1e-9)
    t.share(-0.3 * weight_of(wire) * math.cos(slope), force, 1e-6)
    local books = run:ledger()
    t.share(-force * place, books.lost.friction, 1e-5)
    t.below(1e-5, books.gap / books.play, "gap: friction is booked by the trapezoid")
    scene, wire, slider = bead{ direction = direction, friction = 0.6 }
    scene:run{ duration = 0.5, dt = 0.01 }
    t.near(0, wire:position(0.05)[1], 1e-12)
    place, speed = slider:place()
    assert.are.equal(0, place)
    assert.are.equal(0, speed)
  end)

  -- Slanted gravity accelerates the bead for 0.2 s; friction then stops it within v^2 / (2 mu g). The step
  -- in which it stops is one of implicit Euler, whose place is off by v h at most.
  it("comes to a stop by friction, and stays", function()
    local scene, _, slider = bead{ direction = { 1, 0, 0 }, friction = 0.3, gravity = { 6, 0, -G } }
    scene:run{ duration = 0.2, dt = 0.005 }
    scene:set{ gravity = { 0, 0, -G } }
    scene:run{ duration = 0.5, dt = 0.005 }
    local v = 0.2 * (6 - 0.3 * G)
    local place, speed = slider:place()
    t.near(0.1 * v + v * v / (0.6 * G), place, 5e-5)
    assert.are.equal(0, speed)
    scene:run{ duration = 0.1, dt = 0.005 }
    assert.are.equal(place, (slider:place()))
  end)

  for _, friction in ipairs{ 0, 0.3 } do
    it("is stopped by the rail's end, friction " .. friction, function()
      local scene, wire, slider = bead{ direction = { 1, 0, 0 }, to = 0.1, friction = friction,
        gravity = { 6, 0, -G } }
      local run = scene:run{ duration = 0.6, dt = 0.005 }
      assert.is_true(run.ok, run.reason)
      local place, speed, force = slider:place()
      t.near(0.1, place, 1e-15)
      t.near(0, speed, 1e-12)
      t.share(-6 / G * weight_of(wire), force, 2e-2) -- the rod still swings a little
      local books = run:ledger()
      t.below(1e-4, books.gap / books.play, "gap")
      scene:set{ gravity = { -6, 0, -G } }
      scene:run{ duration = 0.1, dt = 0.005 }
      assert.is_true(slider:place() < 0.1)
    end)
  end

  it("stops at both ends of an open curve, not on a closed one", function()
    local scene, _, slider = bead{ x = 0, z = -0.2, path = circle(0.2, 32, 0.25), gravity = { 20, 0, 0 } }
    assert.is_true(scene:run{ duration = 1, dt = 0.002 }.ok)
    t.near(2 * math.pi * 0.2 * 0.25, (slider:place()), 1e-4)
    scene, _, slider = bead{ x = 0, z = -0.2, path = circle(0.2, 32), closed = true }
    assert.is_true(scene:run{ duration = 0.1 }.ok)
    t.near(0, select(2, slider:place()), 1e-6) -- at its lowest point
  end)

  -- The rail is a hold: it follows a motion, and takes the wire along.
  it("is carried by its rail", function()
    local scene, wire, slider = bead{ direction = { 1, 0, 0 }, gravity = { 0, 0, 0 } }
    slider:follow{ points = { { 0, 0, 0 }, { 0, 0, 0.1 } }, duration = 0.2, relative = true }
    scene:run{ duration = 0.2, dt = 0.005 }
    local p = wire:position(0.05)
    t.near(0.1, p[3], 1e-12)
    t.near(0, p[1], 1e-12)
    slider:pose({ 0, 0, 0.1 }, { axis = { 0, 1, 0 }, angle = math.rad(30) })
    scene:set{ gravity = { 0, 0, -G } }
    scene:run{ duration = 0.2, dt = 0.005 }
    t.share(0.5 * G * 0.5 * 0.04, (slider:place()), 5e-3) -- the rod still swings
  end)

  it("runs quasi-statically", function()
    local scene, _, slider = hung{ direction = { 0, 0, 1 }, segments = 40 }
    scene:settle()
    local before = slider:place()
    slider:follow{ points = { { 0, 0, 0 }, { -0.05, 0, 0 } }, duration = 1, relative = true }
    local run = scene:run{ duration = 1, dt = 0.1, quasistatic = true }
    assert.is_true(run.ok, run.reason)
    t.near(0, slider:force()[3], 1e-9)
    assert.is_true(slider:place() < before)
  end)
end)
