-- SPDX-License-Identifier: GPL-3.0-or-later
--- Worker processes that evaluate. Each is a fork with everything that setup has built; tasks and results are
-- texts. If a worker ends, one evaluation has failed, and another worker takes its place.
-- @module softworld.study.pool
local core = require "softworld.core"

local pool = {}

local LOOK = 0.1       -- longest wait without a look for Ctrl-C [s]
local AGAIN = 1        -- how often an evaluation is sent again if somebody killed its worker
local SIGINT, SIGKILL, SIGPROF, SIGTERM, SIGHUP = 2, 9, 27, 15, 1
local OTHERS = { [SIGINT] = true, [SIGKILL] = true, [SIGTERM] = true, [SIGHUP] = true }
local NAMES = { [4] = "illegal instruction", [6] = "aborted", [7] = "bus error", [8] = "arithmetic error",
  [9] = "killed", [11] = "segmentation fault", [15] = "terminated" }

--- In a worker: answers until there is nothing more to do. answer(text) -> text.
local function serve(channel, options)
  while true do
    local text = channel:receive()
    if not text then return end
    if options.cpu then core.limit_cpu(options.cpu) end
    local reply = options.answer(text)
    if options.cpu then core.limit_cpu(0) end
    io.stdout:flush()
    channel:send(reply)
  end
end

local function fork(self)
  local options = self.options
  local worker, why = core.fork(function(channel)
    options.begin()
    serve(channel, options)
  end, options.memory)
  if not worker then
    error(("no process for a worker (%s); end some others, or give fewer workers"):format(why), 0)
  end
  return worker
end

-- Returns status and reason of an evaluation whose worker has ended, and whether to send it again.
local function ended(options, how, number)
  if how == "exit" then return "failed", ("evaluate ended its process (exit code %d)"):format(number) end
  if number == SIGPROF then return "machine", pool.cpu_reason(options.cpu or 0) end
  local text = ("its process ended by signal %d%s"):format(number,
    NAMES[number] and " (" .. NAMES[number] .. ")" or "")
  return OTHERS[number] and "machine" or "failed", text, OTHERS[number]
end

--- Returns the reason of an evaluation that took too long.
function pool.cpu_reason(cpu) return ("took more than %.9g s of computing time"):format(cpu) end

local function send(self, slot, task)
  slot.task = task
  if slot.worker:send(task.text) then return end
  slot.worker:stop() -- killed while it waited: another one does the task
  slot.worker = fork(self)
  if not slot.worker:send(task.text) then error("a worker ends as soon as it begins", 0) end
end

local function take(self, slot)
  local text, how, number = slot.worker:receive()
  local task = slot.task
  slot.task = nil
  if text then return self.options.done(task, text:match "^(%l+) (.*)$") end
  slot.worker:stop()
  slot.worker = fork(self)
  local status, reason, others = ended(self.options, how, number)
  task.again = (task.again or 0) + (others and 1 or AGAIN + 1)
  if task.again > AGAIN then return self.options.done(task, status, reason) end
  send(self, slot, task)
end

-- Does one round: gives tasks to idle workers and reads results. False when all is done.
local function round(self)
  local busy, at = {}, {}
  for _, slot in ipairs(self.slots) do
    if not slot.task then
      local task = self.options.next()
      if task then send(self, slot, task) end
    end
    if slot.task then busy[#busy + 1], at[#at + 1] = slot.worker, slot end
  end
  if #busy == 0 then return false end
  for _, i in ipairs(core.ready(busy, LOOK)) do take(self, at[i]) end
  return true
end

local function all(self)
  for i = 1, self.options.workers do self.slots[i] = { worker = fork(self) } end
  while round(self) do end
end

--- Does everything that options.next() gives, tasks { text = }, nil if there is none at the moment; calls
-- done(task, status, text) for each as they come. workers: how many; begin(): called in each worker;
-- answer(text) -> text; cpu [s] and memory [B]: limits for one evaluation, nil = none. No worker is left,
-- however this ends.
function pool.run(options)
  local self = { options = options, slots = {} }
  local fine, why = pcall(all, self)
  for _, slot in ipairs(self.slots) do slot.worker:stop() end
  if not fine then error(why, 0) end
end

return pool
