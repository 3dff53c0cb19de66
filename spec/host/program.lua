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

-- A folder for the spec's files; program.clean() removes all of them.
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

-- Run a shell command: what it wrote to stdout, to stderr, its exit code.
function program.shell(command)
  local out, err = os.tmpname(), os.tmpname()
  local _, how, code = os.execute(("( %s\n) >%s 2>%s"):format(command, out, err))
  local texts = { program.read(out), program.read(err) }
  os.remove(out)
  os.remove(err)
  return texts[1], texts[2], how == "exit" and code or how .. code
end

-- A time of 0 is some milliseconds: two signals that are not merged into one.
local MOMENT = "i=0; while [ $i -lt 10000 ]; do i=$((i+1)); done"

-- Run it in the background, send SIGINT after each of the times [s], and KILL
-- (code 137) should it go on for long. Its own number stays taken until wait, so
-- no other process can be hit.
local function with_signals(command, times)
  local steps = {}
  for i, time in ipairs(times) do
    steps[i] = (time > 0 and "sleep " .. time or MOMENT) .. "; kill -INT $p 2>/dev/null; "
  end
  return ("%s & p=$!; (sleep 5; kill -KILL $p) >/dev/null 2>&1 & w=$!; %swait $p; c=$?; kill $w; exit $c")
    :format(command, table.concat(steps))
end

-- Run the program with a list of arguments. options: stdin (a text), input (a
-- redirection instead of it), before (put in front of the command: "FOO=1"),
-- signals (a list of times).
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

-- Run a script given as text; more arguments follow its name.
function program.script(text, arguments, options)
  local name = program.write(program.folder() .. "/script.lua", text)
  local out, err, code = program.run({ name, table.unpack(arguments or {}) }, options)
  return out, err:gsub(name:gsub("%p", "%%%0"), "script.lua"), code
end

function program.has(tool) return (os.execute("command -v " .. tool .. " >/dev/null 2>&1")) end

-- The session at a terminal: keys is a list of texts typed and numbers of
-- seconds waited. Gives what the terminal showed and the exit code.
function program.terminal(keys, options)
  options = options or {}
  local typing = { "sleep 0.5" }
  for _, key in ipairs(keys) do
    typing[#typing + 1] = type(key) == "number" and "sleep " .. key
      or "printf %s " .. quote(key) .. "; sleep 0.15"
  end
  local state = options.state or program.folder()
  local command = ("TERM=dumb INPUTRC=/dev/null XDG_STATE_HOME=%s exec %s"):format(
    quote(state), quote(program.path))
  local out, _, code = program.shell(("(%s) | timeout 20 script -qec %s /dev/null"):format(
    table.concat(typing, "; "), quote(command)))
  return out:gsub("\r", ""), code
end

return program
