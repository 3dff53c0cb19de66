-- SPDX-License-Identifier: GPL-3.0-or-later
--- Processes: sequences of handling steps, as coroutines. Several run at once,
-- each with its own clock of waits; the run advances the scene from one wake-up
-- to the next.
--
--     scene:process(function(p)
--       p:wait(0.5)
--       p:wait_until(function() return left:force()[3] > 0.2 end, { timeout = 2 })
--     end)
--
-- A process that yields by itself goes on after the next step.
-- @module softworld.process
local core = require "softworld.core"
local build = require "softworld.build"
local conditions = require "softworld.conditions"

local process = {}
local Process = { __name = "process" }
Process.__index = Process

local current = setmetatable({}, { __mode = "k" }) -- coroutine -> its process
local SAME_TIME = 1e-12 -- of the time: the core's own rounding [-]

--- Has the scene's time reached t, but for rounding?
function process.reached(scene, t)
  return scene.time >= t - SAME_TIME * math.max(1, math.abs(t))
end

local function check_time(what, seconds)
  if type(seconds) ~= "number" or not (seconds >= 0 and seconds < math.huge) then
    error(("%s = %s%s is not allowed; it must be a time of at least 0 s"):format(what,
      tostring(seconds), type(seconds) == "number" and " s" or ""), 3)
  end
end

--- The process that is running now, or nil outside of one.
function process.current()
  return current[coroutine.running()]
end

local function check_inside(self, what)
  if process.current() ~= self then
    error(what .. " works only inside its own process, not in a function or coroutine beside it", 3)
  end
end

-- Sleep until the scene's time reaches wake [s].
function process.sleep_until(self, wake)
  while not process.reached(self.scene, wake) do
    self.wake = wake
    coroutine.yield()
  end
end

--- Let time pass [s].
function Process:wait(seconds)
  check_time("p:wait: seconds", seconds)
  check_inside(self, "p:wait")
  process.sleep_until(self, self.scene.time + seconds)
end

local function timeout_of(options)
  if options == nil then return math.huge end
  if type(options) ~= "table" then
    error("p:wait_until takes a table of options, got " .. type(options), 3)
  end
  for key in pairs(options) do
    if key ~= "timeout" then
      error(("p:wait_until: there is no option '%s'; known is: timeout"):format(tostring(key)), 3)
    end
  end
  local timeout = options.timeout
  if timeout == nil or timeout == math.huge then return math.huge end
  if type(timeout) ~= "number" or timeout ~= timeout or timeout < 0 then
    error(("p:wait_until: timeout = %s is not allowed; it must be at least 0 s")
      :format(tostring(timeout)), 3)
  end
  return timeout
end

--- Wait until condition() is true; asked once per step. A condition may also be a table, see help
-- "wait_until": { force = [N], on = gripper or obstacle }, { slip = [m], on = gripper },
-- { contact = obstacle }, { distance = [m], between = { a, b } }. Returns true, or false
-- when timeout [s] passed first.
function Process:wait_until(condition, options)
  if type(condition) == "table" then condition = conditions.of(condition, 3) end
  if type(condition) ~= "function" then
    error("p:wait_until expects a function or a table, got " .. type(condition), 2)
  end
  local last = self.scene.time + timeout_of(options)
  check_inside(self, "p:wait_until")
  while not condition() do
    if process.reached(self.scene, last) then return false end
    self.watching, self.wake = true, last
    coroutine.yield()
  end
  return true
end

--- Pay out (length > 0) or draw in (< 0) a length of wire through a feed and wait until it
-- is done: { length = [m], speed = [m/s] or duration = [s], law = }.
function Process:feed(feed, args)
  if core.type(feed) ~= "clamp" then
    error("p:feed expects what scene:feed returns, got " .. (core.type(feed) or type(feed)), 2)
  end
  check_inside(self, "p:feed")
  process.sleep_until(self, self.scene.time + build.call(3, feed.feed, feed, args))
end

--- End the process where it waits.
function Process:finish()
  if coroutine.status(self.thread) == "suspended" then coroutine.close(self.thread) end
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
  local self = setmetatable({ scene = scene, number = data.process_count, body = body }, Process)
  self.thread = coroutine.create(body)
  current[self.thread] = self
  data.processes[#data.processes + 1] = self
  return self
end

--- The functions of the scene's processes, to be begun again later by process.renew. A
-- process that is under way has no way back: nil and it.
function process.bodies(scene)
  local bodies = {}
  for i, p in ipairs(build.data(scene).processes) do
    if p.begun then return nil, p end
    bodies[i] = p.body
  end
  return bodies
end

--- Put these processes in place of those that there are.
function process.renew(scene, bodies)
  local data = build.data(scene)
  for _, p in ipairs(data.processes) do p:finish() end
  data.processes = {}
  for _, body in ipairs(bodies) do scene:process(body) end
end

local library = debug.getinfo(1, "S").short_src:match "^(.*)process%.lua$" or "softworld/"

-- Where in the user's script the library was called that failed a process:
-- "file:line: "; "" when the script's own code failed, whose errors stay as they are.
local function place_in(thread)
  local inside = false
  for level = 0, 50 do
    local info = debug.getinfo(thread, level, "Sl")
    if not info then break end
    if info.currentline > 0 then
      local ours = info.short_src:sub(1, #library) == library
      if not ours then
        return inside and ("%s:%d: "):format(info.short_src, info.currentline) or ""
      end
      inside = true
    end
  end
  return ""
end

local function resume(self)
  self.wake, self.watching, self.begun = nil, nil, true
  local ok, message = coroutine.resume(self.thread, self)
  if not ok then
    self.failed, self.traceback = true, debug.traceback(self.thread)
    if type(message) == "string" and not message:find "^[^\n:]+:%d+: " then
      message = place_in(self.thread) .. message
    end
    error(message, 0)
  end
  if not self.wake then self.watching, self.wake = true, math.huge end -- a plain yield
end

--- Let every process whose time has come go on. Returns the number of living
-- processes, the next wake-up time [s] and whether one watches a condition.
function process.step(scene)
  local alive, wake, watching = {}, math.huge, false
  local data = build.data(scene)
  for _, p in ipairs(data.processes) do
    local waits = coroutine.status(p.thread) == "suspended"
    if waits and (not p.wake or p.watching or process.reached(scene, p.wake)) then resume(p) end
    if coroutine.status(p.thread) == "suspended" then
      alive[#alive + 1] = p
      wake = math.min(wake, p.wake)
      watching = watching or p.watching or false
    end
  end
  data.processes = alive
  return #alive, wake, watching
end

return process
