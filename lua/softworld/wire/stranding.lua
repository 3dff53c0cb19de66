-- SPDX-License-Identifier: GPL-3.0-or-later
--- Mass and stiffness of an insulated stranded conductor, from its parts.
--
-- n strands of diameter d are bunched to a conductor of diameter
-- Dc = d sqrt(n / fill), fill = 0.75 (seven touching strands fill 0.778, nineteen
-- 0.76); the insulation fills the ring from Dc to the outer diameter D.
--
--     A  = n pi d^2 / 4                                    metal [m2]
--     m  = rho_c A / cos b + rho_i pi (D^2 - Dc^2) / 4     [kg/m]
--     EA = E_c A cos^3 b + E_i pi (D^2 - Dc^2) / 4         [N]
--
-- with the mean lay angle b of strands laid with a pitch of 15 Dc: tan b =
-- 2 pi / 45. Bending, with strands that slip freely on one another, and with strands
-- that stick to one another like a solid section of the same metal area:
--
--     EI slip  = n E_c pi d^4 / 64         + E_i pi (D^4 - Dc^4) / 64
--     EI stick = fill E_c pi Dc^4 / 64     + E_i pi (D^4 - Dc^4) / 64
--
-- Torsion is the same with G and twice the section moment. In reality strands stick
-- in slight bending and slip in strong bending.
-- @module softworld.wire.stranding
local material = require "softworld.wire.material"

local stranding = { fill = 0.75, pitch = 15 }

local pi = math.pi
local lay_angle = math.atan(2 * pi / (3 * stranding.pitch))

--- Returns the diameter of the bunched strands [m].
function stranding.conductor_diameter(c)
  if c.strands == 1 then return c.strand_diameter end
  return c.strand_diameter * math.sqrt(c.strands / stranding.fill)
end

--- Returns the area of the metal [m2].
function stranding.metal_area(c) return c.strands * pi * c.strand_diameter ^ 2 / 4 end

-- Computes with "value", "low" or "high" of every material. D: outer diameter [m].
local function with(which, c, D)
  local metal, cover = material(c.conductor), material(c.insulation)
  local n, d, Dc = c.strands, c.strand_diameter, stranding.conductor_diameter(c)
  local A, ring = stranding.metal_area(c), pi * (D ^ 2 - Dc ^ 2) / 4
  local free, solid = n * pi * d ^ 4 / 64, stranding.fill * pi * Dc ^ 4 / 64
  local tube = pi * (D ^ 4 - Dc ^ 4) / 64
  local E, G, Ei, Gi = metal.E[which], metal.G[which], cover.E[which], cover.G[which]
  local lay = lay_angle
  if n == 1 then solid, lay = free, 0 end
  return {
    mass = metal.density[which] * A / math.cos(lay) + cover.density[which] * ring,
    EA = E * A * math.cos(lay) ^ 3 + Ei * ring, ring_EA = Ei * ring,
    EI = { slip = E * free + Ei * tube, stick = E * solid + Ei * tube },
    GJ = { slip = 2 * (G * free + Gi * tube), stick = 2 * (G * solid + Gi * tube) },
  }
end

--- Returns mass_per_length, EA, EI and GJ of a construction { strands =, strand_diameter =
-- [m], conductor =, insulation = (names of materials) } with the outer diameter
-- { value =, low =, high = } [m]. Each is { value, low, high }; EI and GJ also have
-- slip and stick, and their spread covers the lowest and highest values of these.
function stranding.compute(c, D)
  local Dc = stranding.conductor_diameter(c)
  local usual = with("value", c, D.value)
  local least, most = with("low", c, math.max(D.low, Dc)), with("high", c, D.high)
  local out = {
    mass_per_length = { value = usual.mass, low = least.mass, high = most.mass },
    -- loose strands carry only half of it until they have straightened
    EA = { value = usual.EA, low = least.ring_EA + (least.EA - least.ring_EA) / 2, high = most.EA },
  }
  for _, key in ipairs { "EI", "GJ" } do
    out[key] = { slip = usual[key].slip, stick = usual[key].stick,
      low = least[key].slip, high = most[key].stick }
  end
  return out
end

return stranding
