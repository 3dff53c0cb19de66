-- SPDX-License-Identifier: GPL-3.0-or-later
--- Work of friction per area of the wire's surface.
-- @module softworld.check.friction_work
local abrasion = require "softworld.check.abrasion"

return { name = "friction_work", unit = "J/m2", side = "max", on = "wire", asked = true,
  label = "largest work of friction per area", missing = "allowed work of friction",
  value = function(entry, context)
    return abrasion.largest(entry, context, function(place) return place.rubbed end)
  end }
