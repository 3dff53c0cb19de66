-- SPDX-License-Identifier: GPL-3.0-or-later
-- Forces on wires against closed forms, functions as forces, conservation in free flight.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

-- A wire in free flight, straight along x.
local function free(options)
  local scene = sw.scene{ gravity = options.gravity or { 0, 0, 0 } }
  local wire = scene:wire{ E = options.E or 1e8, density = 1200, radius = 0.002,
    segments = options.segments or 20, from = { 0, 0, 0 }, to = { 0.6, 0, 0 },
    model = options.model }
  return scene, wire, wire.beam.mass_per_length
end

describe("drag", function()
  it("lets a falling wire reach its terminal velocity", function()
    local scene, wire, m = free{ gravity = { 0, 0, -9.81 } }
    scene:force{ kind = "drag", on = wire, linear = 0.5 }
    t.fine(scene:run{ duration = 1, dt = 0.005 })
    t.share(-m * 9.81 / 0.5, wire:velocity(0.3)[3], 1e-4, "terminal velocity, linear")
    scene, wire, m = free{ gravity = { 0, 0, -9.81 } }
    scene:force{ kind = "drag", on = wire, quadratic = 0.5 }
    t.fine(scene:run{ duration = 2, dt = 0.005 })
    t.share(-(m * 9.81 / 0.5) ^ 0.5, wire:velocity(0.3)[3], 1e-4, "terminal velocity, quadratic")
  end)

  it("slows a wire as the closed forms say", function()
    local scene, wire, m = free{}
    wire:set_velocity{ 0, 2, 0 }
    scene:force{ kind = "drag", on = wire, linear = 0.1 }
    t.fine(scene:run{ duration = 0.3, dt = 1e-3 })
    t.share(2 * math.exp(-0.1 / m * 0.3), wire:velocity(0.1)[2], 1e-4, "speed, linear")
    scene, wire, m = free{}
    wire:set_velocity{ 0, 2, 0 }
    scene:force{ kind = "drag", on = wire, quadratic = 0.1 }
    t.fine(scene:run{ duration = 0.3, dt = 1e-3 })
    t.share(2 / (1 + 2 * 0.1 / m * 0.3), wire:velocity(0.1)[2], 1e-4, "speed, quadratic")
  end)
end)

describe("Rayleigh damping", function()
  -- Returns the damping ratio of the cantilever's first mode, from its decay over some periods.
  local function ratio(damping)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e9, density = 1200, radius = 0.002, segments = 20,
      from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    local beam = wire.beam
    local omega = 3.516015 * (beam.EI / (beam.mass_per_length * 0.3 ^ 4)) ^ 0.5
    local load = scene:force{ kind = "point", on = wire, s = wire.length,
      force = { 0, 0, 0.002 * beam.EI / 0.3 ^ 2 } }
    t.fine(scene:settle())
    load:release()
    damping.kind, damping.on = "damping", wire
    if damping.zeta then
      damping[damping.by] = damping.by == "mass" and 2 * damping.zeta * omega
        or 2 * damping.zeta / omega
      damping.by, damping.zeta = nil, nil
      scene:force(damping)
    end
    -- from the energy after the third period, when the higher modes have died out, to that after the tenth
    local period = 2 * math.pi / omega
    t.fine(scene:run{ duration = 3 * period, dt = period / 400 })
    local before = scene:energy().total
    t.fine(scene:run{ duration = 7 * period, dt = period / 400 })
    return math.log(before / scene:energy().total) / (2 * 7 * 2 * math.pi)
  end

  it("by mass has the ratio asked for in the first mode", function()
    t.share(0.02, ratio{ by = "mass", zeta = 0.02 }, 0.01, "damping ratio")
  end)

  it("by stiffness has the ratio asked for in the first mode", function()
    t.share(0.02, ratio{ by = "stiffness", zeta = 0.02 }, 0.01, "damping ratio")
  end)

  it("is almost zero if it is left out", function()
    t.below(5e-5, math.abs(ratio{}), "damping ratio of the method")
  end)

  it("by stiffness leaves a turning rod alone", function()
    local scene, wire = free{ E = 1e10 }
    scene:force{ kind = "damping", on = wire, stiffness = 0.01 }
    wire:set_velocity({ 0, 0, 0 }, { 0, 0, 3 }, { 0.3, 0, 0 })
    t.fine(scene:run{ duration = 0.02, dt = 1e-4 }) -- its stretch and waves die out
    local _, before = t.momentum(wire)
    t.fine(scene:run{ duration = 0.5, dt = 1e-3 })
    local p, l = t.momentum(wire)
    t.share(before[3], l[3], 1e-3, "spin")
    t.below(1e-9, t.norm(p), "momentum")
  end)
end)

