-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest force of a clip's lips on the wire, at the last insertion in the run, or the one under way.
-- @module softworld.check.insertion_force
return { name = "insertion_force", unit = "N", side = "max", peaks = true, on = "clip", asked = true,
  label = "largest force on the way into the clip", missing = "allowed insertion force",
  value = function(entry, context)
    local clip, into = entry.object, entry.object.inserted
    local here = into and into.time > context.run.start
    if not here and clip:state() ~= "inserting" then return nil end
    return { value = clip.peak_insertion_force, s = here and into.s or nil, time = here and into.time or nil,
      note = not here and "the wire is not in yet" or nil }
  end,
  reference = function(entry) return entry.object.insertion end }
