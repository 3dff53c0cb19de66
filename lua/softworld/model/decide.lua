-- SPDX-License-Identifier: GPL-3.0-or-later
--- Decides the choices of a model by coarse computations, each from its cheapest rung up to the first that
-- leaves out no more than a part of the tolerance.
-- @module softworld.model.decide
local change = require "softworld.model.change"
local number = require "softworld.output.number"
local probe = require "softworld.model.probe"
local quantity = require "softworld.quantity"
local estimate = require "softworld.run.estimate"

local decide = {}

local MODEL = change.MODEL
local DOUBT = 2 -- changes above the allowed one over this are compared on a finer mesh too [-]
local MOMENT = 1e5 -- iterations times nodes that cost nothing worth saving: about 70 ms [-]
local LONG = 1     -- expected time of a mesh on the second level above which in_vain is asked [s]
local FAR = 100    -- change over the allowed one that cannot come from coarse edges [-]
local HOPE = 4     -- a change shrinks at most by this factor from level to level [-]
local FEIGNED = 16 -- change over the allowed one that coarse edges cause only if poses jump elsewhere [-]
local HIDDEN = 4   -- coarse edges and steps that blur a change may hide this many times as much [-]
local HIDES = 2 / 3 -- largest change with hidden part over the allowed one; the rest is for edges, steps [-]
local SEEN = 0.1   -- least share of a swing that steps must show to accept a blurred change [-]
local GROWTH = 2   -- least iterations of a run over those of the level before [-]
local NONE = 0 / 0 -- value of a check's row that a computation lacks

decide.levels = 3 -- coarse levels on which rungs are compared [-]

--- Returns the chosen rungs by the names of the choices.
function decide.rungs(context)
  local rungs = {}
  for _, state in ipairs(context.states) do rungs[state.choice.name] = state.rung end
  return rungs
end

local function with(rungs, name, rung)
  local copy = {}
  for key, value in pairs(rungs) do copy[key] = value end
  copy[name] = rung
  return copy
end

-- Returns the least iterations that the next rung of a choice needs on level k, from known computations, or
-- from one on the coarsest level; nil: it cannot be computed.
local function iterations_above(context, state, k)
  local up = with(decide.rungs(context), state.choice.name, state.rung + 1)
  for j = k, 2, -1 do
    local above = probe.known(context, up, j)
    if above and above.ok then return GROWTH ^ (k - j) * above.iterations end
  end
  local above = probe.of(context, up, 1)
  return above.ok and GROWTH ^ (k - 1) * above.iterations or nil
end

--- Returns the choice whose rung costs more than the next one, judged by a run on level k, and why; nil:
-- there is none. This may compute another run and leave the scene in its final state.
function decide.wasteful(context, k, run)
  for _, state in ipairs(context.states) do
    local open = state.by ~= "given" and not state.went_on and state.rung < state.last and state.choice.toils
    local above = open and open(state.rung, run) and iterations_above(context, state, k)
    local why = above and state.choice.costly(state.rung, run, { iterations = above }, k)
    if why then return state, why end
  end
end

--- Returns the smallest tolerance over the value of its quantity [-].
function decide.tightest(context, values)
  local share = 1
  for _, q in ipairs(context.job.quantities) do
    local value = values[q.name] or NONE
    local size, asked = quantity.size(value), quantity.asked(q, value)
    if size > 0 and size < math.huge then share = math.min(share, asked / size) end
  end
  return share
end

--- Returns what the chosen rungs, except those of choice `but`, leave out of a quantity, in its unit.
function decide.left_out(context, name, but)
  local sum = 0
  for _, state in ipairs(context.states) do
    sum = sum + (state.change and state ~= but and (state.change[name] or 0) or 0)
  end
  return sum
end

-- Same without failed choices: no other choice can make up for a failed rung.
local function left_by_others(context, name, but)
  local sum = decide.left_out(context, name, but)
  for _, state in ipairs(context.states) do
    if state.by == "failed" and state ~= but and state.change then sum = sum - (state.change[name] or 0) end
  end
  return sum
end

