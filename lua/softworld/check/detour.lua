-- SPDX-License-Identifier: GPL-3.0-or-later
--- Detours of a wanted path that a wire leaves out. Each place of the wire may then lie on the path, and the
-- landing error is zero. The wire and the path are therefore gone along together, in order, as in the
-- distance of Frechet; the path may begin before the wire and go on beyond it.
-- @module softworld.check.detour
local vec = require "softworld.vec"

local detour = {}

local SAMPLES = 400 -- points of a path that are compared with the wire [-]
local TINY = 1e-300 -- instead of the length of a path whose points are all at one place [m]

-- Returns samples of a path, with its corners, and the largest distance between two [m]. A closed path is
-- gone along twice, because the wire may begin anywhere on it.
local function samples_of(path, closed)
  local long, list, gap = 0, { path[1] }, 0
  for i = 2, #path do long = long + vec.norm(vec.sub(path[i], path[i - 1])) end
  for _ = 1, closed and 2 or 1 do
    for i = 2, #path do
      local way = vec.sub(path[i], path[i - 1])
      local piece = vec.norm(way)
      local count = math.max(1, math.ceil(SAMPLES * piece / math.max(long, TINY)))
      for k = 1, count do list[#list + 1] = vec.add(path[i - 1], vec.scale(way, k / count)) end
      gap = math.max(gap, piece / count)
    end
  end
  return list, gap
end

-- Returns the distance of p from the line between a and b, without tables: it is called often.
local function distance(p, a, b)
  local ax, ay, az = a[1], a[2], a[3]
  local wx, wy, wz, tx, ty, tz = b[1] - ax, b[2] - ay, b[3] - az, p[1] - ax, p[2] - ay, p[3] - az
  local long = wx * wx + wy * wy + wz * wz
  local share = long > 0 and math.max(0, math.min(1, (tx * wx + ty * wy + tz * wz) / long)) or 0
  tx, ty, tz = tx - share * wx, ty - share * wy, tz - share * wz
  return math.sqrt(tx * tx + ty * ty + tz * tz)
end

-- Returns the largest distance of the path from the wire, both gone along in order as near to each other as
-- possible. forth: 1 if both have the same direction, -1 if not. far[i]: least such distance of the samples
-- from the first one at the wire's start on, if the present one belongs to piece i.
local function along(samples, points, forth)
  local pieces, far, best = math.max(1, #points - 1), {}, math.huge
  for i = 1, pieces do far[i] = math.huge end
  for _, p in ipairs(samples) do
    local before = 0.0 -- the path may begin here
    for i = 1, pieces do
      local k = forth > 0 and i or pieces + 1 - i
      local least = math.min(before, far[i])
      far[i], before = math.max(least, distance(p, points[k], points[k + 1] or points[k])),
        i == 1 and far[i] or least
    end
    best = math.min(best, far[pieces])
  end
  return best
end

--- Returns which share of a path's length is farther than `far` [m] from a line, by samples.
function detour.share_beyond(points, path, far)
  local whole, off = 0, 0
  local samples = samples_of(path)
  for j = 2, #samples do
    local long, least = vec.norm(vec.sub(samples[j], samples[j - 1])), math.huge
    for i = 1, math.max(1, #points - 1) do
      least = math.min(least, distance(samples[j], points[i], points[i + 1] or points[i]))
    end
    whole, off = whole + long, off + (least > far and long or 0)
  end
  return whole > 0 and off / whole or 0
end

--- Returns the largest distance of a path from a wire that follows it, and the error of that by samples [m].
-- points: of the wire's line; near: distance at which a path's ends count as one place [m].
function detour.distance(points, path, near)
  local closed = #path > 2 and vec.norm(vec.sub(path[#path], path[1])) <= near
  local samples, gap = samples_of(path, closed)
  return math.min(along(samples, points, 1), along(samples, points, -1)), gap
end

return detour
