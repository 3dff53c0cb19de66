-- SPDX-License-Identifier: GPL-3.0-or-later
--- Formats numbers for people: four significant digits and a suitable unit prefix.
-- @module softworld.output.number

local number = {}

--- Returns a count with its word: "1 step", "2 steps"; "1 more event".
-- @tparam integer n
-- @tparam string word in the singular
-- @treturn string
function number.count(n, word) return ("%d %s%s"):format(n, word, n == 1 and "" or "s") end

local prefixes = {
  [-12] = "p", [-9] = "n", [-6] = "u", [-3] = "m", [0] = "", [3] = "k", [6] = "M", [9] = "G",
}

-- Units whose first symbol takes a prefix, and the largest exponent of the prefix.
local scalable = {
  N = 9, ["N m"] = 9, ["N s"] = 9, J = 9, W = 9, Pa = 9, Hz = 9, ["N/m"] = 9,
  m = 0, s = 0, ["m/s"] = 0, ["m/s2"] = 0, ["rad/s"] = 3, V = 9, A = 9,
}

--- Returns a number with a given count of significant digits, without an exponent
-- between 1e-4 and 1e6. Trailing zeros stay, because they are known digits.
-- @tparam number x
-- @tparam[opt=4] integer digits
-- @treturn string
function number.digits(x, digits)
  digits = digits or 4
  if x ~= x then return "nan" end
  if x == math.huge or x == -math.huge then return x > 0 and "inf" or "-inf" end
  if math.type(x) == "integer" and math.abs(x) < 10000000 then return string.format("%d", x) end
  if x == 0 then return "0" end
  local rounded = string.format("%." .. digits - 1 .. "e", x)
  local mantissa, exponent = rounded:match("^(.*)e(.*)$")
  exponent = math.tointeger(tonumber(exponent))
  if exponent < -4 or exponent >= 6 then return mantissa .. "e" .. exponent end
  return string.format("%." .. math.max(0, digits - 1 - exponent) .. "f", tonumber(rounded))
end

local function power_of(x, highest)
  if x == 0 or x ~= x or math.abs(x) == math.huge then return 0 end
  -- from the rounded text, so that 999.96 becomes 1.000 k and not 1000
  local exponent = tonumber(string.format("%.3e", x):match("e(.*)$"))
  local power = exponent // 3 * 3
  return math.tointeger(math.max(-12, math.min(highest, power)))
end

--- Returns a number and its unit, scaled to a suitable prefix if the unit allows one.
-- @tparam number x in the unit
-- @tparam ?string unit SI, such as "N" or "N m"; others are left alone
-- @treturn string digits
-- @treturn string unit with prefix, "" if none
function number.engineering(x, unit)
  unit = unit or ""
  local highest = scalable[unit]
  if not highest or math.type(x) == "integer" and x == 0 then return number.digits(x), unit end
  local power = power_of(x, highest)
  local size = math.abs(x) / 10.0 ^ power
  if power ~= 0 and (size < 1e-4 or size >= 1e6) then return number.digits(x), unit end -- "1.000e-18 pN"
  return number.digits(x / 10.0 ^ power), prefixes[power] .. unit
end

--- Returns both as one text: `1.234 mN`.
-- @tparam number x in the unit
-- @tparam ?string unit
-- @treturn string
function number.text(x, unit)
  local digits, scaled = number.engineering(x, unit)
  return scaled == "" and digits or digits .. " " .. scaled
end

--- Returns a duration in wall-clock time: 0.03 s, 12.4 s, 3 min 20 s, 2 h 05 min.
-- @tparam number seconds [s]
-- @treturn string
function number.duration(seconds)
  if seconds ~= seconds or seconds == math.huge then return "?" end
  if seconds < 1 then return string.format("%.2f s", seconds) end
  if seconds < 59.95 then return string.format("%.1f s", seconds) end
  local whole = math.floor(seconds + 0.5)
  if whole < 3600 then return string.format("%d min %02d s", whole // 60, whole % 60) end
  return string.format("%d h %02d min", whole // 3600, whole % 3600 // 60)
end

--- Returns how many columns a UTF-8 text takes in a terminal; wide scripts are not considered.
-- @tparam string text
-- @treturn integer
function number.columns(text)
  return utf8.len(text) or #text
end

return number
