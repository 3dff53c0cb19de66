-- SPDX-License-Identifier: GPL-3.0-or-later
-- A bead on a rail, for specs of sliders.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local G = 9.81

-- A short stiff rod across the plane of motion, carried by a slider at its middle.
local function bead(o)
  local scene = sw.scene{ gravity = o.gravity or { 0, 0, -G } }
  local x, z = o.x or 0, o.z or 0
  local wire = scene:wire{ E = 1e10, density = 1000, radius = 0.002, segments = 8,
    from = { x, -0.05, z }, to = { x, 0.05, z } }
  return scene, wire, scene:slider(wire, { s = 0.05, direction = o.direction, friction = o.friction,
    from = o.from, to = o.to, path = o.path, closed = o.closed })
end

-- Points of a circle in the plane y = 0 about the origin; fraction: of an arc of this share of the circle.
local function circle(radius, count, fraction)
  local points = {}
  for i = 0, count - (fraction and 0 or 1) do
    local a = 2 * math.pi * (fraction or 1) * i / count - (fraction and math.pi * fraction or 0)
    points[i + 1] = { radius * math.sin(a), 0, -radius * math.cos(a) }
  end
  return points
end

return { bead = bead, circle = circle }
