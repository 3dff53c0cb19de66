-- SPDX-License-Identifier: GPL-3.0-or-later
--- Completes names of parameters within the braces of a call, at the end of a line being typed:
-- `hand:press{ fo`, `scene:gripper{ pads = { wi`. The names come from the rows that check the arguments.
-- @module softworld.prompt.braces
local checks = require "softworld.checks"
local core = require "softworld.core"
local rows = require "softworld.rows"

local braces = {}

local loaded = false

-- Call -> names of the core's row tables for its arguments.
local of_core = { ["scene:wire"] = { "wire", "section", "wire_mesh" },
  ["wire:remodel"] = { "remodel", "wire_mesh" },
  ["scene:run"] = { "run" }, ["scene:settle"] = { "settle" }, ["wire:frequencies"] = { "frequencies" },
  ["scene:wire_contact"] = { "wire_contact" }, ["scene:particles"] = { "particles" },
  ["scene:join"] = { "join" }, ["scene:obstacle"] = { "obstacle" }, ["sw.scene"] = { "scene" },
  ["sw.calibrate"] = { "calibrate" }, ["tune.minimise"] = { "minimise" } }
-- Call -> arguments that only the Lua side reads.
local in_lua = { ["scene:force"] = { { name = "kind" }, { name = "on" } },
  ["scene:obstacle"] = { { name = "file" } },
  ["scene:wire"] = { { name = "cable" }, { name = "stiffness" }, { name = "use" } } }
-- Calls whose further arguments depend on one of them: that argument, and the registry its word is looked up
-- in.
local chosen = { ["scene:obstacle"] = { "shape", "shapes" }, ["scene:force"] = { "kind", "forces" } }

local function named(list, name)
  for _, entry in ipairs(list) do
    if entry.name == name then return entry.params or {} end
  end
  return {}
end

-- Returns the row tables of a call; text: what stands in its braces so far.
local function tables_of(call, text)
  local r, list = core.registry(), {}
  local own = rows.all[call]
  list[1] = own and own.rows or {}
  list[2] = in_lua[call]
  if call == "sw.trajectory" or own and own.also then list[#list + 1] = core.trajectory_parameters() end
  for _, name in ipairs(of_core[call] or {}) do list[#list + 1] = r.params[name] end
  if chosen[call] then
    local word = text:match(chosen[call][1] .. "%s*=%s*[\"']([%w_]+)")
    list[#list + 1] = named(r[chosen[call][2]], word)
  end
  list[#list + 1] = named(r.holds, call:match "^scene:(.*)$")
  return list
end

-- Returns the brackets that are open at the end of the text, outside strings: { { "{", place }, ... }.
local function open_brackets(text)
  local stack, quote, i = {}, nil, 1
  while i <= #text do
    local c = text:sub(i, i)
    if quote then
      if c == "\\" then i = i + 1 elseif c == quote then quote = nil end
    elseif c == '"' or c == "'" then quote = c
    elseif c:find "[{(%[]" then stack[#stack + 1] = { c, i }
    elseif c:find "[})%]]" then stack[#stack] = nil
    end
    i = i + 1
  end
  return not quote and stack or {}
end

-- Returns the call, the keys that lead to the innermost braces, and where the call's braces begin.
local function call_before(text)
  local stack, keys = open_brackets(text), {}
  for level = #stack, 1, -1 do
    local bracket, place = stack[level][1], stack[level][2]
    if bracket ~= "{" then return nil end
    local before = text:sub(1, place - 1)
    local key = before:match "([%a_][%w_]*)%s*=%s*$"
    if not key then
      local outer = stack[level - 1]
      if outer and outer[1] == "(" then before = text:sub(1, outer[2] - 1) end
      return before:match "^%s*(.-)%s*$", keys, place
    end
    table.insert(keys, 1, key)
  end
end

local function name_of(chain, value_before, globals)
  local object, mark, method = chain:match "^(.*)([:%.])([%a_][%w_]*)$"
  local value = object and value_before(object, globals)
  if value == nil then return nil end
  if value == package.loaded["softworld"] then return "sw." .. method end
  if mark == "." and type(value) == "table" and value == rawget(package.loaded["softworld"] or {},
  "tune") then
    return "tune." .. method
  end
  local kind = checks.kind(value)
  return mark == ":" and (kind == "process" and "p" or kind) .. ":" .. method or nil
end

-- Returns all rows whose key can stand at the end of the text (nil: none can), the call, and whether the text
-- ends in the call's own braces.
local function rows_at(text, value_before, globals)
  if not text:find "[{,]%s*$" then return nil end
  if not loaded then rows.load() end
  loaded = true
  local chain, keys, place = call_before(text)
  local call = chain and name_of(chain, value_before, globals)
  if not call then return nil end
  local all
  for _, list in ipairs(tables_of(call, text:sub(place))) do
    for _, key in ipairs(keys) do
      local inner
      for _, row in ipairs(list) do inner = row.name == key and row.rows and row.rows.rows or inner end
      list = inner or {}
    end
    for _, row in ipairs(list) do
      all = all or {}
      all[#all + 1] = row
    end
  end
  return all, call, #keys == 0
end

--- Returns a set of names of parameters, or nil where none can stand. value_before: the prompt's look-up of
-- names.
function braces.names(text, value_before, globals)
  local list = rows_at(text, value_before, globals)
  if not list then return nil end
  local names = {}
  for _, row in ipairs(list) do names[row.name] = true end
  return names
end

-- Returns the words that name members of a registry or entries of the catalogue.
local function members(call, key)
  local family = chosen[call]
  local list = {}
  local registry = family and family[1] == key and family[2]
    or (call == "scene:wire" or call == "wire:remodel") and key == "model" and "models"
  if registry then
    for _, entry in ipairs(core.registry()[registry]) do
      if not entry.inner then list[#list + 1] = entry.name end
    end
  elseif call == "scene:wire" and key == "cable" then
    list = package.loaded["softworld"].cable.list()
  end
  return list
end

--- Returns the words that can stand in quotes at the end of the text, `scene:wire{ model = `, or nil.
function braces.choices(text, value_before, globals)
  local before, key = text:match "^(.*[{,]%s*)([%a_][%w_]*)%s*=%s*$"
  if not before then return nil end
  local list, call, outermost = rows_at(before, value_before, globals)
  for _, row in ipairs(list or {}) do
    if row.name == key and row.choices then return row.choices end
  end
  return list and outermost and members(call, key) or nil
end

return braces
