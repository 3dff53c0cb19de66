-- SPDX-License-Identifier: GPL-3.0-or-later
--- A quarter-circle wire (its shape without load) stands out level from a clamp and droops: bent in
-- two planes and twisted, static. EI = GJ.
-- Options: weight = w L^3/EI (20; 5 and 80 have exact values too).
-- error(): distance of the tip from the exact tip over L.
-- @module softworld.cases.arc
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

-- Shooting with quaternions, error below 1e-9: weight, tip [L].
local exact = {
  { 5, 0.5526037988, 0.5442878988, -0.4427589746 },
  { 20, 0.3134018081, 0.2903053724, -0.7818443273 },
  { 80, 0.1471340051, 0.1160624307, -0.9128043087 },
}

local points = 2000 -- points of the path

return function(options)
  local f = frame.new(options)
  local row = wires.row(exact, options.weight or 20)
  if not row then error("arc: weight must be one of 5, 20, 80", 2) end
  local scene = sw.scene{ name = "arc", gravity = f.gravity }
  local mass, path, r = 0.02, {}, 2 / math.pi -- [kg/m], [m], [m]
  local EI = mass * f.g / row[1] -- [N m2]
  for i = 0, points do
    local u = math.pi / 2 * i / points
    path[i + 1] = f.point(r * math.sin(u), r * (1 - math.cos(u)), 0)
  end
  local wire = scene:wire{ EA = 1e6 * EI, EI = EI, GJ = EI, mass_per_length = mass, radius = 0.001,
    path = path, segments = options.segments or 50, rest = "path", model = options.model }
  local clamp = scene:clamp(wire, { s = 0, direction = f.vector(1, 0, 0) })
  local c = { name = "arc", scene = scene, wire = wire, clamp = clamp, frame = f,
    exact = { x = row[2], y = row[3], z = row[4], source = "shooting with quaternions" } }

  function c.run(o) return scene:settle(o or {}) end

  function c.measured()
    local tip = f.local_point(wire:position(wire.length))
    return { x = tip[1], y = tip[2], z = tip[3] }
  end

  function c.error()
    local m = c.measured()
    return ((m.x - row[2]) ^ 2 + (m.y - row[3]) ^ 2 + (m.z - row[4]) ^ 2) ^ 0.5
  end
  return c
end
