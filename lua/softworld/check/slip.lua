-- SPDX-License-Identifier: GPL-3.0-or-later
--- Slip margin of pads: friction and its moment over what the touches can resist while they hold, as a mean
-- over the window of peaks; 1 means slip. A wire that slid or turned by more than the gripper's
-- slip_tolerance has slipped, whatever the mean is: one end of a wire that turns may stick for a while.
-- @module softworld.check.slip
local SLIPS = 1 - 1e-9 -- a sliding wire has 1 within rounding [-]
local STILL = 1e-9 -- shorter slides are rounding [m]

return { name = "peak_margin", unit = "-", side = "max", peaks = true, on = "gripper",
  label = "share of the pads' friction that is used", missing = "allowed share of the friction",
  value = function(entry, context)
    local m = entry.object:over(context.run.start, context.run.time)
    if not m.peak_margin then return nil end
    local slid = m.slip > STILL and ("slid by %.3g m"):format(m.slip) or "did not slide"
    local note = ("%s; raw %.3g"):format(slid, m.raw_peak_margin)
    local value = m.peak_margin
    for _, event in ipairs(entry.object.events) do
      local during = event.time > context.run.start and event.time <= context.run.time
      if event.kind == "slip" and during then value = math.max(value, 1) end
    end
    return { value = value, time = m.peak_margin_time, note = note }
  end,
  limit = function() return { value = SLIPS, from = "definition", source = "at 1 the wire slips" } end,
  reference = function() return 1 end }
