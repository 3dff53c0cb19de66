-- SPDX-License-Identifier: GPL-3.0-or-later
-- Workers: whatever happens to a worker costs one evaluation, and no worker is left behind.
local sw = require "softworld"
local program = require "host.program"
local core = sw.core

-- A shell starts background processes with SIGINT ignored.
local NORMAL = "env --default-signal=INT"

local function study(evaluate, changes)
  local args = { name = "s", parameters = { x = { 0, 1 } }, evaluate = evaluate, workers = 2 }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

-- Sends a signal to this process, through the shell.
local function die(signal)
  local file = io.open "/proc/self/stat"
  local pid = file:read "n"
  file:close()
  os.execute(("kill -%s %d"):format(signal, pid))
  local x = 0
  for _ = 1, 1e8 do x = x + 1 end
  return x
end

-- Evaluation 3 does something else; returns its row, and checks that only this one has failed.
local function third(does, changes)
  local s = study(function(p)
    if p.number == 3 then does() end
    return { y = p.x }
  end, changes)
  local rows = s:sweep { count = 8 }
  assert.equal(8, #rows)
  for i, row in ipairs(rows) do assert.equal(i == 3, row.failed ~= nil) end
  return rows[3]
end

describe("a worker", function()
  teardown(program.clean)

  it("that is killed gives one failed evaluation, after a second try", function()
    local row = third(function() die "KILL" end)
    assert.equal("its process ended by signal 9 (killed)", row.failed)
    assert.is_true(row.machine)
  end)

  it("that is killed once from outside repeats the evaluation", function()
    local mark = program.folder() .. "/mark"
    local s = study(function(p)
      if p.number == 3 and not core.kind(mark) then
        io.open(mark, "w"):close()
        die "KILL"
      end
      return { y = p.x }
    end)
    for _, row in ipairs(s:sweep { count = 8 }) do assert.is_nil(row.failed) end
  end)

  it("that crashes gives one failed evaluation", function()
    local row = third(function() die "SEGV" end)
    assert.equal("its process ended by signal 11 (segmentation fault)", row.failed)
    assert.is_nil(row.machine)
  end)

  it("that exits gives one failed evaluation", function()
    assert.equal("evaluate ended its process (exit code 3)", third(function() os.exit(3) end).failed)
  end)

  it("is ended when an evaluation takes too much computing time, and only then", function()
    local row = third(function() while true do end end, { cpu = 0.3 }) -- luacheck: ignore
    assert.equal("took more than 0.3 s of computing time", row.failed)
    assert.is_true(row.machine)
    -- the limit applies to each evaluation, not to their sum
    local s = study(function(p)
      local start = os.clock()
      while os.clock() - start < 0.05 do end -- luacheck: ignore
      return { y = p.x }
    end, { cpu = 0.3 })
    for _, row_of in ipairs(s:sweep { count = 20 }) do assert.is_nil(row_of.failed) end
  end)

  it("that takes too much memory gives one failed evaluation", function()
    local row = third(function()
      local list = {}
      for i = 1, 100 do list[i] = ("x"):rep(10000000) .. i end
      return #list
    end, { memory = 200e6 })
    if os.getenv "SOFTWORLD_PRELOAD" then -- the sanitizer's malloc ends the process
      assert.equal("evaluate ended its process (exit code 1)", row.failed)
      return
    end
    assert.equal("took more than 200000000 B of memory", row.failed)
    assert.is_true(row.machine)
  end)

  it("prints each output of evaluate once", function()
    local out, err, code = program.script [[
local sw = require "softworld"
io.write "before "
local study = sw.study { name = "s", parameters = { x = { 0, 1 } }, workers = 2,
  evaluate = function(p) print("number " .. p.number) return { y = 1 } end }
study:sweep { count = 6 }
print "after"
]]
    assert.equal(0, code, err)
    local _, count = out:gsub("before", "")
    assert.equal(1, count)
    for k = 1, 6 do assert.truthy(out:find("number " .. k .. "\n", 1, true)) end
    assert.truthy(out:find "after\n$")
  end)

  it("does not read the parent's input", function()
    local out, err, code = program.script([[
local sw = require "softworld"
local study = sw.study { name = "s", parameters = { x = { 0, 1 } }, workers = 2,
  evaluate = function() return { y = io.read "a" == "" } end }
print(#study:sweep { count = 4 }, study:table()[1].y, io.read "a")
]], {}, { stdin = "mine" })
    assert.equal(0, code, err)
    assert.equal("4\t1.0\tmine\n", out)
  end)

  it("leaves no process and no file open", function()
    local function open()
      local count = 0
      for _ in io.popen "ls /proc/self/fd":lines() do count = count + 1 end
      return count
    end
    local s = study(function(p) return { y = p.x } end)
    s:sweep { count = 4 }
    local before = open()
    for _ = 1, 20 do s:sweep { count = 4 } end
    assert.equal(before, open())
  end)

  -- The processes that have this name among their arguments.
  local function alive(mark)
    local out = program.shell(("grep -l -a %s /proc/[0-9]*/cmdline 2>/dev/null"):format(mark))
    local list = {}
    for pid in out:gmatch "/proc/(%d+)/cmdline" do
      local file = io.open("/proc/" .. pid .. "/stat")
      local text = file and file:read "a" or ""
      if file then file:close() end
      if text:find "%(softworld%) [^Z]" then list[#list + 1] = pid end
    end
    return list
  end

  local ENDLESS = [[
local sw = require "softworld"
local study = sw.study { name = "endless", file = arg[1], parameters = { x = { 0, 1 } }, workers = 2,
  evaluate = function(p)
    if p.number > 5 then while true do end end
    return { y = p.x }
  end }
study:sweep { count = 100 }
]]

  it("does not outlive its parent, however the parent ends", function()
    local folder = program.folder()
    local script = program.write(folder .. "/outlive.lua", ENDLESS)
    for _, signal in ipairs { "KILL", "TERM", "INT" } do
      local file = folder .. "/" .. signal .. ".study"
      local out = program.shell(([[
%s %s %s %s >/dev/null 2>%s/err & p=$!
n=0
while [ "$(grep -c '^e ' %s 2>/dev/null)" != 5 ] && [ $n -lt 1000 ]; do sleep 0.02; n=$((n+1)); done
sleep 0.1; pgrep -P $p | wc -l; kill -%s $p; wait $p; echo $?
sleep 0.3
]]):format(NORMAL, program.quote(program.path), script, file, folder, file, signal))
      assert.truthy(out:find "^%s*2\n", signal .. ": " .. out) -- there were two
      assert.same({}, alive(file))
      assert.equal(5, select(2, program.read(file):gsub("\ne ", "")))
    end
  end)

  -- Also within this process, where Ctrl-C interrupts an evaluation; this is not a failed evaluation.
  it("ends with Ctrl-C, and the results so far are reported and kept", function()
    local folder = program.folder()
    for _, workers in ipairs { 2, 0 } do
      local file = folder .. "/interrupt" .. workers .. ".study"
      local script = ENDLESS:gsub("workers = 2", "workers = " .. workers)
      local _, err, code = program.script(script, { file }, { before = NORMAL, signals = { 0.2 } })
      assert.equal(130, code, err)
      assert.truthy(err:find("study 'endless' was interrupted; so far:", 1, true), err)
      assert.truthy(err:find("1. sweep: 5 evaluations, 0 failed", 1, true), err)
      assert.same({}, alive(file))
      assert.equal(5, select(2, program.read(file):gsub("\ne ", "")))
    end
  end)

  -- A random call (make fuzz) once ended its program with core.limit_cpu.
  it("alone may use the limit of computing time", function()
    for _, seconds in ipairs { 0.01, -1, 0 / 0 } do
      local fine, why = pcall(core.limit_cpu, seconds)
      assert.is_false(fine)
      assert.truthy(why:find("core.limit_cpu ends its process, and is for workers alone", 1, true), why)
    end
  end)
end)
