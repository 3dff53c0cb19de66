-- SPDX-License-Identifier: GPL-3.0-or-later
-- With how little force can a gripper lift a wire from the table without losing it? A loop lowers the
-- force until the wire slips, from the same snapshot each time.
local sw = require "softworld"
local mm = sw.units.mm

local scene = sw.scene { name = "least force" }
scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
scene:force { kind = "damping", mass = 8 }
local wire = scene:wire { cable = "GXL 1.5", from = mm { 0, 0, 1.2 }, to = mm { 300, 0, 1.2 } }
local friction = 0.4
local hand = scene:gripper { name = "hand", pads = { width = mm(15), friction = friction, opening = mm(4) },
  slip_tolerance = mm(0.2) }
local start = scene:snapshot()

-- Does the wire stay in the jaws while it is lifted as fast as wanted?
local function holds(force)
  scene:restore(start)
  hand.events = {}
  scene:process(function(p)
    hand:grasp(wire, { s = mm(150), approach = "plates", force = force, on_slip = "stop" })
    hand:move { by = mm { 0, 0, 250 }, duration = 0.5 }
    p:wait(0.3)
  end)
  local run = scene:run { dt = 0.005 }
  assert(run.ok, run.reason)
  local most = hand:over().peak_margin
  print(("%7.4f N: %s (margin up to %.2f)"):format(force, hand.slip_event and "slips" or "holds", most))
  return not hand.slip_event
end

local low, high = 0, 1 -- [N]
while not holds(high) do low, high = high, 2 * high end
while high - low > 0.02 * high do
  local middle = 0.5 * (low + high)
  if holds(middle) then high = middle else low = middle end
end
local weight = wire.beam.mass_per_length * 9.81 * wire.length
print(("least force %.4f N per finger; held at rest it would be weight / (2 mu) = %.4f N"):format(high,
  weight / (2 * friction)))
