-- SPDX-License-Identifier: GPL-3.0-or-later
--- A function's compiled code without the numbers of its lines, which string.dump writes even where it leaves
-- everything else of the source away: moved within its file it is the same. Format: lundump.c of Lua 5.4.
-- @module softworld.study.bytecode
local START = "\27Lua\x54\0\x19\x93\r\n\x1a\n\4\8\8" -- of what is read here
local HEADER = #START + 8 + 8 + 1 -- with an integer, a number, the count of upvalues [B]

local SIZES = { [0x03] = 8, [0x13] = 8 } -- of constants: integer, number
local TEXTS = { [0x04] = true, [0x14] = true }

-- A number of seven bits a byte, the last one marked; and the place after it.
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
  at = text_after(code, at) -- its source: nothing
  local count, first
  for _ = 1, 2 do at = select(2, number_at(code, at)) end -- its first and last line
  first = at
  count, at = number_at(code, at + 3) -- after three bytes on its frame
  at = constants_after(code, at + 4 * count)
  count, at = number_at(code, at)
  at = at + 3 * count -- upvalues
  count, at = number_at(code, at)
  parts[#parts + 1] = code:sub(first, at - 1)
  for _ = 1, count do at = function_after(code, at, parts) end
  for _ = 1, 4 do at = select(2, number_at(code, at)) end -- what is left away
  return at
end

--- The code of a Lua function as text; of another version of Lua with its lines.
return function(f)
  local code = string.dump(f, true)
  if code:sub(1, #START) ~= START then return code end
  local parts = {}
  local fine, last = pcall(function_after, code, HEADER + 1, parts)
  return fine and last == #code + 1 and table.concat(parts) or code
end
