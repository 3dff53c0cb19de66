-- SPDX-License-Identifier: GPL-3.0-or-later
--- Deciding the choices of a model, each by what coarse computations tell: from its cheapest rung up to one
-- that leaves out no more than a part of what is asked for.
-- @module softworld.model.decide
local change = require "softworld.model.change"
local number = require "softworld.output.number"
local probe = require "softworld.model.probe"
local quantity = require "softworld.quantity"
local estimate = require "softworld.run.estimate"

local decide = {}

local MODEL = change.MODEL
local DOUBT = 2 -- a change that is not smaller than what is allowed by this is looked at on a finer mesh [-]
local MOMENT = 1e5 -- iterations of nodes that nobody counts: some 70 ms [-]
local LONG = 1     -- expected of a mesh on the coarsest level, from which it is asked whether it helps [s]
local FAR = 100    -- a change over what is allowed that coarse edges do not feign [-]
local HOPE = 4     -- by how much a change may shrink from level to level [-]
local FEIGNED = 16 -- the same that coarse edges do only where poses jump to another place [-]
local HIDDEN = 4   -- of a change that coarse edges and steps blur: they may hide so many times as much [-]
local HIDES = 2 / 3 -- of what is allowed: what that may come to; more leaves edges and steps too little [-]
local SEEN = 0.1   -- of a swing: what steps must show for that [-]
local GROWTH = 2   -- iterations of the next rung over those of the level before, at least [-]
local NONE = 0 / 0 -- the value of a check's row that a computation has not

decide.levels = 3 -- coarse ones on which rungs are compared [-]

--- The rungs chosen, by the names of the choices.
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

-- Iterations that the next rung of a choice needs on level k at least, by what was computed of it on the way,
-- or now on the coarsest level; nil: it cannot be.
local function iterations_above(context, state, k)
  local up = with(decide.rungs(context), state.choice.name, state.rung + 1)
  for j = k, 2, -1 do
    local above = probe.known(context, up, j)
    if above and above.ok then return GROWTH ^ (k - j) * above.iterations end
  end
  local above = probe.of(context, up, 1)
  return above.ok and GROWTH ^ (k - 1) * above.iterations or nil
end

--- The choice whose rung costs more than the next one, as a run of the rungs chosen tells by what it needed
-- on level k, and why; nil: there is none. The scene may then be as another run left it.
function decide.wasteful(context, k, run)
  for _, state in ipairs(context.states) do
    local open = state.by ~= "given" and not state.went_on and state.rung < state.last and state.choice.toils
    local above = open and open(state.rung, run) and iterations_above(context, state, k)
    local why = above and state.choice.costly(state.rung, run, { iterations = above }, k)
    if why then return state, why end
  end
end

--- The tightest tolerance over its value [-].
function decide.tightest(context, values)
  local share = 1
  for _, q in ipairs(context.job.quantities) do
    local value = values[q.name] or NONE
    local size, asked = quantity.size(value), quantity.asked(q, value)
    if size > 0 and size < math.huge then share = math.min(share, asked / size) end
  end
  return share
end

--- What the rungs chosen leave out of a quantity, by comparing, in its unit; but one choice.
function decide.left_out(context, name, but)
  local sum = 0
  for _, state in ipairs(context.states) do
    sum = sum + (state.change and state ~= but and (state.change[name] or 0) or 0)
  end
  return sum
end

-- The same, of what may still be chosen otherwise: no other choice makes up for a rung that failed.
local function left_by_others(context, name, but)
  local sum = decide.left_out(context, name, but)
  for _, state in ipairs(context.states) do
    if state.by == "failed" and state ~= but and state.change then sum = sum - (state.change[name] or 0) end
  end
  return sum
end

-- Would a level more of the next rung be all that its run needs? Then comparing there saves nothing, and the
-- comparison ends where it takes more than a moment. above: the next rung on level k - 1, before: on k - 2.
local function saves_nothing(context, above, before, k)
  local growth = above.work / math.max(1, before.work)
  if k < decide.levels or growth * above.work < MOMENT then return false end
  for _, q in ipairs(context.job.quantities) do
    local value = above.values[q.name] or NONE
    local bar, rate = estimate.bar(q, { before.values[q.name] or NONE, value }, above.contact)
    local enough = bar / rate <= quantity.asked(q, value) -- of numbers that are not known: not
    if not enough then return false end
  end
  return true
end

