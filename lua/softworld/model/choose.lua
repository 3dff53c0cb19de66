-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:run{ tolerance = { quantity = value }, model = "auto" }: the cheapest model that suffices for the
-- quantities.
--
-- Every choice starts at its cheapest rung. If a free check shows that the rung suffices, it stays. Otherwise
-- the next rung is computed too, on coarse edges and steps; the rung stays if the quantities change by no
-- more than a part of the tolerance. Then edges and steps are refined for the chosen rungs, and the finest
-- run must still confirm the free checks.
-- @module softworld.model.choose
local answer = require "softworld.model.answer"
local build = require "softworld.scene.build"
local change = require "softworld.model.change"
local checks = require "softworld.checks"
local core = require "softworld.core"
local decide = require "softworld.model.decide"
local facts = require "softworld.model.facts"
local ended = require "softworld.model.ended"
local finest = require "softworld.model.finest"
local guard = require "softworld.model.guard"
local mesh = require "softworld.model.mesh"
local number = require "softworld.output.number"
local probe = require "softworld.model.probe"
local process = require "softworld.run.process"
local quantity = require "softworld.quantity"
local refine = require "softworld.run.refine"
local registry = require "softworld.model.registry"
local spread = require "softworld.model.spread"
local estimate = require "softworld.run.estimate"
local trust = require "softworld.run.trust"

local choose = {}

local LEAST = 1 - change.MODEL -- share of a tolerance that edges and steps always get [-]
local NONE = 0 / 0 -- value of a check's row that a computation lacks
local LONGEST = 300 -- longest expected time of a level [s]
local CONVERGES = 1.5 -- least change of a level over that of the next one, of values that converge [-]
local OWN = 4      -- a bar shortens by at most this times what the next rung changes [-]

-- True if the values of k levels already have short enough bars.
local function suffices(job, k, known)
  if k < decide.levels then return false end
  for _, q in ipairs(job.quantities) do
    local values = job.values[q.name]
    local bar = estimate.bar(q, values, known.contact, known.moves)
    if bar > q.aim(quantity.asked(q, values[k])) then return false end
  end
  return true
end

-- True if level k would take too long. Never below level 3: a bar needs two levels.
local function is_dear(context, k)
  if k < 3 then return false end
  local time = probe.expected(context, decide.rungs(context), k, context.job.levels)
  if not time or time <= LONGEST then return false end
  context.dear = time == math.huge and ("there is no finer mesh than that of level %d"):format(k - 1)
    or ("edges and steps of level %d were not computed: they would take about %s"):format(k,
      number.duration(time))
  return true
end

-- True if a rung of the run turns out to cost more than the next rung, before the bars are short enough.
local function is_wasteful(context, k)
  if not context.run_of[k] then return false end
  local state, why = decide.wasteful(context, k, context.run_of[k])
  context.wasteful = state and { state = state, why = why } or nil
  return state ~= nil
end

-- Returns the choice whose next rung may succeed where this one fails, or nil.
local function may_replace(context)
  for _, state in ipairs(context.states) do
    if state.choice.instead and state.by ~= "given" and state.rung < state.last then return state end
  end
end

