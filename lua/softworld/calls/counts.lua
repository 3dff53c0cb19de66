-- SPDX-License-Identifier: GPL-3.0-or-later
--- Refuses arguments that a method does not take: obstacle:force(wire) would return the force of all wires,
-- and scene:remove("a", "b") would leave b in its place. The rows of the calls tell how many they take.
-- @module softworld.calls.counts
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local place = require "softworld.place"
local rows = require "softworld.rows"

local counts = {}

-- Methods of the core in C that take no arguments, by class. Those that take some stay as they are: they are
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
  local plain = arguments and arguments:gsub("%b{}", "t"):gsub("%b()", "")
  if not plain or plain:find("...", 1, true) then return nil end
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

--- Returns how many arguments a method takes, or false if this is not known, and its row. Its module may not
-- be loaded yet.
function counts.of(kind, class, verb)
  local name = ("%s:%s"):format(kind == "process" and "p" or kind, verb) -- scripts call it p
  if own[name] then return false end
  if not rows.all[name] then rows.load_for(class, verb) end
  local call = rows.all[name]
  return call and count_of(call.arguments) or false, call
end

--- Raises an error, at the place of the call, for arguments beyond the first `most`. A closed object says so
-- itself. The library may give its own methods more than scripts may. Call it from the method itself.
function counts.check(self, call, most, ...)
  if not has_more(most, ...) or core.type(self) and not core.exists(self) then return end
  local level = 3
  local caller = debug.getinfo(level, "S")
  while caller and caller.what == "C" do -- pcall
    level = level + 1
    caller = debug.getinfo(level, "S")
  end
  if not (caller and place.is_ours(caller.source)) then build.call(4, refuse, call, most, ...) end
end

-- Returns a method of the core that refuses all arguments.
local function without(call, method)
  return function(self, ...)
    if has_more(0, ...) and core.exists(self) then build.call(3, refuse, call, 0, ...) end
    return build.call(3, method, self)
  end
end

--- Installs the checks of the core's methods without arguments; those of this library's methods are in
-- softworld.methods.
function counts.install()
  for kind, verbs in pairs(bare) do
    for verb in verbs:gmatch "%S+" do
      local class = core.class[kind]
      local method = class and rawget(class, verb)
      if type(method) == "function" and debug.getinfo(method, "S").what == "C" then
        class[verb] = without({ name = ("%s:%s"):format(kind, verb) }, method)
      end
    end
  end
end

return counts
