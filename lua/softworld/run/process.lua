-- SPDX-License-Identifier: GPL-3.0-or-later
--- Processes: sequences of handling steps, as coroutines. Several run at once,
-- each with its own waits; the run advances the scene from one wake-up to the
-- next.
--
--     scene:process(function(p)
--       p:wait(0.5)
--       p:wait_until(function() return left:force()[3] > 0.2 end, { timeout = 2 })
--       p:step("lay", function() left:move{ by = {0.3, 0, 0}, speed = 0.2 } end)
--     end)
--
-- A process that yields by itself goes on after the next step. A scene read from a file can
-- continue after a named step (p:step): see softworld.scene.save.
-- @module softworld.run.process
local core = require "softworld.core"
local methods = require "softworld.methods"
local rows = require "softworld.rows"
local blame = require "softworld.scene.blame"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local conditions = require "softworld.run.conditions"
local remarks = require "softworld.remarks"
local sealed = require "softworld.sealed"
local stages = require "softworld.run.stages"
local unread = require "softworld.unread"
local waiting = require "softworld.run.waiting"

local process = {}
local Process = { __name = "process" }

local current = setmetatable({}, { __mode = "k" }) -- coroutine -> its process
local SAME_TIME = 1e-12 -- relative rounding of times in the core [-]

--- True if the scene's time has reached t, within rounding.
function process.reached(scene, t)
  return scene.time >= t - SAME_TIME * math.max(1, math.abs(t))
end

--- Returns the running process, or nil outside of one.
function process.current()
  return current[coroutine.running()]
end

local resumed -- the process that has its turn

--- Gives a process its turn. Returns what coroutine.resume returns.
function process.resume(self)
  local before = resumed
  resumed = self
  local function done(...)
    resumed = before
    return ...
  end
  return done(coroutine.resume(self.thread, self))
end

-- Returns the running process of this scene, or nil; if another scene's process runs, that one as well.
local function find(scene, what)
  local self = process.current()
  if self then return self.scene == scene and self or nil, self end
  if resumed and resumed.scene == scene and coroutine.status(resumed.thread) == "normal" then
    error(("%s takes time, and works only in the process itself, not in a coroutine beside it")
      :format(what), 0)
  end
end

--- Returns the running process of this scene, or nil outside of one: a process of another scene may use this
-- one, but no time passes in it meanwhile. A call that takes time raises an error in a coroutine within a
-- process, where it could not wait; what: its name.
function process.of(scene, what)
  local self, other = find(scene, what)
  if other and not self and remarks.wanted() then
    remarks.tell("elsewhere " .. what, ("%s returns at once: it is of scene '%s', and this is a process of "
      .. "scene '%s'"):format(what, scene.name, other.scene.name))
  end
  return self
end

--- Same for a call that works only in a process of this scene; why: what the error says else.
function process.within(scene, what, why)
  local self, other = find(scene, what)
  if self then return self end
  if not other then error(why, 0) end
  error(("%s takes time of scene '%s', but this is a process of scene '%s'; call it in a process of scene "
    .. "'%s'"):format(what, scene.name, other.scene.name, scene.name), 0)
end

local function check_inside(self, what)
  if process.current() ~= self then
    error(what .. " works only inside its own process, not in a function or coroutine beside it", 3)
  end
end

--- Returns the completed steps of a process, in order.
function process.done(self)
  local data = build.data(self.scene)
  data.done = data.done or {}
  data.done[self.number] = data.done[self.number] or {}
  return data.done[self.number]
end

--- Returns the time at which the script came to the place where it is now [s]: while a process leaves out the
-- steps of a file, the time of that place in the run that wrote the file.
function process.moment(scene)
  local self = process.current()
  if not self or self.scene ~= scene or self.inside or self.moves > 1 then return scene.time end
  local done = process.done(self)
  if self.steps == 0 then return done[1] and done[1].from or scene.time end
  return done[self.steps] and done[self.steps].to or scene.time
end

--- Raises an error if steps are kept in a file and the running process is between two of them: a script that
-- continues from the file would do it again.
function process.guard(what)
  local self = process.current()
  if not self or self.inside then return end
  local data = build.data(self.scene)
  if not data.saving and self.steps >= #process.done(self) then return end
  error(("%s: this call is between two steps of %s, and a script that goes on from the file would repeat it; "
    .. "put it into a step: p:step('name', function() ... end)")
    :format(what, tostring(self)), 0)
end

build.guard = process.guard

-- Sleeps until the scene's time reaches wake [s].
function process.sleep_until(self, wake)
  if not process.reached(self.scene, wake) then process.guard "to let time pass" end
  while not process.reached(self.scene, wake) do
    self.wake = wake
    coroutine.yield()
  end
end

local IDLE = 1e5 -- waits at one time after which a process would go on for ever [-]

