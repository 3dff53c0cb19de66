-- SPDX-License-Identifier: GPL-3.0-or-later
--- Bend radius at the inside of the bend, against the limit of a class of use: the smallest of all steps, so
-- that of the moving wire too. Inside: radius of the centre line less that of the wire (IEC 62440).
-- @module softworld.check.bend_radius
local bendrule = require "softworld.wire.bendrule"
local cable = require "softworld.cable"
local edges = require "softworld.check.edges"

local function limit(entry, context)
  local known = entry.object:cable()
  if not known then return nil end
  local use = context.use or entry.use
  local inside = cable.bend_limit(known, use, 2 * entry.object.radius)
  local own = known.bend[use or known.bend.use]
  return { value = inside, from = own and "catalogue" or "standard",
    source = ("%s for %s"):format(own and known.name or bendrule.source, use or known.bend.use) }
end

return { name = "min_bend_radius", unit = "m", side = "min", peaks = true, on = "wire", edges = "low",
  label = "smallest radius of the inside of a bend",
  missing = "bend (its wire has no entry of the catalogue)",
  value = function(entry)
    local radius, s, time = entry.object:min_bend_radius()
    local skin, sharp = entry.object.radius, edges.sharpness(entry.object)
    return { value = radius - skin, inside = skin, sharp = sharp, s = s, time = time }
  end,
  limit = limit,
  reference = function(entry) return 8 * entry.object.radius end }
