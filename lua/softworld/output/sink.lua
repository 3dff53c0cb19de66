-- SPDX-License-Identifier: GPL-3.0-or-later
--- Files, folders and numbers on their way out.
-- A file is written beside its final place under a temporary name and then
-- renamed, so that a reader never meets half a file and an interrupted run
-- never spoils the previous one. Functions that fail raise a plain string
-- that names the path and the reason.
-- @module softworld.output.sink

local sink = {}

local counter = 0

--- Raise an error without position information.
-- @tparam string format as for string.format
-- @param ... its arguments
function sink.fail(format, ...)
  error(string.format(format, ...), 0)
end

--- Quote a word for the POSIX shell.
-- @tparam string word
-- @treturn string one shell word, whatever the characters in it
function sink.quote(word)
  return "'" .. word:gsub("'", "'\\''") .. "'"
end

--- A number as text that reads back to the same bits.
-- Integers are written as integers, floats with 17 significant digits,
-- the rest as nan, inf or -inf, always with a decimal point.
-- @tparam number x
-- @treturn string
function sink.number(x)
  if math.type(x) == "integer" then return string.format("%d", x) end
  if x ~= x then return "nan" end
  if x == math.huge then return "inf" end
  if x == -math.huge then return "-inf" end
  local text = string.format("%.17g", x)
  if text:find(",", 1, true) then text = text:gsub(",", ".") end -- comma locales
  return text
end

--- The folder part of a path.
-- @tparam string path
-- @treturn string "." for a bare name, never with a trailing slash except "/"
function sink.folder(path)
  local folder = path:match("^(.*)/[^/]*$")
  if not folder then return "." end
  return folder == "" and "/" or folder
end

--- The last part of a path.
-- @tparam string path
-- @treturn string
function sink.base(path)
  return path:match("[^/]*$")
end

--- The extension of a path in lower case, without the dot; "" if none.
-- @tparam string path
-- @treturn string
function sink.extension(path)
  return (sink.base(path):match("^.+%.([^.]*)$") or ""):lower()
end

local function check_path(path)
  if type(path) ~= "string" or path == "" then
    sink.fail("a file path (a non-empty string) is expected, got %s", path == "" and '""' or type(path))
  end
  if path:find("\0", 1, true) then sink.fail("cannot write %q: zero byte in the path", path) end
  if sink.base(path) == "" then sink.fail("cannot write %s: it names a folder, not a file", path) end
end

--- A fresh name in the same folder as the path, hidden and with its extension.
-- @tparam string path the final path
-- @treturn string temporary path; nothing is created
function sink.temporary(path)
  check_path(path)
  counter = counter + 1
  local mark = tostring({}):gsub("%W", ""):sub(-10)
  local name = string.format(".%s.%d%s%d.tmp", sink.base(path):sub(1, 120), os.time(), mark, counter)
  local folder = sink.folder(path)
  local extension = sink.extension(path)
  if extension ~= "" then name = name .. "." .. extension end
  if folder == "." and path:sub(1, 2) ~= "./" then return name end
  return (folder == "/" and "" or folder) .. "/" .. name
end