-- Did poses jump? On coarse edges chance tells to where, and any change may come of that.
local function jumps(result) return (result.facts.motion.jumps or 0) > 0 end

-- Does the level tell too little of the next rung to stay, or to go? Or the change, with what may be hidden,
-- if it is still small then.
local function is_blurred(context, state, now, c)
  local choice = state.choice
  if now.k > 1 then return false end
  if choice.rungs[state.rung].own then return true end -- how far the next rung itself is off
  if c.worst > 1 then return c.worst <= FAR or jumps(now.here) or jumps(now.above) end
  local above, share = now.above.facts[choice.name], decide.tightest(context, now.above.values)
  if not choice.blurred or not choice.blurred(now.here.facts[choice.name], above, share) then return false end
  local all = change.hidden(c, HIDDEN)
  if all.worst < HIDES and choice.shows and choice.shows(above) > SEEN then return false, all end
  return true
end

-- Poses that jumped on the level before to where they do not go on this one: what they tell there is no level
-- of what they come to be. last: by how much the rungs differed there. By half of that at least one of them
-- has moved since.
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

-- The same on the coarsest level, and on finer ones as long as a change that is too large becomes smaller: a
-- cheap rung must not pay for coarse steps. Nothing is computed twice.
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

--- One rung up. The choices after it begin anew: they were made with the rung that is given up.
function decide.raise(context, state, why)
  state.rung, state.by, state.raised, state.why, state.rose = state.rung + 1, "raised", why, why, nil
  local after = false
  for _, other in ipairs(context.states) do
    if after and other.by ~= "given" and not other.choice.steady then begin_anew(other) end
    after = after or other == state
  end
end

-- Settled, and why: by the reason for which it went up, if it did, and the one for which it stays.
local function stay(state, by, why)
  state.by = by
  state.why = state.raised and why and state.raised .. "; " .. why or state.raised or why
  return true
end

-- The choice whose next rung computes what does not go with this one, and why.
local function mends(context, result)
  local share = result.values and decide.tightest(context, result.values) or 1
  for _, state in ipairs(context.states) do
    local why = state.by ~= "given" and not state.barred and state.rung < state.last and state.choice.mends
      and state.choice.mends(context, state.rung, result, share)
    if why then return state, why end
  end
end

-- What a share of each value is, in its unit.
local function of_values(context, values, share)
  local all = {}
  for _, q in ipairs(context.job.quantities) do
    local size = quantity.size(values[q.name] or NONE)
    all[q.name] = size < math.huge and share * size or 0
  end
  return all
end

-- Settled for want of the next rung; what is left out counts as far as it is known.
local function unknown(context, state, f, here, why)
  local left = state.choice.left and state.choice.left(state.rung, f)
  state.doubt, state.change = why, left and of_values(context, here.values, left)
  return stay(state, "failed", why)
end

-- What was found with a rung that is given up tells nothing.
local function others_anew(context, state)
  for _, other in ipairs(context.states) do
    if other ~= state and other.by ~= "given" then begin_anew(other) end
  end
end

-- Where wires cannot be made what a rung wants, the one below has to do; true when there is one.
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

-- Would a mesh be computed for bars that no level makes short enough? Lines on two levels tell; nil: not so.
local function in_vain(context, rungs, up)
  local time, job = probe.expected(context, up, 1), context.job
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

-- Does the next rung give another answer? True when the choice is settled.
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

--- One look at a choice; true when it is settled.
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

-- What the others leave out counts in what one may, as far as it is known.
local function decide_all(context)
  for _, state in ipairs(context.states) do
    if state.by ~= "given" then
      state.by, state.known, state.doubt, state.change = nil, nil, nil, nil
      repeat until decide.look(context, state)
    end
  end
end

-- Do the choices together leave out more than they may, each of them being allowed?
local function is_overdrawn(context)
  local here = probe.of(context, decide.rungs(context), 1)
  for _, q in ipairs(here.ok and context.job.quantities or {}) do
    local left = left_by_others(context, q.name)
    local value = change.known(context, q.name, 1, here.values[q.name] or NONE)
    if left > MODEL * quantity.asked(q, value) then return true end
  end
  return false
end

-- Would the rung below do after all, beside the rungs that the others have come to? True where it does: what
-- the others leave out was found with the rung above, and what that changes comes to it.
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

--- Decide all choices until nothing changes: what is chosen later may undo what was free before, or make do
-- with a rung that did not suffice before. Returns what was computed of them on the coarsest level; nil: that
-- failed.
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
