-- SPDX-License-Identifier: GPL-3.0-or-later
--- Refuses arguments that a call does not take: obstacle:force(wire) would return the force of all wires,
-- scene:remove("a", "b") would leave b in its place, and sw.load(file, settings) would lose the settings. The
-- rows of the calls tell how many they take.
-- @module softworld.calls.counts
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local place = require "softworld.place"
local rows = require "softworld.rows"

local counts = {}

-- These refuse arguments themselves, and say what to do.
local own = checks.set "channel:force channel:close channel:open scene:tie"

-- Methods without a row in help: a page of the manual describes them with the fields of their object.
local without_row = { ["section:width"] = { name = "section:width", arguments = "direction" } }

-- Returns how many arguments a call takes, from its arguments in words; nil: any number.
local function count_of(arguments)
  local plain = arguments and arguments:gsub("function%b() %.%.%. end", "f"):gsub("%b{}", "t")
    :gsub("%b()", "")
  if not plain or plain:find("...", 1, true) then return nil end
  if plain == "" then return 0 end
  return select(2, plain:gsub(",", "")) + 1
end

local function refuse(call, most, k, value)
  local got = checks.got(value)
  if most == 0 then error(("%s takes no arguments, got %s as argument %d"):format(call.name, got, k), 0) end
  error(("%s takes (%s), got %s too, as argument %d"):format(call.name, call.arguments, got, k), 0)
end

-- Returns the number of the first argument beyond the first `most` that is not nil.
local function beyond(most, ...)
  for k = most + 1, select("#", ...) do
    if select(k, ...) ~= nil then return k end
  end
end

--- Returns how many arguments a method takes, or false if this is not known, and its row. Its module may not
-- be loaded yet.
function counts.of(kind, class, verb)
  local name = ("%s:%s"):format(kind == "process" and "p" or kind, verb) -- scripts call it p
  if own[name] then return false end
  if not rows.all[name] then rows.load_for(class, verb) end
  local call = rows.all[name] or without_row[name]
  return call and count_of(call.arguments) or false, call
end

-- True if the library makes the call that the function at this level checks.
local function is_inner(level)
  level = level + 1
  local caller = debug.getinfo(level, "S")
  while caller and caller.what == "C" do -- pcall
    level = level + 1
    caller = debug.getinfo(level, "S")
  end
  return caller and place.is_ours(caller.source)
end

--- Raises an error, at the place of the call, for arguments beyond the first `most`. A closed object says so
-- itself. The library may give its own methods more than scripts may. Call it from the method itself.
function counts.check(self, call, most, ...)
  local k = beyond(most, ...)
  if not k or core.type(self) and not core.exists(self) or is_inner(3) then return end
  build.call(4, refuse, call, most, k, (select(k, ...)))
end

--- Returns f, which scripts call as owner[verb] by a name such as sw.load; it refuses arguments that it does
-- not take. called: the owner itself is called, and f gets it as its first argument.
function counts.guarded(owner, verb, name, f, called)
  local first, most = called and 2 or 1, 0
  local is_c = debug.getinfo(f, "S").what == "C"
  local function check(...)
    if not rows.all[name] then rows.load_for(owner, verb) end
    local call = rows.all[name]
    most = call and count_of(call.arguments) or math.huge
    local k = beyond(most, select(first, ...))
    if k and not is_inner(3) then build.call(4, refuse, call, most, k, (select(k + first - 1, ...))) end
  end
  return function(...)
    if select("#", ...) - first >= most then check(...) end
    if is_c then return build.through(f, ...) end
    return f(...) -- the tail call keeps error levels the same as without this wrapper
  end
end

--- Guards the functions of a table that scripts know by this name, such as sw.cable, and the table itself if
-- it can be called.
function counts.guard(name, t)
  local meta = getmetatable(t)
  local call = type(meta) == "table" and rawget(meta, "__call")
  if call then meta.__call = counts.guarded(t, "", name, call, true) end
  for verb, f in next, t do
    if type(f) == "function" then t[verb] = counts.guarded(t, verb, name .. "." .. verb, f) end
  end
  return t
end

-- Tells the core how many values a method of it takes, its object included, when it first gets more than it
-- knows of.
local function tell(kind, verb, self, ...)
  local most, call = counts.of(kind, core.class[kind], verb)
  if not most then return math.maxinteger end
  counts.check(self, call, most, ...)
  return most + 1
end

--- Installs the checks of the core's methods; those of this library's methods are in softworld.methods.
function counts.install() core.count_arguments(tell) end

return counts
