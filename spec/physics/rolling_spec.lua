-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that roll. The reference figures are closed forms of rigid cylinders. For friction that twists a
-- wire see twist_friction_spec.lua.
package.path = "./?.lua;" .. package.path
local core = require "softworld.core"
local cases = require "softworld.cases"
local tools = require "spec.physics.tools"

local near, share, below, fine = tools.near, tools.share, tools.below, tools.fine
local G = 9.81

-- A wire across a slope; downhill is along x. o.turn turns everything.
local function across(o)
  local a, r, L = math.rad(o.angle), o.radius or 0.0025, 0.2
  local rotate = o.rotate or function(v) return v end
  local s = core.scene{ gravity = rotate{ G * math.sin(a), 0, -G * math.cos(a) } }
  s:obstacle{ shape = "plane", friction = o.friction, rotation = o.turn }
  local w = s:wire{ E = 1e8, density = 1500, radius = r, segments = o.segments or 10, rolls = true,
    from = rotate{ 0, 0, r }, to = rotate{ 0, L, r }, spin_inertia = o.spin_inertia }
  return s, w
end

-- Returns the acceleration of the axis, from the distance covered in half a second [m/s2].
local function acceleration(o)
  local s, w = across(o)
  local x0 = w:position(w.length / 2)
  fine(s:advance({ dt = o.dt or 0.01, integrator = o.integrator }, 0.5))
  return 2 * tools.distance(w:position(w.length / 2), x0) / 0.25, w
end

local function expected(angle, friction, ratio) -- ratio: inertia over m r^2
  local a, k = math.rad(angle), ratio or 0.5
  if friction >= math.tan(a) * k / (1 + k) then return G * math.sin(a) / (1 + k) end
  return G * (math.sin(a) - friction * math.cos(a))
end

local function rotation(q)
  return function(v)
    local w, x, y, z = table.unpack(q)
    local c = tools.cross({ x, y, z }, v)
    local d = tools.cross({ x, y, z }, { c[1] + w * v[1], c[2] + w * v[2], c[3] + w * v[3] })
    return { v[1] + 2 * d[1], v[2] + 2 * d[2], v[3] + 2 * d[3] }
  end
end

describe("a wire across a slope", function()
  it("rolls and slides as reference case 10a says", function()
    for _, row in ipairs{ { 0.3, 20, 2.236811737 }, { 0.1, 30, 4.055429079 } } do
      share(row[3], (acceleration{ friction = row[1], angle = row[2] }), 1e-3, "acceleration")
      local c = cases.incline{ across = true, friction = row[1], angle = row[2] }
      fine(c.run())
      share(row[3], c.exact.acceleration, 1e-9, "exact one of the case")
      share(row[3], c.measured().acceleration, 1e-3, "acceleration of the case")
    end
  end)

  for _, angle in ipairs{ 5, 20, 45 } do
    it(("of %d degrees rolls above a third of its slope as friction, slides below"):format(angle),
      function()
        local threshold = math.tan(math.rad(angle)) / 3
        for _, factor in ipairs{ 0.98, 1.02 } do
          local friction = factor * threshold
          local a, w = acceleration{ friction = friction, angle = angle }
          share(expected(angle, friction), a, 1e-3, "acceleration")
          local slip = w:velocity(0.1)[1] - w:spin(0.1) * w.radius
          if factor > 1 then below(1e-9, math.abs(slip), "slip [m/s]")
          else share(0.5 * G * math.sin(math.rad(angle)) * 0.02, slip, 0.1, "slip") end
        end
      end)
  end

  it("rolls and slides the same at any radius, mesh and inertia", function()
    for _, radius in ipairs{ 0.0005, 0.01 } do
      share(expected(20, 0.3), (acceleration{ friction = 0.3, angle = 20, radius = radius }), 0.005,
        "radius " .. radius)
    end
    for _, n in ipairs{ 2, 3, 40 } do
      share(expected(20, 0.3), (acceleration{ friction = 0.3, angle = 20, segments = n }), 1e-3,
        n .. " segments")
    end
    local mass = 1500 * math.pi * 0.0025 ^ 2
    for _, ratio in ipairs{ 0.1, 1 } do -- a heavy core, a thin tube
      for _, friction in ipairs{ 0.05, 0.5 } do
        share(expected(20, friction, ratio), (acceleration{ friction = friction, angle = 20,
          spin_inertia = ratio * mass * 0.0025 ^ 2 }), 1e-3, "inertia " .. ratio)
      end
    end
  end)

  it("rolls the same with every implicit integrator", function()
    for _, name in ipairs{ "tr-bdf2", "sdirk2", "implicit-euler", "bdf2" } do
      for _, dt in ipairs{ 0.01, 0.0025 } do
        local s, w = across{ friction = 0.3, angle = 20 }
        fine(s:advance({ dt = dt, integrator = name }, 0.5))
        share(0.5 * expected(20, 0.3), w:velocity(0.1)[1], 1e-3, name .. ": speed")
      end
    end
  end)

  it("rolls and slides the same on any slope in space", function()
    local random = tools.random(5)
    for _ = 1, 4 do
      local q = tools.turn(random)
      for _, friction in ipairs{ 0.3, 0.05 } do
        share(expected(20, friction), (acceleration{ friction = friction, angle = 20, turn = q,
          rotate = rotation(q) }), 1e-3, "acceleration")
      end
    end
  end)

  it("keeps its energy while it rolls; a third of its kinetic energy is spin", function()
    local s, w = across{ friction = 0.3, angle = 20 }
    fine(s:advance({ dt = 0.005 }, 0.1)) -- the wire has sunk in
    local before = s:energy()
    fine(s:advance({ dt = 0.005 }, 0.6))
    local after, m = s:energy(), w.beam.mass_per_length * w.length
    local gained = after.kinetic - before.kinetic
    near(before.total, after.total, 1e-3 * gained, "energy")
    local v = w:velocity(0.1)[1]
    share(0.75 * m * v * v, after.kinetic, 1e-6, "kinetic energy")
  end)
end)

