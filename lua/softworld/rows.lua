-- SPDX-License-Identifier: GPL-3.0-or-later
--- Parameter rows of everything that is made in Lua, like those of the core: calls, their tables of
-- parameters, results. Argument checks, help, `softworld doc`, completion within braces and the manual's
-- reference read them.
--
--     local press = rows.call("gripper:press", "{...}", "goes on until the wire pushes back", {
--       gives = "force [N], way [m], was it reached",
--       { "force", "number", "N", "push of the wire that ends it", min = 0, above = true, required = true },
--       { "speed", "number", "m/s", "of the way", min = 0, above = true, default = 0.02 },
--     })
--     local t = press:read(args) -- a copy with defaults; errors have no place, see build.call
--
-- A row: name, type, unit, one line; then default, min, max, above (min itself is not allowed), required,
-- choices, about (a function that gives a line about each), rows (of a table within), usual (the default in
-- words, where a number cannot tell it), empty (a text may be), off (false is allowed too). Types: number,
-- integer, boolean, text, name (a text on one line), choice, vector, rotation, function, table; numbers (one,
-- or a list of them), list (of = "number" checks its items), reaction (a choice or a function). Other types
-- are shown in help only; the reader checks them.
-- @module softworld.rows
local core = require "softworld.core"
local checks = require "softworld.checks"
local inherited = require "softworld.inherited"

local rows = {
  all = {},     -- name -> Call
  classes = {}, -- class -> list of its calls and fields, in order
}
local Call = {}
Call.__index = Call

local function complete(given)
  local row = { name = given[1], type = given[2], unit = given[3], doc = given[4],
    required = given.required or false }
  for key, value in pairs(given) do
    if type(key) == "string" then row[key] = value end
  end
  return row
end

--- Makes the rows of a table of parameters within another one: pads, arm, camera.
function rows.list(list)
  local self = setmetatable({ rows = {}, known = {} }, Call)
  for i, given in ipairs(list) do
    self.rows[i] = complete(given)
    self.known[given[1]] = self.rows[i]
  end
  return self
end

--- Registers a call: its name ("scene:clip" or "gripper:press"), its arguments in words, what it does, and
-- the rows of its table if it takes one. list.gives: what it returns; list.example: a line of a script;
-- list.also = "trajectory": the call also takes the core's rows of this name; the core checks their values.
function rows.call(name, arguments, doc, list)
  local self = rows.list(list or {})
  self.name, self.arguments, self.doc = name, arguments, doc
  if list then self.gives, self.example, self.also = list.gives, list.example, list.also end
  local class = name:match "^([%w_]+)[:.]"
  if class == "p" then class = "process" end -- scripts call the object p
  rows.all[name] = self
  rows.classes[class] = rows.classes[class] or {}
  table.insert(rows.classes[class], self)
  return self
end

--- Registers calls and fields that take no table: { { "clip:force", "wire", "what it is", "N" }, ... }.
function rows.calls(list)
  for _, c in ipairs(list) do rows.call(c[1], c[2], c[3], { gives = c[4], example = c.example }) end
end

-- --- checks -----------------------------------------------------------------------------

local function spaced(unit) return unit == "-" and "" or " " .. unit end

local function number(what, row, value)
  checks.number(what, value, row.min or -math.huge, spaced(row.unit), 0, row.max, row.above)
end

local function of_type(lua_type, words)
  return function(what, _, value)
    if type(value) == lua_type then return end
    error(("%s must be %s, got %s"):format(what, words, checks.got(value)), 0)
  end
end

local function choice(what, row, value)
  local known = {}
  for _, word in ipairs(row.choices) do known[word] = true end
  checks.word(what, value, known, 0)
end

local check = { number = number, choice = choice, boolean = of_type("boolean", "true or false"),
  ["function"] = of_type("function", "a function") }

function check.integer(what, row, value)
  if math.type(value) == "integer" and value >= row.min and value <= (row.max or value) then return end
  error(("%s = %s is not allowed; it must be an integer %s"):format(what, checks.got(value), row.max
    and ("from %d to %d"):format(row.min, row.max) or ("of %d or more"):format(row.min)), 0)
end

