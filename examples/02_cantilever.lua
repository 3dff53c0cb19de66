-- SPDX-License-Identifier: GPL-3.0-or-later
-- A clamp holds one end of a cable horizontally. How far does the free end droop? The formula for beams,
-- w L^4 / (8 EI), is valid for small droops only.
local sw = require "softworld"

local E, density, radius, g = 9.4176e8, 1500, 0.0025, 9.81
local weight = density * g * math.pi * radius ^ 2 -- [N/m]
local EI = E * math.pi * radius ^ 4 / 4           -- [N m2]

print "length      droop       beam formula"
for _, length in ipairs { 0.2, 0.5, 1 } do
  local scene = sw.scene { name = "cantilever" }
  local cable = scene:wire { E = E, density = density, radius = radius,
    from = { 0, 0, 0 }, to = { length, 0, 0 }, segments = 50 }
  scene:clamp(cable, { s = 0 })
  local rest = scene:settle()
  assert(rest.ok, rest.reason)
  print(("%.1f m   %9.5f m   %9.5f m"):format(length, -cable:position(length).z,
    weight * length ^ 4 / (8 * EI)))
end
