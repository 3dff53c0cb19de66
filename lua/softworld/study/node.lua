-- SPDX-License-Identifier: GPL-3.0-or-later
--- A task on a cluster: the same script, run on a node with SOFTWORLD_TASK in its environment. It reads what
-- the script asks for earlier from the journal, which is read-only. At the task's part it computes its
-- evaluations, writes the result, and ends the process.
-- @module softworld.study.node
local core = require "softworld.core"
local evaluation = require "softworld.study.evaluation"
local journal = require "softworld.study.journal"
local parameters = require "softworld.study.parameters"
local pool = require "softworld.study.pool"
local sends = require "softworld.study.sends"

local node = {}

local function fail(text, ...) error(text:format(...), 0) end

local task -- of this process: false, or { folder =, number =, about = }

--- Returns the task of this process, or nil.
function node.task()
  if task == nil then
    local folder = os.getenv "SOFTWORLD_TASK"
    task = folder and folder ~= "" and { folder = folder,
      number = 1 + (math.tointeger(os.getenv "SLURM_ARRAY_TASK_ID") or 0) } or false
    if task then
      task.about = sends.read(folder, task.number)
        or fail("SOFTWORLD_TASK=%s: there is no whole list of evaluations", folder)
    end
  end
  return task or nil
end

--- Sets up a study in such a process: it only reads its journal.
function node.study(own)
  local t = node.task()
  if not t then return end
  own.task, own.journal.reader = t, true
  local about = t.about
  if own.name == about.name and own.journal.definition.key ~= about.key then
    fail("study '%s' is another one on this node than where it was sent from:\n  %s", own.name,
      table.concat(journal.differences(about.text, own.journal.definition.text), "\n  "))
  end
end

-- Computes the task like the study's own workers do.
local function compute(own, list)
  local at, results = 0, {}
  pool.run {
    workers = math.tointeger(os.getenv "SLURM_CPUS_PER_TASK") or 1, cpu = own.cpu, memory = own.memory,
    next = function()
      at = at + 1
      local one = list[at]
      return one and { at = at, text = one.number .. " " .. one.word }
    end,
    begin = function() package.loaded.softworld.remarks = false end,
    answer = function(text)
      local number, word = text:match "^(%d+) (.*)$"
      local values = parameters.values(own.parameters, word)
      local status, rest = evaluation.run(own, math.tointeger(number), values)
      return status .. " " .. rest
    end,
    done = function(one, status, rest)
      if status == "mistake" then status = "failed" end
      local given = list[one.at]
      results[one.at] = { number = given.number, word = given.word, status = status, rest = rest }
    end,
  }
  return results
end

--- If the part is the task's, does the task and ends the process. build(): calls setup.
function node.part(own, name, build)
  local t = own.task
  local d = own.journal.definition
  if d.name ~= t.about.name or d.key ~= t.about.key or name ~= t.about.part then return end
  if not own.file or sends.folder(own.file) ~= t.folder:match "^(.*)/%d+$" then return end
  local list = t.about.tasks[t.number]
  if not list then fail("study '%s': there is no task %d in %s", own.name, t.number - 1, t.folder) end
  if not sends.result(t.folder, t.number, list) then -- else it is done, and runs again
    for _, one in ipairs(list) do
      if not parameters.values(own.parameters, one.word) then
        fail("study '%s': evaluation %d has no values of these parameters", own.name, one.number)
      end
    end
    build(own)
    local results = compute(own, list)
    sends.put(("%s/out.%d"):format(t.folder, t.number - 1), sends.result_text(t.number, results))
  end
  io.stdout:flush()
  os.exit(0)
end

--- Called if the task needs something of another part, which the journal should have.
function node.missing(own, number)
  if not own.file then return end
  fail("study '%s': evaluation %d.%d is not in %s, and this task is for another part", own.name, own.part,
    number, own.file)
end

--- Returns the number of processes that a study without a journal has here.
function node.workers() return math.tointeger(os.getenv "SLURM_CPUS_PER_TASK") or core.processors() end

return node
