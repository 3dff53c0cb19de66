-- SPDX-License-Identifier: GPL-3.0-or-later
--- A small, strict JSON reader of limited depth, for messages from others. Objects and arrays become tables,
-- null becomes nil.
-- @module softworld.output.jsonread
local jsonread = {}

local DEEPEST = 16

local function fail(what) error("JSON: " .. what, 0) end

local escapes = { ['"'] = '"', ["\\"] = "\\", ["/"] = "/", b = "\b", f = "\f", n = "\n", r = "\r", t = "\t" }

local function code_of(text, at)
  local hex = text:match("^%x%x%x%x", at)
  return hex and tonumber(hex, 16) or fail "a wrong \\u"
end

-- Reads one escape at the backslash `at`. Returns its text and the position after it.
local function escape(text, at)
  local kind = text:sub(at + 1, at + 1)
  if escapes[kind] then return escapes[kind], at + 2 end
  if kind ~= "u" then fail "a wrong escape" end
  local code = code_of(text, at + 2)
  if code < 0xD800 or code > 0xDFFF then return utf8.char(code), at + 6 end
  local low = code < 0xDC00 and text:sub(at + 6, at + 7) == "\\u" and code_of(text, at + 8) or 0
  if low < 0xDC00 or low > 0xDFFF then fail "half a character" end
  return utf8.char(0x10000 + (code - 0xD800) * 0x400 + low - 0xDC00), at + 12
end

local function read_string(text, at)
  local parts = {}
  while true do
    local stop = text:find('[%c"\\]', at) or fail "a string without an end"
    parts[#parts + 1] = text:sub(at, stop - 1)
    local c = text:sub(stop, stop)
    if c == '"' then return table.concat(parts), stop + 1 end
    if c ~= "\\" then fail "a control character in a string" end
    parts[#parts + 1], at = escape(text, stop)
  end
end

local function read_number(text, at)
  local word = text:match("^-?%d+%.?%d*[eE]?[+-]?%d*", at)
  local plain = word and word:match "^-?(%d+)"
  local fine = plain and (plain == "0" or plain:sub(1, 1) ~= "0") and not word:find "%.$"
    and not word:find "%.[eE]" and tonumber(word)
  if not fine or fine - fine ~= 0 then fail "a wrong number" end
  return fine, at + #word
end

local function space(text, at) return text:find("[^ \t\r\n]", at) or #text + 1 end

local read

local function read_array(text, at, depth)
  local list, count = {}, 0
  at = space(text, at)
  if text:sub(at, at) == "]" then return list, at + 1 end
  while true do
    count = count + 1
    list[count], at = read(text, at, depth)
    local c = text:sub(at, at)
    if c == "]" then return list, at + 1 end
    if c ~= "," then fail "an array without an end" end
    at = at + 1
  end
end

local function read_object(text, at, depth)
  local object = {}
  at = space(text, at)
  if text:sub(at, at) == "}" then return object, at + 1 end
  while true do
    at = space(text, at)
    if text:sub(at, at) ~= '"' then fail "a key that is no string" end
    local key, after = read_string(text, at + 1)
    at = space(text, after)
    if text:sub(at, at) ~= ":" then fail "a key without a value" end
    object[key], at = read(text, at + 1, depth)
    local c = text:sub(at, at)
    if c == "}" then return object, at + 1 end
    if c ~= "," then fail "an object without an end" end
    at = at + 1
  end
end

local words = { { "true", true }, { "false", false }, { "null", nil } }

local function read_value(text, at, depth)
  local c = text:sub(at, at)
  if c == '"' then return read_string(text, at + 1) end
  if c == "{" then return read_object(text, at + 1, depth) end
  if c == "[" then return read_array(text, at + 1, depth) end
  for _, word in ipairs(words) do
    if text:sub(at, at + #word[1] - 1) == word[1] then return word[2], at + #word[1] end
  end
  return read_number(text, at)
end

function read(text, at, depth)
  if depth > DEEPEST then fail "too deep" end
  local value
  value, at = read_value(text, space(text, at), depth + 1)
  return value, space(text, at)
end

--- Returns the value of a text; raises a text without a place, "JSON: ...".
function jsonread.decode(text)
  if not utf8.len(text) then fail "no UTF-8" end
  local value, at = read(text, 1, 0)
  if at <= #text then fail "something after its end" end
  return value
end

return jsonread
