-- SPDX-License-Identifier: GPL-3.0-or-later
--- Verdicts: a value, known between low and high, against a limit, known between low and high.
-- PASS where the whole range of the value keeps the whole range of the limit, FAIL where none of it does,
-- OPEN between. A value that is exactly the limit is met.
-- @module softworld.check.judge
local number = require "softworld.output.number"

local judge = {}

local FAR = 100       -- a limit so many times what limits of its kind are like is hardly meant [-]
local THOUSAND = 500  -- a value so far from a limit may be in another unit, where nothing better is known [-]

-- Is a kept?  side: "max" or "min".
local function kept(a, limit, side)
  if side == "max" then return a <= limit end
  return a >= limit
end

--- The verdict. value and limit: { value =, low =, high = }, low and high may be missing.
function judge.verdict(value, limit, side)
  local low, high = value.low or value.value, value.high or value.value
  local least, most = limit.low or limit.value, limit.high or limit.value
  local worst, best, hard, soft = high, low, least, most
  if side == "min" then worst, best, hard, soft = low, high, most, least end
  for _, x in ipairs{ value.value, low, high, limit.value, least, most } do
    if x ~= x then return "FAIL" end
  end
  if kept(worst, hard, side) then return "PASS" end
  return kept(best, soft, side) and "OPEN" or "FAIL"
end

--- How much is left up to the limit, below 0 where it is broken, in its unit.
function judge.margin(value, limit, side)
  if side == "max" then return limit.value - value.value end
  return value.value - limit.value
end

-- How many times laxer a limit is than what is given; nil where that cannot be told.
local function laxer(limit, than, side)
  if not than or than <= 0 or limit <= 0 or than == math.huge then return nil end
  return side == "max" and limit / than or side == "min" and than / limit
end

local function times(x) return ("%.3g"):format(x >= 1 and x or 1 / x) end

--- What is odd about a limit of the user's: nil, or a text, and whether the row must not pass for that.
-- known: the limit that holds without the user's; reference: what limits of the kind are like; or nil.
function judge.suspicion(value, limit, side, unit, known, reference)
  local usual = known and known.value or reference
  if usual and usual > 0 and side == "min" and limit.value <= 0 then
    return ("a limit of %s excludes nothing; sure = true keeps it"):format(number.text(limit.value, unit)),
      true
  end
  local far = laxer(limit.value, usual or value, side)
  if not far then return nil end
  local least = usual and FAR or THOUSAND
  local strict = far <= 1 / least and not kept(value, limit.value, side)
  if far >= least or strict then
    local what = known and ("the %s's"):format(known.from) or usual and "what is usual" or "the value"
    return ("the limit of %s differs by a factor of %s from %s, %s; is its unit right (%s)? sure = true "
      .. "keeps it"):format(
      number.text(limit.value, unit), times(far), what, number.text(usual or value, unit), unit), far > 1
  end
  if known and far > 1 and known.from ~= "definition" then
    return ("less strict than the %s's %s"):format(known.from, number.text(known.value, unit)), false
  end
end

return judge
