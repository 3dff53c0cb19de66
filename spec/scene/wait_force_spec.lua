-- SPDX-License-Identifier: GPL-3.0-or-later
-- p:wait_until for a force: neither the force of a start at once, which has no exact value, nor a force that
-- rises far beyond the wanted one within a step may pass for it unseen.
local sw = require "softworld"
local t = require "spec.physics.tools"

local WANTED = 5 -- [N]

-- A sagging cable is drawn taut until the hand feels the wanted force. Returns the run, the time of the stop
-- [s], the hand, and the events `late`.
local function drawn(cable, o)
  local path = {}
  for i = 0, 50 do path[i + 1] = { 0.01 * i, 0, -0.1 * math.sin(math.pi * i / 50) } end
  local made = { name = "wire", segments = 30, path = path }
  for k, v in pairs(cable) do made[k] = v end
  local scene = sw.scene{ name = "taut" }
  local wire = scene:wire(made)
  scene:force{ kind = "damping", on = wire, mass = 4, stiffness = 0.001 }
  scene:pin(wire, { s = 0 })
  local hand, stop = scene:gripper{ name = "hand" }, nil
  scene:process(function()
    hand:grasp(wire, { s = wire.length - 0.005 })
    hand:move{ by = { 0.1, 0, 0 }, speed = o.speed or 0.05, law = "linear" }
  end)
  scene:process(function(p)
    p:wait_until({ force = WANTED, on = hand }, { timeout = 3 })
    stop = p.time
    hand:stop()
    p:wait(0.2)
  end)
  local run = t.fine(scene:run{ dt = o.dt, tolerance = o.tolerance, quasistatic = o.quasistatic })
  local late = {}
  for _, e in ipairs(run.events) do
    if e.kind == "late" then late[#late + 1] = e end
  end
  return run, stop, hand, late
end

local stiff, soft = { cable = "GXL 1.5" }, { E = 20e6, density = 1200, radius = 0.002 }

describe("waiting for a force", function()
  -- The cable is taut at 0.86 s. The start at once has up to 105 N for 0.6 us: the process went on with the
  -- cable slack, and a check of its peak passed with 0.06 N.
  it("is not ended by the start of a stiff cable in short steps", function()
    for _, o in ipairs{ { dt = 1e-4 }, { tolerance = 1e-6 }, { dt = 0.01 } } do
      local _, stop, hand = drawn(stiff, o)
      t.near(0.858, stop, 0.006, "time of the stop")
      t.above(0.9 * WANTED, hand.peak_force, "peak")
    end
  end)

  it("ends at the same force in all steps where the force rises slowly, without a word", function()
    for _, o in ipairs{ { dt = 0.02 }, { dt = 0.001 }, { dt = 1e-4 }, { tolerance = 1e-5 },
      { dt = 0.02, quasistatic = true } } do
      local _, stop, _, late = drawn(soft, o)
      t.near(1.09, stop, 0.012, "time of the stop")
      assert.equal(0, #late)
    end
  end)

  it("tells that the force rose far beyond the wanted one within a step", function()
    for _, o in ipairs{ { dt = 0.02, speed = 0.5 }, { dt = 0.1, quasistatic = true } } do
      local run, _, hand, late = drawn(stiff, o)
      assert.equal(1, #late)
      assert.equal("OPEN", run:check{ limits = { ["hand.peak_force"] = 1e4 } }:row "hand.peak_force".verdict)
      assert.equal("hand", late[1].object)
      t.above(1.1 * WANTED, late[1].value, "force that is told")
      t.above(0.3 * late[1].value, hand.peak_force, "peak")
      assert.matches("^the force of 'hand' rose from [%d.]+ m?N to [%d.]+ k?N within a step of [%d.]+ ms: "
        .. "process 2 went on with it, not with 5%.000 N%. Take a shorter dt or a lower speed$", late[1].text)
    end
  end)

  it("says nothing of a force that was there before", function()
    local scene = sw.scene{ name = "there" }
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    local hold, went = scene:clamp(wire, { s = 0 }), nil
    scene:settle()
    scene:process(function(p) went = p:wait_until({ force = 1e-3, on = hold }, { timeout = 1 }) end)
    assert.equal(0, #t.fine(scene:run{ dt = 0.01 }).events)
    assert.is_true(went)
  end)
end)
