-- SPDX-License-Identifier: GPL-3.0-or-later
--- How much noise changes the order of values (N. Hansen, A. Niederberger, L. Guzzella, P. Koumoutsakos, A
-- method for handling uncertainty in evolutionary optimization, 2009).
-- @module softworld.study.unrest

local THETA = 0.2 -- share of random changes of order that is tolerated

-- Returns the tolerated change: the (THETA / 2) quantile of |1 - rank|, |2 - rank|, ..., as for a random
-- order.
local function borne(rank, size)
  local list = {}
  for k = 1, 2 * size - 1 do list[k] = math.abs(k - rank) end
  table.sort(list)
  return list[math.max(1, math.ceil(THETA * 0.5 * #list))]
end

--- Returns a number above 0 if the order of values changes more than tolerated when the first ones are
-- repeated.
return function(values, again)
  local size, sum = #values, 0
  local all = table.move(values, 1, size, 1, {})
  table.move(again, 1, #again, size + 1, all)
  local function rank_of(value, skip)
    local r = 1
    for k, v in ipairs(all) do
      if k ~= skip and v < value then r = r + 1 end
    end
    return r
  end
  for k, value in ipairs(again) do
    local old, new = rank_of(values[k], size + k), rank_of(value, k)
    sum = sum + 2 * math.abs(old - new) - borne(new, size) - borne(old, size)
  end
  return sum / #again
end
