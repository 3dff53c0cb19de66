-- SPDX-License-Identifier: GPL-3.0-or-later
-- How stiff is a cable? Clamp it horizontally and measure how far its free end droops. A study finds the
-- bending stiffness with which the simulated cable droops as far.
local sw = require "softworld"
local length, measured = 0.8, 0.3777 -- [m]

local study = sw.study { name = "stiffness", parameters = { EI = { 0.005, 0.2, unit = "N m2", log = true } },
  evaluate = function(p)
    local scene = sw.scene {}
    local cable = scene:wire { EI = p.EI, EA = 1e4, mass_per_length = 0.03, radius = 0.003,
      from = { 0, 0, 0 }, to = { length, 0, 0 }, segments = 60 }
    scene:clamp(cable, { s = 0 })
    assert(scene:settle().ok)
    local droop = -cable:position(length).z
    return { droop = droop, off = (droop - measured) ^ 2 }
  end }

local found = study:minimise("off", { method = "bobyqa", starts = 1 })
assert(found.ok, found.reason)
print(("EI = %.5f N m2 after %d settles, droop %.5f m"):format(found.best.EI, found.evaluations,
  found.best.droop))
