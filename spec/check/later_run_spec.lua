-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of a second run: its peaks are those of its own time.
local sw = require "softworld"

describe("run:check of a second run", function()
  -- A slip ends the first run, at the time at which the second one starts.
  it("does not count a slip of the first one", function()
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.0015 }, segments = 30,
      to = { 0.3, 0, 0.0015 } }
    scene:clamp(wire, { s = 0 })
    local hand = scene:gripper{ name = "hand", at = { 0.28, 0, 0.0015 }, slip_tolerance = 0.0005,
      pads = { width = 0.02, friction = 0.3, opening = 0.006 } }
    hand.on_slip = "stop"
    scene:process(function()
      hand:grasp(wire, { s = 0.28, approach = "plates", force = 1 })
      hand:move{ by = { 0.01, 0, 0 }, duration = 0.2 }
    end)
    local first = scene:run{ dt = 0.005 }
    assert.same({ "slip", first.time }, { hand.events[1].kind, hand.events[1].time })
    hand:open_jaws{ distance = 0.006 }
    local row = scene:run{ dt = 0.005, duration = 0.3 }:check{}:row "events"
    assert.same({ 0, "PASS" }, { row.value, row.verdict })
  end)

  -- The wire is removed between the runs, at the time at which the second one starts.
  it("does not miss a wire that was removed before it", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wires = {}
    for k, name in ipairs{ "a", "b" } do
      wires[k] = scene:wire{ name = name, cable = "GXL 1.5", from = { 0, k, 0 }, to = { 0.2, k, 0 } }
    end
    scene:run{ duration = 0.02, dt = 0.01 }
    scene:remove(wires[1])
    local check = scene:run{ duration = 0.02, dt = 0.01 }:check{}
    assert.equal("PASS", check.verdict)
    assert.has_error(function() check:row "a.removed" end)
  end)

  -- A gripper draws a straight wire by 1 mm of 0.2 m in the first run, to 722 N, and lets it back at once in
  -- the second. Its force is the wire's tension, as in the row of the tension. Windows that begin in the
  -- first run would give 661 N. Tolerance: the tension is read in the middle of an edge, the force at its
  -- end; they differ by 1 %.
  it("has the peak force of its own windows", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
      segments = 10 }
    scene:clamp(wire, { s = 0 })
    local hand = scene:gripper{ name = "hand" }
    scene:process(function(p)
      hand:grasp(wire, { s = 0.2 })
      hand:move{ by = { 0.001, 0, 0 }, duration = 0.2 }
      hand:move{ by = { -0.001, 0, 0 }, duration = 0.01 }
      p:wait(0.1)
    end)
    scene:run{ dt = 0.005, duration = 0.2 } -- ends before the process, so it cannot be checked
    assert.is_near(wire:max_tension(), hand.peak_force, 5)
    local run = scene:run{ dt = 0.005 }
    local check = run:check{}
    local tension, force = check:row "max_tension", check:row "peak_force"
    assert.is_near(tension.value, force.value, 0.015 * tension.value)
    assert.is_near(tension.time, force.time, 1e-9)
    assert.is_true(force.time >= run.start + 0.01 - 1e-9, force.time)
  end)

  -- The same for an obstacle: a wire of 4 g lies on a table and is lifted at t = 0.1 s. Before that, the
  -- force is its weight in all windows. Within [t1, t2] no mean of a window is larger than the impulse over
  -- the window.
  it("has windows within the time that is asked for, for obstacles too", function()
    local scene = sw.scene{}
    local floor = scene:obstacle{ name = "floor", shape = "plane" }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.0015 }, segments = 10,
      to = { 0.2, 0, 0.0015 } }
    assert(scene:settle().ok)
    local clamps = { scene:clamp(wire, { s = 0.05 }), scene:clamp(wire, { s = 0.15 }) }
    for _, clamp in ipairs(clamps) do
      clamp:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0.02 } }, times = { 0, 0.1, 0.2 },
        relative = true }
    end
    scene:run{ dt = 0.002, duration = 0.2 }
    for _, t1 in ipairs{ 0.1, 0.11, 0.12, 0.13 } do
      local m = floor:over(t1, 0.2)
      assert.is_true(m.peak_force <= m.impulse_size / 0.01 * (1 + 1e-9), t1)
    end
  end)
end)
