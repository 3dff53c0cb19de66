-- SPDX-License-Identifier: GPL-3.0-or-later
-- A box presses on a block of foam that lies on a table. The table shows force over travel. The block is a
-- mesh of solid elements; its outer surface makes contact.
local sw = require "softworld"
local mm = sw.units.mm

local nx, ny, nz, edge = 6, 6, 4, mm(10) -- elements in each direction [-], their size [m]
local E, nu, density = 50e3, 0.2, 30     -- [Pa], [-], [kg/m3]
local radius = mm(1)                     -- contact radius around the corners of the elements [m]

local positions, hexes = {}, {}
local function number(i, j, k) return (k * (ny + 1) + j) * (nx + 1) + i + 1 end
for k = 0, nz do
  for j = 0, ny do
    for i = 0, nx do positions[#positions + 1] = { i * edge, j * edge, k * edge + radius } end
  end
end
for k = 0, nz - 1 do
  for j = 0, ny - 1 do
    for i = 0, nx - 1 do
      for level = k, k + 1 do -- four corners below, then the four above them
        for _, c in ipairs { { i, j }, { i + 1, j }, { i + 1, j + 1 }, { i, j + 1 } } do
          hexes[#hexes + 1] = number(c[1], c[2], level)
        end
      end
    end
  end
end

local scene = sw.scene { name = "foam", gravity = { 0, 0, 0 } }
local width, depth, height = nx * edge, ny * edge, nz * edge
local foam = scene:particles { name = "foam", positions = positions,
  masses = density * width * depth * height / #positions,
  elements = { { hexes = hexes, E = E, nu = nu } }, radius = radius }
scene:obstacle { shape = "plane", friction = 0.05 }
local press = scene:obstacle { shape = "box", size = { mm(80), mm(80), mm(20) }, friction = 0.05,
  at = { width / 2, depth / 2, height + 2 * radius + mm(10) } }

local speed, dt = mm(12), 0.1 -- [m/s], [s]
press:follow { points = { { 0, 0, 0 }, { 0, 0, -mm(12) } }, speed = speed, law = "linear",
  relative = true }
print(foam)
print "travel [mm]   force [N]   widest [mm]"
for i = 1, 10 do
  local run = scene:run { duration = dt, dt = dt, quasistatic = true }
  assert(run.ok, run.reason)
  local x, least, most = foam:positions(), math.huge, -math.huge
  for k = 1, #x, 3 do least, most = math.min(least, x[k]), math.max(most, x[k]) end
  print(("%8.2f %13.3f %12.3f"):format(1e3 * speed * dt * i, press:force()[3], 1e3 * (most - least)))
end
