-- SPDX-License-Identifier: GPL-3.0-or-later
--- Estimates the error of a quantity's last value from its changes between levels; edges and steps are halved
-- from level to level.
-- @module softworld.run.estimate
local quantity = require "softworld.quantity"

local estimate = { HOPED = 8 } -- HOPED: a level shortens a bar at most by this factor [-]

local safety = 1.5
local second_order = 4    -- error of a level over that of the next level [-]
local slowest = 1.5       -- rate below which convergence cannot be relied on [-]
local even = { 2, 6 }     -- two rates in a row within these, one at most twice the other, show an order [-]
local rounding = 1e-9     -- of the value [-]

-- Returns the changes between the values of the last four levels, `last` the newest; first: nil with three
-- levels.
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

-- True if the values can be compared.
local function are_alike(values)
  for i = 2, #values do
    if not quantity.alike(values[i - 1], values[i]) then return false end
  end
  return true
end

-- Returns the sum of all further changes if they shrink as the last two did.
local function to_come(d) return d.rate > 1 and d.last / (d.rate - 1) or math.huge end

-- True if three changes shrink alike, as they do if edges and steps are fine enough.
local function agree(d)
  local rate, other = d.rate, d.first and d.first / d.before or 0
  return not d.turns and math.min(rate, other) > even[1] and math.max(rate, other) < even[2]
    and math.max(rate, other) < 2 * math.min(rate, other)
end

-- Error of a computation without inertia.
local function at_rest(d, contact)
  if contact then return math.max(d.last, d.before / 8) end -- touches jump from node to node
  if d.turns or d.rate < slowest then return math.max(d.last, d.before / 2) end
  local rate = math.min(second_order, d.rate)
  -- The last change may be small by chance if the one before was large. If it is smaller than any order
  -- makes it, parts of opposite signs cancelled in it: what comes may be as large as the order makes it.
  if d.rate > even[2] then return d.before / second_order end
  return math.max(d.last / (rate - 1), d.before / (second_order * (second_order - 1)))
end

-- Error of a computation with inertia. Coarse levels miss short events, so changes that shrank fast may
-- shrink slowly again. With touches, and for peaks, only three changes that agree show an order. Otherwise
-- the earlier changes count with a share, because the last may be small by chance.
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

--- Returns how far the last of a quantity's values may be off. There is one value per level, each
-- level with edges and steps half as long as before.
-- @tparam table q the quantity: plain or own = true if its order is not known; row = true: of a check, whose
--   value may be exactly its limit, so that equal values have no bar; vanishes = true: it is 0 for hard
--   bodies, so that its error is as large as its value
-- @tparam table values of the levels, coarsest first
-- @tparam boolean contact does the wire touch anything, or were steps redone?
-- @tparam boolean moves has the computation inertia?
-- @treturn number error, in the quantity's unit
-- @treturn number factor by which a further level shortens it
function estimate.bar(q, values, contact, moves)
  local n = #values
  if n < 2 or not are_alike(values) then return math.huge, second_order end
  local size = quantity.size(values[n]) -- infinite: bend radius of a straight wire
  local floor = size < math.huge and not q.row and rounding * size or 0
  local least = q.vanishes and size or 0
  if n == 2 then
    local rate = (q.plain or q.own or contact) and 2 or second_order
    return math.max(safety * quantity.distance(values[1], values[2]) / (rate - 1) + floor, least), rate
  end
  local d = changes_of(values)
  local off
  if d.grows then off = math.max(d.last, d.before) -- for example peaks of blows: the bar is their change
  elseif moves then off = in_motion(q, d, contact)
  else off = at_rest(d, contact) end
  if q.row and n == 3 and not d.turns then -- no verdict by two changes that grow or hardly shrink
    off = math.max(off, math.min(to_come(d), second_order * d.last))
  end
  return math.max(safety * off + floor, least), d.grows and 1 or math.max(math.min(second_order, d.rate), 1)
end

--- Returns the shortest bar that can be hoped for on level `most` if it is still longer than asked for, else
-- nil. values: of the levels so far.
function estimate.hopeless(q, values, contact, most, asked)
  local bar = estimate.bar(q, values, contact) / estimate.HOPED ^ math.max(0, most - #values)
  return bar > asked and bar or nil
end

return estimate
