-- SPDX-License-Identifier: GPL-3.0-or-later
--- Mean force of a gripper over the time in which it holds something.
-- @module softworld.check.mean_force
return { name = "mean_force", unit = "N", side = "max", on = "gripper", asked = true, label = "mean force",
  missing = "allowed mean force",
  value = function(entry, context)
    local m = entry.object:over(context.run.start, context.run.time)
    return m.duration > 0 and { value = m.mean_force } or nil
  end }
