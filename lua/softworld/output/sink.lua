-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes and reads files and folders, and formats numbers for files.
-- A file is written beside its final place under a temporary name and then
-- renamed, so that a reader never meets half a file and an interrupted run
-- never spoils the previous one. Temporary files of processes that were killed
-- are removed by the next process that writes into the folder. Functions that fail
-- raise a plain string that names the path and the reason.
-- @module softworld.output.sink
local core = require "softworld.core"
local letters = require "softworld.output.letters"

local sink = {}

local locks = {} -- of this process's temporary files, by path

--- Raises an error without position information.
-- @tparam string format as for string.format
-- @param ... its arguments
function sink.fail(format, ...)
  error(string.format(format, ...), 0)
end

--- Quotes a word for the POSIX shell.
-- @tparam string word
-- @treturn string one shell word, whatever the characters in it
function sink.quote(word)
  return "'" .. word:gsub("'", "'\\''") .. "'"
end

--- Returns a number as text that reads back to the same bits.
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

--- Returns a value as a cell of a CSV file. A spreadsheet computes a text that begins like a formula, so such
-- a text gets a ' in front; control characters become spaces. A text that is not UTF-8 is read as Latin-1.
-- @param value number, text or nil
-- @treturn string
function sink.cell(value)
  if value == nil then return "" end
  if type(value) == "number" then return sink.number(value) end
  local text = letters.utf8(tostring(value)):gsub("%c", " ")
  if text:find "^%s*[=+@-]." then text = "'" .. text end
  if text:find '[",;#]' or text:find "^%s" or text:find "%s$" then
    return '"' .. text:gsub('"', '""') .. '"'
  end
  return text
end

--- Returns the text of a cell that sink.cell wrote, without the ' in front.
function sink.of_cell(text)
  return text:find "^'%s*[=+@-]." and text:sub(2) or text
end

--- Returns the folder part of a path.
-- @tparam string path
-- @treturn string "." for a bare name, never with a trailing slash except "/"
function sink.folder(path)
  local folder = path:match("^(.*)/[^/]*$")
  if not folder then return "." end
  return folder == "" and "/" or folder
end

--- Returns the last part of a path.
-- @tparam string path
-- @treturn string
function sink.base(path)
  return path:match("[^/]*$")
end

--- Returns a path as messages show it.
-- @tparam string path
-- @treturn string
function sink.shown(path)
  return path:find("\0", 1, true) and ("%q"):format(path) or path
end

local function check_path(path, verb)
  verb = verb or "write"
  if type(path) ~= "string" or path == "" then
    sink.fail("a file path (a non-empty string) is expected, got %s", path == "" and '""' or type(path))
  end
  if path:find("\0", 1, true) then
    sink.fail("cannot %s %s: zero byte in the path", verb, sink.shown(path))
  end
  if sink.base(path) == "" then sink.fail("cannot %s %s: it names a folder, not a file", verb, path) end
end

--- Returns the extension of a path in lower case, without the dot; "" if none.
-- @tparam string path
-- @treturn string
function sink.extension(path)
  check_path(path)
  return (sink.base(path):match("^.+%.([^.]*)$") or ""):lower()
end

--- Makes a fresh, empty, hidden file in the same folder as the path. End its use by sink.commit or
-- sink.discard. Files that killed processes left there are removed.
-- @tparam string path the final path
-- @tparam[opt] boolean folder make a folder, not a file
-- @tparam[opt] boolean swept leftovers in the folder have just been removed
-- @treturn string temporary path; raises if the folder cannot be written
function sink.temporary(path, folder, swept)
  check_path(path)
  local place = sink.folder(path)
  if not swept then core.sweep(place) end
  local start = "." .. sink.base(path):sub(1, 120)
  if place ~= "." or path:sub(1, 2) == "./" then start = (place == "/" and "" or place) .. "/" .. start end
  local temporary, lock = core.part(start, folder)
  if not temporary then sink.fail("cannot write %s: %s", path, lock) end
  locks[temporary] = lock
  return temporary
end

--- Makes a fresh, empty file for this process alone; end its use by sink.discard.
-- @treturn string path
function sink.scratch()
  local folder = os.getenv "TMPDIR"
  if not folder or core.kind(folder) ~= "folder" then folder = "/tmp" end
  return sink.temporary(folder .. "/softworld")
end

local function let_go(temporary)
  if locks[temporary] then locks[temporary]() end
  locks[temporary] = nil
end

--- Removes a temporary file.
-- @tparam string temporary
function sink.discard(temporary)
  os.remove(temporary)
  let_go(temporary)
end

