-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:run{ tolerance = { quantity = value }, model = "auto" }: no more model than the quantities need.
--
-- Every choice begins at its cheapest rung. Where a free check tells that it suffices, it stays. Otherwise
-- the next rung is computed too, on coarse edges and steps, and what the quantities change by decides: a rung
-- stays where the change is a small part of what was asked for. Then edges and steps are refined for the
-- rungs chosen, and what the finest run tells must still bear out the free checks.
-- @module softworld.model.choose
local answer = require "softworld.model.answer"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local mesh = require "softworld.model.mesh"
local number = require "softworld.output.number"
local probe = require "softworld.model.probe"
local process = require "softworld.run.process"
local quantity = require "softworld.quantity"
local refine = require "softworld.run.refine"
local registry = require "softworld.model.registry"
local spread = require "softworld.model.spread"
local trust = require "softworld.run.trust"

local choose = {}

local MODEL = 0.75 -- of a tolerance: what rungs may leave out [-]
local LEAST = 0.25 -- of a tolerance: what edges and steps may always take [-]
-- a change that is not smaller than what is allowed by this is looked at on a finer mesh [-]
local DOUBT = 4
local LEVELS = 3   -- coarse ones on which rungs are compared
local HOPE = 4     -- by how much a change may shrink from level to level [-]
local HOPELESS = 50 -- a bar over what is asked: no other rung will mend that [-]
local NONE = 0 / 0 -- the value of a check's row that a computation has not
local LONGEST = 300 -- that a level is expected to take [s]
local SLACK = 2    -- of the limits of free checks, when the finest run is asked whether they hold [-]

local function rungs_of(context)
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

-- The tightest tolerance over its value [-].
local function tightest(context, values)
  local share = 1
  for _, q in ipairs(context.job.quantities) do
    local value = values[q.name] or NONE
    local size, asked = quantity.size(value), quantity.asked(q, value)
    if size > 0 and size < math.huge then share = math.min(share, asked / size) end
  end
  return share
end

-- --- one choice ---------------------------------------------------------------------------

-- What the rungs chosen leave out of a quantity, by comparing, in its unit; but one choice.
local function left_out(context, name, but)
  local sum = 0
  for _, state in ipairs(context.states) do
    sum = sum + (state.change and state ~= but and (state.change[name] or 0) or 0)
  end
  return sum
end

-- By how much quantities change between two results, with what is allowed: the worst share, its quantity,
-- all.
-- before: by the next rung, on a coarser level; what that changed by counts too.
local function change(context, state, here, above, before)
  local c = { worst = -1, all = {} }
  for _, q in ipairs(context.job.quantities) do
    local a, b = here.values[q.name] or NONE, above.values[q.name] or NONE
    local d = quantity.alike(a, b) and quantity.distance(a, b) or math.huge
    if before and quantity.alike(before.values[q.name], b) then
      d = d + quantity.distance(before.values[q.name], b)
    end
    if d ~= d then d = math.huge end
    c.all[q.name] = state.choice.safety * d
    local allowed = math.max(0, MODEL * quantity.asked(q, b) - left_out(context, q.name, state))
    local off = d > 0 and c.all[q.name] / allowed or 0
    if off > c.worst then c.worst, c.quantity, c.allowed = off, q, allowed end
  end
  return c
end

-- The same on the coarsest level, and on finer ones as long as a change that is too large becomes smaller: a
-- cheap rung must not pay for coarse steps. Nothing is computed twice.
local function compare(context, state, rungs, above)
  local c
  local rung, levels, before = state.choice.rungs[state.rung], state.choice.levels or LEVELS, nil
  for k = 1, levels do
    local here, there = probe.of(context, rungs, k), probe.of(context, above, k)
    if k > 1 and not (here.ok and there.ok) then return c, not there.ok and rung.own and there.reason end
    c = change(context, state, here, there, rung.own and before)
    before = there
    local first = rung.own and k == 1 -- how far the next rung itself is off is not known yet
    local clear = c.worst < 1 / DOUBT or c.worst > HOPE ^ (levels - k) or k > 1 and c.worst <= 1
    if clear and not first then return c end
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
  state.rung, state.by, state.raised, state.why, state.checked = 1, nil, nil, nil, nil
end

-- The choices after it begin anew: they were made with the rung that is given up.
local function raise_rung(context, state, why)
  state.rung, state.by, state.raised, state.why = state.rung + 1, "raised", why, why
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
  local share = result.values and tightest(context, result.values) or 1
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

