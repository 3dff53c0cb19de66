-- SPDX-License-Identifier: GPL-3.0-or-later
--- Conditions that processes wait for, given as tables.
-- @module softworld.run.conditions
local core = require "softworld.core"
local checks = require "softworld.checks"
local feeling = require "softworld.run.feeling"
local touching = require "softworld.run.touching"
local vec = require "softworld.vec"

local conditions = {}
local kinds = {}

local function number(what, value, unit, level)
  return checks.number("p:wait_until: " .. what, value, 0, unit, level)
end

local function pushes(object)
  return checks.field(object, "force") or core.type(object) == "obstacle"
    or core.type(object) == "clamp"
end

-- Raises an error if the object is in another scene, which this run does not move.
local function check_scene(object, what, level)
  local _, _, _, own = core.number(object)
  if own == nil and type(object) == "table" then own = checks.field(object, "scene") end
  if own ~= nil and own ~= conditions.scene then
    error(("p:wait_until: %s is of another scene, which this run does not move"):format(what), level)
  end
end

-- Returns why a gripper without hold and pads feels nothing, or nil. One with on_crash may grasp in that
-- function.
local function holds_nothing(object)
  if type(object) ~= "table" or object.hold or object.tool or object.on_crash then return nil end
  return ("gripper '%s' holds nothing"):format(checks.shown(object.name))
end

-- The force of a gripper or hold on its wire, or of wires on an obstacle, reaches a value.
function kinds.force(t, level)
  local least = number("force", t.force, " N", level + 1)
  if not pushes(t.on) then
    error("p:wait_until: force needs on = a gripper, hold or obstacle", level)
  end
  check_scene(t.on, "what force is on", level + 1)
  local felt, last = feeling.of(t.on, conditions.scene)
  return function() return felt() >= least end,
    least > 0 and function() return holds_nothing(t.on) end or nil,
    function(p) feeling.tell(p, { force = least, on = t.on, last = last }) end
end

-- The wire has slid a distance through a gripper's pads.
function kinds.slip(t, level)
  local least = number("slip", t.slip, " m", level + 1)
  if not checks.field(t.on, "state") then
    error("p:wait_until: slip needs on = a gripper", level)
  end
  check_scene(t.on, "the gripper", level + 1)
  return function() return t.on:state().slip >= least end, function() return holds_nothing(t.on) end
end

-- Something touches an obstacle, or has touched it since the last look.
function kinds.contact(t, level)
  if core.type(t.contact) ~= "obstacle" then
    error("p:wait_until: contact needs an obstacle, got " .. (core.type(t.contact) or type(t.contact)),
      level)
  end
  check_scene(t.contact, "the obstacle", level + 1)
  local touches, seen = touching.of(t.contact, conditions.scene)
  return touches, nil, function(p) touching.tell(p, seen) end
end

-- Returns a function that gives a place: a point, a gripper, an obstacle, { wire, s = }; and true if it is
-- fixed.
local function place_of(what, level)
  if type(what) == "table" and core.type(rawget(what, 1)) == "wire" then
    checks.only("p:wait_until: between: a place", what, { "s" }, level + 1)
    local s = number("between: s", what.s, " m", level + 1)
    check_scene(what[1], "the wire", level + 1)
    return function() return what[1]:position(s) end
  elseif checks.field(what, "position") then
    check_scene(what, "a place", level + 1)
    return function()
      return what:position() or error(("gripper '%s' has no place yet; make it with at = {x, y, z} [m], or "
        .. "grasp")
        :format(checks.shown(what.name)), 0)
    end
  elseif core.type(what) == "obstacle" or core.type(what) == "clamp" then
    check_scene(what, "a place", level + 1)
    return function() return (what:pose()) end
  end
  local point = checks.vector("p:wait_until: between: a place", what, "m", level + 1)
  return function() return point end, true
end

-- Two places come near each other.
function kinds.distance(t, level)
  local most = number("distance", t.distance, " m", level + 1)
  if type(t.between) ~= "table" or #t.between ~= 2 then
    error("p:wait_until: distance needs between = { a, b }", level)
  end
  local a, a_fixed = place_of(t.between[1], level + 1)
  local b, b_fixed = place_of(t.between[2], level + 1)
  if a_fixed and b_fixed then
    error("p:wait_until: between names two points, whose distance never changes; one of them must be a "
      .. "gripper, an obstacle, a clamp or { wire, s = }", level)
  end
  return function() return vec.norm(vec.sub(a(), b())) <= most end
end

local known = { on = true, between = true }
for kind in pairs(kinds) do known[kind] = true end

--- Returns the function for a condition given as a table, a function (or nil) that says why it cannot come
-- true as long as nobody acts, and for a force or a contact a function that tells what happened in the last
-- step, when process p goes on.
function conditions.of(t, level, scene)
  conditions.scene = scene
  checks.keys("p:wait_until", t, known, level + 1)
  local found
  for kind in pairs(kinds) do
    if t[kind] ~= nil then
      if found then error(("p:wait_until: %s or %s, not both"):format(found, kind), level) end
      found = kind
    end
  end
  if not found then error("p:wait_until: no condition; give force, slip, contact or distance", level) end
  local holds, impossible, tell = kinds[found](t, level + 1)
  return holds, impossible, tell -- no tail call, it would hide a level
end

return conditions
