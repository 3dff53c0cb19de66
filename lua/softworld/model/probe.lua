-- SPDX-License-Identifier: GPL-3.0-or-later
--- Computes one candidate while a model is chosen: from the start of the run, with one rung per choice, on a
-- coarse level of edges and steps.
-- @module softworld.model.probe
local blame = require "softworld.scene.blame"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local coarsest = require "softworld.run.coarsest"
local core = require "softworld.core"
local ended = require "softworld.model.ended"
local facts = require "softworld.model.facts"
local summaries = require "softworld.run.kept"
local number = require "softworld.output.number"
local refine = require "softworld.run.refine"
local registry = require "softworld.model.registry"
local trust = require "softworld.run.trust"

local probe = {}

local LONGEST = 60 -- longest expected time of such a computation [s]
local USUAL = 0.04 -- time between frames if the script gives none [s]
local MOST_GROWTH = 2 -- largest factor by which a level's time grows faster than by rule [-]
local MOMENTS = 25 -- least frames of a run of known duration [-]

-- Returns the options of the run that the rungs change.
local function changes_of(context, rungs)
  local changes = {}
  for _, choice in ipairs(registry.list) do
    if choice.apply then choice.apply(context, rungs[choice.name], changes, rungs) end
  end
  return changes
end

-- Makes wires stiffer or softer: cables whose stiffness is known only between bounds.
local function stiffen(factors)
  for wire, factor in pairs(factors or {}) do
    core.redraw(wire, wire:get().spin_inertia ~= nil, 1, factor, 1)
  end
end

-- Sets the frames of a run that choices look at: one per step, or enough that nothing passes unseen between
-- them. The final run keeps the script's frames if it gives any.
local function with_frames(context, options, each_step, last)
  local args = context.args
  local told = args.frames ~= false and args.frame or nil
  if type(options.frames) ~= "table" then options.frames = nil end
  if last and told then return options end
  options.frame = each_step and options.dt
    or math.min(told or USUAL, (args.duration or math.huge) / MOMENTS)
  if options.frame <= 0 then options.frame = nil end
  return options
end

--- Prepares the scene at its start for rungs. Returns the steps of the levels of its run. last: this is the
-- script's run, not a computation while choosing.
function probe.arrange(context, rungs, factors, last)
  local changes = changes_of(context, rungs)
  local each_step = changes.each_frame
  context.job.shape = changes.shape
  changes.each_frame, changes.shape = nil, nil
  stiffen(factors)
  local steps = context.job.steps(changes)
  return function(k) return with_frames(context, steps(k), each_step, last) end
end

local function look(context, run, asked)
  local found = {}
  for _, choice in ipairs(registry.list) do
    local told = choice.look and (not asked or asked[choice.name])
    found[choice.name] = told and choice.look(context, run) or {}
  end
  return found
end

-- Reads what a diverged run tells, each choice separately: not everything can be read.
local function look_at_failed(context, run)
  local found = {}
  for _, choice in ipairs(registry.list) do
    local fine, f = pcall(choice.look or function() end, context, run)
    if not fine and checks.is_interrupt(f) then error(f, 0) end
    found[choice.name] = fine and f or nil
  end
  return found
end

--- Returns what a run tells to the choices, by their names; asked: a set of names, or nil for all; from: in
-- frames from this time on [s], or nil for all.
function probe.facts(context, run, asked, from)
  return facts.reading(context.scene, from or run.start, look, context, run, asked)
end

-- Returns what a failed run tells, if anything.
local function facts_of_failed(context, run)
  return facts.reading(context.scene, run.start, look_at_failed, context, run)
end

