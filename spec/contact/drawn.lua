-- SPDX-License-Identifier: GPL-3.0-or-later
-- Draws a wire that is bent over an obstacle along by three of its edges. Contains no specs.
local core = require "softworld.core"
local vec = require "softworld.vec"

local drawn = { T = 1, H = 0.01 } -- pull [N], edge [m]
local T, H, N = drawn.T, drawn.H, 20 -- edges on each side

local function bent_path(slope, radius, round)
  local path, R, top = {}, math.max(3 * H, 2 * round), radius + 0.1 * H
  for i = -60, 60 do
    local a = i / 60 * slope
    path[#path + 1] = { R * math.sin(a), 0, top + R * (math.cos(a) - 1) }
  end
  local foot, arm = path[1], N * H - R * slope
  table.insert(path, 1, { foot[1] - arm * math.cos(slope), 0, foot[3] - arm * math.sin(slope) })
  path[#path + 1] = { -path[1][1], 0, path[1][3] }
  return path
end

--- Returns the corners of a drum along y of radius R with n facets, turned about its axis [m], [-], [rad].
function drawn.drum(R, n, turned)
  local points = {}
  for i = 0, n - 1 do
    local a = 2 * math.pi * (i + 0.3) / n + turned
    for _, y in ipairs { -0.02, 0.02 } do
      points[#points + 1], points[#points + 2], points[#points + 3] = R * math.cos(a), y, R * math.sin(a)
    end
  end
  return points
end

--- Returns a path half round a peg at the origin, from x = -top to x = top, with straight parts downwards of
-- these lengths [m]. at(x, z) gives the place; swapped: it begins at the other end.
function drawn.half_round(top, near, far, at, swapped)
  local path = { at(-top, -near) }
  for k = 0, 200 do
    local phi = math.pi * (1 - k / 200)
    path[#path + 1] = at(top * math.cos(phi), top * math.sin(phi))
  end
  path[#path + 1] = at(top, -far)
  if swapped then
    for i = 1, #path // 2 do path[i], path[#path + 1 - i] = path[#path + 1 - i], path[i] end
  end
  return path
end

--- Returns the least, mean and largest pull over T. o.taut: T h^2/EI; o.angle: of the bend [rad]; o.round:
-- radius of the obstacle [m]; o.dt [s]; o.fine: factor on the number of edges; o.turn: of everything;
-- o.swap: arc length counts from the other end. put(scene, see) adds the obstacle below the origin, before
-- the wire if o.first.
function drawn.pull(o, radius, put)
  local slope, q = o.angle / 2, o.turn or { 1, 0, 0, 0 }
  local function see(p) return vec.rotate(q, p) end
  local path = bent_path(slope, radius, o.round or 0)
  for i, p in ipairs(path) do path[i] = see(p) end
  if o.swap then for i = 1, #path // 2 do path[i], path[#path + 1 - i] = path[#path + 1 - i], path[i] end end
  local s = core.scene{ gravity = { 0, 0, 0 } }
  if o.first then put(s, see) end
  local w = s:wire{ EA = 1e5, EI = T * H * H / o.taut, mass_per_length = 0.05, radius = radius, path = path,
    segments = math.floor(2 * N * (o.fine or 1)) }
  if not o.first then put(s, see) end
  local x, z = math.cos(slope), math.sin(slope)
  s:force{ kind = "point", on = w, s = o.swap and w.length or 0, force = see{ -T * x, 0, -T * z } }
  s:force{ kind = "damping", mass = 20, on = w }
  local drag = 20 * 0.05 * w.length * H -- damping force at one edge per second [N]
  local pin, dt = s:pin(w, { s = o.swap and 0 or w.length }), o.dt or 0.002
  assert(s:advance({ dt = dt }, 1).ok)
  pin:follow{ points = { { 0, 0, 0 }, see{ 3 * H * x, 0, -3 * H * z } }, relative = true, speed = H,
    law = "linear" }
  local least, most, sum = math.huge, 0, 0
  for i = 1, 100 do
    assert(s:advance({ dt = dt }, 1.5 + 0.02 * i).ok)
    local pull = (vec.norm(pin:force()) - drag) / T
    least, most, sum = math.min(least, pull), math.max(most, pull), sum + pull / 100
  end
  return least, sum, most
end

return drawn
