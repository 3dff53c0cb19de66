-- SPDX-License-Identifier: GPL-3.0-or-later
--- A small JSON writer; its numbers read back to the same bits.
-- @module softworld.output.json

local letters = require "softworld.output.letters"
local sink = require "softworld.output.sink"

local json = {}

local marker = {} -- metatable of tables that are written as objects even if empty

--- Marks a table as an object, so that an empty one is written {} and not [].
-- @tparam table value
-- @treturn table the same table
function json.object(value)
  return setmetatable(value, marker)
end

local short = { ['"'] = '\\"', ["\\"] = "\\\\", ["\n"] = "\\n", ["\r"] = "\\r", ["\t"] = "\\t" }

local function escape(char)
  return short[char] or string.format("\\u%04x", char:byte())
end

--- Returns a string in JSON quotes.
-- @tparam string text UTF-8, or else taken as Latin-1
-- @treturn string
function json.string(text)
  return '"' .. letters.utf8(text):gsub('[%c"\\\127]', escape) .. '"'
end

local encode

local function encode_array(value, write, path)
  local count = 0
  for _ in pairs(value) do count = count + 1 end
  if count > #value then sink.fail("JSON: a table with both a sequence and named fields") end
  write "["
  for i = 1, #value do
    if i > 1 then write "," end
    encode(value[i], write, path)
  end
  write "]"
end

local function encode_object(value, write, path)
  local keys = {}
  for key in pairs(value) do
    if type(key) ~= "string" then sink.fail("JSON: a key of type %s beside names", type(key)) end
    keys[#keys + 1] = key
  end
  table.sort(keys)
  write "{"
  for i, key in ipairs(keys) do
    if i > 1 then write "," end
    write(json.string(key))
    write ":"
    encode(value[key], write, path)
  end
  write "}"
end

local function encode_table(value, write, path)
  if path[value] then sink.fail("JSON: a table that contains itself") end
  path[value] = true
  local as_array = getmetatable(value) ~= marker and (#value > 0 or next(value) == nil)
  if as_array then encode_array(value, write, path) else encode_object(value, write, path) end
  path[value] = nil
end

function encode(value, write, path)
  local kind = type(value)
  if kind == "number" then
    local finite = value == value and value ~= math.huge and value ~= -math.huge
    write(finite and sink.number(value) or "null")
  elseif kind == "string" then
    write(json.string(value))
  elseif kind == "boolean" then
    write(tostring(value))
  elseif kind == "nil" then
    write "null"
  elseif kind == "table" then
    encode_table(value, write, path)
  else
    sink.fail("JSON: a %s cannot be written", kind)
  end
end

--- Writes a value piece by piece.
-- Sequences become arrays, other tables objects with sorted keys; an empty
-- table is an array unless marked by json.object. NaN and infinities have no
-- form in JSON and become null.
-- @param value nil, boolean, number, string or table
-- @tparam function write called with one string at a time
function json.write(value, write)
  encode(value, write, {})
end

--- Returns a value as JSON text; see json.write.
-- @param value nil, boolean, number, string or table
-- @treturn string
function json.encode(value)
  local parts, n = {}, 0
  json.write(value, function(text) n = n + 1; parts[n] = text end)
  return table.concat(parts)
end

return json
