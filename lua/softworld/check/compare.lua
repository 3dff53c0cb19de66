-- SPDX-License-Identifier: GPL-3.0-or-later
--- sw.compare: differences between two checks, of two runs or of two versions of a process.
-- @module softworld.check.compare
local build = require "softworld.scene.build"
local check = require "softworld.check.check"
local checks = require "softworld.checks"
local comparison = require "softworld.check.comparison"
local jsonread = require "softworld.output.jsonread"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local sink = require "softworld.output.sink"

local compare = {}

local ROUNDING = 1e-9 -- relative change of a value that another compiler may cause [-]
local NUMBERS = { "value", "error", "low", "high", "limit", "limit_low", "limit_high", "margin", "s", "time" }
local TEXTS = { "name", "object", "what", "unit", "side", "step", "note" }
local VERDICTS = checks.set "PASS FAIL OPEN"

local call = rows.call("sw.compare", "a, b, {...}",
  "differences between two checks, runs or files of check:json", {
  gives = "a comparison: same, rows, csv, json",
  example = 'print(sw.compare("before.json", run:check {}))',
  { "tolerance", "number", "-", "changes of a value up to this share of it do not count", min = 0, max = 1,
    default = ROUNDING },
})

-- --- what is compared ----------------------------------------------------------------------------

local words = { inf = math.huge, ["-inf"] = -math.huge, nan = 0 / 0 } -- as check:json writes them

local function number_of(value)
  if type(value) == "string" then return words[value] end
  return type(value) == "number" and value or nil
end

-- Returns a row of a file, or raises an error that says what is wrong with it.
local function read_row(row, i)
  local function wrong(text) error(("row %d %s"):format(i, text), 0) end
  if type(row) ~= "table" then wrong "is not an object" end
  local copy = { verdict = row.verdict }
  if not VERDICTS[row.verdict or ""] then wrong "has no verdict PASS, FAIL or OPEN" end
  for _, key in ipairs(NUMBERS) do
    copy[key] = number_of(row[key])
    if row[key] ~= nil and copy[key] == nil then wrong(("has %s = %s"):format(key, checks.got(row[key]))) end
  end
  for _, key in ipairs(TEXTS) do
    copy[key] = row[key]
    if row[key] ~= nil and type(row[key]) ~= "string" then wrong(("has a %s that is not a text"):format(
      key)) end
  end
  if not copy.name or not copy.unit then wrong "has no name or no unit" end
  return copy
end

local function read_document(path)
  local text = sink.read_file(path)
  if not text:find "%S" then error("the file is empty", 0) end
  local document = jsonread.decode(text)
  if type(document) ~= "table" or type(document.rows) ~= "table" then error("it has no rows", 0) end
  if not VERDICTS[document.verdict or ""] then error("it has no verdict", 0) end
  local list = {}
  for i, row in ipairs(document.rows) do list[i] = read_row(row, i) end
  for key in pairs(document.rows) do
    if not list[key] then error("its rows are not a list", 0) end
  end
  return { label = path, verdict = document.verdict, reason = tostring(document.reason), rows = list }
end

local function of_file(which, path)
  if not path:find "%S" or path:find "\0" then
    error(("sw.compare: %s: the name of a file is empty, or has a zero byte"):format(which), 0)
  end
  local fine, found = pcall(read_document, path)
  if fine then return found end
  if checks.is_interrupt(found) then error(found, 0) end
  local why = checks.shown(found)
  if why:find "^cannot read" then error(("sw.compare: %s: %s"):format(which, why), 0) end
  error(("sw.compare: %s: %s is not what check:json writes: %s"):format(which, path, why), 0)
end

-- Returns label, verdict, reason and rows of a check, a run or a file.
local function side_of(which, value)
  local kind = checks.kind(value)
  if kind == "string" then return of_file(which, value) end
  if kind == "run" then value = check.check(value, { trial = true }) end
  if kind ~= "run" and kind ~= "check" then
    error(("sw.compare: %s must be a check, a run or the name of a file of check:json, got %s"):format(which,
      checks.got(value)), 0)
  end
  local own = sealed.fields(value)
  return { label = own.name, verdict = own.verdict, reason = own.reason, rows = own.rows }
