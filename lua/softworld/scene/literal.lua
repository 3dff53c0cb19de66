-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes values as Lua source that gives the same bits again.
-- @module softworld.scene.literal
local vector = require "softworld.vector"

local literal = {}

local WIDTH = 100 -- widest line [characters]
local DEEPEST = 100 -- deepest nesting of tables

local reserved = {}
for word in ([[and break do else elseif end false for function goto if in local nil not or repeat return then
  true until while]]):gmatch "%a+" do reserved[word] = true end

--- True if the text can be written as a name.
function literal.is_name(text)
  return text:find "^[%a_][%w_]*$" ~= nil and not reserved[text]
end

--- Returns the shortest source of a number that gives the same number back.
function literal.number(x)
  if math.type(x) == "integer" then return ("%d"):format(x) end
  if x ~= x then return "(0 / 0)" end
  if x == math.huge or x == -math.huge then return x > 0 and "math.huge" or "-math.huge" end
  for digits = 15, 17 do
    local text = ("%%.%dg"):format(digits):format(x)
    if tonumber(text) == x then
      return text:find "[.e]" and text or text .. ".0" -- floats stay floats
    end
  end
end

-- Order of keys: an object's name first, then places, then the rest alphabetically.
local rank = { name = 1, kind = 2, shape = 2, model = 3, cable = 4, on = 5, s = 6, from = 7, to = 8, at = 9 }

local function sorted_keys(value, count)
  local keys = {}
  for key in next, value do
    if not (math.type(key) == "integer" and key >= 1 and key <= count) then keys[#keys + 1] = key end
  end
  table.sort(keys, function(a, b)
    local ra, rb = rank[a] or 99, rank[b] or 99
    if ra ~= rb then return ra < rb end
    return tostring(a) < tostring(b)
  end)
  return keys
end

local function key_text(key, object, path)
  if type(key) == "string" and literal.is_name(key) then return key .. " = " end
  if type(key) == "string" or type(key) == "number" or type(key) == "boolean" then
    return ("[%s] = "):format(literal.of(key, object, path))
  end
  error(("%s has a key that is a %s"):format(path, type(key)), 0)
end

-- Returns the items in one line if they fit, else in lines filled to the width.
local function in_braces(items, indent)
  if #items == 0 then return "{}" end
  local line = "{ " .. table.concat(items, ", ") .. " }"
  if #line + #indent + 20 <= WIDTH and not line:find("\n", 1, true) then return line end
  local lines, now = {}, ""
  for i, item in ipairs(items) do
    local with = item .. (i < #items and "," or "")
    if now ~= "" and (#now + 1 + #with + #indent + 2 > WIDTH or item:find("\n", 1, true)) then
      lines[#lines + 1], now = now, with
    else
      now = now == "" and with or now .. " " .. with
    end
  end
  lines[#lines + 1] = now
  return "{\n" .. indent .. "  " .. table.concat(lines, "\n" .. indent .. "  ") .. "\n" .. indent .. "}"
end

--- Returns a value as source. object(value, path) gives the source of any value that is not plain; it may
-- raise an error. path names the value in messages. Errors are texts without a place.
function literal.of(value, object, path, indent, above)
  local kind = type(value)
  if kind == "number" then return literal.number(value) end
  if kind == "string" then return (("%q"):format(value):gsub("\\\n", "\\n")) end
  if kind == "boolean" or kind == "nil" then return tostring(value) end
  if not vector.is_plain(value) then return object(value, path) end
  indent, above = indent or "", above or {}
  if above[value] then error(path .. " is a table that contains itself", 0) end
  if #indent > 2 * DEEPEST then error(path .. " is in too many tables, one inside the other", 0) end
  above[value] = true
  local items = {}
  for i, item in ipairs(value) do
    items[i] = literal.of(item, object, ("%s[%d]"):format(path, i), indent .. "  ", above)
  end
  for _, key in ipairs(sorted_keys(value, #items)) do
    local inner = ("%s.%s"):format(path, tostring(key))
    items[#items + 1] = key_text(key, object, path)
      .. literal.of(value[key], object, inner, indent .. "  ", above)
  end
  above[value] = nil
  return in_braces(items, indent)
end

return literal
