-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks the finest run: whether it confirms the free checks, and whether the edges on which choices were
-- compared show the same state.
-- @module softworld.model.finest
local change = require "softworld.model.change"
local compare = require "softworld.model.compare"
local decide = require "softworld.model.decide"
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local probe = require "softworld.model.probe"
local quantity = require "softworld.quantity"

local finest = {
  SLACK = 2,     -- on the limits of free checks, when the finest run must confirm them [-]
  HOPELESS = 50, -- bar over tolerance that no other rung can mend [-]
}

--- Drops a free check that the finest run contradicts: its choice is decided again, by comparing. The other
-- choices follow, because it may leave out more now, or less. time: when this was seen [s].
function finest.given_up(context, state, time)
  local was, rung = state.choice.rungs[state.rung].as, state.rung
  state.lost = ('"%s" held on coarse edges, but not in the fine run'):format(state.known)
  if state.no_way then
    state.lost = ("%s: by %s %s, and the run began again, because %s"):format(state.lost,
      number.text(time, "s"), state.broke, state.no_way)
  end
  state.checked, state.by, state.known = true, nil, nil
  repeat until decide.look(context, state)
  if state.rung ~= rung then
    context.given_up[#context.given_up + 1] = { kind = "model", time = time, count = 1,
      text = ("%s: %s given up; %s"):format(state.choice.name, was, state.why) }
  end
  decide.settle(context)
end

-- True if the finest run can contradict the free check of a choice.
local function is_checked(state) return state.by == "free" and not state.went_on end

-- Returns what the finest run tells of choices with a free check to confirm, or with a `short`. For facts
-- that do not depend on the tolerance, only from frames that the guard has not seen.
local function last_facts(context, result)
  local seen, unseen = {}, {}
  for _, state in ipairs(context.states) do
    local asked = is_checked(state) or state.choice.short ~= nil
    local set = state.choice.by_itself and context.guard and unseen or seen
    set[state.choice.name] = asked
  end
  context.watching = true
  local found = probe.facts(context, result, seen)
  local late = next(unseen) and probe.facts(context, result, unseen, context.guard.from)
  context.watching = nil
  for name in pairs(unseen) do found[name] = late[name] end
  return found
end

-- True if poses jumped on the finest edges and left a bar too long for any finer ones.
local function is_lost(context, result)
  for _, q in ipairs(result.jumps > 0 and context.job.quantities or {}) do
    local now = context.job.read[q.name]
    if not q.row and now.least > finest.HOPELESS * quantity.asked(q, now.value) then return true end
  end
  return false
end

-- Gives up a rung whose edges of a comparison show another state than the finest run. was: the rung's words.
local function moved_on(context, state, was)
  context.given_up[#context.given_up + 1] = { kind = "model", time = context.scene.time, count = 1,
    text = ("%s: %s given up: finer edges show another state than the coarse edges of the comparison: "
      .. "%s"):format(state.choice.name, was, state.why) }
  decide.settle(context)
  return true
end

-- True if finer edges may shorten bars that are too long, now that a rung is known to leave out more.
local function needs_finer(context, result)
  if #context.job.levels >= context.job.most then return false end
  for _, q in ipairs(result:error_bars()) do
    if q.error + change.left_out(context, q.name) > q.tolerance then return true end
  end
  return false
end

-- Returns the level of a choice's next comparison: a finer one; or the same again if the last one was of
-- another mesh than the finest run's, as meshes have edges of their own.
local function next_level(context, state)
  local k, was = state.compared.k, state.compared.rungs
  for _, other in ipairs(context.states) do
    if other.choice.steady and was[other.choice.name] ~= other.rung then return k end
  end
  return k + 1
end

-- Compares a choice on finer edges as long as the edges it was compared on show another state than the finest
-- run. Nothing is compared if its rung cannot meet the tolerance there: then the next rung is taken. Returns
-- true if another rung is chosen, or the run needs finer edges.
local function compared_finer(context, state, fine, result)
  local rung, as = state.rung, state.choice.rungs[state.rung].as
  local last, first = compare.last(context, state.choice), state.compared
  while change.is_elsewhere(context, state, fine) and state.compared.k < last do
    if state.rung < state.last and is_lost(context, result) then
      decide.raise(context, state, ("%s jump on fine edges, which leaves an error bar of more than %d times "
        .. "the tolerance"):format(as, finest.HOPELESS))
      return moved_on(context, state, as)
    end
    local before = state.compared
    state.from, state.by = next_level(context, state), nil
    repeat until decide.look(context, state)
    if state.rung ~= rung then return moved_on(context, state, as) end
    if state.compared == before then break end -- the next rung cannot be computed any more
  end
  return state.compared ~= first and needs_finer(context, result)
end

-- Settles a choice anew if the finest run shows that its free check tells nothing, nor would the next rung.
local function not_checked(context, state, f, share)
  local why = state.choice.skip and state.choice.skip(context, state.rung, f, share)
  if why then state.by, state.why, state.known, state.doubt = "skipped", nil, nil, why end
end

--- Checks the finest run; true if it must be computed again.
function finest.broken(context, result)
  local values = {}
  for name, q in pairs(result.quantities) do values[name] = q.value end
  local found, share = last_facts(context, result), change.tightest(context, values)
  local fine = { values = values, shape = facts.shape(context.scene) }
  local again, ran = false, decide.rungs(context)
  for _, state in ipairs(context.states) do
    local f, same = found[state.choice.name], state.rung == ran[state.choice.name]
    if same and is_checked(state) and state.choice.broken(f, finest.SLACK * share, state.rung) then
      finest.given_up(context, state, context.scene.time)
      again = true
    elseif same and is_checked(state) then
      not_checked(context, state, f, finest.SLACK * share)
    end
    again = again or same and state.choice.by_state and compared_finer(context, state, fine, result)
    state.short = state.choice.short and state.choice.short(context, f, share, state)
  end
  return again
end

return finest
