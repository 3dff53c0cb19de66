-- SPDX-License-Identifier: GPL-3.0-or-later
--- Where a gripper's move goes: the trajectory of gripper:move's arguments. Errors have no place, see
-- build.call.
-- @module softworld.grip.target
local build = require "softworld.scene.build"
local core = require "softworld.core"
local inherited = require "softworld.inherited"
local trajectory = require "softworld.trajectory"

local target = {}

local own_keys = { path = true, points = true, to = true, by = true, rotation = true, scale = true,
  on_slip = true } -- not of trajectories, or read here
local targets = { "by", "to", "points", "path", "func" }

-- Raises an error for arguments that contradict one another, or would be left out in silence.
local function check(args)
  local given
  for _, key in ipairs(targets) do
    if args[key] ~= nil then
      if given then error(("gripper:move: give %s or %s, not both"):format(given, key), 0) end
      given = key
    end
  end
  if type(args.path) == "function" then
    error("gripper:move: path is a file or way-points; a function is given as func", 0)
  end
  if args.rotation ~= nil and args.to == nil then
    error("gripper:move: rotation goes with to; way-points have rotations of their own", 0)
  end
  if args.scale ~= nil and type(args.path) ~= "string" then
    error("gripper:move: scale goes with a path that names a file; sw.units.mm converts way-points", 0)
  end
  if args.by and args.relative == false then
    error("gripper:move: by is relative to the present place; to is not", 0)
  end
  if args.to and args.relative then
    error("gripper:move: to is a place of the scene; by is relative to the present place", 0)
  end
end

-- Returns the way-points with the present place in front, unless they begin there or have times.
local function from_here(points, times, here)
  local first = points[1]
  local x, y, z = first.x or first[1], first.y or first[2], first.z or first[3]
  local numbers = type(x) == "number" and type(y) == "number" and type(z) == "number"
  local gap = numbers and ((x - here[1]) ^ 2 + (y - here[2]) ^ 2 + (z - here[3]) ^ 2) ^ 0.5 or 0
  if gap <= 1e-9 or first.t or times then return points end
  return table.move(points, 1, #points, 2, { here }) -- a copy: the caller's table stays as it is
end

-- Returns the trajectory's table for a move from the present pose.
local function table_of(args, here, facing)
  local t = {}
  for k, v in pairs(inherited.flat(args)) do
    if not own_keys[k] then t[k] = v end
  end
  here.rotation = facing
  local points = args.points or args.path
  if type(points) == "string" then points = trajectory.read(points, args.scale) end
  if args.to then
    local to = args.to
    to.rotation = args.rotation
    points = { here, to }
  elseif args.by then
    points, t.relative = { { 0, 0, 0 }, args.by }, true
  elseif not points and t.turn then
    points, t.relative = { { 0, 0, 0 }, { 0, 0, 0 } }, true
  elseif type(points) == "table" and type(points[1]) == "table" and not t.relative then
    points = from_here(points, t.times, here)
  end
  t.points = points
  return t
end

-- Returns the words for a move by or to that goes nowhere: the script has no way-points.
local function nowhere(args)
  local key = args.to and "to" or "by"
  local what = key == "to" and "is the place where it is" or "moves nowhere"
  local x, y, z = table.unpack(args[key])
  return ("gripper:move: %s = (%g, %g, %g) m %s; leave the move out, or let it stay with gripper:wait")
    :format(key, x, y, z, what)
end

--- Returns the trajectory of a move from a pose; errors name the move.
function target.motion(args, here, facing)
  check(args)
  local fine, result = pcall(core.trajectory, table_of(args, here, facing))
  if fine then return result end
  if type(result) ~= "string" then error(result, 0) end
  if (args.to or args.by) and result:find("repeats the one before it", 1, true) then
    error(nowhere(args), 0)
  end
  error((build.plain(result):gsub("^trajectory: ", "gripper:move: ", 1)), 0)
end

return target
