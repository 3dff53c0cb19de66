-- SPDX-License-Identifier: GPL-3.0-or-later
--- S-N curves: how many cycles of a range of tension or of curvature a wire endures.
--
-- If no curves of a cable are given, those of its copper strands are used: cycles N against the range of
-- strain by the method of universal slopes (S. S. Manson, Fatigue: a complex subject, Experimental Mechanics
-- 5, 1965):
--
--     range = 3.5 (Su / E) N^-0.12 + D^0.6 N^-0.6
--
-- with tensile strength Su, Young's modulus E and ductility at fracture D of soft-annealed copper. A range of
-- curvature strains the outermost fibre of a strand of diameter d by d/2 times the range if strands slip on
-- one another, and that of the conductor of diameter Dc by Dc/2 times the range if they stick. A range of
-- tension F strains the strands by F / (E A).
--
-- Uncertainty: life by a factor of 5 either way (assumed: scatter of tests, D from 0.6 to 1.6). On the
-- short side strands also stick, and half of them carry the tension, as in the spread of EA. On the long
-- side the elastic line goes through 76 MPa at 1e8 cycles, which handbooks give for annealed copper C11000.
-- @module softworld.wire.lifecurve
local checks = require "softworld.checks"
local material = require "softworld.wire.material"
local stranding = require "softworld.wire.stranding"

local lifecurve = {}

local STRENGTH, DUCTILITY = 220e6, 1.0   -- of annealed copper [Pa], [-]
local ENDURED, CYCLES = 76e6, 1e8        -- amplitude of stress, and its cycles [Pa], [-]
local ELASTIC, PLASTIC = -0.12, -0.6     -- slopes [-]
local SCATTER = 5                        -- factor of life [-]
local LOOSE = 2                          -- largest tension of a strand over the mean [-]
local DECADES, PER_DECADE = 12, 4        -- points of a curve, from 1 cycle on

lifecurve.source = "literature, not of this cable: annealed copper by universal slopes, Manson 1965"

--- Returns a copy of points { range [unit], cycles } with rising ranges and falling cycles, or raises an
-- error without a place.
function lifecurve.read(what, curve, unit)
  if checks.kind(curve) ~= "table" then
    error(("%s must be points { range [%s], cycles }, got %s"):format(what, unit, checks.got(curve)), 0)
  end
  local copy = {}
  checks.only(what, curve, nil, 0)
  for i, point in ipairs(curve) do
    local here = ("%s[%d]"):format(what, i)
    if type(point) ~= "table" then
      error(("%s must be { range [%s], cycles }, got %s"):format(here, unit, checks.got(point)), 0)
    end
    checks.only(here, point, nil, 0)
    copy[i] = { checks.number(here .. "[1]", point[1], 0, " " .. unit, 0, nil, true),
      checks.number(here .. "[2]", point[2], 0, "", 0, nil, true) }
    local before = copy[i - 1]
    if before and not (copy[i][1] > before[1] and copy[i][2] < before[2]) then
      error(("%s: each range must be larger than the one before, and have fewer cycles"):format(here), 0)
    end
  end
  if #copy < 2 then
    error(("%s has fewer than 2 points { range [%s], cycles }"):format(what, unit), 0)
  end
  return copy
end

--- Returns the range of strain that annealed copper endures for a number of cycles [-].
function lifecurve.strain(cycles, elastic)
  elastic = elastic or 3.5 * STRENGTH / material "copper".E.value
  return elastic * cycles ^ ELASTIC + DUCTILITY ^ 0.6 * cycles ^ PLASTIC
end

-- Returns points { range, cycles }: a range of 1 strains by `strain`; life is `times` as long.
local function curve_of(strain, times, elastic)
  local list = {}
  for k = DECADES * PER_DECADE, 0, -1 do
    local cycles = 10 ^ (k / PER_DECADE)
    list[#list + 1] = { lifecurve.strain(cycles, elastic) / strain, cycles * times }
  end
  return list
end

--- Returns the curves of a copper construction { curve =, bending = (points), low =, high = (the same, for
-- the least and the most damage), strain = { slip, stick } [m]: strain over curvature, source =, flag = };
-- nil for others.
function lifecurve.of(construction)
  if construction.conductor ~= "copper" then return nil end
  local E = material "copper".E.value
  local pull = 1 / (E * stranding.metal_area(construction))
  local slip, stick = construction.strand_diameter / 2, stranding.conductor_diameter(construction) / 2
  local long = 2 * ENDURED / E / CYCLES ^ ELASTIC
  return { curve = curve_of(pull, 1), bending = curve_of(slip, 1),
    low = { curve = curve_of(pull, SCATTER, long), bending = curve_of(slip, SCATTER, long) },
    high = { curve = curve_of(LOOSE * pull, 1 / SCATTER), bending = curve_of(stick, 1 / SCATTER) },
    strain = { slip, stick }, source = lifecurve.source, flag = "guessed" }
end

return lifecurve
