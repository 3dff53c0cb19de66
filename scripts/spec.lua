-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs the specs with Busted inside the host program.
local usage = [[
usage: build/softworld scripts/spec.lua [options] [path ...]
  path           only spec files whose path contains this text
  --name TEXT    only tests whose full name contains this text
  --list         print the tests, run none
  --measured     show what specs measured, in lines that begin with "measured:"
  --slow [N]     afterwards show the N (10) slowest tests
  --jobs N       spec files at a time (default: processors)
  --timeout S    seconds for one spec file (default 600)
  --child FILE   run one file in this very process and print raw records (for a debugger)
Every spec file runs in a process of its own, so a crash costs one file only. Its output is
shown when something failed in it, and lines that begin with "not tested here:" always. A
pending test counts as failed: nothing passes by being skipped. The last line is "N passed, N failed".]]

local lfs = require "lfs"

-- Places ---------------------------------------------------------------------

local function absolute(path)
  return path:sub(1, 1) == "/" and path or lfs.currentdir() .. "/" .. path
end

local function quote(text) -- one word for sh
  return "'" .. text:gsub("'", "'\\''") .. "'"
end

local function exists(path) return lfs.attributes(path, "mode") ~= nil end

-- Returns the program that runs this script: the host, or stock lua5.4. arg must be set: without it a child
-- would not know that it is a child, and would start children without end.
local function interpreter()
  assert(arg and arg[-1], "the interpreter must set the table 'arg' as lua does")
  local lowest = -1
  while arg[lowest - 1] do lowest = lowest - 1 end
  local program = arg[lowest]
  return program:find("/", 1, true) and absolute(program) or program
end

local this = absolute(debug.getinfo(1, "S").source:sub(2))
local root = this:match("^(.*)/scripts/[^/]*$"):gsub("/%.$", "")
local program = interpreter()
local host = os.getenv "SOFTWORLD_BIN"
  or (program:match "softworld$" and program:find "/" and program)
  or root .. "/build/softworld"
host = absolute(host)
local child = dofile(root .. "/scripts/spec_child.lua")

-- Parent ---------------------------------------------------------------------

local function fail_usage(message)
  io.stderr:write(message, "\n", usage, "\n")
  os.exit(2, true)
end

