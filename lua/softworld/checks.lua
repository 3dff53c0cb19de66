-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks of users' arguments: known keys, numbers in range, vectors. Levels count as in error(), from the
-- function that calls the check.
-- @module softworld.checks
local core = require "softworld.core"
local inherited = require "softworld.inherited"

local checks = {}

--- Returns the text of any value, also of an object whose __tostring fails.
function checks.shown(value)
  local fine, text = pcall(tostring, value)
  return fine and text or "a " .. type(value)
end

local shown = checks.shown

--- True if Ctrl-C raised this error. The core's mark may be gone by then, so the text decides as well; the
-- text of stock Lua ends in "!".
function checks.is_interrupt(message)
  if core.interrupted() then return true end
  if type(message) ~= "string" then return false end
  return (message:find "^interrupted!?$" or message:find ": interrupted!?$") ~= nil
end

local function names_of(known)
  local names = {}
  for name in pairs(known) do names[#names + 1] = shown(name) end
  table.sort(names)
  return names
end

--- Returns the keys of a table in order; by: the comparison of table.sort.
function checks.sorted(set, by)
  local keys = {}
  for key in pairs(set) do keys[#keys + 1] = key end
  table.sort(keys, by)
  return keys
end

--- Comparison for `sorted`: orders keys of any type by their shown text.
function checks.by_text(a, b) return shown(a) < shown(b) end

--- Returns the words of a text as a set: { word = true, ... }.
function checks.set(text)
  local set = {}
  for word in text:gmatch "%S+" do set[word] = true end
  return set
end

--- Returns the kind of a value: the class of an object (a table or a userdata), else its Lua type.
function checks.kind(value)
  local meta = type(value) == "table" and getmetatable(value)
  local name = type(meta) == "table" and rawget(meta, "__name")
  return type(name) == "string" and name or core.type(value) or type(value)
end

--- Raises an error unless args is a table whose keys are all known, also those that it inherits.
function checks.keys(what, args, known, level)
  if checks.kind(args) ~= "table" then
    error(("%s takes one table of parameters, got %s"):format(what, checks.kind(args)), level)
  end
  local fine, flat = pcall(inherited.flat, args, known, what)
  if not fine then error(flat, level) end
  for key in pairs(flat) do
    if not known[key] then
      local names = names_of(known)
      local near = core.nearest(shown(key), names)
      error(("%s: there is no parameter '%s'; %s"):format(what, shown(key), near
        and ("did you mean '" .. near .. "'?") or "known are: " .. table.concat(names, " ")), level)
    end
  end
end

--- Raises an error for a key of a table that is a text and none of these names (a list of words; none: the
-- table is a plain list). The n of table.pack may be there.
function checks.only(what, list, names, level)
  local function known(key)
    for _, name in ipairs(names or {}) do
      if name == key then return true end
    end
    return key == "n"
  end
  for key in next, list do
    if type(key) == "string" and not known(key) then
      if not names then error(("%s is a list; it has no field '%s'"):format(what, key), level) end
      local near = #key > 1 and core.nearest(key, names) -- any letter is near to x
      error(("%s has no field '%s'; %s"):format(what, key, near and ("did you mean '%s'?"):format(near)
        or "known are: " .. table.concat(names, " ")), level)
    end
  end
end

--- Returns the message about a field that does not exist: it proposes the nearest of these names, else
-- `else_says`, else lists all of them.
function checks.lacks(what, key, names, else_says)
  local near = core.nearest(shown(key), names)
  return ("%s has no '%s'; %s"):format(what, shown(key), near and ("did you mean '%s'?"):format(near)
    or else_says or "it has: " .. table.concat(names, " "))
end

--- Returns an __index for results that have these fields (a text of words), and a function that lists the
-- fields for completion. Reading any other field raises an error that names the nearest; may_lack: words
-- that may be nil.
function checks.fields(what, fields, may_lack)
  local names, silent = {}, checks.set(may_lack or "")
  for word in fields:gmatch "%S+" do names[#names + 1] = word end
  return function(_, key)
    if silent[key] then return nil end
    error(checks.lacks(what, key, names), 2)
  end, function() return table.move(names, 1, #names, 1, {}) end
end

local LONGEST = 32 -- longest text that a message quotes [characters]

--- Returns a wrong value as messages show it: 3 m, '3', a table. unit: with a space in front.
function checks.got(value, unit)
  local kind = checks.kind(value)
  if value ~= value then return "nan" .. (unit or "") end -- C prints it as -nan
  if kind == "number" then return ("%.9g%s"):format(value, unit or "") end
  if kind == "nil" then return kind end
  if kind == "string" then
    return #value <= LONGEST and not value:find "%c" and ("'%s'"):format(value) or "a string"
  end
  return (kind:find "^[aeiou]" and "an " or "a ") .. kind
end

--- Raises an error unless value is a number from low to high (default: any); above: low itself is not
-- allowed.
function checks.number(what, value, low, unit, level, high, above)
  local fine = type(value) == "number" and value >= low and value - value == 0
    and not (above and value == low) and not (high and value > high)
  if fine then return value end
  local any = low == -math.huge
  local range = any and "finite" or ("%s %g%s"):format(above and "above" or "at least", low, unit)
  if value == math.huge and not high then range = "finite and " .. range end
  if high then range = ("%s and at most %g%s"):format(range, high, unit) end
  if value == nil then error(("%s is required, %s"):format(what, range), level) end
  error(("%s = %s is not allowed; it must be %s%s"):format(what, checks.got(value, unit),
    type(value) == "number" and "" or any and "a number that is " or "a number ", range), level)
end

--- Returns the arc length s if it is on a wire of this length, else raises an error. By rounding a wire may
-- be shorter by 1e-17 m than it was drawn; s is then its end.
function checks.place(what, s, length, level)
  local beyond = type(s) == "number" and s > length and s <= length * (1 + 1e-9)
  return (checks.number(what, beyond and length or s, 0, " m", level + 1, length)) -- (): keeps the level
end

--- Returns value if it is one of the words in known (a table with them as keys), else raises an error.
function checks.word(what, value, known, level)
  if known[value] then return value end
  local names = names_of(known)
  local near = type(value) == "string" and core.nearest(value, names)
  error(("%s = '%s' is not one of: %s%s"):format(what, shown(value), table.concat(names, " "),
    near and ("; did you mean '%s'?"):format(near) or ""), level)
end

local function index(t, key) return t[key] end

--- Returns t[key], or nil if t is no table or reading the field raises an error, as objects do.
function checks.field(t, key)
  if type(t) ~= "table" then return nil end
  local there, value = pcall(index, t, key)
  return there and value or nil
end

local LONGEST_NAME = 63 -- of objects, as in the core [B]

-- Returns words for a character that breaks lines of tables, CSV files and messages.
local function unfit(char)
  local words = { ["\0"] = "a zero byte", ["\n"] = "a line end", ["\r"] = "a line end", ["\t"] = "a tab" }
  return words[char] or ("the control character %d"):format(char:byte())
end

--- Raises an error unless value may be a name: a text on one line that is not empty. longest: [B], default
-- that of names of objects; math.huge: any length. The core says the same of its own names.
function checks.name(what, value, level, longest)
  longest = longest or LONGEST_NAME
  if type(value) ~= "string" then
    error(("%s must be a string, got %s"):format(what, checks.got(value)), level)
  end
  if value == "" then error(what .. " must not be empty", level) end
  local place = value:find "%c"
  if place then
    error(("%s has %s, at place %d; it must be one line without such characters"):format(what,
      unfit(value:sub(place, place)), place), level)
  end
  if #value > longest then
    error(("%s is too long; at most %d bytes, got %d"):format(what, longest, #value), level)
  end
end

--- Returns the name of a part of an object, such as of a gripper's finger; a long name is cut, with its
-- checksum to keep it the only one of this name.
function checks.part_name(name, ending)
  if #name + #ending <= LONGEST_NAME then return name .. ending end
  local sum = ("~%04x"):format(core.checksum(name) & 0xffff)
  local cut = name:sub(1, LONGEST_NAME - #ending - #sum):gsub("[\xc0-\xff][\x80-\xbf]*$", "")
  return cut .. sum .. ending
end

local axes, turns = { "x", "y", "z" }, { "w", "x", "y", "z", "axis", "angle" }
local FARTHEST = 1e100 -- largest coordinate of a place, as in the core [m]

local function check_count(what, value, count, level)
  if type(value) == "table" and rawlen(value) > count then
    error(("%s must have %d numbers, got %d"):format(what, count, rawlen(value)), level)
  end
end

--- Returns a copy of the vector {x, y, z}, or raises an error. Coordinates of places [m] are within 1e100 m.
function checks.vector(what, value, unit, level)
  local copy = {}
  if type(value) == "table" then checks.only(what, value, axes, level > 0 and level + 1 or 0) end
  check_count(what, value, 3, level > 0 and level + 1 or 0)
  for k, axis in ipairs(axes) do
    local v = checks.field(value, k) or checks.field(value, axis)
    if type(v) ~= "number" or v - v ~= 0 then
      local got = type(value) ~= "table" and checks.got(value) or ("%s as item %d"):format(checks.got(v), k)
      error(("%s must be a table of 3 finite numbers [%s], got %s"):format(what, unit, got), level)
    end
    if unit == "m" and math.abs(v) > FARTHEST then
      error(("%s: %s = %g m is not allowed; it must be in [%g, %g] m"):format(what, axis, v, -FARTHEST,
        FARTHEST), level)
    end
    copy[k] = v
  end
  return copy
end

--- Raises an error unless value is a rotation: { w, x, y, z }, or { axis = {x, y, z}, angle = [rad] }.
function checks.rotation(what, value, level)
  if type(value) == "table" then checks.only(what, value, turns, level > 0 and level + 1 or 0) end
  if checks.field(value, "axis") then
    local axis = checks.vector(what .. ".axis", value.axis, "-", level + 1)
    if axis[1] == 0 and axis[2] == 0 and axis[3] == 0 then
      error(what .. ".axis must not be the zero vector", level)
    end
    checks.number(what .. ".angle", value.angle, -math.huge, " rad", level + 1)
    return
  end
  check_count(what, value, 4, level > 0 and level + 1 or 0)
  local size = 0
  for k, name in ipairs{ "w", "x", "y", "z" } do
    local v = checks.field(value, k) or checks.field(value, name)
    size = size + (type(v) == "number" and v * v or 0 / 0)
  end
  if not (size > 0 and size < math.huge) then
    error(("%s must be a rotation, { w, x, y, z } or { axis = {x, y, z}, angle = [rad] }, got %s")
      :format(what, checks.got(value)), level)
  end
end

return checks