local function reason_of(message, path)
  local prefix = path .. ": "
  message = tostring(message)
  if message:sub(1, #prefix) == prefix then return message:sub(#prefix + 1) end
  return message
end

--- Give a finished temporary file its final name.
-- The temporary file is removed if that fails.
-- @tparam string temporary
-- @tparam string path
function sink.commit(temporary, path)
  local ok, why = os.rename(temporary, path)
  if ok then return end
  os.remove(temporary)
  sink.fail("cannot write %s: %s", path, reason_of(why, temporary))
end

local function writer(file)
  return function(...)
    local ok, why = file:write(...)
    if not ok then error({ sink_reason = why }, 0) end
  end
end

local function fill(file, content)
  if type(content) == "function" then content(writer(file)) else writer(file)(content) end
end

--- Write a file whole or not at all.
-- @tparam string path
-- @tparam string|function content the text, or function(write) that calls
-- write(string, ...) as often as it likes; an error in it is passed on
-- @treturn string the path
function sink.write_file(path, content)
  check_path(path)
  if type(content) ~= "string" and type(content) ~= "function" then
    sink.fail("cannot write %s: text or function(write) expected, got %s", path, type(content))
  end
  local temporary = sink.temporary(path)
  local file, why = io.open(temporary, "wb")
  if not file then sink.fail("cannot write %s: %s", path, reason_of(why, temporary)) end
  local ok, failure = pcall(fill, file, content)
  local closed, close_why = file:close()
  if ok and closed then
    sink.commit(temporary, path)
    return path
  end
  os.remove(temporary)
  if not ok and type(failure) ~= "table" then error(failure, 0) end
  if not ok and not failure.sink_reason then error(failure, 0) end
  return sink.fail("cannot write %s: %s", path, reason_of(ok and close_why or failure.sink_reason, temporary))
end

--- Make an empty temporary file beside a path for another program to fill.
-- @tparam string path the final path
-- @treturn string the temporary path; raises if the folder cannot be written
function sink.reserve(path)
  local temporary = sink.temporary(path)
  local file, why = io.open(temporary, "wb")
  if not file then sink.fail("cannot write %s: %s", path, reason_of(why, temporary)) end
  file:close()
  return temporary
end

--- Read a whole file.
-- @tparam string path
-- @treturn string
function sink.read_file(path)
  local file, why = io.open(path, "rb")
  if not file then sink.fail("cannot read %s: %s", path, reason_of(why, path)) end
  local text, read_why = file:read("a")
  file:close()
  if not text then sink.fail("cannot read %s: %s", path, tostring(read_why)) end
  return text
end

local function make_with_lfs(lfs, path)
  local so_far = path:sub(1, 1) == "/" and "/" or ""
  for part in path:gmatch("[^/]+") do
    so_far = so_far .. part
    if lfs.attributes(so_far, "mode") ~= "directory" then
      local ok, why = lfs.mkdir(so_far)
      if not ok and lfs.attributes(so_far, "mode") ~= "directory" then
        sink.fail("cannot make folder %s: %s", path, tostring(why))
      end
    end
    so_far = so_far .. "/"
  end
end

local function make_with_shell(path)
  local guarded = path:sub(1, 1) == "-" and "./" .. path or path
  local ok, text = sink.run("mkdir -p " .. sink.quote(guarded))
  if not ok then sink.fail("cannot make folder %s: %s", path, text:match(": ([^:\n]*)\n*$") or text) end
end

--- Make a folder and those above it; one that exists is fine.
-- Uses LuaFileSystem (Debian package lua-filesystem) if it is there, else mkdir.
-- @tparam string path
-- @treturn string the path
function sink.make_folder(path)
  if type(path) ~= "string" or path == "" then sink.fail("a folder path is expected") end
  local found, lfs = pcall(require, "lfs")
  if found and type(lfs) == "table" then make_with_lfs(lfs, path) else make_with_shell(path) end
  return path
end

--- Remove a folder made for temporary files, with the files in it.
-- @tparam string path
-- @tparam {string,...} names of the files that may be in it
function sink.remove_folder(path, names)
  for _, name in ipairs(names) do os.remove(path .. "/" .. name) end
  os.remove(path)
end

--- Run a command in the shell and catch everything it prints.
-- @tparam string command with its words quoted
-- @treturn boolean whether it ended with exit code 0
-- @treturn string its output and error output together
-- @treturn integer exit code, 127 if the program is missing; 128 + signal if it was killed
function sink.run(command)
  local pipe, why = io.popen("{ " .. command .. "\n} 2>&1 </dev/null", "r")
  if not pipe then return false, tostring(why), 126 end
  local text = pipe:read("a")
  local ok, kind, code = pipe:close()
  if kind == "signal" then code = 128 + code end
  return ok == true, text or "", code or 0
end

--- Insist that a program is on the search path.
-- @tparam string program
-- @tparam string package the Debian package that brings it
-- @tparam string purpose what it is needed for
function sink.need(program, package, purpose)
  if sink.run("command -v " .. sink.quote(program) .. " >/dev/null") then return end
  sink.fail("%s needs the program %s, which is not installed: apt-get install %s", purpose, program, package)
end

return sink
