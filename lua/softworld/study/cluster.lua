-- SPDX-License-Identifier: GPL-3.0-or-later
--- Evaluations of a study on a cluster: sent as job arrays of Slurm, many in a task, and collected from the
-- files that the tasks leave. If Slurm says that a task is over, or does not know it, its missing results are
-- lost: these evaluations are sent again, in smaller tasks, twice at most. Files alone record what has been
-- sent, so any process can continue.
-- @module softworld.study.cluster
local batch = require "softworld.study.batch"
local core = require "softworld.core"
local gather = require "softworld.study.gather"
local owner = require "softworld.study.owner"
local sends = require "softworld.study.sends"
local sink = require "softworld.output.sink"
local slurm = require "softworld.study.slurm"

local cluster = {}

local SECONDS = 30 -- target computing time of a task [s]
local WORTH = 2    -- rounds of a search are sent if computing them here would take this many tasks' time
local NAP, LONG_NAP = 0.1, 2 -- shortest and longest time between two looks for results [s]

local function fail(text, ...) error(text:format(...), 0) end

local say, plural = batch.say, require "softworld.output.number".count

local function count_of(set)
  local count = 0
  for _ in pairs(set) do count = count + 1 end
  return count
end

-- --- one process at a time ------------------------------------------------------------------------

local function cancel_file(own) return sends.folder(own.file) .. "/cancel" end

-- Reports tasks that nobody collects while this process computes here.
local function tell_of_tasks(own)
  local count = 0
  for _, number in ipairs(sends.numbers(own.file)) do
    local about = sends.read(("%s/%d"):format(sends.folder(own.file), number))
    if about and about.key == own.journal.definition.key then count = count + 1 end
  end
  if count == 0 or own.told.tasks then return end
  own.told.tasks = true
  say(own, "%s of it on a cluster: on = 'slurm' collects what they find, study:cancel() ends them",
    plural(count, "job"))
end

--- Called before work on a study; makes this process the only one. Returns what release() takes; nil without
-- a cluster.
function cluster.claim(own)
  if not own.file then
    if own.on == "slurm" then
      fail("study '%s': on = 'slurm' needs a journal, file = '%s.study', in a folder that the nodes see too",
        own.name, (own.name:gsub("[^%w]", "_")))
    end
    return nil
  end
  local folder = sends.folder(own.file)
  if core.kind(folder) ~= "folder" then
    if own.on ~= "slurm" then return nil end
    slurm.need(own.name)
    sink.make_folder(folder)
  end
  local hold = owner.claim(own.name, folder)
  os.remove(cancel_file(own))
  if own.on ~= "slurm" then tell_of_tasks(own) end
  return hold
end

--- Called after the work.
function cluster.release(own, hold)
  if not hold then return end
  hold:release()
  os.remove(sends.folder(own.file)) -- works only if it is empty
end

