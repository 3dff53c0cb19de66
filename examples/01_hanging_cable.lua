-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable of 1 m hangs between two clamps at the same height, 952 mm apart. How far does it sag, and
-- which forces and moments act on it at the clamps?
local sw = require "softworld"

local scene = sw.scene { name = "hanging cable" }
local cable = scene:wire { mass_per_length = 0.03, EA = 5e3, EI = 2.943e-3, radius = 0.0025,
  from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 100 }
local left = scene:clamp(cable, { s = 0 })
local right = scene:clamp(cable, { s = cable.length })

-- Move the right clamp towards the left one in steps shorter than a segment. The slack makes the cable sag.
local span = cable.length / 1.05
for i = 1, 10 do
  right:pose { cable.length + (span - cable.length) * i / 10, 0, 0 }
  local rest = scene:settle()
  assert(rest.ok, rest.reason)
end

local weight = 0.03 * 9.81 * cable.length
print(("sag %.5f m"):format(-cable:position(cable.length / 2).z))
for _, clamp in ipairs { left, right } do
  local force, moment = clamp:force(), clamp:moment()
  print(("clamp: %.5f N along, %.5f N up, moment %.5f N m"):format(force.x, force.z, moment.y))
end
print(("weight %.5f N, tension in the middle %.5f N"):format(weight, cable:tension(cable.length / 2)))
