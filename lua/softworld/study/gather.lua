-- SPDX-License-Identifier: GPL-3.0-or-later
--- Collects what tasks on a cluster have found, and finds out which of them are lost.
-- @module softworld.study.gather
local core = require "softworld.core"
local batch = require "softworld.study.batch"
local checks = require "softworld.checks"
local sends = require "softworld.study.sends"
local slurm = require "softworld.study.slurm"

local gather = {}

local TRIES = 3   -- an evaluation is sent at most this often
local SMALLER = 4 -- factor by which tasks get smaller when sent again
local LOOK, LONG_LOOK = 1, 15 -- shortest and longest time between two questions to Slurm [s]

local say, plural = batch.say, require "softworld.output.number".count

--- Takes what tasks have found. Returns how many evaluations.
function gather.collect(run)
  local count = 0
  for _, send in ipairs(run.sends) do
    for k in pairs(next(send.open) and sends.finished(send.folder) or {}) do
      local found = send.open[k] and sends.result(send.folder, k, send.tasks[k])
      for _, r in ipairs(found or {}) do
        local task = run.needed[r.number]
        if task and task.word == r.word then
          run.needed[r.number], run.left, count = nil, run.left - 1, count + 1
          run.keep(task, r.status, r.rest)
        end
      end
      if found then send.open[k] = nil end
    end
  end
  return count
end

local function reason_of(send, k, state)
  local words = sends.words(send.folder, k)
  local what = state and state.state ~= "COMPLETED" and state.state
    or state and "ended without a result" or "gone, as when it is cancelled before it begins"
  return ("task %d of job %s: %s%s"):format(k - 1, send.id, what,
    words and ", its log ends with: " .. words or "")
end

-- Handles a task that is over without a result: its evaluations are sent again, or have failed.
local function lose(run, send, k, state)
  local again, given_up, reason = 0, 0, reason_of(send, k, state)
  send.open[k] = nil
  for _, item in ipairs(send.tasks[k]) do
    local task = run.needed[item.number]
    if task and task.send == send and task.k == k then
      task.send = nil
      if task.tries >= TRIES then
        run.needed[item.number], run.left, given_up = nil, run.left - 1, given_up + 1
        run.kept_logs = true
        run.keep(task, "machine", ("lost %d times on the cluster; the last: %s"):format(task.tries, reason))
      else
        again = again + 1
        task.per = math.max(1, math.ceil(#send.tasks[k] / SMALLER))
        run.waiting[#run.waiting + 1] = task
      end
    end
  end
  if again > 0 then say(run.own, "%s; sent again: %s", reason, plural(again, "evaluation")) end
  if given_up > 0 then say(run.own, "%s; given up: %s", reason, plural(given_up, "evaluation")) end
end

local function waits_for(run, states)
  local reasons = {}
  for _, tasks in pairs(states) do
    for _, state in pairs(tasks) do
      if state.state ~= "PENDING" then
        if state.state == "RUNNING" then return end
      elseif state.reason ~= "None" and state.reason ~= "Priority" and state.reason ~= "Resources" then
        reasons[state.reason] = true
      end
    end
  end
  local text = table.concat(checks.sorted(reasons), "; ")
  if text ~= "" and run.told ~= text then
    say(run.own, "all tasks wait, for: %s", text)
    run.told = text
  end
end

--- Asks Slurm now and then. A task counts as lost if it is found over and without a result twice, because the
-- file system may show a result late.
function gather.look(run)
  if core.clock() - run.asked < math.min(LONG_LOOK, LOOK * 1.3 ^ run.calm) then return end
  local jobs = {}
  for _, send in ipairs(run.sends) do
    if next(send.open) then jobs[#jobs + 1] = send.job end
  end
  local states, why = slurm.states(jobs)
  run.asked, run.calm = core.clock(), run.calm + 1
  if not states then
    if not run.silent then say(run.own, "Slurm does not answer (%s); waiting", why) end
    run.silent = true
    return
  end
  run.silent = nil
  gather.collect(run)
  waits_for(run, states)
  for _, send in ipairs(run.sends) do
    for k in pairs(send.open) do
      local state = states[send.job] and states[send.job][k - 1]
      if not slurm.over(state) then
        send.missed[k] = nil
      elseif send.missed[k] then
        lose(run, send, k, state)
      else
        send.missed[k], run.calm = true, 0
      end
    end
  end
end

return gather
