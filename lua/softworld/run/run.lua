-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:run and the run it returns.
-- @module softworld.run.run
local core = require "softworld.core"
local advice = require "softworld.run.advice"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local choose = require "softworld.model.choose"
local reactions = require "softworld.grip.reactions"
local leave = require "softworld.scene.leave"
local kept = require "softworld.run.kept"
local ledger = require "softworld.run.ledger"
local process = require "softworld.run.process"
local number = require "softworld.output.number"
local observe = require "softworld.run.observe"
local place = require "softworld.place"
local refine = require "softworld.run.refine"
local remarks = require "softworld.remarks"
local tables = require "softworld.rows"
local runfiles = require "softworld.run.files"
local save = require "softworld.scene.save"
local sealed = require "softworld.sealed"
local series = require "softworld.run.series"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"
local drawn = require "softworld.scene.drawn"
local fixing = require "softworld.link.fixing"
local waiting = require "softworld.run.waiting"
local window = require "softworld.run.window"
local progress = require "softworld.output.progress"

local Run = { __name = "run" }
local readable = runfiles.readable
local summary_of -- of a run, as long as its scene stays as it is
local chunk = 64 -- steps between two looks at progress; fixed, so that results never depend on it
local default_frame = 1 / 30 -- [s]
local frames_rows = tables.list{
  { "memory", "number", "B", "that all frames of the scene may take; when full every second one goes",
    min = 1e4, max = 1e12, default = 256e6 },
}
local progress_after = 1 -- of computing [s]

local function merge(total, part)
  for _, key in ipairs{ "steps", "rejected", "iterations", "evaluations", "jumps" } do
    total[key] = total[key] + part[key]
  end
  total.smallest_dt = math.min(total.smallest_dt, part.smallest_dt)
  total.ok, total.reason, total.time = part.ok, part.reason, part.time
  total.last_jump = part.last_jump or total.last_jump
end

local function new_bar(args, scene, level)
  local host = package.loaded["softworld.host"]
  local wanted = args.progress
  local usual = wanted == nil -- on a terminal, for runs that last
  if usual then wanted = host and host.terminal and os.getenv "TERM" ~= "dumb" end
  return progress.new{ total = args.duration and args.duration > 0 and args.duration or nil,
    name = level and ("%s, %s"):format(scene.name, level) or scene.name, quiet = not wanted,
    after = usual and progress_after or nil,
    terminal = host and host.terminal or nil,
    clock = core.clock, width = host and host.columns or nil }
end

local advance = core.class.scene.advance

-- Advance until the end of time or of the processes. Gives the reason of the end, and of one that leaves
-- things undone "stopped" or "unfinished".
local function drive(scene, args, total, bar)
  local start = total.start
  local stop = args.duration and start + args.duration or math.huge
  local options = {}
  for k, v in pairs(args) do options[k] = v end
  options.progress, options.duration, options.save, options.resume, options.guard = nil, nil, nil, nil, nil
  options.frame = args.frames ~= false and (options.frame or default_frame) or nil
  options.frames = nil
  local bounds = type(args.frames) == "table" and frames_rows:read(args.frames, "scene:run: frames")
  core.keep_frames(scene, bounds and bounds.memory or nil)
  local left = (args.max_steps or math.huge) - total.steps
  while true do
    if args.guard then args.guard:look(options, total) end
    local alive, wake, watching = process.step(scene)
    if args.guard then args.guard:stepped(total) end
    if stop == math.huge and alive == 0 then return "all processes have ended" end
    if process.reached(scene, stop) then
      waiting.at_end(scene)
      return ("%g s have passed"):format(args.duration), alive > 0 and "unfinished" or nil
    end
    local target = math.min(stop, wake)
    if target == math.huge then
      waiting.look(scene, bar, args.progress == false)
      -- a process that waits for a condition without an end: go on step by step
      target = scene.time + (args.dt or 0.01)
    end
    options.max_steps = math.min(left, watching and 1 or chunk)
    local part = build.call(6, advance, scene, options, target, observe.arguments(scene))
    merge(total, part)
    left = left - part.steps
    bar:update(scene.time - start, total.steps)
    if not part.ok then return part.reason end
    local asked = observe.settle(scene)
    local stopped = reactions.look(scene) or asked
    if stopped then return stopped, "stopped" end
    if left <= 0 then
      waiting.at_end(scene)
      return "the allowed number of steps was used", "stopped"
    end
  end
