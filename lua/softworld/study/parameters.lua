-- SPDX-License-Identifier: GPL-3.0-or-later
--- Parameters of a study: what scripts write of them, their values from places between 0 and 1, and their
-- text in the journal, which reads back to the same bits.
-- @module softworld.study.parameters
local behind = require "softworld.study.behind"
local checks = require "softworld.checks"
local core = require "softworld.core"
local sink = require "softworld.output.sink"

local parameters = {}

local KEYS = checks.set "unit log integer start sigma choices of"
local RESERVED = checks.set "random give_up broken number part seed failed machine pass"

local LONGEST = 64 -- longest name [characters]
local MOST = 1000  -- most parameters

local function fail(text, ...) error(text:format(...), 0) end

local SI = " m s kg N Pa rad J W Hz K A V mol "

local LARGEST = 1e15 -- largest integer of a range; numbers keep all integers up to there

--- True for an SI unit without prefixes: products and quotients with whole powers, or "-".
function parameters.is_unit(text)
  if text == "-" or text == "" then return true end
  for part in text:gmatch "[^ /]+" do
    local name = part:match "^(%a+)%d*$"
    if part ~= "1" and not (name and SI:find(" " .. name .. " ", 1, true)) then return false end
  end
  return text:find "%S" ~= nil
end

--- Raises an error unless unit is such a text.
function parameters.check_unit(what, unit)
  if unit == nil then return end
  if type(unit) ~= "string" or not parameters.is_unit(unit) then
    fail("%s: unit = %s is none of the SI; numbers are in SI units without prefixes, such as 'N', 'm/s', "
      .. "'N m2' or '-'", what, checks.got(unit))
  end
end

--- Raises an error unless it is a valid name of a parameter or a result.
function parameters.check_name(what, name)
  if type(name) ~= "string" or not name:find "^%a[%w_]*$" then
    fail("%s %s: a name begins with a letter and has letters, digits and _ only", what, checks.got(name))
  end
  if #name > LONGEST then
    fail("%s '%s...': a name has at most %d characters", what, name:sub(1, 20), LONGEST)
  end
  if RESERVED[name] then fail("%s '%s': the name is taken, choose another", what, name) end
end

