-- SPDX-License-Identifier: GPL-3.0-or-later
-- How stiff is this cable? Clamp it level, measure how far its free end droops, and let the
-- simulation look for the bending stiffness that droops as far.
local sw = require "softworld"

local length, mass_per_length, measured = 0.8, 0.03, 0.3777 -- [m], [kg/m], [m]

local function droop(EI)
  local scene = sw.scene {}
  local cable = scene:wire { EI = EI, EA = 1e4, mass_per_length = mass_per_length, radius = 0.003,
    from = { 0, 0, 0 }, to = { length, 0, 0 }, segments = 60 }
  scene:clamp(cable, { s = 0 })
  assert(scene:settle().ok)
  return -cable:position(length)[3]
end

local function disagreement(EI) return (droop(EI) - measured) ^ 2 end

local found = sw.tune.minimise { f = disagreement, from = 0.005, to = 0.2 }
assert(found.ok, found.reason)
print(("EI = %.5f N m2 after %d settles, droop %.5f m"):format(found.x, found.evaluations,
  droop(found.x)))
