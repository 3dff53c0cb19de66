-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a run kept of the wear of a wire: scene:run{ wear = true }.
-- @module softworld.check.worn
local core = require "softworld.core"

local worn = { LINE = { rod = true, string = true }, -- models whose wear is kept
  HOW = "scene:run{ wear = true } keeps it of every step" }

--- The places of a wire { { s =, rubbed =, slid =, side = }, ... }, and nil or why they are not of the whole
-- run; nil where nothing was kept.
function worn.of(entry)
  local places, partial = core.worn(entry.object)
  if not places then return nil end
  return places, partial and "the wire was a mesh of particles for a while, of which nothing is kept" or nil
end

--- A row's value where nothing was kept: it is not known.
function worn.missing(entry)
  local note = worn.LINE[entry.object.model] and "it was not kept: " .. worn.HOW
    or "it is not kept of a mesh of particles; with model = 'rod' it is"
  return { value = 0, low = 0, high = math.huge, note = note }
end

--- Mark a value as the least that it may be, and say why.
function worn.at_least(value, why)
  value.low, value.high = value.low or value.value, math.huge
  value.note = value.note and value.note .. "; " .. why or why
  return value
end

return worn
