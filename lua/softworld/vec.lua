-- SPDX-License-Identifier: GPL-3.0-or-later
--- Vectors {x, y, z} and orientations {w, x, y, z}, for placing things; never used within a step.
-- @module softworld.vec
local vec = {}

function vec.add(a, b, k)
  k = k or 1
  return { a[1] + k * b[1], a[2] + k * b[2], a[3] + k * b[3] }
end

function vec.sub(a, b) return vec.add(a, b, -1) end
function vec.scale(a, k) return { k * a[1], k * a[2], k * a[3] } end
function vec.dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
function vec.norm(a) return vec.dot(a, a) ^ 0.5 end

function vec.cross(a, b)
  return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end

--- Returns a / |a|, or nil if the length is 0.
function vec.unit(a)
  local n = vec.norm(a)
  return n > 0 and vec.scale(a, 1 / n) or nil
end

--- Returns the component of a perpendicular to the unit vector n.
function vec.across(a, n) return vec.add(a, n, -vec.dot(a, n)) end

--- Returns a turned by the orientation q.
function vec.rotate(q, a)
  local u = { q[2], q[3], q[4] }
  local c = vec.cross(u, a)
  return vec.add(vec.add(a, c, 2 * q[1]), vec.cross(u, c), 2)
end

function vec.conjugate(q) return { q[1], -q[2], -q[3], -q[4] } end

--- Returns the rotation q followed by p.
function vec.multiply(p, q)
  return { p[1] * q[1] - p[2] * q[2] - p[3] * q[3] - p[4] * q[4],
    p[1] * q[2] + p[2] * q[1] + p[3] * q[4] - p[4] * q[3],
    p[1] * q[3] - p[2] * q[4] + p[3] * q[1] + p[4] * q[2],
    p[1] * q[4] + p[2] * q[3] - p[3] * q[2] + p[4] * q[1] }
end

--- Returns the rotation by angle [rad] about a unit axis.
function vec.turn(axis, angle)
  local s = math.sin(angle / 2)
  return { math.cos(angle / 2), s * axis[1], s * axis[2], s * axis[3] }
end

--- Returns the orientation with x along the unit vector x and z as close to the unit vector up as possible.
function vec.facing(x, up)
  local z = vec.unit(vec.across(up, x))
  if not z or math.abs(vec.dot(up, x)) > 0.999 then
    z = vec.unit(vec.across({ 0, 1, 0 }, x)) or vec.unit(vec.across({ 1, 0, 0 }, x))
  end
  return vec.axes(x, vec.cross(z, x))
end

--- Returns the orientation whose axes are x, y and x cross y in the world; x and y are orthogonal unit
-- vectors.
function vec.axes(x, y)
  local z = vec.cross(x, y)
  local m = { { x[1], y[1], z[1] }, { x[2], y[2], z[2] }, { x[3], y[3], z[3] } }
  local best, sign = 1, { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } }
  local function square(k)
    local s = sign[k]
    return 1 + s[1] * m[1][1] + s[2] * m[2][2] + s[3] * m[3][3]
  end
  for k = 2, 4 do
    if square(k) > square(best) then best = k end
  end
  local r = 2 * square(best) ^ 0.5 -- four times the largest component
  local w = { m[3][2] - m[2][3], m[1][3] - m[3][1], m[2][1] - m[1][2] }
  local q = { 0, 0, 0, 0 }
  q[best] = r / 4
  if best == 1 then
    for k = 1, 3 do q[k + 1] = w[k] / r end
    return q
  end
  local i = best - 1
  q[1] = w[i] / r
  for k = 1, 3 do
    if k ~= i then q[k + 1] = (m[i][k] + m[k][i]) / r end
  end
  return q
end

return vec
