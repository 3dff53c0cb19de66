-- SPDX-License-Identifier: GPL-3.0-or-later
--- Job arrays of a study: what to send in tasks, and what earlier processes have sent.
--
-- A run, of one part of a study: own, name (of the part), needed (tasks without a result, by number),
-- left (their count), waiting (tasks to be sent), sends (arrays already sent: folder, job, id, tasks, open
-- and missed by number), per (evaluations in a task), options (of sbatch). A task: number, word, values,
-- tries (how often it was sent), send and k (where it is), per (for sending it again).
-- @module softworld.study.batch
local core = require "softworld.core"
local counted = require "softworld.output.number".count
local sends = require "softworld.study.sends"
local sink = require "softworld.output.sink"
local slurm = require "softworld.study.slurm"

local batch = {}

local AGAIN = 5 -- wait after Slurm had no room [s]

local function fail(text, ...) error(text:format(...), 0) end

--- Prints a message for the user.
function batch.say(own, text, ...)
  if own.bar then own.bar:clear() end
  io.stderr:write(("study '%s': %s\n"):format(own.name, text:format(...)))
end

local say, plural = batch.say, counted

-- --- sending ----------------------------------------------------------------------------------------

-- Returns the tasks in lists of run.per, or of task.per for those that are sent again.
local function chunks(run, tasks)
  local lists, list, most = {}, nil, nil
  for _, task in ipairs(tasks) do
    local per = task.per or run.per
    if not list or #list >= most or per ~= most then
      list, most = {}, per
      lists[#lists + 1] = list
    end
    list[#list + 1] = task
  end
  return lists
end

local function job_script(folder)
  local program = select(2, sink.run "readlink /proc/$PPID/exe"):gsub("\n$", "")
  local here = select(2, sink.run "pwd"):gsub("\n$", "")
  local words = { sink.quote(program), sink.quote(arg[0]) }
  for _, word in ipairs(arg) do words[#words + 1] = sink.quote(word) end
  return ("#!/bin/sh\ncd %s || exit 1\nSOFTWORLD_TASK=%s\nexport SOFTWORLD_TASK\nexec %s\n"):format(
    sink.quote(here), sink.quote(folder), table.concat(words, " "))
end

-- Sends one array. Returns true, or false if Slurm has no room at the moment.
local function send_array(run, lists)
  local own, root = run.own, sends.folder(run.own.file)
  run.last = run.last + 1
  local folder = ("%s/%d"):format(root, run.last)
  local d = own.journal.definition
  local about = { name = d.name, key = d.key, text = d.text, part = run.name,
    job = slurm.job(own.name, ("%s %s %.9f"):format(sends.who(), folder, core.clock())) }
  for _, list in ipairs(lists) do
    for _, task in ipairs(list) do task.tries = task.tries + 1 end
  end
  sends.write(folder, about, lists)
  sends.put(folder .. "/job.sh", job_script(folder))
  local fine, id, why = pcall(slurm.send, own.name, about.job, folder .. "/job.sh", folder .. "/log.%a",
    #lists, run.options)
  if not fine or not id then
    for _, list in ipairs(lists) do
      for _, task in ipairs(list) do task.tries = task.tries - 1 end
    end
    sends.remove(folder)
    if not fine then error(id, 0) end
    if #run.sends == 0 then fail("study '%s': Slurm takes no tasks: %s", own.name, why) end
    return false
  end
  sends.put(folder .. "/id", id .. "\n")
  local send = { folder = folder, job = about.job, id = id, tasks = lists, open = {}, missed = {} }
  for k, list in ipairs(lists) do
    send.open[k] = true
    for _, task in ipairs(list) do task.send, task.k = send, k end
  end
  run.sends[#run.sends + 1] = send
  return true
end

--- Sends the waiting tasks, in arrays of at most the largest allowed length.
function batch.send(run)
  if #run.waiting == 0 or run.full and core.clock() - run.full < AGAIN then return end
  run.largest = run.largest or slurm.largest(run.own.name)
  local lists, at, ids, tasks = chunks(run, run.waiting), 1, {}, 0
  while at <= #lists do
    local array = table.move(lists, at, math.min(#lists, at + run.largest - 1), 1, {})
    if not send_array(run, array) then break end
    at, tasks = at + #array, tasks + #array
    ids[#ids + 1] = run.sends[#run.sends].id
  end
  run.waiting, run.full = {}, at <= #lists and core.clock() or nil
  for k = at, #lists do table.move(lists[k], 1, #lists[k], #run.waiting + 1, run.waiting) end
  if tasks > 0 then
    say(run.own, "%s sent to Slurm, job%s %s", plural(tasks, "task"), #ids == 1 and "" or "s",
      table.concat(ids, " "))
  end
  run.asked, run.calm = core.clock(), 0 -- results will come soon
end

-- --- what is there from before ------------------------------------------------------------------------

--- Takes over what has been sent of this part: tasks in `fresh` that were sent already wait for their result.
function batch.adopt(run, fresh)
  local own, others = run.own, 0
  for _, number in ipairs(sends.numbers(own.file)) do
    run.last = math.max(run.last, number)
    local folder = ("%s/%d"):format(sends.folder(own.file), number)
    local about = sends.read(folder)
    if not about then
      if not core.kind(folder .. "/kept") then sends.remove(folder) end -- else it was never sent
    elseif about.key ~= own.journal.definition.key then
      others = others + 1
    elseif about.part == run.name then
      local id = (sends.text(folder .. "/id") or "?"):match "%S+"
      local send = { folder = folder, job = about.job, id = id, tasks = about.tasks, open = {}, missed = {} }
      local cancelled = core.kind(folder .. "/cancelled")
      for k, list in pairs(about.tasks) do
        send.open[k] = true
        for _, item in ipairs(list) do
          local task = fresh[item.number]
          if task and task.word == item.word then
            task.tries, task.per = math.max(task.tries, item.tries - (cancelled and 1 or 0)), nil
            task.send, task.k = not cancelled and send or nil, k
          end
        end
      end
      run.sends[#run.sends + 1] = send
    end
  end
  if others > 0 and not run.told_others then
    run.told_others = true
    say(own, "%s of another definition of it left on the cluster; study:cancel() ends them",
      plural(others, "job"))
  end
end

return batch
