-- SPDX-License-Identifier: GPL-3.0-or-later
--- Orders that replace one under way: moves of grippers, feeds, motions. Outside a process no call waits for
-- the end of the last one, and another process may wait for what is replaced here; so an event says so.
-- @module softworld.run.replaced
local core = require "softworld.core"
local build = require "softworld.scene.build"
local place = require "softworld.place"
local process = require "softworld.run.process"
require "softworld.scene.save" -- its methods check their place and place their errors
local told = require "softworld.run.told"

local replaced = {}

local SAME_TIME = 1e-12 -- relative rounding of times in the core [-]
-- Hold or obstacle -> its last order, of each kind: a feed pays out while its guide follows a motion.
local orders = { follow = setmetatable({}, { __mode = "k" }), feed = setmetatable({}, { __mode = "k" }) }

-- True if the call at this moment was not made by a reaction or an observer, which replaces on purpose.
local function counts(scene) return process.current() or not build.data(scene).running end

local function is_later(time, scene)
  return time > scene.time + SAME_TIME * math.max(1, math.abs(scene.time))
end

--- Tells that an order replaces one that was to end at a time [s], if it has not ended; true: it has not, and
-- its end is not known. what: "gripper 'hand'"; order: "move".
function replaced.tell(scene, name, what, order, ends)
  local known = ends and ends ~= true and ends < math.huge -- a Lua function has no end
  if not ends or known and not is_later(ends, scene) or not counts(scene) then return end
  local at = place.of_caller()
  told.tell(scene, { kind = "replaced", object = name, value = known and ends - scene.time or nil,
    text = ("%s: the %s%s replaces the one under way%s%s"):format(what, order, at and " at " .. at or "",
      known and (", which was to end at t = %.4g s"):format(ends) or "",
      process.current() and "" or "; outside a process no call waits") })
end

local function scene_of(object) return (select(4, core.number(object))) end

--- Returns the last orders of a scene's holds and obstacles, for replaced.back.
function replaced.image(scene)
  local kept = {}
  for name, last in pairs(orders) do
    kept[name] = {}
    for object, order in pairs(last) do
      if scene_of(object) == scene then kept[name][object] = order end
    end
  end
  return kept
end

--- Puts them back, after a return to the moment at which they were the last ones.
function replaced.back(scene, kept)
  for name, last in pairs(replaced.image(scene)) do
    for object in pairs(last) do orders[name][object] = nil end
    for object, order in pairs(kept[name]) do orders[name][object] = order end
  end
end

-- True if a gripper has this hold: then gripper:move has told.
local function is_gripped(scene, object)
  for _, gripper in ipairs(build.data(scene).grippers) do
    for _, grip in ipairs(gripper.grips) do
      if grip.hold == object then return true end
    end
  end
  return false
end

-- Calls a method that orders a motion and returns its results. always: an order is replaced also after its
-- start; else only at the time at which it was given, when nothing of it is done.
local function watched(kind, name, always)
  local method = core.class[kind][name]
  -- Keeps the new order in mind and passes the results on.
  local function done(object, scene, begun, seconds, ...)
    local data, last, now = build.data(scene), orders[name][object], scene.time
    orders[name][object] = begun and { from = now, restores = data.restores,
      to = type(seconds) == "number" and now + seconds or -math.huge } or nil
    local counted = begun and last and last.restores == data.restores and (always or last.from == now)
    if counted and not is_gripped(scene, object) then
      replaced.tell(scene, object.name, ("%s '%s'"):format(kind == "clamp" and "hold" or kind, object.name),
        name == "feed" and "feed" or "motion", last.to)
    end
    return seconds, ...
  end
  core.class[kind][name] = function(object, ...)
    local scene = scene_of(object)
    if not scene then return method(object, ...) end -- an error
    return done(object, scene, (...) ~= nil, method(object, ...))
  end
end

watched("clamp", "follow", false)
watched("obstacle", "follow", false)
watched("clamp", "feed", true)

return replaced
