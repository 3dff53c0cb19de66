-- SPDX-License-Identifier: GPL-3.0-or-later
--- Remarks on a calibration whose numbers can hardly be meant: units that no cable fits, and single points
-- far from all others.
-- @module softworld.calibration.doubts
local doubts = {}

local DENSITY = { 100, 25000 }  -- of cables, weight over the outer section [kg/m3]
local MODULUS = { 1e3, 1e12 }   -- stiffness over that of a solid bar of modulus 1 Pa [Pa]
local STRETCH = 0.2             -- largest strain of a pull [-]
local SHEAR = 0.3               -- largest shear of the surface by a twist: angle radius / length [-]
local FAR, FEWEST = 8, 6        -- distance over the median one of an outlier, and least number of points [-]

local function outside(value, range) return value < range[1] or value > range[2] end

-- Returns the difference of the largest and the smallest displacement [m].
local function span_of(group)
  local low, high = math.huge, -math.huge
  for _, p in ipairs(group.points) do low, high = math.min(low, p[2]), math.max(high, p[2]) end
  return high - low
end

local function add_pull(said, group)
  local span = span_of(group)
  if span <= STRETCH * group.options.length then return end
  said[#said + 1] = ("pull: the elongations differ by %.3g m, a strain of %.3g; are they in mm?"):format(span,
    span / group.options.length)
end

local function add_plates(said, group, diameter)
  local span = span_of(group)
  if span <= diameter then return end
  said[#said + 1] = ("squeeze: the approaches differ by %.3g m, more than the diameter, %.3g m; are they in "
    .. "mm?"):format(span, diameter)
end

local function add_twist(said, group, diameter)
  local most = 0
  for _, p in ipairs(group.points or {}) do most = math.max(most, p[2]) end
  local shear = most * diameter / 2 / group.options.length
  if shear > SHEAR then
    said[#said + 1] = ("twist: %.4g rad shears the wire's surface by %.2g; is the angle in degrees?"):format(
      most, shear)
  end
end

-- Adds remarks on stiffnesses that no material gives.
local function add_moduli(said, parameters, diameter)
  local bars = { EI = math.pi * diameter ^ 4 / 64, GJ = math.pi * diameter ^ 4 / 32,
    EA = math.pi * diameter ^ 2 / 4 }
  for _, name in ipairs { "EA", "EI", "GJ" } do
    local q = parameters[name]
    if q and q.told ~= false and outside(q.value / bars[name], MODULUS) then
      said[#said + 1] = ("%s = %.3g %s: a solid bar of this diameter would need a modulus of %.2g Pa; are "
        .. "all units right?"):format(name, q.value, q.unit, q.value / bars[name])
    end
  end
end

-- Adds a remark on the point that is far from the fit, compared with half of the points.
local function add_outlier(said, group, residuals)
  local sizes, which = {}, 1
  for k, r in ipairs(residuals) do
    sizes[k] = math.abs(r)
    if sizes[k] > math.abs(residuals[which]) then which = k end
  end
  if #sizes < FEWEST then return end
  local most = sizes[which]
  table.sort(sizes)
  local half = sizes[(#sizes + 1) // 2]
  if most <= FAR * half or half == 0 then return end
  said[#said + 1] = ("%s: %s is %.3g %s off, half of the points are within %.2g %s; check it, or leave "
    .. "it out"):format(group.kind and group.kind.words or group.name, group.points.where(which), most,
      group.unit, half, group.unit)
end

--- Adds remarks to own.said; own as in calibrated.new.
function doubts.add(own)
  local said, diameter, model = own.said, own.outer_diameter.value, own.model
  local density = own.mass_per_length.value / (math.pi / 4 * diameter ^ 2)
  if outside(density, DENSITY) then
    said[#said + 1] = ("mass_per_length = %.3g kg/m and outer_diameter = %.3g m: the density would be %.2g "
      .. "kg/m3; are units right?"):format(own.mass_per_length.value, diameter, density)
  end
  if model.pull then add_pull(said, model.pull) end
  if model.plates then add_plates(said, model.plates, diameter) end
  if model.twist then add_twist(said, model.twist, diameter) end
  add_moduli(said, own.fit.parameters, diameter)
  for _, group in ipairs(model.groups) do
    if group.points and group.points.where then add_outlier(said, group, own.fit.residuals[group.name]) end
  end
end

return doubts
