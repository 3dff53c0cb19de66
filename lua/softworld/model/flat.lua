-- SPDX-License-Identifier: GPL-3.0-or-later
--- Flattening of a section between two faces that press on it: a solid wire as a cylinder, a hollow one as a
-- ring, a cable as its insulation alone.
-- @module softworld.model.flat
local material = require "softworld.wire.material"

local flat = {}

local POISSON = 0.4 -- Poisson's ratio where EI and GJ do not tell it [-]
local SOLID = 1e-6  -- relative difference up to which EI counts as that of a solid wire with this EA [-]
local HOLLOW = 0.4  -- inner over outer radius from which ring theory holds [-]
local SHEAR = 1.2   -- shear factor of a ring's rectangular section [-]
local THIN = math.pi / 4 - 2 / math.pi -- approach of a thin ring, over F R^3/EI [-]
local FULL = 0.1    -- largest flattening for which springs are chosen, also used if it is not known [-]

flat.thin = THIN

--- Returns the body that is pressed: { radius [m], E [Pa], of = owner of that modulus, nu [-] }; for a tube
-- also inner and wall [m]; for a cable cable = true. The wire gives E, or EA and EI; if these belong to one
-- material they also give the inner radius. known = false: they do not, and E is the largest possible value.
function flat.body(wire)
  local entry, r = wire:cable(), wire.radius
  local beam = wire:get()
  local body = { radius = r, nu = POISSON, of = "the wire", known = true, name = wire.name }
  if entry then
    local word = entry.construction and entry.construction.insulation
    local known = word and material.find(word)
    body.cable, body.known = true, known and known.E and true or false
    body.E, body.of = body.known and known.E.value or beam.EA / (math.pi * r * r), word or "the wire"
    return body
  end
  local more = type(beam.EI) == "number" and 4 * beam.EI / (beam.EA * r * r) - 1 or -1 -- (inner/r)^2
  local inner = more >= HOLLOW ^ 2 and more < 1 - SOLID and more ^ 0.5 * r or 0
  body.E = beam.EA / (math.pi * (r * r - inner * inner))
  body.known = inner > 0 or math.abs(more) <= SOLID * (1 + more)
  local nu = body.known and beam.GJ and beam.EI / beam.GJ - 1 or -1
  if nu >= 0 and nu < 0.5 then body.nu = nu end
  if inner > 0 then
    body.inner, body.wall = inner, r - inner
    body.of = ("a tube with a wall of %.3g mm, computed from EA and EI"):format(1e3 * body.wall)
  end
  return body
end

--- Returns the approach of opposite line loads on a ring over the load per length [1/Pa]: Roark's Formulas
-- for Stress and Strain (Young, Budynas), table 9.2, case 1, with stretch and shear of the wall, in plane
-- strain.
function flat.ring(body)
  local mean, wall = (body.radius + body.inner) / 2, body.wall
  local alpha = wall ^ 2 / (12 * mean ^ 2)
  local beta = 2 * (1 + body.nu) * SHEAR * alpha
  local k1, k2 = 1 - alpha + beta, 1 - alpha
  return (math.pi * k1 / 4 - 2 * k2 ^ 2 / math.pi) * 12 * (1 - body.nu ^ 2) * (mean / wall) ^ 3 / body.E
end

--- Returns the approach of two faces that press with q [N/m], over the width. Solid cylinder: Johnson,
-- Contact Mechanics, 1985, section 5.6.
function flat.share(body, q)
  if q <= 0 then return 0 end
  if body.inner then return q * flat.ring(body) / (2 * body.radius) end
  local r, soft = body.radius, (1 - body.nu ^ 2) / (math.pi * body.E)
  local half = (4 * q * r * soft) ^ 0.5 -- half width of the contact strip [m]
  return 2 * q * soft * math.max(1, 2 * math.log(4 * r / half) - 1) / (2 * r)
end

--- Returns the line force over the approach [Pa] at a flattening of at most FULL, by bisection.
function flat.stiffness(body, share)
  share = math.min(share, FULL)
  local low, high = 0, body.E * body.radius
  for _ = 1, 60 do
    local q = (low + high) / 2
    if flat.share(body, q) < share then low = q else high = q end
  end
  return high / (2 * body.radius * share)
end

--- Returns the bending stiffness of a thin wall at the radius `middle` that gives a tube the ring's approach
-- [N m].
function flat.wall_bending(body)
  local middle = ((body.radius ^ 2 + body.inner ^ 2) / 2) ^ 0.5 -- with the tube's EA it has the tube's EI
  return THIN * middle ^ 3 / flat.ring(body)
end

return flat
