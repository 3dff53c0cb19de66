-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest force of a clip's lips on the wire, at the last insertion in the run, or the one under way.
-- A wire that goes in askew takes less than lips that yield only together.
-- @module softworld.check.insertion_force
local askew = require "softworld.check.askew"

return { name = "insertion_force", unit = "N", side = "max", peaks = true, on = "clip", asked = true,
  label = "largest force on the way into the clip", missing = "allowed insertion force",
  value = function(entry, context)
    local clip, into = entry.object, entry.object.inserted
    local here = into and into.time > context.run.start
    if not here and clip:state() ~= "inserting" then return nil end
    local value = { value = clip.peak_insertion_force, s = here and into.s or nil,
      time = here and into.time or nil, note = not here and "the wire is not in yet" or nil }
    local why = here and value.value < clip.insertion and askew.why(clip, context.run)
    if why then value.low, value.high, value.note = value.value, clip.insertion, why end
    return value
  end,
  reference = function(entry) return entry.object.insertion end }
