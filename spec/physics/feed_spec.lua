-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wire fed through a guide against formulas: hanging, pushed out of a sleeve, twisted, pulled
-- against a brake, curved from a spool; orders, energy, forces without jumps.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local sleeves = require "spec.physics.sleeves"

local sleeve = sleeves.sleeve
local g, mass, EI, GJ = 9.81, 0.03, 3e-3, 2e-3
local w = mass * g

-- Heavy cantilevers: Gamma = w L^3 / EI, tip x/L and z/L, clamp moment M L / EI. Independent
-- shooting solution, errors below 2e-9.
local cantilevers = {
  { 1, 0.9912463953, -0.123471402, 0.4969333999 },
  { 2.15443469, 0.9620176276, -0.2551173797, 1.048459568 },
  { 4.641588834, 0.8622773968, -0.4721301176, 2.093529977 },
  { 10, 0.6563537612, -0.7001997155, 3.742191111 },
  { 21.5443469, 0.4248491808, -0.8392427509, 6.013474363 },
  { 46.41588834, 0.2571644941, -0.9037640892, 9.159586568 },
}

local function length_of(gamma) return (gamma * EI / w) ^ (1 / 3) end

describe("wire fed vertically down", function()
  -- All of the wire moves at the feeding speed, in the guide too: no momentum is gained at the guide, so
  -- its force is the weight outside. (The force mass v^2 that accelerates wire from a spool at rest is not
  -- the guide's.)
  it("hangs on the guide with its growing weight and leaves at its speed", function()
    local scene, wire, feed
    scene = sw.scene {}
    wire = scene:wire { EA = 1e5, EI = EI, mass_per_length = mass, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0, 0, -0.3 }, segments = 15 }
    feed = scene:feed(wire, { speed = 0.2 })
    t.fine(scene:settle())
    for _ = 1, 4 do
      t.fine(scene:run { duration = 0.5, dt = 0.01 })
      local length = 0.3 + 0.2 * scene.time
      t.near(length, wire.length, 1e-12, "length")
      t.near(length - 0.3, feed:fed(), 1e-12, "fed")
      t.share(w * length, feed:force()[3], 1e-6, "force")
      t.share(-w * length, feed:drive_force(), 1e-4, "drive")
      for s = 0.05, length, 0.05 do t.near(-0.2, wire:velocity(s)[3], 1e-5, "speed") end
      t.near(-mass * length * 0.2, t.momentum(wire)[3], 1e-7, "momentum")
      t.near(-length, wire:position(length)[3], 1e-5, "end")
    end
  end)

  -- Speeding up with v^2 = 2 a x: the guide bears mass (g - a) per length.
  it("bears less while it accelerates", function()
    local scene = sw.scene {}
    local wire = scene:wire { EA = 1e5, EI = EI, mass_per_length = mass, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0, 0, -0.5 }, segments = 20 }
    local feed = scene:feed(wire)
    t.fine(scene:settle())
    -- trapezoidal: the speed grows over the first quarter of a second
    feed:feed { length = 0.5, speed = 1, acceleration = 4, law = "trapezoidal" }
    t.fine(scene:run { duration = 0.2, dt = 0.005 })
    t.near(0.8, feed:speed(), 1e-9, "speed")
    t.near(0.08, feed:fed(), 1e-9, "fed")
    t.share(mass * (g - 4) * 0.58, feed:force()[3], 1e-3, "force")
  end)
end)

