-- SPDX-License-Identifier: GPL-3.0-or-later
-- object:get() and object:set{} between steps: friction, restitution and places of obstacles, gravity,
-- grippers, forces; snapshots and refusals.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local G = 9.80665

-- A rod that slides along a floor at 2 m/s, pressed by its weight.
local function sliding(friction)
  local scene = sw.scene{ gravity = { 0, 0, -G } }
  local floor = scene:obstacle{ name = "floor", shape = "plane", friction = friction }
  local wire = scene:wire{ E = 1e8, density = 1500, radius = 0.005, segments = 6, from = { 0, 0, 0.005 },
    to = { 0.2, 0, 0.005 } }
  t.fine(scene:settle())
  wire:set_velocity{ 0, 2, 0 }
  return scene, floor, wire
end

-- Returns the rod's mean deceleration over 0.04 s [m/s2].
local function braked(scene, wire)
  local before = wire:velocity(0.1)[2]
  t.fine(scene:run{ duration = 0.04, dt = 1e-3 })
  return (before - wire:velocity(0.1)[2]) / 0.04
end

describe("wire:get", function()
  it("tells what the wire is made of, also after a remodelling", function()
    local scene = sw.scene{}
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
      segments = 20 }
    local cable, got = wire:cable(), wire:get()
    assert.same({ "w", "rod", "GXL 1.5", 20 }, { got.name, got.model, got.cable, got.segments })
    t.near(0.2, got.length, 1e-15)
    t.near(cable.outer_diameter.value / 2, got.radius, 1e-15)
    t.near(cable.EI.value, got.EI, 1e-15)
    t.near(cable.mass_per_length.value, got.mass_per_length, 1e-15)
    wire:remodel{ model = "string" }
    assert.equal("string", wire:get().model)
    scene:close()
    assert.error_matches(function() wire:get() end, "closed")
  end)
end)

describe("obstacle:set", function()
  -- mu g within 1 %: the rod slides as a whole, and its touches sink by less than 1e-5 m meanwhile.
  it("changes friction in mid-run", function()
    local scene, floor, wire = sliding(0.2)
    t.share(0.2 * G, braked(scene, wire), 0.01, "as made")
    floor:set{ friction = 0.5 }
    t.share(0.5 * G, braked(scene, wire), 0.01, "as set")
    floor:set{ friction = 0 }
    t.near(0, braked(scene, wire), 0.001 * G, "without") -- the bend from friction swings on, 2e-4 g
    floor:set{ friction = 0.4, kinetic_friction = 0.3 }
    t.share(0.3 * G, braked(scene, wire), 0.01, "sliding")
  end)

  it("is undone by snapshots, with the same bits afterwards", function()
    local scene, floor, wire = sliding(0.2)
    t.fine(scene:run{ duration = 0.02, dt = 1e-3 })
    local before = scene:snapshot()
    t.fine(scene:run{ duration = 0.02, dt = 1e-3 })
    local there = table.concat(wire:positions(), " ")
    floor:set{ friction = 0.7, restitution = 0.5 }
    t.fine(scene:run{ duration = 0.02, dt = 1e-3 })
    scene:restore(before)
    assert.equal(0.2, floor:get().friction)
    assert.equal(0, floor:get().restitution)
    t.fine(scene:run{ duration = 0.02, dt = 1e-3 })
    assert.equal(there, table.concat(wire:positions(), " "))
  end)

  it("is kept in the file of a run that breaks off", function()
    local file = os.tmpname()
    local function laid(crash)
      local scene, floor, wire = sliding(0.2)
      scene:process(function(p)
        p:step("rough", function()
          floor:set{ friction = 0.5 }
          p:wait(0.02)
        end)
        if crash then error "broken off" end
        p:step("on", function() p:wait(0.02) end)
      end)
      return scene, floor, wire
    end
    local scene, _, wire = laid(false)
    t.fine(scene:run{ dt = 1e-3 })
    local whole = table.concat(wire:positions(), " ")
    assert.is_false(pcall(scene.run, (laid(true)), { dt = 1e-3, save = file }))
    local again, floor, other = laid(false)
    t.fine(again:run{ dt = 1e-3, resume = file })
    os.remove(file)
    assert.equal(0.5, floor:get().friction)
    assert.equal(whole, table.concat(other:positions(), " "))
  end)

  it("moves the obstacle, and keeps what is not given", function()
    local scene = sw.scene{}
    local ball = scene:obstacle{ name = "ball", shape = "sphere", radius = 0.1, friction = 0.4,
      rotation = { axis = { 0, 0, 1 }, angle = 1 } }
    local turned = ball:get().rotation
    ball:set{ at = { 1, 2, 3 } }
    local now = ball:get()
    assert.same({ 1, 2, 3 }, now.at)
    assert.same(turned, now.rotation)
    assert.same({ "ball", 0.4, 0.4, 0 }, { now.name, now.friction, now.kinetic_friction, now.restitution })
  end)

  it("refuses unknown names, fixed parameters and values out of range", function()
    local scene = sw.scene{}
    local floor = scene:obstacle{ shape = "plane" }
    for text, args in pairs{
      ["obstacle:set: there is no parameter 'fricton'; did you mean 'friction'?"] = { fricton = 1 },
      ["obstacle:set: friction = -1 is not allowed; it must be in [0, 100]"] = { friction = -1 },
      ["obstacle:set: name is given when the object is made; the parameters to set are: at rotation friction "
        .. "kinetic_friction restitution"] = { name = "x" },
      ["obstacle:set: at must be a table of 3 numbers [m], got number 1"] = { at = 1 },
    } do
      local fine, why = pcall(floor.set, floor, args)
      assert.is_false(fine)
      assert.is_truthy(why:find(text, 1, true), why)
    end
    assert.equal(0.3, floor:get().friction)
  end)
end)

