-- SPDX-License-Identifier: GPL-3.0-or-later
-- Using a feed: wrong input, running out of wire, snapshots, releasing, changing the wire while it is fed.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local function make(feed, options)
  local scene = sw.scene {}
  local args = { EA = 1e5, EI = 3e-3, mass_per_length = 0.03, radius = 0.002, name = "w",
    from = { 0, 0, 0 }, to = { 0.4, 0, 0 }, segments = 20 }
  for k, v in pairs(options or {}) do args[k] = v end
  local wire = scene:wire(args)
  return scene, wire, scene:feed(wire, feed)
end

local function refused(words, f, ...)
  local ok, message = pcall(f, ...)
  assert.is_false(ok)
  assert.truthy(tostring(message):find(words, 1, true), ("'%s' is not in: %s"):format(words, message))
end

describe("a feed", function()
  it("refuses arguments that make no sense, and changes nothing", function()
    local scene, wire, feed = make { speed = 0.1 }
    refused("speed = ", scene.feed, scene, wire, { s = 0.4, speed = 0 / 0 })
    refused("speed = inf m/s", scene.feed, scene, wire, { s = 0.4, speed = 1 / 0 })
    refused("did you mean 'speed'", scene.feed, scene, wire, { s = 0.4, sped = 1 })
    refused("speed or force", scene.feed, scene, wire, { s = 0.4, speed = 0.1, force = 1 })
    refused("force_limit = -1 N", scene.feed, scene, wire, { s = 0.4, force_limit = -1 })
    refused("already held by 'feed1'", scene.feed, scene, wire, { s = 0 })
    refused("already held by 'feed1'", scene.clamp, scene, wire, { s = 0 })
    refused("is not on wire 'w'", scene.feed, scene, wire, { s = 0.5 })
    refused("feed:speed = inf m/s", feed.speed, feed, 1 / 0)
    refused("feed:speed = ", feed.speed, feed, 0 / 0)
    refused("number", feed.speed, feed, "fast")
    refused("number", feed.speed, feed, nil)
    refused("number", feed.push, feed, nil)
    refused("speed = 20000 m/s", feed.speed, feed, 20000)
    refused("force_limit = 0 N", feed.force_limit, feed, 0)
    refused("give speed", feed.feed, feed, { length = 1 })
    refused("length is required", feed.feed, feed, { speed = 1 })
    refused("did you mean 'length'", feed.feed, feed, { lenth = 1, speed = 1 })
    refused("length = -0.4 m is not allowed", feed.feed, feed, { length = -0.4, speed = 1 })
    refused("there is no law 'sudden'; known are: linear trapezoidal minimum-jerk spline", feed.feed, feed,
      { length = 0.1, speed = 1, law = "sudden" })
    refused("there is no law 'minimum-jrk'; did you mean 'minimum-jerk'?", feed.feed, feed,
      { length = 0.1, speed = 1, law = "minimum-jrk" })
    assert.are.equal(0.1, feed:speed())
    assert.are.equal(0, feed:fed())
    assert.are.equal(1, #sw.core.data(scene).holds)
    local other = scene:clamp(wire, { s = 0.3 })
    for _, name in ipairs { "fed", "speed", "drive_force", "force_limit" } do
      refused("clamp 'clamp2' has no " .. name .. "; holds of scene:feed have it", other[name], other)
    end
    assert.are.same({}, other:read())
    assert.are.same({ fed = feed:fed(), speed = feed:speed(), drive_force = feed:drive_force() }, feed:read())
    refused("has no speed; holds of scene:feed have it", other.speed, other, 1)
    refused("has no length; holds of scene:feed have it", other.feed, other, { length = 1, speed = 1 })
  end)

  it("is the only hold that p:feed accepts", function()
    local scene, wire, feed = make()
    local clamp = scene:clamp(wire, { s = 0.4 })
    scene:process(function(p)
      refused("expects what scene:feed returns", p.feed, p, wire, { length = 1, speed = 1 })
      refused("has no length; holds of scene:feed have it", p.feed, p, clamp, { length = 1, speed = 1 })
      refused("length = -9 m is not allowed", p.feed, p, feed, { length = -9, speed = 1 })
      p:feed(feed, { length = 0, speed = 1 })
    end)
    t.fine(scene:run())
    assert.are.equal(0, feed:fed())
  end)

  it("reports its state and takes changes", function()
    local scene, wire, feed = make { s = 0, name = "spool", force_limit = 3 }
    assert.are.equal(3, feed:force_limit())
    feed:force_limit(nil)
    assert.are.equal(nil, feed:force_limit())
    assert.are.equal(0, feed:speed())
    feed:speed(0.2)
    t.fine(scene:run { duration = 0.25, dt = 0.01 })
    t.near(0.05, feed:fed(), 1e-12)
    feed:speed(-0.1)
    t.fine(scene:run { duration = 0.25, dt = 0.01 })
    t.near(0.025, feed:fed(), 1e-12)
    t.near(0.425, wire.length, 1e-12)
    assert.are.equal("feed", feed.kind)
    assert.truthy(tostring(feed):find("feed 'spool': force on the wire", 1, true))
    feed:push(0.01)
    t.fine(scene:run { duration = 0.1, dt = 0.01 })
    t.near(0.01, feed:drive_force(), 1e-6)
    feed:speed(0) -- from push to speed
    local fed = feed:fed()
    t.fine(scene:run { duration = 0.1, dt = 0.01 })
    assert.are.equal(fed, feed:fed())
  end)

  it("stops the run in a valid state when no wire is left to draw in", function()
    for _, quasistatic in ipairs { false, true } do
      local scene, wire, feed = make { speed = -0.5 }
      refused("wire 'w' is drawn in up to its end", scene.run, scene,
        { duration = 5, dt = 0.01, quasistatic = quasistatic })
      t.below(0.07, wire.length, "length left")
      t.near(0.4 + feed:fed(), wire.length, 1e-12)
      t.near(0.4 - 0.5 * scene.time, wire.length, 1e-9)
      t.below(wire.length * 1.001, wire:position(wire.length)[1])
      feed:speed(0.1) -- and it goes on
      t.fine(scene:run { duration = 1, dt = 0.01, quasistatic = quasistatic })
      t.near(0.4 + feed:fed(), wire.length, 1e-12)
    end
    local scene, wire, feed = make { speed = -0.5 }
    local clamp = scene:clamp(wire, { s = 0.3, name = "stop" })
    clamp:follow { points = { { 0, 0, 0 }, { -0.5, 0, 0 } }, duration = 1, relative = true,
      law = "linear" }
    refused("drawn in up to 'stop'", scene.run, scene, { duration = 5, dt = 0.01 })
    t.near(0.4 + feed:fed(), wire.length, 1e-12)
  end)

  it("with a force needs a run in motion", function()
    local scene = make { force = 1 }
    refused("needs motion", scene.run, scene, { duration = 1, quasistatic = true })
  end)

  it("does not follow a speed that is far too high, and reports it", function()
    local scene = make { speed = 1e4 }
    local run = scene:run { duration = 1, dt = 0.01, max_steps = 200 }
    assert.are.equal("boolean", type(run.ok))
    scene = make { speed = 1e4, name = "spool" }
    run = scene:run { duration = 1000, dt = 1000 }
    assert.is_false(run.ok)
    assert.matches("wire 'w' goes through feed 'spool' at 1e%+04 m/s, too fast for the steps",
      run.reason)
  end)

  it("goes on to the same bits from a snapshot", function()
    for _, options in ipairs { {}, { EI = { 3e-3, 4e-3 }, GJ = 2e-3, normal = { 0, 1, 0 } } } do
      for _, drive in ipairs { { speed = 0.13 }, { force = 0.02 }, { force_limit = 0.01, speed = 0.1 } } do
        local scene, wire, feed = make(drive, options)
        scene:obstacle { shape = "plane", at = { 0, 0, -0.1 }, friction = 0.3 }
        t.fine(scene:run { duration = 0.233, dt = 0.01 })
        local middle = scene:snapshot()
        local function go()
          t.fine(scene:run { duration = 0.3, dt = 0.01 })
          return { wire:positions(), feed:fed(), wire.length, feed:force(), feed:drive_force(),
            scene:energy() }
        end
        local first = go()
        scene:restore(middle)
        assert.are.same(first, go())
        feed:feed { length = 0.1, speed = 0.2 }
        t.fine(scene:run { duration = 0.1, dt = 0.01 })
        local moving = scene:snapshot()
        first = go()
        feed:release()
        scene:restore(moving)
        assert.are.same(first, go())
      end
    end
  end)

  it("lets go of the wire, which keeps its length", function()
    local scene, wire, feed = make { speed = 0.1 }
    t.fine(scene:run { duration = 1, dt = 0.01 })
    feed:release()
    refused("has been released", feed.fed, feed)
    refused("has been released", feed.speed, feed, 1)
    t.near(0.5, wire.length, 1e-12)
    local _, s = wire:positions()
    assert.are.equal(0, s[1])
    t.near(0.5, s[#s], 1e-12)
    local before = wire:velocity(0)[3]
    t.fine(scene:run { duration = 0.1, dt = 0.01 })
    assert.is_true(wire:velocity(0)[3] < before)
    local clamp = scene:clamp(wire, { s = 0.45 }) -- as the wire is now
    t.fine(scene:settle())
    t.share(0.03 * 9.81 * 0.5, clamp:force()[3], 1e-6, "weight")
    assert.truthy(pcall(wire.position, wire, 0.5))
    refused("must be in [0, 0.5] m", wire.position, wire, 0.51)
  end)

  it("goes on while holds and forces come and go", function()
    local scene, wire, feed = make { speed = 0.1 }
    t.fine(scene:run { duration = 0.33, dt = 0.01 })
    local gripper = scene:gripper { name = "g" }
    gripper:grasp(wire, { s = 0.3 })
    local force = scene:force { kind = "point", on = wire, s = 0.4, force = { 0, 0, 0.01 } }
    t.fine(scene:run { duration = 0.1, dt = 0.01 })
    gripper:release()
    force:release()
    t.fine(scene:run { duration = 0.5, dt = 0.01 })
    t.near(0.4 + 0.1 * scene.time, wire.length, 1e-9)
    t.near(0.1 * scene.time, feed:fed(), 1e-9)
  end)

  it("works at both ends at once", function()
    local scene, wire, feed = make { speed = 0.1 }
    local other = scene:feed(wire, { s = 0.4, speed = 0.1 })
    t.fine(scene:run { duration = 1, dt = 0.01 })
    t.fine(scene:settle())
    t.near(0.6, wire.length, 1e-12)
    t.share(feed:force()[3], other:force()[3], 2e-3, "shared weight")
    t.near(0, feed:force()[1] + other:force()[1], 1e-6, "no net force along")
  end)

  it("pays out plastic and viscous wires", function()
    local scene, wire, feed = make()
    scene:force { kind = "plastic", on = wire, yield_moment = 0.004, hardening = 1e-3 }
    scene:force { kind = "viscous_bend", on = wire, eta = 1e-4 }
    feed:feed { length = 0.2, duration = 1 }
    t.fine(scene:run { duration = 1.5, dt = 0.01 })
    t.near(0.6, wire.length, 1e-12)
    t.above(1e-5, scene:energy().dissipated, "dissipated")
  end)

  it("shows in the run's frames and series", function()
    local scene, wire = make { speed = 0.2, name = "spool" }
    local run = t.fine(scene:run { duration = 1, dt = 0.01 })
    local frames = run:frames()
    assert.is_true(#frames[#frames].wires[1] > #frames[1].wires[1])
    assert.are.equal(3 * (wire.segments + 1), #frames[#frames].wires[1])
    local names = {}
    for _, c in ipairs(run:series().columns) do names[c.name] = true end
    assert.is_true(names["spool.force"])
  end)
end)
