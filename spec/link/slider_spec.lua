-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sliders: a place of a wire keeps on a line or a curve. What is exact is compared with its formula; the
-- rail itself is met to rounding.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local G = 9.81
local METHODS = { "tr-bdf2", "sdirk2", "bdf2", "implicit-euler", "generalized-alpha", "implicit-midpoint" }

-- A short stiff rod across the plane of motion, which its middle's slider carries.
local function bead(o)
  local scene = sw.scene{ gravity = o.gravity or { 0, 0, -G } }
  local x, z = o.x or 0, o.z or 0
  local wire = scene:wire{ E = 1e10, density = 1000, radius = 0.002, segments = 8,
    from = { x, -0.05, z }, to = { x, 0.05, z } }
  return scene, wire, scene:slider(wire, { s = 0.05, direction = o.direction, friction = o.friction,
    from = o.from, to = o.to, path = o.path, closed = o.closed })
end

-- Raises an error that names these.
local function refuses(call, ...)
  local fine, message = pcall(call)
  assert.is_false(fine)
  for _, word in ipairs{ ... } do
    assert(message:find(word, 1, true), ("'%s' is not in: %s"):format(word, message))
  end
end

local function weight_of(wire) return wire.beam.mass_per_length * wire.length * G end

-- Points of a circle in the plane y = 0 round (0, 0, 0); fraction of a full one.
local function circle(radius, count, fraction)
  local points = {}
  for i = 0, count - (fraction and 0 or 1) do
    local a = 2 * math.pi * (fraction or 1) * i / count - (fraction and math.pi * fraction or 0)
    points[i + 1] = { radius * math.sin(a), 0, -radius * math.cos(a) }
  end
  return points
end

-- A hanging string without bending stiffness from (0, 0, 0) to a slider at its end.
local function hung(o)
  local scene = sw.scene{ gravity = { 0, 0, -G } }
  local wire = scene:wire{ model = "string", EI = 1e-10, EA = 1e5, mass_per_length = 0.05, radius = 0.002,
    from = { 0, 0, 0 }, to = { 0.6, 0, -0.8 }, segments = o.segments or 100 }
  scene:pin(wire, { s = 0 })
  return scene, wire, scene:slider(wire, { s = 1, direction = o.direction, friction = o.friction })
end

