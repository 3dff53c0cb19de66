-- SPDX-License-Identifier: GPL-3.0-or-later
--- The data of a fit: measured numbers by the names of results, and the residuals of an evaluation.
--
--     data = { droop = 0.12,                                  -- one number
--              sag = { 0.010, 0.031, 0.052, sigma = 0.001, unit = "m" } } -- a list, its standard deviation
-- @module softworld.study.fitdata
local checks = require "softworld.checks"
local core = require "softworld.core"
local parameters = require "softworld.study.parameters"

local fitdata = {}

local MOST = 100000 -- most numbers
--- Range of a sigma [unit of its datum]: fourth powers of it, in covariances, are numbers. A weight is in the
-- same range, as 1 / sigma^2, or 0.
fitdata.LEAST_SIGMA, fitdata.MOST_SIGMA = 1e-60, 1e60
local LARGEST = 1e140 -- largest datum over its sigma: the sum of 100,000 squares is a number [-]
local LIGHTEST, HEAVIEST = fitdata.MOST_SIGMA ^ -2, fitdata.LEAST_SIGMA ^ -2

local function fail(text, ...) error(text:format(...), 0) end

local function unit_of(item)
  return item.unit and item.unit ~= "-" and item.unit ~= "" and " " .. item.unit or ""
end

-- Reads sigma or weight: one number for all, or a list with one for each datum.
local function spread_list(what, item, key, given)
  local list = {}
  if given == nil then return nil end
  if type(given) == "table" then checks.only(("%s: %s"):format(what, key), given, nil, 0) end
  if type(given) == "table" and #given ~= #item.values then
    fail("%s: %s must have one number per datum, %d in all, got %d", what, key, #item.values, #given)
  end
  for i = 1, #item.values do
    local value = given
    if type(given) == "table" then value = given[i] end
    local here = ("%s: %s"):format(what, key)
    if key == "sigma" then
      checks.number(here, value, fitdata.LEAST_SIGMA, unit_of(item), 0, fitdata.MOST_SIGMA)
    elseif type(value) ~= "number" or value ~= 0 and not (value >= LIGHTEST and value <= HEAVIEST) then
      fail("%s = %s is not allowed; it must be 0, or a number from %g to %g", here, checks.got(value),
        LIGHTEST, HEAVIEST)
    end
    list[i] = value
  end
  return list
end

local KEYS = { unit = true, sigma = true, weight = true }

local function check_keys(what, given)
  for key in pairs(given) do
    if not KEYS[key] and not (math.type(key) == "integer" and key >= 1 and key <= #given) then
      local near = type(key) == "string" and core.nearest(key, { "unit", "sigma", "weight" })
      fail("%s: there is no %s; %s", what, checks.shown(key), near and ("did you mean '%s'?"):format(near)
        or "known are: numbers in a list, unit sigma weight")
    end
  end
end

local function read_one(own, name, given)
  parameters.check_name("study:fit: data", name)
  local what = ("study:fit: data.%s"):format(name)
  if own.by_name[name] then fail("%s is a parameter; data are of results", what) end
  if type(given) == "number" then given = { given } end
  if type(given) ~= "table" then
    fail("%s must be a number, or a list of numbers with sigma = and unit =, got %s", what,
      checks.got(given))
  end
  check_keys(what, given)
  parameters.check_unit(what, given.unit)
  local item = { name = name, unit = given.unit, values = table.move(given, 1, #given, 1, {}) }
  if #item.values == 0 then fail("%s has no number", what) end
  for i, value in ipairs(item.values) do
    checks.number(("%s[%d]"):format(what, i), value, -math.huge, unit_of(item), 0)
  end
  item.sigma = spread_list(what, item, "sigma", given.sigma)
  item.weight = spread_list(what, item, "weight", given.weight)
  if item.sigma and item.weight then fail("%s: give sigma or weight, not both", what) end
  return item
end

-- Raises an error unless all data have a sigma, or none.
local function check_sigma(list)
  local with, without, weighed
  for _, item in ipairs(list) do
    if item.sigma then with = with or item.name else without = without or item.name end
    weighed = weighed or item.weight and item.name
  end
  if with and without then
    fail("study:fit: data.%s has a sigma and data.%s has none; give it for all, or for none", with, without)
  end
  if not with and not weighed and #list > 1 then
    fail("study:fit: data.%s and data.%s need a sigma each (or a weight, 1 / sigma^2 times a common factor): "
      .. "without it their deviations cannot be compared", list[1].name,
      list[2].name)
  end
  return with ~= nil
end

-- Raises an error for a datum whose square, in units of its sigma, would not be a number.
local function check_sizes(item)
  for k, value in ipairs(item.values) do
    local size, what = math.abs(value) * item.scale[k], ("study:fit: data.%s[%d]"):format(item.name, k)
    if size > LARGEST then
      local unit = unit_of(item)
      fail("%s = %.9g%s is too large; at most %g%s", what, value, unit, LARGEST,
        item.sigma and (" times its sigma of %.9g%s"):format(item.sigma[k], unit)
          or item.weight and (" / sqrt(weight), with its weight of %.9g"):format(item.weight[k]) or unit)
    end
  end
end

--- Returns the data as a list by name, { name =, unit =, values =, scale = {1 / sigma} }; count; is sigma
-- given?
function fitdata.read(own, given)
  local list, names, count = {}, checks.sorted(given, checks.by_text), 0
  if #names == 0 then fail "study:fit: data is empty; name at least one, such as { droop = 0.12 }" end
  for i, name in ipairs(names) do
    list[i] = read_one(own, name, given[name])
    count = count + #list[i].values
  end
  if count > MOST then fail("study:fit: %d data are too many; %d are allowed", count, MOST) end
  local known = check_sigma(list)
  for _, item in ipairs(list) do
    item.scale = {}
    for k = 1, #item.values do
      item.scale[k] = item.sigma and 1 / item.sigma[k] or item.weight and math.sqrt(item.weight[k]) or 1
    end
    check_sizes(item)
  end
  return { list = list, count = count, known = known }
end

--- Returns what evaluate gave for an item, as a list; nil and the reason if it is missing.
function fitdata.computed(item, results)
  local n, out = #item.values, {}
  if n == 1 and results[item.name] then return { results[item.name] } end
  for k = 1, n do
    out[k] = results[item.name .. "_" .. k]
    if not out[k] then break end
  end
  if #out == n and not results[item.name .. "_" .. n + 1] then return out end
  if #out == 0 and not results[item.name] then
    local names, seen = {}, {}
    for name in pairs(results) do
      local plain = name:match "^(.*)_%d+$" or name
      if not seen[plain] then names[#names + 1] = plain end
      seen[plain] = true
    end
    table.sort(names)
    local near = core.nearest(item.name, names)
    return nil, ("evaluate returns no '%s'; %s"):format(item.name, near
      and ("did you mean '%s'?"):format(near) or "it returns: " .. table.concat(names, " "))
  end
  local given = #out
  while results[item.name .. "_" .. given + 1] do given = given + 1 end
  return nil, ("data.%s has %d number%s, and evaluate returned %d"):format(item.name, n,
    n == 1 and "" or "s", math.max(given, 1))
end

--- Returns all residuals (computed - measured) / sigma of a record's results, as one list; or nil and the
-- reason.
function fitdata.residuals(data, results)
  local r = {}
  for _, item in ipairs(data.list) do
    local computed, why = fitdata.computed(item, results)
    if not computed then return nil, why end
    for k, value in ipairs(computed) do r[#r + 1] = (value - item.values[k]) * item.scale[k] end
  end
  return r
end

return fitdata