end

-- Wires as they are when the run begins, for pictures of one that fails.
local function wires_of(scene) return leave.all(scene, "wire") end

-- A run that failed keeps ok and reason where reading them is seen.
local function hide_failure(run)
  if sealed.fields(run).cut == "stopped" then unread.cut() end
  if sealed.fields(run).ok ~= false then return run end
  local at = place.of_caller()
  local mark = unread.add(("softworld: run of '%s'%s FAILED %s; the script did not look at run.ok")
    :format(run.name, at and " at " .. at or "", run.reason))
  run.failure = { mark = mark, reason = run.reason }
  run.ok, run.reason = nil, nil
  return run
end

-- One run; level names it where it is one of several, and hindrance tells why it cannot even begin.
local function run_once(scene, args, level, hindrance)
  local data = build.data(scene)
  local total = data.going or { steps = 0, rejected = 0, iterations = 0, evaluations = 0, jumps = 0,
    smallest_dt = math.huge, ok = true, reason = "", time = scene.time, start = scene.time,
    wall = 0, cpu = 0 }
  process.check_steps(scene)
  kept.begin(scene)
  data.origin = data.origin or save.origin(scene)
  if not data.going then build.call(3, core.begin_run, scene, args.wear) end -- else the file's run goes on
  data.going = nil
  observe.begin(scene, args)
  total.drawn = wires_of(scene)
  local wall, cpu = core.clock() - total.wall, os.clock() - total.cpu
  local fine, reason, cut
  do -- protected: a coroutine that dies by an error leaves its variables unclosed
    local bar <close> = new_bar(args, scene, level)
    data.running = true
    data.saving = args.save and function()
      total.wall, total.cpu = core.clock() - wall, os.clock() - cpu
      save.write(scene, args.save, total)
    end
    if hindrance then
      fine, reason, total.ok = true, ("at t = %.6g s: %s"):format(scene.time, hindrance), false
    else
      fine, reason, cut = pcall(drive, scene, args, total, bar)
    end
    data.running, data.saving = nil, nil
    if fine and total.ok then bar:finish() elseif fine then bar:fail(reason) end
    observe.finish(scene, fine and total.ok, reason)
  end
  if not fine then error(reason, 0) end
  total.wall, total.cpu = core.clock() - wall, os.clock() - cpu
  total.reason, total.scene, total.name = reason, scene, scene.name
  ledger.close(total)
  if not total.ok and not level and not total.reason:find("take smaller steps", 1, true) then
    total.reason = ("%s; try %s"):format(total.reason, advice.of(total.reason, args))
  end
  total.restores, total.cut = data.restores, cut
  data.runs = (data.runs or 0) + 1
  total.number = data.runs
  local run = sealed.new(Run, total)
  kept.ended(scene, run, summary_of)
  return run
end


local function check_start(scene, args)
  core.check_run(args)
  local data = build.data(scene)
  if data.running then
    error(("scene:run: a run of scene '%s' is under way; a process lets time pass by waiting")
      :format(scene.name), 0)
  end
  if not args.duration and #data.processes == 0 and not data.going then
    error("scene:run: there is no process that could end; give duration [s]", 0)
  end
  if args.save ~= nil and #data.processes == 0 and not data.going then
    error("scene:run: save: the scene is written after the steps of processes, and there is none; "
      .. "scene:save(file) writes it at once", 0)
  end
  if #data.wires + #data.particles + #data.processes == 0 and not data.going then -- a process may make some
    error(("scene '%s': there is no wire"):format(scene.name), 0)
  end
end

-- What frames it is to store.
local function check_frames(args)
  if args.frames == nil or type(args.frames) == "boolean" then return end
  if type(args.frames) ~= "table" then
    error("scene:run: frames must be a table such as { memory = 256e6 }, true or false, got "
      .. checks.got(args.frames), 0)
  end
  frames_rows:read(args.frames, "scene:run: frames")
end

