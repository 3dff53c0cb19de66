-- SPDX-License-Identifier: GPL-3.0-or-later
-- p:wait_until for a contact: a force that rises until the end of the step in which the touch begins is told.
local sw = require "softworld"
local t = require "spec.physics.tools"

local function late_of(run)
  local late = {}
  for _, e in ipairs(run.events) do
    if e.kind == "late" then late[#late + 1] = e end
  end
  return late
end

-- A hand moves the end of a cable at a stop and stops where it touches. Returns the run and the hand.
local function pushed(cable, o)
  local scene = sw.scene{ name = "stop" }
  local stop = scene:obstacle{ name = "stop", shape = "box", size = { 0.02, 0.2, 0.2 }, at = { 0.05, 0, 0.1 },
    friction = 0.2 }
  local wire = scene:wire{ name = "wire", cable = cable, from = { 0, 0, 0.1 }, to = { -0.2, 0, 0.1 },
    segments = 60 }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.001 }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.02 })
    p:wait(0.1)
    scene:process(function() hand:move{ by = { 0.06, 0, 0 }, speed = 0.1, law = "linear" } end)
    assert.is_true(p:wait_until({ contact = stop }, { timeout = 2 }))
    hand:stop()
    p:wait(0.1)
  end)
  return t.fine(scene:run{ dt = o.dt, quasistatic = o.quasistatic }), hand
end

-- A cable falls on a table, or a hand lowers it, or a peg sweeps it where it hangs.
local function touched(cable, dt, how)
  local scene = sw.scene{ name = how }
  local z = how == "fall" and 0.5 or 0.03
  local on = scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = cable, from = { 0, 0, z }, to = { 0.3, 0, z },
    segments = 60 }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.001 }
  local hand = scene:gripper{ name = "hand" }
  if how == "sweep" then
    on = scene:obstacle{ name = "peg", shape = "cylinder", radius = 0.01, length = 0.2,
      at = { 0.25, -0.05, 0.05 } }
  end
  scene:process(function(p)
    if how ~= "fall" then hand:grasp(wire, { s = 0.05 }) end
    if how == "sweep" then
      p:wait(0.2)
      on:follow{ points = { { 0, 0, 0 }, { 0, 0.2, 0 } }, relative = true, speed = 0.3, law = "linear" }
    elseif how == "lower" then
      scene:process(function() hand:move{ by = { 0, 0, -0.025 }, speed = 0.2 } end)
    end
    assert.is_true(p:wait_until({ contact = on }, { timeout = 2 }))
    if how == "sweep" then on:follow(nil) elseif how == "lower" then hand:stop() end
    p:wait(0.1)
  end)
  return t.fine(scene:run{ dt = dt })
end

describe("waiting for a contact", function()
  -- Stopped within 0.01 ms of the touch, FLRY-B 0.5 has a peak of 7 N. At 20 ms it has 70 N.
  it("tells that a hand pushed a stiff cable on until the end of the step", function()
    for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 10" } do
      for _, o in ipairs{ { dt = 0.02 }, { dt = 0.005 }, { dt = 3e-4 }, { dt = 0.02, quasistatic = true } } do
        local run, hand = pushed(cable, o)
        local late = late_of(run)
        assert.equal(1, #late)
        assert.equal("stop", late[1].object)
        t.above(0.3 * hand.peak_force, late[1].value, "force that is told")
        local check = run:check{ limits = { ["hand.peak_force"] = 1e4 } }
        assert.equal("OPEN", check:row "hand.peak_force".verdict)
        assert.matches("^the touch of 'stop' that process 1 waited for began within a step of [%d.]+ %a+, "
          .. "and its force rose to [%d.]+ k?N before the process went on at the step's end%. Take a "
          .. "shorter dt or a lower speed$", late[1].text)
      end
    end
  end)

  it("is late by the step", function()
    for dt, peak in pairs{ [0.02] = 70, [1e-5] = 7 } do
      local _, hand = pushed("FLRY-B 0.5", { dt = dt })
      t.near(peak, hand.peak_force, 0.05 * peak, "peak")
    end
  end)

  it("says nothing of blows, or where the force stays small", function()
    for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 10" } do
      for _, how in ipairs{ "fall", "lower", "sweep" } do
        for _, dt in ipairs{ 0.02, 0.005, 0.001, 3e-4 } do
          assert.equal(0, #late_of(touched(cable, dt, how)))
        end
      end
    end
  end)
end)
