-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mixed grip that is drawn further than its pads can hold. A rigid grip bears any load, and a real cable
-- is stiff along its axis: within one step the load goes from nothing to many times what the pads bear. So
-- that step is taken back, and the pads do it. Before, hands, clamps and cables had 3 to 190 times the
-- limit.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local mu = 0.3
local ABOVE = 1.1 -- largest force over the limit, 2 mu N [-]

-- A cable is clamped at its end; a mixed grip at 60 mm goes away from the clamp by 2 mm.
local function drawn(cable, force, run, law, speed, more)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.1, 0, 0 }, segments = 12 }
  local clamp = scene:clamp(wire, { s = 0 })
  scene:force{ kind = "damping", mass = 8 }
  local hand = scene:gripper{ name = "hand", at = { 0.06, 0, 0 },
    pads = { width = 0.01, friction = mu, opening = 3 * wire.radius } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.06, approach = "mixed", force = force })
    hand:move{ by = { 0.002, 0, 0 }, speed = speed, law = law }
    p:wait(0.05)
    if more then more(hand, p) end
  end)
  return t.fine(scene:run(run)), hand, clamp, wire
end

-- Checks the peaks of all that is in the cable's way.
local function within(cable, force, run, law, speed)
  local what = ("%s at %g ms, %s, %g mm/s"):format(cable, 1e3 * run.dt, law, 1e3 * speed)
  local result, hand, clamp, wire = drawn(cable, force, run, law, speed)
  local most = ABOVE * 2 * mu * force
  t.below(most, hand.peak_force, "hand, " .. what)
  t.below(most, hand:over(nil, nil, { window = 0 }).peak_force, "hand in single steps, " .. what)
  t.below(most, clamp:over().peak_force, "clamp, " .. what)
  t.below(most, wire:max_tension(), "tension, " .. what)
  -- it is the pads that hold in the end, with all that they can
  t.share(2 * mu * force, hand:force()[1], 0.01, "force at the end, " .. what)
  assert.equal("frozen", hand.events[1].kind)
  assert.equal("thawed", hand.events[2].kind)
  t.above(0.9, hand.events[2].margin, "margin of the thaw, " .. what)
  local books = result:ledger()
  local share = run.quasistatic and 0.01 or 1e-3
  t.below(share * books.play, math.abs(books.gap), "energy, " .. what)
end

describe("a mixed grip drawn beyond what its pads hold", function()
  for _, row in ipairs{ { "H07V-K 1.5", 2 }, { "GXL 0.5", 2 }, { "FLRY-B 2.5", 8 } } do
    local cable, force = row[1], row[2]
    for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
      it(("never bears more than they can: %s at %g ms"):format(cable, 1e3 * dt), function()
        within(cable, force, { dt = dt }, "minimum-jerk", 0.01)
        within(cable, force, { dt = dt }, "linear", 0.05)
      end)
    end
  end

  it("nor at 1 ms, nor faster, nor by tolerance", function()
    within("H07V-K 1.5", 2, { dt = 0.001 }, "minimum-jerk", 0.05)
    within("FLRY-B 2.5", 8, { dt = 0.01 }, "minimum-jerk", 0.05)
    within("H07V-K 1.5", 2, { dt = 0.01, tolerance = 1e-6 }, "minimum-jerk", 0.05)
  end)

  it("nor in slow handling, from pose to pose", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
      within("H07V-K 1.5", 2, { dt = dt, quasistatic = true }, "minimum-jerk", 0.01)
      within("GXL 0.5", 2, { dt = dt, quasistatic = true }, "linear", 0.05)
    end
  end)

  it("nor when it stands and the cable's end is drawn away", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "FLRY-B 2.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 24 }
      scene:force{ kind = "damping", mass = 8 }
      local hand = scene:gripper{ name = "hand", at = { 0.05, 0, 0 },
        pads = { width = 0.01, friction = mu, opening = 3 * wire.radius } }
      local far = scene:gripper{ name = "far", at = { 0.2, 0, 0 } }
      scene:process(function()
        far:grasp(wire, { s = 0.2 })
        hand:grasp(wire, { s = 0.05, approach = "mixed", force = 10, region = 0.03 })
        far:move{ by = { 0.003, 0, 0 }, speed = 0.03 }
      end)
      t.fine(scene:run{ dt = dt })
      assert.equal("thawed", hand.events[2].kind)
      t.below(ABOVE * 2 * mu * 10, hand.peak_force, ("hand at %g ms"):format(1e3 * dt))
      t.below(ABOVE * 2 * mu * 10, far.peak_force, ("far end at %g ms"):format(1e3 * dt))
    end
  end)

  it("slips at the same time at any step", function()
    local times = {}
    for k, dt in ipairs{ 0.01, 0.002 } do
      local _, hand = drawn("H07V-K 1.5", 2, { dt = dt }, "minimum-jerk", 0.05)
      for _, e in ipairs(hand.events) do
        if e.kind == "slip" then times[k] = e.time - hand.events[1].time end
      end
    end
    t.near(times[2], times[1], 0.01, "time of the slip after the freeze")
  end)

  it("is frozen again by hand, and thaws again at once", function()
    local before
    local _, hand = drawn("H07V-K 1.5", 2, { dt = 0.01 }, "minimum-jerk", 0.01, function(hand, p)
      before = #hand.events
      hand:freeze()
      hand:move{ by = { 0.0005, 0, 0 }, speed = 0.01, law = "linear" }
      p:wait(0.05)
    end)
    assert.equal("frozen", hand.events[before + 1].kind)
    assert.equal("thawed", hand.events[before + 2].kind)
    assert.is_nil(hand.frozen)
    t.below(ABOVE * 2 * mu * 2, hand.peak_force, "peak")
  end)
end)
