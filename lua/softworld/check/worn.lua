-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a run kept of the wear of a wire: scene:run{ wear = true }.
-- @module softworld.check.worn
local core = require "softworld.core"

local worn = { HOW = "scene:run{ wear = true } records every step" }

--- The places of a wire { { s =, rubbed =, slid =, side = }, ... }; nil where nothing was kept.
function worn.places(entry) return core.worn(entry.object) end

--- A row's value where nothing was kept: it is not known.
function worn.missing()
  return { value = 0, low = 0, high = math.huge, note = "it was not kept: " .. worn.HOW }
end

--- Mark a value as the least that it may be, and say why.
function worn.at_least(value, why)
  value.low, value.high = value.low or value.value, math.huge
  value.note = value.note and value.note .. "; " .. why or why
  return value
end

return worn