describe("scene:set", function()
  it("changes gravity from then on", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e8, density = 1500, radius = 0.005, from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    t.fine(scene:run{ duration = 0.1, dt = 0.01 })
    scene:set{ gravity = { 0, 0, -2 } }
    t.fine(scene:run{ duration = 0.1, dt = 0.01 })
    t.near(-0.2, wire:velocity(0.1)[3], 1e-9, "speed")
    assert.same({ name = "scene", gravity = { 0, 0, -2 } }, scene:get())
    assert.error_matches(function() scene:set{ gravty = { 0, 0, 0 } } end, "did you mean 'gravity'?")
  end)
end)

describe("gripper:set", function()
  it("changes the force that the jaws keep", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e7, density = 1200, radius = 0.003, segments = 20, from = { 0, 0, 0.1 },
      to = { 0.2, 0, 0.1 } }
    local hand = scene:gripper{ name = "hand", pads = { width = 0.02, opening = 0.009 } }
    assert.error_matches(function() hand:set{ force = 5 } end, "no jaws that keep a force")
    scene:process(function(p)
      hand:grasp(wire, { s = 0.1, approach = "plates", force = 10 })
      p:wait(0.2)
      t.share(10, hand:state().squeeze, 2e-3, "as grasped")
      assert.equal(10, hand:get().force)
      hand:set{ force = 15 }
      p:wait(0.2)
      t.share(15, hand:state().squeeze, 2e-3, "as set")
    end)
    t.fine(scene:run{ dt = 0.01 })
  end)

  it("changes reactions and slip tolerance, and get shows them", function()
    local hand = sw.scene{}:gripper{ name = "hand", at = { 0, 0, 1 } }
    hand:set{ slip_tolerance = 1e-3, on_slip = "warn", on_crash = "stop" }
    local now = hand:get()
    assert.same({ 1e-3, "warn", "stop", 0.5 }, { now.slip_tolerance, now.on_slip, now.on_crash,
      now.pads.friction })
    assert.same({ 0, 0, 1 }, now.at)
    assert.error_matches(function() hand:set{ on_slip = "halt" } end, "on_slip = 'halt' is not one of")
    assert.error_matches(function() hand:set{ slip_tolerence = 1 } end, "did you mean 'slip_tolerance'?")
  end)
end)

