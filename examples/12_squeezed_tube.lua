-- SPDX-License-Identifier: GPL-3.0-or-later
-- A soft tube (24 mm outer diameter, 3.6 mm wall) is squeezed between a table and a plate. The table shows
-- force, width, ovalisation, contact pressure and von Mises stress over the closing. The tube is a mesh of
-- solids.
--   12_squeezed_tube.lua [picture.png]
local sw = require "softworld"
local mm = sw.units.mm

local outer, inner, E, nu = mm(12), mm(8.4), 5e6, 0.3 -- [m], [m], [Pa], [-]
local EI = E * math.pi / 4 * (outer ^ 4 - inner ^ 4)
local scene = sw.scene { name = "squeezed tube" }
local tube = scene:wire { name = "tube", model = "cubic", section = "annulus", inner = inner, across = 8,
  body = "solid", nu = nu, EA = E * math.pi * (outer ^ 2 - inner ^ 2), EI = EI, GJ = EI / (1 + nu),
  mass_per_length = 0.25, radius = outer, spacing = mm(5), from = { 0, 0, 0 }, to = { mm(60), 0, 0 },
  normal = { 0, 0, 1 } }
local middle, start = tube.length / 2, tube:section(tube.length / 2)
local D = start.height

scene:obstacle { name = "table", shape = "plane", at = { 0, 0, -D / 2 }, friction = 0.3 }
local plate = scene:obstacle { name = "plate", shape = "box", size = { mm(80), mm(60), mm(5) },
  at = { mm(30), 0, D / 2 + mm(2.5) }, friction = 0.3 }

print "closing    force      height       width        ovalisation  pressure    von Mises"
for k = 1, 4 do
  plate:follow { points = { { 0, 0, 0 }, { 0, 0, -0.1 * D } }, duration = 1, law = "linear",
    relative = true }
  local run = scene:run { duration = 1, dt = 0.02, integrator = "implicit-euler", frame = 0.5 }
  assert(run.ok, run.reason)
  local now = tube:section(middle)
  print(("%3.0f %%  %8.2f N  %8.3f mm  %8.3f mm  %9.4f  %8.0f kPa  %8.0f kPa"):format(10 * k,
    plate:force()[3], now.height * 1e3, now:width { 0, 1, 0 } * 1e3, now.ovalisation,
    tube:contact_pressure(middle).largest / 1e3, tube:von_mises(middle).largest / 1e3))
  if k == 4 and arg[1] then
    run:pictures { path = arg[1], count = 1, camera = { direction = { 1, 0.5, -0.3 } } }
  end
end
print(tube:section(middle))
