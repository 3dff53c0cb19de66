-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads what a run recorded of a wire's wear: scene:run{ wear = true }.
-- @module softworld.check.worn
local core = require "softworld.core"

local worn = { HOW = "scene:run{ wear = true } records every step" }

--- Returns the places of a wire { { s =, rubbed =, slid =, side = }, ... }; nil if nothing was recorded.
function worn.places(entry) return core.worn(entry.object) end

--- Returns a row's unknown value, for a run that recorded nothing.
function worn.missing()
  return { value = 0, low = 0, high = math.huge, note = "it was not kept: " .. worn.HOW }
end

--- Marks a value as a lower bound, with the reason.
function worn.at_least(value, why)
  value.low, value.high = value.low or value.value, math.huge
  value.note = value.note and value.note .. "; " .. why or why
  return value
end

return worn
