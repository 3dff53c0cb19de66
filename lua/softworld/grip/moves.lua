-- SPDX-License-Identifier: GPL-3.0-or-later
--- Moves of grippers around a grasp: waiting, approaching and retreating.
-- @module softworld.grip.moves
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local stand = require "softworld.grip.stand"
local process = require "softworld.run.process"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local vec = require "softworld.vec"

local Moves = {}

local SPEED, SLOW = 0.2, 0.05 -- defaults [m/s]
local DISTANCE = 0.05 -- default [m]

local function this_process(self, verb)
  if type(self) ~= "table" or not rawget(sealed.fields(self), "pads") then
    error(("gripper:%s is a method: call it with a colon"):format(verb), 3)
  end
  stand.check_scene(self, 4)
  local what = "gripper:" .. verb
  return (build.call(3, process.within, self.scene, what, what .. " takes time; call it in a process"))
end

--- Waits for a time [s].
function Moves:wait(seconds)
  local p = this_process(self, "wait")
  checks.number("gripper:wait: seconds", seconds, 0, " s", 3)
  process.sleep_until(p, self.scene.time + seconds)
  return self
end

rows.calls{ { "gripper:wait", "seconds", "lets time pass [s]; in a process only", "the gripper" } }

local function direction_of(what, value)
  return vec.unit(value) or error(what .. ": direction must not be zero", 0)
end

local come = rows.call("gripper:approach", "place, {...}", "goes to a wire or point, slowly on the last part",
  {
  gives = "the gripper",
  { "s", "number", "m", "place along the wire", min = 0, usual = "nearest to the tool" },
  { "distance", "number", "m", "length of the last part, along direction", min = 0, default = DISTANCE },
  { "direction", "vector", "-", "direction of the last part", default = { 0, 0, -1 } },
  { "speed", "number", "m/s", "speed before the last part", min = 0, above = true, default = SPEED },
  { "slow", "number", "m/s", "speed on the last part", min = 0, above = true, usual = SLOW },
})

-- Returns the goal: the point itself, or the place of a wire.
local function target(self, what, args, level)
  if core.type(what) ~= "wire" then
    return checks.vector("gripper:approach: its target, a wire or a point,", what, "m", level + 1)
  end
  local s = args.s
  if s == nil then
    local at = self:position()
    if not at then
      error(("gripper '%s': give s [m], the place of the wire to approach"):format(self.name), level)
    end
    s = stand.nearest_place(what, at)
  end
  return what:position(checks.place("gripper:approach: s", s, what.length, level + 1))
end

--- Goes to a place of a wire or to a point, see help "gripper:approach". A gripper without a place starts at
-- the point before the goal.
function Moves:approach(where, args)
  this_process(self, "approach")
  args = come:read(args == nil and {} or args)
  local way, distance, speed = direction_of("gripper:approach", args.direction), args.distance, args.speed
  local slow = args.slow or math.min(SLOW, speed)
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

local go = rows.call("gripper:retreat", "{...}", "moves away from its present place", {
  gives = "the gripper",
  { "distance", "number", "m", "distance of the move", min = 0, above = true, default = DISTANCE },
  { "direction", "vector", "-", "direction of the move", default = { 0, 0, 1 } },
  { "speed", "number", "m/s", "speed of the move", min = 0, above = true, default = SPEED },
})

--- Goes away, see help "gripper:retreat".
function Moves:retreat(args)
  args = go:read(args == nil and {} or args)
  local way = direction_of("gripper:retreat", args.direction)
  return build.call(3, self.move, self, { by = vec.scale(way, args.distance), speed = args.speed })
end

--- Moves the tool's centre to a point: move_to({x, y, z}, { speed =, rotation =, ... }).
function Moves:move_to(point, args)
  local t = {}
  if args ~= nil and type(args) ~= "table" then
    error("gripper:move_to takes a point and a table of parameters", 2)
  end
  for k, v in pairs(args or {}) do t[k] = v end
  t.to = point
  return self:move(t)
end

rows.calls{
  { "gripper:move_to", "point, {...}", "moves to a point [m], as gripper:move", "the gripper" },
  { "gripper:handover", "gripper, {...}", "the other gripper grasps (see gripper:grasp), then this one lets "
    .. "go",
    "the other gripper" },
}

--- Hands the wire over: the other gripper takes hold with args (see grasp), then this one lets go.
function Moves:handover(other, args)
  if getmetatable(other) ~= getmetatable(self) then
    error("gripper:handover expects the gripper that takes over", 2)
  end
  if not self.wire then error(("gripper '%s' holds nothing to hand over"):format(self.name), 2) end
  if other == self then error(("gripper '%s' cannot hand over to itself"):format(self.name), 2) end
  local wires = {}
  for i, grip in ipairs(self.grips) do wires[i] = grip.wire end
  build.call(3, other.grasp, other, #wires == 1 and wires[1] or wires, args)
  build.call(3, self.release, self)
  return other
end

return { methods = Moves }