-- True if the next rung's run would need only one more level. Comparing there saves nothing, so the
-- comparison ends if it takes more than a moment. above: the next rung on level k - 1, before: on k - 2.
local function saves_nothing(context, above, before, k)
  local growth = above.work / math.max(1, before.work)
  if k < decide.levels or growth * above.work < MOMENT then return false end
  for _, q in ipairs(context.job.quantities) do
    local value = above.values[q.name] or NONE
    local bar, rate = estimate.bar(q, { before.values[q.name] or NONE, value }, above.contact)
    local enough = bar / rate <= quantity.asked(q, value) -- false for NaN
    if not enough then return false end
  end
  return true
end

-- True if poses jumped. On coarse edges chance decides where to, which may cause any change.
local function jumps(result) return (result.facts.motion.jumps or 0) > 0 end

-- True if the level tells too little of the next rung to decide. Else false; and the change together with
-- what may be hidden, if that is still small enough.
local function is_blurred(context, state, now, c)
  local choice = state.choice
  if now.k > 1 then return false end
  if choice.rungs[state.rung].own then return true end -- the next rung's own error is unknown
  if c.worst > 1 then return c.worst <= FAR or jumps(now.here) or jumps(now.above) end
  local above, share = now.above.facts[choice.name], decide.tightest(context, now.above.values)
  if not choice.blurred or not choice.blurred(now.here.facts[choice.name], above, share) then return false end
  local all = change.hidden(c, HIDDEN)
  if all.worst < HIDES and choice.shows and choice.shows(above) > SEEN then return false, all end
  return true
end

-- Marks results of the level before whose poses jumped to a place where they do not go on this level: such
-- results say nothing about finer levels. A result is marked if it jumped and has moved since by at least
-- half of the distance between the rungs. last: the change there.
local function mark_astray(now, last)
  local name, before = last.quantity.name, now.before
  local function distance(one, other)
    local a, b = one.values[name] or NONE, other.values[name] or NONE
    return quantity.alike(a, b) and quantity.distance(a, b) or NONE
  end
  local apart = distance(before.here, before.above)
  for _, rung in ipairs { "here", "above" } do
    local moved = distance(before[rung], now[rung])
    if jumps(before[rung]) and moved >= apart / 2 then before[rung].astray = true end
  end
end

-- Compares a rung with the next on the coarsest level, and on finer levels while a too large change becomes
-- smaller: coarse steps must not rule out a cheap rung. Returns the change, and why the next rung failed.
local function compare(context, state, rungs, above)
  local rung, levels = state.choice.rungs[state.rung], state.choice.levels or decide.levels
  local c, before
  for k = 1, levels do
    local again = before and before.before and before.before.above
    if again and saves_nothing(context, before.above, again, k) then return c end
    local here, there = probe.of(context, rungs, k), probe.of(context, above, k)
    if k > 1 and not (here.ok and there.ok) then return c, not there.ok and rung.own and there.reason end
    local now = { k = k, here = here, above = there, before = before }
    local last = c
    c, before, state.compared = change.between(context, state, now, left_by_others), now, now
    local clear = c.worst < 1 / DOUBT or c.worst > HOPE ^ (levels - k) or k > 1 and c.worst <= 1
    if last and last.worst > FEIGNED and c.worst <= 1 then mark_astray(now, last) end
    local blurred, all = is_blurred(context, state, now, c)
    if clear and not blurred and k >= (state.from or 1) then return all or c end
    local grows = last and not state.choice.steady and c.worst > 1 and c.seen >= last.seen
    if grows then return c end
    local costly = state.choice.costly
    if c.worst > 1 and costly and costly(state.rung, here, there, k, true) then return c end
  end
  return c
end

local function changed_by(c)
  local q = c.quantity
  if c.worst == 0 then return "nothing changes" end
  return ("%s changes by %s (allowed %s)"):format(q.name, number.text(c.all[q.name], q.unit),
    number.text(c.allowed, q.unit))
end

local function begin_anew(state)
  state.rung, state.by, state.raised, state.why, state.checked, state.rose = 1, nil, nil, nil, nil, nil
end

--- Raises a choice by one rung. The choices after it start again, as they were decided with the old rung.
function decide.raise(context, state, why)
  state.rung, state.by, state.raised, state.why, state.rose = state.rung + 1, "raised", why, why, nil
  local after = false
  for _, other in ipairs(context.states) do
    if after and other.by ~= "given" and not other.choice.steady then begin_anew(other) end
    after = after or other == state
  end
