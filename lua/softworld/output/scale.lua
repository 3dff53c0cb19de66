-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scales of colours for quantities at nodes, as in the player.
-- @module softworld.output.scale
local number = require "softworld.output.number"

local scale = {}

--- Quantities by their name in frames: label and unit.
scale.quantities = {
  tension = { label = "Tension", unit = "N" }, curvature = { label = "Curvature", unit = "1/m" },
  contact = { label = "Contact force", unit = "N" },
  twist_moment = { label = "Twist moment", unit = "N m" }, stress = { label = "Stress", unit = "Pa" },
}

--- Their names, in order.
scale.names = { "contact", "curvature", "stress", "tension", "twist_moment" }

local function stops(text)
  local list = {}
  for hex in text:gmatch "%x+" do
    local n = tonumber(hex, 16)
    list[#list + 1] = { (n >> 16) / 255, (n >> 8 & 255) / 255, (n & 255) / 255 }
  end
  return list
end

local sequence = stops "3a5fcd 2196c8 21b59a 86c440 e6c229 f2871e dc3522"
local around_zero = stops "2360c9 6f9bdc c3cfdd e0dcd6 e8c0a8 dd7d55 c9341c"
local grey = { 0.54, 0.56, 0.60 } -- for NaN

--- Returns a scale from the least to the largest value. If the values lie on both sides of 0 (the negative
-- ones by more than 5 % of the largest), 0 is in the middle.
-- @tparam string name of the quantity
-- @tparam number low
-- @tparam number high
-- @treturn table `low, high, label, unit`, `at(x)` a colour {r, g, b}, `text(x)` with its unit
function scale.new(name, low, high)
  local signed = low < 0 and high > 0 and -low > 0.05 * high
  if signed then
    high = math.max(high, -low)
    low = -high
  end
  local list, span = signed and around_zero or sequence, high > low and high - low or 1
  local known = scale.quantities[name]
  local self = { low = low, high = high, label = known.label, unit = known.unit }
  function self.at(x)
    if x ~= x then return grey end
    local place = math.max(0, math.min(1, (x - low) / span)) * (#list - 1)
    local k = math.min(#list - 2, math.floor(place))
    local a, b, t = list[k + 1], list[k + 2], place - k
    return { a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), a[3] + t * (b[3] - a[3]) }
  end
  function self.text(x)
    local digits, unit = number.engineering(x, known.unit)
    if digits:find("%.") and not digits:find "e" then digits = digits:gsub("0+$", ""):gsub("%.$", "") end
    return digits .. " " .. unit
  end
  return self
end

--- Returns the colours of nodes, flat, three numbers each.
function scale.colours(self, values, times)
  local out, n = {}, 0
  for _, x in ipairs(values) do
    local c = self.at(x)
    for _ = 1, times or 1 do
      out[n + 1], out[n + 2], out[n + 3] = c[1], c[2], c[3]
      n = n + 3
    end
  end
  return out
end

return scale
