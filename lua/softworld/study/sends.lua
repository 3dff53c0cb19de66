-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a study sends to a cluster: files in a folder beside its journal that all nodes see. Each job
-- array has a folder of its own:
--
--     grip.study.tasks/3/list      which evaluations each of its tasks is to do, lines as in a journal
--     grip.study.tasks/3/job.sh    what Slurm runs
--     grip.study.tasks/3/id        the job's number, once Slurm has given one
--     grip.study.tasks/3/out.0     what task 0 found
--     grip.study.tasks/3/log.0     what task 0 wrote to its standard output and error
--
-- Every file is written under another name and renamed, and nothing is locked: on shared file systems locks
-- may hold for one machine only. A result counts if all lines of its task are there, each with a correct sum.
-- @module softworld.study.sends
local core = require "softworld.core"
local journal = require "softworld.study.journal"
local sink = require "softworld.output.sink"

local sends = {}

local FIRST = "softworld tasks 1"

local function fail(text, ...) error(text:format(...), 0) end

local function first_line(path)
  local file = io.open(path)
  local line = file and file:read "l"
  if file then file:close() end
  return line
end

--- Returns this machine's name and this process's number as one word.
function sends.who()
  local stat = first_line "/proc/self/stat" or "0"
  return (first_line "/proc/sys/kernel/hostname" or "?"):gsub("[^%w.-]", "_") .. "." .. stat:match "^%d+"
end

--- Writes a file under a temporary name and renames it.
function sends.put(path, text)
  local aside = path .. "." .. sends.who()
  local file, why = io.open(aside, "wb")
  if not file then fail("cannot write %s: %s", aside, why) end
  local fine, problem = file:write(text)
  local closed, last = file:close()
  if not fine or not closed then
    os.remove(aside)
    fail("cannot write %s: %s", path, problem or last)
  end
  core.sync(aside)
  fine, problem = os.rename(aside, path)
  if not fine then fail("cannot write %s: %s", path, problem) end
end

--- Returns the folder of everything that a study with this journal has sent.
function sends.folder(file) return file .. ".tasks" end

--- Returns the text of a file, or nil if there is none.
function sends.text(path)
  local fine, text = pcall(sink.read_file, path)
  return fine and text or nil
end

--- Returns the numbers of sends that still exist.
function sends.numbers(file)
  local list, folder = {}, sends.folder(file)
  if core.kind(folder) ~= "folder" then return list end
  local _, text = sink.run("ls -1 " .. sink.quote(folder .. "/"))
  for line in text:gmatch "[^\n]+" do
    if line:find "^%d+$" then list[#list + 1] = math.tointeger(line) end
  end
  table.sort(list)
  return list
end

-- Returns an iterator over lines with correct sums: body, and part and number of lines about evaluations.
local function lines(text)
  local at = 1
  return function()
    local after, kind, part, number = core.journal_line(text, at)
    if not after then return nil end
    local body = kind and text:sub(at, after - 19) or ""
    at = after
    return body, part, number
  end
end

--- Writes what is to be sent: tasks, lists of { number =, word =, tries = }. about: name, key, text, part
-- and the job's name.
function sends.write(folder, about, tasks)
  local texts = { journal.summed(FIRST), journal.summed(("s %s %s %s"):format(journal.quoted(about.name),
    about.key, journal.quoted(about.text))), journal.summed("p " .. journal.quoted(about.part)),
    journal.summed("j " .. about.job) }
  for k, list in ipairs(tasks) do
    for _, task in ipairs(list) do
      texts[#texts + 1] = journal.summed(("e %d %d %d %s"):format(k, task.number, task.tries, task.word))
    end
  end
  texts[#texts + 1] = journal.summed(("z %d"):format(#tasks))
  sink.make_folder(folder)
  sends.put(folder .. "/list", table.concat(texts))
end

--- Returns what a folder is about: name, key, text, part, job, tasks (lists of { number =, word =, tries =
-- }); with `only` just this task. nil if the list is not whole.
function sends.read(folder, only)
  local text = sends.text(folder .. "/list")
  if not text then return nil end
  local about, whole = { tasks = {} }, false
  for body, k, number in lines(text) do
    if k and k > 0 and (not only or k == only) then
      local tries, word = body:match "^e %d+ %d+ (%d+) (%S+)$"
      about.tasks[k] = about.tasks[k] or {}
      table.insert(about.tasks[k], { number = number, word = word, tries = math.tointeger(tries) })
    elseif body:find "^s " then
      local name, key, definition = body:match '^s "([^"]*)" (%x+) "([^"]*)"$'
      about.name, about.key, about.text = journal.unquoted(name), key, journal.unquoted(definition)
    elseif body:find "^p " then
      about.part = journal.unquoted(body:match '^p "([^"]*)"$')
    elseif body:find "^j " then
      about.job = body:match "^j (%S+)$"
    elseif body:find "^z " then
      about.count, whole = math.tointeger(body:match "^z (%d+)$"), true
    end
  end
  return whole and about.part and about.key and about.job and about or nil
end

--- Returns what a task found, as text: lines { number =, word =, status =, rest = }.
function sends.result_text(k, list)
  local texts = {}
  for i, r in ipairs(list) do
    texts[i] = journal.summed(journal.body(k, r.number, r.word, r.status, r.rest))
  end
  texts[#texts + 1] = journal.summed(("z %d"):format(#list))
  return table.concat(texts)
end

--- Reads this text back: a list; nil if there is no file; false if it is not whole, or of another
-- task.
function sends.result(folder, k, wanted)
  local text = sends.text(("%s/out.%d"):format(folder, k - 1))
  if not text then return nil end
  local list, count = {}, nil
  for body, part, number in lines(text) do
    local word, status, rest = journal.parse(body)
    if word and part == k then
      list[#list + 1] = { number = number, word = word, status = status, rest = rest }
    end
    count = math.tointeger(body:match "^z (%d+)$") or count
  end
  if count ~= #list or #list ~= #wanted then return false end
  for i, r in ipairs(list) do
    if r.number ~= wanted[i].number or r.word ~= wanted[i].word then return false end
  end
  return list
end

--- Returns the numbers of tasks in a folder that have written a result, as keys of a table.
function sends.finished(folder)
  local set = {}
  local _, text = sink.run("ls -1 " .. sink.quote(folder .. "/"))
  for k in text:gmatch "[^\n]*" do
    k = k:match "^out%.(%d+)$"
    if k then set[1 + math.tointeger(k)] = true end
  end
  return set
end

--- Returns the last words in a task's log, or nil.
function sends.words(folder, k)
  local text = sends.text(("%s/log.%d"):format(folder, k - 1)) or ""
  return text:sub(-2000):gsub("%s+$", ""):match "[^\n]+$"
end

--- Removes everything in a folder except its logs.
function sends.forget(folder)
  sends.put(folder .. "/kept", "logs of tasks that were lost; nothing needs them\n")
  sink.run(("cd %s && rm -f list job.sh id cancelled out.*"):format(sink.quote(folder)))
end

--- Removes a folder with its files.
function sends.remove(folder)
  local files = "list list.* job.sh job.sh.* id id.* kept cancelled cancelled.* out.* log.*"
  sink.run(("cd %s && rm -f %s"):format(sink.quote(folder), files))
  os.remove(folder)
end

return sends