describe("a slider", function()
  for _, method in ipairs(METHODS) do
    -- a = g sin(slope): constant, so that methods of second order have place and speed to rounding, and
    -- those of first order the speed.
    it("goes down a slope by " .. method, function()
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

  -- All of the wire has the velocity that it is given, the sliding place too: nothing acts along the rail,
  -- so that momentum stays. It stood still at first, as a node of a clamp does, and took its share from
  -- the others: an eighth of the speed was gone with 8 segments, half with 2.
  for name, way in pairs{ before = "before the rail is there", after = "on the rail" } do
    it("goes on with the velocity that a wire is given " .. way, function()
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

  -- On a ring without weight friction is mu m v^2 / R: 1/v grows by mu t / R.
  it("slows down on a ring by the friction of its own pressure", function()
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

  -- On a rail that turns at w about its end, r = r0 cosh(w t); the rail's work is m (r'^2 + w^2 r^2)/2 less
  -- what the bead began with. Its moment about the pose was missing at the start of each step: a fifth of it.
  it("takes the work of a rail that turns", function()
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

  it("does not leave its end, or the rail, with a velocity that it is given", function()
    local scene, wire, slider = bead{ gravity = { 0, 0, 0 }, direction = { 1, 0, 0 }, to = 0 }
    wire:set_velocity{ 1, 0, 2 }
    scene:observe{ call = function() -- its free ends swing, and may pull it back
      t.below(1e-12, (slider:place()), "place beyond the end")
      t.near(0, wire:position(0.05)[3], 1e-12, "off the rail")
    end }
    local run = scene:run{ duration = 0.01, dt = 0.001 }
    assert.is_true(run.ok, run.reason)
    t.below(1e-3, run:ledger().gained / run:ledger().play, "gained")
  end)

  -- A pendulum without a string: period 2 pi sqrt(R/g) / agm(1, cos(amplitude/2)). After one it is back,
  -- as exactly as the method is.
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

  -- L = a sinh(0.6/a) gives a; the pull is H = m g a, level, and the end hangs a (cosh(0.6/a) - 1) lower.
  it("hangs a string's end on a vertical rail as half a catenary", function()
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
    it("reacts across a rail that is " .. name, function()
      local scene, _, slider = hung{ direction = direction }
      assert.is_true(scene:settle().ok)
      local f, along = slider:force(), 0
      for k = 1, 3 do along = along + f[k] * direction[k] end
      t.near(0, along, 1e-9)
    end)
  end

  -- At rest the force along is friction times that across, on its limit after the end has slid.
  for _, friction in ipairs{ 0.1, 0.5 } do
    it("comes to rest within the cone of friction " .. friction, function()
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

  -- a = g (sin - mu cos); below tan(slope) = mu nothing moves at all.
  it("slides and sticks on a slope as Coulomb has it", function()
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

  -- Thrown by gravity askew for 0.2 s, it then takes v^2 / (2 mu g); the step in which it stops is one of
  -- implicit Euler, whose place is off by v h at most.
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

  -- The rail is a hold: it follows a motion, and the wire goes along it as the frame has it.
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

describe("a slider among other things", function()
  local function swing(o)
    local scene = sw.scene{ gravity = { 0, 0, -G } }
    local args = { E = 5e6, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 0.6, 0, 0 },
      segments = 30 }
    for k, v in pairs(o.wire or {}) do args[k] = v end
    local wire = scene:wire(args)
    scene:clamp(wire, { s = 0 })
    if o.twist then
      scene:clamp(wire, { s = 0.6 }):follow{ turn = { axis = { 1, 0, 0 }, angle = o.twist },
        points = { { 0, 0, 0 }, { -0.1, 0.05, 0 } }, relative = true, duration = 0.2 }
    end
    local slider = scene:slider(wire, { s = 0.3, direction = { 1, 0, -0.2 } })
    if o.more then o.more(scene, wire, slider) end
    local run = scene:run{ duration = 0.25, dt = 2e-3 }
    assert.is_true(run.ok, run.reason)
    return wire:position(0.3), slider:force(), run, slider, wire
  end

  local function on_rail(p) t.near(0, 0.2 * (p[1] - 0.3) + p[3], 1e-12, "off the rail") end

  -- Frames do not change a straight wire of one stiffness; another matrix does not either.
  it("is the same with frames", function()
    local p, f = swing{}
    local q, g = swing{ wire = { rolls = true } }
    on_rail(p)
    on_rail(q)
    for k = 1, 3 do
      t.near(p[k], q[k], 1e-6)
      t.near(f[k], g[k], 1e-3)
    end
  end)

  -- It lets the wire turn: a wire twisted by a full turn and a half is twisted on both sides of it.
  it("is passed by twist, with and without frames", function()
    local p, _, run, _, wire = swing{ twist = 3 }
    on_rail(p)
    t.below(2e-2, run:ledger().gap / run:ledger().play, "gap, as without a slider")
    t.near(wire:twist_moment(0.15), wire:twist_moment(0.45), 1e-3 * math.abs(wire:twist_moment(0.15)) + 1e-12)
    local q = swing{ twist = 3, wire = { rolls = true } }
    on_rail(q)
  end)

  it("goes with joins and with contact, of wires and at obstacles", function()
    for _, rolls in ipairs{ false, true } do
      local p, _, run = swing{ wire = { rolls = rolls }, more = function(scene, wire)
        local branch = scene:wire{ E = 5e6, density = 1200, radius = 0.003, from = { 0.2, 0, 0 },
          to = { 0.2, 0.3, 0 }, segments = 15 }
        scene:join{ ends = { { wire, s = 0.2 }, { branch, s = 0 } } }
        scene:obstacle{ shape = "box", size = { 1, 1, 0.02 }, at = { 0.3, 0, -0.08 }, friction = 0.2 }
        local other = scene:wire{ E = 5e6, density = 1200, radius = 0.003, from = { 0.45, -0.2, 0.01 },
          to = { 0.45, 0.2, 0.01 }, segments = 15 }
        scene:wire_contact{ between = { wire, other }, friction = 0.2 }
      end }
      on_rail(p)
      t.below(1e-2, run:ledger().gap / run:ledger().play, "gap")
    end
  end)

  it("is saved, restored and goes on with the same bits", function()
    local scene, wire, slider = bead{ direction = { 1, 0, -1 }, friction = 0.2, to = 0.3 }
    scene:run{ duration = 0.1, dt = 0.005 }
    local snapshot = scene:snapshot()
    local path = os.tmpname()
    scene:save(path)
    local function on(s, w, l)
      s:run{ duration = 0.2, dt = 0.005 }
      local p, place, speed, force = w:position(0.05), l:place()
      return { p[1], p[2], p[3], place, speed, force }
    end
    local first = on(scene, wire, slider)
    scene:restore(snapshot)
    assert.are.same(first, on(scene, wire, slider))
    local other = sw.load(path)
    os.remove(path)
    assert.are.same(first, on(other, other:find "wire1", other:find "slider1"))
  end)

  it("keeps its place and speed when the scene is edited", function()
    local scene, wire, slider = bead{ direction = { 1, 0, -1 } }
    scene:run{ duration = 0.1, dt = 0.005 }
    local place, speed = slider:place()
    scene:obstacle{ shape = "sphere", radius = 0.1, at = { 0, 0, -50 } }
    scene:run{ duration = 0.1, dt = 0.005 }
    local a = G / math.sqrt(2)
    local later, faster = slider:place()
    t.near(place + 0.1 * speed + 0.005 * a, later, 1e-9)
    t.near(speed + 0.1 * a, faster, 1e-9)
    assert.are.equal("slider", slider.kind)
    assert.is_true(#wire:position(0.05) == 3)
  end)

  it("is described, written as Lua and changed between steps", function()
    local scene, _, slider = bead{ direction = { 1, 0, -1 }, friction = 0.9 }
    local item = scene:describe().holds[1]
    assert.are.equal("slider", item.now.kind)
    assert.are.same({ 1, 0, -1 }, item.given.direction)
    local again = assert(load(scene:script()))()
    assert.are.equal(0.9, again:find("slider1"):get().friction)
    again:run{ duration = 0.1, dt = 0.01 }
    scene:run{ duration = 0.1, dt = 0.01 }
    assert.are.equal((slider:place()), (again:find("slider1"):place()))
    assert.are.equal(0.9, slider:get().friction)
    slider:set{ friction = 0 }
    scene:run{ duration = 0.1, dt = 0.01 }
    t.near(0.1 * G / math.sqrt(2), select(2, slider:place()), 0.15)
    refuses(function() slider:set{ friction = -1 } end, "friction")
    refuses(function() slider:set{ direction = { 1, 0, 0 } } end, "direction")
  end)
end)

describe("a slider is refused", function()
  local function refuses_args(args, ...)
    local scene = sw.scene{}
    local wire = scene:wire{ E = 1e9, density = 1000, radius = 0.002, from = { 0, 0, 0 },
      to = { 1, 0, 0 } }
    refuses(function() scene:slider(wire, args) end, ...)
    assert.are.equal(0, #sw.core.data(scene).holds)
  end

  it("without a rail, with two, or with one that is none", function()
    refuses_args({ s = 0.5 }, "direction", "path")
    refuses_args({ s = 0.5, direction = { 0, 0, 0 } }, "direction")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, path = circle(1, 8) }, "path")
    refuses_args({ s = 0.5, path = { { 0, 0, 0 }, { 1, 0, 0 } } }, "2 points")
    refuses_args({ s = 0.5, path = { { 0, 0, 0 }, { 0.5, 0, 0 }, { 0.5, 0, 0 } } },
      "away from the one before")
    refuses_args({ s = 0.5, path = circle(1, 16), closed = true }, "away from the path")
    refuses_args({ s = 0.5, path = "round" }, "path")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, frction = 1 }, "friction")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, friction = -1 }, "friction")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, to = -1 }, "to")
    refuses_args({ s = 2, direction = { 1, 0, 0 } }, "s = 2")
  end)

  it("on a mesh, where something holds already, and on a wire that is to become a mesh", function()
    local scene = sw.scene{}
    local tube = scene:wire{ model = "tube", E = 1e6, density = 1000, radius = 0.01, from = { 0, 0, 0 },
      to = { 0.1, 0, 0 } }
    refuses(function() scene:slider(tube, { s = 0, direction = { 1, 0, 0 } }) end, "slider")
    local wire = scene:wire{ E = 1e6, density = 1000, radius = 0.01, from = { 0, 1, 0 }, to = { 0.3, 1, 0 } }
    local slider = scene:slider(wire, { s = 0.1, direction = { 1, 0, 0 } })
    refuses(function() scene:slider(wire, { s = 0.1, direction = { 0, 0, 1 } }) end, "slider")
    refuses(function() scene:clamp(wire, { s = 0.1 }) end, "slider1")
    refuses(function() wire:remodel{ model = "radial" } end, "slides along", "slider1")
    refuses(function() wire:frequencies{ modes = 2 } end, "slides along")
    refuses(function() slider:fed() end, "has no fed; holds of scene:feed have it")
    local clamp = scene:clamp(wire, { s = 0.3 })
    refuses(function() clamp:place() end, "has no place; holds of scene:slider have it")
    slider:release()
    refuses(function() slider:place() end, "released")
  end)

  it("by methods that cannot have it", function()
    local scene = bead{ direction = { 1, 0, 0 } }
    refuses(function() scene:run{ duration = 0.1, integrator = "velocity-verlet" } end, "slider1")
    scene = bead{ direction = { 1, 0, 0 }, friction = 0.1 }
    refuses(function() scene:run{ duration = 0.1, integrator = "implicit-midpoint" } end, "slider1")
  end)
end)
