-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:run and the run it returns.
-- @module softworld.run.run
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local choose = require "softworld.model.choose"
local cliproom = require "softworld.link.cliproom"
local document = require "softworld.run.document"
local go = require "softworld.run.go"
local inherited = require "softworld.inherited"
local kept = require "softworld.run.kept"
local ledger = require "softworld.run.ledger"
local outs = require "softworld.link.outs"
local reactions = require "softworld.grip.reactions"
local methods = require "softworld.methods"
local counted = require "softworld.output.number".count
local passing = require "softworld.run.passing"
local place = require "softworld.place"
local refine = require "softworld.run.refine"
local remarks = require "softworld.remarks"
local tables = require "softworld.rows"
local runfiles = require "softworld.run.files"
local save = require "softworld.scene.save"
local sealed = require "softworld.sealed"
local settings = require "softworld.run.settings"
local series = require "softworld.run.series"
local summary = require "softworld.run.summary"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"
local working = require "softworld.run.working"

local Run = { __name = "run" }
local readable = runfiles.readable

-- Keeps in mind the events of a run that is ok until the script reads run.events, itself or by its summary, a
-- check or a page.
local function mark_events(run)
  local at = place.of_caller()
  local what = ("the run of '%s'%s"):format(run.name, at and " at " .. at or "")
  run.unseen_met = trust.watch(run, what)
  run.unseen_slips = reactions.tell(run.scene, run.start, what)
  local events = reactions.others(outs.others(run.scene, sealed.fields(run).events or {}))
  if #events == 0 then return run end
  local event = ("%s: %s"):format(events[1].kind, events[1].text)
  run.unseen = unread.note(("softworld: note: %s is ok, but has %s; see run.events: %s"):format(what,
    counted(#events, "event"), event), event)
  outs.keep(run.scene, events, run.unseen)
  return run
end

-- For `softworld --check`: makes the check that was given to the run, because its values are lost with the
-- next run. It comes before the marks, since it is no look of the script at the run.
local function count_given(run)
  if unread.counting() and sealed.fields(run).checked then run:check() end
end

-- Hides ok and reason of a failed run, so that reading them counts as a look at the failure.
local function hide_failure(run)
  count_given(run)
  if sealed.fields(run).cut == "stopped" then unread.cut() end
  if sealed.fields(run).ok ~= false then return mark_events(run) end
  local at = place.of_caller()
  local mark = unread.add(("softworld: run of '%s'%s FAILED %s; the script did not look at run.ok")
    :format(run.name, at and " at " .. at or "", run.reason))
  run.failure = { mark = mark, reason = run.reason }
  run.ok, run.reason = nil, nil
  return run
end

local function run_once(scene, args, level, hindrance)
  local run = sealed.new(Run, go.once(scene, args, level, hindrance))
  if sealed.fields(run).ok ~= false then passing.look(scene) end -- a diverged run has no places to read
  kept.ended(scene, run, summary.of)
  return run
end

-- For `softworld --check`: counts a run that ends with an error after it has begun, also if the script's own
-- pcall takes the error. Returns what must be closed.
local function count_errors()
  local before = go.begun()
  return setmetatable({}, { __close = function(_, raised)
    if raised ~= nil and go.begun() > before then unread.cut() end
  end })
end

local function check_start(scene, args)
  core.check_run(args)
  local data = build.data(scene)
  if data.running then
    error(("scene:run: a run of scene '%s' is under way; in a process, let time pass by waiting")
      :format(scene.name), 0)
  end
  if not args.duration and #data.processes == 0 and not data.going then
    error("scene:run: there is no process to run to its end; give duration [s]", 0)
  end
  if args.save ~= nil and #data.processes == 0 and not data.going then
    error("scene:run: save writes the scene after each step of a process, and there is no process; "
      .. "scene:save(file) writes it at once", 0)
  end
  if #data.wires + #data.particles + #data.processes == 0 and not data.going then -- a process may make some
    error(("scene '%s': there is no wire"):format(scene.name), 0)
  end
  if data.going then settings.check(data.going.settings, args, data.from_file) end
  cliproom.check(scene)
end

-- Checks which frames to store.
local function check_frames(args)
  if args.frames == nil or type(args.frames) == "boolean" then return end
  if type(args.frames) ~= "table" then
    error("scene:run: frames must be a table such as { memory = 256e6 }, true or false, got "
      .. checks.got(args.frames), 0)
  end
  go.frames:read(args.frames, "scene:run: frames")
end

-- Checks the files to write and to continue from.
local function check_files(scene, args)
  if refine.wanted(args) and build.data(scene).from_file then
    error(("scene:run: error bars need a computation from the start, and scene '%s' goes on from the file "
      .. "'%s'; give dt [s], or tolerance as a number [m]"):format(scene.name,
      build.data(scene).from_file), 0)
  end
  for _, key in ipairs{ "save", "resume" } do
    local file = args[key]
    if file ~= nil and (type(file) ~= "string" or file == "") then
      error(("scene:run: %s: the name of a file is wanted, got %s"):format(key,
        file == "" and "''" or type(file)), 0)
    end
    if file ~= nil and refine.wanted(args) then
      error(("scene:run: %s does not go with a table of quantities as tolerance, or with check, which run "
        .. "the scene several times; give dt [s], or tolerance as a number [m]"):format(key), 0)
    end
  end
end

--- Advances the scene: { duration = [s], dt = [s] or tolerance = [m], integrator =,
-- progress = true, frame = [s] }. Without duration the run lasts until the processes end.
-- With a table of quantities as tolerance the run has error bars, see help "tolerance".
-- Returns a run: ok, reason, time, steps, ... Errors of processes and callbacks
-- are raised unchanged and leave the scene at its last good step.
function core.class.scene.run(scene, args)
  build.check(scene, "scene:run", 3)
  unread.used(build.data(scene))
  local _ <close> = count_errors()
  if args == nil then args = {} end
  if type(args) == "table" then
    if checks.kind(args) ~= "table" then
      error("scene:run takes one table of parameters, got " .. checks.kind(args), 2)
    end
    args = build.call(3, inherited.copy, args, "run", "scene:run")
    build.call(3, check_files, scene, args)
    build.call(3, check_frames, args)
  end
  if build.call(3, choose.wanted, scene, args) then
    local _ <close> = working.several(args and args.progress)
    return hide_failure(build.call(3, choose.run, scene, args, check_start, run_once))
  end
  if refine.wanted(args) then
    local _ <close> = working.several(args and args.progress)
    local job = build.call(3, refine.job, scene, args, check_start)
    return hide_failure(build.call(3, refine.run, job, run_once))
  end
  build.call(3, core.check_run, args)
  if not args.quasistatic then remarks.on("run", "scene:run", args) end
  if args.resume ~= nil then build.call(3, save.resume, scene, args.resume, args) end
  build.call(3, check_start, scene, args)
  return hide_failure(run_once(scene, args))
end

--- Returns the time series of the run: { time = {...} [s], columns = {{ name, unit, values }} }.
function Run:series()
  readable(self, "series")
  return series.of(self, ledger.add)
end

--- Returns the stored frames: { { t, wires = {flat positions}, obstacles, holds, energy } }.
function Run:frames()
  readable(self, "frames", true)
  local list = {}
  for i = 1, self.scene:frame_count() do list[i] = self.scene:frame(i) end
  return list
end

Run.document = document.of
for name, method in pairs(runfiles.methods) do Run[name] = method end
tables.later(Run, "softworld.run.pictures", "picture film gltf obj stl")
tables.later(Run, "softworld.check.check", "check")
tables.later(Run, "softworld.model.answer", "why")
Run.error_bars = trust.error_bars
Run.ledger = ledger.of

-- Fields that may be nil.
local may_lack = checks.set [[quantities levels met advice where asked refused last_jump failure
  ok reason model unseen unseen_met unseen_slips]]
local fields = { "ok", "reason", "time", "steps", "rejected", "iterations", "evaluations", "jumps",
  "smallest_dt", "start", "wall", "cpu", "scene", "name", "events", "quantities", "met", "levels", "model" }

--- Returns the names of methods and fields, for completion at the prompt.
function Run.__names() return methods.names(Run, fields) end

for name, value in pairs(Run) do
  if type(value) == "function" and name:sub(1, 2) ~= "__" then Run[name] = build.placed(value) end
end

function Run.__index(self, key)
  local own = sealed.fields(self)
  if key == "events" and own.unseen then unread.seen(own.unseen) end
  if key == "events" and own.unseen_slips then -- summaries, pages, checks tell slips too
    local all = sealed.by_library()
    for _, mark in ipairs(own.unseen_slips) do
      if all or mark.lost then unread.seen(mark) end
    end
  end
  if (key == "met" or key == "advice") and own.unseen_met then unread.seen(own.unseen_met) end
  local value = own[key]
  if value == nil then value = Run[key] end
  if value ~= nil then return value end
  local failure = own.failure
  if failure and (key == "ok" or key == "reason") then
    unread.seen(failure.mark)
    if key == "ok" then return false end
    return failure.reason
  end
  if may_lack[key] then return trust.refuse(self, key) end
  error(checks.lacks("run", key, Run.__names(), "`softworld doc run` lists what it has"), 2)
end

function Run:__newindex(key, value)
  if not sealed.by_library() then
    error(("run has no '%s' to set; results of a run can only be read"):format(checks.shown(key)), 2)
  end
  rawset(sealed.fields(self), key, value)
end

-- Says how many events a run has.
local function told(run)
  local count = #(sealed.fields(run).events or {})
  return count > 0 and (", %s (run.events)"):format(counted(count, "event")) or ""
end

function Run:__tostring()
  if self.ok and self.quantities then
    local unmet = trust.unmet(self)
    return ("run of '%s': ok (%s)%s, t = %.6g s, %s, %.3g s of computing%s\n%s"):format(self.name,
      self.reason, unmet and ", " .. unmet or "", self.time, counted(#self.levels, "level"), self.cpu,
      told(self), tostring(self:error_bars()))
  end
  return ("run of '%s': %s (%s), t = %.6g s, %s, %.3g s of computing%s"):format(self.name,
    self.ok and "ok" or "FAILED", self.reason, self.time, counted(self.steps, "step"), self.cpu, told(self))
end

return Run
