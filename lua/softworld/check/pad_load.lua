-- SPDX-License-Identifier: GPL-3.0-or-later
--- Line load of pads on the wire: largest force of a finger in any step over the pads' width along the wire.
-- Ends of pads and wires that lie askew press harder locally; see gripper:pressure_map.
-- @module softworld.check.pad_load
return { name = "pad_load", unit = "N/m", side = "max", peaks = true, on = "gripper", asked = true,
  label = "force of a finger over the pads' width", missing = "allowed line load",
  value = function(entry, context)
    local m = entry.object:over(context.run.start, context.run.time)
    local width = entry.object.width
    if not m.peak_squeeze or not (width and width > 0) then return nil end
    return { value = m.peak_squeeze / width }
  end }