end

-- Settles a choice with the reason why it was raised, if it was, and why it stays. Returns true.
local function stay(state, by, why)
  state.by = by
  state.why = state.raised and why and state.raised .. "; " .. why or state.raised or why
  return true
end

-- Returns the choice whose next rung can compute what this one cannot, and why.
local function mends(context, result)
  local share = result.values and decide.tightest(context, result.values) or 1
  for _, state in ipairs(context.states) do
    local why = state.by ~= "given" and not state.barred and state.rung < state.last and state.choice.mends
      and state.choice.mends(context, state.rung, result, share)
    if why then return state, why end
  end
end

-- Returns a share of each value, in its unit.
local function of_values(context, values, share)
  local all = {}
  for _, q in ipairs(context.job.quantities) do
    local size = quantity.size(values[q.name] or NONE)
    all[q.name] = size < math.huge and share * size or 0
  end
  return all
end

-- Settles a choice because the next rung is not available; what it leaves out counts as far as it is known.
local function unknown(context, state, f, here, why)
  local left = state.choice.left and state.choice.left(state.rung, f)
  state.doubt, state.change = why, left and of_values(context, here.values, left)
  return stay(state, "failed", why)
end

-- Starts the other choices again: what was found with the old rung says nothing.
local function others_anew(context, state)
  for _, other in ipairs(context.states) do
    if other ~= state and other.by ~= "given" then begin_anew(other) end
  end
end

-- If wires cannot be made as a rung wants, takes the rung below; false if there is none.
local function bar_rung(context, failed)
  for _, state in ipairs(context.states) do
    if state.choice.steady and state.rung > 1 then
      state.barred = ("%s cannot be computed: %s"):format(state.choice.rungs[state.rung].as, failed.reason)
      state.rung, state.raised = state.rung - 1, nil
      others_anew(context, state)
      return true
    end
  end
  return false
end

-- Returns a text if no level would make a bar short enough, so that a costly mesh is in vain; else nil. Two
-- levels of the present rung show it.
local function in_vain(context, rungs, up)
  local time, job = probe.expected(context, up, 2), context.job -- two levels make a bar
  if not time or time < LONG then return nil end
  local one, two = probe.of(context, rungs, 1), probe.of(context, rungs, 2)
  for _, q in ipairs(one.ok and two.ok and job.quantities or {}) do
    local now = two.values[q.name] or NONE
    local asked = quantity.asked(q, now)
    local bar = estimate.hopeless(q, { one.values[q.name] or NONE, now }, two.contact, context.most, asked)
    if bar then
      return ("the bar of %s is at least %s on the finest of %d levels, and %s is asked for: no mesh helps")
        :format(q.name, number.text(bar, q.unit), context.most, number.text(asked, q.unit))
    end
  end
end

-- Checks whether the next rung gives another answer. True when the choice is settled.
local function climb(context, state, rungs, here)
  local choice, rung = state.choice, state.rung
  local name, f = choice.name, here.facts[choice.name]
  local up = with(rungs, name, rung + 1)
  local next_as = choice.rungs[rung + 1].as
  if choice.rungs[rung].own and probe.expected(context, up, 2) == math.huge then -- one level tells nothing
    return unknown(context, state, f, here,
      ("%s cannot be computed on finer edges: there is no such mesh"):format(next_as))
  end
  local vain = choice.rungs[rung + 1].own and in_vain(context, rungs, up)
  if vain then
    state.doubt = vain
    return stay(state, "skipped", vain)
  end
  local above = probe.of(context, up, 1)
  if not above.ok then
    return unknown(context, state, f, here, ("%s cannot be computed: %s"):format(next_as, above.reason))
  end
  local costly = choice.costly and choice.costly(rung, here, above, 1)
  if costly then
    decide.raise(context, state, costly)
    return false
  end
  local c, blind = compare(context, state, rungs, up)
  if blind then
    return unknown(context, state, f, here, ("%s: no computation on finer edges: %s"):format(next_as, blind))
  end
  if c.worst > 1 then
    decide.raise(context, state, ("with %s %s"):format(next_as, changed_by(c)))
    state.rose = probe.key(rungs, 1)
  else
    state.change = c.all
    return stay(state, "compared", ("with %s %s"):format(next_as, changed_by(c)))
  end
  return false
