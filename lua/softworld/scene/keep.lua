-- SPDX-License-Identifier: GPL-3.0-or-later
--- Turns Lua values into a string and back, for the Lua side's part of a saved scene. Numbers keep their
-- bits, and vectors stay vectors. Objects of a scene are stored by their numbers, a table that occurs several
-- times stays one table, and tables of a known class (a gripper) get their class again:
--
--     keep.class("gripper", Gripper)
--
-- An object of a known class has a `name`. If the reading script has made an object with this name, the value
-- refers to that object. Its fields are stored as they are. Functions cannot be stored.
-- @module softworld.scene.keep
local core = require "softworld.core"
local sealed = require "softworld.sealed"
local vector = require "softworld.vector"

local keep = {}
local classes, class_names = {}, {}
local DEEPEST = 150 -- deepest nesting of tables

--- Registers tables with this metatable as the class `name`.
function keep.class(name, metatable)
  classes[name], class_names[metatable] = metatable, name
end

-- --- writing ---------------------------------------------------------------------

local write -- function(out, value, path, depth)

local function fail(path, what)
  error(("%s is %s, which cannot be saved"):format(path, what), 0)
end

-- Returns the keys in a fixed order, so that equal tables give equal strings.
local function sorted_keys(value)
  local keys = {}
  for key in next, value do keys[#keys + 1] = key end
  table.sort(keys, function(a, b)
    local ta, tb = math.type(a) or type(a), math.type(b) or type(b)
    if ta ~= tb then return ta < tb end
    if ta == "boolean" then return a and not b end
    return a < b
  end)
  return keys
end

local function write_fields(out, value, path, depth)
  value = sealed.fields(value)
  for key in next, value do
    if type(key) ~= "string" and type(key) ~= "number" and type(key) ~= "boolean" then
      fail(path, "a table with a key of type " .. type(key))
    end
  end
  local keys = sorted_keys(value)
  out[#out + 1] = string.pack("<I4", #keys)
  for _, key in ipairs(keys) do
    write(out, key, path, depth)
    write(out, rawget(value, key), ("%s.%s"):format(path, tostring(key)), depth)
  end
end

local function name_of(value) return tostring(rawget(sealed.fields(value), "name") or "") end

local function write_table(out, value, path, depth)
  local number, class = out.numbers[value], nil
  if number then
    out[#out + 1] = string.pack("<c1I4", "R", number)
    return
  end
  if depth > DEEPEST then fail(path, "in too many tables, one inside the other") end
  out.count = out.count + 1
  out.numbers[value] = out.count
  local metatable, list = getmetatable(value), vector.kind(value)
  if metatable ~= nil and not list then
    class = class_names[metatable]
    if not class then
      local kind = type(metatable) == "table" and rawget(metatable, "__name")
      fail(path, type(kind) == "string" and "a " .. kind or "a table with a metatable")
    end
  end
  out[#out + 1] = class and string.pack("<c1s4s4", "C", class, name_of(value))
    or list == "vector" and "V" or list == "rotation" and "W" or "T"
  write_fields(out, value, path, depth + 1)
end

local function write_object(out, value, path)
  if rawequal(value, out.scene) then
    out[#out + 1] = "S"
    return
  end
  local class, slot, generation, scene = core.number(value)
  if not class then fail(path, "a " .. (core.type(value) or type(value))) end
  if not rawequal(scene, out.scene) then fail(path, "a " .. class .. " of another scene") end
  out[#out + 1] = string.pack("<c1s4I4I4", "O", class, slot, generation)
end

local writers = {
  ["nil"] = function(out) out[#out + 1] = "N" end,
  boolean = function(out, value) out[#out + 1] = value and "t" or "f" end,
  number = function(out, value)
    out[#out + 1] = math.type(value) == "integer" and string.pack("<c1j", "i", value)
      or string.pack("<c1d", "d", value)
  end,
  string = function(out, value) out[#out + 1] = string.pack("<c1s4", "s", value) end,
  table = write_table,
  userdata = write_object,
}

function write(out, value, path, depth)
  local writer = writers[type(value)]
  if not writer then fail(path, "a " .. type(value)) end
  writer(out, value, path, depth)
end

--- Returns the value as a string. scene: whose objects may be in it. what: its name in errors.
function keep.pack(value, scene, what)
  local out = { numbers = {}, count = 0, scene = scene }
  write(out, value, what, 0)
  return table.concat(out)
end

--- True if the value can be stored; else false and the reason.
function keep.may(value, scene, what)
  return pcall(keep.pack, value, scene, what)
end

-- --- reading ---------------------------------------------------------------------

local read -- function(from, depth) -> value

local function damaged() error("its note is damaged", 0) end

local function unpack(from, format)
  local ok, a, b, c, at = pcall(string.unpack, format, from.text, from.at)
  if not ok then damaged() end
  -- string.unpack returns the next position after the values, which are one to three
  if at == nil then if c ~= nil then at, c = c, nil else at, b = b, nil end end
  from.at = at
  return a, b, c
end

local function read_fields(from, into, depth)
  if depth > DEEPEST then damaged() end
  for _ = 1, (unpack(from, "<I4")) do
    local key = read(from, depth)
    if key == nil or key ~= key or type(key) == "table" or type(key) == "userdata" then damaged() end
    local value = read(from, depth)
    rawset(into, key, value)
  end
  return into
end

local function remember(from, value)
  from.count = from.count + 1
  from.tables[from.count] = value
  return value
end

local function list_of(from, class, depth)
  return read_fields(from, remember(from, setmetatable({}, class)), depth + 1)
end

local readers = {
  N = function() return nil end,
  t = function() return true end,
  f = function() return false end,
  i = function(from) return (unpack(from, "<j")) end,
  d = function(from) return (unpack(from, "<d")) end,
  s = function(from) return (unpack(from, "<s4")) end,
  S = function(from) return from.scene end,
  R = function(from)
    local value = from.tables[unpack(from, "<I4")]
    if value == nil then damaged() end
    return value
  end,
  O = function(from)
    local class, slot, generation = unpack(from, "<s4I4I4")
    return from.object(class, slot, generation)
  end,
  T = function(from, depth) return read_fields(from, remember(from, {}), depth + 1) end,
  V = function(from, depth) return list_of(from, core.vector, depth) end,
  W = function(from, depth) return list_of(from, core.rotation, depth) end,
  C = function(from, depth)
    local class, name = unpack(from, "<s4s4")
    if not classes[class] then
      error(("it has a %s, which this SoftWorld does not know"):format(class), 0)
    end
    local value = from.instance(class, name) or sealed.another(classes[class]) or {}
    remember(from, value)
    local fields = sealed.fields(value)
    for key in next, fields do rawset(fields, key, nil) end
    read_fields(from, fields, depth + 1)
    return setmetatable(value, classes[class])
  end,
}

function read(from, depth)
  local tag = from.text:sub(from.at, from.at)
  from.at = from.at + 1
  local reader = readers[tag]
  if not reader then damaged() end
  return reader(from, depth)
end

local function nothing() return nil end

--- Returns the value of a string, for a scene. object(class, slot, generation) gives its objects;
-- instance(class, name) gives the object of a registered class that the script has made under this name, or
-- nil. Without these two functions the string is only checked; an error names its fault.
function keep.unpack(text, scene, object, instance)
  local from = { text = text, at = 1, tables = {}, count = 0, scene = scene,
    object = object or nothing, instance = instance or nothing }
  local value = read(from, 0)
  if from.at ~= #text + 1 then damaged() end
  return value
end

-- --- in the process ----------------------------------------------------------------

-- Copies plain tables. Tables of a known class stay the same tables, and their fields are copied into `own`.
-- Records { object =, ... } never change and are not copied.
local function copy(value, seen, own)
  if type(value) ~= "table" then return value end
  if seen[value] then return seen[value] end
  local metatable, to, from = getmetatable(value), {}, value
  seen[value] = value
  if class_names[metatable] then
    own[value], from = to, sealed.fields(value)
  elseif vector.kind(value) then
    seen[value] = setmetatable(to, metatable)
  elseif metatable ~= nil or value.object ~= nil then
    return value
  else
    seen[value] = to
  end
  for key, part in next, from do to[key] = copy(part, seen, own) end
  return seen[value]
end

-- Copies the fields of a list's objects of a known class into `own`; it stays nil if there are none.
local function things(list, own, seen)
  for k = 1, #list do
    own, seen = own or {}, seen or {}
    local thing = list[k]
    copy(class_names[getmetatable(thing)] and thing or thing.fixing, seen, own)
  end
  return own, seen
end

--- Returns an image of a table's fields with everything that belongs to them, for keep.back. imaged:
-- `lists` names fields whose lists only grow; `things` names those of them that have objects of a known
-- class; `whole` names fields whose value never changes; `passing` names all of these and the fields to
-- leave out. Objects and functions are only referred to.
function keep.image(data, imaged)
  local image, own, seen = {}, nil, nil
  for i = 1, #imaged.lists do
    local list = data[imaged.lists[i]]
    image[2 * i - 1], image[2 * i] = list, #list
  end
  for i = 1, #imaged.whole do image[imaged.whole[i]] = data[imaged.whole[i]] end
  for i = 1, #imaged.things do own, seen = things(data[imaged.things[i]], own, seen) end
  for key, value in next, data do
    if not imaged.passing[key] then
      own, seen, image.rest = own or {}, seen or {}, image.rest or {}
      image.rest[key] = copy(value, seen, own)
    end
  end
  image.own = own
  return image
end

local function refill(to, from, seen)
  for key in next, to do
    if from[key] == nil then rawset(to, key, nil) end
  end
  for key, value in next, from do rawset(to, key, copy(value, seen, {})) end
end

--- Restores the table to its state at keep.image, and every object of a known class in it.
function keep.back(data, image, imaged)
  local seen, rest = {}, image.rest or {}
  for i = 1, #imaged.lists do
    local list, count = image[2 * i - 1], image[2 * i]
    if data[imaged.lists[i]] ~= list or #list ~= count then
      data[imaged.lists[i]] = table.move(list, 1, count, 1, {})
    end
  end
  for i = 1, #imaged.whole do data[imaged.whole[i]] = image[imaged.whole[i]] end
  for object in next, image.own or {} do seen[object] = object end
  for object, fields in next, image.own or {} do refill(sealed.fields(object), fields, seen) end
  for key in next, data do
    if not imaged.passing[key] and rest[key] == nil then data[key] = nil end
  end
  for key, value in next, rest do data[key] = copy(value, seen, {}) end
end

--- Returns every table of a registered class within a value: { [class .. " " .. name] = table }.
function keep.instances(value)
  local found, seen = {}, {}
  local function walk(t)
    if seen[t] then return end
    seen[t] = true
    local class = class_names[getmetatable(t)]
    if class then found[class .. " " .. name_of(t)] = t end
    for _, v in next, sealed.fields(t) do
      if type(v) == "table" then walk(v) end
    end
  end
  walk(value)
  return found
end

return keep
