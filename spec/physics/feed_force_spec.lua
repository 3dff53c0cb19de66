-- SPDX-License-Identifier: GPL-3.0-or-later
-- Feeds driven by a force, and feeds together with grippers.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local sleeves = require "spec.physics.sleeves"

local sleeve = sleeves.sleeve
local g, mass, EI = 9.81, 0.03, 3e-3
local w = mass * g

describe("a feed with a force", function()
  -- A fall against a brake B: x'' = g - B / (mass x). Its energy integral is exact.
  it("lets wire fall as the formula says", function()
    local start = 0.5
    local brake = 0.5 * w * start
    local function speed_at(x)
      return math.sqrt(2 * (g * (x - start) - brake / mass * math.log(x / start)))
    end
    local length, speed = start, 0 -- the same by Runge-Kutta
    local h = 1e-4
    local function slope(x) return g - brake / (mass * x) end
    for _ = 1, 4000 do
      local k1, k2 = slope(length), slope(length + 0.5 * h * speed)
      local k3 = slope(length + 0.5 * h * (speed + 0.5 * h * k1))
      local k4 = slope(length + h * (speed + 0.5 * h * k2))
      length, speed = length + h * speed + h * h / 6 * (k1 + k2 + k3),
        speed + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    end
    t.share(speed_at(length), speed, 1e-8, "the formulas")
    for _, dt in ipairs { 0.01, 0.0025 } do
      local scene = sw.scene {}
      local wire = scene:wire { EA = 1e5, EI = EI, mass_per_length = mass, radius = 0.002,
        from = { 0, 0, 0 }, to = { 0, 0, -start }, segments = 25 }
      local feed = scene:feed(wire, { force = -brake })
      t.fine(scene:settle())
      t.fine(scene:run { duration = 0.4, dt = dt })
      t.share(length, wire.length, 0.5 * dt, "length")
      t.share(speed_at(wire.length), feed:speed(), 0.15 * dt + 1e-4, "speed")
      t.share(-brake, feed:drive_force(), 1e-6, "force")
      t.share(-feed:speed(), wire:velocity(wire.length)[3], 1e-4, "the end's speed")
    end
  end)

  it("with a limit holds, slips at exactly that force, and holds again", function()
    local scene = sw.scene {}
    local wire = scene:wire { EA = 1e5, EI = EI, mass_per_length = mass, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0, 0, -0.5 }, segments = 25 }
    local feed = scene:feed(wire, { force_limit = 0.2 })
    local clamp = scene:clamp(wire, { s = 0.5 })
    t.fine(scene:settle())
    t.share(-w * 0.25, feed:drive_force(), 1e-6, "half of the weight")
    clamp:follow { points = { { 0, 0, 0 }, { 0, 0, -0.1 } }, duration = 1, relative = true }
    for _ = 1, 95 do
      t.fine(scene:run { duration = 0.01, dt = 0.01 })
      t.below(0.2 * (1 + 1e-6), math.abs(feed:drive_force()), "force")
      if scene.time > 0.05 then t.share(-0.2, feed:drive_force(), 1e-6, "force") end
    end
    t.fine(scene:run { duration = 0.3, dt = 0.01 })
    t.near(0.1, feed:fed(), 1e-5, "fed") -- the wire stretches by less
    t.near(0, feed:speed(), 1e-9, "speed")
    t.below(0.2 * (1 + 1e-6), math.abs(feed:drive_force()), "force at rest")
  end)
end)

-- A gripper draws a cable through a slack arc off a drive that pays out at another speed.
local function arc_drawn(limit, stiffness, dt)
  local scene, long, way, took = sw.scene {}, 0.176, 0.25, 1.47
  local wire = scene:wire { cable = "H07V-K 2.5", segments = 30, from = { 0, 0, 0 }, to = { long, 0, 0 } }
  scene:force { kind = "damping", mass = 2, stiffness = stiffness }
  local feed = scene:feed(wire, { force_limit = limit })
  local hand = scene:gripper {}
  scene:process(function(p)
    hand:grasp(wire, { s = long - 0.02 })
    p:wait(0.05)
    feed:feed { length = 1.05 * way, duration = took }
    hand:move { by = { 0.977 * way, 0.07 * way, -0.2 * way }, duration = took }
    p:wait(0.2)
  end)
  t.fine(scene:run { dt = dt })
  return feed:over(0.1, scene.time), wire
end

describe("a drive that slips at its limit", function()
  -- The drive bears at most its limit. The guide's walls bear EI/(2 R^2) along a wire that leaves it bent,
  -- and half of the weight across: together within 5 %. Regression: the slipping speed of cables with
  -- dashpots swung about the right one and grew by 1.2 times from step to step. With 1 ms of stiffness a
  -- single step had 0.85 to 1 N (limit 0.28 N), with 2 ms 2.4 to 3.3 N; means over 10 ms were 10 and 25 %
  -- too large, the mean force 16 %, without an event.
  it("has no larger force within its steps, whatever the damping", function()
    local limit = 0.28
    for _, stiffness in ipairs { 0, 1e-3, 2e-3 } do
      for _, dt in ipairs { 0.005, 0.002, 0.001 } do
        local loads, wire = arc_drawn(limit, stiffness, dt)
        local along = limit + wire.beam.EI / (2 * wire:min_bend_radius() ^ 2)
        t.below(1.05 * along, loads.raw_peak_force, ("force with %g s at %g s"):format(stiffness, dt))
        t.below(1.02 * along, loads.peak_force, ("mean over 10 ms with %g s at %g s"):format(stiffness, dt))
      end
    end
  end)
end)

