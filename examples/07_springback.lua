-- SPDX-License-Identifier: GPL-3.0-or-later
-- How far must a wire be bent to stay bent? A gripper bends 60 mm of a wire to an arc and releases it.
-- The curvature that springs back is the bending moment over EI.
local sw = require "softworld"
local mm, deg = sw.units.mm, sw.units.deg

local length, EI = mm(60), 0.02     -- bent length [m], bending stiffness [N m2]
local yield, hardening = 0.2, 0.002 -- yield moment [N m], hardening [N m2]

-- Bends the wire by the angle; returns the remaining angle [rad] and the dissipated energy [J].
local function springback(angle)
  local scene = sw.scene { name = "springback", gravity = { 0, 0, 0 } }
  local wire = scene:wire { EA = 2e4, EI = EI, mass_per_length = 0.02, radius = mm(1),
    from = { 0, 0, 0 }, to = { length + mm(30), 0, 0 }, segments = 45 }
  scene:force { kind = "plastic", on = wire, yield_moment = yield, hardening = hardening }
  scene:force { kind = "damping", on = wire, stiffness = sw.units.ms(1) }
  scene:clamp(wire, { s = 0 })
  local gripper = scene:clamp(wire, { s = length })
  -- follow the end of an arc of this length while its angle grows
  gripper:follow { func = function(t)
    local a = math.max(angle * math.min(t, 1), 1e-9)
    return { length * math.sin(a) / a, 0, length * (1 - math.cos(a)) / a },
      { axis = { 0, -1, 0 }, angle = a }
  end }
  local run = scene:run { duration = 1, dt = 0.01 }
  assert(run.ok, run.reason)
  gripper:release()
  local rest = scene:settle()
  assert(rest.ok, rest.reason)
  local along = wire:tangent(wire.length).x -- cosine of the remaining angle
  return math.acos(math.min(along, 1)), scene:energy().dissipated
end

print "bent by   remains   dissipated"
for _, angle in ipairs { 30, 60, 90, 120 } do
  local remains, work = springback(deg(angle))
  print(("%5.0f     %6.2f    %.4f J"):format(angle, math.deg(remains), work))
end
