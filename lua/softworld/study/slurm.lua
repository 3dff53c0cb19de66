-- SPDX-License-Identifier: GPL-3.0-or-later
--- Calls Slurm's commands: https://slurm.schedmd.com/archive/slurm-22.05.8/ (sbatch, squeue, scancel).
-- @module softworld.study.slurm
local checks = require "softworld.checks"
local core = require "softworld.core"
local sink = require "softworld.output.sink"

local slurm = {}

local COMMANDS = { "sbatch", "squeue", "scancel" }
local OWN = checks.set [[array job-name output error input open-mode parsable wrap wait quiet test-only help
  usage version verbose]]

local function fail(text, ...) error(text:format(...), 0) end

--- Raises an error unless Slurm's commands exist.
function slurm.need(name)
  for _, command in ipairs(COMMANDS) do
    if not sink.run("command -v " .. command .. " >/dev/null") then
      fail("study '%s': on = 'slurm' needs Slurm's commands, and %s is not on the PATH: run the script on "
        .. "the cluster's login node (or apt-get install slurm-client there), or compute on this machine "
        .. "with on = 'here'", name, command)
    end
  end
end

--- Returns options for sbatch, { partition = "short", cpus_per_task = 4 }, as a sorted list of words.
function slurm.options(what, given)
  local words = {}
  for key, value in pairs(given or {}) do
    if type(key) ~= "string" or not key:find "^%a[%w_-]*$" then
      fail("%s: options: %s is not the name of an option of sbatch, such as partition = 'short'", what,
        checks.got(key))
    end
    local name = key:gsub("_", "-")
    if OWN[name] then fail("%s: options: %s is set by the study itself; leave it out", what, key) end
    local kind = type(value)
    if value == true then words[#words + 1] = "--" .. name
    elseif kind == "number" and value == value or kind == "string" and not value:find "%c" then
      words[#words + 1] = ("--%s=%s"):format(name, math.tointeger(value) or value)
    else
      fail("%s: options: %s = %s must be a text on one line, a number or true", what, key, checks.got(value))
    end
  end
  table.sort(words)
  return words
end

-- Returns the words of Slurm's commands without the commands' names, on one line.
local function plain(text)
  text = text:gsub("sbatch: ", ""):gsub("slurm_load[%w_]* ", ""):gsub("error: ", "")
  return (text:gsub("%s+$", ""):gsub("\n", "; "))
end

--- Returns the most tasks of an array. Raises an error if Slurm does not answer.
function slurm.largest(name)
  local fine, text = sink.run "scontrol show config"
  if not fine then fail("study '%s': Slurm does not answer: %s", name, plain(text)) end
  return math.max(1, math.tointeger(text:match "MaxArraySize%s*=%s*(%d+)") or 1001)
end

local function hint(text)
  if not text:find "[Pp]artition" then return "" end
  local fine, names = sink.run "sinfo -h -o %R"
  return fine and "; partitions are: " .. names:gsub("%s+", " "):gsub(" $", "") or ""
end

--- Sends an array of count tasks. Returns the job's number; or nil and why, if there is no room at the
-- moment.
function slurm.send(name, job, script, log, count, options)
  local words = { "sbatch", "--parsable", "--array=0-" .. count - 1, "--job-name=" .. job,
    "--open-mode=append", "--output=" .. log }
  for _, word in ipairs(options) do words[#words + 1] = word end
  words[#words + 1] = script
  for i, word in ipairs(words) do words[i] = sink.quote(word) end
  local fine, text = sink.run(table.concat(words, " "))
  local id = fine and text:match "(%d+)[;%d%w_-]*%s*$"
  if id then return id end
  if text:find "[Ss]ubmit" and text:find "[Ll]imit" or text:find "MaxSubmit" then return nil, plain(text) end
  fail("study '%s': Slurm takes no tasks: %s%s", name, plain(text), hint(text))
end

--- Returns the states of all tasks of jobs with these names: { [name] = { [number within the array] = { state
-- =, reason =, id = } } }; nil and why, if Slurm does not answer.
function slurm.states(names)
  local found = {}
  for _, name in ipairs(names) do found[name] = {} end
  local fine, text = sink.run(("squeue -h -r -t all -n %s -o '%%j|%%K|%%T|%%i|%%r'"):format(
    sink.quote(table.concat(names, ","))))
  if not fine then return nil, plain(text) end
  for line in text:gmatch "[^\n]+" do
    local name, k, state, id, reason = line:match "^([^|]*)|(%d+)|([^|]*)|([^|]*)|(.*)$"
    if name and found[name] then
      found[name][math.tointeger(k)] = { state = state, id = id, reason = reason }
    end
  end
  return found
end

local OVER = checks.set [[COMPLETED FAILED CANCELLED TIMEOUT NODE_FAIL OUT_OF_MEMORY BOOT_FAIL DEADLINE
  REVOKED PREEMPTED SPECIAL_EXIT]]

--- True if a task in this state is over. nil: Slurm does not know it any more.
function slurm.over(state) return state == nil or OVER[state.state] == true end

--- Cancels jobs with these names.
function slurm.cancel(names)
  if #names == 0 then return true end
  for _, name in ipairs(names) do sink.run("scancel -n " .. sink.quote(name)) end
  return true
end

--- Returns a unique name for a job, from the study's name and a text.
function slurm.job(name, text)
  return ("softworld-%s-%016x"):format(name:gsub("[^%w]", "_"):sub(1, 40), core.checksum(text))
end

return slurm
