-- SPDX-License-Identifier: GPL-3.0-or-later
--- Decides the choices of a model by coarse computations, each from its cheapest rung up to the first that
-- leaves out no more than a part of the tolerance.
-- @module softworld.model.decide
local change = require "softworld.model.change"
local compare = require "softworld.model.compare"
local dearer = require "softworld.model.dearer"
local number = require "softworld.output.number"
local probe = require "softworld.model.probe"
local quantity = require "softworld.quantity"
local estimate = require "softworld.run.estimate"

local decide = {}

local MODEL = change.MODEL
local HARDLY = 1e-6 -- change over the allowed one that is not worth a number [-]
local NONE = 0 / 0 -- value of a check's row that a computation lacks

decide.levels = compare.levels -- coarse levels on which rungs are compared [-]

--- Returns the chosen rungs by the names of the choices.
function decide.rungs(context)
  local rungs = {}
  for _, state in ipairs(context.states) do rungs[state.choice.name] = state.rung end
  return rungs
end

--- Returns the choice whose rung costs more than the next one, judged by a run on level k, and why; nil:
-- there is none. This may compute another run and leave the scene in its final state.
function decide.wasteful(context, k, run)
  local rungs = decide.rungs(context)
  for _, state in ipairs(context.states) do
    local open = state.by ~= "given" and not state.went_on and state.rung < state.last and state.choice.toils
    local above = open and open(state.rung, run) and dearer.iterations(context, state, rungs, k)
    local why = above and state.choice.costly(state.rung, run, { iterations = above },
      k + context.job.skipped)
    if why then return state, why end
  end
end

-- Returns by how much the worst quantity changes between two rungs, as text.
local function changed_by(c)
  local q = c.quantity
  if c.worst == 0 then return "nothing changes" end
  if c.worst < HARDLY then return "hardly anything changes" end
  return ("%s changes by up to %s, %s %s"):format(q.name, number.text(c.all[q.name], q.unit),
    c.worst > 1 and "more than the allowed" or "less than the allowed", number.text(c.allowed, q.unit))
end

-- Starts a choice again. What a fine run has shown of its free check still holds.
local function begin_anew(state)
  state.rung, state.by, state.raised, state.why, state.rose, state.found = 1, nil, nil, nil, nil, nil
end

--- Raises a choice by one rung. The choices after it start again, as they were decided with the old rung.
function decide.raise(context, state, why)
  if state.choice.instead and context.unskip then context.unskip() end -- the next rung begins on all levels
  state.rung, state.by, state.raised, state.why, state.rose = state.rung + 1, "raised", why, why, nil
  local after = false
  for _, other in ipairs(context.states) do
    if after and other.by ~= "given" and not other.choice.steady then begin_anew(other) end
    after = after or other == state
  end
end

