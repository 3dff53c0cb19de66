-- SPDX-License-Identifier: GPL-3.0-or-later
--- Observers: functions that look at a scene while it runs. They are called between two steps inside one call
-- of the core, so that the run keeps every bit. The changes they ask for are made between two calls of the
-- core.
-- @module softworld.run.observe
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local counted = require "softworld.output.number".count
local methods = require "softworld.methods"
local place = require "softworld.place"
local process = require "softworld.run.process"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local unread = require "softworld.unread"

local observe = {}
local Observer = { __name = "observer" }

local new = rows.call("scene:observe", "{...}",
  "calls a function between two steps of a run; without every and wall after each step", {
    gives = "an observer",
    example = "scene:observe { every = 0.01, call = function() print(scene.time) end }",
    { "call", "function", "-", "function that is called, with the observer", required = true },
    { "every", "number", "s", "simulated time between two calls", min = 0, above = true },
    { "wall", "number", "s", "real time between two calls", min = 0, above = true },
  })

local pause = rows.call("observer:pause", "{...}", "pauses the run; Ctrl-C ends the pause", {
  example = "observer:pause { wall = 0.5 }",
  { "wall", "number", "s", "length of the pause in real time", min = 0, required = true },
})

rows.calls{
  { "observer:stop", "reason", "ends the run after the present step; its results are valid" },
  { "observer:change", "function() ... end",
    "calls a function that may change the scene, before the next step",
    example = "observer:change(function() plane:set { friction = 0.5 } end)" },
  { "observer:remove", "", "ends its calls" },
  { "observer.scene", nil, "the scene that it observes", "a scene" },
  { "observer.every", nil, "simulated time between two calls", "s, or nil" },
  { "observer.wall", nil, "real time between two calls", "s, or nil" },
  { "observer.calls", nil, "calls of its function so far", "a number" },
}

-- scene's data -> { its observers, in the order made }
local watching = setmetatable({}, { __mode = "k" })

local function list_of(scene)
  local data = build.data(scene)
  watching[data] = watching[data] or {}
  return watching[data]
end

local function fields(self) return sealed.fields(self) end

-- --- when ---------------------------------------------------------------------------------------

-- Returns when the next observer is due: simulated time [s], time on the clock [s].
local function next_of(list)
  local at, wall = math.huge, math.huge
  for _, observer in ipairs(list) do
    local own = fields(observer)
    at, wall = math.min(at, own.at), math.min(wall, own.at_wall)
  end
  return at, wall
end

-- Sets when an observer is due next; times that a long step has passed are skipped.
local function set_next(own, now)
  own.soon = nil
  own.at = own.each and -math.huge or own.wall and math.huge or -math.huge
  if own.every and not own.each then
    local count = math.floor((now - own.from) / own.every * (1 + 1e-12) + 1e-9)
    own.at = own.from + (count + 1) * own.every
  end
  own.at_wall = own.wall and core.clock() + own.wall or math.huge
end

local SAME_TIME = 1e-12 -- of the time: the core's own rounding [-]

local function is_past(at, now) return now >= at - SAME_TIME * math.max(1, math.abs(now)) end

local function is_due(own, now) return is_past(own.at, now) or core.clock() >= own.at_wall end

-- Returns the first time after now. from: the clock's start; before now in a run that goes on from a file,
-- where the calls up to now were made before the file was written.
local function first_time(from, every, now)
  local count = math.max(1, math.floor((now - from) / every))
  for _ = 1, 2 do -- the quotient is rounded
    if is_past(from + count * every, now) then count = count + 1 end
  end
  return from + count * every
end

-- soon: calls it after the first step in any case.
local function begin(own, from, now)
  own.from = from
  own.at = (own.each or own.soon) and -math.huge or own.every and first_time(from, own.every, now)
    or own.wall and math.huge or -math.huge
  own.at_wall = own.wall and core.clock() + own.wall or math.huge
end

-- --- in a run -----------------------------------------------------------------------------------

--- Functions that are called for each run: begin(scene, args), finish(scene, ok, reason).
observe.followers = {}

local function tell(what, ...)
  for _, follower in ipairs(observe.followers) do follower[what](...) end
end

-- Keeps in mind an observer that no run was long enough for, until one is.
local function note_uncalled(scene, own)
  if own.calls > 0 or own.note or not own.every or scene.time <= own.from then return end
  if is_past(own.from + own.every, scene.time) then return end -- called before the run's file was written
  own.note = unread.note(("softworld: note: the observer%s was never called: every = %g s is longer than the "
    .. "run of '%s', %.4g s"):format(own.at_line and " at " .. own.at_line or "", own.every, scene.name,
    scene.time - own.from))
end

--- Called at the end of a run.
function observe.finish(scene, ok, reason)
  tell("finish", scene, ok, reason)
  for _, observer in ipairs(list_of(scene)) do note_uncalled(scene, fields(observer)) end
end

