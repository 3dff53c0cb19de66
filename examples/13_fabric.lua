-- SPDX-License-Identifier: GPL-3.0-or-later
-- A piece of fabric falls over a box and hangs down on all sides. Links along the threads resist stretch,
-- weaker diagonal links resist shear, rows of three particles resist bending; repulsion keeps folds apart.
local sw = require "softworld"
local mm = sw.units.mm

local n, mesh = 31, mm(10)          -- particles in each direction [-], distance between them [m]
local density, height = 0.15, 0.2   -- mass of the fabric per area [kg/m2], height of the box [m]

local positions, threads, across, rows = {}, {}, {}, {}
local function number(i, j) return (j - 1) * n + i end
local function add(list, ...) for _, k in ipairs { ... } do list[#list + 1] = k end end
for j = 1, n do
  for i = 1, n do
    local k = number(i, j)
    add(positions, (i - 1) * mesh, (j - 1) * mesh, height + mm(5))
    if i < n then add(threads, k, k + 1) end
    if j < n then add(threads, k, k + n) end
    if i < n and j < n then add(across, k, k + n + 1, k + 1, k + n) end
    if i < n - 1 then add(rows, k, k + 1, k + 2) end
    if j < n - 1 then add(rows, k, k + n, k + 2 * n) end
  end
end

local scene = sw.scene { name = "fabric" }
local middle = (n - 1) / 2 * mesh
local box = scene:obstacle { shape = "box", size = { mm(160), mm(160), height },
  at = { middle, middle, height / 2 }, friction = 0.3 }
local fabric = scene:particles { name = "fabric", positions = positions,
  masses = density * ((n - 1) * mesh) ^ 2 / n ^ 2,
  links = { { pairs = threads, k = 500 }, { pairs = across, k = 20 } },
  folds = { { triples = rows, stiffness = 1e-5 } },
  radius = mm(1), repel = { distance = mm(6), stiffness = 20 } }
scene:force { kind = "damping", on = fabric, mass = 4, stiffness = sw.units.ms(2) }

local run = scene:run { duration = 2, dt = 0.01 }
assert(run.ok, run.reason)
print(fabric)
local x = fabric:positions()
for _, corner in ipairs { number(1, 1), number(n, 1), number(1, n), number(n, n) } do
  print(("corner hangs %.1f mm below the box's top"):format(1e3 * (height - x[3 * corner])))
end
print(("the box carries %.4f N of %.4f N"):format(-box:force()[3], fabric.mass * 9.81))
local energy = fabric:energy()
print(("stored: %.3g J stretching, %.3g J bending"):format(energy.stretch, energy.bend))
