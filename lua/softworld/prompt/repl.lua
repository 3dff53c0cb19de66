-- SPDX-License-Identifier: GPL-3.0-or-later
-- Prints results at the prompt and completes names. The host program
-- (csrc/host/repl.c) reads the lines and runs them.

local pretty = require "softworld.prompt.pretty"

local repl = {}

local function width()
  local host = package.loaded["softworld.host"]
  return host and host.columns() or 80
end

-- Returns the text of a value at the prompt. Wires, scenes and grippers show more than their tostring.
local function text_of(value)
  local more = package.loaded["softworld"] and type(value) ~= "number" and type(value) ~= "string"
    and require("softworld.prompt.portrait")(value)
  return pretty(value, { width = width() }) .. (more or "")
end

--- Prints results as the prompt does: values side by side, tables readable. `_` is then the first of them.
function repl.show(...)
  local values = table.pack(...)
  local texts, separator = {}, "\t"
  if values[1] ~= nil then _G._ = values[1] end
  for i = 1, values.n do
    texts[i] = text_of(values[i])
    if texts[i]:find("\n", 1, true) then separator = "\n" end
  end
  io.write(table.concat(texts, separator), "\n")
end

--- `?x` at the prompt: help on the value of x, else on the topic with this name.
function repl.ask(text)
  local sw = require "softworld"
  text = text:match "^%s*(.-)%s*$"
  if text == "" then return sw.help() end
  local topic = text:match "^[\"'](.*)[\"']$" or text
  local chunk = load("return " .. text, "=?", "t")
  local fine, value
  if chunk then fine, value = pcall(chunk) end
  if fine and value ~= nil and type(value) ~= "number" and type(value) ~= "function"
    and type(value) ~= "boolean" and value ~= sw then
    return sw.help(value)
  end
  sw.help(topic:match "^sw%.([%w_]+)$" or topic:match "^[%w_]+[:.]([%w_]+)$" or topic)
end

--- time(f, ...): calls f, prints how long it took, returns its results.
function repl.time(f, ...)
  local clock = package.loaded["softworld"] and package.loaded["softworld"].core.clock or os.clock
  local wall, cpu = clock(), os.clock()
  local function done(...)
    io.write(("%.4g s, %.4g s of computing\n"):format(clock() - wall, os.clock() - cpu))
    return ...
  end
  return done(f(...))
end

-- --- completion ------------------------------------------------------------

local NAME = "^[%a_][%w_]*$"

local keywords = {}
for word in ([[and break do else elseif end false for function goto if in local nil not or repeat
  return then true until while]]):gmatch "%a+" do
  keywords[word] = true
end

local function index(value, key) return value[key] end

-- Returns the value of "a.b[1]:" at the end of the text; nil if it cannot be found
-- without running calls.
local function value_before(text, globals)
  local chain = text:match "[%a_][%w_%.%[%]]*$"
  if not chain then return nil end
  local before = text:sub(1, -#chain - 1)
  if before:find "[%w_%.:%)%]\"']$" then return nil end -- the end of a longer expression
  local name, rest = chain:match "^([%w_]+)(.*)$"
  local value = globals[name]
  while rest ~= "" and value ~= nil do
    local key, after = rest:match "^%.([%a_][%w_]*)(.*)$"
    if not key then
      key, after = rest:match "^%[(%d+)%](.*)$"
      key = math.tointeger(tonumber(key))
    end
    if not key then return nil end
    local ok, inner = pcall(index, value, key)
    value, rest = ok and inner or nil, after
  end
  return value
end

local function add_fields(names, fields, methods_only)
  for key, value in next, fields do
    if type(key) == "string" and (not methods_only or type(value) == "function") then
      names[key] = true
    end
  end
end

-- Adds the names that a metamethod __names lists: properties and methods that are in no table.
local function add_listed(names, value, list)
  if type(list) == "function" then
    local ok, answer = pcall(list, value)
    list = ok and answer or nil
  end
  if type(list) ~= "table" then return end
  for _, name in ipairs(list) do
    if type(name) == "string" then names[name] = true end
  end
end

-- Returns every name that may follow value and "." or ":" (methods only).
local function names_of(value, methods_only)
  local names, seen = {}, {}
  while value ~= nil and not seen[value] do
    seen[value] = true
    if type(value) == "table" then add_fields(names, value, methods_only) end
    local meta = debug.getmetatable(value)
    if type(meta) ~= "table" then break end
    add_listed(names, value, rawget(meta, "__names"))
    value = rawget(meta, "__index")
    if type(value) == "function" then break end
  end
  return names
end

--- Returns the names that can stand for word after the text before it on the line. Within braces of a call
-- these are its parameters.
function repl.complete(before, word, globals)
  globals = globals or _G
  if package.loaded["softworld"] and before:find "[\"']$" then -- choices of a parameter, or nothing
    local choices = require("softworld.prompt.braces").choices(before:sub(1, -2), value_before, globals)
    local found = {}
    for _, name in ipairs(choices or {}) do
      if name:sub(1, #word) == word then found[#found + 1] = name end
    end
    table.sort(found)
    return found
  end
  if select(2, before:gsub("[\"']", "")) % 2 == 1 then return {} end -- within a string
  local text, mark = before:match "^(.-)%s*([%.:])%s*$"
  local names = package.loaded["softworld"]
    and require("softworld.prompt.braces").names(before, value_before, globals)
  if not names and text and not text:find "%.$" then
    local value = value_before(text, globals)
    names = value ~= nil and names_of(value, mark == ":") or {}
  end
  names = names or names_of(globals, false)
  local found = {}
  for name in pairs(names) do
    if name:sub(1, #word) == word and name:find(NAME) and not keywords[name]
      and (word ~= "" or not name:find "^__") then
      found[#found + 1] = name
    end
  end
  table.sort(found)
  return found
end

return repl
