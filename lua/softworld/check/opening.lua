-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest opening of a gripper's pads in the run, against the gripper's largest possible opening. Jaws that
-- close at once from their widest opening are narrower at the end of the first step. The opening before it
-- therefore counts too: that of the step before, or that with which the pads were made.
-- @module softworld.check.opening
local rated = require "softworld.check.rated"

return { name = "opening", unit = "m", side = "max", on = "gripper", asked = true,
  label = "largest opening of the pads", rated = "stroke", limit = rated "stroke",
  wanted = function(_, entry) return entry.object.rating and entry.object.rating.stroke end,
  value = function(entry, context)
    local series, best, before = entry.object:series(), nil, entry.object.opening
    for i, opening in ipairs(series.opening or {}) do
      local t = series.t[i]
      local known = opening == opening -- not that of a rigid hold
      if known and t <= context.run.start then before = opening end
      if known and t > context.run.start and t <= context.run.time then
        local widest = best and opening or math.max(opening, before)
        if not best or widest > best.value then best = { value = widest, time = t } end
      end
    end
    return best
  end }