-- One look at a choice; true when it is settled.
local function look(context, state)
  local choice, rungs = state.choice, rungs_of(context)
  local name, rung = choice.name, state.rung
  local here = probe.of(context, rungs, 1)
  local mender, because = mends(context, here)
  if mender then
    raise_rung(context, mender, because)
    others_anew(context, mender)
    return false
  end
  if here.unmade and bar_rung(context, here) then return false end
  if not here.ok then
    if rung == state.last or here.raised then return stay(state, "failed") end
    raise_rung(context, state, ("%s cannot be computed: %s"):format(choice.rungs[rung].as, here.reason))
    return false
  end
  local f = here.facts[name]
  if choice.idle and choice.idle(f) then
    return stay(state, "idle")
  end
  local why, more
  if choice.free and not state.checked then
    why, more = choice.free(context, rung, f, tightest(context, here.values))
  end
  state.doubt = not why and more or nil
  if why then
    state.known, state.change = why, more and of_values(context, here.values, more)
    return stay(state, "free", why)
  end
  if rung == state.last then return stay(state, "last") end
  local skip = choice.skip and choice.skip(context, rung, f, tightest(context, here.values))
  if skip then
    state.doubt = skip
    return stay(state, "skipped")
  end
  if state.barred then return unknown(context, state, f, here, state.barred) end
  local up = with(rungs, name, rung + 1)
  local above = probe.of(context, up, 1)
  local next_as = choice.rungs[rung + 1].as
  if not above.ok then
    return unknown(context, state, f, here, ("%s cannot be computed: %s"):format(next_as, above.reason))
  end
  local c, blind = compare(context, state, rungs, up)
  if blind then
    return unknown(context, state, f, here, ("%s cannot be computed finer: %s"):format(next_as, blind))
  end
  local costly = choice.costly and choice.costly(rung, here, above)
  if costly then raise_rung(context, state, costly)
  elseif c.worst > 1 then raise_rung(context, state, ("with %s %s"):format(next_as, changed_by(c)))
  else
    state.change = c.all
    return stay(state, "compared", ("with %s %s"):format(next_as, changed_by(c)))
  end
  return false
end

local function decide(context)
  for _, state in ipairs(context.states) do
    if state.by ~= "given" then
      state.by, state.known, state.doubt, state.change = nil, nil, nil, nil
      repeat until look(context, state)
    end
  end
end

-- Until nothing changes: what is chosen later may undo what was free before.
local function settle(context)
  for _ = 1, 3 do
    local before = rungs_of(context)
    decide(context)
    local same, now = true, rungs_of(context)
    for _, state in ipairs(context.states) do
      local name = state.choice.name
      same = same and (state.choice.steady or before[name] == now[name])
    end
    if same then break end
  end
  local base = probe.of(context, rungs_of(context), 1)
  if not base.ok then
    if base.raised then error(base.raised, 0) end
    return nil
  end
  return base
end

-- --- the run --------------------------------------------------------------------------------

-- Do the values of k levels already have the bars that are asked for?
local function suffices(job, k, contact)
  if k < LEVELS then return false end
  for _, q in ipairs(job.quantities) do
    local values = job.values[q.name]
    if trust.estimate(q, values, contact) > q.aim(quantity.asked(q, values[k])) then return false end
  end
  return true
end

-- No finer levels than can be waited for; two tell a bar.
local function affordable(context)
  local job, rungs = context.job, rungs_of(context)
  job.most, context.dear = context.most, nil
  for k = 3, context.most do
    local time = probe.expected(context, rungs, k)
    if time and time > LONGEST then
      job.most = k - 1
      context.dear = time == math.huge and ("there is no finer mesh than that of level %d"):format(k - 1)
        or ("edges and steps of level %d would take about %s: not computed"):format(k, number.duration(time))
      return
    end
  end
end

-- The finest run of the rungs chosen.
local function refined(context)
  local job, steps = context.job, nil
  for _, q in ipairs(job.quantities) do
    local left = left_out(context, q.name)
    function q.aim(asked) return math.max(asked - left, asked * LEAST, context.spread:floor(q)) end
  end
  job.levels, job.contact, job.finest, job.begun = {}, nil, nil, 0
  for name in pairs(job.values) do job.values[name] = {} end
  for k = 1, LEVELS do -- what was computed on the way is not computed again
    local known = probe.known(context, rungs_of(context), k)
    if not known or not known.ok then break end
    for name, values in pairs(job.values) do values[k] = known.values[name] or NONE end
    if suffices(job, k, known.contact) then break end -- the scene is to end there
    job.levels[k], job.begun = known.level, k
  end
  for _, values in pairs(job.values) do
    for k = job.begun + 1, #values do values[k] = nil end
  end
  affordable(context)
  job.restore()
  function job.arrange() steps = probe.arrange(context, rungs_of(context)) end
  local total = { wall = 0, cpu = 0 }
  local result = trust.work(job, function(k, name)
    return refine.computer(job, steps, context.run_once, total)(k, name)
  end)
  result.wall, result.cpu = total.wall, total.cpu
  return result
end

