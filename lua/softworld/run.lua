-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:run and the run it returns.
-- @module softworld.run
local core = require "softworld.core"
local build = require "softworld.build"
local grasp = require "softworld.grasp"
local ledger = require "softworld.ledger"
local process = require "softworld.process"
local number = require "softworld.output.number"
local refine = require "softworld.refine"
local save = require "softworld.save"
local trust = require "softworld.trust"
local fixing = require "softworld.fixing"
local progress = require "softworld.output.progress"

local Run = { __name = "run" }
local chunk = 64 -- steps between two looks at progress; fixed, so that results never depend on it
local default_frame = 1 / 30 -- [s]

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
  if wanted == nil then wanted = false end
  return progress.new{ total = args.duration and args.duration > 0 and args.duration or nil,
    name = level and ("%s, %s"):format(scene.name, level) or scene.name, quiet = not wanted,
    terminal = host and host.terminal or nil,
    clock = core.clock, width = host and host.columns or nil }
end

local advance = core.class.scene.advance

-- Advance until the end of time or of the processes.
local function drive(scene, args, total, bar)
  local start = total.start
  local stop = args.duration and start + args.duration or math.huge
  local options = {}
  for k, v in pairs(args) do options[k] = v end
  options.progress, options.duration, options.save, options.resume = nil, nil, nil, nil
  options.frame = options.frame or default_frame
  local left = (args.max_steps or math.huge) - total.steps
  while true do
    local alive, wake, watching = process.step(scene)
    if stop == math.huge and alive == 0 then return "all processes have ended" end
    if process.reached(scene, stop) then return ("%g s have passed"):format(args.duration) end
    local target = math.min(stop, wake)
    if target == math.huge then
      -- a process that waits for a condition without an end: go on step by step
      target = scene.time + (args.dt or 0.01)
    end
    options.max_steps = math.min(left, watching and 1 or chunk)
    local part = build.call(5, advance, scene, options, target)
    merge(total, part)
    left = left - part.steps
    bar:update(scene.time - start, total.steps)
    if not part.ok then return part.reason end
    local stopped = grasp.look(scene)
    if stopped then return stopped end
    if left <= 0 then return "the allowed number of steps was used" end
  end
end

-- One run; level names it where it is one of several.
local function run_once(scene, args, level)
  local data = build.data(scene)
  local total = data.going or { steps = 0, rejected = 0, iterations = 0, evaluations = 0, jumps = 0,
    smallest_dt = math.huge, ok = true, reason = "", time = scene.time, start = scene.time,
    wall = 0, cpu = 0 }
  process.check_steps(scene)
  data.origin = data.origin or save.origin(scene)
  if not data.going then build.call(3, core.begin_run, scene) end -- else the run of the file goes on
  data.going = nil
  local wall, cpu = core.clock() - total.wall, os.clock() - total.cpu
  local fine, reason
  do -- protected: a coroutine that dies by an error leaves its variables unclosed
    local bar <close> = new_bar(args, scene, level)
    data.running = true
    data.saving = args.save and function()
      total.wall, total.cpu = core.clock() - wall, os.clock() - cpu
      save.write(scene, args.save, total)
    end
    fine, reason = pcall(drive, scene, args, total, bar)
    data.running, data.saving = nil, nil
    if fine and total.ok then bar:finish() elseif fine then bar:fail(reason) end
  end
  if not fine then error(reason, 0) end
  total.wall, total.cpu = core.clock() - wall, os.clock() - cpu
  total.reason, total.scene, total.name = reason, scene, scene.name
  ledger.close(total)
  total.restores = data.restores
  return setmetatable(total, Run)
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
end

