-- SPDX-License-Identifier: GPL-3.0-or-later
--- Vectors { x, y, z } and rotations { w, x, y, z } that read-outs return: lists of numbers that print as
-- such and have their items also under names.
--
--     local a, b = wire:position(0), wire:position(wire.length)
--     print(a, a.z, (b - a):norm())
--
-- A vector takes part in +, -, * and / of numbers, and has :norm(), :dot(b), :cross(b). Any list of three
-- numbers can be the other operand. The core makes these lists and keeps their metatables.
-- @module softworld.vector
local core = require "softworld.core"
local pretty = require "softworld.prompt.pretty"

local vector = {}

local Vector, Rotation = core.vector, core.rotation
local methods = {}

--- Returns "vector" or "rotation" for such a list, nil for anything else.
function vector.kind(value)
  local class = type(value) == "table" and getmetatable(value)
  return class == Vector and "vector" or class == Rotation and "rotation" or nil
end

--- True for tables that are no object: those without a metatable, vectors, and rotations.
function vector.is_plain(value)
  return type(value) == "table" and (getmetatable(value) == nil or vector.kind(value) ~= nil)
end

--- Makes a list of three or four numbers a vector or a rotation, and returns it.
function vector.of(list)
  return setmetatable(list, #list == 4 and Rotation or Vector)
end

-- Returns what an operand is, in one line.
local function got(value)
  if type(value) == "number" then return "number " .. value end
  if type(value) ~= "table" then return core.type(value) or type(value) end
  local text = pretty(value)
  return text:find "\n" and ("a list of %d items"):format(rawlen(value)) or text
end

-- Returns the items of an operand.
local function items(value, operation)
  if type(value) == "table" then
    local x, y, z = rawget(value, 1), rawget(value, 2), rawget(value, 3)
    if type(x) == "number" and type(y) == "number" and type(z) == "number" and #value == 3 then
      return x, y, z
    end
  end
  error(("%s takes vectors, lists of three numbers; got %s"):format(operation, got(value)), 3)
end

function Vector.__add(a, b)
  local x, y, z = items(a, "vector +")
  local u, v, w = items(b, "vector +")
  return vector.of{ x + u, y + v, z + w }
end

function Vector.__sub(a, b)
  local x, y, z = items(a, "vector -")
  local u, v, w = items(b, "vector -")
  return vector.of{ x - u, y - v, z - w }
end

function Vector.__mul(a, b)
  if type(a) == "number" then a, b = b, a end
  if type(b) ~= "number" then
    error("vector *: one of both must be a number; products of vectors are a:dot(b) and a:cross(b)", 2)
  end
  local x, y, z = items(a, "vector *")
  return vector.of{ b * x, b * y, b * z }
end

function Vector.__div(a, b)
  if type(b) ~= "number" then error("vector /: only a number can divide it", 2) end
  local x, y, z = items(a, "vector /")
  return vector.of{ x / b, y / b, z / b }
end

function Vector.__unm(a)
  local x, y, z = items(a, "vector -")
  return vector.of{ -x, -y, -z }
end

--- Returns the vector's length.
function methods:norm()
  local x, y, z = items(self, "vector:norm")
  return math.sqrt(x * x + y * y + z * z)
end

--- Returns the scalar product with another vector.
function methods:dot(other)
  local x, y, z = items(self, "vector:dot")
  local u, v, w = items(other, "vector:dot")
  return x * u + y * v + z * w
end

--- Returns the cross product with another vector.
function methods:cross(other)
  local x, y, z = items(self, "vector:cross")
  local u, v, w = items(other, "vector:cross")
  return vector.of{ y * w - z * v, z * u - x * w, x * v - y * u }
end

-- Gives a class names for its items. Other fields are those of an ordinary table.
local function name_items(class, places, others)
  function class.__index(list, key)
    local k = places[key]
    if k then return rawget(list, k) end
    return others[key]
  end
  function class.__newindex(list, key, value) rawset(list, places[key] or key, value) end
  class.__tostring = pretty

  -- For completion and help at the prompt.
  function class.__names()
    local names = {}
    for _, list in ipairs{ places, others } do
      for name in pairs(list) do names[#names + 1] = name end
    end
    return names
  end
end

name_items(Vector, { x = 1, y = 2, z = 3 }, methods)
name_items(Rotation, { w = 1, x = 2, y = 3, z = 4 }, {})

return vector
