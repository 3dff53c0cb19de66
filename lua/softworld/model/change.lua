-- SPDX-License-Identifier: GPL-3.0-or-later
--- By how much the next rung of a choice changes the quantities: on coarse levels of edges and steps, and
-- estimated from them for the finest level.
-- @module softworld.model.change
local quantity = require "softworld.quantity"

local change = {}

change.MODEL = 0.875 -- share of a tolerance that the rungs may leave out [-]
change.FAINT = 1 / 64 -- change over the allowed one that finer edges hardly bring up to it [-]

local SAFETY = 1.5 -- on estimates for finer levels [-]
local ELSEWHERE = 1 / 4 -- error of a coarse value, over the value, up to which a comparison counts [-]
local STILL = 1e-4 -- way over an edge of wires that have not moved [-]
local STEADY = 1 / 2 -- largest change over the allowed one that finer edges need not confirm [-]
local NONE = 0 / 0 -- value of a check's row that a computation lacks

local function is_finite(v) return v ~= nil and quantity.size(v) < math.huge end

-- Returns by how much the change between the rungs differs from that on the level before. Both rungs have the
-- same edges and steps, and so mostly the same errors. nil: there is no level before.
local function moved(levels, name)
  local now, before = levels, levels.before
  local a, b = now.here.values[name], now.above.values[name]
  local c, d = before and before.here.values[name], before and before.above.values[name]
  if not (is_finite(a) and is_finite(b) and is_finite(c) and is_finite(d)) then return nil end
  if not (quantity.alike(a, b) and quantity.alike(a, c) and quantity.alike(a, d)) then return nil end
  return quantity.distance(quantity.minus(a, c), quantity.minus(b, d))
end

-- Returns a bound for a change d on the finest level: d times the choice's safety. Another estimate holds if
-- it is less: SAFETY * d, or with a level before, d plus SAFETY times what it moved by; both over the share
-- of the change that this level shows. levels: { here =, above = } of the rungs, also before.
local function bound(state, levels, name, d)
  local choice = state.choice
  local most, move = choice.safety * d, moved(levels, name)
  local shown = choice.shows and choice.shows(levels.above.facts[choice.name]) or 1
  if shown <= 0 then return most end
  return math.min(most, (move and d + SAFETY * move or SAFETY * d) / shown)
end

-- Same for a rung whose next rung has its own edges, which also change the values.
local function own_bound(state, levels, name, d)
  local before, now = levels.before.above.values[name], levels.above.values[name]
  return state.choice.safety * (d + (quantity.alike(before, now) and quantity.distance(before, now) or 0))
end

--- Returns the smallest tolerance over the value of its quantity [-].
function change.tightest(context, values)
  local share = 1
  for _, q in ipairs(context.job.quantities) do
    local value = values[q.name] or NONE
    local size, asked = quantity.size(value), quantity.asked(q, value)
    if size > 0 and size < math.huge then share = math.min(share, asked / size) end
  end
  return share
end

--- Returns what the chosen rungs, except those of choice `but`, leave out of a quantity, in its unit.
function change.left_out(context, name, but)
  local sum = 0
  for _, state in ipairs(context.states) do
    sum = sum + (state.change and state ~= but and (state.change[name] or 0) or 0)
  end
  return sum
end

--- Same without failed choices: no other choice can make up for a failed rung.
function change.left_by_others(context, name, but)
  local sum = change.left_out(context, name, but)
  for _, state in ipairs(context.states) do
    if state.by == "failed" and state ~= but and state.change then sum = sum - (state.change[name] or 0) end
  end
  return sum
end

--- Returns a quantity's value on level k, for shares of it: that of a finer level if one was computed. Coarse
-- poses may end in another place, where a force is a small part of its later value.
function change.known(context, name, k, value)
  local finest = context.finest
  local finer = finest and finest.k > k and finest.values[name] or nil
  return is_finite(finer) and quantity.alike(finer, value) and finer or value
end

--- Returns by how much quantities change between two rungs, compared with what is allowed: the worst share
-- and its quantity; all changes; seen: the changes on this level alone, over the allowed ones.
-- levels: { here =, above = } of the rungs, also before; left(context, name, state): what other choices leave
-- out of a quantity.
function change.between(context, state, levels, left)
  local c = { worst = -1, all = {}, seen = {} }
  local own = state.choice.rungs[state.rung].own and levels.before
  for _, q in ipairs(context.job.quantities) do
    local a, b = levels.here.values[q.name] or NONE, levels.above.values[q.name] or NONE
    local d = quantity.alike(a, b) and quantity.distance(a, b) or math.huge
    if d ~= d then d = math.huge end
    c.all[q.name] = (own and own_bound or bound)(state, levels, q.name, d)
    local asked = quantity.asked(q, change.known(context, q.name, levels.k, b))
    local allowed = math.max(0, change.MODEL * asked - left(context, q.name, state))
    local off = d > 0 and c.all[q.name] / allowed or 0
    c.seen[q.name] = d > 0 and d / allowed or 0
    if off > c.worst then c.worst, c.quantity, c.allowed = off, q, allowed end
  end
  return c