local function options_of(args)
  local o = { paths = {}, timeout = 600 }
  local i = 1
  local function value(what)
    i = i + 1
    return args[i] or fail_usage(what .. " needs a value")
  end
  local function number(what)
    local n = math.tointeger(tonumber(value(what)))
    return n and n > 0 and n or fail_usage(what .. " needs a number above 0")
  end
  while args[i] do
    local a = args[i]
    if a == "--name" then o.name = value(a)
    elseif a == "--list" then o.list = true
    elseif a == "--measured" then o.measured = true
    elseif a == "--slow" then
      o.slow = 10
      if math.tointeger(tonumber(args[i + 1])) then o.slow = number(a) end
    elseif a == "--jobs" then o.jobs = number(a)
    elseif a == "--timeout" then o.timeout = number(a)
    elseif a == "--child" then o.child = value(a)
    elseif a == "--records" then o.records = value(a) -- given by the parent to its children
    elseif a == "--help" then
      print(usage)
      os.exit(0, true)
    elseif a:sub(1, 1) == "-" then fail_usage("unknown option " .. a)
    else o.paths[#o.paths + 1] = a
    end
    i = i + 1
  end
  return o
end

local function spec_files(paths)
  local found = {}
  local function walk(folder)
    for entry in lfs.dir(folder) do
      local path = folder .. "/" .. entry
      if entry:sub(1, 1) ~= "." then
        if lfs.attributes(path, "mode") == "directory" then walk(path)
        elseif entry:find "_spec%.lua$" then found[#found + 1] = path
        end
      end
    end
  end
  if exists "spec" then walk "spec" end
  table.sort(found)
  if #paths == 0 then return found end
  local chosen = {}
  for _, file in ipairs(found) do
    for _, path in ipairs(paths) do
      local text = path:gsub("^%./", ""):gsub("/+$", "/")
      if (root .. "/" .. file):find(text, 1, true) then
        chosen[#chosen + 1] = file
        break
      end
    end
  end
  return chosen
end

local function read_all(path)
  local f = io.open(path, "rb")
  if not f then return "" end
  local text = f:read "a"
  f:close()
  return text
end

local function first_line(command)
  local pipe = io.popen(command)
  local line = pipe:read "l"
  pipe:close()
  return line
end

-- Runs all files, several at a time. xargs keeps the processors busy; a line "index status start end" comes
-- when a file ends. Calls done(i, status, seconds) in the order of the files.
local function run_files(files, o, folder, done)
  local words = table.concat({ quote(program), quote(this), "--records",
    quote(folder) .. "/$1.records", o.list and "--list" or "",
    o.name and "--name " .. quote(o.name) or "", "--child \"$2\"" }, " ")
  -- --foreground: Ctrl-C must reach the child. -k: kills a child that ignores the first signal.
  local one = ([[s=$(date +%%s.%%N)
timeout --foreground -k 10 %d %s >%s/$1.log 2>&1 </dev/null
echo "$1 $? $s $(date +%%s.%%N)"]]):format(o.timeout, words, quote(folder))
  local queue = assert(io.open(folder .. "/queue", "w"))
  for i, file in ipairs(files) do queue:write(i, "\0", file, "\0") end
  queue:close()
  local pipe = io.popen(("SOFTWORLD_BIN=%s SOFTWORLD_ROOT=%s %sxargs -0 -a %s/queue -n 2 -P %d sh -c %s sh")
    :format(quote(host), quote(root), o.measured and "SOFTWORLD_MEASURED=1 " or "", quote(folder), o.jobs,
      quote(one)))
  local ended, next_one = {}, 1
  local function advance(all)
    while next_one <= #files and (ended[next_one] or all) do
      local e = ended[next_one] or { status = "never started", seconds = 0 }
      done(next_one, e.status, e.seconds)
      next_one = next_one + 1
    end
  end
  for line in pipe:lines() do
    local i, status, from, to = line:match "^(%d+) (%d+) (%S+) (%S+)$"
    if i then
      ended[tonumber(i)] = { status = tonumber(status), seconds = tonumber(to) - tonumber(from) }
      advance()
    end
  end
  pipe:close()
  advance(true)
end

local signals = { [4] = "illegal instruction", [6] = "abort", [7] = "bus error",
  [8] = "arithmetic exception", [9] = "killed", [11] = "segmentation fault", [15] = "terminated" }

local function how_it_ended(status, timeout)
  if status == 124 or status == 137 then return ("took longer than %d s or was killed"):format(timeout) end
  if type(status) ~= "number" then return status end
  if status > 128 then
    return ("crashed: signal %d (%s)"):format(status - 128, signals[status - 128] or "?")
  end
  return "ended with exit status " .. status
end

-- Returns the records of one child as { passed, tests = { { name, where, seconds } }, failures }.
local function result_of(path, file, status, o)
  local r = { passed = 0, tests = {}, failures = {} }
  local running, finished
  local function failure(where, name, message)
    r.failures[#r.failures + 1] = { where = where, name = name, message = message }
  end
  for line in read_all(path):gmatch "([^\n]*)\n" do
    local f = {}
    for field in (line .. "\t"):gmatch "([^\t]*)\t" do f[#f + 1] = child.unescape(field) end
    local kind, where, name = f[1], f[2], f[3]
    if kind == "start" then running = { where = where, name = name }
    elseif kind == "pass" then
      r.passed, running = r.passed + 1, nil
      r.tests[#r.tests + 1] = { name = name, where = where, seconds = tonumber(f[4]) }
    elseif kind == "fail" then
      running = nil
      r.tests[#r.tests + 1] = { name = name, where = where, seconds = tonumber(f[5]) }
      failure(where, name, f[4])
    elseif kind == "test" then r.tests[#r.tests + 1] = { name = name, where = where, seconds = 0 }
    elseif kind == "end" then finished = true
    end
  end
  if not finished then
    local at = running or { where = file, name = "(no test running)" }
    failure(at.where, at.name, "the spec file " .. how_it_ended(status, o.timeout)
      .. " before all its tests had run" .. (status == 0 and "; does it call os.exit?" or ""))
  elseif status ~= 0 then
    failure(file, "(after the last test)", "the process " .. how_it_ended(status, o.timeout))
  elseif #r.tests == 0 and #r.failures == 0 and not o.name then
    failure(file, "(whole file)", "holds no test")
  end
  return r
end

local function indent(text) return "    " .. text:gsub("\n+$", ""):gsub("\n", "\n    ") end

local function show_failures(r, log)
  for _, f in ipairs(r.failures) do
    local where, message = f.where, f.message
    -- A message starts with its own position. If that is in the spec, it is more precise: use it.
    local at, rest = message:match "^([^\n:]+_spec%.lua:%d+): (.*)$"
    if at then
      if at:sub(1, #root + 1) == root .. "/" then at = at:sub(#root + 2) end
      where, message = at, rest
    end
    print(("  FAIL %s: %s\n%s"):format(where, f.name, indent(message)))
  end
  local lines = {}
  for line in log:gmatch "[^\n]+" do lines[#lines + 1] = line end
  if #lines == 0 then return end
  local skipped = math.max(0, #lines - 60)
  print("  its output" .. (skipped > 0 and (" (last 60 of %d lines):"):format(#lines) or ":"))
  print(indent(table.concat(lines, "\n", skipped + 1)))
end

local function show_slowest(tests, count)
  table.sort(tests, function(a, b) return a.seconds > b.seconds end)
  print "slowest tests:"
  for i = 1, math.min(count, #tests) do
    print(("  %8.3f s  %s: %s"):format(tests[i].seconds, tests[i].where, tests[i].name))
  end
end

local function run_all(o)
  local files = spec_files(o.paths)
  local folder = first_line "mktemp -d"
  o.jobs = o.jobs or tonumber(first_line "nproc") or 1
  local width = 0
  for _, file in ipairs(files) do width = math.max(width, #file) end

  local passed, failed, tests = 0, 0, {}
  run_files(files, o, folder, function(i, status, seconds)
    local base = folder .. "/" .. i
    local r = result_of(base .. ".records", files[i], status, o)
    passed, failed = passed + r.passed, failed + #r.failures
    table.move(r.tests, 1, #r.tests, #tests + 1, tests)
    if o.list then
      for _, t in ipairs(r.tests) do print(t.where .. ": " .. t.name) end
    elseif #r.tests + #r.failures > 0 then
      print(("%-" .. width .. "s  %4d passed, %d failed %8.2f s"):format(files[i], r.passed,
        #r.failures, seconds))
    end
    local log = read_all(base .. ".log")
    for line in log:gmatch "[^\n]+" do
      if line:find "^not tested here:" or o.measured and line:find "^measured:" then print("  " .. line) end
    end
    if #r.failures > 0 then show_failures(r, log) end
    io.stdout:flush()
  end)
  os.execute("rm -rf " .. quote(folder))

  if #tests == 0 and failed == 0 then
    print "no test was found: check the paths and --name"
    failed = 1
  end
  if o.slow then show_slowest(tests, o.slow) end
  if not o.list then print(("%d passed, %d failed"):format(passed, failed)) end
  io.stdout:flush()
  return failed == 0
end

local o = options_of(arg)
assert(lfs.chdir(root))
if o.child then
  local sink = o.records and assert(io.open(o.records, "w")) or io.stdout
  child.run(o.child, sink, o.name, o.list, root, host)
  if o.records then sink:close() end
else
  os.exit(run_all(o), true)
end
