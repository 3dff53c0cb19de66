-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest opening of a gripper's pads in the run, against the gripper's largest possible opening.
-- @module softworld.check.opening
local rated = require "softworld.check.rated"

return { name = "opening", unit = "m", side = "max", on = "gripper", asked = true,
  label = "largest opening of the pads", rated = "stroke", limit = rated "stroke",
  wanted = function(_, entry) return entry.object.rating and entry.object.rating.stroke end,
  value = function(entry, context)
    local series, best = entry.object:series(), nil
    for i, opening in pairs(series.opening or {}) do
      local t = series.t[i]
      local inside = t >= context.run.start and t <= context.run.time
      if inside and (not best or opening > best.value) then best = { value = opening, time = t } end
    end
    return best
  end }
