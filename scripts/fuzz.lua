-- SPDX-License-Identifier: GPL-3.0-or-later
-- Makes random calls of all functions that scripts can call: plausible calls and hostile ones.
local usage = [[
usage: build/softworld scripts/fuzz.lua [option=value ...]
  seed=1         the first seed; every seed is a case of its own, the same every time
  calls=2e4      how many calls in all
  per=150        calls of one case
  cpu=30         seconds of processor time that a case may take
  slow=6         seconds that one call may take
  out=FOLDER     where failing cases are written (default: out/fuzz)
  replay=FILE    do the calls of a file again and tell what is found
  shrink=0       leave failing cases as long as they are
  reach=1        tell in the end how often each method was called, and how often without an error
Every case runs in a process of its own. A failing one is made shorter by leaving out calls, and
printed. The last line is "N calls, M findings"; the exit status is 1 when there are any.]]

local has_lfs, lfs = pcall(require, "lfs")
if not has_lfs then
  io.stderr:write "fuzz: lua-filesystem is missing; sh scripts/test.sh installs what tests need\n"
  os.exit(1)
end

local options = { seed = 1, calls = 2e4, per = 150, cpu = 30, slow = 6, shrink = 1, tries = 150 }
for _, word in ipairs(arg) do
  local key, value = word:match "^(%w+)=(.*)$"
  if not key then
    print(usage)
    os.exit(word == "help" or word == "--help")
  end
  options[key] = tonumber(value) or value
end

local function absolute(path)
  return path:sub(1, 1) == "/" and path or lfs.currentdir() .. "/" .. path
end

local function quote(text) return "'" .. text:gsub("'", "'\\''") .. "'" end

local this = absolute(debug.getinfo(1, "S").source:sub(2))
local root = this:match "^(.*)/scripts/[^/]*$"
local program = absolute(arg[-1])
package.path = ("%s/lua/?.lua;%s/lua/?/init.lua;%s/spec/?.lua;"):format(root, root, root) .. package.path

-- --- cases as text ----------------------------------------------------------------------

-- In a file, empty lines separate the calls.
local function to_text(calls) return table.concat(calls, "\n\n") .. "\n" end

