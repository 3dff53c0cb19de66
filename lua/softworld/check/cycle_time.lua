-- SPDX-License-Identifier: GPL-3.0-or-later
--- Cycle time: the duration of the run.
-- @module softworld.check.cycle_time
local DIGITS = 12 -- of the clock; beyond them differences of its times are rounding [-]

-- Returns the time between two readings of the clock, without their rounding [s].
local function between(start, time)
  local places = DIGITS - math.max(0, math.ceil(math.log(math.max(math.abs(time), 1), 10)))
  return tonumber(("%%.%df"):format(math.max(0, places)):format(time - start))
end

return { name = "cycle_time", unit = "s", side = "max", on = "run", asked = true, label = "cycle time",
  missing = "allowed cycle time",
  value = function(_, context) return { value = between(context.run.start, context.run.time) } end }
