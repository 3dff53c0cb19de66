-- SPDX-License-Identifier: GPL-3.0-or-later
--- Cycle time: the duration of the run.
-- @module softworld.check.cycle_time
return { name = "cycle_time", unit = "s", side = "max", on = "run", asked = true, label = "cycle time",
  missing = "allowed cycle time",
  value = function(_, context) return { value = context.run.time - context.run.start } end }
