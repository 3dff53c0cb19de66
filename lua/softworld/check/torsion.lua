-- SPDX-License-Identifier: GPL-3.0-or-later
--- Torsion per metre, M_t / GJ: the largest of all steps, in any model that the wire had.
-- @module softworld.check.torsion
local checks = require "softworld.checks"

return { name = "max_torsion", unit = "rad/m", side = "max", peaks = true, on = "wire", asked = true,
  label = "largest torsion per metre", missing = "allowed torsion",
  value = function(entry)
    local GJ = entry.object.beam.GJ
    if not (GJ and GJ > 0) then return nil end
    local known, torsion, s, time = pcall(entry.object.max_torsion, entry.object)
    if known then return { value = torsion, s = s, time = time } end
    if checks.is_interrupt(torsion) then error(torsion, 0) end
    return { value = 0 / 0, note = ("a %s bears no twist, so its torsion is not known; take a rod"):format(
      entry.object.model) }
  end,
  reference = function(entry) return 0.1 / entry.object.radius end }
