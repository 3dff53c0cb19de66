-- SPDX-License-Identifier: GPL-3.0-or-later
-- The capstan: a string over a cylinder along y, pulled at its start by 1 N. No gravity. When the string is
-- drawn by its end, its tension where it leaves is exp(mu angle) N, and the normal force per length is T/R
-- [N/m].
local sw = require "softworld"

local capstan = { R = 0.05, RADIUS = 0.0015 } -- radii of the cylinder and of the string [m]

--- Returns the scene, its wire 'w', a pin at the end, and the direction in which the end is drawn [-]. args:
-- friction = mu; angle = [rad] of the arc; segments =; around = points of the arc; lead = points of the
-- straight string on both sides, 1 cm apart; EI [N m2] for a rod instead of a string.
function capstan.scene(args)
  local Rw, half = capstan.R + capstan.RADIUS, args.angle / 2
  local function at(a) return { -Rw * math.cos(a), 0, Rw * math.sin(a) } end
  local from, to, path = at(math.pi / 2 - half), at(math.pi / 2 + half), {}
  local c, s, around = math.cos(half), math.sin(half), args.around or 60
  local lead = args.lead or 8
  for i = lead, 1, -1 do path[#path + 1] = { from[1] - 0.01 * i * c, 0, from[3] - 0.01 * i * s } end
  for i = 0, around do path[#path + 1] = at(math.pi / 2 - half + args.angle * i / around) end
  for i = 1, lead do path[#path + 1] = { to[1] + 0.01 * i * c, 0, to[3] - 0.01 * i * s } end
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", EA = 1e4, EI = args.EI or 1e-9, GJ = args.EI, mass_per_length = 0.1,
    radius = capstan.RADIUS, path = path, model = args.EI and "rod" or "string", segments = args.segments }
  scene:obstacle{ shape = "cylinder", radius = capstan.R, length = 1, friction = args.friction,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  scene:force{ kind = "point", on = wire, s = 0, force = { -c, 0, -s } }
  scene:force{ kind = "damping", mass = 20, on = wire }
  return scene, wire, scene:pin(wire, { s = wire.length }), { c, 0, -s }
end

--- Points of a path along which a pin draws the end by a way [m].
function capstan.draw(along, way) return { { 0, 0, 0 }, { way * along[1], 0, way * along[3] } } end

return capstan
