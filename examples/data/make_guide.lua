-- SPDX-License-Identifier: GPL-3.0-or-later
-- Writes a guide block as an STL file in mm: 100 long (x), 60 wide (y), 60 high (z). A groove along x
-- narrows to 10 mm at a height of 30.
--   softworld examples/data/make_guide.lua guide.stl
local path = ...

-- Outline in the y-z plane, and the triangles that fill it.
local outline = { { -30, 0 }, { 30, 0 }, { 30, 60 }, { 20, 60 }, { 5, 30 },
  { -5, 30 }, { -20, 60 }, { -30, 60 } }
local caps = { { 1, 2, 5 }, { 1, 5, 6 }, { 2, 3, 4 }, { 2, 4, 5 }, { 1, 6, 7 }, { 1, 7, 8 } }
local half = 50

local lines = { "solid guide" }
local function triangle(a, b, c)
  lines[#lines + 1] = "facet normal 0 0 0\n outer loop" -- programs compute the normal from the corners
  for _, p in ipairs { a, b, c } do
    lines[#lines + 1] = ("  vertex %g %g %g"):format(p[1], p[2], p[3])
  end
  lines[#lines + 1] = " endloop\nendfacet"
end
local function corner(x, i) return { x, outline[i][1], outline[i][2] } end

for _, t in ipairs(caps) do
  triangle(corner(half, t[1]), corner(half, t[2]), corner(half, t[3]))
  triangle(corner(-half, t[1]), corner(-half, t[3]), corner(-half, t[2]))
end
for i = 1, #outline do
  local j = i % #outline + 1
  triangle(corner(-half, i), corner(-half, j), corner(half, j))
  triangle(corner(-half, i), corner(half, j), corner(half, i))
end
lines[#lines + 1] = "endsolid guide\n"

local file = assert(io.open(path, "w"))
assert(file:write(table.concat(lines, "\n")))
file:close()
