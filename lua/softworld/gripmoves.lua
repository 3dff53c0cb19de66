-- SPDX-License-Identifier: GPL-3.0-or-later
--- Moves of grippers around a grasp: waiting, approaching and retreating.
-- @module softworld.gripmoves
local core = require "softworld.core"
local build = require "softworld.build"
local checks = require "softworld.checks"
local grasp = require "softworld.grasp"
local process = require "softworld.process"
local sealed = require "softworld.sealed"
local vec = require "softworld.vec"

local Moves = {}

local SPEED, SLOW = 0.2, 0.05 -- unless told [m/s]
local DISTANCE = 0.05 -- [m]

local function this_process(self, verb)
  if type(self) ~= "table" or not rawget(sealed.fields(self), "pads") then
    error(("gripper:%s is a method: call it with a colon"):format(verb), 3)
  end
  grasp.check_scene(self, 4)
  local p = process.current()
  if not p then error(("gripper:%s takes its time; call it in a process"):format(verb), 3) end
  return p
end

--- Stay for a time [s].
function Moves:wait(seconds)
  local p = this_process(self, "wait")
  checks.number("gripper:wait: seconds", seconds, 0, " s", 3)
  process.sleep_until(p, self.scene.time + seconds)
  return self
end

local function direction_of(what, value, default, level)
  local way = vec.unit(checks.vector(what .. ": direction", value or default, "-", level + 1))
  return way or error(what .. ": direction must not be zero", level)
end

local approach_keys = { s = true, distance = true, direction = true, speed = true, slow = true }

-- The point to go to: itself, or a wire's place.
local function target(self, what, args, level)
  if core.type(what) ~= "wire" then
    return checks.vector("gripper:approach: where, a wire or a point,", what, "m", level + 1)
  end
  local s = args.s
  if s == nil then
    local at = self:position()
    if not at then
      error(("gripper '%s': give s [m], the place of the wire to approach"):format(self.name), level)
    end
    s = grasp.nearest_place(what, at)
  end
  return what:position(checks.number("gripper:approach: s", s, 0, " m", level + 1, what.length))
end

--- Go to a place of a wire or a point, the last distance [m] (0.05) along direction (downwards)
-- and at the speed slow [m/s] (0.05) instead of speed (0.2). One that is nowhere yet begins
-- there. Only in a process.
function Moves:approach(where, args)
  this_process(self, "approach")
  if args == nil then args = {} end
  checks.keys("gripper:approach", args, approach_keys, 3)
  local way = direction_of("gripper:approach", args.direction, { 0, 0, -1 }, 3)
  local distance = checks.number("gripper:approach: distance", args.distance or DISTANCE, 0, " m", 3)
  local speed = checks.number("gripper:approach: speed", args.speed or SPEED, 0, " m/s", 3, nil, true)
  local slow = checks.number("gripper:approach: slow", args.slow or math.min(SLOW, speed), 0, " m/s", 3,
    nil, true)
  local goal = target(self, where, args, 3)
  local before = vec.add(goal, way, -distance)
  local here = self:position()
  if not here then
    self.at, here = before, before
    self.first_at = self.first_at or before
  end
  if vec.norm(vec.sub(before, here)) > 1e-9 then self:move{ to = before, speed = speed } end
  if distance > 1e-9 then self:move{ to = goal, speed = slow } end
  return self
end

local retreat_keys = { distance = true, direction = true, speed = true }

--- Go away: distance = [m] (0.05) along direction (upwards) at speed [m/s] (0.2).
function Moves:retreat(args)
  if args == nil then args = {} end
  checks.keys("gripper:retreat", args, retreat_keys, 3)
  local way = direction_of("gripper:retreat", args.direction, { 0, 0, 1 }, 3)
  local distance = checks.number("gripper:retreat: distance", args.distance or DISTANCE, 0, " m", 3, nil,
    true)
  local speed = checks.number("gripper:retreat: speed", args.speed or SPEED, 0, " m/s", 3, nil, true)
  return build.call(3, self.move, self, { by = vec.scale(way, distance), speed = speed })
end

return { methods = Moves }
