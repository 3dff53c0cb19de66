-- SPDX-License-Identifier: GPL-3.0-or-later
--- Shared by clips, ties and channels ("fixings"): how they are made and read, checks of arguments, and the
-- scene's list of them, which run summaries and pictures use.
-- @module softworld.link.fixing
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local keep = require "softworld.scene.keep"
local remarks = require "softworld.remarks"
local sealed = require "softworld.sealed"

local fixing = {}

--- Returns the parameters of a new fixing by its rows, and its name in messages. Errors have no place yet:
-- call it from build.call.
function fixing.arguments(scene, call, kind, args)
  remarks.on(kind, call.name, args)
  checks.keys(call.name, args, call.known, 0)
  local name = fixing.name(scene, call.name, args.name, kind)
  local what = ("%s '%s'"):format(kind, name)
  local copy = call:read(args, what)
  copy.name = name
  return copy, what
end

--- Returns the value if it is a wire of the scene, else raises an error.
function fixing.wire(scene, what, name, value)
  if core.type(value) ~= "wire" then
    error(("%s: %s must be a wire (from scene:wire), got %s"):format(what, name, checks.got(value)), 0)
  end
  build.own(scene, ("%s: %s is a wire of"):format(what, name), value)
  return value
end

--- Returns the name to use, see build.name; errors have no place yet.
function fixing.name(scene, what, given, kind)
  if given ~= nil then checks.name(what .. ": name", given, 0) end
  local ok, name = pcall(build.name, scene, given, kind, #build.data(scene).fixings, 0)
  if not ok then error(name, 0) end
  return name
end

--- Adds scene:clip and the like. make(scene, ...) takes the call's arguments and returns the fields, among
-- them name and object (the object of the core). The new fixing is put into the scene's list; its class has
-- exists(), and report(add) for the summary.
function fixing.made(class, make)
  local function new(scene, ...)
    local fields, list = make(scene, ...), build.data(scene).fixings
    fields.scene = scene
    local it = sealed.new(class, fields)
    list[#list + 1] = { fixing = it, object = fields.object, name = fields.name }
    return it
  end
  core.class.scene[class.__name] = function(scene, ...)
    build.check(scene, "scene:" .. class.__name)
    return (build.call(3, new, scene, ...))
  end
end

--- Returns the fixings that exist.
function fixing.all(scene)
  local list = {}
  for _, entry in ipairs(build.data(scene).fixings) do
    if entry.fixing:exists() then list[#list + 1] = entry.fixing end
  end
  return list
end

-- Returns an __index for fields, properties and methods. A misspelt name raises an error that proposes the
-- nearest. known: fields that may be nil.
local function reader(kind, class, properties, known)
  return function(self, key)
    local field = rawget(sealed.fields(self), key)
    if field ~= nil then return field end
    if properties[key] then return build.call(3, properties[key], self) end
    local value = class[key]
    if value ~= nil or known[key] then return value end
    error(checks.lacks(kind, key, class.__names()), 2)
  end
end

-- Returns a __newindex: only the library may set fields.
local function writer(kind, class)
  return function(self, key, value)
    if not sealed.by_library() then
      local near = core.nearest(checks.shown(key), class.__names())
      error(("%s has no '%s' to set%s"):format(kind, checks.shown(key),
        near and ("; '%s' can only be read"):format(near)
          or "; other values are given when it is made"), 2)
    end
    rawset(sealed.fields(self), key, value)
  end
end

-- Returns the names of methods and properties, for completion at the prompt.
local function names_of(class, properties)
  local names = { "name" }
  for _, list in ipairs{ class, properties } do
    for name in pairs(list) do
      if name:sub(1, 2) ~= "__" then names[#names + 1] = name end
    end
  end
  table.sort(names)
  return names
end

--- Raises an error unless the fixing still exists; errors have no place yet.
function fixing.check(self)
  if self:exists() then return end
  error(("%s '%s' was released, or taken back when a snapshot was restored"):format(
    getmetatable(self).__name, self.name), 0)
end

-- Methods that runs call on fixings that may no longer exist.
local always = { exists = true, solids = true, report = true }

-- Returns the method with a check that the fixing exists; its errors get a place.
local function method(class, name, f)
  return build.placed(function(self, add, ...)
    if not always[name] then fixing.check(self) end
    if name == "report" and type(add) ~= "function" then
      error(("%s:report: must get a function that adds a row, got %s"):format(class.__name, type(add)), 0)
    end
    return f(self, add, ...)
  end)
end

--- Returns a class whose objects have methods and properties (functions of the object). A
-- misspelt name raises an error that proposes the nearest. `own` lists fields that may be nil.
function fixing.class(kind, properties, own)
  local class = { __name = kind }
  local known = checks.set(table.concat(own or {}, " "))
  sealed.class(class)
  class.__index, class.__newindex = reader(kind, class, properties, known), writer(kind, class)
  function class.__names() return names_of(class, properties) end
  keep.class(kind, class)
  local meta = { __index = { solids = function() return {} end } } -- pictures show obstacles only
  function meta.__newindex(_, name, value)
    rawset(class, name, name:sub(1, 2) ~= "__" and method(class, name, value) or value)
  end
  return setmetatable(class, meta)
end

return fixing