local function open_tasks(run)
  local count, ids = 0, {}
  for _, send in ipairs(run.sends) do
    local n = count_of(send.open)
    count = count + n
    if n > 0 then ids[#ids + 1] = send.id end
  end
  return count, table.concat(ids, " ")
end

local function detach(run)
  if not run.own.detach or #run.waiting > 0 or run.left == 0 then return end
  local count, ids = open_tasks(run)
  fail("study '%s': %s left to Slurm, job %s; run the script again to collect what they find, or "
    .. "study:cancel() to end them", run.own.name, plural(count, "task"), ids)
end

-- Waits until nothing is left.
local function wait(run)
  run.asked, run.calm = core.clock(), 0
  local nap = NAP
  while run.left > 0 do
    run.hold:beat()
    run.own.bar:update()
    if core.kind(cancel_file(run.own)) then
      fail("study '%s' was cancelled; run the script again to go on", run.own.name)
    end
    batch.send(run)
    if gather.collect(run) > 0 then nap = NAP end
    gather.look(run)
    if #run.waiting == 0 then detach(run) end
    if run.left > 0 then core.ready({}, nap) end
    nap = math.min(LONG_NAP, 1.2 * nap)
  end
end

-- --- a part ---------------------------------------------------------------------------------------------

-- Returns all tasks that can be done at the moment.
local function ask(run)
  local fresh, list = {}, {}
  for task in run.next do
    task.tries = 0
    fresh[task.number], list[#list + 1] = task, task
  end
  batch.adopt(run, fresh)
  return list
end

-- Computes the first task here. This shows a mistake at once, and its time gives the number of evaluations in
-- a task.
local function first_here(run, list)
  if run.each or #list == 0 then return end
  local task, started = table.remove(list, 1), core.clock()
  run.here(function()
    local one = task
    task = nil
    return one
  end)
  run.each = math.max(1e-4, core.clock() - started)
end

local function send_all(run, list)
  local o = run.own
  run.needed, run.left, run.waiting = {}, #list, {}
  for _, task in ipairs(list) do
    run.needed[task.number] = task
    if not task.send then run.waiting[#run.waiting + 1] = task end
  end
  run.per = o.tasks and math.ceil(#list / o.tasks)
    or math.max(1, math.floor((o.seconds or SECONDS) / (run.each or SECONDS)))
  wait(run)
end

-- Removes the files of this part's sends, but keeps logs if tasks were lost.
local function tidy(run)
  for _, send in ipairs(run.sends) do
    if run.kept_logs then
      say(run.own, "logs of tasks are in %s", send.folder)
      sends.forget(send.folder)
    else
      sends.remove(send.folder)
    end
  end
  run.sends = {}
end

local function is_anything_sent(list)
  for _, task in ipairs(list) do
    if task.send then return true end
  end
  return false
end

local function all(run)
  local list = ask(run)
  while #list > 0 do
    if not is_anything_sent(list) then first_here(run, list) end
    if not run.whole and #list > 0 and not is_anything_sent(list) then
      local time = run.each * #list / math.max(1, run.workers)
      if time < WORTH * (run.own.seconds or SECONDS) then
        return run.here(function() return table.remove(list, 1) or run.next() end)
      end
    end
    if #list > 0 then send_all(run, list) end
    tidy(run)
    list = ask(run)
  end
end

local function cancel(run)
  local jobs = {}
  for _, send in ipairs(run.sends) do
    if next(send.open) then
      jobs[#jobs + 1] = send.job
      sends.put(send.folder .. "/cancelled", "")
    end
  end
  slurm.cancel(jobs)
end

-- After Ctrl-C: asks whether tasks go on, or cancels them.
local function leave(run)
  local count, ids = open_tasks(run)
  if count == 0 then return end
  local stay = run.own.detach
  run.own.bar:clear()
  if not stay and os.execute "test -t 0 && test -t 2" then
    io.stderr:write(("\nstudy '%s': %s on the cluster (job %s). Leave them running? [Y/n] "):format(
      run.own.name, plural(count, "task"), ids))
    stay = not (io.read "l" or ""):find "^%s*[nN]"
  end
  if stay then
    return say(run.own, "%s left to Slurm; run the script again to collect", plural(count, "task"))
  end
  cancel(run)
  say(run.own, "%s cancelled (job %s)", plural(count, "task"), ids)
end

--- Computes what next() gives, tasks { number =, values =, word = }, on the cluster; calls keep(task, status,
-- rest) for each. about: name of the part; whole: all tasks come at once (else it is a search, whose rounds
-- are sent if worth it); here(next): computes in this process's workers; workers: their number.
function cluster.run(own, about)
  slurm.need(own.name)
  if not arg or not arg[-1] or not arg[0] or core.kind(arg[0]) ~= "file" then
    fail("study '%s': on = 'slurm' needs a script in a file, because the nodes run it too", own.name)
  end
  local run = { own = own, name = about.name, next = about.next, whole = about.whole, keep = about.keep,
    here = about.here, workers = about.workers, hold = own.hold, sends = {}, waiting = {}, last = 0, left = 0,
    options = slurm.options("study:run", own.options) }
  local fine, why = pcall(all, run)
  if fine then return end
  if type(why) == "string" and why:find "interrupted$" then leave(run) end
  error(why, 0)
end

--- Called when nothing is left to compute of a part: removes what was sent of it and left by a process that
-- was killed.
function cluster.done(own, name)
  if not own.hold then return end
  local jobs, folders = {}, {}
  for _, number in ipairs(sends.numbers(own.file)) do
    local folder = ("%s/%d"):format(sends.folder(own.file), number)
    local about = sends.read(folder)
    if about and about.part == name and about.key == own.journal.definition.key then
      jobs[#jobs + 1], folders[#folders + 1] = about.job, folder
    end
  end
  slurm.cancel(jobs)
  for _, folder in ipairs(folders) do sends.remove(folder) end
end

--- Cancels everything that a study has sent, from any process. Returns how many tasks were left.
function cluster.cancel(own)
  local run, count = { sends = {} }, 0
  if not own.file or own.task then return 0 end
  for _, number in ipairs(sends.numbers(own.file)) do
    local folder = ("%s/%d"):format(sends.folder(own.file), number)
    local about = sends.read(folder)
    if about and not core.kind(folder .. "/cancelled") then
      local open, finished = {}, sends.finished(folder)
      for k in pairs(about.tasks) do open[k] = not finished[k] or nil end
      run.sends[#run.sends + 1] = { folder = folder, job = about.job, open = open }
      count = count + count_of(open)
    end
  end
  if #run.sends == 0 then return 0 end
  slurm.need(own.name)
  if core.kind(sends.folder(own.file) .. "/owner") then sends.put(cancel_file(own), "") end
  cancel(run)
  return count
end

return cluster
