-- SPDX-License-Identifier: GPL-3.0-or-later
--- What the Lua side adds when objects are made: names, mesh files, the
-- descriptions that pictures and series need, and what snapshots must know of it.
-- @module softworld.build
local core = require "softworld.core"
local meshfile = require "softworld.meshfile"

local build = {}
local class = core.class

--- What is known of a scene: lists of { object =, name =, ... }.
function build.data(scene)
  local data = core.data(scene)
  if not data.wires then
    data.wires, data.obstacles, data.holds = {}, {}, {}
    data.grippers, data.processes = {}, {}
    data.restores = 0 -- how often a snapshot was restored
  end
  return data
end

local function finish(level, ok, ...)
  if ok then return ... end
  local message = ...
  if type(message) ~= "string" or message:find "^[^\n]-:%d+: " then error(message, 0) end
  error(message, level)
end

--- Call f; an error of the core without a place gets that of the caller `level`
-- calls up, counted from build.call itself as in error().
function build.call(level, f, ...) return finish(level, pcall(f, ...)) end

--- Raise unless scene is one that may be changed now.
function build.check(scene, what, level)
  if core.type(scene) ~= "scene" then
    error(("%s is a method: call it with a colon, scene:%s"):format(what, what:match ":(.*)"), level)
  end
  if core.busy(scene) then
    error(("%s: scene '%s' cannot be changed from inside a step or a function of time")
      :format(what, scene.name), level)
  end
end

local function copy(t)
  local c = {}
  for k, v in pairs(t) do c[k] = v end
  return c
end

local function table_of(args, what)
  if args == nil then return {} end
  if type(args) ~= "table" then
    error(("%s takes one table of parameters, got %s"):format(what, type(args)), 3)
  end
  return copy(args)
end

local function is_taken(data, name)
  for _, list in ipairs{ data.wires, data.obstacles, data.holds, data.grippers } do
    for _, entry in ipairs(list) do
      if entry.name == name then return true end
    end
  end
  return false
end

--- The name to use: the given one, which must be new, or kind and a number.
-- Names tell objects apart in series and messages.
function build.name(scene, given, kind, count, level)
  local data = build.data(scene)
  if given == nil then
    repeat count = count + 1 until not is_taken(data, kind .. count)
    return kind .. count
  end
  if type(given) == "string" and is_taken(data, given) then
    error(("scene '%s' already has something named '%s'"):format(scene.name, given), level)
  end
  return given
end

local new_wire = class.scene.wire
--- scene:wire{...}: see help "wire" for the parameters.
function class.scene.wire(scene, args)
  build.check(scene, "scene:wire", 3)
  args = table_of(args, "scene:wire")
  local data = build.data(scene)
  args.name = build.name(scene, args.name, "wire", #data.wires, 3)
  local wire = build.call(3, new_wire, scene, args)
  data.wires[#data.wires + 1] = { object = wire, name = args.name }
  return wire
end

local new_obstacle = class.scene.obstacle
--- scene:obstacle{ shape =, ... }: see help "obstacle". `file` reads a mesh.
function class.scene.obstacle(scene, args)
  build.check(scene, "scene:obstacle", 3)
  args = table_of(args, "scene:obstacle")
  local data = build.data(scene)
  if args.file ~= nil then
    local mesh = meshfile.read(args.file)
    args.data, args.format, args.file = mesh.data, args.format or mesh.format, nil
  end
  local kind = type(args.shape) == "string" and args.shape or "obstacle"
  args.name = build.name(scene, args.name, kind, #data.obstacles, 3)
  local obstacle = build.call(3, new_obstacle, scene, args)
  local entry = copy(args)
  entry.object, entry.data = obstacle, nil
  data.obstacles[#data.obstacles + 1] = entry -- in the order of the core's, whatever fails next
  if args.shape == "mesh" or args.shape == "hull" then
    entry.vertices, entry.indices = obstacle.shape:triangles()
    for i, corner in ipairs(entry.indices) do entry.indices[i] = corner - 1 end
  end
  return obstacle
end

-- clamp, pin and grip
for _, kind in ipairs{ "clamp", "pin", "grip" } do
  local new_hold = class.scene[kind]
  class.scene[kind] = function(scene, wire, args)
    build.check(scene, "scene:" .. kind, 3)
    args = table_of(args, "scene:" .. kind)
    local data = build.data(scene)
    if kind ~= "grip" or args.name == nil then -- a gripper's holds have its name
      args.name = build.name(scene, args.name, kind, #data.holds, 3)
    end
    local hold = build.call(3, new_hold, scene, wire, args)
    data.holds[#data.holds + 1] =
      { object = hold, name = args.name, kind = kind, width = args.width }
    return hold
  end
end

local new_force = class.scene.force
--- scene:force{ kind =, on =, ... }: see help "force".
function class.scene.force(scene, args)
  build.check(scene, "scene:force", 3)
  return (build.call(3, new_force, scene, args))
end

-- --- snapshots ------------------------------------------------------------------

local new_snapshot = class.scene.snapshot
--- The scene as it is, to be restored as often as wanted. Processes are not part
-- of it: restoring ends them.
function class.scene.snapshot(scene)
  local snapshot = build.call(3, new_snapshot, scene)
  local grippers = {}
  for i, gripper in ipairs(build.data(scene).grippers) do
    grippers[i] = { gripper = gripper, state = gripper:remember() }
  end
  core.data(snapshot).grippers = grippers
  return snapshot
end

local function keep_existing(list)
  local kept = {}
  for _, entry in ipairs(list) do
    if core.exists(entry.object) then kept[#kept + 1] = entry end
  end
  return kept
end

local restore = class.scene.restore
--- Back to the snapshot, bit by bit. What was made after it is taken back.
function class.scene.restore(scene, snapshot)
  build.check(scene, "scene:restore", 3)
  local data = build.data(scene)
  if data.running then
    error(("scene:restore: a run of scene '%s' is under way"):format(scene.name), 2)
  end
  if core.type(snapshot) ~= "snapshot" then
    error("scene:restore expects a snapshot, got " .. (core.type(snapshot) or type(snapshot)), 2)
  end
  build.call(3, restore, scene, snapshot)
  data.restores = data.restores + 1
  data.holds, data.obstacles = keep_existing(data.holds), keep_existing(data.obstacles)
  for _, process in ipairs(data.processes) do process:finish() end
  data.processes = {}
  local kept = {}
  for _, gripper in ipairs(data.grippers) do gripper:recall(nil) end
  for i, saved in ipairs(core.data(snapshot).grippers or {}) do
    saved.gripper:recall(saved.state)
    kept[i] = saved.gripper
  end
  data.grippers = kept
end

return build
