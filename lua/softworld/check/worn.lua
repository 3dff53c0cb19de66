-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a run kept of the wear of a wire: scene:run{ wear = true }.
-- @module softworld.check.worn
local core = require "softworld.core"

local worn = { LINE = { rod = true, string = true }, -- models of which cycles of load are kept
  HOW = "scene:run{ wear = true } keeps it of every step" }

--- The places of a wire { { s =, rubbed =, slid =, side = }, ... }; nil where nothing was kept.
function worn.places(entry) return (core.worn(entry.object)) end

--- The same where cycles of load were kept at them, and nil or why they are not of the whole run.
function worn.of(entry)
  local places, cycles = core.worn(entry.object)
  if not cycles then return nil end
  return places, cycles == "part" and "the wire was a mesh of particles for a while, which keeps no cycles"
    or nil
end

--- A row's value where nothing was kept: it is not known.
function worn.missing()
  return { value = 0, low = 0, high = math.huge, note = "it was not kept: " .. worn.HOW }
end

--- The same where cycles of load are wanted.
function worn.no_cycles(entry)
  local value = worn.missing()
  if worn.places(entry) or not worn.LINE[entry.object.model] then
    value.note = "cycles of load are not kept of a mesh of particles; with model = 'rod' they are"
  end
  return value
end

--- Mark a value as the least that it may be, and say why.
function worn.at_least(value, why)
  value.low, value.high = value.low or value.value, math.huge
  value.note = value.note and value.note .. "; " .. why or why
  return value
end

return worn
