-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:remove: removes any object from a scene, with everything that belongs to it. The run's series,
-- frames and events keep what it did until then. Removed wires and objects of particles are listed in
-- build.data(scene).gone: { kind =, label =, body =, radius =, length =, segments =, edges =, time = [s] }.
-- @module softworld.scene.leave
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local stand = require "softworld.grip.stand"
local losing = require "softworld.grip.losing"
local process = require "softworld.run.process"
local rows = require "softworld.rows"

rows.calls{
  { "scene:remove", "object or name", "takes it out of the scene, with what belongs to it" },
  { "scene:forces", "", "all forces in the order made; force.held is true for those that act", "a list" },
  { "wire.present", nil, "whether it is still in its scene", "true or false" },
}

local lists = { wire = "wires", particles = "particles" }

-- Returns a new list without the object, and the object's entry. The old list stays, because lists only grow.
local function without(list, object)
  local left, entry = {}, nil
  for _, one in ipairs(list) do
    if one.object == object then entry = one else left[#left + 1] = one end
  end
  return left, entry
end

local function entry_of(kind, entry)
  local body = entry.object
  local gone = { kind = kind, label = entry.name, body = body, radius = body.radius }
  if kind == "wire" then
    gone.length, gone.segments = body.length, body.segments
  else
    gone.edges = core.edges(body)
  end
  return gone
end

local function told(scene, kind, name)
  local data = build.data(scene)
  if not data.running then return end
  data.bereft = data.bereft or not process.current() or nil
  local none = lists[kind == "object" and "particles" or kind] and #data.wires + #data.particles == 0
  scene:tell{ kind = "removed", object = name, text = ("%s '%s' is taken away%s"):format(kind, name,
    none and "; no wire is left, and the run goes on without wires" or "") }
end

local function remove_body(scene, kind, body)
  local data = build.data(scene)
  local left, entry = without(data[lists[kind]], body)
  if not entry then error(("scene:remove: '%s' was taken away already"):format(tostring(body.name)), 0) end
  local gone = entry_of(kind, entry)
  gone.time = scene.time
  core.remove_body(body) -- first: the motion of its holds may raise an error
  for _, gripper in ipairs(data.grippers) do losing.wire(gripper, body) end
  data[lists[kind]] = left
  data.gone = table.move(data.gone or {}, 1, #(data.gone or {}), 1, {})
  data.gone[#data.gone + 1] = gone
  told(scene, kind == "wire" and "wire" or "object", entry.name)
end

local function remove_gripper(scene, gripper)
  stand.check_there(gripper, 0)
  losing.begin(gripper)
  for _, tool in ipairs{ gripper.tool or false, gripper.carrier or false } do
    if tool and core.exists(tool) then core.remove_tool(tool) end
  end
  losing.all(gripper)
  gripper.left = scene.time
  told(scene, "gripper", gripper.name)
end

-- Raises an error if the object is a part of a gripper; it leaves only with the gripper.
local function check_own(scene, object)
  for _, g in ipairs(build.data(scene).grippers) do
    for _, part in ipairs(g.left and {} or g.obstacles or {}) do
      if part == object then
        error(("scene:remove: '%s' is a part of gripper '%s'; remove the gripper"):format(object.name,
          g.name), 0)
      end
    end
    for _, grip in ipairs(g.grips) do
      if grip.hold == object then
        error(("scene:remove: this is the grip of gripper '%s'; release it with gripper:release, or remove "
          .. "the gripper"):format(g.name), 0)
      end
    end
  end
end

local verbs = { obstacle = "remove", clamp = "release", join = "release", force = "release", tie = "release",
  clip = "release", channel = "release" }

local function class_of(object)
  local meta = type(object) == "table" and getmetatable(object)
  return core.type(object) or type(meta) == "table" and rawget(meta, "__name") or nil
end

-- Returns the scene of an object: of the core, or a table.
local function scene_of(object)
  if core.type(object) then return (select(4, core.number(object))) end
  return object.scene
end

local function remove(scene, object)
  if type(object) == "string" then object = scene:find(object) end
  local class = class_of(object)
  if not (lists[class] or verbs[class] or class == "gripper") then
    error(("scene:remove expects an object or its name, got %s"):format(checks.got(object)), 0)
  end
  if not rawequal(scene_of(object), scene) then
    error(("scene:remove: this %s is of another scene"):format(class), 0)
  end
  if lists[class] then return remove_body(scene, class, object) end
  if class == "gripper" then return remove_gripper(scene, object) end
  check_own(scene, object)
  if class == "obstacle" and not object.present then
    error(("scene:remove: '%s' was taken away already"):format(object.name), 0)
  end
  object[verbs[class]](object)
end

--- scene:remove(object): see help "scene:remove".
function core.class.scene.remove(scene, object)
  build.check(scene, "scene:remove", 3)
  build.call(3, remove, scene, object)
end

local leave = {}

--- Returns wires, or objects of particles, in the numbering of frames, both present and removed ones.
-- kind: "wire", "particles". { { name, radius, length, segments, edges, slot } }; slot: among all, from 0.
function leave.all(scene, kind)
  local data, list = build.data(scene), {}
  local function add(it, body)
    local _, number = core.number(body)
    it.slot = number
    list[#list + 1] = it
  end
  for _, entry in ipairs(data[lists[kind]]) do
    local it = entry_of(kind, entry)
    it.name, it.label, it.body, it.kind = it.label, nil, nil, nil
    add(it, entry.object)
  end
  for _, g in ipairs(data.gone or {}) do
    if g.kind == kind then
      add({ name = g.label, radius = g.radius, length = g.length, segments = g.segments, edges = g.edges,
        gone = g.time }, g.body)
    end
  end
  table.sort(list, function(a, b) return a.slot < b.slot end)
  return list
end

return leave
