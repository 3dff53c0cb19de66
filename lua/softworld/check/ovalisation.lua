-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest ovalisation of all steps, of wires that are meshes.
-- @module softworld.check.ovalisation
return { name = "max_ovalisation", unit = "-", side = "max", on = "wire", asked = true,
  label = "largest ovalisation of a section", missing = "allowed ovalisation",
  value = function(entry)
    if entry.object.model == "rod" or entry.object.model == "string" then return nil end
    local value, s, time = entry.object:max_ovalisation()
    return { value = value, s = s, time = time }
  end,
  reference = function() return 0.1 end }
