-- SPDX-License-Identifier: GPL-3.0-or-later
--- How tightly a cable may be bent: a multiple of its outer diameter, by use.
--
-- IEC 62440:2008, guide to use of cables up to 450/750 V, for circular flexible
-- thermoplastic cables at (20 +- 10) degC. Its radius is at the inside of the
-- bend; the centre line, which wire:min_bend_radius() measures, is half a diameter
-- farther out.
-- @module softworld.wire.bendrule
local core = require "softworld.core"
local checks = require "softworld.checks"

local bendrule = { source = "IEC 62440:2008", unit = "outer diameters" }

--- Largest outer diameter of the columns [m]; the last has no limit.
bendrule.steps = { 0.008, 0.012, 0.020 }

--- Uses in the order in which they are shown, each with a multiple per column.
bendrule.uses = { "fixed", "termination", "movement", "load", "reeling", "pulleys" }
bendrule.table = {
  fixed = { 4, 5, 6, 6 }, -- laid once
  termination = { 2, 3, 4, 4 }, -- bent carefully where it ends
  movement = { 5, 5, 6, 6 }, -- moves freely
  load = { 9, 9, 9, 10 }, -- moves under mechanical load
  reeling = { 7, 7, 8, 8 },
  pulleys = { 10, 10, 10, 10 },
}

--- Returns the multiple for a use and an outer diameter [m].
function bendrule.factor(use, diameter)
  local column = 1
  while bendrule.steps[column] and diameter > bendrule.steps[column] * (1 + 1e-9) do
    column = column + 1
  end
  return bendrule.table[use][column]
end

--- Returns nil if the use is known, else a message.
function bendrule.unknown(use)
  if bendrule.table[use] then return nil end
  local near = type(use) == "string" and core.nearest(use, bendrule.uses)
  return ("there is no use '%s'; %s"):format(checks.shown(use), near
    and ("did you mean '%s'?"):format(near) or "known are " .. table.concat(bendrule.uses, " "))
end

return bendrule
