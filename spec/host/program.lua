-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs the host program from outside, for the specs beside this file.

local program = {}

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
program.root = here .. "/../.."
program.path = os.getenv "SOFTWORLD_BIN" or "build/softworld"

function program.quote(text) return "'" .. text:gsub("'", "'\\''") .. "'" end

local quote = program.quote

function program.read(name)
  local file = assert(io.open(name, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

function program.write(name, text)
  local file = assert(io.open(name, "wb"))
  assert(file:write(text))
  file:close()
  return name
end

-- Folders for a spec's files; program.clean() removes all of them.
local folders = {}

function program.folder()
  local pipe = assert(io.popen "mktemp -d")
  local name = pipe:read "l"
  pipe:close()
  folders[#folders + 1] = name
  return name
end

function program.clean()
  for _, name in ipairs(folders) do os.execute("rm -rf " .. quote(name)) end
  folders = {}
end

-- Runs a shell command; returns its stdout, its stderr and its exit code.
function program.shell(command)
  local out, err = os.tmpname(), os.tmpname()
  local _, how, code = os.execute(("( %s\n) >%s 2>%s"):format(command, out, err))
  local texts = { program.read(out), program.read(err) }
  os.remove(out)
  os.remove(err)
  return texts[1], texts[2], how == "exit" and code or how .. code
end

-- Time without progress after which a program counts as hanging. Wall time says little on a busy machine, so
-- the limit is on the program's own CPU time [s]; the limit on wall time is far beyond any wait for the
-- processor.
local MOST_CPU, MOST_WALL = 40, 300

-- A time of 0 becomes a few milliseconds, so that two signals are not merged into one.
local MOMENT = "i=0; while [ $i -lt 10000 ]; do i=$((i+1)); done"

-- Shell functions for process $p. ticks: its CPU time t [1/100 s] and its state. ready: it catches or
-- ignores SIGINT by now, and has computed for a time since its start or is waiting.
local SHELL = [[
ticks() {
  read -r line 2>/dev/null </proc/$p/stat || return 1
  set -- ${line##*) }; state=$1; t=$((${12}+${13}))
}
handles() {
  while read -r key value; do
    case $key in SigCgt:|SigIgn:) [ $((0x${value#????????} & 2)) -ne 0 ] && return 0 ;; esac
  done 2>/dev/null </proc/$p/status
  return 1
}
ready() {
  still=0
  while ticks && [ $state != Z ]; do
    if handles; then
      case $state in S) still=$((still+1)) ;; *) still=0 ;; esac
      [ $t -ge $1 ] || [ $still -ge 10 ] && return 0
    fi
    sleep 0.02
  done
}
more() { # has computed for $1/100 s more since $from, or waits
  still=0
  while ticks && [ $state != Z ] && [ $((t-from)) -lt $1 ] && [ $still -lt 10 ]; do
    case $state in S) still=$((still+1)) ;; *) still=0 ;; esac
    sleep 0.02
  done
}
watch() { # ends it when it goes on for too long
  n=0
  while ticks && [ $state != Z ]; do
    [ $t -gt $1 ] || [ $n -gt $2 ] && { kill -KILL $p; return; }
    sleep 0.2; n=$((n+1))
  done
}
]]

-- Runs the command in the background and sends SIGINT: first when it has computed for the first of the times
-- [s] (or waits), then after each further time, once it has computed for three quarters of that time (or
-- waits). With again = true it sends more until the program ends. If the program does not end, KILL follows
-- (code 137). The process id stays reserved until wait, so no other process can be hit.
local function with_signals(command, times)
  local steps = {}
  for i, time in ipairs(times) do
    local wait = i == 1 and ("ready %d"):format(100 * time // 1)
      or time > 0 and ("sleep %g; more %d"):format(time, 75 * time // 1) or MOMENT
    local note = (times[i + 1] or 0) > 0 and "; ticks; from=$t" or ""
    steps[i] = wait .. note .. "; kill -INT $p 2>/dev/null"
  end
  if times.again then
    steps[#steps + 1] = "while sleep 0.2; ticks && [ $state != Z ]; do kill -INT $p 2>/dev/null; done"
  end
  return ("%s%s & p=$!; (watch %d %d) >/dev/null 2>&1 & w=$!; %s; wait $p; c=$?; kill $w 2>/dev/null; "
    .. "exit $c"):format(SHELL, command, 100 * MOST_CPU, 5 * MOST_WALL, table.concat(steps, "; "))
end

-- Runs the program with a list of arguments. options: stdin (a text), input (a redirection instead of
-- stdin), before (text in front of the command: "FOO=1"), signals (a list of times).
function program.run(arguments, options)
  options = options or {}
  local words = { options.before or "", quote(options.path or program.path) }
  for _, word in ipairs(arguments) do words[#words + 1] = quote(word) end
  local input = program.write(os.tmpname(), options.stdin or "")
  words[#words + 1] = options.input or "<" .. input
  local command = table.concat(words, " ")
  if options.signals then command = with_signals(command, options.signals) end
  local out, err, code = program.shell(command)
  os.remove(input)
  return out, err, code
end

-- Runs a script given as text; more arguments follow its name.
function program.script(text, arguments, options)
  local name = program.write(program.folder() .. "/script.lua", text)
  local out, err, code = program.run({ name, table.unpack(arguments or {}) }, options)
  return out, err:gsub(name:gsub("%p", "%%%0"), "script.lua"), code
end

function program.has(tool) return (os.execute("command -v " .. tool .. " >/dev/null 2>&1")) end

-- Returns true if the program can be given a terminal; false if the system has none (no /dev/pts, as in some
-- containers). Raises an error if it has one but script(1), which makes terminals, fails.
function program.has_terminals()
  local _, why, code = program.shell "script -qec true /dev/null </dev/null"
  if code == 0 then return true end
  assert(select(3, program.shell ": <>/dev/ptmx") ~= 0,
    "there are terminals (/dev/ptmx), but script(1) of package bsdutils fails: " .. why)
  return false
end

-- quiet N: process $p waits for input, or has computed for another N/100 s.
local TYPING = [[
quiet() {
  ticks || return; from=$t; still=0
  while ticks && [ $state != Z ] && [ $still -lt 5 ] && [ $((t-from)) -lt $1 ]; do
    case $state in S) still=$((still+1)) ;; *) still=0 ;; esac
    sleep 0.02
  done
}
]]

-- A session at a terminal. keys: a list of texts and numbers. A text is typed when the program waits for
-- input or computes; a number is a span of the program's computing time [s]. Returns the terminal's output
-- and the exit code.
function program.terminal(keys, options)
  options = options or {}
  local number = program.folder() .. "/number"
  local typing = { SHELL .. TYPING .. ("n=0; while ! read -r p <%s; do sleep 0.02; n=$((n+1)); "
    .. "[ $n -gt 10000 ] && exit; done 2>/dev/null"):format(number), "quiet 1000" }
  for _, key in ipairs(keys) do
    typing[#typing + 1] = type(key) == "number" and ("quiet %d"):format(100 * key // 1)
      or "printf %s " .. quote(key) .. "; sleep 0.05; quiet 5"
  end
  local state = options.state or program.folder()
  local command = ("echo $$ >%s; TERM=dumb INPUTRC=/dev/null XDG_STATE_HOME=%s exec %s"):format(number,
    quote(state), quote(program.path))
  local out, _, code = program.shell(("(%s) | timeout %d script -qec %s /dev/null"):format(
    table.concat(typing, "; "), MOST_WALL, quote(command)))
  return out:gsub("\r", ""), code
end

return program
