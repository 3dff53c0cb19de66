-- SPDX-License-Identifier: GPL-3.0-or-later
--- The twisting moment at which a straight isotropic rod buckles between two ends that are hinged, or whose
-- tangents are clamped along its axis (A. G. Greenhill 1883); before that its twist is moment L / GJ.
--
-- With m = M L / EI and t = T L^2 / EI (T the tension) the deflection y1 + i y2 obeys
-- y'''' - i m y''' - t y'' = 0: 1, s, exp(i a s), exp(i b s) with a, b = m / 2 -+ q, q^2 = m^2 / 4 - t.
-- Hinged: q = pi. Clamped: 2 q (cos q - cos(m / 2)) - t sin q = 0; tan(m / 2) = m / 2 without tension.
-- @module softworld.calibration.twisted
local twisted = {}

local STEPS = 400  -- intervals of q over pi in the search for a change of sign
local NEAR = 0.02  -- |t| below which the determinant, of order t^2, is interpolated between -NEAR and NEAR
local FREE = 8.986818915715815 -- m without tension: tan(m / 2) = m / 2

local function determinant(q, t)
  return 2 * q * (math.cos(q) - math.cos(math.sqrt(q * q + t))) - t * math.sin(q)
end

-- Returns m at the first q at which the determinant is 0. This q is not below pi, nor the root of -t, where
-- m is 0; the determinant does not change its sign up to there. At pi it is not above 0, and 0 where t is
-- 8 pi^2, 24 pi^2, 48 pi^2 and so on: q is pi there.
local function clamped(t)
  local low = t > 0 and math.pi or math.max(math.pi, math.sqrt(-t))
  local before = t < 0 and determinant(low + 1e-9, t) > 0
  for _ = 1, STEPS do
    local high = low + math.pi / STEPS
    if (determinant(high, t) > 0) ~= before then
      for _ = 1, 80 do
        local middle = 0.5 * (low + high)
        if (determinant(middle, t) > 0) == before then low = middle else high = middle end
      end
      return 2 * math.sqrt(low * low + t)
    end
    low = high
  end
end

--- Returns m at buckling; nil if it buckles without a moment (t <= -4 pi^2 clamped, -pi^2 hinged).
function twisted.moment(t, hinged)
  if hinged then
    return t > -math.pi ^ 2 and 2 * math.sqrt(math.pi ^ 2 + t) or nil
  end
  if t <= -4 * math.pi ^ 2 then return nil end
  if math.abs(t) < NEAR then
    local low, high = clamped(-NEAR), clamped(NEAR)
    return FREE + 0.5 * (high - low) * t / NEAR + 0.5 * (high + low - 2 * FREE) * (t / NEAR) ^ 2
  end
  return clamped(t)
end

--- Returns the compression that buckles the wire without a twist [N]; o as in twisted.angle.
function twisted.limit(o, EI) return (o.ends == "hinged" and 1 or 4) * math.pi ^ 2 * EI / o.length ^ 2 end

--- Returns the angle by which one end is turned at buckling [rad]: o { length =, tension =, ends = }, tension
-- by point. Raises an error if it buckles untwisted.
function twisted.angle(o, tension, EI, GJ)
  local m = twisted.moment(tension * o.length ^ 2 / EI, o.ends == "hinged")
  if not m then error("the compression buckles the wire without any twist", 0) end
  return m * EI / GJ
end

--- Returns the period of a weight on the wire as a torsional pendulum [s], 2 pi sqrt(inertia L / GJ).
function twisted.period(o, GJ) return 2 * math.pi * math.sqrt(o.inertia * o.length / GJ) end

return twisted