--- Returns the key of a computation: of rungs on level k, and a label.
function probe.key(rungs, k, label)
  local words = { k, label or "" }
  for _, choice in ipairs(registry.list) do words[#words + 1] = rungs[choice.name] end
  return table.concat(words, " ")
end

-- Returns the expected time from the rungs' own rules alone, or nil.
local function rule(context, rungs, k)
  local sum
  for _, choice in ipairs(registry.list) do
    local time = choice.expected and choice.expected(context, rungs[choice.name], k)
    if time then sum = (sum or 0) + time end
  end
  return sum
end

-- Returns the time that a run of rungs took on level k, while choosing or in the job's levels [s]; nil: not
-- run.
local function taken(context, rungs, k, levels)
  local known = context.probes[probe.key(rungs, k)]
  local level = levels and levels[k] or known and known.level
  return level and level.ok and level.cpu > 0 and level.cpu or nil
end

--- Returns the expected time of a run of rungs on level k [s], or nil if no rung costs much. It scales the
-- time of the finest earlier level (levels: of the job). If that one grew faster than by rule, as iterations
-- may, the same growth is assumed again.
function probe.expected(context, rungs, k, levels)
  local time = rule(context, rungs, k)
  if not time or time == math.huge then return time end
  for j = k - 1, 1, -1 do
    local last = taken(context, rungs, j, levels)
    if last then
      local before = j > 1 and taken(context, rungs, j - 1, levels)
      local growth = before and last / before * rule(context, rungs, j - 1) / rule(context, rungs, j) or 1
      growth = math.max(1, math.min(MOST_GROWTH, growth))
      return last * time / rule(context, rungs, j) * growth ^ (k - j)
    end
  end
  return time
end

-- Returns the number of nodes of all wires; of a mesh all its particles, as each takes its time.
local function nodes_of(scene)
  local sum = 0
  for _, w in ipairs(build.data(scene).wires) do
    sum = sum + (core.exists(w.object) and #w.object:particles() // 3 or 0)
  end
  return sum
end

-- Returns the steps of levels widened by a choice, no more than `most`.
local function widened(steps, choice, most)
  return function(k)
    local options = steps(k)
    choice.widen(options)
    options.max_steps = most
    return options
  end
end

-- Reads what a run on level k tells, while the scene is in its final state. cpu: its time [s]; asked: a set
-- of choices, or nil for all.
local function read_all(context, k, run, cpu, result, asked)
  local job, scene = context.job, context.scene
  result.work = run.iterations * nodes_of(scene)
  result.facts, result.contact = probe.facts(context, run, asked), trust.touches(scene)
  result.moves, result.shape = job.moves, facts.shape(scene)
  result.values = {}
  for name, read in pairs(trust.read(job, run)) do result.values[name] = read.value end
  result.level = { segments = trust.counts(job, k), ok = true, cpu = cpu }
end

local function note_finest(context, k, result)
  local finest = context.finest
  if k >= (finest and finest.k or 0) then context.finest = { k = k, values = result.values } end
end

-- wide: nil; or { choice = that widens the steps, most = number of steps }.
local function compute(context, rungs, k, factors, wide)
  local job, scene = context.job, context.scene
  local time = probe.expected(context, rungs, k)
  if time and time > LONGEST and time < math.huge then
    return { ok = false, reason = ("it would take about %s"):format(number.duration(time)) }
  end
  ended.leave(context)
  summaries.take(scene) -- of a run that was only made to choose a model
  job.restore()
  local steps, own = probe.arrange(context, rungs, factors), factors or wide
  if wide then steps = widened(steps, wide.choice, wide.most) end
  core.remesh(scene, trust.counts(job, k))
  local begun = os.clock()
  local run = refine.computer(job, steps, context.run_once, { wall = 0, cpu = 0 })(k, "choosing a model")
  if job.unmade then return { ok = false, unmade = true, reason = job.unmade } end
  local cpu = os.clock() - begun
  local result = { ok = run.ok, reason = run.reason, iterations = run.iterations, steps = run.steps }
  if wide and run.steps >= wide.most then result.ok, result.reason = false, "it takes too many steps" end
  if not result.ok then
    result.facts = facts_of_failed(context, run)
    return result
  end
  local asked = wide and { [wide.choice.name] = true } or nil -- wide steps tell about their choice only
  read_all(context, k, run, cpu, result, asked)
  if not wide then context.iterations = run.iterations / 2 ^ (k - 1) end
  if not own then note_finest(context, k, result) end
  context.last = not own and { key = probe.key(rungs, k), k = k, run = run,
    level = result.level } or nil
  return result
end

--- Leaves out the coarsest level, on which no rung could be computed. False if there is no finer one that is
-- still coarse.
function probe.finer(context)
  if not coarsest.finer(context.job) then return false end
  context.most, context.probes, context.levels, context.finest = context.job.most, {}, {}, nil
  ended.forget(context)
  return true
end

--- Leaves out the n coarsest levels, on which these rungs cannot be computed. False if too few are left.
function probe.skip(context, rungs, n)
  local job, probes, finest, most = context.job, context.probes, context.finest, context.most
  local undo = coarsest.skip(job, n)
  if not undo then return false end
  local first = probes[probe.key(rungs, n + 1)]
  context.probes, context.levels, context.last = { [probe.key(rungs, 1)] = first }, {}, nil
  ended.forget(context)
  context.finest = { k = 1, values = first.values }
  context.most, context.skipped = job.most, n
  function context.unskip()
    undo()
    context.probes, context.levels, context.last = probes, {}, nil
    ended.forget(context)
    context.finest, context.most = finest, most
    context.unskip, context.skipped = nil, 0
  end
  return true
end

--- Same with the steps that a choice widens. It counts as failed if it takes `most` steps.
function probe.glance(context, rungs, k, choice, most)
  return probe.of(context, rungs, k, nil, "wide", { choice = choice, most = most })
end

-- True if the script tells which frames its run stores. They may tell less than those of other computations.
local function has_own_frames(context)
  local args = context.args
  return args.frames ~= false and (args.frame or args.frames ~= nil)
end

--- Keeps what level k of the script's run tells, because a later comparison may need the same computation.
-- The scene is in its final state. Not for meshes, nor if the run has changed its rungs on the way.
function probe.keep(context, rungs, k, run, cpu)
  if not run.ok or has_own_frames(context) or context.job.shape then return end
  for _, state in ipairs(context.states) do
    if state.went_on then return end
  end
  local result = { ok = true, reason = run.reason, iterations = run.iterations, steps = run.steps }
  read_all(context, k, run, cpu, result)
  context.levels[probe.key(rungs, k)] = result
end

--- Returns what was computed of rungs on level k, or nil.
function probe.known(context, rungs, k)
  local key = probe.key(rungs, k)
  local kept = context.levels[key]
  if kept and not context.probes[key] then
    context.probes[key] = kept
    note_finest(context, k, kept)
  end
  return context.probes[key]
end

--- Returns the run of rungs on level k and its level, if the scene is in its final state or can be put back
-- into it, and its frames are those that the kept run would have; else nil.
function probe.as_it_ended(context, rungs, k)
  local last, key = context.last, probe.key(rungs, k)
  if has_own_frames(context) then return nil end
  return last and last.key == key and last or ended.resume(context, key)
end

--- Returns the values and facts of rungs (by the choices' names) on level k; each is computed only once.
-- A computation that raises an error counts as failed, unless the function of a quantity raised it. A variant
-- has a label: factors on the stiffness of wires, or what widens the steps.
function probe.of(context, rungs, k, factors, label, wide)
  local key = probe.key(rungs, k, label)
  local known = label and context.probes[key] or not label and probe.known(context, rungs, k)
  if known then return known end
  local fine, result = pcall(compute, context, rungs, k, factors, wide)
  if not fine then
    -- A quantity that cannot be read is the script's fault in any model, as in a run without a choice.
    if checks.is_interrupt(result) or blame.is_fault(result) then error(result, 0) end
    result = { ok = false, reason = build.plain(tostring(result)), raised = result }
  end
  context.probes[key] = result
  context.probe_count = context.probe_count + 1
  return result
end

return probe
