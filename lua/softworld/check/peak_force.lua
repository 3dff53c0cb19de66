-- SPDX-License-Identifier: GPL-3.0-or-later
--- Peak force of a gripper on its wires, the mean over the window that moves along (see help
-- "peaks"). A blow of few steps may be up to twice as large.
-- @module softworld.check.peak_force
return { name = "peak_force", unit = "N", side = "max", on = "gripper", label = "peak force",
  missing = "rating of the gripper",
  value = function(entry, context)
    local m = entry.object:over(context.run.start, context.run.time)
    if m.duration == 0 and not m.peak_force_time then return nil end
    local v = { value = m.peak_force, time = m.peak_force_time, note = m.peak_force_note }
    if m.peak_force_coarse then v.low, v.high = v.value, 2 * v.value end
    return v
  end }
