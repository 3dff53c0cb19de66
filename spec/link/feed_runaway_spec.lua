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

  it("is not told where the wire holds back, or where the drive is a brake", function()
    assert.is_nil((driven{ force = -4, duration = 0.1 }))
    assert.is_nil((driven{ limit = 4, duration = 0.1 }))
  end)
end)