-- Raises an error if the process waits again and again while no time passes.
local function check_idle(self, seconds)
  local time = self.scene.time
  if time + seconds > time then return end
  if self.idle_at ~= time then self.idle_at, self.idle = time, 0 end
  self.idle = self.idle + 1
  if self.idle < IDLE then return end
  error(("p:wait: seconds = %g s was waited for %d times at t = %g s, and no time passes; wait for a time, "
    .. "or use p:wait_until(function)"):format(seconds, self.idle, time), 3)
end

--- Waits for a time [s].
function Process:wait(seconds)
  checks.number("p:wait: seconds", seconds, 0, " s", 3)
  check_inside(self, "p:wait")
  check_idle(self, seconds)
  process.sleep_until(self, self.scene.time + seconds)
end

local until_then = rows.call("p:wait_until", "condition, {...}",
  "waits until a function returns true, or until a condition given as a table holds, see help 'waiting'", {
    gives = "true, or false after the timeout",
    example = "p:wait_until({ force = 0.02, on = hand }, { timeout = 0.5 })",
    { "timeout", "number", "s", "longest wait", min = 0, usual = "no end" },
  })

rows.calls{
  { "scene:process", "function(p) ... end", "adds a process: a function that runs beside the simulation; "
    .. "several run at once", "a process" },
  { "p:wait", "seconds", "lets time pass [s]" },
  { "p:step", "name, function", "a step after which a saved run begins again, see help 'save'",
    "what the function returns",
    example = 'p:step("lift", function() hand:move { by = { 0, 0, 0.1 } } end)' },
  { "p:finish", "", "ends the process at the place where it waits" },
  { "p.time", nil, "of the scene", "s" },
  { "p.scene", nil, "of the process", "a scene" },
  { "p.number", nil, "of the process in its scene, from 1" },
}

local function timeout_of(options)
  if options == nil then return math.huge end
  if type(options) == "table" and options.timeout == math.huge then options = {} end
  return build.call(4, until_then.read, until_then, options).timeout or math.huge
end

--- Waits until condition() is true; it is called after each step, and again if another process has gone on
-- since at the same time, for it may have made the condition true. A condition may also be a table, see help
-- "wait_until": { force = [N], on = gripper or obstacle }, { slip = [m], on = gripper },
-- { contact = obstacle }, { distance = [m], between = { a, b } }. Returns true, or false
-- if timeout [s] passed first.
function Process:wait_until(condition, options)
  local impossible, tell
  local told, asked, again = type(condition) == "table", false, false
  if told then
    condition, impossible, tell = conditions.of(condition, 3, self.scene)
    condition = build.placed(condition)
  end
  if type(condition) ~= "function" then
    error("p:wait_until expects a function or a table, got " .. type(condition), 2)
  end
  local last = self.scene.time + timeout_of(options)
  check_inside(self, "p:wait_until")
  process.guard "p:wait_until"
  while not condition() do
    if process.reached(self.scene, last) then
      if told then waiting.ran_out(self, options.timeout) end
      return false
    end
    if last == math.huge then waiting.goes_on(self, impossible) end
    if asked then self.moves = self.moves - 1 end -- it is where it was; but a function may have a memory
    asked = told
    self.watching, self.asks, self.wake = true, again and "again" or "first", last
    again = true
    coroutine.yield()
  end
  waiting.ended(self)
  if tell then tell(self) end
  return true
end

rows.call("p:feed", "feed, {...}", "pays wire out or draws it in, and waits until the end", {
  example = "p:feed(feed, { length = 0.1, speed = 0.05 })",
  { "length", "number", "m", "to pay out; below zero it is drawn in", required = true },
  { "speed", "number", "m/s", "of the wire" },
  { "duration", "number", "s", "instead of a speed" },
  { "law", "text", "-", "law of the motion, as in a trajectory" },
})

--- Pays out or draws in wire through a feed, see help "p:feed".
function Process:feed(feed, args)
  if core.type(feed) ~= "clamp" then
    error("p:feed expects what scene:feed returns, got " .. (core.type(feed) or type(feed)), 2)
  end
  check_inside(self, "p:feed")
  remarks.on("feed", "p:feed", args)
  process.sleep_until(self, self.scene.time + build.call(3, feed.feed, feed, args))
end

local function check_step(self, name, work)
  if type(name) ~= "string" or name == "" then
    error(("p:step expects a name and a function, got %s"):format(name == "" and "''" or type(name)), 3)
  end
  checks.name("p:step: the name", name, 4, math.huge)
  if type(work) ~= "function" then
    error(("p:step '%s' expects a function, got %s"):format(name, type(work)), 3)
  end
  check_inside(self, "p:step")
  if self.inside then
    error(("p:step '%s' begins inside of step '%s'; end a step before the next one begins"):format(name,
      self.inside), 3)
  end
end

