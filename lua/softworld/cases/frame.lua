-- SPDX-License-Identifier: GPL-3.0-or-later
--- The axes in which a case is built: x along the wire, z up. Options gravity, rotation
-- and at turn and shift them; a case's answers are in its own axes.
-- @module softworld.cases.frame
local vec = require "softworld.vec"

local frame = {}

local function turn(q, p) -- p turned by the unit quaternion q
  local u = { q[2], q[3], q[4] }
  local c = vec.cross(u, p)
  local d = vec.cross(u, c)
  return { p[1] + 2 * (q[1] * c[1] + d[1]), p[2] + 2 * (q[1] * c[2] + d[2]),
    p[3] + 2 * (q[1] * c[3] + d[3]) }
end

local function normal(q)
  local n = (q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2 + q[4] ^ 2) ^ 0.5
  return { q[1] / n, q[2] / n, q[3] / n, q[4] / n }
end

-- Returns the shortest turn of straight down into the direction g of length size.
local function hang(g, size)
  local d = { g[1] / size, g[2] / size, g[3] / size }
  if d[3] > 1 - 1e-12 then return { 0, 1, 0, 0 } end
  return normal{ 1 - d[3], d[2], -d[1], 0 }
end

--- Returns the axes for a case's options. g: gravity [m/s2]; point, vector: from the case's
-- axes to the world's; local_point, local_vector: back.
function frame.new(options)
  local q, at, g = { 1, 0, 0, 0 }, options.at or { 0, 0, 0 }, 9.81
  if options.gravity then
    local v = options.gravity
    g = (v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2) ^ 0.5
    if g > 0 then q = hang(v, g) end
  end
  if options.rotation then q = vec.multiply(normal(options.rotation), q) end
  local back = { q[1], -q[2], -q[3], -q[4] }
  local f = { g = g, quaternion = q }
  function f.vector(x, y, z) return turn(q, { x, y, z }) end
  function f.point(x, y, z)
    local p = turn(q, { x, y, z })
    return { p[1] + at[1], p[2] + at[2], p[3] + at[3] }
  end
  function f.local_vector(v) return turn(back, v) end
  function f.local_point(p) return turn(back, { p[1] - at[1], p[2] - at[2], p[3] - at[3] }) end
  f.gravity = f.vector(0, 0, -g)
  return f
end

--- Returns the product of two turns.
frame.product = vec.multiply

return frame