describe("dead loads", function()
  it("at a point accelerate a free wire like a line of the same sum", function()
    local scene, wire, m = free{}
    scene:force{ kind = "line", on = wire, force = { 0, 0.01, 0 } }
    t.fine(scene:run{ duration = 1, dt = 0.01 })
    t.share(0.01 / m, wire:velocity(0.3)[2], 1e-9, "speed under a line force")
    scene, wire, m = free{}
    scene:force{ kind = "point", on = wire, s = 0.217, force = { 0.006, 0, 0 } }
    t.fine(scene:run{ duration = 1, dt = 0.01 })
    t.share(0.01 / m, t.momentum(wire)[1] / (m * 0.6), 1e-9, "speed under a point force")
  end)

  it("at a point between nodes bend a cantilever as beam theory says", function()
    -- small deflection of a cantilever under P at a: P a^2 (3 L - a)/(6 EI)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e6, EI = 1, mass_per_length = 0.1, radius = 0.01,
      from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    local before
    for _, a in ipairs{ 0.5, 0.505, 0.5099, 0.51 } do
      local load = scene:force{ kind = "point", on = wire, s = a, force = { 0, 0, 1e-4 } }
      t.fine(scene:settle{ tolerance = 1e-13 })
      t.share(1e-4 * a ^ 2 * (3 - a) / 6, wire:position(1)[3], 1e-3, "deflection")
      assert.is_true(not before or wire:position(1)[3] > before)
      before = wire:position(1)[3]
      load:release()
    end
  end)

  it("along a line bend like weight", function()
    local c = cases.droop{}
    t.fine(c.run())
    local tip = c.wire:position(1)
    c.scene:gravity{ 0, 0, 0 }
    c.scene:force{ kind = "line", on = c.wire,
      force = { 0, 0, -c.parameters.mass_per_length * 9.81 } }
    t.fine(c.scene:settle())
    t.below(1e-9, t.distance(tip, c.wire:position(1)), "tips differ by")
  end)

  it("along a line act like weight in motion, too", function()
    local weighed, loaded = cases.release{ segments = 20 }, cases.release{ segments = 20 }
    loaded.scene:gravity{ 0, 0, 0 }
    loaded.scene:force{ kind = "line", on = loaded.wire,
      force = { 0, 0, -loaded.parameters.mass_per_length * 9.81 } }
    t.fine(weighed.scene:run{ duration = 0.5, dt = 0.01 })
    t.fine(loaded.scene:run{ duration = 0.5, dt = 0.01 })
    t.below(1e-9, t.distance(weighed.wire:position(1), loaded.wire:position(1)), "tips differ by")
  end)

  it("released leave no trace", function()
    local c = cases.droop{}
    t.fine(c.run())
    local tip = c.wire:position(1)
    local load = c.scene:force{ kind = "point", on = c.wire, s = 1, force = { 0.1, 0.2, 0.1 } }
    t.fine(c.scene:settle())
    t.above(0.05, t.distance(tip, c.wire:position(1)), "tip moved by")
    load:release()
    t.fine(c.scene:settle())
    t.below(1e-8, t.distance(tip, c.wire:position(1)), "tips differ by")
  end)
end)