-- A free check that the finest run does not bear out is no reason any more: its choice is compared.
local function given_up(context, state)
  local was, why = state.choice.rungs[state.rung].as, state.known
  state.checked, state.by, state.known = true, nil, nil
  local rung = state.rung
  repeat until look(context, state)
  local text = ("in the fine run it does not hold any more that %s"):format(why)
  state.why = state.why and text .. "; " .. state.why or text
  if state.rung == rung then return end
  context.given_up[#context.given_up + 1] = { kind = "model", time = context.scene.time, count = 1,
    text = ("%s: %s given up; %s"):format(state.choice.name, was, state.why) }
end

-- Look at what the finest run tells; true when it is to be computed again.
local function broken(context, result)
  local values = {}
  for name, q in pairs(result.quantities) do values[name] = q.value end
  local facts, share = probe.facts(context, result), tightest(context, values)
  local again = false
  for _, state in ipairs(context.states) do
    local f = facts[state.choice.name]
    if state.by == "free" and not state.choice.free(context, state.rung, f, SLACK * share) then
      given_up(context, state)
      again = true
    end
    state.short = state.choice.short and state.choice.short(context, f, share, state)
  end
  return again
end

-- A bar that stays too long may be the rung's own, as friction makes bars of poses: the first choice that
-- the quantity depends on goes up. True when it does.
local function shorter(context, result)
  if context.dear then return false end -- the bars are those of a mesh that is not to be finer
  for _, state in ipairs(context.states) do
    if state.choice.steady and state.by == "failed" then return false end -- not met in any case
  end
  for _, q in ipairs(result:error_bars()) do
    local hopeless = q.error > HOPELESS * q.tolerance or q.error <= context.spread:floor(q)
    for _, state in ipairs(not q.met and not hopeless and context.states or {}) do
      local depends = state.by == "free" and state.choice.name == "motion"
        or state.by == "compared" and (state.change[q.name] or 0) > 0
      if state.rung < state.last and depends and not state.choice.steady then
        raise_rung(context, state, ("with %s the bar of %s stays at %s (asked for %s)"):format(
          state.choice.rungs[state.rung].as, q.name, number.text(q.error, q.unit),
          number.text(q.tolerance, q.unit)))
        settle(context)
        return true
      end
    end
  end
  return false
end

local function compute(context)
  local base = settle(context)
  if base then context.spread:look(rungs_of(context), base) end
  for _ = 1, 2 * #context.states do
    local result = refined(context)
    if result.refused or not broken(context, result) and not shorter(context, result) then return result end
  end
  return refined(context)
end

local function new_context(scene, job, args, run_once)
  local data = build.data(scene)
  local context = { scene = scene, data = data, job = job, args = args, run_once = run_once, probes = {},
    probe_count = 0, spent = 0, states = {}, given_up = {},
    scripted_contact = data.touching }
  context.spread = spread.new(context)
  return context
end

local function begin(context)
  trust.open(context.job)
  if not context.args.quasistatic then refine.look(context.job) end
  for i, choice in ipairs(registry.list) do
    if choice.begin then choice.begin(context) end
    local state = { choice = choice, rung = 1, last = #choice.rungs }
    local why, rung
    if choice.given then why, rung = choice.given(context) end
    if why then state.by, state.why, state.rung = "given", why, rung end
    context.states[i] = state
  end
end

--- Is a model to be chosen? Raises where it cannot be.
function choose.wanted(scene, args)
  if type(args) ~= "table" then return false end
  local word = args.model
  if word ~= nil and word ~= "auto" then
    error(("scene:run: model = %s is not allowed; it must be 'auto', or left out: each wire has its own "
      .. "model")
      :format(checks.shown(word)), 0)
  end
  local named
  for _, w in ipairs(build.data(scene).wires) do named = named or core.data(w.object).auto and w.name end
  if word == nil and not named then return false end
  if type(args.tolerance) ~= "table" and args.check == nil then
    error(("scene:run: %s needs to know what for: give tolerance = { quantity = value } or check = {...}, "
      .. "see help 'auto'")
      :format(word and "model = 'auto'" or ("wire '%s' has model = 'auto', which"):format(named)), 0)
  end
  return true
end

--- The run, with run.model and run:why().
function choose.run(scene, given, check, run_once)
  local args = {}
  for key, value in pairs(given) do args[key] = value end
  args.model = nil
  mesh.undo(scene)
  local job = refine.job(scene, args, check)
  local context = new_context(scene, job, args, run_once)
  local touching = context.data.touching
  context.most = job.most
  local fine, result = pcall(function()
    begin(context)
    return compute(context)
  end)
  context.data.auto = nil
  if not fine or result.refused then
    context.data.touching = touching
    if job.restore then
      job.restore()
      process.renew(scene, {})
      job.begin_processes()
    end
  end
  if job.close then job.close() end
  if not fine then error(result, 0) end
  return answer.add(context, result)
end

return choose
