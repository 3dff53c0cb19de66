-- SPDX-License-Identifier: GPL-3.0-or-later
--- Records what a script made and changed in a scene, call by call, for scene:script and scene:describe. A
-- record has { self =, method =, args = { n = }, results = { n = }, late = } of each call that returned, with
-- copied arguments; late: the call came after the first step. Calls that other library functions make, and
-- calls from within a run, are not recorded.
-- @module softworld.scene.record
local core = require "softworld.core"
local build = require "softworld.scene.build"
local inherited = require "softworld.inherited"
local trajectory = require "softworld.trajectory"
local vector = require "softworld.vector"

local record = {}

local DEEPEST = 100 -- deepest nesting of copied tables
local MOST = 20000 -- most calls of a scene; a loop that changes something at each step would fill the memory

-- Methods that make or change something. "name?" changes only if called with an argument; else it reads.
local core_methods = {
  scene = "wire particles obstacle hold wire_contact join force gripper clip "
    .. "channel tie set gravity? settle remove zone",
  wire = "remodel set_velocity", particles = "set_velocity", force = "release call_it set",
  obstacle = "follow pose? set remove", join = "release",
  clamp = "follow pose? release feed push? force_limit? drive_force? speed? set",
}
for _, hold in ipairs(core.registry().holds) do
  core_methods.scene = core_methods.scene .. " " .. hold.name
end
local table_methods = {
  gripper = "grasp release freeze thaw close_jaws open_jaws move stop move_to rotate approach retreat "
    .. "handover set",
  clip = "release", tie = "release", channel = "open close release",
}

-- scene's data -> { calls, missed = number of calls beyond MOST, made = table of sw.scene }
local logs = setmetatable({}, { __mode = "k" })
local marks = setmetatable({}, { __mode = "k" })    -- snapshot -> length of the record at that time
local made_by = setmetatable({}, { __mode = "k" })  -- trajectory -> { self =, method =, args = }
local inside = false

-- Stands for a function argument, which the record must not keep alive.
local Function = { __name = "function" }
record.a_function = setmetatable({}, Function)

-- Copies an argument, because scripts may change their tables after the call. Objects are not copied. seen:
-- table -> its copy, because tables may contain themselves.
local function copied(value, seen, depth)
  if type(value) == "function" then return record.a_function end
  if type(value) ~= "table" or depth > DEEPEST then return value end
  local flat = inherited.flat(value)
  if rawequal(flat, value) and not vector.is_plain(value) then return value end
  if seen[value] then return seen[value] end
  local copy = {}
  seen[value] = copy
  for key, item in next, flat do copy[key] = copied(item, seen, depth + 1) end
  return copy
end

local function arguments(...)
  local args, seen = table.pack(...), {}
  for i = 1, args.n do args[i] = copied(args[i], seen, 0) end
  return args
end

--- Calls f(...) without recording the calls it makes; the caller keeps them elsewhere. Errors are passed on.
function record.quietly(f, ...)
  local before = inside
  inside = true
  local function out(...)
    inside = before
    if not (...) then error((select(2, ...)), 0) end
    return select(2, ...)
  end
  return out(pcall(f, ...))
end

--- True if the scene was changed after its first step, apart from calls within `quietly`.
function record.has_late(scene)
  for _, call in ipairs(record.of(scene)) do
    if call.late then return true end
  end
  return false
end

--- Returns the record of a scene.
function record.of(scene)
  local data = build.data(scene)
  logs[data] = logs[data] or { missed = 0 }
  return logs[data]
end

--- Records the arguments a scene was made with.
function record.begin(scene, args)
  record.of(scene).made = arguments(args or {})[1]
end

--- Returns the arguments of sw.scene that the scene was made with; nil for a scene read from a file.
function record.made_as(scene) return record.of(scene).made end

--- Returns the call that made a trajectory, or nil.
function record.trajectory(object) return made_by[object] end

local function finish(scene, call, fine, ...)
  inside = false
  if not fine then error((...), 0) end
  call.results = table.pack(...)
  local log = record.of(scene)
  if #log < MOST then log[#log + 1] = call else log.missed = log.missed + 1 end
  return ...
end

-- Returns the method as if the script called it: itself if it is a Lua function, else with its errors placed
-- anew.
local function unrecorded(method)
  if debug.getinfo(method, "S").what == "Lua" then return method end
  return function(self, ...) return build.through(method, self, ...) end
end

-- Returns the plain name and a recording method. scene_of(self): the scene of self; nil if self is not such
-- an object or its scene is closed.
local function recorded(name, method, scene_of)
  local plain, other = name:gsub("%?$", ""), unrecorded(method)
  return plain, function(self, ...)
    if inside or plain ~= name and select("#", ...) == 0 then return other(self, ...) end
    local scene = scene_of(self)
    if not scene or build.data(scene).running then return other(self, ...) end
    local call = { self = self, method = plain, args = arguments(...), late = scene.time > 0 }
    inside = true
    return finish(scene, call, pcall(build.through, method, self, ...))
  end
end

local function install(class, names, scene_of)
  for name in names:gmatch "%S+" do
    local plain, method = recorded(name, class[name:gsub("%?$", "")], scene_of)
    class[plain] = method
  end
end

local function name_of(scene) return scene.name end

local function is_open(scene) return core.type(scene) == "scene" and (pcall(name_of, scene)) end

-- Returns a function that gives the scene of an object of the core, and nil for other values; the class's own
-- check reports those.
local function scene_of_core(kind)
  return function(self)
    if core.type(self) ~= kind then return nil end
    local scene = self
    if kind ~= "scene" then scene = select(4, core.number(self)) end
    return is_open(scene) and scene or nil
  end
end

local function scene_of_table(class)
  return function(self)
    return type(self) == "table" and getmetatable(self) == class and self.scene or nil
  end
end

local function follow_snapshots()
  local class = core.class.scene
  local snapshot, restore = class.snapshot, class.restore
  function class.snapshot(scene)
    local result = snapshot(scene)
    local log = record.of(scene)
    marks[result] = { count = #log, missed = log.missed }
    return result
  end
  function class.restore(scene, from, own)
    local function go(...)
      local log, mark = record.of(scene), marks[from]
      if mark then
        for i = #log, mark.count + 1, -1 do log[i] = nil end
        log.missed = mark.missed
      end
      return ...
    end
    return go(build.through(restore, scene, from, own))
  end
end

local function follow_trajectories()
  local function noted(self, method, args, object)
    if core.type(object) == "trajectory" then
      made_by[object] = { self = self, method = method, args = args }
    end
    return object
  end
  local meta = getmetatable(trajectory)
  local make = meta.__call
  meta.__call = function(self, ...)
    return noted(nil, nil, arguments(...), (build.through(make, self, ...)))
  end
  for _, name in ipairs{ "delayed", "placed", "relative" } do
    local method = core.class.trajectory[name]
    core.class.trajectory[name] = function(self, ...)
      return noted(self, name, arguments(...), (build.through(method, self, ...)))
    end
  end
end

--- Starts recording. made: classes of objects made in Lua, by name.
function record.install(made)
  for kind, names in pairs(core_methods) do install(core.class[kind], names, scene_of_core(kind)) end
  for kind, names in pairs(table_methods) do install(made[kind], names, scene_of_table(made[kind])) end
  follow_snapshots()
  follow_trajectories()
end

return record