-- Returns the results of a step that was completed before the file was written.
local function recall(self, name, old)
  if old.name == name then return table.unpack(old.results, 1, old.count) end
  error(("p:step '%s': the file '%s' has '%s' as step %d of %s; a script that goes on from a file must have "
    .. "the same steps"):format(name, tostring(build.data(self.scene).from_file), tostring(old.name),
    self.steps, tostring(self)), 3)
end

--- A named step of the process: calls work(), which may let time pass. A run with save = file writes the
-- scene after it; a script that continues from the file skips the step. The results of work are
-- returned, and stored in the file: numbers, strings, tables of these, objects.
function Process:step(name, work)
  check_step(self, name, work)
  local done = process.done(self)
  self.steps = self.steps + 1
  if done[self.steps] then return recall(self, name, done[self.steps]) end
  self.inside = name
  local stage, from = stages.begin(self.scene, self.number, name), self.scene.time
  local results = table.pack(work())
  self.inside, stage.to = nil, self.scene.time
  local count = results.n
  results.n = nil
  done[self.steps] = { name = name, results = results, count = count, from = from, to = self.scene.time }
  self.between, self.wake = true, self.scene.time -- other steps that end now end first
  coroutine.yield()
  return table.unpack(results, 1, count)
end

--- Ends the process where it waits. Raises an error of its `<close>` variables.
function Process:finish()
  if process.current() == self then
    error("p:finish ends a process where it waits; within itself it ends by return", 2)
  end
  if coroutine.status(self.thread) ~= "suspended" then return end
  local fine, why = coroutine.close(self.thread)
  if not fine then blame.fault(why) end
end

-- Fields that may be nil.
local fields = { wake = true, watching = true, asks = true, begun = true, between = true, inside = true,
  failed = true, traceback = true }

--- Returns the names of methods and fields, for completion at the prompt.
function Process.__names() return methods.names(Process, { "time", "scene", "number" }) end

--- p.time is the scene's time [s].
function Process:__index(key)
  local own = rawget(sealed.fields(self), key)
  if own ~= nil then return own end
  if key == "time" then return self.scene.time end
  local value = Process[key]
  if value ~= nil or fields[key] then return value end
  error(checks.lacks("a process", key, Process.__names(),
    "`softworld doc process` lists what it has"), 2)
end

function Process:__newindex(key, value)
  if not sealed.by_library() then
    error(("a process has no '%s' to set; use a local variable"):format(checks.shown(key)), 2)
  end
  rawset(sealed.fields(self), key, value)
end

function Process:__tostring()
  return ("process %d (%s)"):format(self.number,
    self.failed and "failed" or coroutine.status(self.thread))
end

--- scene:process(function(p) ... end) -> process
function core.class.scene.process(scene, body)
  build.check(scene, "scene:process", 3)
  if type(body) ~= "function" then
    error("scene:process expects a function, got " .. type(body), 2)
  end
  local data = build.data(scene)
  data.process_count = (data.process_count or 0) + 1
  local self = sealed.new(Process, { scene = scene, number = data.process_count, body = body,
    steps = 0, moves = 0, idle = 0, idle_at = false, asked = 0 })
  self.thread = coroutine.create(body)
  if not data.from_file then -- forgets the steps of an earlier process with this number
    if data.done then data.done[self.number] = nil end
    if data.ended then data.ended[self.number] = nil end
  end
  current[self.thread] = self
  data.processes[#data.processes + 1] = self
  if not data.running then unread.process(data) end -- else the run that is under way has a use for it
  return self
end

--- Returns the functions of the scene's processes, so that process.renew can start them again. If a
-- process is under way, which cannot be started again: nil and the process.
function process.bodies(scene)
  local bodies = {}
  for i, p in ipairs(build.data(scene).processes) do
    if p.begun then return nil, p end
    bodies[i] = p.body
  end
  return bodies
end

--- Replaces all processes by these.
function process.renew(scene, bodies)
  local data = build.data(scene)
  local raise = blame.each(data.processes, "finish")
  data.processes = {}
  for _, body in ipairs(bodies) do scene:process(body) end
  unread.used(data)
  raise()
end

--- Returns how far the living processes are, for process.is_at: { [process] = moves }.
function process.mark(scene)
  local mark = {}
  for _, p in ipairs(build.data(scene).processes) do
    if coroutine.status(p.thread) ~= "dead" then mark[p] = p.moves end
  end
  return mark
end

--- True if the processes are still where they were at the mark, so that restoring the scene alone suffices.
function process.is_at(scene, mark)
  local count = 0
  for _, p in ipairs(build.data(scene).processes) do
    if coroutine.status(p.thread) ~= "dead" then
      if mark[p] ~= p.moves then return false end
      count = count + 1
    end
  end
  for _ in pairs(mark) do count = count - 1 end
  return count == 0
end

methods.guard_table("process", Process)

return process
