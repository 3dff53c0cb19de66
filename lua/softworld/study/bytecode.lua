-- SPDX-License-Identifier: GPL-3.0-or-later
--- Returns a function's compiled code without line numbers. string.dump keeps them even when stripped;
-- without them a function moved within its file stays the same. Format: lundump.c of Lua 5.4.
-- @module softworld.study.bytecode
local START = "\27Lua\x54\0\x19\x93\r\n\x1a\n\4\8\8" -- of the format read here
local HEADER = #START + 8 + 8 + 1 -- followed by an integer, a number, the count of upvalues [B]

local SIZES = { [0x03] = 8, [0x13] = 8 } -- of constants: integer, number [B]
local TEXTS = { [0x04] = true, [0x14] = true }

-- Reads a number of seven bits per byte with the last byte marked. Returns it and the position after it.
local function number_at(code, at)
  local value = 0
  while true do
    local byte = code:byte(at)
    value, at = (value << 7) | (byte & 0x7f), at + 1
    if byte & 0x80 ~= 0 then return value, at end
  end
end

local function text_after(code, at)
  local size, from = number_at(code, at)
  return size == 0 and from or from + size - 1
end

local function constants_after(code, at)
  local count
  count, at = number_at(code, at)
  for _ = 1, count do
    local kind = code:byte(at)
    at = TEXTS[kind] and text_after(code, at + 1) or at + 1 + (SIZES[kind] or 0)
  end
  return at
end

local function function_after(code, at, parts)
  at = text_after(code, at) -- its source, empty
  local count, first
  for _ = 1, 2 do at = select(2, number_at(code, at)) end -- first and last line
  first = at
  count, at = number_at(code, at + 3) -- after three bytes about its frame
  at = constants_after(code, at + 4 * count)
  count, at = number_at(code, at)
  at = at + 3 * count -- upvalues
  count, at = number_at(code, at)
  parts[#parts + 1] = code:sub(first, at - 1)
  for _ = 1, count do at = function_after(code, at, parts) end
  for _ = 1, 4 do at = select(2, number_at(code, at)) end -- stripped parts
  return at
end

--- Returns the code of a Lua function as text; with line numbers for other versions of Lua.
return function(f)
  local code = string.dump(f, true)
  if code:sub(1, #START) ~= START then return code end
  local parts = {}
  local fine, last = pcall(function_after, code, HEADER + 1, parts)
  return fine and last == #code + 1 and table.concat(parts) or code
end