end

-- Returns the largest distance between two shapes, lists of points of each wire [m].
local function shapes_apart(one, other)
  return quantity.alike(one, other) and quantity.distance(one, other) or math.huge
end

-- True if the wires were at the same place on the edges of a comparison as in the finest run: nearer than a
-- share of how far they moved, and of the shortest edge there; or they have not moved, neither on these edges
-- nor on fine ones: a straight wire that only turns has no way to compare with.
local function is_there(context, compared, shape)
  local way, edge = shapes_apart(context.start, shape), math.huge
  for i, w in ipairs(context.data.wires) do
    edge = math.min(edge, w.object.length / compared.here.level.segments[i])
  end
  local apart = shapes_apart(compared.here.shape, shape)
  local lines = not context.job.shape -- a mesh may be squeezed without a way
  local still = lines and math.max(way, apart) < STILL * edge
  return still or apart < ELSEWHERE * math.min(way, edge)
end

-- True if coarse edges may hide a change of a quantity between the rungs of a comparison: inertia counts, and
-- the quantity is the largest or least of many values, of which the same one may be largest in both rungs.
local function may_hide(context, state, q)
  local there, choice = state.compared, state.choice
  if not (q.plain or q.own) or not choice.blurred then return false end
  local share = change.tightest(context, there.above.values)
  return choice.blurred(there.here.facts[choice.name], there.above.facts[choice.name], share)
end

-- True if a comparison on this level found about the same as on the level before, and at most half of what is
-- allowed. Then a finer level will find about the same, where wires are at the same place.
local function is_steady(there)
  local before = there.coarser
  return before ~= nil and there.worst <= STEADY and there.worst <= SAFETY * before.worst
end

-- True if a comparison tells nothing of a quantity on the edges of the finest run, whose values and shape are
-- `fine`: see change.is_elsewhere. jumped: poses jumped in the comparison.
local function is_off(context, state, q, fine, jumped)
  local there = state.compared
  local coarse, value = there.here.values[q.name] or NONE, fine.values[q.name] or NONE
  if not quantity.alike(coarse, value) then return false end
  local off, hides = quantity.distance(coarse, value), not jumped and may_hide(context, state, q)
  local far = off > ELSEWHERE * quantity.size(value)
  if not (far or jumped or hides) or off <= quantity.asked(q, value) then return false end
  if hides and not q.own then return true end
  local clear = there.worst < change.FAINT or not far and is_steady(there)
  return not (clear and is_there(context, there, fine.shape))
end

--- Returns true if a choice was compared on edges so coarse that the wire was somewhere else there: the
-- rung's values were off those of the finest run by a quarter, and by more than the tolerance. On such edges
-- both rungs may agree on a shape that fine edges do not have. A pushed trunk may buckle to the other side.
-- Values alone may also be off because a sharp bend needs fine edges. So if the shape is the same, a change
-- far below the allowed one counts. Where poses jump, friction may hold the wire elsewhere after the jump, so
-- the coarse values must be right to the tolerance. If they are only right to a quarter, the shape must be
-- the same, and the change far below the allowed one, or one that two levels agree on. Peaks of fast motion
-- must be right to the tolerance: a coarse peak may be at another place and time than a fine one, and the
-- same for both rungs. There even a change far below the allowed one does not count, except of the script's
-- own quantities, which are mostly no peaks. fine: values and shape of the finest run.
function change.is_elsewhere(context, state, fine)
  local there = state.by == "compared" and state.compared
  local jumped = there and there.here.facts.motion.jumps > 0
  for _, q in ipairs(there and context.job.quantities or {}) do
    if is_off(context, state, q, fine, jumped) then return true end
  end
  return false
end

--- Returns c with the changes multiplied by `times`, which edges and steps may hide.
function change.hidden(c, times)
  local more = { worst = times * c.worst, quantity = c.quantity, allowed = c.allowed, seen = c.seen,
    all = {} }
  for name, d in pairs(c.all) do more.all[name] = times * d end
  return more
end

return change