--- Raises an error for a list with a name in it, or with a hole, behind which a part of the list would be
-- lost.
function rows.whole(what, list)
  checks.only(what, list, nil, 0)
  local count = rawlen(list)
  for key in next, list do
    if math.type(key) == "integer" and key > count then count = key end
  end
  for i = 1, count do
    if rawget(list, i) == nil then
      error(("%s has %d items, but item %d is nil"):format(what, count, i), 0)
    end
  end
end

function check.list(what, row, value)
  if type(value) ~= "table" then error(("%s must be a list, got %s"):format(what, checks.got(value)), 0) end
  rows.whole(what, value)
  for i, item in ipairs(row.of == "number" and value or {}) do
    number(("%s[%d]"):format(what, i), row, item)
  end
end

function check.text(what, row, value)
  if type(value) == "string" and (value ~= "" or row.empty) then return end
  error(("%s must be a string, got %s"):format(what, checks.got(value)), 0)
end

function check.name(what, _, value) checks.name(what, value, 0, math.huge) end

function check.vector(what, row, value) return checks.vector(what, value, row.unit, 0) end

function check.rotation(what, _, value) checks.rotation(what, value, 0) end

function check.numbers(what, row, value)
  if type(value) ~= "table" then return number(what, row, value) end
  rows.whole(what, value)
  for i, item in ipairs(value) do number(("%s[%d]"):format(what, i), row, item) end
end

function check.reaction(what, row, value)
  if type(value) ~= "function" then choice(what, row, value) end
end

check["table"] = function(what, row, value)
  return row.rows and row.rows:read(value, what, what .. ".") or checks.keys(what, value, value, 0)
end

local function missing(prefix, row)
  local range = row.min and (" %s %g%s"):format(row.above and "above" or "at least", row.min,
    spaced(row.unit))
    or row.type == "vector" and (" {x, y, z} [%s]"):format(row.unit) or " " .. row.doc
  error(("%s%s is required,%s"):format(prefix, row.name, range), 0)
end

-- Returns the names that the call takes, as keys.
local function names_of(self)
  if not self.also then return self.known end
  local names = {}
  for _, list in ipairs{ self.rows, core.trajectory_parameters() } do
    for _, row in ipairs(list) do names[row.name] = true end
  end
  return names
end

--- Checks names and values of the arguments, also of those that they inherit, and returns a copy with
-- defaults. what: the owner in the message
-- about an unknown name, default the call's name; prefix: text before a name in other messages.
function Call:read(args, what, prefix)
  what = what or self.name
  prefix = prefix or what .. ": "
  local names = names_of(self)
  checks.keys(what, args, names, 0)
  args = inherited.flat(args, names)
  local copy = {}
  for key, value in pairs(args) do copy[key] = value end
  for _, row in ipairs(self.rows) do
    local value = args[row.name]
    if value ~= nil then
      local look = check[row.type]
      local read = look and not (row.off and value == false) and look(prefix .. row.name, row, value)
      if read ~= nil then copy[row.name] = read end
    elseif row.required then
      missing(prefix, row)
    elseif row.default ~= nil then
      copy[row.name] = type(row.default) == "table" and check.vector("", row, row.default) or row.default
    end
  end
  return copy
end

-- --- methods whose module is read late ------------------------------------------------------

local late = {} -- modules with rows, in the order of registration
local later = {} -- class -> name of a method -> its module
local told = {} -- modules that describe objects of the core

--- Adds methods to a class that live in a module (a table of functions) loaded at the first call.
function rows.later(class, module, names)
  late[#late + 1] = module
  later[class] = later[class] or {}
  for name in names:gmatch "%S+" do
    later[class][name] = module
    class[name] = function(...) return require(module)[name](...) end
  end
end

--- Registers modules that only describe objects of the core by rows.
function rows.told(modules)
  for module in modules:gmatch "%S+" do late[#late + 1], told[#told + 1] = module, module end
end

--- Loads the module that may have the row of a method.
function rows.load_for(class, name)
  local module = later[class] and later[class][name]
  for _, one in ipairs(module and { module } or told) do require(one) end
end

--- Loads the registered modules, for help, completion and checks. They may register more.
function rows.load()
  local i = 1
  while late[i] do
    require(late[i])
    i = i + 1
  end
end

--- Returns the rows of a call by its name, or nil.
function rows.of(name) return rows.all[name] and rows.all[name].rows end

return rows
