-- SPDX-License-Identifier: GPL-3.0-or-later
-- The margin of pads that have just closed on a wire at rest: friction bears nothing but rounding. The margin
-- is the load's power over the most that the touches can resist, and so 1 at most.
local sw = require "softworld"

local RADIUS, S = 0.002175, 0.1241

local function largest_margin(segments)
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  local wire = scene:wire{ cable = "H07V-K 4", segments = segments, from = { 0, 0, RADIUS },
    to = { 0.365, 0, RADIUS } }
  scene:force{ kind = "damping", mass = 2.5, stiffness = 2e-3 }
  local hand = scene:gripper{ at = { S, 0, RADIUS }, rotation = { 1, 0, 0, 0 },
    pads = { width = 0.01, friction = 0.65, opening = 3.2 * RADIUS } }
  scene:process(function() hand:grasp(wire, { s = S, approach = "plates", force = 13.8 }) end)
  assert.is_true(scene:run{ dt = 2.5e-3 }.ok)
  local most = 0
  for _, margin in ipairs(hand:series().margin) do
    if margin == margin then most = math.max(most, margin) end
  end
  return most
end

describe("pads that have just closed", function()
  -- Friction of 1e-12 N was turned into a margin of 9e6 with 46 segments, by a turn that moves no touch; that
  -- was the grip's peak_margin. 0.01: the wire rests, and bears nothing but what rounding leaves.
  it("have no margin", function()
    for segments = 40, 50 do
      local most = largest_margin(segments)
      assert.is_true(most < 0.01, ("%d segments: %g"):format(segments, most))
    end
  end)
end)