describe("wire pushed out of a level sleeve", function()
  it("droops as a cantilever of its present length, whose drive differs by EI k^2 / 2", function()
    local scene, wire, feed = sleeve(length_of(0.1), 10)
    t.fine(scene:settle())
    for _, c in ipairs(cantilevers) do
      local L = length_of(c[1])
      local seconds = feed:feed { length = L - wire.length, duration = 1, law = "linear" }
      t.fine(scene:run { duration = seconds, dt = 0.1, quasistatic = true })
      local tip, curvature = wire:position(wire.length), c[4] / L
      t.near(L, wire.length, 1e-12, "length")
      t.below(1e-4 * L, t.distance({ c[2] * L, 0, c[3] * L }, tip), "tip off by")
      t.share(w * L, feed:force()[3], 1e-9, "weight")
      t.near(0, feed:force()[1], 1e-9, "axial force of walls and drive together")
      t.share(EI * curvature, -feed:moment()[2], 2e-4, "moment")
      t.share(-EI * curvature ^ 2 / 2, feed:drive_force(), 4e-4, "drive")
    end
    t.above(60, wire.segments, "segments") -- of the initial size
  end)

  it("is second order in the mesh", function()
    local c = cantilevers[5]
    t.order_at_least(1.8, { 3, 6, 12 }, function(n)
      local scene, wire, feed = sleeve(length_of(1), n)
      t.fine(scene:settle())
      feed:feed { length = length_of(c[1]) - wire.length, duration = 1 }
      t.fine(scene:run { duration = 1, dt = 0.1, quasistatic = true })
      local L = wire.length
      return t.distance({ c[2] * L, 0, c[3] * L }, wire:position(L)) / L
    end, "tip")
  end)

  -- The drive's work is all the energy that comes in. The drive's force is not the one that balances the
  -- wire's weight and inertia, which has no component along the guide here.
  it("takes the drive's work and gives it back, without jumps of the moment", function()
    local function balance(n)
      local scene, _, feed = sleeve(0.2, n)
      t.fine(scene:settle())
      feed:speed(0.3)
      local before, work, drive = scene:energy().total, 0, feed:drive_force()
      local last, last_but_one, jump = nil, nil, 0
      for _ = 1, 500 do
        t.fine(scene:run { duration = 0.002, dt = 0.002, quasistatic = true })
        work, drive = work + 0.5 * (drive + feed:drive_force()) * 0.3 * 0.002, feed:drive_force()
        local moment = feed:moment()[2]
        if last_but_one then
          jump = math.max(jump, math.abs((moment - 2 * last + last_but_one) / moment))
        end
        last_but_one, last = last, moment
      end
      return math.abs(work / (scene:energy().total - before) - 1), jump
    end
    local coarse, coarse_jump = balance(10)
    local fine, fine_jump = balance(20)
    t.below(5e-4, coarse, "energy missing with 10 segments")
    t.below(6e-5, fine, "energy missing with 20 segments")
    t.below(3e-4, coarse_jump, "jump of the moment with 10 segments")
    t.below(8e-5, fine_jump, "jump of the moment with 20 segments")
  end)

  it("comes back to its place when it is drawn in and paid out again", function()
    local function round(n)
      local scene, wire, feed = sleeve(0.4, n)
      t.fine(scene:settle())
      local tip, energy = wire:position(0.4), scene:energy().total
      for _, length in ipairs { -0.25, 0.25 } do
        feed:feed { length = length, duration = 1 }
        t.fine(scene:run { duration = 1, dt = 0.05, quasistatic = true })
      end
      t.near(0.4, wire.length, 1e-12, "length")
      assert.are.equal(n, wire.segments)
      return t.distance(tip, wire:position(wire.length)), math.abs(scene:energy().total - energy)
    end
    local off, energy = round(20)
    t.below(2e-4, off, "tip off by")
    t.below(8e-6, energy, "energy off by")
    t.below(off / 3, (round(40)), "tip off by with 40 segments")
  end)
end)

