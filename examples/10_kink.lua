-- SPDX-License-Identifier: GPL-3.0-or-later
-- Why do twisted cables kink? A taut cable is twisted, then its ends are moved together. It forms a
-- loop, which closes and coils around itself.
local sw = require "softworld"
local mm = sw.units.mm

local length, radius = 1, mm(1.5) -- [m]
local turns, slack = 6, 0.2       -- twist in turns [-]; how far the ends are moved together [m]

local scene = sw.scene { name = "kink", gravity = { 0, 0, 0 } }
local path = {} -- straight except for an initial bow of 0.2 mm, since no cable is perfectly straight
for i = 0, 100 do
  path[#path + 1] = { length * i / 100, mm(0.2) * math.sin(math.pi * i / 100), 0 }
end
local cable = scene:wire { EA = 700, EI = 4e-4, GJ = 3e-4, mass_per_length = 0.01, radius = radius,
  path = path, segments = 160 }
scene:wire_contact { friction = 0.02 } -- more brakes the coil: see help "limits"
scene:force { kind = "damping", mass = 3 }
scene:clamp(cable, { s = 0 })
local hand = scene:clamp(cable, { s = cable.length })

hand:follow { points = { { 0, 0, 0 }, { 0, 0, 0 } }, duration = 4, relative = true,
  turn = { axis = { 1, 0, 0 }, angle = 2 * math.pi * turns } }
assert(scene:run { duration = 4, dt = 0.01 }.ok)
print(("taut: torque %.6f N m"):format(math.abs(hand:moment()[1])))

print "slack    pull       torque      bend radius  places touching"
for k = 1, 8 do
  hand:follow { points = { { 0, 0, 0 }, { -slack / 8, 0, 0 } }, duration = 0.5, relative = true }
  local run = scene:run { duration = 1, dt = 0.005 }
  assert(run.ok, run.reason)
  local radius_now = cable:min_bend_radius { now = true }
  print(("%.3f m  %.5f N  %.6f N m  %.4f m     %d"):format(slack * k / 8, hand:force()[1],
    math.abs(hand:moment()[1]), radius_now, #scene:touches()))
end
