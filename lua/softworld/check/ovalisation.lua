-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest ovalisation of all steps in which the wire was a mesh.
-- @module softworld.check.ovalisation
local checks = require "softworld.checks"
local terms = require "softworld.check.terms"

return { name = "max_ovalisation", unit = "-", side = "max", peaks = true, on = "wire", asked = true,
  terms = terms.one,
  label = "largest ovalisation of a section", missing = "allowed ovalisation",
  value = function(entry)
    local known, value, s, time = pcall(entry.object.max_ovalisation, entry.object)
    if not known then
      if checks.is_interrupt(value) then error(value, 0) end
      return nil -- it has been a line in the whole run
    end
    return { value = value, s = s, time = time }
  end,
  reference = function() return 0.1 end }