describe("wire fed in motion", function()
  local function pay_out(n, dt, options)
    local scene, wire, feed = sleeve(0.2, n, options)
    t.fine(scene:settle())
    feed:feed { length = 0.3, duration = 1 }
    t.fine(scene:run { duration = 1, dt = dt, integrator = options and options.integrator })
    return wire:position(wire.length), wire
  end

  -- While no node comes out of the guide, and with 30 nodes that do.
  it("is second order in the time step", function()
    local function pay_out_a_little(dt)
      local scene, wire, feed = sleeve(0.4, 10)
      t.fine(scene:settle())
      feed:feed { length = 0.018, duration = 0.32 }
      t.fine(scene:run { duration = 0.32, dt = dt })
      return wire:position(wire.length)
    end
    local fine = pay_out_a_little(0.0005)
    t.order_at_least(1.9, { 1 / 0.016, 1 / 0.008, 1 / 0.004 }, function(rate)
      return t.distance(fine, pay_out_a_little(1 / rate))
    end, "tip")
    fine = pay_out(20, 0.0005)
    t.below(2e-4, t.distance(fine, (pay_out(20, 0.02))), "tip off by with steps of 20 ms")
    t.below(8e-5, t.distance(fine, (pay_out(20, 0.005))), "tip off by with steps of 5 ms")
  end)

  it("converges in the mesh", function()
    local fine = pay_out(80, 0.004)
    t.order_at_least(1.5, { 5, 10, 20 }, function(n)
      return t.distance(fine, (pay_out(n, 0.004)))
    end, "tip")
  end)

  it("agrees among methods and wire models", function()
    local usual = pay_out(20, 0.002)
    for _, method in ipairs { "sdirk2", "bdf2", "implicit-euler" } do
      t.below(method == "implicit-euler" and 4e-3 or 4e-4,
        t.distance(usual, (pay_out(20, 0.002, { integrator = method }))), method)
    end
    local coarse = pay_out(8, 0.002)
    t.below(5e-4, t.distance(coarse, (pay_out(8, 5e-6, { integrator = "rk4" }))), "rk4")
    t.below(2e-4, t.distance(usual, (pay_out(20, 0.002, { model = "string" }))), "string")
    local framed = pay_out(20, 0.002, { EI = { EI, EI }, normal = { 0, 1, 0 } })
    t.below(1e-8, t.distance(usual, framed), "with frames")
  end)

  -- The guide's force, sampled at every step, has kinks where nodes come out; they fade with the mesh.
  it("has almost no jumps in the guide's force", function()
    local function jump(n)
      local scene, _, feed = sleeve(0.2, n)
      t.fine(scene:settle())
      feed:feed { length = 0.3, duration = 1 }
      local list = {}
      for i = 1, 200 do
        t.fine(scene:run { duration = 0.005, dt = 0.005 })
        list[i] = feed:force()[3]
      end
      local most = 0
      for i = 2, 199 do most = math.max(most, math.abs(list[i + 1] - 2 * list[i] + list[i - 1])) end
      return most / (w * 0.5)
    end
    local coarse, fine = jump(20), jump(80)
    t.below(0.05, coarse, "jump over the weight, 20 segments")
    t.below(0.012, fine, "jump over the weight, 80 segments")
  end)

  -- Without weight, all of the wire moves with the guide, which moves across while it feeds.
  it("leaves a moving guide with the guide's velocity plus the feeding speed", function()
    local scene, wire, feed = sleeve(0.2, 20, { gravity = { 0, 0, 0 }, feed = { speed = 0.2 } })
    wire:set_velocity({ 0.2, 0.5, 0 })
    feed:follow { points = { { 0, 0, 0 }, { 0, 0.5, 0 } }, speed = 0.5, law = "linear" }
    t.fine(scene:run { duration = 1, dt = 0.01 })
    t.below(1e-9, t.distance({ 0.4, 0.5, 0 }, wire:position(0.4)), "end off by")
    t.below(1e-9, t.norm(feed:force()), "force")
  end)

  -- A stiff wire comes out of a guide that turns at omega: every piece of it is accelerated across by 2 v
  -- omega, and inwards by omega^2 r.
  it("bears Coriolis' force in a turning guide", function()
    local v, omega = 0.3, 2
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    local wire = scene:wire { EA = 1e6, EI = 30, mass_per_length = mass, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 20 }
    local feed = scene:feed(wire, { speed = v })
    wire:set_velocity({ v, 0, 0 }, { 0, 0, omega }, { 0, 0, 0 })
    feed:follow { points = { { 0, 0, 0 }, { 0, 0, 0 } }, turn = { axis = { 0, 0, 1 }, angle = omega },
      duration = 1, law = "linear" }
    for _ = 1, 5 do
      t.fine(scene:run { duration = 0.1, dt = 0.0025 })
      local force, angle, L = feed:force(), omega * scene.time, wire.length
      local along = force[1] * math.cos(angle) + force[2] * math.sin(angle)
      local across = force[2] * math.cos(angle) - force[1] * math.sin(angle)
      t.share(2 * mass * v * omega * L, across, 1e-3, "across")
      -- first order in the step where the acceleration changes, like all reactions of stiff wires
      t.share(-mass * omega ^ 2 * L ^ 2 / 2, along, 0.01, "inwards")
    end
  end)

  -- Steady drag on a straight wire that comes out at v: linear b v per length.
  it("feels drag at the speed with which it leaves", function()
    local scene, wire, feed = sleeve(0.4, 10, { gravity = { 0, 0, 0 } })
    scene:force { kind = "drag", on = wire, linear = 0.5 }
    feed:feed { length = 0.4, speed = 0.5, law = "trapezoidal", acceleration = 5 }
    t.fine(scene:run { duration = 0.4, dt = 0.005 }) -- now at a steady speed
    t.near(0.5, feed:speed(), 1e-9)
    t.share(0.5 * 0.5 * wire.length, feed:force()[1], 1e-3, "force")
  end)

  -- A feed at the far end, at the start and in mid-wire must give the same.
  it("is the same with the feed at any place of the wire", function()
    local function tip(from, to, segments, s, clamped)
      local scene = sw.scene {}
      local wire = scene:wire { EA = 1e5, EI = EI, mass_per_length = mass, radius = 0.002,
        from = { from, 0, 0 }, to = { to, 0, 0 }, segments = segments }
      local feed = scene:feed(wire, { s = s })
      local other = clamped and scene:clamp(wire, { s = 0 })
      t.fine(scene:settle())
      if other then -- follows what goes out on the other side
        other:follow { points = { { 0, 0, 0 }, { -0.1, 0, 0 } }, duration = 1, relative = true }
      end
      feed:feed { length = 0.1, duration = 1 }
      t.fine(scene:run { duration = 1, dt = 0.01 })
      return wire:position(from == -0.2 and 0 or wire.length), wire.length
    end
    local near, length = tip(0, -0.2, 20, 0)
    t.near(0.3, length, 1e-12)
    local far = tip(-0.2, 0, 20, 0.2)
    local middle, kept = tip(0.3, -0.2, 50, 0.3, true)
    t.near(0.5, kept, 1e-12)
    t.below(1e-9, t.distance(near, far), "far end")
    t.below(1e-9, t.distance(near, middle), "mid-wire")
  end)
end)

