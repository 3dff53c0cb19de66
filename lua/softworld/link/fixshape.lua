-- SPDX-License-Identifier: GPL-3.0-or-later
--- The shape of clips in pictures: a slotted ring with wings at its mouth, on a foot, extruded along its
-- axis.
-- @module softworld.link.fixshape
local vec = require "softworld.vec"

local fixshape = {}

local ARC = 20 -- flat pieces of the ring
local MOUTH = math.rad(42) -- half the angle of the mouth: two thirds of the wire's width
local WALL = 0.5 -- thickness over the seat's radius
local WING = 0.9 -- length of the wings over the seat's radius

-- Returns pairs { inner, outer } of points { across, up } around the ring from one wing to the other.
local function profile(radius)
  local list, wall, wing = {}, WALL * radius, WING * radius
  local function point(angle, r) return { r * math.sin(angle), r * math.cos(angle) } end
  local function ring(angle) return { point(angle, radius), point(angle, radius + wall) } end
  local function tip(side)
    local edge = ring(side * MOUTH)
    local out = { side * wing * math.sin(math.rad(35)), wing * math.cos(math.rad(35)) }
    return { { edge[1][1] + out[1], edge[1][2] + out[2] },
      { edge[2][1] + 0.7 * out[1], edge[2][2] + 0.4 * out[2] } }
  end
  list[1] = tip(1)
  for i = 0, ARC do list[#list + 1] = ring(MOUTH + (2 * math.pi - 2 * MOUTH) * i / ARC) end
  list[#list + 1] = tip(-1)
  return list
end

-- Extrudes a strip of quadrilaterals (pairs of inner and outer points) to both sides along x.
local function extrude(pairs_of, half)
  local v, f = {}, {}
  local function vertex(x, p) v[#v + 1], v[#v + 2], v[#v + 3] = x, p[1], p[2] end
  local function quad(a, b, c, d)
    for _, i in ipairs{ a, b, c, a, c, d } do f[#f + 1] = i end
  end
  for _, p in ipairs(pairs_of) do
    vertex(-half, p[1]) vertex(-half, p[2]) vertex(half, p[1]) vertex(half, p[2])
  end
  local n = #pairs_of
  for i = 0, n - 2 do
    local a, b = 4 * i, 4 * (i + 1)
    quad(a, b, b + 1, a + 1)
    quad(a + 2, a + 3, b + 3, b + 2)
    quad(a + 1, b + 1, b + 3, a + 3)
    quad(a, a + 2, b + 2, b)
  end
  local z = 4 * (n - 1)
  quad(0, 1, 3, 2)
  quad(z, z + 2, z + 3, z + 1)
  return v, f
end

-- Transforms vertices from x along the axis, y across, z towards the mouth to the world.
local function placed(clip, vertices)
  local across, out = vec.cross(clip.direction, clip.axis), {}
  for i = 1, #vertices, 3 do
    for k = 1, 3 do
      out[i + k - 1] = clip.at[k] + vertices[i] * clip.axis[k] + vertices[i + 1] * across[k]
        + vertices[i + 2] * clip.direction[k]
    end
  end
  return out
end

--- Returns the shape of a clip with at, direction, axis, width and a seat of this radius [m].
function fixshape.clip(clip, radius)
  local v, f = extrude(profile(radius), clip.width / 2)
  local low, wide = -radius * (1 + WALL), 0.8 * radius
  local foot, faces = extrude({ { { -wide, low - 0.6 * radius }, { -wide, low + 0.25 * radius } },
    { { wide, low - 0.6 * radius }, { wide, low + 0.25 * radius } } }, clip.width / 2)
  local first = #v // 3
  table.move(foot, 1, #foot, #v + 1, v)
  for _, i in ipairs(faces) do f[#f + 1] = first + i end
  return { name = clip.name, shape = "mesh", vertices = placed(clip, v), indices = f,
    color = { 0.36, 0.42, 0.50 }, transparency = 0 }
end

return fixshape
