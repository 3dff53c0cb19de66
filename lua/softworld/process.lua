-- SPDX-License-Identifier: GPL-3.0-or-later
--- Processes: sequences of handling steps, as coroutines. Several run at once,
-- each with its own clock of waits; the run advances the scene from one wake-up
-- to the next.
--
--     scene:process(function(p)
--       p:wait(0.5)
--       p:wait_until(function() return left:force()[3] > 0.2 end, { timeout = 2 })
--     end)
-- @module softworld.process
local core = require "softworld.core"
local build = require "softworld.build"

local process = {}
local Process = { __name = "process" }
Process.__index = Process

local current = setmetatable({}, { __mode = "k" }) -- coroutine -> its process

local function check_time(what, seconds)
  if type(seconds) ~= "number" or not (seconds >= 0 and seconds < math.huge) then
    error(("%s = %s is not allowed; it must be a time of at least 0 s")
      :format(what, tostring(seconds)), 3)
  end
end

--- The process that is running now, or nil outside of one.
function process.current()
  return current[coroutine.running()]
end

-- Sleep until the scene's time reaches wake [s].
function process.sleep_until(self, wake)
  self.wake = wake
  while self.scene.time < wake - 1e-12 * math.max(1, math.abs(wake)) do coroutine.yield() end
  self.wake = nil
end

--- Let time pass [s].
function Process:wait(seconds)
  check_time("p:wait: seconds", seconds)
  process.sleep_until(self, self.scene.time + seconds)
end

--- Wait until condition() is true; asked once per step. Returns true, or false
-- when timeout [s] passed first.
function Process:wait_until(condition, options)
  if type(condition) ~= "function" then
    error("p:wait_until expects a function, got " .. type(condition), 2)
  end
  local timeout = options and options.timeout or math.huge
  if timeout ~= math.huge then check_time("p:wait_until: timeout", timeout) end
  local last = self.scene.time + timeout
  while not condition() do
    if self.scene.time >= last - 1e-12 * math.max(1, math.abs(last)) then
      self.watching, self.wake = nil, nil
      return false
    end
    self.watching, self.wake = true, last
    coroutine.yield()
  end
  self.watching, self.wake = nil, nil
  return true
end

function Process:__tostring()
  return ("process %d (%s)"):format(self.number, coroutine.status(self.thread))
end

--- scene:process(function(p) ... end) -> process
function core.class.scene.process(scene, body)
  if type(body) ~= "function" then
    error("scene:process expects a function, got " .. type(body), 2)
  end
  local list = build.data(scene).processes
  local self = setmetatable({ scene = scene, number = #list + 1 }, Process)
  self.thread = coroutine.create(body)
  current[self.thread] = self
  list[#list + 1] = self
  return self
end

local function resume(self)
  local ok, message = coroutine.resume(self.thread, self)
  if not ok then
    self.failed = true
    error(message, 0)
  end
end

--- Let every process whose time has come go on. Returns the number of living
-- processes, the next wake-up time [s] and whether one watches a condition.
function process.step(scene)
  local alive, wake, watching = 0, math.huge, false
  for _, p in ipairs(build.data(scene).processes) do
    if coroutine.status(p.thread) ~= "dead" then
      local due = not p.wake or p.watching or
        scene.time >= p.wake - 1e-12 * math.max(1, math.abs(p.wake))
      if due then resume(p) end
    end
    if coroutine.status(p.thread) ~= "dead" then
      alive = alive + 1
      wake = math.min(wake, p.wake or scene.time)
      watching = watching or p.watching or false
    end
  end
  return alive, wake, watching
end

return process
