-- SPDX-License-Identifier: GPL-3.0-or-later
--- Parts of a study: each call of a method is one, known by the method, those of its options that say what
-- it is, and how many such ones were before it in the script. So another call between them changes nothing
-- of what the others have computed, nor their random numbers. How many evaluations are wanted, how exactly
-- and who computes them is not in the name: what is there then still counts.
-- @module softworld.study.parts
local core = require "softworld.core"
local parameters = require "softworld.study.parameters"

local parts = {}

local LEFT_OUT = { workers = true, count = true, evaluations = true, each = true, tolerance = true }
local LONG = 120 -- characters, beyond which a checksum stands for it
local DEEP = 8   -- tables within tables

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

-- A value as text, the same for the same value; of functions and objects their kind.
function shown(value, depth)
  if type(value) == "number" then return parameters.text(value) end
  if type(value) == "table" and getmetatable(value) == nil and depth < DEEP then
    return of_table(value, depth)
  end
  if type(value) == "string" or type(value) == "boolean" then return tostring(value) end
  return type(value)
end

--- The name of a method's call without its place in the script: "sweep kind=sobol".
function parts.text(method, options)
  local left = {}
  for key, value in pairs(options) do
    if not LEFT_OUT[key] then left[key] = value end
  end
  local text = shown(left, 0):sub(2, -2)
  if #text > LONG then text = ("%016x"):format(core.checksum(text)) end
  return text == "" and method or method .. " " .. text
end

--- The name of the call that comes now.
function parts.name(own, method, options)
  local text = parts.text(method, options)
  local count = (own.counts[text] or 0) + 1
  return { text = text, count = count, full = count == 1 and text or ("%s #%d"):format(text, count) }
end

--- The stream of random numbers that a part has by its name.
function parts.stream(full) return core.checksum(full) end

--- Begin it: its number, in own.part; random numbers are those of own.stream.
function parts.begin(own, name, method, records)
  own.counts[name.text] = name.count
  own.before = own.part
  own.part, own.stream = own.journal:part(name.full), parts.stream(name.full)
  own.asked[own.part] = { method = method, records = records, name = name.full, stream = own.stream }
  return own.part
end

--- It was broken off, and may be asked for again.
function parts.leave(own, name)
  own.counts[name.text] = name.count - 1
  own.part = own.before
end

return parts
