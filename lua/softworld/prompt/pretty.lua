-- SPDX-License-Identifier: GPL-3.0-or-later
-- Formats values as text for people; the prompt prints with it.
--
--   pretty(value, { width = 80, items = 100 }) -> text
--
-- A table is one line if it fits, else one item per line, each item on one
-- line or summarised. Keys are sorted, metamethods other than __tostring are
-- not called, cycles are named.

local core = require "softworld.core"

local DEPTH = 4 -- deepest nesting of tables that is shown
local SORTED = 20000 -- most keys that are sorted; beyond, sorting costs more than it helps

local keywords = {}
for word in ([[and break do else elseif end false for function goto if in local nil not or repeat
  return then true until while]]):gmatch "%a+" do
  keywords[word] = true
end

local function is_name(key)
  return type(key) == "string" and key:find "^[%a_][%w_]*$" ~= nil and not keywords[key]
end

local escapes = { ["\n"] = "\\n", ["\t"] = "\\t", ["\r"] = "\\r", ["\\"] = "\\\\", ['"'] = '\\"' }

local function quote(text)
  return '"' .. text:gsub('[%c\\"\127]', function(c)
    return escapes[c] or ("\\%03d"):format(c:byte())
  end) .. '"'
end

-- Numbers inside tables have seven digits; a number alone has all of them.
local function number(value)
  if math.type(value) == "integer" then return tostring(value) end
  local text = ("%.7g"):format(value)
  return text:find "^-?%d+$" and text .. ".0" or text
end

local function text_of(value)
  local ok, text = pcall(tostring, value)
  return ok and text or ("<%s whose __tostring fails>"):format(type(value))
end

local function function_text(value)
  local info = debug.getinfo(value, "S")
  if info.what == "C" then return "function (built in)" end
  return ("function (%s:%d)"):format(info.short_src, info.linedefined)
end

-- Vectors are shown as the lists that they are: their own __tostring calls this module.
local function has_tostring(value)
  local meta = debug.getmetatable(value)
  if meta == core.vector or meta == core.rotation then return false end
  return type(meta) == "table" and rawget(meta, "__tostring") ~= nil
end

local rank = { number = 1, string = 2, boolean = 3 }

local function before(a, b)
  local ra, rb = rank[type(a)] or 4, rank[type(b)] or 4
  if ra ~= rb then return ra < rb end
  if ra <= 2 then return a < b end
  return text_of(a) < text_of(b)
end

-- Returns the length of the array part, and the other keys, sorted.
local function keys_of(t)
  local count, keys = rawlen(t), {}
  while count > 0 and rawget(t, count) == nil do count = count - 1 end
  for key in next, t do
    if not (math.type(key) == "integer" and key >= 1 and key <= count) then keys[#keys + 1] = key end
  end
  if #keys <= SORTED then table.sort(keys, before) end
  return count, keys
end

local compact

local function summary(t)
  local count, keys = keys_of(t)
  local total = count + #keys
  return ("{ %d item%s }"):format(total, total == 1 and "" or "s")
end

local function key_text(key, room, path)
  return is_name(key) and key or "[" .. compact(key, room, path) .. "]"
end

-- Returns "a = 1" for a key, "1" for an array item; nil if it is longer than room.
local function item_text(t, key, is_array, room, path)
  local label = is_array and "" or key_text(key, room, path) .. " = "
  local text = compact(rawget(t, key), room - #label, path)
  return text and #label + #text <= room and label .. text or nil, label
end

-- Returns the table as one line of at most room characters, or nil.
local function line(t, room, path)
  local count, keys = keys_of(t)
  if (count + #keys) * 3 > room then return nil end
  local parts, used = {}, 4
  for i = 1, count + #keys do
    local is_array = i <= count
    local part = item_text(t, is_array and i or keys[i - count], is_array, room - used, path)
    if not part then return nil end
    parts[i], used = part, used + #part + 2
  end
  if used - 2 > room and #parts > 0 then return nil end
  return #parts == 0 and "{}" or "{ " .. table.concat(parts, ", ") .. " }"
end

-- Returns the value in at most room characters; nil if a table or string is longer.
function compact(value, room, path)
  local kind = type(value)
  if kind == "string" then
    local text = quote(value)
    return #text <= room and text or nil
  elseif kind == "number" then
    return number(value)
  elseif kind == "function" then
    return function_text(value)
  elseif kind ~= "table" or has_tostring(value) then
    return text_of(value)
  elseif path[value] then
    return "<cycle>"
  elseif path.depth >= DEPTH then
    return next(value) == nil and "{}" or summary(value)
  end
  path[value], path.depth = true, path.depth + 1
  local text = line(value, room, path)
  path[value], path.depth = nil, path.depth - 1
  return text
end

local function shortened(value, room)
  if type(value) == "table" then return summary(value) end
  if type(value) ~= "string" then return text_of(value) end
  return quote(value:sub(1, math.max(8, room - 20))) .. (" ... %d bytes"):format(#value)
end

local function block(t, width, most)
  local count, keys = keys_of(t)
  local path = { [t] = true, depth = 1 }
  local lines = { "{" }
  local total = count + #keys
  for i = 1, math.min(total, most) do
    local is_array = i <= count
    local key = is_array and i or keys[i - count]
    local text, label = item_text(t, key, is_array, width - 3, path)
    lines[#lines + 1] = "  " .. (text or label .. shortened(rawget(t, key), width - #label)) .. ","
  end
  if total > most then lines[#lines + 1] = ("  ... %d more"):format(total - most) end
  lines[#lines + 1] = "}"
  return table.concat(lines, "\n")
end

local function pretty(value, options)
  options = options or {}
  local width = options.width or 80
  local kind = type(value)
  if kind == "function" then return function_text(value) end
  if kind ~= "table" or has_tostring(value) then return text_of(value) end
  return line(value, width, { [value] = true, depth = 1 }) or block(value, width, options.items or 100)
end

return pretty
