-- SPDX-License-Identifier: GPL-3.0-or-later
--- Slip margin of pads: friction over what the normal forces allow while they hold, as a mean over the
-- window of peaks; 1 means slip.
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
    return { value = m.peak_margin, time = m.peak_margin_time, note = note }
  end,
  limit = function() return { value = SLIPS, from = "definition", source = "at 1 the wire slips" } end,
  reference = function() return 1 end }
