-- SPDX-License-Identifier: GPL-3.0-or-later
--- Places of the parameters' values for sweeps: on a grid, or points that fill the ranges evenly.
-- @module softworld.study.design
local checks = require "softworld.checks"
local core = require "softworld.core"
local parameters = require "softworld.study.parameters"

local design = {}

local MOST = 1000000 -- most evaluations of one sweep, about 1 GB of records
local SHOWN = 6 -- most factors that a message shows

local function fail(text, ...) error(text:format(...), 0) end

-- Returns how many values of a grid each parameter has.
local function counts(list, what, grid, count)
  local each = {}
  for i, p in ipairs(list) do
    local n = type(grid) == "table" and grid[p.name] or type(grid) == "number" and grid or nil
    if p.kind == "choice" then n = n or #p.choices end
    if n == nil and count then n = math.max(2, math.floor(count ^ (1 / #list) + 1e-9)) end
    if p.kind == "integer" and type(n) == "number" then n = math.min(n, p.high - p.low + 1) end
    if n == nil then fail("%s: grid has no number of values for '%s'", what, p.name) end
    if type(n) ~= "number" or not math.tointeger(n) or n < 1 or n > MOST then
      fail("%s: grid: %s = %s is not allowed; it must be an integer from 1 to %d", what, p.name,
        checks.got(n), MOST)
    end
    each[i] = math.tointeger(n)
    if p.kind == "choice" then each[i] = math.min(each[i], #p.choices) end
  end
  return each
end

-- Returns the k-th of n values of a range, ends included; of a single value the middle, or the start.
local function on_grid(p, k, n)
  if p.kind == "choice" then return k + 1 end
  if n == 1 then return p.start or parameters.at(p, 0.5) end
  if p.kind == "integer" and not p.log then
    return p.low + math.floor((p.high - p.low) * k / (n - 1) + 0.5)
  end
  return parameters.at(p, k / (n - 1))
end

-- Returns the number of evaluations of a grid.
local function total_of(what, each)
  local total, factors = 1.0, {} -- a float: the product may be above the largest integer
  for i, n in ipairs(each) do
    total = total * n
    if i <= SHOWN then factors[i] = ("%d"):format(n) end
  end
  if total <= MOST then return math.tointeger(total) end
  if #each > SHOWN then factors[SHOWN + 1] = "..." end
  fail("%s: the grid has %s = %.6g evaluations, of %d parameters; at most %d are allowed: take fewer values, "
    .. "or kind = 'sobol' with count", what, table.concat(factors, " x "), total, #each, MOST)
end

--- Returns a grid: its size, and a function from the number to the values. The last parameter changes first.
function design.grid(list, what, grid, count)
  if type(grid) == "table" then
    local names, known = {}, {}
    for i, p in ipairs(list) do names[i], known[p.name] = p.name, true end
    for name in pairs(grid) do
      if not known[name] then
        local near = type(name) == "string" and core.nearest(name, names)
        fail("%s: grid: there is no parameter '%s'; %s", what, tostring(name), near
          and ("did you mean '%s'?"):format(near) or "known are: " .. table.concat(names, " "))
      end
    end
  end
  local each = counts(list, what, grid, count)
  local total = total_of(what, each)
  return total, function(number)
    local values, rest = {}, number - 1
    for i = #list, 1, -1 do
      values[i] = on_grid(list[i], rest % each[i], each[i])
      rest = rest // each[i]
    end
    return values
  end
end

-- Returns a generator of its own: xorshift64* (S. Vigna, An experimental exploration of Marsaglia's xorshift
-- generators, scrambled, 2016).
local function generator(...)
  local state = 0
  for i = 1, select("#", ...) do
    state = core.checksum("design" .. string.pack("<i8i8", state, (select(i, ...))))
  end
  if state == 0 then state = 1 end
  return function()
    state = state ~ (state >> 12)
    state = state ~ (state << 25)
    state = state ~ (state >> 27)
    return ((state * 0x2545F4914F6CDD1D) >> 11) * 2.0 ^ -53
  end
end
design.generator = generator

--- Returns a normal number with mean 0 and deviation 1, from a function for uniform ones (Box and Muller
-- 1958).
function design.normal(random)
  return math.sqrt(-2 * math.log(1 - random())) * math.cos(2 * math.pi * random())
end

--- Returns the starts of `count` searches: the parameters' start or the middle, then points of Halton's
-- sequence; a list of lists of places.
function design.starts(list, count)
  local n, all = #list, { {} }
  for i, p in ipairs(list) do all[1][i] = parameters.start(p) or 0.5 end
  local flat = count > 1 and core.quasi("halton", n, count)
  for k = 2, count do all[k] = table.move(flat, (k - 1) * n + 1, k * n, 1, {}) end
  return all
end

--- Latin hypercube (McKay, Beckman, Conover 1979): each of count equal intervals of each range is used once.
local function latin(n, count, seed)
  local random, columns = generator(seed), {}
  for i = 1, n do
    local column = {}
    for k = 1, count do column[k] = k - 1 end
    for k = count, 2, -1 do
      local other = 1 + math.floor(random() * k)
      column[k], column[other] = column[other], column[k]
    end
    for k = 1, count do column[k] = (column[k] + random()) / count end
    columns[i] = column
  end
  return function(number)
    local places = {}
    for i = 1, n do places[i] = columns[i][number] end
    return places
  end
end
design.places = latin

--- Returns count points of a kind, "latin", "halton" or "sobol": a function from the number to the values.
function design.fill(list, kind, count, seed)
  if kind == "latin" then
    local place_of = latin(#list, count, seed)
    return function(number) return parameters.all_at(list, place_of(number)) end
  end
  local fine, flat = pcall(core.quasi, kind, #list, count)
  if not fine then
    local why = tostring(flat)
    error(why:find("parameters", 1, true) and "study:sweep: " .. why .. "; take kind = 'latin'" or why, 0)
  end
  return function(number) return parameters.all_at(list, flat, (number - 1) * #list) end
end

return design
