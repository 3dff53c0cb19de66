-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks that methods are called on an object of their class, with no more arguments than their rows tell.
-- A call with a dot, or on another object, raises a clear error instead of failing somewhere inside the
-- library. Methods written in C check this themselves.
-- @module softworld.methods
local checks = require "softworld.checks"
local core = require "softworld.core"
local sealed = require "softworld.sealed"

local methods = {}

--- Returns the names of the fields and methods of a class, for completion at the prompt.
function methods.names(class, fields)
  local names = table.move(fields, 1, #fields, 1, {})
  for name in pairs(class) do
    if name:sub(1, 2) ~= "__" then names[#names + 1] = name end
  end
  return names
end

--- Makes the objects of a class read-only results. Scripts can read these fields and the `unnamed` ones (a
-- text of words), which completion does not list. Writing raises an error.
function methods.found(kind, class, fields, unnamed)
  local readable = checks.set(table.concat(fields, " ") .. " " .. (unnamed or ""))
  function class.__names() return methods.names(class, fields) end
  function class.__index(self, key)
    local value = readable[key] and rawget(sealed.fields(self), key)
    if value ~= nil and readable[key] then return value end
    if class[key] ~= nil then return class[key] end
    error(checks.lacks("a " .. kind, key, class.__names()), 2)
  end
  function class.__newindex(_, key)
    error(("a %s has no '%s' to set; its results can only be read"):format(kind, checks.shown(key)), 2)
  end
  methods.guard_table(kind, class)
end

local function described(value)
  local kind = core.type(value)
    or type(value) == "table" and (getmetatable(value) or {}).__name or type(value)
  return type(kind) == "string" and kind or "table"
end

-- Returns a method that checks its object and how many arguments it gets.
local function guarded(kind, class, name, method, is)
  local most, call -- learnt at the first call with arguments; false: any number
  -- The tail call keeps error levels the same as without this wrapper.
  return function(self, ...)
    if not is(self) then
      error(("%s:%s is a method: call it with a colon (%s expected, got %s)"):format(kind, name, kind,
        described(self)), 2)
    end
    if select("#", ...) > 0 then
      local counts = require "softworld.calls.counts"
      if most == nil then most, call = counts.of(kind, class, name) end
      if most and select("#", ...) > most then counts.check(self, call, most, ...) end
    end
    return method(self, ...)
  end
end

--- Guards the Lua functions of a class. is(value) is true for an object of the class.
function methods.guard(kind, class, is)
  for name, method in next, class do
    if type(name) == "string" and name:sub(1, 2) ~= "__" and type(method) == "function"
      and debug.getinfo(method, "S").what == "Lua" then
      class[name] = guarded(kind, class, name, method, is)
    end
  end
end

--- Guards a class whose objects are tables with the class as their metatable.
function methods.guard_table(kind, class)
  methods.guard(kind, class, function(value)
    return type(value) == "table" and getmetatable(value) == class
  end)
end

--- Guards all classes of the core.
function methods.guard_core()
  for kind, class in pairs(core.class) do
    methods.guard(kind, class, function(value) return core.type(value) == kind end)
  end
end

return methods
