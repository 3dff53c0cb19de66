-- SPDX-License-Identifier: GPL-3.0-or-later
--- Least distance of a wire's surface from the zones to keep out of, over the whole motion: at the end of
-- every step, and between steps, where its nodes move on straight lines. A place at distance a before a way w
-- and at distance b after it was never nearer than (a + b - w) / 2, so no sweep through a zone is missed.
-- @module softworld.check.clearance
local core = require "softworld.core"
local terms = require "softworld.check.terms"

return { name = "clearance", unit = "m", side = "min", places = true, on = "wire",
  terms = terms.places,
  label = "smallest distance from forbidden zones", missing = "wanted distance",
  value = function(entry)
    local best
    for _, zone in ipairs(core.zones(entry.object)) do
      if zone.gap and not zone.temperature then
        best = best or { value = math.huge, low = math.huge }
        if zone.gap < best.value then
          best.value, best.s, best.time = zone.gap, zone.s, zone.time
          best.note = ("zone '%s'"):format(zone.name)
        end
        best.low = math.min(best.low, zone.between)
      end
    end
    if best and best.low < best.value - 1e-12 then
      best.high = best.value
      best.note = ("%s; between steps it may have been %.4g m"):format(best.note or "", best.low)
    elseif best then
      best.low = nil
    end
    return best
  end,
  limit = function() return { value = 0, from = "definition", source = "nothing may enter it" } end,
  reference = function(entry) return entry.object.radius end }
