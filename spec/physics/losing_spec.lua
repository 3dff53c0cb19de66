-- SPDX-License-Identifier: GPL-3.0-or-later
-- The time at which pads lose a wire that is drawn out of them.
local sw = require "softworld"
local mm = sw.units.mm

--- Returns the time of the event, and of the first step after the grasp in which the pads press on nothing
-- [s].
local function lost(dt, reaction, poses)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.3 }, to = { 0.5, 0, 0.3 } }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.001 }
  scene:clamp(wire, { s = 0 })
  local hand = scene:gripper{ name = "hand", pads = { width = mm(20), friction = 0.4, opening = mm(6) } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.48, approach = "plates", force = 5, on_slip = reaction })
    hand:move{ by = { 0.1, 0, 0 }, speed = 0.1 }
    p:wait(0.3)
  end)
  local run = scene:run{ dt = dt, quasistatic = poses }
  assert.is_true(run.ok)
  local event = hand.events[#hand.events]
  assert.equal("lost", event.kind)
  local all = {} -- of the run: once, with the same time and place
  for _, e in ipairs(run.events) do
    if e.kind == "lost" then all[#all + 1] = { e.time, e.s, e.object, e.count } end
  end
  assert.same({ { event.time, event.s, "hand", 1 } }, all)
  local series, pressed = run:series(), false
  for _, c in ipairs(series.columns) do
    for i, squeeze in ipairs(c.name == "hand.squeeze" and c.values or {}) do
      if pressed and squeeze == 0 then return event.time, series.time[i] end
      pressed = squeeze > 0
    end
  end
end

describe("pads that lose a wire", function()
  it("report the time of the step in which they do", function()
    for _, dt in ipairs{ 0.03, 0.01, 0.003 } do
      local told, seen = lost(dt)
      assert.equal(seen, told)
      assert.near(0.88, told, 0.01 + 1.5 * dt) -- 0.881 with steps of 1 ms
    end
  end)

  it("report it in poses too", function()
    local told, seen = lost(0.03, nil, true)
    assert.equal(seen, told)
  end)

  it("call the function for slips at once", function()
    local times = {}
    local told, seen = lost(0.01, function(hand, event)
      if event.kind == "lost" then times[#times + 1] = { event.time, hand:state().squeeze } end
    end)
    assert.equal(seen, told)
    assert.same({ { seen, 0 } }, times)
  end)
end)
