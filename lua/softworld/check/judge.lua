-- SPDX-License-Identifier: GPL-3.0-or-later
--- Verdicts on a value against a limit, each known between low and high.
-- PASS if the whole range of the value keeps the whole range of the limit, FAIL if no part of it does or a
-- number is NaN, else OPEN. A value at the limit keeps it, within rounding.
-- @module softworld.check.judge
local number = require "softworld.output.number"

local judge = {}

local FAR = 100       -- a limit this many times laxer than usual ones is probably not meant [-]
local ROUNDING = 1e-12 -- share of a value by which rounding may put it beyond its limit [-]
local LAST = 16 * 2 ^ -52 -- rounding of a value that should be 0, as a share of the terms that make it [-]
local THOUSAND = 500  -- same against the value itself, if nothing better is known: its unit may be wrong [-]

-- Returns how far a is beyond the limit, below 0 if it keeps it. side: "max" or "min". Sums such as 0.15 -
-- 0.1 - 0.002 differ from 0.048 in the last bits, so a value that differs by rounding is at its limit. At a
-- limit of 0 the value tells nothing about its rounding; terms: size of what it is the difference of, or nil.
local function beyond(a, limit, side, terms)
  if a == limit then return 0.0 end
  local by = side == "max" and a - limit or side == "min" and limit - a
  local size = math.max(math.abs(a), math.abs(limit))
  local rounding = limit == 0 and terms and LAST * terms or ROUNDING * size
  if size < math.huge and by > 0 and by <= rounding then return 0.0 end
  return by
end

-- True if a keeps the limit.
local function kept(a, limit, side, terms) return beyond(a, limit, side, terms) <= 0 end

--- Returns the verdict. value and limit: { value =, low =, high = }, low and high may be missing;
-- value.terms: see softworld.check.terms.
function judge.verdict(value, limit, side)
  local low, high = value.low or value.value, value.high or value.value
  local least, most = limit.low or limit.value, limit.high or limit.value
  local worst, best, hard, soft = high, low, least, most
  if side == "min" then worst, best, hard, soft = low, high, most, least end
  for _, x in ipairs{ value.value, low, high, limit.value, least, most } do
    if x ~= x then return "FAIL" end
  end
  if kept(worst, hard, side, value.terms) then return "PASS" end
  return kept(best, soft, side, value.terms) and "OPEN" or "FAIL"
end

--- Returns the distance to the limit in its unit, below 0 if the limit is broken.
function judge.margin(value, limit, side)
  return 0.0 - beyond(value.value, limit.value, side, value.terms)
end

-- Returns how many times laxer a limit is than a reference; nil if that cannot be told.
local function laxer(limit, than, side)
  if not than or than <= 0 or limit <= 0 or than == math.huge then return nil end
  return side == "max" and limit / than or side == "min" and than / limit
end

local function shown(value, unit) return number.text(value, unit ~= "-" and unit or nil) end

local function times(x) return ("%.3g"):format(x >= 1 and x or 1 / x) end

--- Returns what is odd about a limit of the user's, or nil; and whether the row must not pass because of it.
-- known: the limit without the user's; reference: a usual limit of this kind; or nil.
function judge.suspicion(value, limit, side, unit, known, reference)
  local usual = known and known.value or reference
  if usual and usual > 0 and side == "min" and limit.value <= 0 then
    return ("a limit of %s excludes nothing; sure = true keeps it"):format(shown(limit.value, unit)),
      true
  end
  local far = laxer(limit.value, usual or value, side)
  if not far then return nil end
  local least = usual and FAR or THOUSAND
  local strict = far <= 1 / least and not kept(value, limit.value, side)
  if far >= least or strict then
    local what = known and ("the %s's"):format(known.from) or usual and "what is usual" or "the value"
    return ("the limit of %s differs by a factor of %s from %s, %s; is %s? sure = true keeps it")
      :format(shown(limit.value, unit), times(far), what, shown(usual or value, unit),
        unit ~= "-" and ("its unit right (%s)"):format(unit) or "it right"), far > 1
  end
  if known and far > 1 and known.from ~= "definition" then
    return ("less strict than the %s's %s"):format(known.from, shown(known.value, unit)), false
  end
end

return judge
