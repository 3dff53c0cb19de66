-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest tension of all steps, as a mean over the run's window, against the allowed pull or else the
-- breaking load.
-- @module softworld.check.tension
local core = require "softworld.core"
local terms = require "softworld.check.terms"
local window = require "softworld.run.window"

local YIELD = 0.01 -- strain that no pull in handling reaches [-]

-- Returns the wire's own load, or that of its cable with its spread.
local function limit(entry)
  local own, known = core.data(entry.object).breaking, entry.object:cable()
  local load = known and known.breaking_load
  if load and (not own or own.value == load.value) then
    return { value = load.value, low = load.low, high = load.high, from = "catalogue",
      source = ("breaking load of %s, %s"):format(known.name, load.flag) }
  end
  if not own then return nil end
  return { value = own.value, from = "user", source = ("breaking load of the wire, %s"):format(own.flag) }
end

return { name = "max_tension", unit = "N", side = "max", peaks = true, on = "wire", edges = "both",
  terms = terms.tension,
  label = "largest tension",
  missing = "breaking_load", limit = limit,
  value = function(entry, context)
    local value, s, time, note = window.tension(context.scene, entry.object)
    return { value = value, s = s, time = time, note = note }
  end,
  reference = function(entry)
    local known = limit(entry)
    return known and known.value or YIELD * entry.object.beam.EA
  end }
