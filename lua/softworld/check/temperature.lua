-- SPDX-License-Identifier: GPL-3.0-or-later
--- Temperatures to which a wire is exposed in the zones it enters in any step, against the class of its
-- cable. A wire takes the temperature of a zone at once; the time to warm up is neglected.
-- @module softworld.check.temperature
local core = require "softworld.core"

local worse = { max = function(a, b) return a > b end, min = function(a, b) return a < b end }

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
  for _, zone in ipairs(core.zones(entry.object)) do
    local perhaps = zone.temperature and zone.gap and zone.gap >= 0 and zone.between < 0
    if perhaps and (not best or worse[side](zone.temperature, best.value)) then
      best = best or { value = zone.temperature, low = -math.huge, high = math.huge }
      best[side == "max" and "high" or "low"] = zone.temperature
      best.note = ("%sperhaps in zone '%s' between steps"):format(best.note and best.note .. "; " or "",
        zone.name)
    end
  end
  return best
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
