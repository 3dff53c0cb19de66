-- SPDX-License-Identifier: GPL-3.0-or-later
--- Torsion per metre, M_t / GJ: the largest of all steps, in any model that the wire had.
-- @module softworld.check.torsion
return { name = "max_torsion", unit = "rad/m", side = "max", peaks = true, on = "wire", asked = true,
  label = "largest torsion per metre", missing = "allowed torsion",
  value = function(entry)
    local GJ = entry.object.beam.GJ
    if not (GJ and GJ > 0) then return nil end
    local torsion, s, time = entry.object:max_torsion()
    return { value = torsion, s = s, time = time }
  end,
  reference = function(entry) return 0.1 / entry.object.radius end }
