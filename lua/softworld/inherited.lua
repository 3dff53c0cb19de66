-- SPDX-License-Identifier: GPL-3.0-or-later
--- Parameters that a table inherits by the __index of its metatable: scripts make variants of a table so, as
-- setmetatable({ speed = 0.2 }, { __index = usual }). The core reads them in the same way. Objects, whose
-- metatables have a __name, inherit none.
-- @module softworld.inherited
local core = require "softworld.core"
local vector = require "softworld.vector"

local inherited = {}

local words = { "shape", "file", "cable", "stiffness", "use", "model" } -- of Lua, beside the core's rows
local found = {} -- name of a list of rows, or "all" -> names, as keys

-- Returns the names of parameters in a list of the core, or in all of its lists.
local function names_of_core(which)
  if found[which] then return found[which] end
  local names, registry = {}, core.registry()
  local function add(list)
    for _, row in ipairs(list) do names[row.name] = true end
  end
  for _, word in ipairs(words) do names[word] = true end
  for name, list in pairs(registry.params) do
    if which == "all" or which == name then add(list) end
  end
  for _, kind in ipairs{ "forces", "shapes", "holds" } do
    for _, entry in ipairs(which == "all" and registry[kind] or {}) do add(entry.params) end
  end
  found[which] = names
  return names
end

-- Returns what a table inherits from: a table, a function, or nil.
local function base_of(t)
  local meta = debug.getmetatable(t)
  if type(meta) ~= "table" or type(rawget(meta, "__name")) == "string" then return nil end
  return rawget(meta, "__index")
end

local function get(t, key) return t[key] end

-- True if an inherited field is meant as a parameter: metamethods and methods of a class may be in the same
-- table.
local function is_field(key, value, names)
  if type(value) == "function" then return names[key] end
  return not (type(key) == "string" and key:sub(1, 2) == "__")
end

-- Raises an error if a function gives parameters: what else it would give cannot be checked. It may raise an
-- error for names that it does not know.
local function refuse(what, args, names, taken)
  local given = {}
  for name in pairs(names) do
    local fine, value = pcall(get, args, name)
    if fine and value ~= nil and not taken[name] then given[#given + 1] = name end
  end
  if #given == 0 then return end
  table.sort(given)
  error(("%s: %s %s from a function, the __index of a metatable; write %s into the table, or into one that "
    .. "it inherits from"):format(what, table.concat(given, ", "), #given == 1 and "comes" or "come",
    #given == 1 and "it" or "them"), 0)
end

--- Returns a plain table with a table's own fields and those it inherits from tables. names: those of the
-- parameters, as keys; or the name of a list of the core; nil: all of its lists. what: the call in the error
-- about parameters that a function gives; nil: functions are left out. Any other value, and a table that
-- inherits nothing, is returned itself.
function inherited.flat(args, names, what)
  local base = type(args) == "table" and base_of(args)
  if not base then return args end
  local flat, taken, seen = {}, {}, {}
  if type(names) ~= "table" then names = names_of_core(names or "all") end
  for key, value in next, args do flat[key], taken[key] = value, true end
  while type(base) == "table" and not seen[base] do
    seen[base] = true
    for key, value in next, base do
      if not taken[key] and is_field(key, value, names) then flat[key] = value end
      taken[key] = true
    end
    base = base_of(base)
  end
  local by_function = base and type(base) ~= "table" and not vector.kind(args)
  if what and by_function then refuse(what, args, names, taken) end
  return flat
end

--- Same, but a table that inherits nothing is copied.
function inherited.copy(args, names, what)
  local flat = inherited.flat(args, names, what)
  if not rawequal(flat, args) then return flat end
  local copy = {}
  for key, value in next, args do copy[key] = value end
  return copy
end

return inherited
