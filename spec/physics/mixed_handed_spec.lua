-- SPDX-License-Identifier: GPL-3.0-or-later
-- A frozen grip hands a cable over to pads of another hand: these go on to press on a rod. Nothing else acts,
-- so no energy comes from nowhere, and the pads bear the cable all the time.
local sw = require "softworld"
local t = require "spec.physics.tools"

-- The first hand lifts a cable, the second one takes it, the first one lets go. Returns the force of the
-- second one after a further lift [N], the height of the cable's start [m], the second hand's peak [N], the
-- run and the first hand.
local function handed(cable, approach, dt, segments)
  local scene = sw.scene{ name = "handed" }
  local r = sw.cable(cable).outer_diameter.value / 2
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = cable, from = { 0, 0, r }, to = { 0.4, 0, r },
    segments = segments or 80 }
  scene:force{ kind = "damping", on = wire, mass = 8 }
  local pads = { width = 0.02, friction = 0.5 }
  local one, two = scene:gripper{ name = "one", pads = pads }, scene:gripper{ name = "two", pads = pads }
  local force, height
  scene:process(function(p)
    one:grasp(wire, { s = 0.12, approach = approach, force = 20 })
    one:move{ by = { 0, 0, 0.15 }, duration = 0.6 }
    p:wait(0.3)
    two:grasp(wire, { s = 0.22, approach = "plates", force = 20 })
    one:release()
    two:move{ by = { 0, 0, 0.1 }, duration = 0.5 }
    p:wait(0.3)
    force, height = two:force().z, wire:position(0).z
  end)
  local run = t.fine(scene:run{ dt = dt })
  return force, height, two.peak_force, run, one
end

describe("a frozen grip that lets go while other pads hold the cable", function()
  for _, cable in ipairs{ "GXL 1.5", "H07V-K 4", "FLRY-B 0.5" } do
    it("hands over " .. cable, function()
      local force, height, peak = handed(cable, "plates", 0.005)
      for _, dt in ipairs{ 0.02, 0.005 } do
        local now, high, most = handed(cable, "mixed", dt)
        t.near(force, now, 0.02 * force, "force")
        t.near(height, high, 0.002, "height")
        t.below(1.1 * peak, most, "peak")
      end
    end)

    -- Before, 2 % of the energy came from nowhere in the first steps: the rod's depth in the pads that stay
    -- counted as that of a wire drawn into them, and it came out against their force.
    it("makes no energy and stays in balance, whatever its edges: " .. cable, function()
      for _, o in ipairs{ { 0.01, 60 }, { 0.005, 80 }, { 0.0025, 97 } } do
        local _, _, _, run, one = handed(cable, "mixed", o[1], o[2])
        assert.equal(0, #t.events(run, "energy"))
        assert.equal(0, #t.events(run, "unbalanced"))
        t.below(1e-4, run:ledger().gained / run:ledger().play, "energy from nowhere")
        assert.equal("rod", one.events[2].on)
      end
    end)
  end
end)
