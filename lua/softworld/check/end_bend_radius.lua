-- SPDX-License-Identifier: GPL-3.0-or-later
--- Bend radius at the inside of the bend at the end of the run, against the limit of a cable that is laid
-- once. min_bend_radius checks the moving wire, by the run's own class of use.
-- @module softworld.check.end_bend_radius
local bendrule = require "softworld.wire.bendrule"
local cable = require "softworld.cable"
local edges = require "softworld.check.edges"

local USE = "fixed"

return { name = "end_bend_radius", unit = "m", side = "min", places = true, on = "wire", edges = "low",
  asked = true,
  label = "smallest radius of the inside of a bend at the end",
  missing = "bend (its wire has no entry of the catalogue)",
  wanted = function(context) return context.use ~= nil and context.use ~= USE end,
  value = function(entry, context)
    local radius, s = entry.object:min_bend_radius{ now = true }
    local skin, sharp = entry.object.radius, edges.sharpness(entry.object, { now = true })
    return { value = radius - skin, inside = skin, sharp = sharp, s = s, time = context.run.time }
  end,
  limit = function(entry)
    local known = entry.object:cable()
    if not known then return nil end
    return { value = cable.bend_limit(known, USE, 2 * entry.object.radius),
      from = known.bend[USE] and "catalogue" or "standard",
      source = ("%s for %s"):format(known.bend[USE] and known.name or bendrule.source, USE) }
  end,
  reference = function(entry) return 8 * entry.object.radius end }