-- Settles a choice with what a fine run has shown of it, why it was raised, and why it stays. Returns true.
local function stay(state, by, why)
  local reasons = {}
  for _, words in ipairs { state.lost or false, state.raised or false, why or false } do
    if words then reasons[#reasons + 1] = words end
  end
  state.by, state.why = by, reasons[1] and table.concat(reasons, "; ")
  return true
end

-- Returns the choice whose next rung can compute what this one cannot, and why.
local function mends(context, result)
  local share = result.values and change.tightest(context, result.values) or 1
  for _, state in ipairs(context.states) do
    local why = state.by ~= "given" and not state.barred and state.rung < state.last and state.choice.mends
      and state.choice.mends(context, state.rung, result, share)
    if why then return state, why end
  end
end

-- Returns a share of each value, in its unit. share: also a function of the quantity.
local function of_values(context, values, share)
  local all = {}
  for _, q in ipairs(context.job.quantities) do
    local size = quantity.size(values[q.name] or NONE)
    local part = type(share) == "function" and share(q) or share
    all[q.name] = size < math.huge and part * size or 0
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
-- levels of the present rung show it. They are asked for any mesh: they cost little beside one, and the
-- expected time of a mesh is often too short where the scene begins at rest.
local function in_vain(context, rungs, up)
  local time, job = probe.expected(context, up, 2), context.job -- two levels make a bar
  if not time then return nil end
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

-- Same, found only once for the same rungs: the expected time changes as more is computed.
local function known_in_vain(context, rungs, up)
  local key, known = probe.key(up, 1), context.vain
  if known[key] == nil then known[key] = in_vain(context, rungs, up) or false end
  return known[key]
end

-- Settles a choice by what the next rung changes. here: the computation of its rung on the coarsest level.
local function stays(state, c, next_as, here)
  local why = ("with %s %s"):format(next_as, changed_by(c))
  state.change, state.found = c.all, { rung = state.rung, all = c.all, why = why,
    faint = c.worst < change.FAINT and here.facts[state.choice.name] or nil }
  return stay(state, "compared", why)
end

-- Settles a choice again, after others have risen, if its next rung changed next to nothing before and the
-- rung acts as it did then. Returns nil if it must be compared again.
local function stays_faint(state, here)
  local found, alike = state.found, state.choice.alike
  if not found or found.rung ~= state.rung or not found.faint or not alike then return nil end
  if not alike(found.faint, here.facts[state.choice.name]) then return nil end
  state.change = found.all
  return stay(state, "compared", found.why)
end

-- Settles a choice by what was found before, with cheaper rungs of later choices, if the next rung cannot be
-- computed any more: a wire that rolls cannot become a mesh between pads. Returns nil if nothing was found,
-- or if others leave out more now. why: what failed.
local function stays_as_before(context, state, why)
  local found, base = state.found, probe.of(context, decide.rungs(context), 1)
  if not found or found.rung ~= state.rung then return nil end
  for _, q in ipairs(context.job.quantities) do
    local value = change.known(context, q.name, 1, base.values[q.name] or NONE)
    local left = change.left_by_others(context, q.name, state)
    local enough = found.all[q.name] + left <= MODEL * quantity.asked(q, value) -- false for NaN
    if not enough then return nil end
  end
  state.change = found.all
  return stay(state, "compared", ("%s, found with cheaper models of the other choices; now %s"):format(
    found.why, why))
end

-- Checks whether the next rung gives another answer. True when the choice is settled.
local function climb(context, state, rungs, here)
  local choice, rung = state.choice, state.rung
  local name, f = choice.name, here.facts[choice.name]
  local up = dearer.with(rungs, name, rung + 1)
  local next_as = choice.rungs[rung + 1].as
  if not state.from and stays_faint(state, here) then return true end -- from: finer edges are asked for
  if choice.rungs[rung].own and probe.expected(context, up, 2) == math.huge then -- one level tells nothing
    return unknown(context, state, f, here,
      ("%s cannot be computed on finer edges: there is no such mesh"):format(next_as))
  end
  local vain = choice.rungs[rung + 1].own and known_in_vain(context, rungs, up)
  if vain then
    state.doubt = vain
    return stay(state, "skipped", vain)
  end
  local seen, first = compare.glance(context, state, rungs, up)
  if seen then return stays(state, seen, next_as, here) end
  local above, k = compare.above(context, state, rungs, up, first)
  if not above.ok then
    local why = ("%s cannot be computed: %s"):format(next_as, above.reason)
    return stays_as_before(context, state, why) or unknown(context, state, f, here, why)
  end
  local costly = choice.costly and choice.costly(rung, probe.of(context, rungs, k), above,
    k + context.job.skipped)
  if costly then
    decide.raise(context, state, costly)
    return false
  end
  local c, blind = compare.rungs(context, state, rungs, up, k)
  if blind then
    return unknown(context, state, f, here, ("%s: no computation on finer edges: %s"):format(next_as, blind))
  end
  if c.worst > 1 then
    decide.raise(context, state, ("with %s %s"):format(next_as, changed_by(c)))
    state.rose = probe.key(rungs, 1)
    return false
  end
  if compare.is_narrow(context, state, c) then
    decide.raise(context, state, ("with %s %s, and finer edges and steps for the rest of the tolerance would "
      .. "cost more than %s"):format(next_as, changed_by(c), next_as))
    return false
  end
  return stays(state, c, next_as, here)
end

-- If no motion can be computed on the coarsest edges, begins again on finer ones. True if there are such.
local function begins_finer(context, here)
  if here.raised or here.unmade then return false end
  for _, state in ipairs(context.states) do
    if state.choice.instead and state.by ~= "given" and state.rung < state.last then return false end
    if state.choice.steady and state.rung > 1 then return false end -- a mesh has edges of its own
  end
  if not probe.finer(context) then return false end
  for _, state in ipairs(context.states) do
    if state.by ~= "given" then begin_anew(state) end
  end
  return true
end

-- If a rung that another may replace fails on the way on the coarsest edges, begins on the first finer edges
-- on which it can be computed: with edges as long as a bend a wire may have no equilibrium where one with
-- finer edges has. Such edges are looked for as long as failing again, with as many iterations, costs less
-- than the next rung on the same edges. True if there are such.
local function begins_later(context, state, rungs, here)
  local fails_late = state.choice.instead and state.rung < state.last and (here.steps or 0) > 0
  if not fails_late or here.raised or context.unskip then return false end
  for k = 2, compare.levels do
    if not dearer.is_next(context, state, rungs, k, here.iterations) then return false end
    if probe.of(context, rungs, k).ok then return probe.skip(context, rungs, k - 1) end
  end
  return false
end

-- Asks a choice for its free check on the coarsest level, and if that is worth it, on the next one. Returns
-- what choice.free does.
local function free_check(context, state, rungs, here)
  local choice, rung = state.choice, state.rung
  local f, share = here.facts[choice.name], change.tightest(context, here.values)
  local why, more = choice.free(context, rung, f, share)
  if why or not choice.again or here.work < compare.BRIEF or not choice.again(context, rung, f, share) then
    return why, more
  end
  local finer = probe.of(context, rungs, 2)
  if not finer.ok then return why, more end
  share = change.tightest(context, finer.values)
  local found, rest = choice.free(context, rung, finer.facts[choice.name], share)
  if found then return found, rest end
  return why, more
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
  if not here.ok and begins_finer(context, here) then return false end
  if not here.ok and begins_later(context, state, rungs, here) then return false end
  if not here.ok then
    if rung == state.last or here.raised then return stay(state, "failed") end
    decide.raise(context, state, ("%s cannot be computed: %s"):format(choice.rungs[rung].as, here.reason))
    return false
  end
  local f = here.facts[name]
  if choice.idle and choice.idle(f) then
    return stay(state, "idle")
  end
  local lacks, why, more = choice.lacks and choice.lacks(context, rung, f, here.values), nil, nil
  if lacks then
    decide.raise(context, state, lacks)
    return false
  end
  if choice.free and not state.checked then why, more = free_check(context, state, rungs, here) end
  state.doubt = not why and more or nil
  if why then
    state.known, state.change = why, more and of_values(context, here.values, more)
    return stay(state, "free", why)
  end
  if rung == state.last then return stay(state, "last") end
  local skip = choice.skip and choice.skip(context, rung, f, change.tightest(context, here.values))
  if skip then
    state.doubt = skip
    return stay(state, "skipped")
  end
  if state.barred then return unknown(context, state, f, here, state.barred) end
  return climb(context, state, rungs, here)
end

-- Raises a choice at once if the coarsest edges show that its rung is far off, and that the comparisons of
-- other choices before it would tell nothing: wires that pass through each other.
local function raise_first(context, state)
  local choice, rungs = state.choice, decide.rungs(context)
  if not choice.first or state.by == "given" or state.barred or state.rung == state.last then return end
  local here = probe.of(context, rungs, 1)
  if not here.ok or not choice.first(here.facts[choice.name]) then return end
  local there = probe.of(context, dearer.with(rungs, choice.name, state.rung + 1), 1)
  if not there.ok then return end
  local c = compare.far(context, state, here, there)
  if not c then return end
  decide.raise(context, state, ("with %s %s"):format(choice.rungs[state.rung + 1].as, changed_by(c)))
  state.rose = probe.key(rungs, 1)
end

-- Decides all choices in turn. What one may leave out is reduced by what the others are known to leave out.
local function decide_all(context)
  for _, state in ipairs(context.states) do raise_first(context, state) end
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
    local left = change.left_by_others(context, q.name)
    local value = change.known(context, q.name, 1, here.values[q.name] or NONE)
    if left > MODEL * quantity.asked(q, value) then return true end
  end
  return false
end

-- Goes back to the rung below if it suffices with the present rungs of the others; true if it does. What the
-- others leave out was found with the rung above, and the change between the two rungs is added to it.
local function may_fall(context, state)
  local now = decide.rungs(context)
  local below = dearer.with(now, state.choice.name, state.rung - 1)
  if not state.rose or state.choice.steady or state.rose == probe.key(below, 1) then return false end
  state.rose = probe.key(below, 1)
  local here, above, costly = probe.of(context, below, 1), probe.of(context, now, 1), state.choice.costly
  if not (here.ok and above.ok) then return false end
  if costly and costly(state.rung - 1, here, above, 1 + context.job.skipped) then return false end
  local rung, was = state.rung, state.change
  state.rung, state.change = rung - 1, nil
  local c = compare.rungs(context, state, below, now)
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
