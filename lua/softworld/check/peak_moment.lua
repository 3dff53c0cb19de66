-- SPDX-License-Identifier: GPL-3.0-or-later
--- Peak moment of a gripper about its centre, the mean over the window that moves along (see help
-- "peaks"). A blow of few steps may be up to twice as large.
-- @module softworld.check.peak_moment
return { name = "peak_moment", unit = "N m", side = "max", on = "gripper", label = "peak moment",
  missing = "rating of the gripper",
  value = function(entry, context)
    local m = entry.object:over(context.run.start, context.run.time)
    if m.duration == 0 and not m.peak_moment_time then return nil end
    local v = { value = m.peak_moment, time = m.peak_moment_time, note = m.peak_moment_note }
    if m.peak_moment_coarse then v.low, v.high = v.value, 2 * v.value end
    return v
  end }
