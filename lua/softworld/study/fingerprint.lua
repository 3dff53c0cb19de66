-- SPDX-License-Identifier: GPL-3.0-or-later
--- Returns a checksum of what a function computes: of its code without places, and of the functions, numbers
-- and texts of the script that it uses. Comments and lines around it do not count.
-- @module softworld.study.fingerprint
local bytecode = require "softworld.study.bytecode"
local core = require "softworld.core"
local place = require "softworld.place"
local vector = require "softworld.vector"

-- Names that Lua, its libraries and the host program define.
local standard = {}
for name in pairs(_G) do standard[name] = true end
standard.arg = true

local of_function

local function add(parts, text) parts[#parts + 1] = text end

local function of_value(value, parts, seen)
  local kind = math.type(value) or type(value)
  if kind == "function" then return of_function(value, parts, seen) end
  if kind ~= "table" then
    if kind ~= "userdata" and kind ~= "thread" then
      add(parts, kind .. ":" .. (kind == "float" and ("%a"):format(value) or tostring(value)))
    end
    return
  end
  if seen[value] or not vector.is_plain(value) then return end -- objects do not count
  seen[value] = true
  local keys = {}
  for key in next, value do
    local key_kind = type(key)
    if key_kind == "string" or key_kind == "number" then keys[#keys + 1] = key end
  end
  table.sort(keys, function(a, b)
    if type(a) == type(b) then return a < b end
    return type(a) == "number"
  end)
  for _, key in ipairs(keys) do
    add(parts, "[" .. tostring(key) .. "]")
    of_value(value[key], parts, seen)
  end
end

-- Adds the script's own globals whose names are among the constants of the code.
local function of_globals(environment, code, parts, seen)
  local names = {}
  for name in next, environment do
    if type(name) == "string" and not standard[name] and code:find(name, 1, true) then
      names[#names + 1] = name
    end
  end
  table.sort(names)
  for _, name in ipairs(names) do
    add(parts, name)
    of_value(environment[name], parts, seen)
  end
end

function of_function(f, parts, seen)
  local info = debug.getinfo(f, "Su")
  if seen[f] or info.what == "C" or place.is_ours(info.source) then return end
  seen[f] = true
  local code = bytecode(f)
  add(parts, code)
  for i = 1, info.nups do
    local name, value = debug.getupvalue(f, i)
    if name == "_ENV" then
      if type(value) == "table" then of_globals(value, code, parts, seen) end
    elseif type(value) ~= "table" or package.loaded.softworld ~= value then
      of_value(value, parts, seen)
    end
  end
end

--- Returns the checksum of functions (nil for a missing one), 16 hexadecimal digits.
return function(...)
  local parts, seen = {}, {}
  for i = 1, select("#", ...) do
    local f = select(i, ...)
    add(parts, "f")
    if f then of_function(f, parts, seen) end
  end
  return ("%016x"):format(core.checksum(table.concat(parts, "\0")))
end
