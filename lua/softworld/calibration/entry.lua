-- SPDX-License-Identifier: GPL-3.0-or-later
--- Makes a catalogue entry from a calibration: measured values are flagged so, with their source; the rest is
-- taken from a similar entry, or guessed.
-- @module softworld.calibration.entry
local cable = require "softworld.cable"

local entry = {}

local function source_of(own, key)
  local m = own.model
  local group = key == "EI" and m.sag or key == "GJ" and m.twist or key == "EA" and m.pull
  return group and ("%s: %s"):format(own.source, group.source) or own.source
end

-- Returns a measured value; nil if it was not measured; raises an error if the data did not determine it.
local function measured(own, key)
  local q = own.parameters[key]
  if not q then return nil end
  if q.told == false or not q.low then
    error(("calibration of '%s': the measurements do not determine %s, so there is no catalogue entry; see "
      .. ".remarks")
      :format(own.name, key), 0)
  end
  return { value = q.value, low = q.low, high = q.high, flag = "measured", source = source_of(own, key) }
end

local function weighed(own, known)
  local half = known.sigma and 2 * known.sigma or 0
  return { value = known.value, low = known.value - half, high = known.value + half, flag = "measured",
    source = own.source }
end

local function guessed(value, low, high, source)
  return { value = value, low = low, high = high, flag = "guessed", source = source }
end

local function of_like(own, key)
  if own.like == nil then return nil end
  local like = cable.get(own.like)
  local q = like[key]
  return guessed(q.value, q.low, q.high, ("that of %s, assumed to be alike"):format(like.name))
end

-- Returns EI if it was given, not fitted.
local function given_EI(own)
  local EI = own.model.constants.EI
  return EI and { value = EI, low = EI, high = EI, flag = "measured", source = own.source .. ": given" }
end

--- Returns EA if it was not measured [N]: of a similar entry, or as if half of the mass [kg/m] were copper.
function entry.EA(like, mass)
  if like ~= nil then return cable.get(like).EA.value end
  return 115e9 * mass / 2 / 8930
end

--- Returns the fields of an entry, as sw.cable.define takes them.
function entry.fields(own)
  local EI = measured(own, "EI") or given_EI(own)
  if not EI then
    error(("calibration of '%s': a catalogue entry needs EI; give a sag, or EI"):format(own.name), 0)
  end
  local EA = entry.EA(nil, own.mass_per_length.value)
  local like = own.like ~= nil and cable.get(own.like)
  return { name = own.name, description = "calibrated: " .. own.source,
    outer_diameter = weighed(own, own.outer_diameter), mass_per_length = weighed(own, own.mass_per_length),
    EI = EI,
    EA = measured(own, "EA") or of_like(own, "EA")
      or guessed(EA, EA / 10, 2 * EA, "as if half of the mass were copper"),
    GJ = measured(own, "GJ") or guessed(cable.twist_ratio * EI.value, 0.5 * EI.low, 2 * EI.high,
      ("EI times %g as of three measured wires"):format(cable.twist_ratio)),
    friction = of_like(own, "friction") or guessed(0.4, 0.15, 0.8, "range of polymers on steel"),
    temperature = like and { low = like.temperature.low, high = like.temperature.high, flag = "guessed",
      source = "that of " .. like.name } or { low = 0, high = 60, flag = "guessed",
      source = "any insulation of wires" },
    bend = { rule = "IEC 62440", use = like and like.bend.rule and like.bend.use or "fixed", flag = "guessed",
      source = "IEC 62440:2008" } }
end

return entry
