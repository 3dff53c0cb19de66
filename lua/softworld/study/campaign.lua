-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs all evaluations of one sweep, search or spread: it takes those in the journal from there; workers
-- compute the others, which are added to the journal.
--
-- A record: { part =, number =, values =, results = { name = number } or nil, failed = reason, machine = true
-- if the machine failed, not the model, events = the first event of its runs that evaluate did not look at }.
-- @module softworld.study.campaign
local checks = require "softworld.checks"
local cluster = require "softworld.study.cluster"
local core = require "softworld.core"
local evaluation = require "softworld.study.evaluation"
local judge = require "softworld.study.judge"
local node = require "softworld.study.node"
local parameters = require "softworld.study.parameters"
local parts = require "softworld.study.parts"
local pool = require "softworld.study.pool"
local progress = require "softworld.study.progress"
local unread = require "softworld.unread"

local campaign = {}

local function finite(text)
  local x = tonumber(text)
  return x and x - x == 0 and x + 0.0 or nil
end

-- Reads 'time=1.5 margin=0.25' as a table; nil for anything else. Also returns a text in quotes behind it.
local function results_of(text)
  local results, left, events = {}, text, text:match ' "([^"]*)"$'
  if events then left = left:sub(1, #left - #events - 3) end
  while left ~= "" do
    local name, number, rest = left:match "^(%a[%w_]*)=(%S+) ?(.*)$"
    local value = number and finite(number)
    if not value then return nil end
    results[name], left = value, rest
  end
  return next(results) and results, events
end

--- Makes a record from a line: status "ok" and results as text, or another status and a reason. nil: invalid.
function campaign.record(part, number, values, status, rest)
  local r = { part = part, number = number, values = values }
  if status == "ok" then
    r.results, r.events = results_of(rest)
    return r.results and r
  end
  r.failed, r.machine = rest, status == "machine" or nil
  return r
end

-- True if the line is final. Failures of the machine are computed again, unless due to the present limits.
local function stands(own, status, rest)
  if status ~= "machine" then return true end
  return own.cpu and rest == pool.cpu_reason(own.cpu)
    or own.memory and rest == evaluation.memory_reason(own.memory)
end

--- Calls setup once, when something must be computed.
function campaign.build(own)
  if own.built then return end
  own.built = own.setup and table.pack(own.setup()) or table.pack()
  evaluation.keep(own)
end

-- Returns an iterator over the tasks left to do; those in the journal are done at once.
local function tasks(own, part, source, done)
  return function()
    while true do
      local number, values = source.next()
      if not number then return nil end
      local word = parameters.word(values)
      local status, rest = own.journal:find(part, number, word)
      local record = status and (own.task or stands(own, status, rest))
        and campaign.record(part, number, values, status, rest)
      if not record then
        return { number = number, values = values, word = word, text = number .. " " .. word }
      end
      done(record, true)
    end
  end
end

local LONGEST = 300 -- longest text of an event that is kept [characters]

-- Returns status and text of an evaluation. Events of its runs stand in quotes behind the results.
local function evaluate(own, number, values)
  local event, status, rest = unread.gathered(evaluation.run, own, number, values)
  if status ~= "ok" or not event then return status, rest end
  return status, ('%s "%s"'):format(rest, event:sub(1, LONGEST):gsub("%c", " "):gsub('"', "'"))
end

local function keep(own, part, task, status, rest, done)
  if status == "mistake" then
    if task.number == 1 then error(rest, 0) end -- all others would fail alike
    status = "failed"
  end
  own.journal:add(part, task.number, task.word, status, rest)
  own.computed = own.computed + 1
  done(campaign.record(part, task.number, task.values, status, rest))
end

-- Computes within this process, one task after the other.
local function here(own, part, next_task, done)
  local again, more = math.random(0), math.random(0)
  local fine, why = pcall(function()
    for task in next_task do
      local status, rest = evaluate(own, task.number, task.values)
      keep(own, part, task, status, rest, done)
    end
  end)
  math.randomseed(again, more)
  if not fine then error(why, 0) end
end

local function by_workers(own, part, count, next_task, done)
  pool.run {
    workers = count, cpu = own.cpu, memory = own.memory, next = next_task,
    begin = function()
      own.journal:leave()
      package.loaded.softworld.remarks = false
    end,
    answer = function(text)
      local number, word = text:match "^(%d+) (.*)$"
      local values = parameters.values(own.parameters, word)
      local status, rest = evaluate(own, math.tointeger(number), values)
      return status .. " " .. rest
    end,
    done = function(task, status, rest) keep(own, part, task, status, rest, done) end,
  }
end

-- Computes the tasks. The first one shows whether anything must be built.
local function compute(own, part, options, source, done)
  local next_task = tasks(own, part, source, done)
  local first = next_task()
  if not first then return cluster.done(own, own.asked[part].name) end
  if own.task then node.missing(own, first.number) end
  campaign.build(own)
  local function from_first()
    local task = first
    if task then
      first = nil
      return task
    end
    return next_task()
  end
  local count = own.task and node.workers() or options.workers or own.workers or core.processors()
  local function compute_here(next_one)
    if count == 0 then return here(own, part, next_one, done) end
    by_workers(own, part, count, next_one, done)
  end
  if own.on ~= "slurm" or own.task then
    compute_here(from_first)
    return cluster.done(own, own.asked[part].name)
  end
  cluster.run(own, { name = own.asked[part].name, next = from_first, whole = source.whole,
    here = compute_here, workers = count,
    keep = function(task, status, rest) keep(own, part, task, status, rest, done) end })
end

local function bar_of(own, method, options, source)
  return progress.new(own, method, { total = source.count or options.evaluations,
    most = source.count == nil, result = method:match "^minimise (.*)$" })
end

--- Evaluates everything that source.next() gives: number, values; nil if there is none at the moment.
-- source.done(record) gets each result. Returns the part's records by number.
function campaign.run(own, method, options, source)
  if own.busy then error(("study '%s': evaluate cannot start other evaluations"):format(own.name), 0) end
  local name, part, records = parts.name(own, method, options), nil, {}
  own.bar = bar_of(own, method, options, source)
  local function done(record, known)
    judge.complete(own, record)
    records[record.number] = record
    own.bar:update(record, known)
    if source.done then source.done(record) end
  end
  own.busy = true
  local fine, why = pcall(function()
    own.hold = not own.task and cluster.claim(own)
    own.journal:open()
    own.tell()
    part = parts.begin(own, name, method, records)
    if own.task then node.part(own, name.full, campaign.build) end
    compute(own, part, options, source, done)
  end)
  own.busy = false
  own.bar:clear()
  own.journal:close()
  cluster.release(own, own.hold)
  if fine then return records end
  if part then parts.leave(own, name) end -- if asked for again, it goes on
  if checks.is_interrupt(why) then own.interrupted() end
  error(why, 0)
end

return campaign
