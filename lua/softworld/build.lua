-- SPDX-License-Identifier: GPL-3.0-or-later
--- What the Lua side adds when objects are made: names, mesh files, and the
-- descriptions that pictures and series need.
-- @module softworld.build
local core = require "softworld.core"
local meshfile = require "softworld.meshfile"

local build = {}
local class = core.class

-- What is known of a scene: lists of { object =, name =, ... }.
function build.data(scene)
  local data = core.data(scene)
  if not data.wires then
    data.wires, data.obstacles, data.holds = {}, {}, {}
    data.grippers, data.processes = {}, {}
  end
  return data
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

-- Names must be told apart in series and messages.
local function check_name(scene, name)
  local data = build.data(scene)
  for _, list in ipairs{ data.wires, data.obstacles, data.holds, data.grippers } do
    for _, entry in ipairs(list) do
      if entry.name == name then
        error(("scene '%s' already has something named '%s'"):format(scene.name, name), 3)
      end
    end
  end
end

local new_wire = class.scene.wire
--- scene:wire{...}: see help "wire" for the parameters.
function class.scene.wire(scene, args)
  args = table_of(args, "scene:wire")
  local data = build.data(scene)
  if args.name == nil then args.name = "wire" .. #data.wires + 1 end
  if type(args.name) == "string" then check_name(scene, args.name) end
  local wire = new_wire(scene, args)
  data.wires[#data.wires + 1] = { object = wire, name = args.name }
  core.data(wire).name = args.name
  return wire
end

local new_obstacle = class.scene.obstacle
--- scene:obstacle{ shape =, ... }: see help "obstacle". `file` reads a mesh.
function class.scene.obstacle(scene, args)
  args = table_of(args, "scene:obstacle")
  local data = build.data(scene)
  if args.file ~= nil then
    local mesh = meshfile.read(args.file)
    args.data, args.format, args.file = mesh.data, args.format or mesh.format, nil
  end
  if args.name == nil then
    args.name = tostring(args.shape or "obstacle") .. #data.obstacles + 1
  end
  if type(args.name) == "string" then check_name(scene, args.name) end
  local obstacle = new_obstacle(scene, args)
  local entry = copy(args)
  entry.object, entry.data = obstacle, nil
  if args.shape == "mesh" or args.shape == "hull" then
    entry.vertices, entry.indices = obstacle.shape:triangles()
    for i, corner in ipairs(entry.indices) do entry.indices[i] = corner - 1 end
  end
  data.obstacles[#data.obstacles + 1] = entry
  core.data(obstacle).name = args.name
  return obstacle
end

-- clamp, pin and grip
for _, kind in ipairs{ "clamp", "pin", "grip" } do
  local new_hold = class.scene[kind]
  class.scene[kind] = function(scene, wire, args)
    args = table_of(args, "scene:" .. kind)
    local data = build.data(scene)
    if args.name == nil then args.name = kind .. #data.holds + 1 end
    local hold = new_hold(scene, wire, args)
    data.holds[#data.holds + 1] =
      { object = hold, name = args.name, kind = kind, width = args.width }
    core.data(hold).name = args.name
    return hold
  end
end

return build