describe("a wire thrown along a table", function()
  -- angular momentum about the line of contact is kept, whatever the friction
  for _, case in ipairs{ { 1, 0, 0.3 }, { 1, 0, 0.8 }, { 1, -200, 0.3 }, { 0, 300, 0.3 },
    { 0.5, -800, 0.5 } } do
    it(("at %g m/s, spinning at %g rad/s, with friction %g"):format(case[1], case[2], case[3]),
      function()
        local v0, spin, mu, r = case[1], case[2], case[3], 0.0025
        local s, w = across{ friction = mu, angle = 0 }
        w:set_velocity({ v0, 0, 0 }, { 0, spin, 0 }, { 0, 0, r })
        near(spin, w:spin(0.05), 1e-9, "spin at the start")
        local slip = v0 - r * spin
        local needed = math.abs(slip) / (3 * mu * G)
        fine(s:advance({ dt = 0.002 }, 0.8 * needed))
        local sign = slip > 0 and 1 or -1
        near(v0 - 0.8 * sign * mu * G * needed, w:velocity(0.1)[1], 0.01 * math.abs(slip), "sliding")
        fine(s:advance({ dt = 0.002 }, 1.5 * needed + 0.05))
        local v = (v0 + 0.5 * r * spin) / 1.5
        near(v, w:velocity(0.1)[1], 2e-3 * math.abs(slip), "speed")
        near(v, r * w:spin(0.1), 2e-3 * math.abs(slip), "rolling")
      end)
  end

  it("and falling on it gets speed and spin from the impulse of friction", function()
    for _, mu in ipairs{ 0.05, 0.5 } do
      local s = core.scene{}
      s:obstacle{ shape = "plane", friction = mu }
      local w = s:wire{ E = 1e8, density = 1500, radius = 0.0025, segments = 10, rolls = true,
        from = { 0, 0, 0.0525 }, to = { 0, 0.2, 0.0525 } }
      w:set_velocity{ 0.5, 0, 0 }
      fine(s:advance({ dt = 0.002 }, 0.12))
      -- the impulse of friction is mu times that of the fall, or less if less stops the sliding
      local fall, t = (2 * G * 0.05) ^ 0.5, 0.12 - (2 * 0.05 / G) ^ 0.5
      local v = math.max(0.5 / 1.5, 0.5 - mu * (fall + G * t))
      near(v, w:velocity(0.1)[1], 0.01 * 0.5, "speed")
      near(2 * (0.5 - v), 0.0025 * w:spin(0.1), 0.02 * 0.5, "spin")
    end
  end)
end)

