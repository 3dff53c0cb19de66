-- SPDX-License-Identifier: GPL-3.0-or-later
--- What is in a scene: by name (scene:find, scene:names), or as lists in the order made (scene:wires,
-- scene:obstacles, scene:grippers).
-- @module softworld.scene.find
local build = require "softworld.scene.build"
local core = require "softworld.core"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"

local class = core.class

rows.calls{
  { "scene:wires", "", "its wires, in the order made", "a list" },
  { "scene:obstacles", "", "its obstacles, in the order made, without the pads of grippers", "a list" },
  { "scene:grippers", "", "its grippers, in the order made", "a list" },
}

-- Parts of build.data that hold no objects of the scene.
local skipped = { origin = true }
for key in pairs(build.passing) do skipped[key] = true end

-- Returns all named objects, { name = object }, and the names in order. The holds of a gripper share its
-- name, so they come last.
local function named(scene)
  local objects, names, data, order = {}, {}, build.data(scene), {}
  for key, list in pairs(data) do
    if type(list) == "table" and not skipped[key] then order[#order + 1] = key end
  end
  table.sort(order, function(a, b)
    if (a == "holds") ~= (b == "holds") then return b == "holds" end
    return a < b
  end)
  for _, key in ipairs(order) do
    for _, entry in ipairs(data[key]) do
      local name = type(entry) == "table" and rawget(sealed.fields(entry), "name")
      local object = name and (getmetatable(entry) and entry or rawget(entry, "fixing")
        or rawget(entry, "object"))
      if object and not objects[name] then
        objects[name], names[#names + 1] = object, name
      end
    end
  end
  table.sort(names)
  return objects, names
end

local function name_of(scene) return scene.name end

-- Raises unless scene is a scene that has not been closed.
local function check(scene, what)
  if core.type(scene) ~= "scene" then error(what .. " is a method: call it with a colon", 3) end
  build.call(4, name_of, scene)
end

--- scene:find(name) -> the wire, obstacle, clamp, gripper, ... of this name
function class.scene.find(scene, name)
  check(scene, "scene:find")
  if type(name) ~= "string" then error("scene:find expects a name, got " .. type(name), 2) end
  local objects, names = named(scene)
  if objects[name] then return objects[name] end
  local near = core.nearest(name, names)
  error(("scene '%s' has nothing named '%s'; %s"):format(scene.name, name,
    near and ("did you mean '%s'?"):format(near)
      or #names > 0 and "it has: " .. table.concat(names, ", ") or "it is empty"), 2)
end

--- scene:names() -> the names that scene:find knows, in order
function class.scene.names(scene)
  check(scene, "scene:names")
  return (select(2, named(scene)))
end

-- Returns the set of obstacles that are parts of grippers.
local function parts_of(grippers)
  local parts = {}
  for _, g in ipairs(grippers) do
    for _, part in ipairs(g.obstacles or {}) do parts[part] = true end
  end
  return parts
end

-- Returns the objects of a list's entries for which there(object) is true.
local function objects(entries, there)
  local list = {}
  for _, entry in ipairs(entries) do
    if core.exists(entry.object) and there(entry.object) then list[#list + 1] = entry.object end
  end
  return list
end

--- scene:wires() -> its wires, in the order made; without those that were removed
function class.scene.wires(scene)
  check(scene, "scene:wires")
  return objects(build.data(scene).wires, function(w) return w.present end)
end

--- scene:obstacles() -> its obstacles, in the order made; without pads and what was removed
function class.scene.obstacles(scene)
  check(scene, "scene:obstacles")
  local data = build.data(scene)
  local parts = parts_of(data.grippers)
  return objects(data.obstacles, function(o) return o.present and not parts[o] end)
end

--- scene:grippers() -> its grippers, in the order made; without those that were removed
function class.scene.grippers(scene)
  check(scene, "scene:grippers")
  local list = {}
  for _, g in ipairs(build.data(scene).grippers) do
    if not g.left then list[#list + 1] = g end
  end
  return list
end
