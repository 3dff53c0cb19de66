-- SPDX-License-Identifier: GPL-3.0-or-later
--- By how much the next rung of a choice changes the quantities, on coarse levels of edges and steps and, as
-- far as these tell, on the finest.
-- @module softworld.model.change
local quantity = require "softworld.quantity"

local change = {}

change.MODEL = 0.875 -- of a tolerance: what rungs may leave out [-]

local SAFETY = 1.5 -- of what is known of finer levels [-]
local ELSEWHERE = 1 / 4 -- of a value: how far coarse edges may be off for a change on them to count [-]
local NONE = 0 / 0 -- the value of a check's row that a computation has not

local function is_finite(v) return v ~= nil and quantity.size(v) < math.huge end

-- By how much the change itself changed from the level before: edges and steps are the same for both rungs,
-- and so are most of their errors. nil: there is no level before.
local function moved(levels, name)
  local now, before = levels, levels.before
  local a, b = now.here.values[name], now.above.values[name]
  local c, d = before and before.here.values[name], before and before.above.values[name]
  if not (is_finite(a) and is_finite(b) and is_finite(c) and is_finite(d)) then return nil end
  if not (quantity.alike(a, b) and quantity.alike(a, c) and quantity.alike(a, d)) then return nil end
  return quantity.distance(quantity.minus(a, c), quantity.minus(b, d))
end

-- What a change of d here may be on the finest level: times the choice's safety. Or, if that is less, over
-- the share of it that the level shows: 1.5 times as much; by two levels, with 1.5 times what it moved by.
-- levels: { here =, above = } of the rungs, also before.
local function bound(state, levels, name, d)
  local choice = state.choice
  local most, move = choice.safety * d, moved(levels, name)
  local shown = choice.shows and choice.shows(levels.above.facts[choice.name]) or 1
  if shown <= 0 then return most end
  return math.min(most, (move and d + SAFETY * move or SAFETY * d) / shown)
end

-- The same of a rung whose next one has edges of its own, which change it too.
local function own_bound(state, levels, name, d)
  local before, now = levels.before.above.values[name], levels.above.values[name]
  return state.choice.safety * (d + (quantity.alike(before, now) and quantity.distance(before, now) or 0))
end

--- A quantity's value on level k, for what a share of it is: by a finer level where one was computed. Coarse
-- poses may end in another place, where a force is a small part of what it comes to be.
function change.known(context, name, k, value)
  local finest = context.finest
  local finer = finest and finest.k > k and finest.values[name] or nil
  return is_finite(finer) and quantity.alike(finer, value) and finer or value
end

--- By how much quantities change between two results, with what is allowed: the worst share, its quantity,
-- all; seen: what that quantity changes by here, over what is allowed. levels: { here =, above = } of the
-- rungs, also before; left(context, name, state): what other choices leave out of a quantity.
function change.between(context, state, levels, left)
  local c = { worst = -1, all = {} }
  local own = state.choice.rungs[state.rung].own and levels.before
  for _, q in ipairs(context.job.quantities) do
    local a, b = levels.here.values[q.name] or NONE, levels.above.values[q.name] or NONE
    local d = quantity.alike(a, b) and quantity.distance(a, b) or math.huge
    if d ~= d then d = math.huge end
    c.all[q.name] = (own and own_bound or bound)(state, levels, q.name, d)
    local asked = quantity.asked(q, change.known(context, q.name, levels.k, b))
    local allowed = math.max(0, change.MODEL * asked - left(context, q.name, state))
    local off = d > 0 and c.all[q.name] / allowed or 0
    if off > c.worst then c.worst, c.quantity, c.allowed, c.seen = off, q, allowed, d / allowed end
  end
  return c
end

--- Was the choice compared on edges so coarse that the wire was somewhere else there? By the values of the
-- finest run, the rung's own were off by a quarter and by more than the tolerance. On such edges both rungs
-- may agree on a shape that fine edges do not have: a pushed trunk buckles to the other side.
function change.is_elsewhere(context, state, values)
  local there = state.by == "compared" and state.compared
  for _, q in ipairs(there and context.job.quantities or {}) do
    local coarse, fine = there.here.values[q.name] or NONE, values[q.name] or NONE
    if quantity.alike(coarse, fine) then
      local off = quantity.distance(coarse, fine)
      if off > ELSEWHERE * quantity.size(fine) and off > quantity.asked(q, fine) then return true end
    end
  end
  return false
end

--- The same where edges and steps hide so many times as much of it.
function change.hidden(c, times)
  local more = { worst = times * c.worst, quantity = c.quantity, allowed = c.allowed, seen = c.seen,
    all = {} }
  for name, d in pairs(c.all) do more.all[name] = times * d end
  return more
end

return change