-- The files that it is to be written to and to go on from.
local function check_files(scene, args)
  if trust.wanted(args) and build.data(scene).from_file then
    error(("scene:run: tolerance: error bars need the whole computation, and scene '%s' goes on from the "
      .. "file '%s'; give dt [s], or tolerance as a number [m]"):format(scene.name,
      build.data(scene).from_file), 0)
  end
  for _, key in ipairs{ "save", "resume" } do
    local file = args[key]
    if file ~= nil and (type(file) ~= "string" or file == "") then
      error(("scene:run: %s: the name of a file is wanted, got %s"):format(key,
        file == "" and "''" or type(file)), 0)
    end
    if file ~= nil and trust.wanted(args) then
      error(("scene:run: %s does not go with a table of quantities as tolerance, which runs the scene "
        .. "several times; give dt [s], or tolerance as a number [m]"):format(key), 0)
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
  if type(args) == "table" then build.call(3, check_files, scene, args) end
  if trust.wanted(args) then
    local job, steps = build.call(3, refine.job, scene, args, check_start)
    return build.call(3, refine.run, job, steps, run_once)
  end
  build.call(3, core.check_run, args)
  if args.resume ~= nil then build.call(3, save.resume, scene, args.resume) end
  build.call(3, check_start, scene, args)
  return run_once(scene, args)
end

local function readable(self, what)
  if not self.ok then
    error(("run of '%s' failed %s; it has no %s"):format(self.name, self.reason, what), 3)
  end
  if build.data(self.scene).restores ~= self.restores then
    error(("run of '%s': its %s went when a snapshot was restored; read them before that")
      :format(self.name, what), 3)
  end
end

local function column(name, unit) return { name = name, unit = unit, values = {} } end

