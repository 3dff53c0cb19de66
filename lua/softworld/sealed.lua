-- SPDX-License-Identifier: GPL-3.0-or-later
--- Objects whose fields scripts can read, and the library alone can change. The fields are not in
-- the object's own table: writing to one that there is comes to __newindex as well.
--
--     local Gripper = { __name = "gripper" }
--     local self = sealed.new(Gripper, { name = "left" })
--     function Gripper:__index(key) return sealed.fields(self)[key] end
--     function Gripper:__newindex(key, value)
--       if not sealed.by_library() then error("...", 2) end
--       rawset(sealed.fields(self), key, value)
--     end
-- @module softworld.sealed
local sealed = {}

local held = setmetatable({}, { __mode = "k" }) -- object -> its fields
local classes = setmetatable({}, { __mode = "k" })
local library = debug.getinfo(1, "S").source:match "^(.*)sealed%.lua$" or "@softworld/"

--- An object of the class. fields: becomes the object's.
function sealed.new(class, fields)
  local object = {}
  classes[class], held[object] = true, fields or {}
  return setmetatable(object, class)
end

--- Another object of a class that has sealed ones, without fields; nil for other classes.
function sealed.another(class)
  return classes[class] and sealed.new(class)
end

--- Say that a class has such objects before there is one.
function sealed.class(class) classes[class] = true end

--- The fields, to be read and written without metamethods; those of other tables are in these.
function sealed.fields(object) return held[object] or object end

--- Is the assignment that __newindex was called for one of the library?
function sealed.by_library()
  local info = debug.getinfo(3, "S")
  return info ~= nil and info.source:sub(1, #library) == library
end

return sealed
