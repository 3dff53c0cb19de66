-- SPDX-License-Identifier: GPL-3.0-or-later
-- Central differences of a trajectory's poses, to check its derivatives.
local differences = {}

function differences.multiply(a, b)
  return { a[1] * b[1] - a[2] * b[2] - a[3] * b[3] - a[4] * b[4],
    a[1] * b[2] + a[2] * b[1] + a[3] * b[4] - a[4] * b[3],
    a[1] * b[3] - a[2] * b[4] + a[3] * b[1] + a[4] * b[2],
    a[1] * b[4] + a[2] * b[3] - a[3] * b[2] + a[4] * b[1] }
end

function differences.norm(a)
  local sum = 0
  for i = 1, #a do sum = sum + a[i] ^ 2 end
  return math.sqrt(sum)
end

--- Returns the largest difference of two arrays of numbers.
function differences.apart(a, b)
  local most = 0
  for i = 1, #a do most = math.max(most, math.abs(a[i] - b[i])) end
  return most
end

--- Returns the quaternion of a turn about an axis.
function differences.turn(axis, angle)
  local n, s = differences.norm(axis), math.sin(angle / 2)
  return { math.cos(angle / 2), s * axis[1] / n, s * axis[2] / n, s * axis[3] / n }
end

-- Fourth order: (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12h
function differences.rate(f, t, h)
  local a, b, c, d = f(t - 2 * h), f(t - h), f(t + h), f(t + 2 * h)
  local out = {}
  for i = 1, #a do out[i] = (8 * (c[i] - b[i]) - (d[i] - a[i])) / (12 * h) end
  return out
end

--- Returns the angular velocity from the rotations alone: 2 q' q*.
function differences.angular_velocity(rotation, t, h)
  local q = rotation(t)
  local function alike(at)
    local r = rotation(at)
    local dot = q[1] * r[1] + q[2] * r[2] + q[3] * r[3] + q[4] * r[4]
    return dot < 0 and { -r[1], -r[2], -r[3], -r[4] } or r
  end
  local w = differences.multiply(differences.rate(alike, t, h), { q[1], -q[2], -q[3], -q[4] })
  return { 2 * w[2], 2 * w[3], 2 * w[4] }
end

return differences
