-- SPDX-License-Identifier: GPL-3.0-or-later
--- Compares a rung of a choice with the next one on coarse levels of edges and steps, until it is clear
-- whether it suffices.
-- @module softworld.model.compare
local change = require "softworld.model.change"
local probe = require "softworld.model.probe"
local quantity = require "softworld.quantity"
local estimate = require "softworld.run.estimate"

local compare = {}

local DOUBT = 2 -- changes above the allowed one over this are compared on a finer mesh too [-]
local MOMENT = 1e5 -- iterations times nodes that cost nothing worth saving: about 70 ms [-]
local LITTLE = 2 -- work or time of the next rung over that of a rung that costs little less [-]
local GROWS = 4  -- work of a level over that of the level before [-]
local FAR = 100    -- change over the allowed one that cannot come from coarse edges [-]
local HOPE = 4     -- a change shrinks at most by this factor from level to level [-]
local FEIGNED = 16 -- change over the allowed one that coarse edges cause only if poses jump elsewhere [-]
local HIDDEN = 4   -- coarse edges and steps that blur a change may hide this many times as much [-]
local HIDES = 2 / 3 -- largest change with hidden part over the allowed one; the rest is for edges, steps [-]
local SEEN = 1 / HIDDEN -- least share of a swing that steps must show; less would hide more than HIDDEN [-]
local TOILS = 2    -- wide steps over those of the rung above which they save nothing; mostly below 1.5 [-]
local SWELLS = 4   -- growth of a peak's change per level from which its value is not known yet [-]
local NONE = 0 / 0 -- value of a check's row that a computation lacks

compare.levels = 3 -- coarse levels on which rungs are compared [-]
compare.BRIEF = 3e3 -- iterations times nodes beside which the next rung costs little: about 2 ms [-]

--- Returns the finest level on which rungs of a choice are compared. Levels left out count.
function compare.last(context, choice)
  return math.max(1, (choice.levels or compare.levels) - context.skipped)
end

-- True if comparing on level k saves nothing and takes more than a moment: the next rung's run would need
-- only this level more; or the next rung takes little more than the rung, so that computing both here costs
-- what the cheaper one might save on a finer level. Rungs that have as many levels as the next one save
-- little in short runs too. last: both rungs on level k - 1, before: the next rung on k - 2.
local function saves_nothing(context, state, last, before, k)
  local above = last.above
  local work = above.work ^ 2 / math.max(1, before.work) -- expected
  local little = above.work < LITTLE * last.here.work
  local least = little and not state.choice.rough and compare.BRIEF or MOMENT
  if k < compare.levels or work < least then return false end
  if little then return true end
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

--- Returns the change between a rung and the next on the coarsest level if no finer level can make it small;
-- else nil.
function compare.far(context, state, here, there)
  if jumps(here) or jumps(there) then return nil end
  local c = change.between(context, state, { k = 1, here = here, above = there }, change.left_by_others)
  return c.worst > FAR and c or nil
end

-- True if a quantity is the largest or least of many values. Neither wide steps nor the coarsest edges show
-- the short event that may make it: a wire's end that falls off a wall.
local function asks_for_peaks(context)
  for _, q in ipairs(context.job.quantities) do
    if q.plain then return true end
  end
  return false
end

-- True if the level tells too little of the next rung to decide. Else false; and the change together with
-- what may be hidden, if that is still small enough.
local function is_blurred(context, state, now, c)
  local choice = state.choice
  if now.k > 1 then return false end
  if choice.rungs[state.rung].own then return true end -- the next rung's own error is unknown
  if c.worst > 1 then return c.worst <= FAR or jumps(now.here) or jumps(now.above) end
  if choice.blurred and now.above.contact and asks_for_peaks(context) then return true end
  local above, share = now.above.facts[choice.name], change.tightest(context, now.above.values)
  if not choice.blurred or not choice.blurred(now.here.facts[choice.name], above, share) then return false end
  local all = change.hidden(c, HIDDEN)
  local seen = choice.shows and choice.shows(above, jumps(now.here)) or 0
  if all.worst < HIDES and seen > SEEN then return false, all end
  return true
end

-- True if what the next rung changes of a peak has grown much since the level before.
local function peak_grows(context, now)
  local before = now.coarser and now.coarser.seen
  for _, q in ipairs(before and context.job.quantities or {}) do
    local seen = now.seen[q.name]
    if q.plain and seen > change.FAINT and seen > SWELLS * before[q.name] then return true end
  end
  return false
end

-- True if the rung may not stay by this comparison, though the change is small: the choice doubts it on the
-- first coarse levels.
local function is_doubtful(context, state, now, c, levels)
  local choice = state.choice
  if not choice.doubtful or c.worst == 0 or c.worst > 1 or now.k >= levels then return false end
  return choice.doubtful(now.here.facts[choice.name], now.k, peak_grows(context, now))
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

-- Returns the change on level k by wide steps; nil: they show too little, or they are no saving. Also returns
-- whether the next rung failed, or its steps were far too many.
local function glance_at(context, state, rungs, above, k)
  local choice, here = state.choice, probe.of(context, rungs, k)
  if not here.ok or here.work < compare.BRIEF or jumps(here) or asks_for_peaks(context) then return nil end
  if choice.toils and choice.toils(state.rung, here) then return nil end -- the full cost must be known
  local there = probe.glance(context, above, k, choice, TOILS * here.steps)
  if not there.ok then return nil, true end
  if jumps(there) then return nil end
  local now = { k = k, here = here, above = there, rungs = rungs, wide = true }
  local c, f = change.between(context, state, now, change.left_by_others), there.facts[choice.name]
  local all = change.hidden(c, HIDDEN)
  if all.worst >= HIDES or choice.shows(f) <= SEEN then return nil end
  now.worst, state.compared = c.worst, now
  local share = change.tightest(context, there.values)
  return choice.blurred(here.facts[choice.name], f, share) and all or c
