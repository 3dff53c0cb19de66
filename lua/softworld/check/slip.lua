-- SPDX-License-Identifier: GPL-3.0-or-later
--- Slip margin of pads: friction over what the normal forces allow, the largest of all steps; 1: it slips.
-- @module softworld.check.slip
local SLIPS = 1 - 1e-9 -- a wire that slides has 1 but for rounding [-]

return { name = "peak_margin", unit = "-", side = "max", on = "gripper",
  label = "friction used, of what the pads allow", missing = "allowed share of the friction",
  value = function(entry, context)
    local m = entry.object:over(context.run.start, context.run.time)
    return m.peak_margin and { value = m.peak_margin, note = ("slid by %.3g m"):format(m.slip) } or nil
  end,
  limit = function() return { value = SLIPS, from = "definition", source = "at 1 the wire slips" } end,
  reference = function() return 1 end }