local function from_text(text)
  local calls = {}
  for call in (text .. "\n\n"):gmatch "(.-)\n\n+" do
    if call:find "%S" and not call:find "^%-%-" then calls[#calls + 1] = call end
  end
  return calls
end

local function read(path)
  local file = io.open(path, "rb")
  if not file then return "" end
  local text = file:read "a"
  file:close()
  return text
end

local function write(path, text)
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
end

-- --- in the child: one case -------------------------------------------------------------

-- Runs a case. Writes each call before it is made, and each finding at once.
local function child(files)
  local case = require "fuzz.case"
  local log, found = assert(io.open(files .. "/log", "wb")), assert(io.open(files .. "/found", "wb"))
  local write_to, flush = log.write, log.flush -- a case may change io
  local doing = { files = files, slow = options.slow }
  function doing.log(text)
    write_to(log, text, "\n\n")
    flush(log)
  end
  function doing.report(kind, text)
    write_to(found, kind, " ", (text:gsub("[\r\n]", " ")), "\n")
    flush(found)
  end
  local reach = options.reach and require "fuzz.reach"
  if reach then reach.begin() end
  if options.replay then case.replay(from_text(read(options.replay)), doing)
  else case.run(options.seed, options.per, doing) end
  if reach then write(files .. "/reach", reach.text()) end
  write_to(found, "end\n")
  flush(found)
  -- close the state, so that checks at the program's end (sanitizers) see what is left
  os.exit(true, true)
end

-- --- in the parent ------------------------------------------------------------------------

local place = os.tmpname()
os.remove(place)
lfs.mkdir(place)

local function empty(folder)
  for name in lfs.dir(folder) do
    if name ~= "." and name ~= ".." then
      local path = folder .. "/" .. name
      if lfs.attributes(path, "mode") == "directory" then empty(path) lfs.rmdir(path) else os.remove(path) end
    end
  end
end

-- Returns a finding's text without numbers and names, to tell different findings apart.
local function signature(text)
  text = text:gsub(", in: .*", "")
  local inside = text:match "placed in the library: .-softworld/([%w_/]+%.lua:%d+)"
  if inside then return "error placed in the library: " .. inside end
  text = text:gsub("'[^']*'", "'*'"):gsub("\"[^\"]*\"", "'*'"):gsub("v%[%d+%]", "v"):gsub("0x%x+", "#")
  return (text:gsub("%-?%d+%.?%d*[eE]?[-+]?%d*", "#"):sub(1, 120)) -- one finding of each kind is enough
end

local function crash(why, code)
  local out = read(place .. "/out")
  local told = out:match "SUMMARY: ([^\n]*)" or out:match "([^\n]*runtime error[^\n]*)"
    or out:match "([^\n]*[Aa]ssertion[^\n]*)" or out:match "(PANIC[^\n]*)"
  if why == "signal" and (code == 24 or code == 9) or why == "exit" and (code == 137 or code == 152) then
    return "hang more than the processor time allowed"
  end
  return ("crash %s %s %s"):format(why, code, told or out:sub(-200):gsub("\n", " "))
end

-- Runs one case in a child process; returns a list of findings, and the calls that it began.
local function run(words, cpu)
  empty(place)
  lfs.mkdir(place .. "/tmp")
  local command = "ulimit -t %d; cd %s && exec %s %s child=%s slow=%s %s %s >%s 2>&1 </dev/null"
  local _, why, code = os.execute(command:format(
    cpu or options.cpu, quote(place .. "/tmp"), quote(program), quote(this), quote(place), options.slow,
    options.reach and "reach=1" or "", words,
    quote(place .. "/out")))
  local findings, ended = {}, false
  for line in read(place .. "/found"):gmatch "[^\n]+" do
    if line == "end" then ended = true else findings[#findings + 1] = line end
  end
  if not ended or why ~= "exit" or code ~= 0 then findings[#findings + 1] = crash(why, code) end
  return findings, from_text(read(place .. "/log"))
end

local function holds(calls, wanted)
  write(place .. ".case", to_text(calls))
  local cpu = wanted:find "^hang" and math.min(5, options.cpu) or nil
  for _, finding in ipairs((run("replay=" .. quote(place .. ".case"), cpu))) do
    if signature(finding) == wanted then return true end
  end
  return false
end

local function without(list, first, last)
  local rest = {}
  for i, item in ipairs(list) do
    if i < first or i > last then rest[#rest + 1] = item end
  end
  return rest
end

-- Removes parts of a list, large ones first, as long as good(rest) is true.
local function reduce(list, good, budget)
  local size = #list // 2
  while size >= 1 and budget.left > 0 do
    local last = #list
    while last >= 1 and budget.left > 0 do
      local rest = without(list, math.max(1, last - size + 1), last)
      budget.left = budget.left - 1
      if #rest < #list and good(rest) then list = rest end
      last = math.min(last - size, #list)
    end
    size = size // 2
  end
  return list
end

local function lines_of(text)
  local lines = {}
  for line in text:gmatch "[^\n]+" do lines[#lines + 1] = line end
  return lines
end

local function shrink(calls, wanted)
  local budget = { left = wanted:find "^hang" and options.tries // 5 or options.tries }
  calls = reduce(calls, function(rest) return holds(rest, wanted) end, budget)
  for i = #calls, 1, -1 do -- lines inside functions
    local lines = lines_of(calls[i])
    if #lines > 3 then
      local inner = table.move(lines, 2, #lines - 1, 1, {})
      local function whole(rest)
        return lines[1] .. "\n" .. (#rest > 0 and table.concat(rest, "\n") .. "\n" or "") .. lines[#lines]
      end
      inner = reduce(inner, function(rest)
        local other = table.move(calls, 1, #calls, 1, {})
        other[i] = whole(rest)
        return holds(other, wanted)
      end, budget)
      calls[i] = whole(inner)
    end
  end
  return calls
end

local function tell(number, seed, finding, calls)
  local out = options.out or root .. "/out/fuzz"
  lfs.mkdir(root .. "/out")
  lfs.mkdir(out)
  local path = ("%s/%d.lua"):format(out, number)
  local text = ("-- seed=%d per=%d: %s\n-- build/softworld scripts/fuzz.lua replay=%s\n\n%s"):format(seed,
    options.per, finding, path, to_text(calls))
  write(path, text)
  print(("== finding %d, seed %d: %s\n%s"):format(number, seed, finding, text))
  io.stdout:flush()
end

local function hunt()
  local seen, count, done, seed, reached = {}, 0, 0, options.seed, {}
  while done < options.calls do
    local findings, calls = run(("seed=%d per=%d"):format(seed, options.per))
    done = done + #calls
    for _, finding in ipairs(findings) do
      local mark = signature(finding)
      if not seen[mark] and not finding:find(options.leave or "\0", 1, true) then
        seen[mark], count = true, count + 1
        local short = calls
        if options.shrink ~= 0 and holds(calls, mark) then short = shrink(calls, mark) end
        tell(count, seed, finding, short)
      end
    end
    if options.reach then require "fuzz.reach".add(reached, read(place .. "/reach")) end
    seed = seed + 1
  end
  if options.reach then print(require "fuzz.reach".list(reached)) end
  print(("%d calls, %d findings"):format(done, count))
  return count == 0
end

local function again()
  local findings, calls = run("replay=" .. quote(absolute(options.replay)))
  for _, finding in ipairs(findings) do print(finding) end
  io.write(read(place .. "/out"))
  print(("%d calls, %d findings"):format(#calls, #findings))
  return #findings == 0
end

if options.child then child(options.child) end
local fine = options.replay and again() or not options.replay and hunt()
empty(place)
lfs.rmdir(place)
os.remove(place .. ".case")
os.exit(fine)
