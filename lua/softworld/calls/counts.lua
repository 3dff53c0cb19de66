-- SPDX-License-Identifier: GPL-3.0-or-later
--- Refuses arguments that a method does not take: obstacle:force(wire) would return the force of all wires,
-- and scene:remove("a", "b") would leave b in its place. The rows of the calls tell how many they take.
-- @module softworld.calls.counts
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local rows = require "softworld.rows"

local counts = {}

-- Methods of the core that take no arguments, by class. Those that take some stay as they are: they are
-- called often.
local bare = {
  scene = "energy contacts penetration touches stable_dt frame_count clear_frames snapshot names",
  obstacle = "force remove", wire = "positions velocities particles bend_energy folded",
  clamp = "force release", join = "release", force = "release",
}

-- These refuse arguments themselves, and say what to do.
local own = checks.set "channel:force channel:close channel:open scene:tie"

-- Returns how many arguments a call takes, from its arguments in words; nil: any number.
local function count_of(arguments)
  if not arguments or arguments:find("...", 1, true) and not arguments:find "{%.%.%.}" then return nil end
  local plain = arguments:gsub("%b{}", "t"):gsub("%b()", "")
  if plain == "" then return 0 end
  return select(2, plain:gsub(",", "")) + 1
end

local function refuse(call, most, ...)
  local got = checks.got((select(most + 1, ...)))
  if most == 0 then error(("%s takes no arguments, got %s"):format(call.name, got), 0) end
  error(("%s takes (%s), got %s too"):format(call.name, call.arguments, got), 0)
end

-- Returns true if an argument beyond the first `most` is not nil.
local function has_more(most, ...)
  for k = most + 1, select("#", ...) do
    if select(k, ...) ~= nil then return true end
  end
  return false
end

-- Returns a method that checks the count. method: of this library, or of the core without arguments.
local function counted(call, most, method)
  if debug.getinfo(method, "S").what == "C" then
    return function(self, ...)
      if has_more(0, ...) and core.exists(self) then build.call(3, refuse, call, 0, ...) end
      return build.call(3, method, self)
    end
  end
  return function(self, ...)
    local there = not core.type(self) or core.exists(self) -- else the method says that it is closed
    if there and has_more(most, ...) then build.call(3, refuse, call, most, ...) end
    return method(self, ...)
  end
end

local function install(class, verb, call, most)
  local method = class and rawget(class, verb)
  if type(method) == "function" then class[verb] = counted(call, most, method) end
end

-- Installs the check of a call with a row, if its method is of this library and takes a known number.
local function install_row(class, name, call)
  local verb = name:match ":([%a_]+)$"
  local most = not own[name] and count_of(call.arguments) or nil
  local method = class and rawget(class, verb)
  if most and method and debug.getinfo(method, "S").what ~= "C" then install(class, verb, call, most) end
end

--- Installs the checks of a class whose objects have this name in the rows.
function counts.of(kind, class)
  for name, call in pairs(rows.all) do
    if name:match "^([%a_]+):" == kind then install_row(class, name, call) end
  end
end

--- Installs the checks. made: classes of objects made in Lua, by name.
function counts.install(made)
  for kind, verbs in pairs(bare) do
    for verb in verbs:gmatch "%S+" do
      install(core.class[kind], verb, { name = ("%s:%s"):format(kind, verb) }, 0)
    end
  end
  for name, call in pairs(rows.all) do
    local kind, verb = name:match "^([%a_]+):([%a_]+)$"
    local is_bare = bare[kind] and (" " .. bare[kind] .. " "):find(" " .. verb .. " ", 1, true)
    if kind and not is_bare then install_row(made[kind] or core.class[kind], name, call) end
  end
end

return counts
