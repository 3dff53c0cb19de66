-- SPDX-License-Identifier: GPL-3.0-or-later
--- Temperatures to which a wire is exposed in the zones it enters in any step, against the class of its
-- cable. A wire takes the temperature of a zone at once; the time to warm up is neglected.
-- @module softworld.check.temperature
local core = require "softworld.core"

local worse = { max = function(a, b) return a > b end, min = function(a, b) return a < b end }

-- Widens the value by the zones that the wire may have entered between steps. Of several, the worst counts.
local function perhaps(entry, side, best)
  local way, sure = side == "max" and "high" or "low", best ~= nil
  for _, zone in ipairs(core.zones(entry.object)) do
    local maybe = zone.temperature and zone.gap and zone.gap >= 0 and zone.between < 0
    if maybe and not best then
      best = { value = zone.temperature, low = -math.huge, high = math.huge }
      best[way] = zone.temperature
      best.note = ("perhaps in zone '%s' between steps"):format(zone.name)
    elseif maybe and worse[side](zone.temperature, best[way] or best.value) then
      best[way] = zone.temperature
      if not sure then best.value = zone.temperature end
      best.note = ("%s; perhaps in zone '%s' between steps"):format(best.note, zone.name)
    end
  end
  return best
end

-- Returns the worst temperature of the zones that the wire entered, and of those it may have entered.
local function exposed(entry, side)
  local best
  for _, zone in ipairs(core.zones(entry.object)) do
    if zone.temperature and zone.gap and zone.gap < 0
      and (not best or worse[side](zone.temperature, best.value)) then
      best = { value = zone.temperature, s = zone.s, time = zone.time,
        note = ("zone '%s', in it for %.4g s"):format(zone.name, zone.inside) }
    end
  end
  return perhaps(entry, side, best)
end

--- Returns the check of one side: "max" or "min".
return function(side)
  local class = side == "max" and "high" or "low"
  return { name = side .. "_temperature", unit = "degC", side = side, on = "wire",
    label = (side == "max" and "highest" or "lowest") .. " temperature of zones that it enters",
    missing = "temperature class (its wire has no entry of the catalogue)",
    value = function(entry) return exposed(entry, side) end,
    limit = function(entry)
      local known = entry.object:cable()
      if not known then return nil end
      return { value = known.temperature[class], from = "catalogue",
        source = ("%s, %s"):format(known.temperature.source, known.temperature.flag) }
    end }
end
