-- SPDX-License-Identifier: GPL-3.0-or-later
-- The mixed grasp, compared with plates all the way: a wire is squeezed, lifted, carried and laid down.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r, L, width, force = 0.003, 0.24, 0.02, 20

-- The table is frictionless, so results do not depend on the way there.
local function new_scene()
  local scene = sw.scene{}
  scene:obstacle{ name = "table", shape = "plane", friction = 0 }
  local wire = scene:wire{ E = 2e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r },
    to = { L, 0, r },    segments = 48 }
  scene:force{ kind = "damping", mass = 8 }
  local g = scene:gripper{ name = "hand", pads = { width = width, friction = 0.7, opening = 3 * r } }
  return scene, wire, g
end

-- The two-plate test. freeze: nil = as usual, false = never. Returns what was recorded on the way.
local function carry(freeze)
  local scene, wire, g = new_scene()
  local seen = { g = g, wire = wire, scene = scene }
  local function look(name)
    local x = {}
    for k = 0, 12 do x[k] = wire:position(L * k / 12) end
    seen[name] = { force = g:force(), moment = g:moment(), x = x, squeeze = g:squeeze(), time = scene.time,
      tail = g:moment{ at = wire:position(L / 2 - 2 * width) } }
  end
  local clock = os.clock
  scene:process(function(p)
    g:grasp(wire, { s = L / 2, approach = "mixed", force = force, freeze = freeze })
    look "held"
    local from, began = scene.time, clock()
    g:move{ by = { 0, 0, 0.15 }, duration = 1 }
    p:wait(2)
    look "lifted"
    g:move{ by = { 0, 0.05, 0 }, duration = 0.5 }
    p:wait(1)
    look "carried"
    seen.cost = (clock() - began) / (scene.time - from)
    g:move{ by = { 0, 0, -0.145 }, duration = 1 }
    g:release()
    p:wait(0.5)
  end)
  local run = scene:run{ dt = 0.01 }
  assert(run.ok, run.reason)
  return seen
end

