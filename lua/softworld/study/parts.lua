-- SPDX-License-Identifier: GPL-3.0-or-later
--- Parts of a study. Each call of a method is a part, identified by the method, the options that define it,
-- and how many equal calls came before it in the script. So another call between them changes neither what
-- the others have computed nor their random numbers. The number of evaluations, the accuracy and the place of
-- computing are not part of the name, so existing evaluations still count.
-- @module softworld.study.parts
local core = require "softworld.core"
local parameters = require "softworld.study.parameters"
local vector = require "softworld.vector"

local parts = {}

local LEFT_OUT = { workers = true, count = true, evaluations = true, each = true, tolerance = true }
local LONG = 120 -- longest text [characters]; a checksum replaces longer ones
local DEEP = 8   -- deepest nesting of tables

local shown

local function of_table(value, depth)
  local keys, texts = {}, {}
  for key in next, value do
    if type(key) == "string" or math.type(key) == "integer" then keys[#keys + 1] = key end
  end
  table.sort(keys, function(a, b)
    if type(a) == type(b) then return a < b end
    return type(a) == "number"
  end)
  for i, key in ipairs(keys) do texts[i] = ("%s=%s"):format(key, shown(value[key], depth + 1)) end
  return "{" .. table.concat(texts, " ") .. "}"
end

-- Returns a value as text, equal for equal values; for functions and objects their kind.
function shown(value, depth)
  if type(value) == "number" then return parameters.text(value) end
  if vector.is_plain(value) and depth < DEEP then
    return of_table(value, depth)
  end
  if type(value) == "string" or type(value) == "boolean" then return tostring(value) end
  return type(value)
end

--- Returns the name of a method's call without its place in the script: "sweep kind=sobol".
function parts.text(method, options)
  local left = {}
  for key, value in pairs(options) do
    if not LEFT_OUT[key] then left[key] = value end
  end
  local text = shown(left, 0):sub(2, -2)
  if #text > LONG then text = ("%016x"):format(core.checksum(text)) end
  return text == "" and method or method .. " " .. text
end

--- Returns the name of the next call.
function parts.name(own, method, options)
  local text = parts.text(method, options)
  local count = (own.counts[text] or 0) + 1
  return { text = text, count = count, full = count == 1 and text or ("%s #%d"):format(text, count) }
end

--- Returns the stream of random numbers of a part, from its name.
function parts.stream(full) return core.checksum(full) end

--- Begins a part: sets own.part to its number, and own.stream for its random numbers.
function parts.begin(own, name, method, records)
  own.counts[name.text] = name.count
  own.before = own.part
  own.part, own.stream = own.journal:part(name.full), parts.stream(name.full)
  own.asked[own.part] = { method = method, records = records, name = name.full, stream = own.stream }
  return own.part
end

--- Called when a part was interrupted, so that it can be asked for again.
function parts.leave(own, name)
  own.counts[name.text] = name.count - 1
  own.part = own.before
end

return parts