end

-- --- which row belongs to which --------------------------------------------------------------------

-- Returns the free rows by key: lists, in their order.
local function by_key(list, taken, key_of)
  local found = {}
  for _, row in ipairs(list) do
    if not taken[row] then
      local key = key_of(row)
      found[key] = found[key] or {}
      table.insert(found[key], row)
    end
  end
  return found
end

local function full_key(row) return table.concat({ row.name, row.unit, row.side or "" }, "\0") end
local function short_key(row) return row.name .. "\0" .. row.unit end

-- Returns row of a -> row of b. A row with a limit in only one of them is still the same row.
local function pairs_of(a, b)
  local mate, taken = {}, {}
  for _, key_of in ipairs{ full_key, short_key } do
    local free = by_key(b, taken, key_of)
    for _, row in ipairs(a) do
      local list = not mate[row] and free[key_of(row)]
      local other = list and table.remove(list, 1)
      if other then mate[row], taken[other] = other, true end
    end
  end
  return mate, taken
end

-- --- what has changed ------------------------------------------------------------------------------

local function is_finite(x) return x ~= nil and x - x == 0 end

-- True if the known ranges of the two values do not overlap. A value that is not a number, and an infinite
-- one beside a finite one, are apart whatever their errors are.
local function apart(a, b, tolerance)
  if a.value == b.value then return false end
  if not (is_finite(a.value) and is_finite(b.value)) then return true end
  if math.abs(b.value - a.value) <= tolerance * math.max(math.abs(a.value), math.abs(b.value)) then
    return false
  end
  return (a.high or a.value) < (b.low or b.value) or (b.high or b.value) < (a.low or a.value)
end

-- Returns the error of both values together; nil if it is not known.
local function error_of(a, b)
  local sum = 0
  for _, row in ipairs{ a, b } do
    if not row.low or not row.high then return nil end
    sum = sum + (row.high - row.low) / 2
  end
  return sum
end

local function better(a, b, changed)
  if not changed or a.side ~= b.side or not (a.margin and b.margin) then return nil end
  if a.margin == b.margin then return nil end
  return b.margin > a.margin
end

local function both(a, b, tolerance)
  local row = { name = a.name, object = a.object, what = a.what, unit = a.unit, side = b.side or a.side,
    value_a = a.value, value_b = b.value, limit_a = a.limit, limit_b = b.limit, margin_a = a.margin,
    margin_b = b.margin, verdict_a = a.verdict, verdict_b = b.verdict, error = error_of(a, b) }
  local changed = apart(a, b, tolerance)
  row.status = changed and "changed" or "same"
  row.tolerated = not changed and apart(a, b, 0) or nil -- the same by the tolerance alone
  if is_finite(a.value) and is_finite(b.value) then
    row.change = b.value - a.value
    row.share = a.value ~= 0 and row.change / math.abs(a.value) or nil
  end
  row.verdict_changed = a.verdict ~= b.verdict
  row.limit_changed = a.limit ~= b.limit or a.side ~= b.side
  row.better = better(a, b, changed or row.limit_changed)
  return row
end

local function alone(which, one)
  return { status = "only in " .. which, name = one.name, object = one.object, what = one.what,
    unit = one.unit, side = one.side, ["value_" .. which] = one.value, ["limit_" .. which] = one.limit,
    ["margin_" .. which] = one.margin, ["verdict_" .. which] = one.verdict, verdict_changed = false,
    limit_changed = false }
end

local function make(a, b, args)
  local o = call:read(args == nil and {} or args)
  local before, after = side_of("a", a), side_of("b", b)
  local mate, taken = pairs_of(before.rows, after.rows)
  local list = {}
  for _, row in ipairs(before.rows) do
    list[#list + 1] = mate[row] and both(row, mate[row], o.tolerance) or alone("a", row)
  end
  for _, row in ipairs(after.rows) do
    if not taken[row] then list[#list + 1] = alone("b", row) end
  end
  return comparison.new(before, after, list)
end

--- sw.compare(a, b, { tolerance = }): see help "sw.compare".
compare.compare = build.placed(make)

return compare