local function reason_of(message, path)
  local prefix = path .. ": "
  message = tostring(message)
  if message:sub(1, #prefix) == prefix then return message:sub(#prefix + 1) end
  return message
end

local function put_in_place(temporary, path, safe)
  local kind = core.kind(path)
  if kind and kind ~= "file" then return nil, kind == "folder" and "Is a directory" or "it is a " .. kind end
  local good, why = true, nil
  if safe then good, why = core.sync(temporary) end
  if good then good, why = os.rename(temporary, path) end
  if good and safe then good, why = core.sync(sink.folder(path), true) end
  return good, why
end

--- Gives a finished temporary file its final name.
-- If that fails, the temporary file is removed.
-- @tparam string temporary
-- @tparam string path
-- @tparam[opt] boolean safe flush the file to the disk first, so that a crash of the
-- computer leaves either the old file or the new one, whole
function sink.commit(temporary, path, safe)
  local ok, why = put_in_place(temporary, path, safe)
  sink.discard(temporary) -- on success it does not exist any more
  if not ok then sink.fail("cannot write %s: %s", path, reason_of(why, temporary)) end
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

-- Fills an open file and closes it. Returns nil, or a message.
local function fill_and_close(file, content)
  local ok, failure = pcall(fill, file, content)
  local closed, close_why = file:close()
  if ok and closed then return nil end
  if ok then return { sink_reason = close_why } end
  return failure
end

-- Writes to a device or a pipe (/dev/stdout); renaming would put a file in its place.
local function write_through(path, content)
  local file, why = io.open(path, "wb")
  if not file then sink.fail("cannot write %s: %s", path, reason_of(why, path)) end
  local failure = fill_and_close(file, content)
  if failure and not (type(failure) == "table" and failure.sink_reason) then error(failure, 0) end
  if failure then sink.fail("cannot write %s: %s", path, reason_of(failure.sink_reason, path)) end
  return path
end

--- Writes a file whole or not at all.
-- @tparam string path
-- @tparam string|function content the text, or function(write) that calls
-- write(string, ...) any number of times; its errors are passed on
-- @tparam[opt] table options `safe` as in sink.commit; `swept` as in sink.temporary
-- @treturn string the path
function sink.write_file(path, content, options)
  check_path(path)
  if type(content) ~= "string" and type(content) ~= "function" then
    sink.fail("cannot write %s: text or function(write) expected, got %s", path, type(content))
  end
  local kind = core.kind(path)
  if kind and kind ~= "file" and kind ~= "folder" then return write_through(path, content) end
  local temporary = sink.temporary(path, false, options and options.swept)
  local _ <close> = setmetatable({}, { __close = function() sink.discard(temporary) end }) -- also on Ctrl-C
  local file, why = io.open(temporary, "wb")
  if not file then sink.fail("cannot write %s: %s", path, reason_of(why, temporary)) end
  local failure = fill_and_close(file, content)
  if not failure then
    sink.commit(temporary, path, options and options.safe)
    return path
  end
  if type(failure) ~= "table" or not failure.sink_reason then error(failure, 0) end
  return sink.fail("cannot write %s: %s", path, reason_of(failure.sink_reason, temporary))
end

local largest = 4e9 -- largest file that is read whole [B]

-- Returns why a file cannot be read, or nil. Reading pipes and devices may never end.
local function unreadable(path)
  local kind = core.kind(path)
  if kind == nil or kind == "file" then return nil end
  if kind == "pipe" and (path == "/dev/stdin" or path:find "^/dev/fd/%d+$") then return nil end
  return ("it is a %s, not a file"):format(kind)
end

--- Reads a whole file.
-- @tparam string path
-- @treturn string
function sink.read_file(path)
  check_path(path, "read")
  local never = unreadable(path)
  if never then sink.fail("cannot read %s: %s", path, never) end
  local file, why = io.open(path, "rb")
  if not file then sink.fail("cannot read %s: %s", path, reason_of(why, path)) end
  local size = file:seek "end"
  if size and size > largest then
    file:close()
    sink.fail("cannot read %s: it has %.0f bytes, more than %.0f", path, size, largest)
  end
  if size then file:seek "set" end
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

--- Makes a folder and those above it; an existing folder is no error.
-- Uses LuaFileSystem (Debian package lua-filesystem) if it is there, else mkdir.
-- @tparam string path
-- @treturn string the path
function sink.make_folder(path)
  if type(path) ~= "string" or path == "" then sink.fail("a folder path is expected") end
  local found, lfs = pcall(require, "lfs")
  if found and type(lfs) == "table" then make_with_lfs(lfs, path) else make_with_shell(path) end
  return path
end

--- Removes a folder made for temporary files, with the files in it.
-- @tparam string path
-- @tparam {string,...} names of the files that may be in it
function sink.remove_folder(path, names)
  for _, name in ipairs(names) do os.remove(path .. "/" .. name) end
  sink.discard(path)
end

--- Runs a command in the shell and catches everything it prints.
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

--- Raises an error unless a program is on the search path.
-- @tparam string program
-- @tparam string package the Debian package that brings it
-- @tparam string purpose what it is needed for
function sink.need(program, package, purpose)
  if sink.run("command -v " .. sink.quote(program) .. " >/dev/null") then return end
  sink.fail("%s needs the program %s, which is not installed: apt-get install %s", purpose, program, package)
end

--- Returns numbers as bytes, each by a format of string.pack.
function sink.packed(format, values)
  local parts = {}
  for i = 1, #values, 200 do
    local n = math.min(200, #values - i + 1)
    parts[#parts + 1] = ("<" .. format:rep(n)):pack(table.unpack(values, i, i + n - 1))
  end
  return table.concat(parts)
end

return sink