-- Force and moment columns of one hold, or gripper with pads, on the common time axis of all.
local function add_hold(series, index, name, rows, count, width)
  local axes = { "x", "y", "z" }
  local names = {}
  for k, axis in ipairs(axes) do names[k] = column(name .. ".force_" .. axis, "N") end
  for k, axis in ipairs(axes) do names[3 + k] = column(name .. ".moment_" .. axis, "N m") end
  local force, moment = column(name .. ".force", "N"), column(name .. ".moment", "N m")
  for i = 0, count - 1 do
    local b, at = width * i, index[rows[width * i + 1]]
    for k = 1, 6 do names[k].values[at] = rows[b + 1 + k] end
    force.values[at] = (rows[b + 2] ^ 2 + rows[b + 3] ^ 2 + rows[b + 4] ^ 2) ^ 0.5
    moment.values[at] = (rows[b + 5] ^ 2 + rows[b + 6] ^ 2 + rows[b + 7] ^ 2) ^ 0.5
  end
  for _, c in ipairs{ force, moment } do series.columns[#series.columns + 1] = c end
  for _, c in ipairs(names) do series.columns[#series.columns + 1] = c end
end

local function add_jaws(series, index, log)
  for k, what in ipairs{ { "opening", "m" }, { "squeeze", "N" }, { "margin", "-" }, { "slip", "m" } } do
    local c = column(("%s.%s"):format(log.name, what[1]), what[2])
    for i = 0, log.count - 1 do
      c.values[index[log.rows[log.width * i + 1]]] = log.rows[log.width * i + 10 + k]
    end
    series.columns[#series.columns + 1] = c
  end
end

local function collect_times(self, logs)
  local seen, times = {}, {}
  for _, log in ipairs(logs) do
    for i = 0, log.count - 1 do
      local t = log.rows[log.width * i + 1]
      if t >= self.start and not seen[t] then
        seen[t] = true
        times[#times + 1] = t
      end
    end
  end
  table.sort(times)
  local index = {}
  for i, t in ipairs(times) do index[t] = i end
  return times, index
end

-- Rows of a log from the run's start on.
local function cut(log, start)
  local rows, first = {}, 0
  while first < log.count and log.rows[log.width * first + 1] < start do first = first + 1 end
  table.move(log.rows, log.width * first + 1, log.width * log.count, 1, rows)
  return { name = log.name, width = log.width, rows = rows, count = log.count - first,
    obstacle = log.obstacle, tool = log.tool }
end

local function all_logs(self)
  local data, logs = build.data(self.scene), {}
  for _, h in ipairs(data.holds) do
    local rows, count = h.object:log()
    if count > 0 then logs[#logs + 1] = { name = h.name, rows = rows, count = count, width = 10 } end
  end
  for _, o in ipairs(data.obstacles) do
    local rows, count = o.object:log()
    logs[#logs + 1] = { name = o.name, rows = rows, count = count, width = 4, obstacle = true }
  end
  for _, g in ipairs(data.grippers) do
    if g.tool then
      local rows, count = g.tool:log()
      if count > 0 then
        logs[#logs + 1] = { name = g.name, rows = rows, count = count, width = 14, tool = true }
      end
    end
  end
  for i, log in ipairs(logs) do logs[i] = cut(log, self.start) end
  return logs
end

local function fill_gaps(series)
  for _, c in ipairs(series.columns) do
    for i = 1, #series.time do
      if c.values[i] == nil then c.values[i] = 0 / 0 end
    end
  end
end

local function add_obstacle(series, index, log)
  local c = column(log.name .. ".contact_force", "N")
  for i = 0, log.count - 1 do
    local b = 4 * i
    c.values[index[log.rows[b + 1]]] =
      (log.rows[b + 2] ^ 2 + log.rows[b + 3] ^ 2 + log.rows[b + 4] ^ 2) ^ 0.5
  end
  series.columns[#series.columns + 1] = c
end

--- Time series of the run: { time = {...} [s], columns = {{ name, unit, values }} }.
function Run:series()
  readable(self, "series")
  local logs = all_logs(self)
  local times, index = collect_times(self, logs)
  local series = { time = times, columns = {} }
  for _, log in ipairs(logs) do
    if log.obstacle then add_obstacle(series, index, log)
    else
      add_hold(series, index, log.name, log.rows, log.count, log.width)
      if log.tool then add_jaws(series, index, log) end
    end
  end
  ledger.add(self, series, index)
  fill_gaps(series)
  return series
end

--- Frames stored while running: { { t, wires = {flat positions}, obstacles, holds, energy } }.
function Run:frames()
  readable(self, "frames")
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

local function summary_of(self)
  local data, rows = build.data(self.scene), {}
  local function add(label, value, unit, s, t)
    rows[#rows + 1] = { label = label, value = value, unit = unit,
      where = s and ("s = %.4g m"):format(s) or nil, when = t }
  end
  for _, g in ipairs(data.grippers) do
    local m = g:over(self.start, self.time)
    add(g.name .. ": peak force", m.peak_force, "N", nil, m.peak_force_time)
    add(g.name .. ": mean force", m.mean_force, "N")
    add(g.name .. ": peak moment", m.peak_moment, "N m", nil, m.peak_moment_time)
    add(g.name .. ": mean moment", m.mean_moment, "N m")
    if m.peak_squeeze then add(g.name .. ": largest squeeze per finger", m.peak_squeeze, "N") end
    for _, e in ipairs(g.events) do
      if told[e.kind] and e.time >= self.start and e.time <= self.time then
        add(("%s: %s"):format(g.name, told[e.kind](e)), e.time, "s", e.s, e.time)
      end
    end
  end
  for _, w in ipairs(data.wires) do
    local radius, s, t = w.object:min_bend_radius()
    local label = w.name .. ": smallest bend radius"
    if w.object:cable() then
      local allowed = w.object:bend_limit()
      label = ("%s (limit %s, %s%s)"):format(label, number.text(allowed.limit, "m"), allowed.use,
        allowed.ok and "" or ", EXCEEDED")
    end
    add(label, radius, "m", s, t)
    local tension
    tension, s, t = w.object:max_tension()
    add(w.name .. ": largest tension", tension, "N", s, t)
    s, t = w.object:folded()
    if s then
      add(w.name .. ": section FOLDED through itself, its forces are wrong since", t, "s", s, t)
    end
  end
  if #data.obstacles > 0 then
    local depth, s, t = self.scene:penetration()
    add("deepest penetration", depth, "m", s, t)
  end
  for _, f in ipairs(fixing.all(self.scene)) do f:report(add) end
  ledger.report(self, add)
  for _, q in ipairs(self.quantities and self:error_bars() or {}) do
    rows[#rows + 1] = { label = q.name, value = type(q.value) == "number" and q.value or q:text(),
      unit = type(q.value) == "number" and q.unit or "",
      where = ("+- %s%s"):format(number.text(q.error, q.unit), q.met and "" or " (NOT as asked)") }
  end
  return rows
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

--- Plain tables of everything that charts, pictures and files need.
function Run:document()
  if self.ok then readable(self, "results") end
  local data = build.data(self.scene)
  local doc = { name = self.name, ok = self.ok, reason = self.reason, time = self.time,
    events = self.events,
    steps = self.steps, wall = self.wall, cpu = self.cpu, gravity = self.scene:gravity(),
    wires = {}, obstacles = {}, grips = {}, frames = {} }
  if not self.ok then return doc end
  for i, w in ipairs(data.wires) do
    doc.wires[i] = { name = w.name, radius = w.object.radius, length = w.object.length,
      segments = w.object.segments }
  end
  for i, o in ipairs(data.obstacles) do
    local entry = {}
    for k, v in pairs(o) do entry[k] = v end
    entry.object = nil
    doc.obstacles[i] = entry
  end
  local shown = {}
  for i, h in ipairs(data.holds) do
    if h.kind == "grip" then
      shown[#shown + 1] = i
      doc.grips[#shown] = { name = h.name, width = h.width or 0.02 }
    end
  end
  for i = 1, self.scene:frame_count() do
    local f = self.scene:frame(i)
    f.grips = {}
    for k, h in ipairs(shown) do
      f.grips[k] = f.holds[h] or
        { position = { 0, 0, 0 }, rotation = { 1, 0, 0, 0 }, held = false }
    end
    doc.frames[i] = f
  end
  add_fixings(self.scene, doc)
  doc.series, doc.summary = self:series(), summary_of(self)
  for i, q in ipairs(self.quantities and self:error_bars() or {}) do
    doc.quantities = doc.quantities or {}
    doc.quantities[i] = { name = q.name, value = q.value, error = q.error, unit = q.unit,
      asked = q.tolerance, met = q.met, where = q.where, when = q.when }
  end
  return doc
end

--- Table of results on the terminal.
function Run:summary(stream)
  require("softworld.output.summary").print(self:document(), stream or io.stdout)
end

--- Series as CSV or JSON, by the file's extension.
function Run:save(path)
  readable(self, "series")
  require("softworld.output.series").write(self:document(), path)
  return path
end

--- ParaView series (.pvd).
function Run:vtk(path)
  readable(self, "frames")
  require("softworld.output.vtk").write(self:document(), path)
  return path
end

--- Chart of series: { path = "x.svg", columns = { names }, title = }.
function Run:chart(options)
  readable(self, "series")
  local o = {}
  for k, v in pairs(options or {}) do o[k] = v end
  o.run = self:document()
  return require("softworld.output.chart").series(o)
end

--- A strip of ray-traced pictures: { path = "x.png", count = 6, ... }.
function Run:pictures(options)
  readable(self, "frames")
  local o = {}
  for k, v in pairs(options or {}) do o[k] = v end
  o.run = self:document()
  return require("softworld.output.povray").strip(o)
end

Run.error_bars = trust.error_bars
Run.ledger = ledger.of

for name, value in pairs(Run) do
  if type(value) == "function" and name:sub(1, 2) ~= "__" then Run[name] = build.placed(value) end
end

function Run.__index(self, key)
  local value = Run[key]
  if value ~= nil then return value end
  return trust.refuse(self, key)
end

function Run:__tostring()
  if self.ok and self.quantities then
    return ("run of '%s': ok (%s), t = %.6g s, %d levels, %.3g s of computing\n%s"):format(self.name,
      self.reason, self.time, #self.levels, self.cpu, tostring(self:error_bars()))
  end
  return ("run of '%s': %s (%s), t = %.6g s, %d steps, %.3g s of computing"):format(
    self.name, self.ok and "ok" or "FAILED", self.reason, self.time, self.steps, self.cpu)
end

return Run
