-- SPDX-License-Identifier: GPL-3.0-or-later
-- Snapshots: a run that goes on from one is the same, to the last bit.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

-- Everything that can be read of a scene with one wire, as one list.
local function state(scene, wire)
  local all = {}
  for _, list in ipairs{ (wire:positions()), (wire:velocities()) } do
    table.move(list, 1, #list, #all + 1, all)
  end
  for k = 0, 10 do all[#all + 1] = wire:tension(wire.length * k / 10) end
  all[#all + 1] = scene.time
  all[#all + 1] = scene:energy().total
  return all
end

local function same(a, b)
  assert.are.equal(#a, #b)
  assert.are.equal(0, t.largest_difference(a, b))
end

for _, method in ipairs{ { "tr-bdf2", 0.01 }, { "bdf2", 0.01 }, { "sdirk2", 0.01 },
  { "implicit-midpoint", 0.01 }, { "implicit-euler", 0.01 }, { "velocity-verlet", 5e-5 },
  { "rk4", 5e-5 } } do
  describe("a snapshot under " .. method[1], function()
    local function go(c, duration)
      t.fine(c.scene:run{ duration = duration, dt = method[2], integrator = method[1] })
    end

    it("is restored exactly, again and again", function()
      local c = cases.release{ segments = 15 }
      go(c, 0.2)
      local snapshot = c.scene:snapshot()
      local here = state(c.scene, c.wire)
      go(c, 0.2)
      local there = state(c.scene, c.wire)
      for _ = 1, 3 do
        c.scene:restore(snapshot)
        same(here, state(c.scene, c.wire))
        go(c, 0.2)
        same(there, state(c.scene, c.wire))
      end
    end)

    it("does not disturb the run it is taken from", function()
      local c, plain = cases.release{ segments = 15 }, cases.release{ segments = 15 }
      go(plain, 0.2)
      go(plain, 0.2)
      go(c, 0.2)
      c.scene:snapshot()
      go(c, 0.2)
      same(state(plain.scene, plain.wire), state(c.scene, c.wire))
    end)
  end)
end

describe("a snapshot", function()
  it("brings back a hold that was released, and takes away one that was added", function()
    local c = cases.release{ segments = 20 }
    t.fine(c.scene:run{ duration = 0.1 })
    local snapshot = c.scene:snapshot()
    local here = state(c.scene, c.wire)
    t.fine(c.scene:run{ duration = 0.1 })
    local there = state(c.scene, c.wire)

    c.scene:clamp(c.wire, { s = 0.613 }) -- moves a node
    c.clamp:release()
    t.fine(c.scene:run{ duration = 0.1 })
    assert.is_true(t.distance({ 0, 0, 0 }, c.wire:position(0)) > 1e-6)

    c.scene:restore(snapshot)
    same(here, state(c.scene, c.wire))
    t.fine(c.scene:run{ duration = 0.1 })
    same(there, state(c.scene, c.wire))
    assert.is_true(c.clamp:force()[3] ~= 0)
    t.below(1e-12, t.distance({ 0, 0, 0 }, c.wire:position(0)), "clamped end moved by")
  end)

  it("keeps motions under way", function()
    local c = cases.transport{ segments = 15 }
    t.fine(c.scene:settle())
    c.clamp:follow{ points = { { 0, 0, 0 }, { 0.5, 0, 0 } }, times = { 0, 1 }, law = "minimum-jerk" }
    t.fine(c.scene:run{ duration = 0.3 })
    local snapshot = c.scene:snapshot()
    t.fine(c.scene:run{ duration = 0.4 })
    local there = state(c.scene, c.wire)
    c.scene:restore(snapshot)
    c.clamp:follow(nil) -- stops
    t.fine(c.scene:run{ duration = 0.4 })
    assert.is_true(t.largest_difference(there, state(c.scene, c.wire)) > 0.01)
    c.scene:restore(snapshot)
    t.fine(c.scene:run{ duration = 0.4 })
    same(there, state(c.scene, c.wire))
  end)

  it("keeps contact and friction", function()
    local c = cases.laying{ segments = 40, duration = 1, distance = 0.6 }
    t.fine(c.run{ duration = 0.9 })
    assert.is_true(c.scene:contacts() > 0)
    local snapshot = c.scene:snapshot()
    t.fine(c.scene:run{ duration = 0.3 })
    local there = state(c.scene, c.wire)
    c.scene:restore(snapshot)
    t.fine(c.scene:run{ duration = 0.3 })
    same(there, state(c.scene, c.wire))
  end)

  it("keeps gravity, adaptive steps and added forces", function()
    local c = cases.release{ segments = 15 }
    t.fine(c.scene:run{ duration = 0.2, tolerance = 1e-5 })
    local snapshot = c.scene:snapshot()
    t.fine(c.scene:run{ duration = 0.2, tolerance = 1e-5 })
    local there = state(c.scene, c.wire)
    c.scene:restore(snapshot)
    c.scene:gravity{ 0, 0, -1 }
    c.scene:force{ kind = "line", on = c.wire, force = { 0, 1, 0 } }
    t.fine(c.scene:run{ duration = 0.2, tolerance = 1e-5 })
    assert.is_true(t.largest_difference(there, state(c.scene, c.wire)) > 0.01)
    c.scene:restore(snapshot)
    t.fine(c.scene:run{ duration = 0.2, tolerance = 1e-5 })
    same(there, state(c.scene, c.wire))
  end)

  it("is a way out of a diverged run", function()
    local c = cases.cord{}
    local snapshot = c.scene:snapshot()
    local here = state(c.scene, c.wire)
    local r = c.run{ duration = 0.5, dt = 1.2 * c.exact.leapfrog,
      integrator = "velocity-verlet", unstable = true }
    assert.is_false(r.ok)
    c.scene:restore(snapshot)
    same(here, state(c.scene, c.wire))
    t.fine(c.run{ duration = 0.1, dt = 0.9 * c.exact.leapfrog, integrator = "velocity-verlet" })
  end)

  it("of a settled scene makes tuning loops exact", function()
    local c = cases.droop{}
    t.fine(c.run())
    local snapshot, tips = c.scene:snapshot(), {}
    for round = 1, 2 do
      for i, g in ipairs{ 5, 9.81, 15 } do
        c.scene:restore(snapshot)
        c.scene:gravity{ 0, 0, -g }
        t.fine(c.scene:settle())
        local tip = c.wire:position(1)
        if round == 1 then tips[i] = tip else assert.are.equal(0, t.distance(tip, tips[i])) end
      end
    end
  end)

  it("of another scene is refused", function()
    local a, b = sw.scene{}, sw.scene{}
    a:wire{ E = 1e9, density = 1000, radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    assert.has_error(function() b:restore(a:snapshot()) end)
  end)
end)
