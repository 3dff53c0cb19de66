-- SPDX-License-Identifier: GPL-3.0-or-later
-- Grippers that grasp or let go while they move, as another process told them: the move goes on. References
-- are the move itself, which does not depend on the wire, and the momentum of the wire.
local sw = require "softworld"
local vec = require "softworld.vec"

local WAY = { 0.02, 0.2, 0.05 }

-- A carries the wire; B flies beside it and grasps at t = 0.5 s; then A lets go.
local function flight(options)
  local o = options or {}
  local scene = sw.scene{ gravity = o.gravity or { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", segments = 40, from = { 0, 0, 0.3 },
    to = { 0.4, 0, 0.3 } }
  scene:force{ kind = "damping", stiffness = 5e-3 }
  local b_at = { 0.23, 0, 0.3 + (o.off or 0) }
  local a, b = scene:gripper{ name = "a" }, scene:gripper{ name = "b", at = b_at }
  a:grasp(wire, { s = 0.17 })
  local at = {}
  scene:process(function() a:move{ by = WAY, duration = 1 } end)
  scene:process(function() b:move{ by = WAY, duration = 1 } end)
  scene:process(function(p)
    p:wait(0.5)
    at.wire, at.b = wire:position(0.23), b:position()
    b:grasp(wire, { s = 0.23 })
    at.after = b:position()
    p:wait(0.02)
    a:release()
    at.freed, at.a = p.time, a:position()
  end)
  local run = scene:run{ duration = 2, dt = 0.01 }
  assert.is_true(run.ok)
  return { run = run, wire = wire, a = a, b = b, at = at, b_end = vec.add(b_at, WAY) }
end

local function same(expected, got, tolerance)
  for k = 1, 3 do assert.near(expected[k], got[k], tolerance, ("coordinate %d"):format(k)) end
end

describe("a gripper that grasps as it moves", function()
  -- Before, it stopped where it grasped, without a word; the process that waited for the move went on as if
  -- it had been made. 1e-9 m: rounding of the move's law.
  it("goes on with its move, and takes the wire along", function()
    local f = flight()
    same(f.at.b, f.at.after, 1e-12)
    same(f.b_end, f.b:position(), 1e-9)
    same(vec.add(f.at.wire, vec.sub(f.b_end, f.at.b)), f.wire:position(0.23), 1e-6)
    assert.are.equal(0, #f.run.events)
  end)

  -- 1e-4 m: the wire lags behind A by its inertia
  it("tells how far from its centre it took the wire, and keeps the wire there", function()
    local f = flight{ off = 0.01 }
    assert.are.equal("grasp", f.run.events[1].kind)
    assert.near(0.01, f.run.events[1].value, 1e-4)
    assert.is_truthy(f.run.events[1].text:find("from its centre: it goes on with its move", 1, true))
    same(f.b_end, f.b:position(), 1e-9)
    same(vec.add(f.at.wire, vec.sub(f.b_end, f.at.b)), f.wire:position(0.23), 1e-6)
  end)

  -- What both grippers gave the wire is its weight times the time, and the momentum that it still swings
  -- with. 1e-3 of it: steps without a jerk count by the trapezoids of their ends.
  it("bears the wire's weight and inertia, which the other had borne", function()
    local f = flight{ gravity = { 0, 0, -9.81 } }
    local mass, rest = f.wire.beam.mass_per_length * f.wire.length, { 0, 0, 0 }
    for k = 1, 400 do
      rest = vec.add(rest, f.wire:velocity((k - 0.5) / 400 * f.wire.length), mass / 400)
    end
    local weight = mass * 9.81
    same(vec.add(rest, { 0, 0, 2 * weight }), vec.add(f.a.impulse, f.b.impulse), 2e-3 * weight)
    assert.is_true(f.b.impulse[3] > 1.3 * weight)
  end)
end)

describe("a gripper that lets go as it moves", function()
  it("goes on with its move", function()
    local f = flight()
    same(vec.add({ 0.17, 0, 0.3 }, WAY), f.a:position(), 1e-9)
    assert.is_true(vec.norm(vec.sub(f.at.a, f.a:position())) > 0.05)
  end)

  it("has loads up to its release only", function()
    local f = flight()
    local series = f.a:series()
    assert.is_true(series.t[#series.t] < f.at.freed + 1e-9)
    assert.near(f.at.freed, f.a:over().duration, 1e-9)
  end)
end)

-- One gripper grasps three times: after a move while empty, beside its first wire, and anew. It holds
-- something for 0.2 + 0.1 + 0.1 s.
describe("the loads of a gripper that moved while empty and took a second wire", function()
  it("have each step once", function()
    local scene, wires = sw.scene{}, {}
    for k = 1, 2 do
      wires[k] = scene:wire{ name = "w" .. k, cable = "GXL 1.5", segments = 20, from = { 0, 0.1 * k, 0.3 },
        to = { 0.4, 0.1 * k, 0.3 } }
    end
    scene:force{ kind = "damping", stiffness = 5e-3 }
    local hand = scene:gripper{ name = "hand", at = { 0.2, 0.1, 0.35 } }
    scene:process(function(p)
      hand:move{ by = { 0, 0, -0.05 }, duration = 0.1 }
      hand:grasp(wires[1], { s = 0.2 })
      p:wait(0.2)
      hand:grasp(wires[2], { s = 0.2 })
      p:wait(0.1)
      hand:release()
      p:wait(0.1)
      hand:grasp(wires[1], { s = 0.1 })
      p:wait(0.1)
    end)
    assert.is_true(scene:run{ dt = 0.01 }.ok)
    assert.near(0.4, hand:over().duration, 1e-9)
    local last = 0
    for _, t in ipairs(hand:series().t) do
      assert.is_true(t > last)
      last = t
    end
  end)

  it("begin with the first step of a hold", function()
    local scene = sw.scene{}
    local wire = scene:wire{ cable = "GXL 1.5", segments = 20, from = { 0, 0, 0.3 }, to = { 0.4, 0, 0.3 } }
    scene:force{ kind = "damping", stiffness = 5e-3 }
    local clamp = scene:clamp(wire, { s = 0 })
    assert.is_true(scene:run{ dt = 0.01, duration = 0.3 }.ok)
    assert.near(0.3, clamp:over().duration, 1e-9)
    assert.near(0.1, clamp:over(0.1, 0.2).duration, 1e-9)
    assert.near(0.2, clamp:over(0, 0.2).duration, 1e-9)
  end)
end)

describe("pads that grasp as they move", function()
  -- Pads that close on a wire at rest while they go along it: their centre keeps its way, the wire follows.
  it("stay on their way", function()
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    scene:force{ kind = "damping", mass = 8, stiffness = 1e-3 }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", segments = 40, from = { 0, 0, 0.0012 },
      to = { 0.4, 0, 0.0012 } }
    local hand = scene:gripper{ name = "hand", at = { 0.1, 0, 0.0012 },
      pads = { width = 0.01, friction = 0.6, opening = 0.006 } }
    scene:process(function() hand:move{ by = { 0.1, 0, 0 }, duration = 1 } end)
    scene:process(function(p)
      p:wait(0.3)
      hand:grasp(wire, { s = 0.14, approach = "plates", force = 5 })
    end)
    local run = scene:run{ duration = 1.2, dt = 0.01 }
    assert.is_true(run.ok)
    same({ 0.2, 0, 0.0012 }, hand:position(), 1e-9)
    assert.are.equal("grasp", run.events[#run.events].kind)
    assert.is_true(wire:position(0)[1] > 0.03)
  end)
end)
