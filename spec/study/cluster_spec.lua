-- SPDX-License-Identifier: GPL-3.0-or-later
-- A study's tasks on a real Slurm of this machine: whatever happens to them, the table equals the one
-- computed locally.
local one_cluster = require "study.one_cluster"
local program = require "host.program"

-- Arguments: the journal, the duration of an evaluation [s], the number of tasks, detach, what happens to
-- some tasks ("held": all wait for the file journal.go).
local SCRIPT = [[
local sw = require "softworld"
local study = sw.study { name = "lot", file = arg[1], seed = 7, on = "ON", workers = 2,
  parameters = { height = { 0.02, 0.2, unit = "m" }, kind = { choices = { "few", "many" } } },
  setup = function() return { 2 } end,
  evaluate = function(p, given)
    local noted = io.open(arg[1] .. ".noted", "a")
    noted:write(p.number, "\n")
    noted:close()
    if p.random() < 0.1 then error("lost by chance", 0) end
    os.execute((arg[5] ~= "held" or not os.getenv "SOFTWORLD_TASK") and "sleep " .. arg[2]
      or ("for i in $(seq 600); do [ -e %s.go ] || sleep 0.1; done"):format(arg[1]))
    local file, mark = io.open "/proc/self/stat", arg[1] .. ".mark." .. p.number
    local parent = file:read("a"):match "^%d+ %b() %u (%d+)"
    file:close()
    if os.getenv "SOFTWORLD_TASK" and (arg[5] == "always" and p.number == 9
      or arg[5] == "once" and p.number == 7 and not io.open(mark)) then
      io.open(mark, "w"):close()
      os.execute("kill -KILL " .. parent) -- of the task itself: this is one of its workers
      os.execute "sleep 1"
    end
    return { force = p.height * given[1], luck = math.random() }
  end,
  constraints = { force = { max = 0.3 } } }
study:run { on = "ON", tasks = tonumber(arg[3]), detach = arg[4] == "detach", options = OPTIONS }
study:sweep { kind = "latin", count = 40 }
study:spread { count = 12 }
study:csv(arg[1] .. ".csv")
print(study.computed)
]]

local slurm, expected

local function script_in(folder, on, options)
  local text = SCRIPT:gsub('"ON"', on):gsub("OPTIONS", options or "nil")
  return program.write(folder .. "/script.lua", text)
end

-- A script with its journal in its own folder: returns the command to run it, and the journal.
local function case(options, on)
  local folder = program.folder()
  local script = script_in(folder, on or '"slurm"', options)
  local journal = folder .. "/lot.study"
  return { folder = folder, journal = journal, command = function(wait, tasks, detach, what)
    return ("%s timeout 100 %s %s %s %s %d %s %s"):format(slurm and slurm.env or "",
      program.quote(program.path), script, journal, wait or "0", tasks or 4, detach or "-", what or "-")
  end }
end

local function same(c)
  assert.is_true(expected == program.read(c.journal .. ".csv"), "another table")
  assert.is_nil(io.open(c.journal .. ".tasks/1/list"), "what was sent is still there")
end

-- How often each evaluation was started.
local function noted(c)
  local counts = {}
  for line in io.lines(c.journal .. ".noted") do counts[line] = (counts[line] or 0) + 1 end
  return counts
end

-- Runs a command in the background; calls meanwhile(number of the first job, process) once the job is sent.
local function during(c, command, meanwhile, word)
  local out = c.folder .. "/out"
  program.shell((": >%s.err; %s >%s 2>%s.err & echo $! >%s.pid"):format(out, command, out, out, out))
  local id = one_cluster.waited(function()
    return program.read(out .. ".err"):match(word or "sent to Slurm, jobs? (%d+)")
  end, 300)
  assert(id, program.read(out .. ".err"))
  meanwhile(id, program.read(out .. ".pid"):match "%d+")
  one_cluster.waited(function()
    return select(3, program.shell(("kill -0 $(cat %s.pid) 2>/dev/null"):format(out))) ~= 0
  end, 1000)
  return program.read(out), program.read(out .. ".err")
end

local function until_empty()
  if one_cluster.waited(function() return slurm:ask "squeue -h" == "" end, 600) then return end
  error("tasks do not end: " .. slurm:ask "squeue")
end

