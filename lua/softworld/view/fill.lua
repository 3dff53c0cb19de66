-- SPDX-License-Identifier: GPL-3.0-or-later
--- Turns a filled-in form from a page into a line of Lua. The line consists of checked numbers, words from
-- lists of choices, and texts in quotes. Nothing else of a message gets into it, except function bodies if
-- the view's user allows them.
-- @module softworld.view.fill
local checks = require "softworld.checks"
local functions = require "softworld.view.functions"
local kinds = require "softworld.view.kinds"
local literal = require "softworld.scene.literal"

local fill = {}

local LONGEST = 200 -- longest text [B]
local MOST = 2000 -- most numbers or points in a list
local MOST_SEGMENTS = 20000 -- most segments of a wire made by a form

local function fail(text, ...) error(text:format(...), 0) end

-- --- reading ---------------------------------------------------------------------------------------

local function number(what, value)
  if type(value) ~= "number" or value - value ~= 0 then
    fail("%s must be a finite number, got %s", what, checks.got(value))
  end
  return value
end

local function list(what, value, least, most)
  if type(value) ~= "table" or getmetatable(value) ~= nil or #value < least or #value > most then
    fail("%s must be a list of %s, got %s", what, least == most and least or ("%d to %d"):format(least, most),
      type(value) == "table" and ("one of %d"):format(#value) or checks.got(value))
  end
  for key in next, value do
    if math.type(key) ~= "integer" or key < 1 or key > #value then fail("%s must be a list", what) end
  end
  return value
end

local function numbers(what, value, least, most)
  local copy = {}
  for k, x in ipairs(list(what, value, least, most)) do copy[k] = number(("%s[%d]"):format(what, k), x) end
  return copy
end

local read = {}

function read.number(what, _, value) return number(what, value) end

function read.integer(what, field, value)
  local whole = math.tointeger(number(what, value))
  if not whole then fail("%s = %s is not allowed; it must be an integer", what, checks.got(value)) end
  if field.name == "segments" and whole > MOST_SEGMENTS then
    fail("%s = %d is too large for a form; at most %d", what, whole, MOST_SEGMENTS)
  end
  return whole
end

function read.boolean(what, _, value)
  if type(value) ~= "boolean" then fail("%s must be true or false, got %s", what, checks.got(value)) end
  return value
end

function read.text(what, _, value)
  if type(value) ~= "string" or #value > LONGEST then fail("%s must be a short text", what) end
  return value
end

-- Reads a file name without a folder, so that no other place can be reached.
function read.file(what, field, value)
  value = read.text(what, field, value)
  if not value:find "^[%w_][%w_ .-]*$" then
    fail("%s must be the name of a file without a folder, got %s", what, checks.got(value))
  end
  return value
end

function read.choice(what, field, value)
  if type(value) ~= "string" then fail("%s must be a word, got %s", what, checks.got(value)) end
  local known = {}
  for _, word in ipairs(field.choices) do known[word] = true end
  return checks.word(what, value, known, 0)
end

function read.vector(what, _, value) return numbers(what, value, 3, 3) end

function read.rotation(what, _, value)
  if type(value) ~= "table" or value.axis == nil then return numbers(what, value, 4, 4) end
  return { axis = numbers(what .. ".axis", value.axis, 3, 3), angle = number(what .. ".angle", value.angle) }
end

function read.numbers(what, _, value) return numbers(what, value, 1, MOST) end

function read.points(what, _, value)
  local copy = {}
  for k, p in ipairs(list(what, value, 1, MOST)) do copy[k] = numbers(("%s[%d]"):format(what, k), p, 3, 3) end
  return copy
end

function read.object(what, _, value)
  if type(value) ~= "string" or value == "" or #value > LONGEST then fail("%s must be a name", what) end
  return value
end

read["function"] = functions.read

local function read_all(what, known, values)
  if type(values) ~= "table" or getmetatable(values) ~= nil then fail("%s: values is not a table", what) end
  checks.keys(what, values, known, 0)
  local copy = {}
  for key, value in next, values do
    local field = known[key]
    copy[key] = read[field.type](("%s.%s"):format(what, key), field, value)
  end
  return copy
end

read["table"] = function(what, field, value)
  local known = {}
  for _, inner in ipairs(field.rows) do known[inner.name] = inner end
  return read_all(what, known, value)
end

--- Returns the kind of a message and a checked copy of its values. Errors are texts without a place. may: Lua
-- functions are accepted.
function fill.read(class, name, values, may)
  local kind = kinds.of(class, name)
  if not kind then fail("there is no %s '%s'", checks.shown(class), checks.shown(name)) end
  if kind.lua and not may then error(functions.REFUSED, 0) end
  local known = {}
  for key, field in pairs(kind.known) do known[key] = field end
  if kind.on then known._on = { type = "object" } end
  if kind.self == "gripper" then known._by = { type = "object" } end
  return kind, read_all(kind.kind, known, values)
end

--- Raises an error unless numbers and words are in their ranges, with the words of the object itself.
function fill.check(kind, values, prefix)
  for _, field in ipairs(kind.fields or kind.rows) do
    local value, what = values[field.name], ("%s: %s"):format(prefix or kind.kind, field.name)
    if value == nil and field.required then
      fail("%s is required%s", what, field.unit ~= "-" and (" [%s]"):format(field.unit) or "")
    end
    if value ~= nil and (field.type == "number" or field.type == "integer") then
      checks.number(what, value, field.min or -math.huge, field.unit == "-" and "" or " " .. field.unit, 0,
        field.max, field.above)
    end
    if value ~= nil and field.type == "table" then fill.check(field, value, what) end
  end
end

--- Returns the names of the objects that values refer to: { name, ... }.
function fill.names(kind, values)
  local names = {}
  if kind.on then names[#names + 1] = values._on end
  if kind.self == "gripper" then names[#names + 1] = values._by end
  for _, field in ipairs(kind.fields) do
    if field.type == "object" then names[#names + 1] = values[field.name] end
  end
  return names
end

--- Returns the values with one name replaced by another.
function fill.renamed(kind, values, old, new)
  local copy = {}
  for key, value in pairs(values) do
    local field = kind.known[key]
    local is_name = key == "_on" or key == "_by" or field and field.type == "object"
    copy[key] = is_name and value == old and new or value
  end
  return copy
end

-- --- writing ---------------------------------------------------------------------------------------

local Word = {} -- source text that is inserted as it is

local function flat(points)
  local all = {}
  for _, p in ipairs(points) do table.move(p, 1, 3, #all + 1, all) end
  return all
end

local function source(value)
  return literal.of(value, function(word) return word.text end, "value")
end

fill.source = source

--- Returns the line of Lua that makes the object or does the step, without `local name =`. word(name): source
-- of the object with this name. p: the process.
function fill.line(kind, values, word)
  if kind.write then
    return kind.write(values, function(name) return setmetatable({ text = word(name) }, Word) end, source)
  end
  local args, self = {}, "scene"
  for key, value in pairs(kind.set or {}) do
    if value ~= "rod" then args[key] = value end
  end
  for key, value in pairs(values) do
    local field = kind.known[key]
    if field and key ~= kind.bare then
      if field.type == "object" then value = setmetatable({ text = word(value) }, Word) end
      args[key] = field.flat and flat(value) or value
    end
  end
  if kind.self == "gripper" then self = word(values._by or fail("%s: which gripper?", kind.kind)) end
  if kind.self == "p" then self = "p" end
  local call = ("%s:%s"):format(self, kind.method)
  if kind.bare then return ("%s(%s)"):format(call, source(values[kind.bare])) end
  if kind.on then
    local on = word(values._on or fail("%s: on which %s?", kind.kind, kind.on))
    return ("%s(%s%s)"):format(call, on, next(args) and ", " .. source(args) or "")
  end
  if kind.class == "step" and not next(args) then return call .. "()" end
  return ("%s %s"):format(call, source(args))
end

--- Returns a name for an object without one: its kind and a number; taken(name): true if the name exists.
function fill.name(kind, taken)
  local word, count = kind.class == "wire" and "wire" or kind.kind, 1
  while taken(word .. count) do count = count + 1 end
  return word .. count
end

--- True if objects of the kind have a name.
function fill.has_name(kind) return kind.known.name ~= nil end

return fill
