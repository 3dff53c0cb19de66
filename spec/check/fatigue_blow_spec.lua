-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fatigue counts the tension as other rows do, as a mean over the run's window: a gripper that starts and
-- stops at once sends waves along the wire, whose forces in single steps grow as steps get shorter.
local sw = require "softworld"

local function run_of(options)
  local scene = sw.scene{ name = "endstop" }
  local wire = scene:wire{ name = "w", cable = "H07V-K 4", from = { 0, 0, 0 }, to = { 0.5, 0, 0 },
    segments = 25 }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.002 }
  local hand = scene:gripper{ name = "h", rating = { force = 20, moment = 1, stroke = false } }
  scene:clamp(wire, { s = 0 })
  assert(scene:settle().ok)
  scene:process(function(p)
    hand:grasp(wire, { s = 0.5 })
    p:wait(0.1)
    hand:move{ by = { -0.1, 0, 0.03 }, speed = 0.5, law = "linear" }
    p:wait(0.1)
  end)
  options.wear = true
  return scene:run(options)
end

local PULL = { repeats = 8, curve = { { 1, 1e6 }, { 10, 1e3 } } }
local BEND = { repeats = 8, bending = { { 10, 1e7 }, { 100, 1e4 } } }

local function row(run, given) return run:check{ fatigue = given or PULL }:row "fatigue" end

describe("fatigue where a gripper stops at once", function()
  local finest = run_of{ dt = 0.0001 }
  local fine, bent = row(finest), row(finest, BEND)

  for _, dt in ipairs{ 0.02, 0.01, 0.003, 0.001 } do
    it(("is that of fine steps, at dt = %g s"):format(dt), function()
      local run = run_of{ dt = dt }
      local pull, bend = row(run), row(run, BEND)
      print(("measured: tension %.5g at %g s, %.5g at 0.1 ms; bending %.5g, %.5g; %s"):format(pull.value, dt,
        fine.value, bend.value, bent.value, pull.note))
      assert.is_near(fine.value, pull.value, 0.05 * fine.value)
      assert.is_near(bent.value, bend.value, 0.02 * bent.value)
      assert.equal("PASS", pull.verdict)
    end)
  end

  it("tells of the blow that it does not count", function()
    assert.truthy(fine.note:find("tension: 10 ms mean; raw %S+ N in", 1), fine.note)
    local soft = row(run_of{ dt = 0.01, window = 0 })
    print(("measured: %.4g with window = 0; %s"):format(soft.value, soft.note))
    assert.is_true(soft.value > 100 * fine.value)
    assert.is_nil(soft.note:find("mean", 1, true), soft.note)
  end)

  it("counts a run shorter than the window as one mean", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", E = 1e8, density = 1000, radius = 0.002, from = { 0, 0, 0 },
      to = { 0.2, 0, 0 }, segments = 8 }
    scene:clamp(wire, { s = 0 })
    scene:force{ kind = "point", on = wire, s = 0.2, force = { 5, 0, 0 } }
    local short = row(scene:run{ duration = 0.005, dt = 0.0002, wear = true })
    local mean = wire:max_tension()
    print(("measured: %.4g, mean %.4g N; %s"):format(short.value, mean, short.note))
    assert.is_near(mean, tonumber(short.note:match("ranges up to (%S+) N")), 0.01 * mean)
  end)
end)
