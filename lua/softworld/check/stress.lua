-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest stress of the outermost fibres in all steps, from tension and bending, of a solid wire.
-- @module softworld.check.stress
local terms = require "softworld.check.terms"

return { name = "max_stress", unit = "Pa", side = "max", peaks = true, on = "wire", edges = "both",
  asked = true,
  terms = terms.stress,
  label = "largest stress of the outermost fibres, of a solid wire", missing = "allowed stress",
  value = function(entry)
    local value, s, time = entry.object:max_stress()
    return { value = value, s = s, time = time }
  end,
  reference = function() return 1e8 end }
