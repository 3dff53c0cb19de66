-- SPDX-License-Identifier: GPL-3.0-or-later
--- One computation on the way to a model: from the start of the run, of one rung of each choice, on a coarse
-- level of edges and steps.
-- @module softworld.model.probe
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local refine = require "softworld.run.refine"
local registry = require "softworld.model.registry"
local trust = require "softworld.run.trust"

local probe = {}

local LONGEST = 60 -- that a computation on the way is expected to take [s]
local USUAL = 0.04 -- between frames, where the script says nothing [s]
local MOST_GROWTH = 2 -- of a level's time, over that by rule, from one to the next [-]
local MOMENTS = 25 -- frames of a run at least, of a duration that is known [-]

-- Options of the run in place of those given.
local function changes_of(context, rungs)
  local changes = {}
  for _, choice in ipairs(registry.list) do
    if choice.apply then choice.apply(context, rungs[choice.name], changes, rungs) end
  end
  return changes
end

-- Stiffer or softer wires, of cables whose stiffness is known between bounds.
local function stiffen(factors)
  for wire, factor in pairs(factors or {}) do
    core.redraw(wire, wire:get().spin_inertia ~= nil, 1, factor, 1)
  end
end

-- Options of runs whose frames choices look at: of each step, or so many that nothing passes between them.
-- As the script says in the run that it keeps.
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

--- Set the scene, as it begins, for rungs; returns the steps of the levels of its run. last: the run is the
-- script's, not one on the way.
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

-- Of a scene that diverged not all can be read: what its frames tell, of each choice by itself.
local function look_at_failed(context, run)
  local found = {}
  for _, choice in ipairs(registry.list) do
    local fine, f = pcall(choice.look or function() end, context, run)
    if not fine and checks.is_interrupt(f) then error(f, 0) end
    found[choice.name] = fine and f or nil
  end
  return found
end

--- What a run tells to the choices, by their names; asked: a set of names, or nil for all; from: in frames
-- from that time on [s], or nil for all.
function probe.facts(context, run, asked, from)
  return facts.reading(context.scene, from or run.start, look, context, run, asked)
end

-- What a run that failed tells, if anything.
local function facts_of_failed(context, run)
  return facts.reading(context.scene, run.start, look_at_failed, context, run)
end

--- The name of a computation: of rungs on level k, and a label.
function probe.key(rungs, k, label)
  local words = { k, label or "" }
  for _, choice in ipairs(registry.list) do words[#words + 1] = rungs[choice.name] end
  return table.concat(words, " ")
end

-- By what rungs are made of alone.
local function rule(context, rungs, k)
  local sum
  for _, choice in ipairs(registry.list) do
    local time = choice.expected and choice.expected(context, rungs[choice.name], k)
    if time then sum = (sum or 0) + time end
  end
  return sum
end

-- What a run of rungs on level k took, on the way or by the levels of the job [s]; nil: there was none.
local function taken(context, rungs, k, levels)
  local known = context.probes[probe.key(rungs, k)]
  local level = levels and levels[k] or known and known.level
  return level and level.ok and level.cpu > 0 and level.cpu or nil
end

--- Expected time of a run of rungs on level k, where one of them may cost much [s]; else nil. By what the
-- level before took, if it was computed (levels: of the job), and if that grew faster than by the rule, as
-- iterations may, so it may again.
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

local function nodes_of(scene)
  local sum = 0
  for _, w in ipairs(build.data(scene).wires) do
    sum = sum + (core.exists(w.object) and core.segments(w.object) + 1 or 0)
  end
  return sum
end

local function compute(context, rungs, k, factors)
  local job, scene = context.job, context.scene
  local time = probe.expected(context, rungs, k)
  if time and time > LONGEST and time < math.huge then
    return { ok = false, reason = ("it would take about %s"):format(number.duration(time)) }
  end
  context.last = nil
  job.restore()
  local steps = probe.arrange(context, rungs, factors)
  core.remesh(scene, trust.counts(job, k))
  local begun = os.clock()
  local run = refine.computer(job, steps, context.run_once, { wall = 0, cpu = 0 })(k, "choosing a model")
  if job.unmade then return { ok = false, unmade = true, reason = job.unmade } end
  local cpu = os.clock() - begun
  local result = { ok = run.ok, reason = run.reason, iterations = run.iterations }
  if not run.ok then
    result.facts = facts_of_failed(context, run)
    return result
  end
  result.work = run.iterations * nodes_of(scene)
  result.facts, result.contact = probe.facts(context, run), trust.touches(scene)
  result.moves = job.moves
  result.values = {}
  for name, read in pairs(trust.read(job, run)) do result.values[name] = read.value end
  context.iterations = run.iterations / 2 ^ (k - 1)
  result.level = { segments = trust.counts(job, k), ok = true, cpu = cpu }
  if not factors and k >= (context.finest and context.finest.k or 0) then
    context.finest = { k = k, values = result.values }
  end
  context.last = not factors and { key = probe.key(rungs, k), run = run, level = result.level } or nil
  return result
end

--- What was computed of rungs on level k; nil: nothing.
function probe.known(context, rungs, k) return context.probes[probe.key(rungs, k)] end

--- The run of rungs on level k and the level, where the scene is still as it ended, with the frames that the
-- run to be kept would have; else nil.
function probe.as_it_ended(context, rungs, k)
  local last, args = context.last, context.args
  local own_frames = args.frames ~= false and (args.frame or args.frames ~= nil)
  return last and not own_frames and last.key == probe.key(rungs, k) and last or nil
end

--- The values and facts of rungs (by the choices' names) on level k; of what was computed before the same.
-- A computation that raises counts as one that failed.
function probe.of(context, rungs, k, factors, label)
  local key = probe.key(rungs, k, label)
  local known = context.probes[key]
  if known then return known end
  local fine, result = pcall(compute, context, rungs, k, factors)
  if not fine then
    if checks.is_interrupt(result) then error(result, 0) end
    result = { ok = false, reason = build.plain(tostring(result)), raised = result }
  end
  context.probes[key] = result
  context.probe_count = context.probe_count + 1
  return result
end

return probe