-- True if the last level failed by a rung that can be replaced. Finer levels mostly fail too, and slowly.
local function has_failed(context)
  local levels = context.job.levels
  local last = levels[#levels]
  return last and not last.ok and may_replace(context) ~= nil
end

-- Limits the levels to those that do not take too long, by what is known before and after each level.
local function affordable(context)
  local job = context.job
  job.most, context.dear = context.most, nil
  for k = 3, context.most do
    if is_dear(context, k) then
      job.most = k - 1
      break
    end
  end
  function job.enough(k, good)
    return has_failed(context) or good >= 2 and (is_dear(context, k) or is_wasteful(context, k - 1))
  end
end

-- Returns the steps of levels, each with a guard that watches what the free checks rely on.
local function guarded(context, steps)
  local base = probe.known(context, decide.rungs(context), 1)
  local share = base and base.values and change.tightest(context, base.values)
  return function(k)
    local options = steps(k)
    if context.guard then context.guard:close() end
    context.guard = share and not context.unwatched and guard.new(context, finest.SLACK * share) or nil
    options.guard = context.guard
    return options
  end
end

-- Starts the levels of the run with those computed while choosing, so that nothing is computed twice. Returns
-- the kept run of the last of them if it suffices.
local function take_known(context)
  local job, kept = context.job, nil
  job.levels, job.contact, job.finest, job.begun = {}, nil, nil, 0
  for name in pairs(job.values) do job.values[name] = {} end
  local astray = 0 -- last level that says nothing about finer ones
  for k = 1, decide.levels do
    local known = probe.known(context, decide.rungs(context), k)
    if not known or not known.ok then break end
    astray = known.astray and k or astray
    for _, q in ipairs(job.quantities) do -- index 0 for an astray one: unused
      trust.add(q, job.values[q.name], k - astray, known.values[q.name] or NONE)
      if known.astray then job.values[q.name] = {} end
    end
    job.moves = known.moves
    if suffices(job, k, known) then -- the scene must end in its state
      kept = probe.as_it_ended(context, decide.rungs(context), k)
      break
    end
    job.levels[k], job.begun = known.level, k
  end
  for _, values in pairs(job.values) do
    for k = job.begun - astray + 1, #values do values[k] = nil end
  end
  return kept
end

-- Computes the finest run of the chosen rungs.
local function refined(context)
  local job, steps = context.job, nil
  for _, q in ipairs(job.quantities) do
    local left = change.left_out(context, q.name)
    function q.aim(asked) return math.max(asked - left, asked * LEAST, context.spread:floor(q)) end
  end
  local kept = take_known(context)
  affordable(context)
  if context.guard then context.guard:close() end
  context.guard = nil
  context.wasteful, context.run_of = nil, {}
  if not kept then job.restore() end
  function job.kept(k)
    local known = k == job.begun + 1 and kept
    kept = nil
    return known
  end
  function job.arrange()
    steps = guarded(context, probe.arrange(context, decide.rungs(context), nil, true))
  end
  local total = { wall = kept and kept.run.wall or 0, cpu = kept and kept.run.cpu or 0 }
  context.last = nil
  local result = trust.work(job, function(k, name)
    local begun = os.clock()
    local run = refine.computer(job, steps, context.run_once, total)(k, name)
    context.run_of[k] = { iterations = run.iterations, steps = run.steps }
    if k <= decide.levels then probe.keep(context, decide.rungs(context), k, run, os.clock() - begun) end
    return run
  end)
  result.wall, result.cpu = total.wall, total.cpu
  return result
end

-- True if a bar of poses comes from edges, as the values converge, and dynamics, which have the same edges,
-- would have a longer one with values like these: bars in motion count more of the earlier changes.
local function is_of_edges(context, q)
  local job = context.job
  local values = job.values[q.name]
  local entry
  for _, known in ipairs(job.quantities) do entry = known.name == q.name and known or entry end
  local _, rate = estimate.bar(entry, values, job.contact, false)
  return #values > 2 and rate >= CONVERGES and estimate.bar(entry, values, job.contact, true) > q.tolerance
end

-- True if the next rung of a choice may shorten the bar of a quantity enough. over: excess of the bar, with
-- what the rungs leave out. The next rung removes what this one leaves out, and it shortens a bar, which is
-- made of changes between levels, by at most OWN times its own change. Rough choices may mend any bar:
-- friction makes the bars of fine poses long; but not if the values converge.
local function may_mend(context, state, q, over)
  if state.choice.rough and is_of_edges(context, q) then return false end
  if state.by == "free" then return state.choice.name == "motion" and not q.met end
  local moved = state.by == "compared" and state.change[q.name] or 0
  return moved > 0 and (state.choice.rough and not q.met or over <= OWN * moved)
end

-- If a bar stays too long, raises the first choice whose next rung may mend it. True if one is raised.
local function shorter(context, result)
  if context.dear then return false end -- the mesh cannot be finer
  for _, state in ipairs(context.states) do
    if state.choice.steady and state.by == "failed" then return false end -- not met in any case
  end
  for _, q in ipairs(result:error_bars()) do
    local least = context.job.read[q.name].least -- coarse levels of a motion make a bar longer
    local hopeless = least > finest.HOPELESS * q.tolerance or q.error <= context.spread:floor(q)
    local all = q.error + change.left_out(context, q.name)
    local over = all - q.tolerance
    for _, state in ipairs(over > 0 and not hopeless and context.states or {}) do
      if state.rung < state.last and not state.choice.steady and may_mend(context, state, q, over) then
        decide.raise(context, state, ("with %s the error bar of %s is still %s (asked for %s)"):format(
          state.choice.rungs[state.rung].as, q.name, number.text(all, q.unit),
          number.text(q.tolerance, q.unit)))
        decide.settle(context)
        return true
      end
    end
  end
  return false
end

-- Computes the finest run; nil if its guard ended it.
local function watched(context)
  local fine, result = pcall(refined, context)
  if fine then return result end
  local found = guard.found(result)
  if not found then error(result, 0) end
  finest.given_up(context, found.state, found.time)
end

-- If a fine run failed by a rung that coarse runs could be computed with, raises its choice.
local function goes_on_above(context, result)
  if not result.refused then return false end
  local state = may_replace(context)
  if not state then return false end
  decide.raise(context, state, ("%s cannot be computed on finer edges: %s"):format(
    state.choice.rungs[state.rung].as, result.reason))
  decide.settle(context)
  return true
end

-- Gives up a rung that costs more than the next one.
local function spares(context)
  local found = context.wasteful
  if not found then return false end
  decide.raise(context, found.state, found.why)
  decide.settle(context)
  return true
end

local function is_good(context, result)
  if goes_on_above(context, result) or spares(context) then return false end
  return result.refused or not finest.broken(context, result) and not shorter(context, result)
end

local function compute(context)
  local base = decide.settle(context)
  if base then context.spread:look(decide.rungs(context), base) end
  for _ = 1, 2 * #context.states do
    local result = watched(context)
    if result then ended.begin(context, result) end
    if result and is_good(context, result) and ended.back(context) then return result end
    ended.close(context)
  end
  context.unwatched = true
  return refined(context)
end

local function new_context(scene, job, args, run_once)
  local data = build.data(scene)
  local context = { scene = scene, data = data, job = job, args = args, run_once = run_once, probes = {},
    levels = {}, finals = {},
    probe_count = 0, skipped = 0, states = {}, given_up = {}, vain = {},
    scripted_contact = data.touching }
  context.spread = spread.new(context)
  return context
end

local function begin(context)
  trust.open(context.job)
  context.start = facts.shape(context.scene)
  if not context.args.quasistatic then refine.look(context.job) end
  for i, choice in ipairs(registry.list) do
    if choice.begin then choice.begin(context) end
    local state = { choice = choice, rung = 1, last = #choice.rungs }
    local why, rung
    if choice.given then why, rung = choice.given(context) end
    if why then state.by, state.why, state.rung = "given", why, rung end
    context.states[i] = state
  end
  context.most = context.job.most
end

--- True if a model is to be chosen. Raises an error if that is impossible.
function choose.wanted(scene, args)
  if type(args) ~= "table" then return false end
  local word = args.model
  if word ~= nil and word ~= "auto" then
    error(("scene:run: model = %s is not allowed; it must be 'auto'; else each wire has its own model")
      :format(checks.shown(word)), 0)
  end
  local named
  for _, w in ipairs(build.data(scene).wires) do named = named or core.data(w.object).auto and w.name end
  if word == nil and not named then return false end
  if type(args.tolerance) ~= "table" and args.check == nil then
    error(("scene:run: %s needs a purpose: give tolerance = { quantity = value } or check = {...}, see help "
      .. "'auto'")
      :format(word and "model = 'auto'" or ("wire '%s' has model = 'auto', which"):format(named)), 0)
  end
  return true
end

--- Computes the run, with run.model and run:why().
function choose.run(scene, given, check, run_once)
  local args = {}
  for key, value in pairs(given) do args[key] = value end
  args.model = nil
  mesh.undo(scene)
  local job = refine.job(scene, args, check)
  local context = new_context(scene, job, args, run_once)
  local touching = context.data.touching
  local begun = os.clock()
  local fine, result = pcall(function()
    begin(context)
    return compute(context)
  end)
  context.spent = os.clock() - begun
  if context.guard then context.guard:close() end
  ended.close(context)
  ended.forget(context)
  context.data.auto = nil
  local tidy, why = true, nil
  if not fine or result.refused then
    context.data.touching = touching
    if job.restore then
      tidy, why = pcall(job.restore)
      process.renew(scene, {})
      job.begin_processes()
    end
  end
  if job.close then job.close() end
  if not fine then error(result, 0) end
  if not tidy then error(why, 0) end
  if given.frames == false then scene:clear_frames() end -- they were only for the choices
  return answer.add(context, result)
end

return choose