describe("a study on a cluster", function()
  setup(function()
    local here = case(nil, '"here"')
    local _, err, code = program.shell(here.command())
    assert.equal(0, code, err)
    expected = program.read(here.journal .. ".csv")
    assert.truthy(expected:find("lost by chance", 1, true))
    slurm = one_cluster.start()
  end)

  teardown(function()
    if slurm then slurm:stop() end
    program.clean()
  end)

  it("gives the same table as a local study, also with more tasks than an array may have", function()
    local c = case()
    local out, err, code = program.shell(c.command("0", 4))
    assert.equal(0, code, err)
    assert.equal("52\n", out)
    assert.truthy(err:find("study 'lot': 4 tasks sent to Slurm, job %d+\n"), err)
    same(c)
    assert.equal(select(2, expected:gsub("lost by chance", "")), 6)
    -- the second time nothing is sent
    out, err, code = program.shell(c.command("0", 4))
    assert.equal("0\n0", out .. code)
    assert.equal("", err)
    c = case "{ cpus_per_task = 2, time = '1' }"
    out, err, code = program.shell(c.command("0", 13)) -- arrays have at most 11 tasks here
    assert.equal("52\n0", out .. code, err)
    assert.truthy(err:find("13 tasks sent to Slurm, jobs %d+ %d+\n"), err)
    same(c)
  end)

  it("recomputes the evaluations of a cancelled task and of a requeued one", function()
    local c = case()
    -- The tasks are held until both are done: on a busy machine they would have ended before.
    local _, err = during(c, c.command("0", 4, nil, "held"), function(id)
      assert.is_true(one_cluster.waited(function()
        return select(2, slurm:ask("squeue -h -r -o %T"):gsub("RUNNING", "")) == 4
      end, 600))
      slurm:ask("scancel " .. id .. "_2")
      slurm:ask("scontrol requeue " .. id .. "_1")
      program.write(c.journal .. ".go", "")
    end)
    assert.truthy(err:find("task 2 of job %d+: CANCELLED.*; sent again: 10 evaluations\n"), err)
    same(c)
  end)

  it("recomputes the evaluations of a killed task; after three times they have failed", function()
    local c = case()
    local out, err = program.shell(c.command("0.01", 4, nil, "once"))
    assert.equal("52\n", out, err)
    assert.truthy(err:find("sent again: 10 evaluations\n", 1, true), err)
    same(c)
    c = case()
    out, err = program.shell(c.command("0.01", 4, nil, "always"))
    assert.equal("52\n", out, err)
    assert.truthy(err:find("given up: 1 evaluation\n", 1, true), err)
    program.read(assert(err:match "logs of tasks are in (%S+)") .. "/log.0") -- the log exists
    local before, now = {}, {}
    for line in expected:gmatch "[^\n]+" do before[#before + 1] = line end
    for line in program.read(c.journal .. ".csv"):gmatch "[^\n]+" do now[#now + 1] = line end
    assert.equal(#before, #now)
    for i, line in ipairs(now) do
      if i == 10 then
        assert.truthy(line:find("lost 3 times on the cluster; the last: task %d of job %d+: FAILED"), line)
      else
        assert.equal(before[i], line)
      end
    end
    -- a failure of the machine is not a result of the model: it is tried again the next time
    out = program.shell(c.command("0", 4))
    assert.equal("1\n", out)
    assert.is_true(expected == program.read(c.journal .. ".csv"))
  end)

  it("leaves its tasks to the cluster, and collects them in another shell, also when results are "
    .. "lost", function()
    local c = case()
    local _, err, code = program.shell(c.command("0.02", 4, "detach"))
    assert.equal(1, code)
    assert.truthy(err:find("script.lua:25: study 'lot': 4 tasks left to Slurm, job %d+; run the script"),
      err)
    until_empty()
    os.remove(c.journal .. ".tasks/1/out.1")
    local path = c.journal .. ".tasks/1/out.2"
    program.write(path, program.read(path):sub(1, -30))
    _, err, code = program.shell("cd /; " .. c.command("0.02", 4))
    assert.equal(0, code, err)
    assert.truthy(err:find("task 1 of job %d+: ended without a result; sent again: 10 evaluations"), err)
    assert.truthy(err:find("task 2 of job %d+: ended without a result; sent again: 10 evaluations"), err)
    assert.is_nil(err:find("4 tasks sent to Slurm, job 1\n", 1, true))
    same(c)
  end)

  it("continues after its parent was killed, and computes nothing twice", function()
    local c = case()
    during(c, c.command("0.1", 4), function(_, pid) program.shell("kill -KILL $(pgrep -P " .. pid .. ")") end)
    local out, err, code = program.shell(c.command("0.1", 4))
    assert.equal(0, code, err)
    assert.equal("51\n", out) -- the first part was computed before
    same(c)
    for number, count in pairs(noted(c)) do
      assert.equal(tonumber(number) <= 12 and 2 or 1, count, number) -- once in the sweep, once in the spread
    end
  end)

  it("reports and removes its jobs when it is computed locally; the table is the same", function()
    for _, wait in ipairs { "0", "3" } do -- tasks that have ended, and tasks that would take 15 s
      local c = case(nil, "os.getenv 'WHERE'")
      program.shell((c.command(wait, 4, "detach"):gsub("^env", "env WHERE=slurm")))
      if wait == "0" then until_empty() end
      assert.equal(wait == "3", slurm:ask "squeue -h -t pending,running" ~= "")
      local out, err, code = program.shell((c.command("0", 4, "detach"):gsub("^env", "env WHERE=here")))
      assert.equal("51\n0", out .. code, err)
      assert.truthy(err:find("study 'lot': 1 job of it on a cluster: on = 'slurm' collects", 1, true), err)
      assert.equal("", slurm:ask "squeue -h -t pending,running")
      assert.equal("", program.shell(("ls -d %s.tasks 2>/dev/null"):format(c.journal)))
      same(c)
      until_empty()
    end
  end)

  it("waits for a drained node, and says so", function()
    local host = slurm:ask("sinfo -h -N -o %N"):match "%S+"
    slurm:ask(("scontrol update nodename=%s state=drain reason=spec"):format(host))
    local c = case()
    local out, err = during(c, c.command("0", 4), function()
      slurm:ask(("scontrol update nodename=%s state=resume"):format(host))
    end, "all tasks wait, for: ([^\n]+)")
    assert.equal("52\n", out, err)
    same(c)
  end)

  it("can be cancelled from another process", function()
    local c = case()
    local canceller = program.write(c.folder .. "/cancel.lua", [[
local sw = require "softworld"
local study = sw.study { name = "lot", file = arg[1], parameters = { x = { 0, 1 } }, evaluate = print }
print(study:cancel(), study:cancel())
]])
    local said
    local _, err = during(c, c.command("3", 4), function()
      said = program.shell(("%s %s %s %s 2>/dev/null"):format(slurm.env, program.path, canceller, c.journal))
    end)
    assert.equal("4\t0\n", said)
    assert.truthy(err:find("script.lua:25: study 'lot' was cancelled; run the script again", 1, true), err)
    until_empty()
    _, err = program.shell(c.command("0", 4))
    assert.equal(2, select(2, err:gsub("4 tasks sent", "")), err)
    same(c)
  end)

  it("ends its tasks with Ctrl-C when there is no terminal to ask", function()
    local c = case()
    local _, err = during(c, "env --default-signal=INT " .. c.command("3", 4), function(_, pid)
      program.shell("kill -INT $(pgrep -P " .. pid .. ")")
    end)
    assert.truthy(err:find("study 'lot': 4 tasks cancelled (job ", 1, true), err)
    assert.truthy(err:find("study 'lot' was interrupted; so far:", 1, true), err)
    until_empty()
  end)

  it("belongs to one process at a time", function()
    local c = case()
    local second
    local out, err = during(c, c.command("0.1", 4), function()
      second = select(2, program.shell(c.command("0.1", 4)))
    end)
    assert.truthy(second:find("study 'lot': process .* already works with its journal; let it end first"),
      second)
    assert.equal("52\n", out, err)
    same(c)
  end)

  it("sends rounds of a search when that is worth it, and computes the others locally", function()
    local folder = program.folder()
    local script = program.write(folder .. "/search.lua", [[
local sw = require "softworld"
local study = sw.study { name = "search", file = arg[1], on = arg[2], workers = 1,
  parameters = { a = { -2, 2 }, b = { -1, 3, start = 2 } },
  evaluate = function(p) return { y = (p.b - p.a ^ 2) ^ 2 + (1 - p.a) ^ 2, luck = p.random() } end }
study:run { on = arg[2], seconds = tonumber(arg[3]) }
study:minimise("y", { evaluations = 12, starts = 4 })
study:csv(arg[1] .. ".csv")
]])
    local function table_of(on, seconds)
      local path = folder .. "/" .. on .. seconds
      local _, err, code = program.shell(("%s %s %s %s %s %s"):format(slurm.env, program.quote(program.path),
        script, path, on, seconds))
      assert.equal(0, code, err)
      return program.read(path .. ".csv"), select(2, err:gsub("sent to Slurm", ""))
    end
    local here = table_of("here", "1")
    local there, count = table_of("slurm", "30")
    assert.is_true(here == there)
    assert.equal(0, count)
    there, count = table_of("slurm", "1e-7")
    assert.is_true(here == there)
    assert.is_true(count >= 2 and count <= 4)
  end)

  it("computes the example, with the same output", function()
    local folder = program.folder()
    local path = program.quote(program.path) .. " examples/23_cluster.lua"
    local here = program.shell(path)
    local there = ("%s SOFTWORLD_ON=slurm %s %s/plug.study"):format(slurm.env, path, folder)
    local out, err, code = program.shell(there)
    assert.equal(0, code, err)
    assert.equal(here, out)
    assert.truthy(here:find "^within reach in ")
    assert.truthy(err:find("4 tasks sent to Slurm", 1, true), err)
  end)

  it("reports mistakes in the script before it sends anything", function()
    local _, err, code = program.script([[
local sw = require "softworld"
local study = sw.study { name = "s", file = arg[1], parameters = { x = { 0, 1 } }, on = "slurm",
  evaluate = function(p) return p.x end }
study:sweep { count = 5 }
]], { program.folder() .. "/s.study" }, { before = slurm.env })
    assert.equal(1, code)
    local told = "script.lua:3: evaluate returned 0.5; it must return a table of results"
    assert.truthy(err:find(told, 1, true), err)
    assert.is_nil(err:find "sent")
  end)

  it("needs a script in a file that reaches the same part on the nodes", function()
    local journal = program.folder() .. "/s.study"
    local text = ([[
local sw = require "softworld"
if os.getenv "SOFTWORLD_TASK" then print "I stop" os.exit(0) end
local study = sw.study { name = "s", file = "%s", parameters = { x = { 0, 1 } }, on = "slurm",
  evaluate = function(p) return { y = p.x } end }
print(study:sweep { count = 2 }[2].failed)
]]):format(journal)
    local _, err = program.run({ "-e", text }, { before = slurm.env })
    local told = "study 's': on = 'slurm' needs a script in a file, because the nodes run it too"
    assert.truthy(err:find(told, 1, true), err)
    _, err = program.run({ "-" }, { before = slurm.env, stdin = text })
    assert.truthy(err:find(told, 1, true), err)
    local out
    out, err = program.script(text, {}, { before = slurm.env })
    assert.truthy(out:find("^lost 3 times on the cluster; the last: task 0 of job %d+: ended without a "
      .. "result, its log ends with: I stop\n"), out .. err)
    local folder = err:match "logs of tasks are in (%S+)"
    assert.equal("I stop\n", program.read(folder .. "/log.0"))
  end)

  it("reports a wrong partition, and lists the existing ones", function()
    local c = case "{ partition = 'mian' }"
    local _, err, code = program.shell(c.command())
    assert.equal(1, code)
    assert.truthy(err:find("script.lua:25: study 'lot': Slurm takes no tasks: invalid partition specified: "
      .. "mian", 1, true), err)
    assert.truthy(err:find("; partitions are: main\n", 1, true), err)
    assert.is_nil(io.open(c.journal .. ".tasks/1/list"))
  end)

  it("says what to do without Slurm", function()
    local bin = program.folder()
    program.shell(("for f in sh cat ls rm mkdir; do ln -s $(command -v $f) %s/$f; done"):format(bin))
    local c = case()
    local path = program.shell("readlink -f " .. program.quote(program.path)):match "[^\n]+"
    local _, err, code = program.shell(("PATH=%s %s %s/script.lua %s 0"):format(bin, path, c.folder,
      c.journal))
    assert.equal(1, code)
    assert.truthy(err:find("script.lua:25: study 'lot': on = 'slurm' needs Slurm's commands, and sbatch is "
      .. "not on the PATH: run the script on the cluster's login node", 1, true), err)
    local conf = program.read(slurm.folder .. "/slurm.conf"):gsub("SlurmctldPort=%d+", "SlurmctldPort=1")
    program.write(c.folder .. "/slurm.conf", conf)
    conf = "SLURM_CONF=" .. c.folder .. "/slurm.conf"
    _, err, code = program.shell((c.command():gsub("SLURM_CONF=%S+", conf)))
    assert.equal(1, code)
    assert.truthy(err:find("study 'lot': Slurm does not answer: Unable to contact", 1, true), err)
  end)

  it("waits while Slurm does not answer", function()
    local c = case()
    local pid = slurm:ask("cat " .. slurm.folder .. "/slurmctld.pid"):match "%d+"
    local out, err = during(c, c.command("0.1", 4), function()
      program.shell("kill " .. pid)
      for _ = 1, 200 do
        if program.read(c.folder .. "/out.err"):find "does not answer" then break end
        program.shell "sleep 0.1"
      end
      program.shell(("PATH=$PATH:/usr/sbin; slurmctld -f %s/slurm.conf"):format(slurm.folder))
    end)
    assert.equal("52\n", out, err)
    assert.truthy(err:find("study 'lot': Slurm does not answer (", 1, true), err)
    same(c)
  end)

  it("does not accept a task of another script", function()
    local c = case()
    program.shell(c.command("0", 4, "detach") .. "; true")
    until_empty()
    local script = c.folder .. "/script.lua"
    program.write(script, (program.read(script):gsub("seed = 7", "seed = 8")))
    local _, err, code = program.shell(c.command("0", 4))
    assert.equal(0, code, err)
    assert.truthy(err:find("1 job of another definition of it left on the cluster", 1, true), err)
    assert.is_false(expected == program.read(c.journal .. ".csv"))
  end)
end)