describe("twist of fed wire", function()
  -- The guide keeps the wire from turning, so the angle between guide and clamp stays, over more length.
  for name, options in pairs { plain = {}, framed = { EI = { EI, 4e-3 }, normal = { 0, 1, 0 } } } do
    it("thins out while wire is paid out, " .. name, function()
      options.gravity = { 0, 0, 0 }
      local scene, wire, feed = sleeve(1, 20, options)
      local clamp, turn = scene:clamp(wire, { s = 1 }), 3
      clamp:follow { points = { { 0, 0, 0 }, { 0, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = turn },
        duration = 1, relative = true }
      t.fine(scene:run { duration = 1, dt = 0.05, quasistatic = true })
      t.share(GJ * turn, clamp:moment()[1], 1e-6, "moment before")
      feed:feed { length = 0.2, duration = 1 }
      clamp:follow { points = { { 0, 0, 0 }, { 0.2, 0, 0 } }, duration = 1, relative = true }
      t.fine(scene:run { duration = 1, dt = 0.05, quasistatic = true })
      t.share(GJ * turn / 1.2, clamp:moment()[1], 1e-6, "moment")
      t.share(-GJ * turn / 1.2, feed:moment()[1], 1e-6, "moment on the guide")
      t.share(GJ * turn / 1.2, wire:twist_moment(0.6), 1e-6, "torque")
      -- paying out takes energy GJ (turn / L)^2 / 2 from the wire per length
      t.share(-0.5 * GJ * (turn / 1.2) ^ 2, feed:drive_force(), 1e-6, "drive")
    end)
  end
end)

describe("wire from a spool", function()
  it("keeps the curvature it has on the spool", function()
    local radius, before, after = 0.1, 0.1, 0.25
    local function off(n)
      local scene, points = sw.scene { gravity = { 0, 0, 0 } }, {}
      for i = 0, 200 do
        local a = before / radius * i / 200
        points[i + 1] = { radius * math.sin(a), 0, radius * (1 - math.cos(a)) }
      end
      local wire = scene:wire { EA = 1e5, EI = EI, GJ = GJ, mass_per_length = mass, radius = 0.002,
        path = points, rest = "path", segments = n }
      local feed = scene:feed(wire, { direction = { 1, 0, 0 } })
      feed:feed { length = after - before, duration = 1 }
      t.fine(scene:run { duration = 1, dt = 0.05, quasistatic = true })
      t.near(0, feed:moment()[2], 1e-12, "moment") -- unloaded
      t.share(1 / radius, wire:curvature(0.02), 1e-4, "curvature")
      t.share(-EI / radius ^ 2 / 2, feed:drive_force(), 2e-3, "drive") -- the guide straightens it
      local a = wire.length / radius
      return t.distance({ radius * math.sin(a), 0, radius * (1 - math.cos(a)) },
        wire:position(wire.length))
    end
    t.below(1.2e-4, off(10), "end off by")
    t.below(8e-6, off(40), "end off by, 40 segments")
  end)
end)
