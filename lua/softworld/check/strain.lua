-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest strain of the outermost fibres in all steps, from tension and bending, of a solid wire.
-- @module softworld.check.strain
local terms = require "softworld.check.terms"

return { name = "max_strain", unit = "-", side = "max", peaks = true, on = "wire", edges = "both",
  asked = true,
  terms = terms.one,
  label = "largest strain of the outermost fibres, of a solid wire", missing = "allowed strain",
  value = function(entry)
    local value, s, time = entry.object:max_strain()
    return { value = value, s = s, time = time }
  end,
  reference = function() return 0.01 end }
