-- SPDX-License-Identifier: GPL-3.0-or-later
-- A rod between pads gets other edges. It stays where it is, so the pads press and hold it as before: the
-- depth of its new samples is what the pads' force has pressed in, not that of a wire drawn into the pads.
local sw = require "softworld"
local t = require "spec.physics.tools"

local FORCE, SOON = 20, 3e-4 -- of each finger [N]; parts of the time after the change [s]

-- A cable, clamped at its start, that pads have lifted by 20 mm. Its edges change, and the run goes on.
local function changed(cable, segments, dt)
  local scene = sw.scene{ name = "edges" }
  local r = sw.cable(cable).outer_diameter.value / 2
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = cable, segments = 80, from = { 0, 0, r },
    to = { 0.4, 0, r } }
  scene:force{ kind = "damping", on = wire, mass = 8 }
  scene:clamp(wire, { s = 0.02 })
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, friction = 0.5 } }
  local out = { way = 0, least = math.huge }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.22, approach = "plates", force = FORCE })
    hand:move{ by = { 0, 0, 0.02 }, duration = 0.2 }
    p:wait(0.3)
    local opening = hand:state().opening
    out.before, out.turned = hand:force().z, hand:moment().y
    wire:remodel{ model = "rod", segments = segments }
    out.now, out.turns = hand:force().z, hand:moment().y
    for k = 1, 30 do
      p:wait(SOON)
      local state = hand:state()
      out.way = math.max(out.way, math.abs(state.opening - opening))
      out.least = math.min(out.least, state.squeeze)
      if k == 1 then out.after = hand:force().z end
    end
  end)
  local run = t.fine(scene:run{ dt = dt })
  return out, run
end

describe("pads on a rod that gets other edges", function()
  for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    it("press and hold it as before: " .. cable, function()
      for _, o in ipairs{ { 60, 0.01 }, { 81, SOON }, { 120, SOON } } do
        local got, run = changed(cable, o[1], o[2])
        -- Two faces are pressed in by 5 um. Edges with another number of samples alter this by up to 2.5 um;
        -- a depth that does not count would let the pads close by 10 um more.
        t.below(3e-6, got.way, "way of the jaws [m]")
        t.above(0.99 * FORCE, got.least, "least force of a finger [N]")
        t.share(got.before, got.now, 1e-9, "the same before a step") -- nothing has changed; it was 0
        t.share(got.turned, got.turns, 1e-6, "its moment before a step")
        t.share(got.before, got.after, 0.03, "force that the pads bear")
        t.below(1e-3, run:ledger().gained / run:ledger().play, "energy from nowhere")
        assert.equal(0, #t.events(run, "energy"))
      end
    end)
  end
end)