describe("a wire that rolls", function()
  it("follows an accelerating table with a third of its speed", function()
    local s = core.scene{}
    local r = 0.0025
    local plate = s:obstacle{ shape = "box", size = { 8, 2, 0.1 }, at = { 0, 0, -0.05 }, friction = 0.3 }
    local w = s:wire{ E = 1e8, density = 1500, radius = r, segments = 10, rolls = true,
      from = { 0, 0, r }, to = { 0, 0.2, r } }
    fine(s:advance({ dt = 0.005 }, 0.2))
    plate:follow{ func = function(t) return { 0.5 * t * t, 0, 0 } end, relative = true }
    fine(s:advance({ dt = 0.005 }, 1.2))
    share(1 / 3, w:velocity(0.1)[1], 0.005, "speed")
    share(-2 / 3 / r, w:spin(0.1), 0.005, "spin")
  end)

  it("is pushed up a slope with the force of a cylinder, also with friction on the pusher", function()
    for _, mu in ipairs{ 0, 0.2, 0.5 } do
      local s, w = across{ angle = 20, friction = 0.8 }
      local r, speed = w.radius, 0.1
      local pusher = s:obstacle{ shape = "box", size = { 0.1, 1, 0.1 }, at = { 0.05 + r, 0.1, 0.05 },
        friction = mu }
      fine(s:advance({ dt = 0.005 }, 0.1))
      pusher:follow{ relative = true, func = function(t)
        return { -speed * (t < 0.2 and t * t / 0.4 or t - 0.1), 0, 0 }
      end }
      fine(s:advance({ dt = 0.005 }, 1.1))
      local weight = w.beam.mass_per_length * w.length * G * math.sin(math.rad(20))
      share(weight / (1 - mu), pusher:force()[1], 0.01, "push")
      share(-speed / r, w:spin(0.1), 0.001, "spin")
    end
  end)

  it("is spun by a table that moves under it", function()
    local s, r = core.scene{}, 0.0025
    local belt = s:obstacle{ shape = "plane", friction = 0.4 }
    local w = s:wire{ E = 1e8, density = 1500, radius = r, segments = 20, rolls = true,
      from = { 0, 0, r }, to = { 0, 0.5, r } }
    for _, place in ipairs{ 0, w.length } do s:pin(w, { s = place }) end
    fine(s:settle())
    belt:follow{ relative = true, func = function(t)
      return { 0.2 * (t < 0.5 and t * t or t - 0.25), 0, 0 }
    end }
    fine(s:advance({ dt = 0.005 }, 1.5))
    for at = 0, 0.5, 0.1 do share(-0.2 / r, w:spin(at), 1e-3, "spin at " .. at) end
    near(0, tools.norm{ belt:force()[1], belt:force()[2], 0 }, 1e-4, "friction")
  end)

  -- Pinned along a radius of a turntable, the wire spins as fast as the table moves under its middle, and
  -- both halves wind it up.
  it("is spun and twisted by a turntable", function()
    local s, r, L, rate, mass, mu = core.scene{}, 0.0025, 0.5, 2, 0.03, 0.3
    local table_ = s:obstacle{ shape = "plane", friction = mu }
    local w = s:wire{ EA = 1e4, EI = 10, GJ = 1e-4, mass_per_length = mass, radius = r, segments = 50,
      rolls = true, from = { 0.2, 0, r }, to = { 0.2 + L, 0, r } }
    fine(s:settle())
    for _, place in ipairs{ 0, w.length } do s:pin(w, { s = place }) end
    table_:follow{ relative = true, func = function(t)
      local a = rate * (t < 0.5 and t * t or t - 0.25)
      return { 0, 0, 0 }, { math.cos(a / 2), 0, 0, math.sin(a / 2) }
    end }
    fine(s:advance({ dt = 0.01, integrator = "implicit-euler" }, 4))
    for at = 0, 0.5, 0.1 do share(rate * (0.2 + L / 2) / r, w:spin(at), 0.01, "spin at " .. at) end
    local torque = mu * mass * G * r -- per length
    for at = 0.05, 0.45, 0.05 do
      local wanted = torque * math.min(at, L - at)
      local share_of = math.abs(at - L / 2) < 0.01 and 0.06 or 0.03 -- it sticks at L/2
      near(wanted, math.abs(w:twist_moment(at)), share_of * torque * L / 2, "torque at " .. at)
    end
  end)

  it("rolls the same beside other wires, with steps chosen by a tolerance", function()
    local s = across{ friction = 0.3, angle = 20 }
    local wires = {}
    for k, rolls in ipairs{ false, true, false, true } do
      wires[k] = s:wire{ E = 1e8, density = 1500, radius = 0.0025, segments = 4 + k, rolls = rolls,
        from = { -k, 0, 0.0025 }, to = { -k, 0.2, 0.0025 } }
    end
    s:clamp(wires[1], { s = 0 })
    s:clamp(wires[4], { s = 0 })
    fine(s:advance({ dt = 0.02, tolerance = 1e-6 }, 0.5))
    share(0.5 * expected(20, 0.3), wires[2]:velocity(0.1)[1], 2e-3, "speed of the one that rolls")
    local slides = G * (math.sin(math.rad(20)) - 0.3 * math.cos(math.rad(20)))
    share(0.5 * slides, wires[3]:velocity(0.1)[1], 5e-3, "speed of the one that slides")
    share(0.5 * expected(20, 0.3) / 0.0025, wires[2]:spin(0.1), 2e-3, "spin")
    tools.above(1e-6, math.abs(wires[4]:twist_moment(0)), "torque of the one that is held")
    assert.are.equal(0, wires[1]:twist_moment(0))
  end)

  it("leaves a drum where a cylinder does", function()
    local s, r, R = core.scene{}, 0.0025, 0.1
    local drum = s:obstacle{ shape = "cylinder", radius = R, length = 1, friction = 20,
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    local start = 0.1 -- [rad]
    local x, z = (R + r) * math.sin(start), (R + r) * math.cos(start)
    local w = s:wire{ E = 1e8, density = 1500, radius = r, segments = 10, rolls = true,
      from = { x, -0.1, z }, to = { x, 0.1, z } }
    local top, leaves = math.cos(start)
    for k = 1, 450 do
      fine(s:advance({ dt = 0.001 }, k * 0.001))
      local p = w:position(0.1)
      local angle = math.atan(p[1], p[3])
      leaves = tools.norm(drum:force()) > 0 and angle or leaves
      if k % 20 == 0 and angle > 0.15 and angle < 0.9 then
        local speed = (4 / 3 * G * (R + r) * (top - math.cos(angle))) ^ 0.5
        share(speed, tools.norm(w:velocity(0.1)), 1e-3, "speed at " .. angle)
        share(speed / r, w:spin(0.1), 1e-3, "spin at " .. angle)
      end
    end
    near(math.acos(4 / 7 * top), leaves, 0.01, "angle where it leaves")
  end)
end)

describe("a rolling wire's scene", function()
  local function rolling()
    local s, w = across{ friction = 0.3, angle = 20 }
    fine(s:advance({ dt = 0.01 }, 0.2))
    return s, w
  end

  it("goes on to the same bits from a snapshot", function()
    for _, name in ipairs{ "tr-bdf2", "bdf2" } do
      local s, w = rolling()
      fine(s:advance({ dt = 0.01, integrator = name }, 0.3))
      local before = s:snapshot()
      fine(s:advance({ dt = 0.01, integrator = name }, 0.5))
      local x, spin = w:positions(), w:spin(0.1)
      s:restore(before)
      fine(s:advance({ dt = 0.01, integrator = name }, 0.5))
      assert.are.equal(0, tools.largest_difference(x, (w:positions())))
      assert.are.equal(spin, w:spin(0.1))
    end
  end)

  it("rolls on when something is added", function()
    local s, w = rolling()
    local spin = w:spin(0.1)
    s:obstacle{ shape = "sphere", radius = 0.1, at = { 5, 5, 5 } }
    assert.are.equal(spin, w:spin(0.1))
    fine(s:advance({ dt = 0.01 }, 0.5))
    share(0.5 * expected(20, 0.3), w:velocity(0.1)[1], 1e-3, "speed")
  end)

  it("stops with a clamp, and twists", function()
    local s, w = rolling()
    local clamp = s:clamp(w, { s = 0 })
    fine(s:advance({ dt = 0.01, integrator = "implicit-euler" }, 2))
    near(0, w:spin(0), 1e-3, "spin")
    near(0, w:spin(0.2), 1e-3, "spin")
    tools.above(1e-7, math.abs(clamp:moment()[2]), "torque")
  end)

  it("has no rest on a slope, and settle() reports it", function()
    local s = across{ friction = 0.3, angle = 20 }
    local r = s:settle()
    assert.is_false(r.ok)
    assert.truthy(r.reason:find("not at rest", 1, true), r.reason)
  end)

  it("has a rest on a level table", function()
    local s = across{ friction = 0.3, angle = 0 }
    fine(s:settle())
  end)
end)

describe("wrong use of spin", function()
  local function wire(changes)
    local s = core.scene{}
    local t = { EA = 1e4, EI = 1e-2, mass_per_length = 0.03, radius = 0.0025, from = { 0, 0, 0 },
      to = { 1, 0, 0 } }
    for k, v in pairs(changes) do t[k] = v end
    return s:wire(t), s
  end

  local function refused(text, f, ...)
    local ok, message = pcall(f, ...)
    assert.is_false(ok)
    assert.truthy(message:find(text, 1, true), message)
  end

  it("gives an error that names the mistake", function()
    refused("spin_inertia goes with rolls = true", wire, { spin_inertia = 1e-8 })
    refused("spin_inertia = 1e-06 kg m must be in (0, 1.875e-07] kg m", wire,
      { rolls = true, spin_inertia = 1e-6 })
    refused("spin_inertia", wire, { rolls = true, spin_inertia = 0 })
    refused("rolls", wire, { rolls = 1 })
    refused("did you mean 'rolls'", wire, { roll = true })
    refused("go with model = 'rod'", wire, { rolls = true, model = "string" })
    refused("rolls = true", function() wire{}:spin(0.5) end)
    refused("not on the wire", function() wire{ rolls = true }:spin(2) end)
    local _, s = wire{ rolls = true }
    refused("is explicit", function() s:advance({ dt = 1e-6, integrator = "rk4" }, 1e-5) end)
    refused("rolls", function()
      s:force{ kind = "plastic", yield_moment = 1, hardening = 1e-3 }
    end)
  end)
end)
