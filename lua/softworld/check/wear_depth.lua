-- SPDX-License-Identifier: GPL-3.0-or-later
--- Depth worn off a wire, by Archard's law.
-- @module softworld.check.wear_depth
local abrasion = require "softworld.check.abrasion"

return { name = "wear_depth", unit = "m", side = "max", on = "wire", asked = true,
  label = "largest depth worn off", missing = "allowed depth",
  wanted = function(context) return context.abrasion ~= nil end,
  value = function(entry, context)
    local given = context.abrasion
    if not given then
      return { value = 0 / 0, note = "the coefficient is missing; give abrasion = { coefficient = [1/Pa] }" }
    end
    local v = abrasion.largest(entry, context, function(place) return given.coefficient * place.slid end)
    local from = "coefficient " .. abrasion.source(given)
    v.note = v.note and v.note .. "; " .. from or from
    return v
  end,
  reference = function(entry) return entry.object.radius end }