describe("a mixed grasp", function()
  local mixed, plates
  setup(function() mixed, plates = carry(), carry(false) end)

  it("is frozen once and given back to the pads", function()
    local kinds = {}
    for i, e in ipairs(mixed.g.events) do kinds[i] = e.kind end
    assert.are.same({ "frozen", "thawed" }, kinds)
    assert.are.same({}, plates.g.events)
    assert.equal("rod", mixed.wire.model) -- as it was before
  end)

  it("has the force, moment, shape and section of plates within 2 %", function()
    for _, when in ipairs{ "lifted", "carried" } do
      local a, b = mixed[when], plates[when]
      t.share(b.force[3], a.force[3], 0.02, when .. ": force")
      t.share(b.tail[2], a.tail[2], 0.02, when .. ": moment of one side")
      t.share(b.squeeze.height, a.squeeze.height, 0.02, when .. ": height of the section")
      t.share(b.squeeze.width, a.squeeze.width, 0.02, when .. ": width of the section")
      for k = 0, 12 do
        t.below(0.02 * L, t.distance(a.x[k], b.x[k]), ("%s: place at s = %g L"):format(when, k / 12))
      end
    end
  end)

  it("costs less than a quarter to carry", function()
    -- benchmarks give the ratio; this bound only leaves room for noise
    t.below(plates.cost / 4, mixed.cost, "computing time per simulated second")
  end)

  it("takes hold of soft and stiff wires on a rough table, thick and thin", function()
    for _, E in ipairs{ 1e6, 1e8, 1e9, 3e9 } do
      for _, thick in ipairs{ 0.001, 0.005 } do
        local scene = sw.scene{}
        scene:obstacle{ shape = "plane", friction = 0.4 }
        scene:force{ kind = "damping", mass = 8, stiffness = 1e-3 }
        local long, wide = 40 * thick, math.max(4 * thick, 0.006)
        local wire = scene:wire{ E = E, nu = 0.4, density = 1200, radius = thick,
          from = { 0, 0, thick }, to = { long, 0, thick } }
        local g = scene:gripper{ pads = { opening = 3 * thick, friction = 0.6, width = wide } }
        local weight = wire.beam.mass_per_length * long * 9.81
        scene:process(function(p) -- the pads' force squeezes it by some per cent
          g:grasp(wire, { s = long / 2, approach = "mixed", force = 0.0176 * E * thick * wide })
          g:move{ by = { 0, 0, long / 2 }, duration = 0.5 }
          p:wait(0.5)
          t.share(weight, g:force()[3], 0.02, "weight") -- the wire still swings
        end)
        local run = t.fine(scene:run{ dt = 0.01 })
        assert.equal("frozen", g.events[1].kind)
        t.below(12, run.rejected, ("steps not taken, E = %g, r = %g"):format(E, thick))
      end
    end
  end)

  it("keeps its force in the first step after a switch, in full motion", function()
    local scene, wire, g = new_scene()
    local mass = wire.beam.mass_per_length * L
    scene:process(function()
      g:grasp(wire, { s = L / 2, approach = "mixed", force = force, freeze = false })
      g:move{ by = { 0, 0, 0.1 }, duration = 0.4 }
    end)
    local seen = {}
    scene:process(function(p) -- in the middle of the move, where it is fast
      p:wait_until(function() return g.held end)
      p:wait(0.1)
      for k, change in ipairs{ "freeze", "thaw" } do
        p:wait(0.1)
        seen[k] = { g:force()[3] }
        g[change](g)
        p:wait(0.001)
        seen[k][2] = g:force()[3]
      end
    end)
    t.fine(scene:run{ dt = 0.001 })
    for k, name in ipairs{ "frozen", "thawed" } do
      -- 1 %, plus what swinging ends change in a step of 1 ms
      t.near(seen[k][1], seen[k][2], 0.02 * mass * 9.81, name .. ": force in motion")
    end
  end)

  it("keeps mass and momentum across the switches", function()
    local mass
    -- In the middle of a move, where the wire is fast: the force at the gripper two steps after each
    -- switch. Only the first `switches` switches are made. The first step after a switch begins anew and is
    -- off by up to 2 %.
    local function ride(switches)
      local scene, wire, g = new_scene()
      local seen = {}
      mass = wire.beam.mass_per_length * L
      scene:process(function()
        g:grasp(wire, { s = L / 2, approach = "mixed", force = force, freeze = false })
        g:move{ by = { 0, 0, 0.1 }, duration = 0.4 }
      end)
      scene:process(function(p)
        p:wait_until(function() return g.held end)
        p:wait(0.1)
        for k, change in ipairs{ "freeze", "thaw" } do
          p:wait(0.1)
          if k <= switches then g[change](g) end
          p:wait(0.002)
          seen[k] = g:force()[3]
        end
      end)
      t.fine(scene:run{ dt = 0.001 })
      return seen, g
    end
    local none, once = ride(0), ride(1)
    local both, g = ride(2)
    -- compared with the same instant without the switch: swinging ends change the force by 2 % a step
    t.near(none[1], once[1], 0.01 * mass * 9.81, "frozen: force in motion")
    t.near(once[2], both[2], 0.01 * mass * 9.81, "thawed: force in motion")
    for i = 1, 2 do
      local e = g.events[i]
      assert.equal(({ "frozen", "thawed" })[i], e.kind)
      for _, part in ipairs{ "linear", "angular" } do
        local scale = part == "linear" and mass * 0.1 or mass * 0.1 * L
        for k = 1, 3 do
          t.near(e.before[part][k], e.after[part][k], 1e-9 * scale, e.kind .. ": " .. part .. " momentum")
        end
      end
      t.above(0.3 * mass * 0.1, math.abs(e.before.linear[3]), "it moves") -- not at rest
    end
  end)

  it("keeps force and moment across a switch at rest", function()
    local scene, wire, g = new_scene()
    local steps = {}
    scene:process(function(p)
      g:grasp(wire, { s = L / 2, approach = "mixed", force = force, freeze = false })
      g:move{ by = { 0, 0, 0.15 }, duration = 1 }
      p:wait(3)
      for k, change in ipairs{ "freeze", "thaw" } do
        steps[k] = { before = g:force()[3], tail = g:moment{ at = wire:position(L / 2 - 2 * width) }[2] }
        g[change](g)
        steps[k].at_once = g:force()[3]
        p:wait(0.01)
        steps[k].after = g:force()[3]
        steps[k].tail_after = g:moment{ at = wire:position(L / 2 - 2 * width) }[2]
        p:wait(1)
        steps[k].later = g:force()[3]
        steps[k].tail_later = g:moment{ at = wire:position(L / 2 - 2 * width) }[2]
      end
    end)
    local run = scene:run{ dt = 0.01 }
    assert(run.ok, run.reason)
    for k, s in ipairs(steps) do
      t.share(s.before, s.after, 1e-3, ("force a step after switch %d"):format(k))
      t.share(s.tail, s.tail_after, 0.01, ("moment of one side a step after switch %d"):format(k))
      t.share(s.before, s.later, 1e-3, ("force a second after switch %d"):format(k))
      t.share(s.tail, s.tail_later, 0.01, ("moment of one side a second after switch %d"):format(k))
    end
    t.near(steps[1].before, steps[1].at_once, 1e-9, "what the grip begins with")
  end)

  it("goes back to the pads when they would lose the wire", function()
    local scene, wire, g = new_scene()
    local weight = wire.beam.mass_per_length * L * 9.81
    scene:process(function(p)
      -- enough for the weight, but not for the jerk at the end
      g:grasp(wire, { s = L / 2, approach = "mixed", force = 2 * weight })
      assert.is_truthy(g.frozen)
      g:move{ by = { 0, 0, 0.15 }, duration = 1 }
      p:wait(0.5)
      assert.is_truthy(g.frozen)
      g:move{ by = { 0, 0, 0.15 }, duration = 0.15 }
    end)
    scene:run{ dt = 0.005 }
    local lost = g.events[2]
    assert.equal("thawed", lost.kind)
    t.above(0.9, lost.margin, "margin")
    assert.is_nil(g.frozen)
  end)

  it("goes on to the same bits from a snapshot", function()
    local scene, wire, g = new_scene()
    scene:process(function() g:grasp(wire, { s = L / 2, approach = "mixed", force = force }) end)
    assert(scene:run{ dt = 0.01 }.ok)
    local snapshot = scene:snapshot()
    local function on()
      scene:process(function()
        g:move{ by = { 0, 0, 0.1 }, duration = 0.5 }
        g:release()
      end)
      local run = scene:run{ dt = 0.01 }
      assert(run.ok, run.reason)
      return wire:positions(), #g.events
    end
    local a, n = on()
    scene:restore(snapshot)
    assert.is_truthy(g.frozen)
    local b, m = on()
    assert.are.same(a, b)
    assert.equal(n, m)
  end)
end)
