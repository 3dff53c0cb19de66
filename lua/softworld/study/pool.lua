-- SPDX-License-Identifier: GPL-3.0-or-later
--- Processes that evaluate. Each is a fork with all that setup has built; what it is to do and what came
-- out are texts. One that ends is one failed evaluation, and another takes its place.
-- @module softworld.study.pool
local core = require "softworld.core"

local pool = {}

local LOOK = 0.1       -- longest wait without a look for Ctrl-C [s]
local AGAIN = 1        -- an evaluation is sent again so often when somebody killed its worker
local SIGINT, SIGKILL, SIGPROF, SIGTERM, SIGHUP = 2, 9, 27, 15, 1
local OTHERS = { [SIGINT] = true, [SIGKILL] = true, [SIGTERM] = true, [SIGHUP] = true }
local NAMES = { [4] = "illegal instruction", [6] = "aborted", [7] = "bus error", [8] = "arithmetic error",
  [9] = "killed", [11] = "segmentation fault", [15] = "terminated" }

--- In a worker: answer until there is nothing more to do. answer(text) -> text.
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

-- Status and reason of an evaluation whose worker has ended; second, whether to send it again.
local function ended(options, how, number)
  if how == "exit" then return "failed", ("evaluate ended its process (exit code %d)"):format(number) end
  if number == SIGPROF then return "machine", pool.cpu_reason(options.cpu or 0) end
  local text = ("its process ended by signal %d%s"):format(number,
    NAMES[number] and " (" .. NAMES[number] .. ")" or "")
  return OTHERS[number] and "machine" or "failed", text, OTHERS[number]
end

--- What is said of an evaluation that took too long.
function pool.cpu_reason(cpu) return ("took more than %.9g s of computing time"):format(cpu) end

local function send(self, slot, task)
  slot.task = task
  if slot.worker:send(task.text) then return end
  slot.worker:stop() -- it was killed while it waited: another one does it
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

-- One round: who has nothing to do gets something, who has done it is heard. False when all is done.
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

--- Do all that options.next() gives, tasks { text = }, nil when there is none now; done(task, status, text)
-- is called for each as they come. workers: how many; begin(): called in each worker; answer(text) -> text;
-- cpu [s] and memory [B] of one evaluation, nil = any. No worker is left, however this ends.
function pool.run(options)
  local self = { options = options, slots = {} }
  local fine, why = pcall(all, self)
  for _, slot in ipairs(self.slots) do slot.worker:stop() end
  if not fine then error(why, 0) end
end

return pool
