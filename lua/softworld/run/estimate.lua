-- SPDX-License-Identifier: GPL-3.0-or-later
--- How far the last of a quantity's values may be off, by how they change from level to level, edges and
-- steps half as long on each.
-- @module softworld.run.estimate
local quantity = require "softworld.quantity"

local estimate = { HOPED = 8 } -- bars get no smaller than by this from level to level

local safety = 1.5
local second_order = 4    -- error of a level over that of the next one
local slowest = 1.5       -- below this rate there is no convergence to rely on
local even = { 2, 6 }     -- two rates in a row between these, one at most twice the other, tell of an order
local rounding = 1e-9     -- of the value

-- The distances between the values of the last four levels, the last one's last; first: nil of three levels.
local function changes_of(values)
  local n = #values
  local d = { last = quantity.distance(values[n - 1], values[n]),
    before = quantity.distance(values[n - 2], values[n - 1]),
    first = n > 3 and quantity.distance(values[n - 3], values[n - 2]) or nil,
    turns = quantity.agreement(values[n - 2], values[n - 1], values[n]) < 0 }
  d.rate = d.last > 0 and d.before / d.last or math.huge
  d.grows = d.first and d.before > d.first
  return d
end

-- All changes from now on, if they shrink as the last two did.
local function to_come(d) return d.rate > 1 and d.last / (d.rate - 1) or math.huge end

-- Do three changes shrink alike, as they do where edges and steps are fine enough?
local function agree(d)
  local rate, other = d.rate, d.first and d.first / d.before or 0
  return not d.turns and math.min(rate, other) > even[1] and math.max(rate, other) < even[2]
    and math.max(rate, other) < 2 * math.min(rate, other)
end

-- Changes of a computation without inertia.
local function at_rest(d, contact)
  if contact then return math.max(d.last, d.before / 8) end -- touching places jump from node to node
  if d.turns or d.rate < slowest then return math.max(d.last, d.before / 2) end
  local rate = math.min(second_order, d.rate)
  -- a small last change may be chance, where the one before was large
  return math.max(d.last / (rate - 1), d.before / (second_order * (second_order - 1)))
end

-- Of a motion: coarse levels miss what is short, so that changes which shrank fast shrink slowly again. Where
-- the wire touches things, and where a peak is looked for, only three that agree tell an order. Else the last
-- counts as much as a share of those before it, as it may be small by chance.
local function in_motion(q, d, contact)
  local off
  if not contact and (not q.plain or agree(d)) then off = at_rest(d, false)
  elseif not d.first then off = math.max(d.last, d.before / 2)
  elseif agree(d) then off = math.max(d.last, d.before / second_order)
  else off = math.max(d.last, d.before / 3, d.first / 8) end
  if d.turns and not d.first then off = math.max(off, d.before) end
  if d.rate > even[2] then off = math.max(off, d.before / second_order) end
  return d.rate < 2 and math.max(off, math.min(to_come(d), 2 * d.last)) or off
end

--- How far the last of the values of a quantity may be off, one value per level, each
-- level with edges and steps half as long as before.
-- @tparam table q the quantity: plain or own = true when its order is not known; row = true: of a check,
--   which may be exactly its limit, so that equal values have no bar; vanishes = true: hard bodies have none
--   of it, so that it is as uncertain as it is large
-- @tparam table values of the levels, coarsest first
-- @tparam boolean contact does the wire touch anything, or were steps redone?
-- @tparam boolean moves has the computation inertia?
-- @treturn number error, in the quantity's unit
-- @treturn number by how much a further level makes it smaller
function estimate.bar(q, values, contact, moves)
  local n = #values
  if n < 2 then return math.huge, second_order end
  local size = quantity.size(values[n]) -- infinite: the bend radius of a straight wire
  local floor = size < math.huge and not q.row and rounding * size or 0
  local least = q.vanishes and size or 0
  if n == 2 then
    local rate = (q.plain or q.own or contact) and 2 or second_order
    return math.max(safety * quantity.distance(values[1], values[2]) / (rate - 1) + floor, least), rate
  end
  local d = changes_of(values)
  local off
  if d.grows then off = math.max(d.last, d.before) -- peaks of blows, for instance: the bar is their change
  elseif moves then off = in_motion(q, d, contact)
  else off = at_rest(d, contact) end
  if q.row and n == 3 and not d.turns then -- a verdict must not go by two changes that hardly shrink, or grow
    off = math.max(off, math.min(to_come(d), second_order * d.last))
  end
  return math.max(safety * off + floor, least), d.grows and 1 or math.max(math.min(second_order, d.rate), 1)
end

--- Is a quantity's bar so long on the last of k levels that no finer one of at most so many makes it short
-- enough? Values of levels, what is asked for; returns the shortest that may be hoped for, or nil.
function estimate.hopeless(q, values, contact, most, asked)
  local bar = estimate.bar(q, values, contact) / estimate.HOPED ^ math.max(0, most - #values)
  return bar > asked and bar or nil
end

return estimate