describe("a function as a force", function()
  -- The line force, written as a user would.
  local function line(n, length, q)
    return function(_, _, _, f)
      for i = 0, n do
        f[3 * i + 3] = f[3 * i + 3] + q * length / n * (i > 0 and i < n and 1 or 0.5)
      end
    end
  end

  it("does what the built-in one does, at rest", function()
    local built, own = cases.droop{ segments = 20 }, cases.droop{ segments = 20 }
    built.scene:force{ kind = "line", on = built.wire, force = { 0, 0, 0.1 } }
    own.scene:force{ kind = line(20, 1, 0.1), on = own.wire }
    t.fine(built.run())
    t.fine(own.run())
    t.below(1e-8, t.distance(built.wire:position(1), own.wire:position(1)), "tips differ by")
  end)

  it("does what the built-in one does, in motion and with every kind of method", function()
    for _, method in ipairs{ { "tr-bdf2", 0.01 }, { "implicit-midpoint", 0.01 }, { "bdf2", 0.01 },
      { "velocity-verlet", 5e-5 } } do
      local built, own = cases.release{ segments = 20 }, cases.release{ segments = 20 }
      built.scene:force{ kind = "line", on = built.wire, force = { 0, 0, 0.1 } }
      own.scene:force{ kind = line(20, 1, 0.1), on = own.wire }
      for _, c in ipairs{ built, own } do
        t.fine(c.scene:run{ duration = 0.3, dt = method[2], integrator = method[1] })
      end
      -- a function's force is iterated to a fixed point; with the built-in one a step ends after one
      -- linearised solve
      t.below(2e-5, t.distance(built.wire:position(1), own.wire:position(1)), method[1])
    end
  end)

  it("may depend on place, speed and time", function()
    -- drag, written out
    local a, wire_a, m = free{}
    local b, wire_b = free{}
    a:force{ kind = "drag", on = wire_a, linear = 0.1 }
    b:force{ kind = function(time, x, v, f)
      assert(type(time) == "number" and #x == #v)
      for i = 0, 20 do
        local share = 0.6 / 20 * (i > 0 and i < 20 and 1 or 0.5)
        for k = 1, 3 do f[3 * i + k] = f[3 * i + k] - 0.1 * share * v[3 * i + k] end
      end
    end, on = wire_b }
    for _, w in ipairs{ wire_a, wire_b } do w:set_velocity({ 0, 1, 0 }, { 0, 0, 4 }, { 0, 0, 0 }) end
    t.fine(a:run{ duration = 0.2, dt = 1e-3 })
    t.fine(b:run{ duration = 0.2, dt = 1e-3 })
    t.below(1e-6, t.distance(wire_a:position(0), wire_b:position(0)), "places differ by")
    assert.is_true(m > 0)
  end)
end)

describe("a wire thrown spinning without gravity", function()
  for _, model in ipairs{ "rod", "string" } do
    it(("keeps its momentum, spin and energy as a %s"):format(model), function()
      local scene, wire, m = free{ model = model, E = 5e7 }
      wire:set_velocity({ 1, 2, -0.5 }, { 2, -3, 8 }, { 0.2, 0, 0 })
      local p0, l0 = t.momentum(wire)
      local e0 = scene:energy().total
      t.fine(scene:run{ duration = 1, dt = 1e-3 })
      local p, l = t.momentum(wire)
      t.below(1e-9 * t.norm(p0), t.distance(p0, p), "momentum changed by")
      -- spin and energy are not invariants of TR-BDF2: second order in the step
      t.below(2e-4 * t.norm(l0), t.distance(l0, l), "spin changed by")
      t.near(e0, scene:energy().total, 2e-3 * e0, "energy")
      -- its centre of mass flies straight on
      t.share(0.6 * m, t.norm(p) / t.norm{ 1, 2 + 8 * 0.1, -0.5 + 3 * 0.1 }, 1e-9, "mass")
    end)
  end

  it("keeps them better with smaller steps, at second order", function()
    t.order_at_least(1.8, { 500, 1000, 2000 }, function(n)
      local scene, wire = free{ E = 5e7 }
      wire:set_velocity({ 1, 2, -0.5 }, { 2, -3, 8 }, { 0.2, 0, 0 })
      local _, l0 = t.momentum(wire)
      t.fine(scene:run{ duration = 0.5, dt = 0.5 / n })
      local _, l = t.momentum(wire)
      return t.distance(l0, l)
    end, "spin")
  end)

  it("falls like a stone with gravity", function()
    local scene, wire, m = free{ gravity = { 0, 0, -9.81 } }
    wire:set_velocity({ 1, 0, 3 }, { 0, 10, 0 }, { 0.3, 0, 0 })
    t.fine(scene:run{ duration = 0.5, dt = 2e-3 })
    local p = t.momentum(wire)
    t.near(3 - 9.81 * 0.5, p[3] / (m * 0.6), 1e-9, "speed")
    t.near(1, p[1] / (m * 0.6), 1e-9, "speed")
  end)
end)