--- Called at the start of a run. start: times are counted from here; a run that goes on from a file began
-- before [s].
function observe.begin(scene, args, start)
  tell("begin", scene, args)
  for _, observer in ipairs(list_of(scene)) do
    local own = fields(observer)
    own.wants, own.reason = nil, nil
    begin(own, start, scene.time)
  end
end

-- Calls the observers that are due. They may make or remove others.
local function look(scene)
  local list, wanted = list_of(scene), false
  for _, observer in ipairs(table.move(list, 1, #list, 1, {})) do
    local own = fields(observer)
    if not own.gone and is_due(own, scene.time) then
      own.calls, own.inside = own.calls + 1, true
      if own.note then unread.seen(own.note) end
      local fine, message = pcall(own.call, observer)
      own.inside = nil
      if not fine then error(message, 0) end
      if not own.gone then set_next(own, scene.time) end
    end
    wanted = wanted or own.reason ~= nil or own.wants ~= nil
  end
  return wanted, next_of(list)
end

--- Returns further arguments of scene:advance: the function that looks, and when it is due; none without
-- observers.
function observe.arguments(scene)
  local list = list_of(scene)
  if #list == 0 then return end
  return function() return look(scene) end, next_of(list)
end

--- Makes the changes that observers have asked for. Returns why the run has to stop, or nil.
function observe.settle(scene)
  local reason
  local list = list_of(scene)
  for _, observer in ipairs(table.move(list, 1, #list, 1, {})) do
    local own = fields(observer)
    local wants = own.wants
    own.wants = nil
    for _, change in ipairs(wants or {}) do change() end
    reason, own.reason = reason or own.reason, nil
  end
  return reason
end

-- --- observers ------------------------------------------------------------------------------------

local function make(scene, args)
  local own = new:read(args)
  own.scene, own.calls, own.at_line = scene, 0, place.of_caller()
  begin(own, process.moment(scene), scene.time)
  local list = list_of(scene)
  list[#list + 1] = sealed.new(Observer, own)
  return list[#list]
end

local function name_of(scene) return scene.name end

--- scene:observe{ every = [s], wall = [s], call = f }: see help "scene:observe". It can be called at any
-- time, also by an observer.
function core.class.scene.observe(scene, args)
  if core.type(scene) ~= "scene" then error("scene:observe is a method: call it with a colon", 2) end
  build.call(3, name_of, scene) -- raises if the scene is closed
  return build.call(3, make, scene, args)
end

local function check_inside(self, what)
  if fields(self).inside then return end
  error(what .. " works only inside the function of the observer, while a run goes on", 3)
end

--- Ends the run with this step.
function Observer:stop(reason)
  if reason ~= nil and type(reason) ~= "string" then
    error("observer:stop expects a text, the reason, got " .. checks.got(reason), 2)
  end
  check_inside(self, "observer:stop")
  fields(self).reason = reason or "stopped by an observer"
end

--- Asks for a change, to be made before the next step.
function Observer:change(change)
  if type(change) ~= "function" then
    error("observer:change expects a function, got " .. checks.got(change), 2)
  end
  check_inside(self, "observer:change")
  local own = fields(self)
  own.wants = own.wants or {}
  own.wants[#own.wants + 1] = change
end

--- Holds the run for a time on the clock [s].
function Observer:pause(args)
  local given = build.call(3, pause.read, pause, args)
  check_inside(self, "observer:pause")
  build.call(3, core.sleep, given.wall)
end

--- Removes the observer; it is not called any more.
function Observer:remove()
  local own = fields(self)
  if own.note then unread.seen(own.note) end
  own.gone, own.wants, own.reason = true, nil, own.inside and own.reason or nil
  local list = list_of(own.scene)
  for i = #list, 1, -1 do
    if list[i] == self then table.remove(list, i) end
  end
end

local names = { "scene", "every", "wall", "calls", "stop", "change", "pause", "remove" }
local known = { scene = true, every = true, wall = true, calls = true }

--- Returns the names of methods and fields, for completion at the prompt.
function Observer.__names() return table.move(names, 1, #names, 1, {}) end

function Observer:__index(key)
  if known[key] then return rawget(fields(self), key) end
  local value = Observer[key]
  if value ~= nil then return value end
  error(checks.lacks("an observer", key, names), 2)
end

function Observer.__newindex(_, key)
  error(("an observer has no '%s' to set"):format(checks.shown(key)), 2)
end

function Observer:__tostring()
  local own, when = fields(self), {}
  if own.every then when[1] = ("every %g s"):format(own.every) end
  if own.wall then when[#when + 1] = ("every %g s on the clock"):format(own.wall) end
  return ("observer of '%s', %s, %s%s"):format(own.scene.name, #when > 0 and table.concat(when, " and ")
    or "at each step", counted(own.calls, "call"), own.gone and ", removed" or "")
end

methods.guard_table("observer", Observer)

return observe
