-- SPDX-License-Identifier: GPL-3.0-or-later
--- Objects whose fields scripts can read but only the library can change. The fields are not in the
-- object's own table, so that assignments to existing fields reach __newindex as well.
--
--     local Gripper = { __name = "gripper" }
--     local self = sealed.new(Gripper, { name = "left" })
--     function Gripper:__index(key) return sealed.fields(self)[key] end
--     function Gripper:__newindex(key, value)
--       if not sealed.by_library() then error("...", 2) end
--       rawset(sealed.fields(self), key, value)
--     end
-- @module softworld.sealed
local place = require "softworld.place"

local sealed = {}

local held = setmetatable({}, { __mode = "k" }) -- object -> its fields
local classes = setmetatable({}, { __mode = "k" })

--- Returns a new object of the class; the table fields becomes its fields.
function sealed.new(class, fields)
  local object = {}
  classes[class], held[object] = true, fields or {}
  return setmetatable(object, class)
end

--- Returns another object of a class with sealed objects, without fields; nil for other classes.
function sealed.another(class)
  return classes[class] and sealed.new(class)
end

--- Registers a class with sealed objects before there is one.
function sealed.class(class) classes[class] = true end

--- Returns the fields, for access without metamethods. An ordinary table is returned itself.
function sealed.fields(object) return held[object] or object end

--- True if the assignment that called __newindex is in the library. Call it from __newindex itself.
function sealed.by_library()
  local info = debug.getinfo(3, "S")
  return info ~= nil and place.is_ours(info.source)
end

return sealed