describe("force:set", function()
  local V = 0.3

  -- A wire that flies along itself at speed V; mass damping slows it by exp(-rate t).
  local function flying()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e7, density = 1200, radius = 0.003, segments = 10, from = { 0, 0, 0 },
      to = { 0.3, 0, 0 } }
    local damping = scene:force{ kind = "damping", on = wire, mass = 1 }
    wire:set_velocity{ V, 0, 0 }
    return scene, wire, damping
  end

  it("changes damping in mid-run; snapshots undo it", function()
    local scene, wire, damping = flying()
    t.fine(scene:run{ duration = 0.1, dt = 1e-3 })
    t.share(V * math.exp(-0.1), wire:velocity(0.1)[1], 1e-4, "as made") -- h^2 of the method: 1e-7
    local before = scene:snapshot()
    damping:set{ mass = 20 }
    assert.same({ 20, 0, "damping" }, { damping:get().mass, damping:get().stiffness, damping:get().kind })
    t.fine(scene:run{ duration = 0.1, dt = 1e-3 })
    t.share(V * math.exp(-2.1), wire:velocity(0.1)[1], 1e-3, "as set")
    scene:restore(before)
    assert.equal(1, damping:get().mass)
    t.fine(scene:run{ duration = 0.1, dt = 1e-3 })
    t.share(V * math.exp(-0.2), wire:velocity(0.1)[1], 1e-4, "taken back")
  end)

  -- m v' = F: 0.1 s of F along the wire, then 0.1 s of -2 F.
  it("changes loads, whose work is force times way", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e7, density = 1200, radius = 0.003, segments = 10, from = { 0, 0, 0 },
      to = { 0.3, 0, 0 } }
    local push = scene:force{ kind = "line", on = wire, force = { 0.01, 0, 0 } }
    local line = wire.beam.mass_per_length
    t.fine(scene:run{ duration = 0.1, dt = 1e-3 })
    t.share(0.1 * 0.01 / line, wire:velocity(0.1)[1], 1e-6, "pushed")
    push:set{ force = { -0.02, 0, 0 } }
    local run = scene:run{ duration = 0.1, dt = 1e-3 }
    t.fine(run)
    t.share(-0.1 * 0.01 / line, wire:velocity(0.1)[1], 1e-6, "pulled")
    assert.is_true(run:ledger().gained < 1e-6 * run:ledger().play)
  end)

  it("keeps a force's place on the wire", function()
    local scene, wire = flying()
    local point = scene:force{ kind = "point", on = wire, s = 0.12, force = { 0, 0, 1 } }
    point:set{ force = { 0, 0, 2 } }
    t.near(0.12, point:get().s, 1e-12, "s")
    assert.same({ 0, 0, 2 }, point:get().force)
  end)

  it("refuses what cannot be set, naming it", function()
    local scene, wire, damping = flying()
    local point = scene:force{ kind = "point", on = wire, s = 0.12, force = { 0, 0, 1 } }
    local own = scene:force{ kind = function() end, on = wire }
    local strain = scene:force{ kind = "plastic", on = wire, yield_moment = 1, hardening = 0.1 }
    local gone = scene:force{ kind = "drag", on = wire, linear = 1 }
    gone:release()
    for text, call in pairs{
      ["force point: set: s is given when the object is made; the parameters to set are: force"] =
        function() point:set{ s = 0.2 } end,
      ["force damping: set: there is no parameter 'mas'; did you mean 'mass'?"] =
        function() damping:set{ mas = 2 } end,
      ["mass = -1"] = function() damping:set{ mass = -1 } end,
      ["nan s is not allowed"] = function() damping:set{ mass = 2, stiffness = 0 / 0 } end,
      ["yield_moment is given when the object is made; this object has nothing to set"] =
        function() strain:set{ yield_moment = 2 } end,
      ["force drag: it was released; make another one"] = function() gone:set{ linear = 2 } end,
      ["force damping: set takes one table of parameters"] = function() damping:set(7) end,
      ["it has no parameters to set"] = function() own:set{ x = 1 } end,
    } do
      local fine, message = pcall(call)
      assert.is_false(fine, text)
      assert.is_truthy(message:find(text, 1, true), message)
    end
    assert.equal(1, damping:get().mass)
  end)
end)
