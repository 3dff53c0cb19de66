-- SPDX-License-Identifier: GPL-3.0-or-later
-- Grippers with pads: verbs in processes, events, refusals, snapshots.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r = 0.003

local function new_scene(args)
  local scene = sw.scene{}
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 8 }
  local p = { E = 2e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r }, to = { 0.2, 0, r } }
  for k, v in pairs(args or {}) do p[k] = v end
  return scene, scene:wire(p)
end

local pads = { width = 0.02, friction = 0.6, opening = 3 * r }

local function run(scene, body, dt)
  scene:process(body)
  local result = scene:run{ dt = dt or 0.01 }
  assert(result.ok, result.reason)
  return result
end

describe("a gripper with pads", function()
  it("makes no pads where the wire is a line, beside its mesh region", function()
    local scene, wire = new_scene()
    wire:remodel{ model = "radial", region = { 0.08, 0.12 } }
    local g = scene:gripper{ name = "hand", pads = pads }
    local before = table.concat(require("softworld.core").items(scene), " ")
    assert.error_matches(function() g:grasp(wire, { s = 0.19, approach = "plates", force = 1 }) end, "line")
    assert.are.equal(before, table.concat(require("softworld.core").items(scene), " "))
  end)

  it("makes no pads in a scene that diverged", function()
    local scene, wire = new_scene()
    local g = scene:gripper{ name = "hand", pads = pads, at = { 0.1, 0, r } }
    local clamp = scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 0.2 })
    clamp:pose{ -0.5, 0, -0.5 } -- far more than the wire can follow
    assert.is_false(scene:run{ duration = 0.05 }.ok)
    local before = table.concat(require("softworld.core").items(scene), " ")
    assert.error_matches(function() g:grasp(wire, { approach = "plates", force = 1 }) end, "diverged")
    assert.are.equal(before, table.concat(require("softworld.core").items(scene), " "))
  end)

  it("refuses invalid arguments and calls, naming them", function()
    local scene, wire = new_scene()
    local function refused(text, f)
      local ok, message = pcall(f)
      assert.is_false(ok)
      assert.is_truthy(message:find(text, 1, true), message)
    end
    for text, args in pairs{
      ["pads: there is no parameter 'widht'; did you mean 'width'?"] = { pads = { widht = 0.02 } },
      ["pads.shape = 'vee' is not one of: flat mesh round v"] = { pads = { shape = "vee" } },
      ["pads.friction = -1 is not allowed; it must be at least 0"] = { pads = { friction = -1 } },
      ["pads.height = 0 m is not allowed; it must be above 0 m"] = { pads = { height = 0 } },
      ["pads.fingers = 9 is not allowed; it must be an integer from 1 to 6"] = { pads = { fingers = 9 } },
      ["pads: file goes with shape = 'mesh'"] = { pads = { file = "finger.stl" } },
      ["pads: mesh file 'nothere.stl': No such file"] = { pads = { shape = "mesh", file = "nothere.stl" } },
      ["arm.length is required, above 0 m"] = { arm = { radius = 0.01 } },
      ["slip_tolerance = 0 m is not allowed; it must be above 0 m"] = { slip_tolerance = 0 },
      ["on_crash = 'halt' is not one of: record stop warn"] = { on_crash = "halt" },
    } do
      refused(text, function() scene:gripper(args) end)
    end
    local g = scene:gripper{ name = "hand", pads = pads }
    for text, args in pairs{
      ["s = 0.3 m is not allowed; it must be at least 0 m and at most 0.2 m"] =
        { s = 0.3, approach = "plates", force = 1 },
      ["approach = 'plate' is not one of: auto imposed mixed plates; did you mean 'plates'?"] =
        { approach = "plate" },
      ["give force [N], distance [m] or speed [m/s]"] = { s = 0.1, approach = "plates" },
      ["force goes with approach = 'plates' or 'mixed'"] = { s = 0.1, force = 1 },
      ["region goes with approach = 'mixed'"] = { s = 0.1, approach = "plates", force = 1, region = 0.1 },
      ["a mixed grasp takes time; call it in a process"] = { s = 0.1, approach = "mixed", force = 1 },
      ["force = -1 N is not allowed; it must be above 0 N"] = { s = 0.1, approach = "plates", force = -1 },
      ["on_slip = 'halt' is not one of: record stop warn"] =
        { s = 0.1, approach = "plates", force = 1, on_slip = "halt" },
    } do
      refused(text, function() g:grasp(wire, args) end)
      assert.is_nil(g.wire)
    end
    refused("has no pads yet", function() g:state() end)
    refused("has no pads yet", function() g:pressure_map() end)
    refused("has no pads yet", function() g:open_jaws() end)
    refused("press works inside a process only", function()
      scene:gripper{ at = { 0, 0, 0.1 } }:press{ force = 1 }
    end)
    refused("less than the wire's diameter", function()
      scene:gripper{ pads = { opening = r } }:grasp(wire, { s = 0.1, approach = "plates", force = 1 })
    end)
    refused("only a mixed grasp can be frozen", function() g:freeze() end)
  end)

  it("refuses wires of other scenes", function()
    local scene = new_scene()
    local g = scene:gripper{ name = "hand", at = { 0.1, 0.05, 0.05 }, rotation = { 1, 0, 0, 0 }, pads = pads }
    local _, wire = new_scene()
    assert.error_matches(function()
      g:grasp(wire, { approach = "plates", force = 1 })
    end, "belongs to another scene")
  end)

  it("reports that it closed on nothing", function()
    local scene, wire = new_scene()
    local g = scene:gripper{ name = "hand", at = { 0.1, 0.05, 0.05 }, rotation = { 1, 0, 0, 0 }, pads = pads }
    local why
    run(scene, function()
      local ok, message = pcall(g.grasp, g, wire, { approach = "plates", force = 1 })
      assert.is_false(ok)
      why = message
    end)
    assert.is_truthy(why:find("closed on nothing: wire 'wire1' is 6", 1, true), why)
    assert.equal("missed", g.events[1].kind)
    assert.is_nil(g.wire)
    run(scene, function() -- and can be used again
      g:open_jaws()
      g:grasp(wire, { s = 0.1, approach = "plates", force = 1 })
    end)
    assert.equal(wire, g.wire)
  end)

  it("reports that it presses on another wire, instead of its own or besides it", function()
    -- wire a is at height z, wire b on the axis between the pads
    local function two(z, body)
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wires = {}
      for i, height in ipairs{ z, 0 } do
        wires[i] = scene:wire{ name = i == 1 and "a" or "b", E = 2e7, density = 1200, radius = r,
          from = { 0, 0, height }, to = { 0.2, 0, height }, segments = 20 }
        scene:clamp(wires[i], { s = 0 })
      end
      scene:force{ kind = "damping", mass = 20, stiffness = 1e-3 }
      local g = scene:gripper{ name = "hand", at = { 0.1, 0, 0 },
        pads = { width = 0.02, height = 0.04, below = 0.02, friction = 1, opening = 0.01 } }
      return scene, g, body(scene, g, wires[1])
    end
    local orders = { approach = "plates", force = 5 }
    local scene, g, why = two(0.1, function(world, hand, wire)
      local said
      run(world, function() said = select(2, pcall(hand.grasp, hand, wire, orders)) end)
      return said
    end)
    assert.matches("^[^ ]*gripper_use_spec%.lua:%d+: gripper 'hand' presses on wire 'b' %([45][%d.]* N%), "
      .. "not on wire 'a', the one to grasp$", why)
    assert.is_nil(g.wire)
    assert.equal("grasp", scene:events()[1].kind)
    -- outside a process no call waits; the events of the run report it
    local told = {}
    for _, z in ipairs{ 0.1, 0.0075, 0 } do
      scene = two(z, function(world, hand, wire)
        hand:grasp(wire, orders)
        if z == 0 then world:restore(world:snapshot()) end
        t.fine(world:run{ duration = 1, dt = 0.01 })
        return hand
      end)
      told[#told + 1] = scene:events()[1]
    end
    assert.matches("presses on wire 'b' %(5 N%), not on wire 'a'", told[1].text)
    assert.matches("presses on wire 'b' %(2%.%d+ N%) besides wire 'a'", told[2].text)
    t.near(2.5, told[2].value, 0.2, "force on it")
    assert.matches("besides wire 'a'", told[3].text)
    local clean, wire = new_scene()
    local alone = clean:gripper{ name = "hand", pads = pads }
    run(clean, function() alone:grasp(wire, { s = 0.1, approach = "plates", force = 1 }) end)
    assert.same({}, clean:events())
  end)

  it("makes nothing when a move or a press has invalid arguments", function()
    for _, given in ipairs{ pads, { width = 0.02 } } do
      local scene = new_scene()
      local g = scene:gripper{ name = "hand", at = { 0, 0, 1 }, pads = given }
      local before = table.concat(scene:names(), " ")
      for _, act in ipairs{ function() g:move{ to = { 0, 0 }, speed = 1 } end,
        function() g:move{ to = { 0, 0, 0 }, speed = -1 } end, function() g:move{ path = {} } end,
        function() g:move{ by = { 0, 0, 1 }, speed = 1, on_slip = "never" } end, function() g:move(g) end,
        function() g:press{ force = 1 } end, function() g:press{ froce = 1 } end } do
        assert.has_error(act)
        assert.equal(before, table.concat(scene:names(), " "))
        assert.is_nil(g.tool or g.carrier or g.on_slip)
      end
      g:move{ to = { 0, 0, 0.9 }, speed = 1 }
      t.fine(scene:run{ duration = 0.3 })
      t.near(0.9, g:position()[3], 1e-9, "height")
    end
  end)

  it("stops before it crushes the wire", function()
    local mesh = { E = 2e6, model = "radial", body = "solid", to = { 0.1, 0, r } }
    for _, model in ipairs{ { E = 2e6 }, mesh } do
      local scene, wire = new_scene(model)
      local g = scene:gripper{ name = "hand", pads = pads }
      local why
      run(scene, function()
        local _, message = pcall(g.grasp, g, wire, { s = 0.05, approach = "plates", force = 1e5 })
        why = message
      end, 0.005)
      assert.is_truthy(why:find("crushes the wire", 1, true), why)
      assert.equal("crushed", g.events[1].kind)
      assert.is_true(scene:run{ duration = 0.02, dt = 0.005 }.ok)
    end
  end)

  it("crushes the wire when an opening demands it, and reports it", function()
    local scene, wire = new_scene{ E = 2e6 }
    local g = scene:gripper{ name = "hand", pads = pads }
    run(scene, function()
      g:grasp(wire, { s = 0.05, approach = "plates", distance = 1.2 * r })
      assert.equal(0, #g.events)
      g:close_jaws{ distance = 0.2 * r }
    end, 0.005)
    assert.equal("crushed", g.events[1].kind)
    assert.is_true(math.abs(g.events[1].opening - 0.2 * r) < 1e-9)
    assert.is_true(scene:run{ duration = 0.02, dt = 0.005 }.ok)
  end)

  it("reports slip once, calls a function, and stops the run where asked to", function()
    local scene, wire = new_scene()
    local g = scene:gripper{ name = "hand", pads = { width = 0.02, friction = 0.1, opening = 3 * r } }
    local calls = {}
    scene:process(function(p)
      g:grasp(wire, { s = 0.1, approach = "plates", force = 0.1, on_slip = function(who, event)
        calls[#calls + 1] = { who, event }
      end })
      g:move{ by = { 0, 0, 0.05 }, duration = 0.2 }
      p:wait(0.2)
    end)
    assert(scene:run{ dt = 0.005 }.ok)
    assert.equal(2, #calls) -- slip, then loss
    assert.equal("lost", calls[2][2].kind)
    assert.equal(g, calls[1][1])
    assert.equal("slip", calls[1][2].kind)
    t.near(0.1, calls[1][2].s, 0.01, "place")
    -- stop: the run ends there
    scene, wire = new_scene()
    g = scene:gripper{ name = "hand", pads = { width = 0.02, friction = 0.1, opening = 3 * r } }
    scene:process(function(p)
      g:grasp(wire, { s = 0.1, approach = "plates", force = 0.1 })
      g:move{ by = { 0, 0, 0.05 }, duration = 0.2, on_slip = "stop" }
      p:wait(10)
    end)
    local result = scene:run{ dt = 0.005 }
    assert.is_true(result.ok)
    assert.is_truthy(result.reason:find("gripper 'hand': the wire slips", 1, true), result.reason)
    t.near(g.events[1].time, result.time, 1e-9, "time of the slip")
  end)

  it("reports its parts that run into obstacles", function()
    local scene, wire = new_scene()
    scene:obstacle{ name = "wall", shape = "box", size = { 0.01, 0.2, 0.1 }, at = { 0.3, 0, 0.05 } }
    local g = scene:gripper{ name = "hand", pads = pads, arm = { radius = 0.01, length = 0.1 } }
    run(scene, function()
      g:grasp(wire, { s = 0.19, approach = "plates", force = 2 })
      g:move{ by = { 0, 0, 0.02 }, speed = 0.2 }
      g:move{ by = { 0.2, 0, 0 }, speed = 0.2 }
      g:move{ by = { 0, 0, -0.03 }, speed = 0.2 }
    end)
    local seen = {}
    for _, e in ipairs(g.events) do
      if e.kind == "crash" then seen[#seen + 1] = e.part .. " " .. e.obstacle end
    end
    assert.equal("hand.arm wall", seen[1])
    assert.is_truthy(seen[2]:find "^hand.finger[12] table$")
  end)

  it("refuses a trajectory that begins away from where it is", function()
    local scene, wire = new_scene()
    local g = scene:gripper{ name = "hand", pads = pads }
    run(scene, function()
      g:grasp(wire, { s = 0.1, approach = "plates", force = 2 })
      local ok, message = pcall(g.move, g, { points = { { t = 0, 0, 0, 0.5 }, { t = 1, 0, 0, 0.6 } } })
      assert.is_false(ok)
      assert.is_truthy(message:find("away from the present pose", 1, true), message)
    end)
  end)

  it("moves with open jaws, presses, and hands over", function()
    local scene, wire = new_scene()
    local left = scene:gripper{ name = "left", pads = pads }
    local right = scene:gripper{ name = "right", at = { 0.15, 0, 0.1 }, rotation = { 1, 0, 0, 0 },
      pads = pads }
    local weight = wire.beam.mass_per_length * 9.81 * wire.length
    run(scene, function(p)
      right:move_to({ 0.15, 0, 0.12 }, { speed = 0.5 })
      t.near(0.12, right:position()[3], 1e-9, "open jaws move")
      left:grasp(wire, { s = 0.05, approach = "plates", force = 3 })
      left:move{ by = { 0, 0, 0.15 }, duration = 0.5 }
      p:wait(1)
      t.share(weight, left:force()[3], 0.15, "weight") -- the wire's end may lie on the table
      left:handover(right, { s = 0.15, approach = "plates", force = 3 })
      assert.is_nil(left.wire)
      p:wait(0.5)
      t.above(0.5 * weight, right:force()[3], "handed over")
      local force, way, done = right:press{ force = 0.5, speed = 0.1, distance = 0.4 }
      assert.is_true(done)
      t.above(0.5, force, "pressed")
      t.above(0.01, way, "way down")
    end, 0.005)
    -- It runs into the table while it presses. The push turns the wire, with 0.96 of the moment 2 mu F w/4
    -- that the pads resist; the middle does not slip by the tolerance.
    for _, e in ipairs(right.events) do
      if e.kind ~= "crash" then
        assert.equal("slip", e.kind)
        local middle = t.norm(right:state().slipped) -- the rest is by turning: at most at the pads' edges
        t.above(e.distance - middle, e.turned * pads.width / 2, "way of the pads' edges by turning [m]")
      end
    end
    t.above(0.9, right:state().margin, "margin")
    t.below(right.slip_tolerance, t.norm(right:state().slipped), "slip of the middle [m]")
  end)

  it("waits for conditions given as tables", function()
    local scene, wire = new_scene()
    local wall = scene:obstacle{ shape = "box", size = { 0.1, 0.1, 0.01 }, at = { 0.1, 0, 0.105 } }
    local g = scene:gripper{ name = "hand", pads = pads }
    local times = {}
    scene:process(function(p)
      p:wait_until({ force = 0.02, on = g })
      times.force = scene.time
      p:wait_until({ distance = 0.05, between = { { wire, s = 0.1 }, { 0.1, 0, 0.1 } } })
      times.distance = scene.time
      times.contact = p:wait_until({ contact = wall }, { timeout = 0.01 })
      times.slip = p:wait_until({ slip = 0.01, on = g }, { timeout = 0.01 })
      for text, condition in pairs{
        ["there is no parameter 'forse'; did you mean 'force'?"] = { forse = 1 },
        ["force needs on"] = { force = 1 }, ["no condition; give force, slip, contact or distance"] = {},
        ["contact needs an obstacle, got number"] = { contact = 1 },
        ["distance needs between"] = { distance = 1 },
      } do
        local ok, message = pcall(p.wait_until, p, condition)
        assert.is_false(ok)
        assert.is_truthy(message:find(text, 1, true), message)
      end
    end)
    run(scene, function()
      g:grasp(wire, { s = 0.1, approach = "plates", force = 3 })
      g:move{ by = { 0, 0, 0.08 }, duration = 1 }
    end)
    t.above(0.05, times.force, "waited for force")
    t.above(times.force, times.distance, "waited for distance")
    assert.is_false(times.slip)
  end)

  it("goes on from a snapshot bit for bit", function()
    local scene, wire = new_scene{ model = "radial", body = "solid", to = { 0.1, 0, r } }
    local g = scene:gripper{ name = "hand", pads = pads }
    run(scene, function() g:grasp(wire, { s = 0.05, approach = "plates", force = 3 }) end)
    local snapshot = scene:snapshot()
    local function on()
      run(scene, function()
        g:move{ by = { 0, 0, 0.05 }, duration = 0.3 }
        g:release()
      end)
      local x = wire:positions()
      return x, g:series()
    end
    local x, series = on()
    scene:restore(snapshot)
    assert.equal(wire, g.wire)
    local y, again = on()
    assert.are.same(x, y)
    assert.are.same(series.force, again.force)
    assert.are.same(series.squeeze, again.squeeze)
  end)
end)

describe("a gripper that two processes use", function()
  it("reports that its wire was released while its jaws closed", function()
    for _, time in ipairs{ 0.001, 0.05, 0.3 } do
      local scene = sw.scene{}
      local wire = scene:wire{ E = 1e7, density = 1000, radius = 0.003, segments = 6, from = { 0, 0, 0.1 },
        to = { 0.3, 0, 0.1 } }
      scene:clamp(wire, { s = 0 })
      local hand = scene:gripper{ name = "hand" }
      scene:process(function(p)
        p:wait(time)
        pcall(hand.release, hand, { speed = 0.1 })
      end)
      scene:process(function() hand:grasp(wire, { s = 0.1, approach = "plates", distance = 0.05 }) end)
      local fine, message = pcall(scene.run, scene, { dt = 0.01, duration = 1 })
      assert.is_false(fine)
      local text = "gripper 'hand': something let go of wire 'wire1' while its jaws moved to grasp it"
      assert.is_truthy(message:find(text, 1, true), message)
    end
  end)
end)
