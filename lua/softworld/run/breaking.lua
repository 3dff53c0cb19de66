-- SPDX-License-Identifier: GPL-3.0-or-later
--- Computes the breaking load of a conductor from its construction. See help "breaking".
-- @module softworld.run.breaking
local stranding = require "softworld.wire.stranding"

-- Tensile strength of soft-annealed conductors [Pa]: value, low, high. Copper as in EN 13602 (Cu-ETP
-- wire, annealed: 200 MPa and more), aluminium 1350-O.
local strengths = { copper = { 220e6, 200e6, 260e6 }, aluminium = { 75e6, 60e6, 95e6 } }

local breaking = {}

--- Returns the breaking load of a construction [N]: { value, low, high, flag, source }, computed from its
-- conductor; nil if the conductor's strength is not known.
function breaking.load(construction)
  local strength = strengths[construction.conductor]
  if not strength then return nil end
  local area = stranding.metal_area(construction)
  return { value = strength[1] * area, low = strength[2] * area, high = strength[3] * area,
    unit = "N", flag = "computed",
    source = ("area of the %s strands times their strength"):format(construction.conductor) }
end

return breaking
