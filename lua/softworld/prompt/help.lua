-- SPDX-License-Identifier: GPL-3.0-or-later
--- Help at the prompt.
--
--     help()            -- what there is
--     help "grip"       -- a page of the manual
--     help "wire"       -- parameters of scene:wire; of an obstacle, a force, a clamp, ...
--     help(scene)       -- methods of an object
--     help "press"      -- a method with all that it takes
-- @module softworld.prompt.help
local cable = require "softworld.cable"
local checks = require "softworld.checks"
local core = require "softworld.core"
local rows = require "softworld.rows"
local topics = require "softworld.prompt.topics"
local units = require "softworld.units"

-- Returns the name of a part of sw, or of a method: "load", "units", "wire:tension"; nil for other values.
local function name_of(object)
  local sw = require "softworld"
  for name, value in next, sw do
    if rawequal(value, object) then
      return topics.text("sw." .. name) and "sw." .. name or name
    end
  end
  for class, methods in pairs(type(object) == "function" and core.class or {}) do
    for verb, method in next, methods do
      local name = ("%s:%s"):format(class, verb)
      if rawequal(method, object) and rows.all[name] then return name end
    end
  end
end

-- Returns the help of all calls whose names begin so; nil if there is none.
local function functions_of(prefix)
  local texts = {}
  for _, name in ipairs(checks.sorted(rows.all)) do
    if name:sub(1, #prefix) == prefix then texts[#texts + 1] = topics.text(name) end
  end
  return texts[1] and table.concat(texts, "\n\n")
end

-- Shows sw, or a part of it; true if it is one.
local function show_part(object)
  if object == require "softworld" then
    print(topics.object "sw")
    return true
  end
  local kind = type(object)
  local name = (kind == "function" or kind == "table") and name_of(object)
  local plain = name and name:gsub("^sw%.", "")
  local text = name and (topics.text(plain) or topics.text(name) or functions_of("sw." .. plain .. "."))
  if text then print(text) end
  return text and true or false
end

local function show_object(object)
  if show_part(object) then return end
  local known = topics.object(checks.kind(object))
  if known then
    print(checks.shown(object) .. "\n" .. known)
    return
  end
  local meta = debug.getmetatable(object)
  local list = type(meta) == "table" and rawget(meta, "__names")
  local names = list and list(object) or {}
  if #names == 0 then
    for name, value in pairs(type(object) == "table" and object or {}) do
      if type(name) == "string" and type(value) == "function" then names[#names + 1] = name end
    end
  end
  table.sort(names)
  print(checks.shown(object))
  if #names > 0 then print("  " .. table.concat(names, " ")) end
end

-- Returns what a name stands for that is no topic: a cable of the catalogue, a unit; or nil.
local function other(name)
  local fine, entry = pcall(cable.get, name)
  if fine then return tostring(entry) end
  local si, times, by = units.find(name)
  if si then
    return ("sw.units.%s(x) is x times %.9g in %s; help 'units' lists all units"):format(name, times / by, si)
  end
end

return function(topic)
  if topic == nil then print(topics.overview())
  elseif type(topic) ~= "string" then show_object(topic)
  else print(topics.text(topic) or other(topic) or topics.unknown(topic)) end
end