end

--- Takes one step in deciding a choice; true when it is settled.
function decide.look(context, state)
  local choice, rungs = state.choice, decide.rungs(context)
  local name, rung = choice.name, state.rung
  local here = probe.of(context, rungs, 1)
  local mender, because = mends(context, here)
  if mender then
    decide.raise(context, mender, because)
    others_anew(context, mender)
    return false
  end
  if here.unmade and bar_rung(context, here) then return false end
  if not here.ok then
    if rung == state.last or here.raised then return stay(state, "failed") end
    decide.raise(context, state, ("%s cannot be computed: %s"):format(choice.rungs[rung].as, here.reason))
    return false
  end
  local f = here.facts[name]
  if choice.idle and choice.idle(f) then
    return stay(state, "idle")
  end
  local why, more
  if choice.free and not state.checked then
    why, more = choice.free(context, rung, f, decide.tightest(context, here.values))
  end
  state.doubt = not why and more or nil
  if why then
    state.known, state.change = why, more and of_values(context, here.values, more)
    return stay(state, "free", why)
  end
  if rung == state.last then return stay(state, "last") end
  local skip = choice.skip and choice.skip(context, rung, f, decide.tightest(context, here.values))
  if skip then
    state.doubt = skip
    return stay(state, "skipped")
  end
  if state.barred then return unknown(context, state, f, here, state.barred) end
  return climb(context, state, rungs, here)
end

-- Decides all choices in turn. What one may leave out is reduced by what the others are known to leave out.
local function decide_all(context)
  for _, state in ipairs(context.states) do
    if state.by ~= "given" then
      state.by, state.known, state.doubt, state.change = nil, nil, nil, nil
      repeat until decide.look(context, state)
    end
  end
end

-- True if the choices together leave out more than allowed, although each one is within its limit.
local function is_overdrawn(context)
  local here = probe.of(context, decide.rungs(context), 1)
  for _, q in ipairs(here.ok and context.job.quantities or {}) do
    local left = left_by_others(context, q.name)
    local value = change.known(context, q.name, 1, here.values[q.name] or NONE)
    if left > MODEL * quantity.asked(q, value) then return true end
  end
  return false
end

-- Goes back to the rung below if it suffices with the present rungs of the others; true if it does. What the
-- others leave out was found with the rung above, and the change between the two rungs is added to it.
local function may_fall(context, state)
  local now = decide.rungs(context)
  local below = with(now, state.choice.name, state.rung - 1)
  if not state.rose or state.choice.steady or state.rose == probe.key(below, 1) then return false end
  state.rose = probe.key(below, 1)
  local here, above, costly = probe.of(context, below, 1), probe.of(context, now, 1), state.choice.costly
  if not (here.ok and above.ok) or costly and costly(state.rung - 1, here, above, 1) then return false end
  local rung, was = state.rung, state.change
  state.rung, state.change = rung - 1, nil
  local c = compare(context, state, below, now)
  if c.worst <= 1 then
    state.change = c.all
    state.by, state.why = "compared", ("with %s %s"):format(state.choice.rungs[rung].as, changed_by(c))
    return true
  end
  state.rung, state.change = rung, was
  return false
end

--- Decides all choices until nothing changes: a later choice may undo a free one, or make a rung suffice that
-- did not before. Returns the computation of the chosen rungs on the coarsest level; nil: it failed.
function decide.settle(context)
  for _ = 1, 3 do
    local before = decide.rungs(context)
    decide_all(context)
    local same, now = true, decide.rungs(context)
    for _, state in ipairs(context.states) do
      local name = state.choice.name
      same = same and (state.choice.steady or before[name] == now[name])
    end
    if same and not is_overdrawn(context) then break end
  end
  for _, state in ipairs(context.states) do may_fall(context, state) end
  local base = probe.of(context, decide.rungs(context), 1)
  if not base.ok then
    if base.raised then error(base.raised, 0) end
    return nil
  end
  return base
end

return decide
