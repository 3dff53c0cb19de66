-- SPDX-License-Identifier: GPL-3.0-or-later
-- Objects of particles that touch wires, each other and themselves: statics, friction, momentum and energy
-- of collisions, and the state after saving or changing a scene.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local G, R = 9.81, 1e-3

-- Returns a rotation of points and vectors about an axis that is no coordinate axis.
local function turner(angle)
  local c, s, k = math.cos(angle), math.sin(angle), 1 / math.sqrt(3)
  return function(v)
    local dot = (v[1] + v[2] + v[3]) * k * k * (1 - c)
    return { c * v[1] + s * k * (v[3] - v[2]) + dot, c * v[2] + s * k * (v[1] - v[3]) + dot,
      c * v[3] + s * k * (v[2] - v[1]) + dot }
  end
end

local straight = turner(0)

-- A block of n x n x n particles, `side` apart; o.at is the middle of its lowest layer.
local function block(scene, o)
  local n, side, turn, positions, hexes = o.n or 4, o.side or 4 * R, o.turn or straight, {}, {}
  local function number(i, j, k) return (k * n + j) * n + i + 1 end
  for k = 0, n - 1 do
    for j = 0, n - 1 do
      for i = 0, n - 1 do
        positions[#positions + 1] = turn{ o.at[1] + (i - (n - 1) / 2) * side,
          o.at[2] + (j - (n - 1) / 2) * side, o.at[3] + k * side }
      end
    end
  end
  for k = 0, n - 2 do
    for j = 0, n - 2 do
      for i = 0, n - 2 do
        for level = k, k + 1 do
          for _, c in ipairs{ { i, j }, { i + 1, j }, { i + 1, j + 1 }, { i, j + 1 } } do
            hexes[#hexes + 1] = number(c[1], c[2], level)
          end
        end
      end
    end
  end
  return scene:particles{ name = o.name, positions = positions, masses = (o.mass or 2e-3) / #positions,
    elements = { { hexes = hexes, E = o.E or 1e5, nu = 0.3 } }, radius = R }
end

local function momentum(object, mass)
  local v, sum = object:velocities(), { 0, 0, 0 }
  for i = 1, #v, 3 do
    for k = 1, 3 do sum[k] = sum[k] + mass * v[i + k - 1] * 3 / #v end
  end
  return sum
end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

describe("an object of particles", function()
  -- The wires' ends carry both weights; the wires carry the block's. Cases: also no particle above a wire,
  -- and long and short steps.
  for _, case in ipairs{ { 0, 0.01 }, { 0, 2e-3 }, { 0.7, 5e-3, y = 0.4 * R }, { 2.1, 0.01, y = R } } do
    it(("falls on two wires, turned by %g, in steps of %g s"):format(case[1], case[2]), function()
      local turn, wires, ends = turner(case[1]), {}, {}
      local scene = sw.scene{ gravity = turn{ 0, 0, -G } }
      scene:force{ kind = "damping", mass = 20 }
      for k, y in ipairs{ -3 * R, 3 * R } do
        y = y + (case.y or 0)
        wires[k] = scene:wire{ E = 1e9, density = 1200, radius = R, from = turn{ -0.1, y, 0 },
          to = turn{ 0.1, y, 0 }, segments = 37 }
        for _, s in ipairs{ 0, 0.2 } do ends[#ends + 1] = scene:clamp(wires[k], { s = s }) end
      end
      local object = block(scene, { at = { 0.003, 0, 2.5 * R }, turn = turn })
      scene:wire_contact{ friction = 0.5 }
      local run = t.fine(scene:run{ duration = 1, dt = case[2] })
      t.below(1e-3, run:ledger().gained / run:ledger().play, "energy made")
      local up, load, all = turn{ 0, 0, 1 }, 0, 0
      for _, touch in ipairs(scene:touches()) do
        assert.equal(object.name, touch.wires[1])
        load = load + dot(touch.force, up)
      end
      local weight = 2e-3 * G
      -- the remaining swing has decayed at 20 /s, far below a thousandth
      t.share(weight, load, 0.01, "weight on the wires")
      for _, hold in ipairs(ends) do all = all + dot(hold:force(), up) end
      t.share(weight + 2 * wires[1].beam.mass_per_length * 0.2 * G, all, 0.01, "weight on the clamps")
      t.below(0.02 * R, (scene:penetration()), "penetration")
    end)
  end

  it("is carried by a wire with explicit methods too", function()
    for _, method in ipairs{ "symplectic-euler", "velocity-verlet" } do
      local scene = sw.scene{ gravity = { 0, 0, -G } }
      local wire = scene:wire{ model = "string", E = 1e7, density = 1200, radius = R, from = { -0.02, 0, 0 },
        to = { 0.02, 0, 0 }, segments = 8 }
      scene:clamp(wire, { s = 0 })
      scene:clamp(wire, { s = 0.04 })
      local positions = { { -R, 0, 2.05 * R }, { 3 * R, 0, 2.05 * R } }
      local object = scene:particles{ positions = positions, masses = 1e-4,
        links = { { 1, 2, k = 100 } }, radius = R }
      scene:wire_contact{ friction = 0.3 }
      t.fine(scene:run{ duration = 0.02, dt = 2e-5, integrator = method })
      -- in free fall the object would have fallen by 2 mm
      t.above(1.6 * R, (object:particle(1))[3], method .. ": height")
    end
  end)

  it("slides along wires as Coulomb's law says", function()
    for _, share in ipairs{ 0.95, 1.1 } do
      local mu, a = 0.4, math.atan(0.4 * share)
      local scene = sw.scene{ gravity = { 0, 0, -G } }
      scene:force{ kind = "damping", stiffness = 1e-3 }
      for _, y in ipairs{ -2 * R, 2.5 * R } do
        local wire = scene:wire{ E = 1e11, density = 1200, radius = R, from = { -0.05, y, 0 },
          to = { 0.05, y, 0 }, segments = 20 }
        scene:clamp(wire, { s = 0 })
        scene:clamp(wire, { s = 0.1 })
      end
      local object = block(scene, { at = { 0, 0, 2.001 * R }, E = 1e6 })
      scene:wire_contact{ friction = mu }
      t.fine(scene:run{ duration = 0.2, dt = 5e-3 })
      scene:gravity{ G * math.sin(a), 0, -G * math.cos(a) }
      local x, time = (object:particle(1))[1], 0.2
      t.fine(scene:run{ duration = time, dt = 5e-3 })
      local way = (object:particle(1))[1] - x
      local free = 0.5 * G * (math.sin(a) - mu * math.cos(a)) * time ^ 2
      if share < 1 then
        -- the friction springs of an object of 64 particles are 64 times softer than its touches
        t.below(50e-6, math.abs(way), "way of what sticks [m]")
      else
        t.share(free, way, 0.06, "way of what slides") -- the springs add 1.5 mm/s
      end
    end
  end)

  for _, case in ipairs{ { 0, 5e-3, 0.2 }, { 1.3, 2e-3, 1 }, { 0.4, 0.01, 3 } } do
    it(("collides with another: turned by %g, steps of %g s, %g m/s"):format(table.unpack(case)), function()
      local turn, v, mass = turner(case[1]), case[3], { 2e-3, 1e-3 }
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local one = block(scene, { name = "one", at = { 0, 0, 0 }, turn = turn, mass = mass[1], E = 3e6 })
      local two = block(scene, { name = "two", at = { 30 * R, 0.7 * R, 1.1 * R }, turn = turn, n = 3,
        mass = mass[2], E = 3e6 })
      scene:wire_contact{ friction = 0.3 }
      one:set_velocity(turn{ v, 0, 0 })
      local before = scene:energy().kinetic
      local touched = false
      for _ = 1, 10 do
        local run = t.fine(scene:run{ duration = 0.02 / v, dt = math.min(case[2], 0.002 / v) })
        touched = touched or scene:contacts() > 0 or scene:energy().kinetic < 0.999 * before
        local ledger = run:ledger()
        t.below(1e-2, ledger.gained / before, "energy made")
      end
      assert.is_true(touched)
      -- forces are equal and opposite: momentum changes by rounding only
      local p, q, whole = momentum(one, mass[1]), momentum(two, mass[2]), turn{ mass[1] * v, 0, 0 }
      for k = 1, 3 do t.near(whole[k], p[k] + q[k], 1e-7 * mass[1] * v, "momentum") end
      -- the struck object moves at least as fast as the one that struck it
      local along = turn{ 1, 0, 0 }
      t.above(dot(p, along) / mass[1] - 1e-3 * v, dot(q, along) / mass[2], "speed of what was struck")
      -- and no faster than an elastic impact of balls would make it
      t.below(1.001 * 2 * mass[1] / (mass[1] + mass[2]) * v, dot(q, along) / mass[2], "speed")
      t.below(before, scene:energy().kinetic, "kinetic energy")
    end)
  end

  -- The wires are between rows of particles, so edges of the block lie on them. There both axes are 2 R
  -- apart, and the middle between the surfaces is R from the wire's axis.
  it("reports where its edges touch a wire", function()
    local scene, wires = sw.scene{ gravity = { 0, 0, -G } }, {}
    scene:force{ kind = "damping", mass = 20 }
    for _, y in ipairs{ -4 * R, 4 * R } do
      local wire = scene:wire{ E = 1e9, density = 1200, radius = R, from = { -0.03, y, 0 },
        to = { 0.03, y, 0 }, segments = 11 }
      scene:clamp(wire, { s = 0 })
      scene:clamp(wire, { s = 0.06 })
      wires[wire.name] = wire
    end
    block(scene, { at = { 0, 0, 2.01 * R } })
    scene:wire_contact{ friction = 0.5 }
    t.fine(scene:run{ duration = 0.3, dt = 5e-3 })
    local touches = scene:touches()
    assert.is_true(#touches >= 8)
    for _, touch in ipairs(touches) do
      local away, on = 0, wires[touch.wires[2]]:position(touch.s[2])
      for k = 1, 3 do away = away + (touch.point[k] - on[k]) ^ 2 end
      t.share(R, math.sqrt(away), 0.01, "the place from the wire's axis")
    end
  end)

  it("carries a wire that is laid over it", function()
    local scene = sw.scene{ gravity = { 0, 0, -G } }
    scene:force{ kind = "damping", mass = 20 }
    local object = block(scene, { at = { 0, 0, 0 }, E = 1e6 })
    local floor, wanted = {}, 2.1 * R
    for k = 1, 16 do floor[k] = k end
    local hold = scene:hold(object, { particles = floor })
    local wire = scene:wire{ E = 2e8, density = 1200, radius = R, from = { -0.04, 0.3 * R, 12 * R + wanted },
      to = { 0.05, 0.2 * R, 12 * R + wanted }, segments = 31 }
    scene:wire_contact{ friction = 0.5 }
    t.fine(scene:run{ duration = 1, dt = 5e-3 })
    local weight = (2e-3 * 1 + wire.beam.mass_per_length * wire.length) * G
    t.share(weight, hold:force()[3], 0.01, "weight on what holds the object")
    t.above(12 * R + 1.8 * R, wire:position(wire.length / 2)[3], "height of the wire")
    t.fine(scene:settle())
    t.share(weight, hold:force()[3], 1e-3, "the same at rest")
  end)

  it("does not pass through itself", function()
    -- a strip of 20 cells whose ends are brought together, one above the other
    local positions, links, n = {}, {}, 21
    for i = 0, n - 1 do
      for j = 0, 1 do positions[#positions + 1] = { i * 4 * R, j * 4 * R, 0 } end
    end
    local function add(a, b) links[#links + 1] = { a, b, k = 200 } end
    for i = 0, n - 1 do
      add(2 * i + 1, 2 * i + 2)
      if i + 1 < n then
        for _, p in ipairs{ { 1, 3 }, { 2, 4 }, { 1, 4 }, { 2, 3 } } do add(2 * i + p[1], 2 * i + p[2]) end
      end
    end
    local scene = sw.scene{ gravity = { 0, 0, -G } }
    scene:force{ kind = "damping", mass = 20 }
    scene:obstacle{ shape = "plane", at = { 0, 0, -R }, friction = 0.3 }
    local strip = scene:particles{ positions = positions, masses = 1e-5, links = links, radius = R }
    local hand = scene:hold(strip, { particles = { 1, 2 } })
    scene:wire_contact{ friction = 0.3 }
    hand:follow{ points = { { 0, 0, 0 }, { 20 * R, 0, 30 * R }, { 50 * R, 0, 20 * R },
      { 50 * R, 0, 2.5 * R } }, duration = 1, relative = true }
    t.fine(scene:run{ duration = 1.5, dt = 5e-3 })
    assert.is_true(scene:contacts() > 20)
    t.below(0.1 * R, (scene:penetration()), "penetration")
    -- no particle of the upper part is below the surface of the lower part
    local upper = 0
    for k = 1, 2 * n do
      local x = strip:particle(k)
      t.above(-0.05 * R, x[3], "height")
      if x[3] > 1.5 * R then upper = upper + 1 end
    end
    t.above(5, upper, "particles of the upper layer")
  end)

  it("goes on the same after a snapshot, a saved file and a change of the scene", function()
    local function make()
      local scene = sw.scene{ gravity = { 0.3, 0, -G } }
      scene:force{ kind = "damping", mass = 10 }
      local wire = scene:wire{ name = "wire", E = 1e9, density = 1200, radius = R, from = { -0.1, 0, 0 },
        to = { 0.1, 0, 0 }, segments = 20 }
      scene:clamp(wire, { s = 0 })
      scene:clamp(wire, { s = 0.2 })
      local object = block(scene, { name = "block", at = { 0, 0.3 * R, 2.2 * R } })
      scene:wire_contact{ friction = 0.5 }
      t.fine(scene:run{ duration = 0.1, dt = 5e-3 })
      return scene, object
    end
    local scene, object = make()
    local touches, snapshot, ways = scene:contacts(), scene:snapshot(), {}
    t.above(0, touches, "touches")
    for k = 1, 2 do
      t.fine(scene:run{ duration = 0.1, dt = 5e-3 })
      ways[k] = object:positions()
      scene:restore(snapshot)
      assert.equal(touches, scene:contacts())
    end
    assert.same(ways[1], ways[2])
    local file = os.tmpname()
    scene:save(file)
    local other = sw.load(file)
    os.remove(file)
    assert.equal(touches, other:contacts())
    t.fine(other:run{ duration = 0.1, dt = 5e-3 })
    assert.same(ways[1], other:find("block"):positions())
    -- another hold makes a new system; friction's springs are kept, so nothing jumps
    scene:hold(object, { particles = { 64 } })
    local x = object:particle(1)
    t.fine(scene:run{ duration = 5e-3, dt = 5e-3 })
    t.near(x[1], (object:particle(1))[1], 1e-4, "place")
  end)

  it("names what may touch where something else is given", function()
    local scene = sw.scene{}
    local object = block(scene, { at = { 0, 0, 0 } })
    assert.error_matches(function() scene:wire_contact{ between = 3 } end,
      "is a wire, an object of particles or a list of these, got")
    scene:wire_contact{ between = object, friction = 0.2 }
  end)
end)