-- The files that it is to be written to and to go on from.
local function check_files(scene, args)
  if refine.wanted(args) and build.data(scene).from_file then
    error(("scene:run: error bars need the whole computation, and scene '%s' goes on from the "
      .. "file '%s'; give dt [s], or tolerance as a number [m]"):format(scene.name,
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

--- Advance the scene: { duration = [s], dt = [s] or tolerance = [m], integrator =,
-- progress = true, frame = [s] }. Without duration until the processes end. With a
-- table of quantities as tolerance the run has error bars, see help "tolerance".
-- Returns a run: ok, reason, time, steps, ... Errors of processes and callbacks
-- are raised unchanged and leave the scene at its last good step.
function core.class.scene.run(scene, args)
  build.check(scene, "scene:run", 3)
  if args == nil then args = {} end
  if type(args) == "table" then
    if checks.kind(args) ~= "table" then
      error("scene:run takes one table of parameters, got " .. checks.kind(args), 2)
    end
    local own = {} -- what the table itself has, and nothing that metamethods make up
    for key, value in next, args do own[key] = value end
    args = own
    build.call(3, check_files, scene, args)
    build.call(3, check_frames, args)
  end
  if build.call(3, choose.wanted, scene, args) then
    return hide_failure(build.call(3, choose.run, scene, args, check_start, run_once))
  end
  if refine.wanted(args) then
    local job = build.call(3, refine.job, scene, args, check_start)
    return hide_failure(build.call(3, refine.run, job, run_once))
  end
  build.call(3, core.check_run, args)
  if not args.quasistatic then remarks.on("run", "scene:run", args) end
  if args.resume ~= nil then build.call(3, save.resume, scene, args.resume) end
  build.call(3, check_start, scene, args)
  return hide_failure(run_once(scene, args))
end

--- Time series of the run: { time = {...} [s], columns = {{ name, unit, values }} }.
function Run:series()
  readable(self, "series")
  return series.of(self, ledger.add)
end

--- Frames stored while running: { { t, wires = {flat positions}, obstacles, holds, energy } }.
function Run:frames()
  readable(self, "frames", true)
  local list = {}
  for i = 1, self.scene:frame_count() do list[i] = self.scene:frame(i) end
  return list
end

-- Events of grippers that a summary tells, at their time.
local told = {
  slip = function() return "the wire SLIPS since" end,
  lost = function() return "the wire is LOST since" end,
  crash = function(e) return ("%s RUNS INTO %s at"):format(e.part, e.obstacle) end,
}

-- Rows of the summary; add(label, value, unit, s, t, note) puts one.
local function sum_up_grippers(self, data, add)
  for _, g in ipairs(data.grippers) do
    local m = g:over(self.start, self.time)
    add(g.name .. ": peak force", m.peak_force, "N", nil, m.peak_force_time, m.peak_force_note)
    add(g.name .. ": mean force", m.mean_force, "N")
    add(g.name .. ": peak moment", m.peak_moment, "N m", nil, m.peak_moment_time, m.peak_moment_note)
    add(g.name .. ": mean moment", m.mean_moment, "N m")
    if m.peak_squeeze then add(g.name .. ": largest squeeze per finger", m.peak_squeeze, "N") end
    for _, e in ipairs(g.events) do
      if told[e.kind] and e.time >= self.start and e.time <= self.time then
        add(("%s: %s"):format(g.name, told[e.kind](e)), e.time, "s", e.s, e.time)
      end
    end
  end
end

local function sum_up_wires(self, data, add)
  for _, w in ipairs(data.wires) do
    local radius, s, t = w.object:min_bend_radius()
    local label = w.name .. ": smallest bend radius"
    if w.object:cable() then
      local allowed = w.object:bend_limit()
      label = ("%s (limit %s, %s%s)"):format(label, number.text(allowed.limit, "m"), allowed.use,
        allowed.ok and "" or ", EXCEEDED")
    end
    add(label, radius, "m", s, t)
    local tension, note
    tension, s, t, note = window.tension(self.scene, w.object)
    add(w.name .. ": largest tension", tension, "N", s, t, note)
    s, t = w.object:folded()
    if s then
      add(w.name .. ": section FOLDED through itself, its forces are wrong since", t, "s", s, t)
    end
  end
end

local function bar_of(q)
  local is_number = type(q.value) == "number"
  return { label = q:label(), value = is_number and q.value or q:text(), unit = is_number and q.unit or "",
    where = ("+- %s%s"):format(number.text(q.error, q.unit), q.met and "" or " (NOT as asked)")
      .. (q.note and (" (%s)"):format(q.note) or "") }
end

function summary_of(self)
  local data, rows = build.data(self.scene), {}
  local function add(label, value, unit, s, t, note)
    local where = s and ("s = %.4g m"):format(s) or nil
    if note then where = ("%s(%s)"):format(where and where .. " " or "", note) end
    rows[#rows + 1] = { label = label, value = value, unit = unit, where = where, when = t }
  end
  sum_up_grippers(self, data, add)
  sum_up_wires(self, data, add)
  if #data.obstacles > 0 then
    local depth, s, t = self.scene:penetration()
    add("deepest penetration", depth, "m", s, t)
  end
  for _, f in ipairs(fixing.all(self.scene)) do f:report(add) end
  ledger.report(self, add)
  local thinned = core.frames_thinned(self.scene)
  if thinned > 1 then
    add("frames: one of so many is kept, for want of memory", thinned, "-", nil, nil,
      "see frames = { memory = }")
  end
  for _, q in ipairs(self.quantities and self:error_bars() or {}) do rows[#rows + 1] = bar_of(q) end
  return rows
end

-- Entries of obstacles without the objects.
local function obstacles_of(data)
  local list = {}
  for i, o in ipairs(data.obstacles) do
    list[i] = {}
    for k, v in pairs(o) do list[i][k] = v end
    list[i].object = nil
  end
  return list
end

-- Clips are shown as obstacles that stand still.
local function add_fixings(scene, doc)
  for _, f in ipairs(fixing.all(scene)) do
    for _, solid in ipairs(f:solids()) do
      doc.obstacles[#doc.obstacles + 1] = solid
      for _, frame in ipairs(doc.frames) do
        frame.obstacles[#doc.obstacles] = { position = { 0, 0, 0 }, rotation = { 1, 0, 0, 0 } }
      end
    end
  end
end

-- What pictures show, of frames of these numbers; nil: of all.
local function draw(self, doc, wires, numbers)
  doc.wires = wires
  doc.obstacles, doc.zones = obstacles_of(build.data(self.scene)), build.data(self.scene).zones
  for i = 1, numbers and #numbers or self.scene:frame_count() do
    doc.frames[i] = self.scene:frame(numbers and numbers[i] or i)
    doc.frames[i].number = numbers and numbers[i] or i
  end
  drawn.add(self.scene, doc)
  add_fixings(self.scene, doc)
end

-- What a run has beside its frames.
local function outline(self)
  local doc = { name = self.name, ok = self.ok, reason = self.reason, time = self.time,
    events = self.events,
    steps = self.steps, wall = self.wall, cpu = self.cpu, gravity = self.scene:gravity(),
    wires = {}, obstacles = {}, grips = {}, clamps = {}, frames = {} }
  if not self.ok then return doc end
  doc.series, doc.summary = self:series(), kept.rows(self) or summary_of(self)
  local unmet = trust.unmet(self)
  doc.model = self.model and tostring(self.model)
  doc.met, doc.unmet = self.met, unmet and ("%s (%s)"):format(unmet, self.advice)
  for i, q in ipairs(self.quantities and self:error_bars() or {}) do
    doc.quantities = doc.quantities or {}
    doc.quantities[i] = { name = q:label(), value = q.value, error = q.error, unit = q.unit,
      asked = q.tolerance, met = q.met, where = q.where, when = q.when }
  end
  return doc
end

--- Plain tables of everything that charts, pictures and files need.
function Run:document()
  if self.ok then readable(self, "results") end
  local doc = outline(self)
  if self.ok then draw(self, doc, wires_of(self.scene)) end
  return doc
end

-- What a player draws of a scene.
local function describe(scene, doc, wires)
  local data = build.data(scene)
  doc.scene, doc.wires, doc.obstacles = scene, wires or wires_of(scene), obstacles_of(data)
  doc.zones = data.zones
  drawn.describe(scene, doc)
  for _, f in ipairs(fixing.all(scene)) do
    for _, one in ipairs(f:solids()) do
      one.name, one.part = one.name or f.name, f.name
      doc.obstacles[#doc.obstacles + 1] = one
    end
  end
  return doc
end

-- For a player: without frames, which it takes from the core.
function runfiles.described(self)
  readable(self, "frames", true)
  local doc = outline(self)
  doc.start, doc.from, doc.to = self.start, self.start - 1e-9, self.time + 1e-9
  return describe(self.scene, doc, not self.ok and self.drawn or nil)
end

-- The same of a scene as it is now, with or without a run under way.
function runfiles.scene_described(scene)
  return describe(scene, { name = scene.name, ok = true, start = scene.time, time = scene.time,
    gravity = scene:gravity(), events = {} })
end

-- What pictures of some frames need, without series and numbers.
function runfiles.moments(self, numbers)
  readable(self, "frames", true)
  local doc = { name = self.name, ok = self.ok, reason = self.reason, time = self.time,
    gravity = self.scene:gravity(), frames = {}, seen = {} }
  draw(self, doc, self.ok and wires_of(self.scene) or self.drawn, numbers)
  drawn.add_particles(self.scene, doc)
  return doc
end

-- The same of a scene as it is now.
function runfiles.present(scene)
  local doc = { name = scene.name, ok = true, time = scene.time, gravity = scene:gravity(),
    wires = wires_of(scene), obstacles = obstacles_of(build.data(scene)), zones = build.data(scene).zones,
    frames = { core.frame_now(scene) }, seen = {} }
  drawn.add(scene, doc)
  drawn.add_particles(scene, doc)
  add_fixings(scene, doc)
  return doc
end

-- The document, with the frames of a run that failed.
function runfiles.pictured(self)
  local doc = self:document()
  if not self.ok then
    readable(self, "frames", true)
    draw(self, doc, self.drawn)
  end
  return doc
end

for name, method in pairs(runfiles.methods) do Run[name] = method end
tables.later(Run, "softworld.run.pictures", "picture film gltf obj stl")
tables.later(Run, "softworld.check.check", "check")
tables.later(Run, "softworld.model.answer", "why")
Run.error_bars = trust.error_bars
Run.ledger = ledger.of

-- Fields that a run may lack.
local may_lack = checks.set [[quantities levels met advice where asked refused last_jump failure
  ok reason model]]
local fields = { "ok", "reason", "time", "steps", "rejected", "iterations", "evaluations", "jumps",
  "smallest_dt", "start", "wall", "cpu", "scene", "name", "events", "quantities", "met", "levels", "model" }

--- Names of methods and fields, for completion at the prompt.
function Run.__names()
  local names = table.move(fields, 1, #fields, 1, {})
  for name in pairs(Run) do
    if name:sub(1, 2) ~= "__" then names[#names + 1] = name end
  end
  return names
end

for name, value in pairs(Run) do
  if type(value) == "function" and name:sub(1, 2) ~= "__" then Run[name] = build.placed(value) end
end

function Run.__index(self, key)
  local own = sealed.fields(self)
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
  local near = core.nearest(checks.shown(key), Run.__names())
  error(("run has no '%s'; %s"):format(checks.shown(key), near and "did you mean '" .. near .. "'?"
    or "help(run) at the prompt lists what it has"), 2)
end

function Run:__newindex(key, value)
  if not sealed.by_library() then
    error(("run has no '%s' to set; what a run found can only be read"):format(checks.shown(key)), 2)
  end
  rawset(sealed.fields(self), key, value)
end

function Run:__tostring()
  if self.ok and self.quantities then
    local unmet = trust.unmet(self)
    return ("run of '%s': ok (%s)%s, t = %.6g s, %d levels, %.3g s of computing\n%s"):format(self.name,
      self.reason, unmet and ", " .. unmet or "", self.time, #self.levels, self.cpu,
      tostring(self:error_bars()))
  end
  return ("run of '%s': %s (%s), t = %.6g s, %d steps, %.3g s of computing"):format(
    self.name, self.ok and "ok" or "FAILED", self.reason, self.time, self.steps, self.cpu)
end

return Run
