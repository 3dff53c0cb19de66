-- SPDX-License-Identifier: GPL-3.0-or-later
--- The row of a gripper's peak force or moment.
-- @module softworld.check.peak
local rated = require "softworld.check.rated"

return function(what, unit)
  local peak = "peak_" .. what
  return { name = peak, unit = unit, side = "max", peaks = true, on = "gripper", label = "peak " .. what,
    rated = what, limit = rated(what),
    value = function(entry, context)
      local m = entry.object:over(context.run.start, context.run.time)
      if m.duration == 0 and not m[peak .. "_time"] then return nil end
      local v = { value = m[peak], time = m[peak .. "_time"], note = m[peak .. "_note"] }
      if m[peak .. "_coarse"] then v.low, v.high = v.value, 2 * v.value end
      return v
    end }
end
