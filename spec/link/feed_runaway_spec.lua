-- SPDX-License-Identifier: GPL-3.0-or-later
-- A feed whose force nothing holds back drives its wire faster than any machine: the run says so.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Runs a short cable between a clamp and a feed at its end; returns the event `runaway` and the feed's speed.
local function driven(order)
  local scene = sw.scene{}
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, -0.01 },
    segments = 40 }
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 0.002 }
  scene:clamp(wire, { s = 0 })
  local feed = scene:feed(wire, { s = wire.length, name = "brake", force = order.force })
  if order.limit then feed:force_limit(order.limit) end
  local run = t.fine(scene:run{ duration = order.duration, dt = 0.01 })
  local found
  for _, e in ipairs(run.events) do if e.kind == "runaway" then found = e end end
  return found, feed:speed()
end

describe("a feed whose force nothing holds back", function()
  -- 4 N push out a cable of 19 g/m: it buckles, and 40 ms later it leaves the guide at more than 10 m/s.
  it("is told once with its speed and force, and the word for a brake", function()
    local e, speed = driven{ force = 4, duration = 0.1 }
    assert.are.equal("brake", e.object)
    t.above(10, e.value, "speed [m/s]")
    t.near(speed, e.value, 1e-6, "speed at the run's end [m/s]")
    assert.truthy(e.text:find("^feed 'brake' pays out wire 'w' at %S+ m/s at t = %S+ s"), e.text)
    assert.truthy(e.text:find("force of 4 N", 1, true), e.text)
    assert.truthy(e.text:find(":force_limit(4)", 1, true), e.text)
  end)

  -- The wire grew to thousands of segments, each step slower, until "steps have collapsed".
  it("ends the run, with the same words, when it has made the wire ten times as long", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", cable = "FLRY-B 0.5", segments = 20, from = { 0, 0, 0 },
      to = { 0.2, 0, 0.001 } }
    local feed = scene:feed(wire, { s = 0, name = "brake", force = 4 })
    local run = scene:run{ duration = 0.5, dt = 0.005 }
    assert.is_false(run.ok)
    assert.truthy(run.reason:find("feed 'brake' pays out wire 'w' at ", 1, true), run.reason)
    assert.truthy(run.reason:find("nothing holds back its force of 4 N", 1, true), run.reason)
    t.below(3, wire.length, "length [m]")
    assert.is_true(feed.held)
  end)

  it("tells no weight of a blow where there is no gravity", function()
    local count = 0
    for _, from in ipairs{ 0.05, 0.1, 0.15 } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      scene:obstacle{ shape = "box", size = { 0.02, 0.4, 0.4 }, at = { 0.2, 0, 0 }, friction = 0.3 }
      local wire = scene:wire{ cable = "FLRY-B 0.5", segments = 20, from = { 0, 0, 0 }, to = { from, 0, 0 } }
      scene:feed(wire, { s = 0, force = 4 })
      for _, e in ipairs(scene:run{ duration = 0.05, dt = 0.01 }.events) do
        local unit = e.text:match "^a blow of %S+ times its wire's (%S+)"
        if unit then
          assert.are.equal("EI/length^2", unit)
          count = count + 1
        end
      end
    end
    t.above(0, count, "blows")
  end)

  it("lets no error bars be computed, and the error says what to do", function()
    local scene = sw.scene{}
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
    scene:feed(wire, { s = 0, name = "spool" })
    assert.error_matches(function()
      scene:run{ duration = 0.1, model = "auto", tolerance = { max_tension = 1 } }
    end, "wire 'w' is fed by 'spool': its segments cannot be changed, so there are no error bars and no "
      .. "model = 'auto'; choose the model, run with dt %(or a tolerance in m%), and compare with another "
      .. "number of segments")
  end)

  it("is not told where the wire holds back, or where the drive is a brake", function()
    assert.is_nil((driven{ force = -4, duration = 0.1 }))
    assert.is_nil((driven{ limit = 4, duration = 0.1 }))
  end)
end)
