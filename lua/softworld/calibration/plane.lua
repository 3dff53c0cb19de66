-- SPDX-License-Identifier: GPL-3.0-or-later
--- Maps a photograph to a plane: the projective map takes pixels (u, v) of at least four known points to
-- their places (x, z) in the plane, x = (a u + b v + c) / (g u + h v + 1), z = (d u + e v + f) / (...).
-- The lens must be free of distortion.
-- @module softworld.calibration.plane
local checks = require "softworld.checks"

local plane = {}

local MOST = 1000       -- most known points
local FLAT = 1e-10      -- pivot of the scaled equations below which points lie on a line
local ROUGH = 0.05      -- largest error at more than four known points, over their extent

local function fail(text, ...) error(text:format(...), 0) end

-- Solves the symmetric a x = b of n unknowns by elimination; nil if it is singular.
local function solve(a, b, n)
  for k = 1, n do
    local at = k
    for i = k + 1, n do
      if math.abs(a[i][k]) > math.abs(a[at][k]) then at = i end
    end
    if math.abs(a[at][k]) < FLAT then return nil end
    a[k], a[at], b[k], b[at] = a[at], a[k], b[at], b[k]
    for i = k + 1, n do
      local share = a[i][k] / a[k][k]
      for j = k, n do a[i][j] = a[i][j] - share * a[k][j] end
      b[i] = b[i] - share * b[k]
    end
  end
  for k = n, 1, -1 do
    for j = k + 1, n do b[k] = b[k] - a[k][j] * b[j] end
    b[k] = b[k] / a[k][k]
  end
  return b
end

-- Returns the middle and size of the columns i, i + 1 of a list of rows, which scale the equations to about
-- 1.
local function scale_of(known, i)
  local x, z, size, n = 0, 0, 0, #known
  for _, p in ipairs(known) do x, z = x + p[i] / n, z + p[i + 1] / n end
  for _, p in ipairs(known) do size = math.max(size, math.abs(p[i] - x), math.abs(p[i + 1] - z)) end
  return { x, z, size }
end

local function normal_equations(rows)
  local a, b = {}, {}
  for i = 1, 8 do
    a[i], b[i] = {}, 0
    for j = 1, 8 do
      a[i][j] = 0
      for _, row in ipairs(rows) do a[i][j] = a[i][j] + row[i] * row[j] end
    end
    for _, row in ipairs(rows) do b[i] = b[i] + row[i] * row[9] end
  end
  return a, b
end

local function read(what, known)
  if type(known) ~= "table" or #known < 4 or #known > MOST then
    fail("%s: pixels must be a list of at least four known points { u, v, x, z }, got %s", what,
      type(known) == "table" and ("%d"):format(#known) or checks.got(known))
  end
  checks.only(what .. ": pixels", known, nil, 0)
  for i, p in ipairs(known) do
    if type(p) == "table" then checks.only(("%s: pixels[%d]"):format(what, i), p, nil, 0) end
    for k = 1, 4 do
      local value = checks.field(p, k)
      if type(value) ~= "number" or value - value ~= 0 then
        fail("%s: pixels[%d] must be { u, v, x, z }: a place in the picture [px] and in the plane [m], got "
          .. "%s as item %d", what, i, checks.got(value), k)
      end
    end
  end
end

-- True if three of the first four known points lie on a line (in columns i, i + 1).
local function on_a_line(known, i, size)
  for skip = 1, 4 do
    local p = {}
    for k = 1, 4 do
      if k ~= skip then p[#p + 1] = known[k] end
    end
    local area = (p[2][i] - p[1][i]) * (p[3][i + 1] - p[1][i + 1])
      - (p[3][i] - p[1][i]) * (p[2][i + 1] - p[1][i + 1])
    if math.abs(area) < 1e-3 * size * size then return true end
  end
  return false
end

-- Returns the map with numbers h, as a function u, v -> x, z.
local function map_of(h, from, to)
  return function(u, v)
    u, v = (u - from[1]) / from[3], (v - from[2]) / from[3]
    local below = h[7] * u + h[8] * v + 1
    return to[1] + to[3] * (h[1] * u + h[2] * v + h[3]) / below,
      to[2] + to[3] * (h[4] * u + h[5] * v + h[6]) / below, below
  end
end

--- Returns the map of known points { { u, v, x, z }, ... }: a function u, v -> x, z, and a number above 0 on
-- the side of the picture's horizon on which they lie.
function plane.map(what, known)
  read(what, known)
  local from, to, rows = scale_of(known, 1), scale_of(known, 3), {}
  for i, columns in ipairs { from, to } do
    if columns[3] == 0 or #known == 4 and on_a_line(known, 2 * i - 1, columns[3]) then
      fail("%s: three of the four known points of pixels lie on a line%s; take the corners of a rectangle",
        what, i == 1 and " in the picture" or " in the plane")
    end
  end
  for _, p in ipairs(known) do
    local u, v = (p[1] - from[1]) / from[3], (p[2] - from[2]) / from[3]
    local x, z = (p[3] - to[1]) / to[3], (p[4] - to[2]) / to[3]
    rows[#rows + 1] = { u, v, 1, 0, 0, 0, -u * x, -v * x, x }
    rows[#rows + 1] = { 0, 0, 0, u, v, 1, -u * z, -v * z, z }
  end
  local a, b = normal_equations(rows)
  local h = solve(a, b, 8)
  if not h then fail("%s: the known points of pixels give no picture of the plane", what) end
  local map = map_of(h, from, to)
  for i, p in ipairs(known) do
    local x, z, below = map(p[1], p[2])
    if below <= 0 or math.sqrt((x - p[3]) ^ 2 + (z - p[4]) ^ 2) > ROUGH * to[3] then
      fail("%s: pixels[%d] does not fit the other known points; are they in the same order in the picture "
        .. "and in the plane?", what, i)
    end
  end
  return map
end

--- Returns the length of a pixel in the plane at u, v [m]: the root of the area it covers.
function plane.scale(map, u, v)
  local x, z = map(u, v)
  local xu, zu = map(u + 0.5, v)
  local xv, zv = map(u, v + 0.5)
  return 2 * math.sqrt(math.abs((xu - x) * (zv - z) - (xv - x) * (zu - z)))
end

return plane
