-- SPDX-License-Identifier: GPL-3.0-or-later
--- Gives errors the right place. Errors of this library or of the core get the place of the script's line
-- that is running; an error of a script's own function keeps its place.
-- @module softworld.scene.blame
local blame = {}

-- The folder of this library, as places in messages begin. Lua cuts long paths there; how early depends on
-- the length of the file name.
local library = debug.getinfo(1, "S").source:match "^@(.*)scene/blame%.lua$" or "softworld/"

local function is_ours(source)
  local cut = source:sub(1, 3) == "..."
  return source:find(cut and "softworld/" or library, 1, true) ~= nil
end

-- Returns "file:line: " of the script's line that is running; "" if there is none.
local function place()
  for level = 3, 200 do
    local info = debug.getinfo(level, "Sl")
    if not info then return "" end
    if info.currentline > 0 and not is_ours(info.short_src) then
      return ("%s:%d: "):format(info.short_src, info.currentline)
    end
  end
  return ""
end

-- True for Lua's own message about a bug in this library. Its place must stay visible.
local function is_mistake(text)
  return text:find "^attempt to " or text:find "^bad argument #%d+ to '[^f]" or text:find "^stack overflow"
end

local function finish(of_core, ok, ...)
  if ok then return ... end
  local message = ...
  if type(message) ~= "string" then error(message, 0) end
  local where, text = message:match "^([^\n]-:%d+: )(.*)$"
  if where and (not is_ours(where) or is_mistake(text)) or not where and of_core then
    error(message, 0) -- an error of the script itself
  end
  text = (text or message):gsub("^bad argument #(%d+) to 'f' %((.*)%)$", "argument %1: %2")
  error(place() .. text, 0)
end

local function all(...) return ... end

-- Calls f so that an error of the core gets the place of this line; an error of a script's function keeps its
-- own.
local function of_core(f, ...) return all(f(...)) end

local kinds = setmetatable({}, { __mode = "k" }) -- function -> "C", "Lua"

local function kind_of(f)
  local kind = kinds[f]
  if not kind then
    kind = debug.getinfo(f, "S").what
    kinds[f] = kind
  end
  return kind
end

--- Calls f. An error of this library or of the core gets the place of the script's line. If f is a
-- function of this library it raises errors without a place, error(text, 0).
function blame.call(_, f, ...)
  if kind_of(f) == "C" then return finish(true, pcall(of_core, f, ...)) end
  return finish(false, pcall(f, ...))
end

--- Same for a function of this library that places its errors itself, with levels counted as if the
-- script called it.
function blame.through(f, ...) return finish(true, pcall(of_core, f, ...)) end

--- Returns f with errors placed as by blame.call.
function blame.placed(f)
  return function(...) return blame.call(3, f, ...) end
end

local last -- { raised = the last error that blame.fault raised }

--- Raises an error of a script's function unchanged: no other model can mend it.
function blame.fault(raised)
  last = { raised = raised }
  error(raised, 0)
end

--- True if this error came from blame.fault.
function blame.is_fault(raised) return last ~= nil and rawequal(last.raised, raised) end

--- Calls a method of each object of a list, also after one has raised an error. Returns a function that
-- raises the first error, if any.
function blame.each(list, method)
  local first
  for _, object in ipairs(list) do
    local fine, why = pcall(object[method], object)
    if not fine then first = first or { why = why } end
  end
  return function()
    if first then blame.fault(first.why) end
  end
end

--- Returns an error's text without the place in this library where it was raised.
function blame.plain(message)
  return (tostring(message):gsub("^[^\n:]*softworld/[%w_/]+%.lua:%d+: ", ""))
end

return blame