-- A gripper with pads draws a short stiff cable over a roller off a drive that slips at 2.2 N.
local function stiff_drawn(dt)
  local scene, long, way = sw.scene {}, 0.209, 0.14
  local wire = scene:wire { cable = "FLRY-B 6", segments = 43, from = { 0, 0, 0 }, to = { long, 0, 0 } }
  scene:force { kind = "damping", mass = 2, stiffness = 1e-3 }
  scene:obstacle { shape = "cylinder", radius = 0.017, length = 0.1, friction = 0.3,
    at = { 0.5 * long, 0, -0.017 - wire.radius - 1e-4 },
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  local feed = scene:feed(wire, { name = "drive", force_limit = 2.2 })
  local hand = scene:gripper { at = { long - 0.02, 0, 0 }, rotation = { 1, 0, 0, 0 },
    pads = { width = 0.012, opening = 4 * wire.radius, friction = 0.7 } }
  scene:process(function(p)
    hand:grasp(wire, { s = long - 0.02, approach = "plates", force = 10 })
    p:wait(0.05)
    feed:feed { length = 1.05 * way, duration = 1 }
    hand:move { by = { 0.972 * way, 0.2 * way, 0.12 * way }, duration = 1 }
    p:wait(0.2)
  end)
  local run = t.fine(scene:run { dt = dt })
  local told
  for _, e in ipairs(run.events) do told = told or e.kind == "coarse" and e.object == "drive" and e.value end
  return hand.peak_force, told
end

describe("a drive that slips in long steps", function()
  -- Regression: the force was the limit at the ends of steps only. The gripper bore 2.85 N at 20 ms and
  -- 2.5 N at 10 ms, without an event at 10 ms; 2.20 N in steps of 0.5 ms. 8 %: a tenth is told.
  it("tells that its mean force is larger", function()
    for _, dt in ipairs { 0.02, 0.01 } do
      local peak, told = stiff_drawn(dt)
      t.above(1.08 * 2.2, peak, "peak of the gripper's force")
      t.above(0.1 * 2.2, told or 0, ("the event's excess at %g s"):format(dt))
    end
    local peak, told = stiff_drawn(5e-4)
    t.below(1.03 * 2.2, peak, "peak in fine steps")
    assert.is_nil(told)
  end)
end)

describe("feeding and handling", function()
  it("lays wire onto a table", function()
    local scene = sw.scene {}
    local table_ = scene:obstacle { shape = "plane", friction = 0.3 }
    local wire = scene:wire { EA = 2e4, EI = EI, mass_per_length = mass, radius = 0.002,
      from = { 0, 0, 0.15 }, to = { 0.1, 0, 0.15 }, segments = 10 }
    local feed = scene:feed(wire)
    scene:process(function(p)
      p:feed(feed, { length = 0.6, speed = 0.3 })
      p:wait(1)
    end)
    t.fine(scene:run { dt = 0.005 })
    t.fine(scene:settle())
    t.near(0.7, wire.length, 1e-12, "length")
    t.share(w * 0.7, feed:force()[3] - table_:force()[3], 0.01, "weight") -- borne by both
    t.below(2e-5, (scene:penetration()), "penetration")
    t.near(0.002, wire:position(wire.length)[3], 1e-4, "end on the table")
  end)

  -- Two movers: the gripper takes along what the feed pays out, and the wire between keeps its kind of
  -- shape.
  it("pays out what a gripper pulls away", function()
    local scene, wire, feed = sleeve(0.5, 25)
    local gripper = scene:gripper { name = "puller" }
    gripper:grasp(wire, { s = 0.49 })
    t.fine(scene:settle())
    local sag = wire:position(0.24)[3]
    scene:process(function()
      feed:feed { length = 0.3, duration = 1 }
      gripper:move { by = { 0.3, 0, 0 }, duration = 1 }
    end)
    t.fine(scene:run { duration = 1, dt = 0.01 })
    t.fine(scene:settle())
    t.near(0.8, wire.length, 1e-12, "length")
    t.share(w * 0.8, feed:force()[3] + gripper:force()[3], 1e-6, "weight")
    -- the gripper holds the same piece of wire, now further from the start
    t.below(1e-5, t.distance({ 0.79, 0, 0 }, wire:position(0.79)), "tool centre off by")
    assert.is_true(wire:position(0.39)[3] < sag) -- longer spans sag more
  end)

  it("keeps a force at its place on the wire", function()
    local scene, wire, feed = sleeve(0.4, 20, { gravity = { 0, 0, 0 } })
    scene:force { kind = "point", on = wire, s = 0.2, force = { 0, 0, -0.01 } }
    feed:feed { length = 0.1, duration = 1 }
    t.fine(scene:run { duration = 1, dt = 0.05, quasistatic = true })
    -- the place that was at 0.2 m is then 0.3 m from the guide
    t.share(0.01 * wire:position(0.3)[1], feed:moment()[2] * -1, 1e-4, "moment")
    t.near(0, wire:curvature(0.4), 1e-9, "beyond it")
  end)
end)