local function read_choices(what, given)
  local list, seen = given.choices, {}
  if given[1] ~= nil or given.log or given.integer or given.start or given.sigma then
    fail("%s: choices go without a range, log, integer, start and sigma", what)
  end
  if type(list) ~= "table" or #list < 1 then fail("%s: choices must be a list of values", what) end
  checks.only(what .. ": choices", list, nil, 0)
  for i, value in ipairs(list) do
    local kind = type(value)
    if kind ~= "string" and kind ~= "number" and kind ~= "boolean" or value ~= value then
      fail("%s: choices[%d] must be a text, a number or true or false, got %s", what, i, checks.got(value))
    end
    if seen[value] then fail("%s: choices[%d] is there twice", what, i) end
    seen[value] = true
  end
  return { kind = "choice", choices = table.move(list, 1, #list, 1, {}) }
end

local function is_finite(x) return type(x) == "number" and x - x == 0 end

local function check_range(what, low, high, unit)
  unit = unit and unit ~= "-" and unit ~= "" and " " .. unit or ""
  for i = 1, 2 do
    local value = low
    if i == 2 then value = high end
    if not is_finite(value) then
      fail("%s: it needs a range { lowest, highest } of finite numbers, or choices = {...}; the %s is %s",
        what, i == 1 and "lowest" or "highest", value == nil and "missing" or checks.got(value, unit))
    end
  end
  if low >= high then
    fail("%s: the range %.9g to %.9g%s is %s; the lowest must be below the highest", what, low, high, unit,
      low == high and "one value" or "reversed")
  end
  if high - low == math.huge then
    fail("%s: the range %.9g to %.9g%s is wider than the largest number, 1.8e308", what, low, high, unit)
  end
end

local function read_range(what, given)
  local low, high = given[1], given[2]
  check_range(what, low, high, given.unit)
  for _, key in ipairs { "log", "integer" } do
    if given[key] ~= nil and type(given[key]) ~= "boolean" then
      fail("%s: %s must be true or false, got %s", what, key, checks.got(given[key]))
    end
  end
  if given.integer and not (math.tointeger(low) and math.tointeger(high)) then
    fail("%s: the range %.9g to %.9g of an integer must be of integers", what, low, high)
  end
  if given.integer and math.max(math.abs(low + 0.0), math.abs(high + 0.0)) > LARGEST then
    fail("%s: the range %.9g to %.9g of an integer is too wide; integers are within +-%.9g", what, low, high,
      LARGEST)
  end
  if given.log and low <= 0 then fail("%s: log needs a range above 0, and it begins at %.9g", what, low) end
  local start, sigma = given.start, given.sigma
  if start ~= nil and not (is_finite(start) and start >= low and start <= high) then
    fail("%s: start = %s is not in the range %.9g to %.9g", what, checks.got(start), low, high)
  end
  if sigma ~= nil and not (is_finite(sigma) and sigma > 0) then
    fail("%s: sigma = %s is not allowed; it must be a number above 0", what, checks.got(sigma))
  end
  if sigma and (given.integer or given.log) then
    fail("%s: sigma, of a normal spread, goes without log and integer", what)
  end
  return { kind = given.integer and "integer" or "number", log = given.log or nil,
    start = start, sigma = sigma,
    low = given.integer and math.tointeger(low) or low + 0.0,
    high = given.integer and math.tointeger(high) or high + 0.0 }
end

-- Reads a quantity of the catalogue: its value and its bounds.
local function of_catalogue(what, given)
  local low, high = checks.field(given, "low"), checks.field(given, "high")
  if low == nil or high == nil then
    fail("%s: the catalogue has no spread for this value; give a range { lowest, highest }", what)
  end
  return read_range(what, { low, high, start = checks.field(given, "value") })
end

local function read_one(name, given)
  parameters.check_name("sw.study: parameter", name)
  local what = ("sw.study: parameter '%s'"):format(name)
  if type(given) ~= "table" then
    fail("%s: it needs a range { lowest, highest }, or choices = {...}, got %s", what, checks.got(given))
  end
  if rawget(given, 1) == nil and checks.field(given, "value") ~= nil then return of_catalogue(what, given) end
  for key in pairs(given) do
    if key ~= 1 and key ~= 2 and not KEYS[key] then
      local near = type(key) == "string" and core.nearest(key, { "unit", "log", "integer", "start", "sigma",
        "choices", "of" })
      fail("%s: there is no '%s'; %s", what, checks.shown(key), near and ("did you mean '%s'?"):format(near)
        or "known are: two numbers, unit log integer start sigma choices of")
    end
  end
  given = behind.read(what, given)
  parameters.check_unit(what, given.unit)
  local p = given.choices ~= nil and read_choices(what, given) or read_range(what, given)
  p.unit = given.unit
  return p
end

--- Returns the list of parameters in a script's table, by name.
function parameters.read(given)
  local list, names = {}, checks.sorted(given, checks.by_text)
  for i, name in ipairs(names) do
    list[i] = read_one(name, given[name])
    list[i].name = name
  end
  if #list == 0 then
    fail "sw.study: parameters is empty; name at least one, such as { force = { 1, 20 } }"
  end
  if #list > MOST then fail("sw.study: %d parameters are too many; %d are allowed", #list, MOST) end
  return list
end

-- --- values ------------------------------------------------------------------------------------

local function between(p, u)
  if p.log then return math.exp(math.log(p.low) + u * (math.log(p.high) - math.log(p.low))) end
  return p.low + u * (p.high - p.low)
end

--- Returns the value at a place u from 0 to 1 of a parameter's range; for choices the number of a choice.
function parameters.at(p, u)
  if p.kind == "choice" then return math.min(#p.choices, 1 + math.floor(u * #p.choices)) end
  if u <= 0 then return p.low elseif u >= 1 then return p.high end
  if p.kind == "number" then return math.max(p.low, math.min(p.high, between(p, u))) end
  if p.log then return math.max(p.low, math.min(p.high, math.floor(between(p, u) + 0.5))) end
  return math.min(p.high, p.low + math.floor(u * (p.high - p.low + 1)))
end

--- Returns the place of a value in a range.
function parameters.place(p, value)
  if p.log then -- not of quotients, which may be beyond the largest number
    return (math.log(value) - math.log(p.low)) / (math.log(p.high) - math.log(p.low))
  end
  return (value - p.low) / (p.high - p.low)
end

--- Returns the place of a parameter's start; nil without a start.
function parameters.start(p)
  return p.start and math.max(0, math.min(1, parameters.place(p, p.start)))
end

--- Returns the values at a list of places.
function parameters.all_at(list, places, from)
  local values = {}
  for i, p in ipairs(list) do values[i] = parameters.at(p, places[(from or 0) + i]) end
  return values
end

-- --- text --------------------------------------------------------------------------------------

--- Returns a number as text that reads back to the same bits and the same type.
function parameters.text(x)
  local text = sink.number(x)
  if math.type(x) == "float" and not text:find "[%.en]" then text = text .. ".0" end
  return text
end

--- Returns values as one word.
function parameters.word(values)
  local texts = {}
  for i, value in ipairs(values) do texts[i] = parameters.text(value) end
  return table.concat(texts, ",")
end

--- Returns the values of a word; nil if it does not fit these parameters.
function parameters.values(list, word)
  local values = {}
  for text in word:gmatch "[^,]+" do
    local p, value = list[#values + 1], tonumber(text)
    if not p or not value then return nil end
    value = p.kind == "number" and value + 0.0 or math.tointeger(value)
    if p.kind == "choice" and not p.choices[value] or not value then return nil end
    values[#values + 1] = value
  end
  return #values == #list and values or nil
end

--- Returns what a script gets for a value: for choices the choice itself.
function parameters.shown(p, value)
  if p.kind == "choice" then return p.choices[value] end
  return value
end

--- Returns one line about a parameter: exact, so that it identifies the definition, or for people.
function parameters.describe(p, for_people)
  local shown = for_people and function(x) return ("%.9g"):format(x) end or parameters.text
  if p.kind == "choice" then
    local texts = {}
    for i, c in ipairs(p.choices) do
      texts[i] = type(c) == "number" and shown(c) or type(c) == "string" and ("%q"):format(c) or tostring(c)
    end
    return ("%s: %s"):format(p.name, table.concat(texts, " | "))
  end
  return ("%s: %s to %s%s%s%s%s%s"):format(p.name, shown(p.low), shown(p.high),
    p.unit and p.unit ~= "-" and " " .. p.unit or "", p.log and ", log" or "",
    p.kind == "integer" and ", integer" or "", p.start and ", start " .. shown(p.start) or "",
    p.sigma and ", sigma " .. shown(p.sigma) or "")
end

return parameters
