-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest pull of a tie in a single step over its strength; also for one that broke in the run.
-- @module softworld.check.strength_used
return { name = "strength_used", unit = "-", side = "max", peaks = true, on = "tie",
  label = "largest pull of the tie, as a share of its strength", missing = "allowed share of the strength",
  value = function(entry, context)
    local tie = entry.object
    local broken = tie.broken
    if not tie.strength or broken and broken.time <= context.run.start then return nil end
    if broken then
      return { value = math.max(1, broken.force / tie.strength), time = broken.time, s = tie.s,
        note = "it broke" }
    end
    local m = tie:over(context.run.start, context.run.time)
    return { value = m.raw_peak_force / tie.strength, time = m.raw_peak_force_time, s = tie.s }
  end,
  limit = function()
    return { value = 1 - 1e-9, from = "definition", source = "at its strength a tie breaks" }
  end,
  reference = function() return 1 end }