end

--- Compares a rung with the next one on wide steps. Returns the change if it is so small that it stays within
-- what is allowed even if these steps hide most of it; nil: computing the next rung in full tells, or costs
-- little anyway. Also returns the level on which the next rung can be computed, as far as wide steps tell: on
-- the coarsest edges they may fail.
function compare.glance(context, state, rungs, above)
  local k = state.from or 1
  if not state.choice.widen then return nil, k end
  local c, failed = glance_at(context, state, rungs, above, k)
  if not failed or k >= compare.last(context, state.choice) then return c, k end
  c, failed = glance_at(context, state, rungs, above, k + 1)
  return c, failed and k or k + 1
end

--- Returns the computation of the next rung on the coarsest edges on which both rungs can be computed, and
-- its level: the first, or for a rung that may be replaced, the second, as contact on coarse edges may make
-- steps collapse. first: the level to begin with. If both fail, returns that of the first level.
function compare.above(context, state, rungs, above, first)
  local other = state.choice.instead and compare.last(context, state.choice) > 1 and 2 or 1
  for _, k in ipairs { first > 1 and other or 1, first > 1 and 1 or other } do
    local there = probe.of(context, above, k)
    if there.ok and probe.of(context, rungs, k).ok then return there, k end
  end
  return probe.of(context, above, 1), 1
end

-- Returns the comparison on the level before k, if both rungs are known there. A comparison on finer edges
-- then tells as much as one that came from that level: how the change moves, and whether it is steady.
local function level_before(context, state, rungs, above, k)
  local here = k > 1 and probe.known(context, rungs, k - 1)
  local there = here and probe.known(context, above, k - 1)
  if not (there and here.ok and there.ok) then return nil end
  local now = { k = k - 1, here = here, above = there }
  local c = change.between(context, state, now, change.left_by_others)
  now.worst, now.seen = c.worst, c.seen
  return now
end

--- Compares a rung with the next on the coarsest level, or from level `begin` on, and on finer levels while a
-- too large change becomes smaller: coarse steps must not rule out a cheap rung. Returns the change, and why
-- the next rung failed.
function compare.rungs(context, state, rungs, above, begin)
  local rung, levels = state.choice.rungs[state.rung], compare.last(context, state.choice)
  local wide = state.compared and state.compared.wide -- wide steps tell no change
  local first = math.max(begin or 1, wide and state.from or 1)
  local c, before, doubtful
  for k = first, levels do
    local again = before and before.before and before.before.above
    if again and not doubtful and saves_nothing(context, state, before, again, k) then return c end
    -- The final run can take over a third level without computing it again if it was the last to be computed.
    if k >= compare.levels and c and c.worst <= 1 then probe.of(context, above, k) end
    local here, there = probe.of(context, rungs, k), probe.of(context, above, k)
    if k > 1 and not (here.ok and there.ok) then return c, not there.ok and rung.own and there.reason end
    local now = { k = k, here = here, above = there, rungs = rungs, before = before }
    local last = c
    c, before, state.compared = change.between(context, state, now, change.left_by_others), now, now
    now.worst, now.seen = c.worst, c.seen
    now.coarser = last and now.before or level_before(context, state, rungs, above, k)
    local clear = c.worst < 1 / DOUBT or c.worst > HOPE ^ (levels - k) or k > 1 and c.worst <= 1
    if last and last.worst > FEIGNED and c.worst <= 1 then mark_astray(now, last) end
    local blurred, all = is_blurred(context, state, now, c)
    doubtful = is_doubtful(context, state, now, c, levels)
    if clear and not blurred and not doubtful and k >= (state.from or 1) then return all or c end
    local grows = last and not state.choice.steady and c.worst > 1
      and c.seen[c.quantity.name] >= last.seen[last.quantity.name]
    if grows then return c end
    local costly = state.choice.costly
    local depth = k + context.job.skipped
    if c.worst > 1 and costly and costly(state.rung, here, there, depth, true) then return c end
  end
  return c
end

--- Returns true if a rung that would stay leaves so little of a tolerance to edges and steps that it costs
-- more than the next rung. Errors shrink at best with the square of edges and steps, and work grows with that
-- square, so a share x of the tolerance takes 1 / x of the work. An iteration of the next rung may take more
-- time, up to LITTLE times. c: the change from compare.rungs.
function compare.is_narrow(context, state, c)
  local k, choice = state.compared.k, state.choice
  local here, above = state.compared.here, state.compared.above
  if choice.costly or choice.steady or GROWS ^ (compare.levels - k) * here.work < MOMENT then return false end
  local rest = 1
  for _, q in ipairs(context.job.quantities) do
    local asked = quantity.asked(q, change.known(context, q.name, k, above.values[q.name] or NONE))
    local left = change.left_by_others(context, q.name, state)
    local part = 1 - c.all[q.name] / (asked - left)
    rest = part < rest and part or rest -- NaN does not count
  end
  return LITTLE * above.work * rest < here.work
end

return compare
