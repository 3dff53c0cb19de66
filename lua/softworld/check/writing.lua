-- SPDX-License-Identifier: GPL-3.0-or-later
--- What run:check gives: prints as a table, is written as CSV, JSON and JUnit XML, with the same numbers.
-- @module softworld.check.writing
local checks = require "softworld.checks"
local core = require "softworld.core"
local json = require "softworld.output.json"
local methods = require "softworld.methods"
local number = require "softworld.output.number"
local sealed = require "softworld.sealed"
local sink = require "softworld.output.sink"

local writing = {}
local Check = { __name = "check" }

-- Columns of files, in their order; numbers are in the row's unit, s in m, time in s.
local columns = { "verdict", "name", "object", "what", "value", "error", "low", "high", "unit", "side",
  "limit", "limit_low", "limit_high", "from", "source", "margin", "s", "time", "step", "note" }

-- --- the terminal ------------------------------------------------------------------------------------

local function plain(text) return (tostring(text):gsub("%c", " ")) end

local function text_of(value, unit)
  if type(value) ~= "number" then return "" end
  return number.text(value, unit ~= "-" and unit or nil)
end

local sign = { max = "<= ", min = ">= " }

local function cells(row)
  local bar = row.error and (" +- %s"):format(text_of(row.error, row.unit)) or ""
  local limit = row.side and sign[row.side] .. text_of(row.limit, row.unit) or ""
  local place = {}
  if row.s then place[1] = "s = " .. text_of(row.s, "m") end
  if row.time then place[#place + 1] = "t = " .. text_of(row.time, "s") end
  if row.step then place[#place + 1] = row.step end
  return { row.verdict, plain(row.name), text_of(row.value, row.unit) .. bar, limit, row.from or "",
    row.margin and "margin " .. text_of(row.margin, row.unit) or "", plain(table.concat(place, ", ")) }
end

local function pad(text, width) return text .. (" "):rep(width - number.columns(text)) end

function Check:__tostring()
  local own = sealed.fields(self)
  local lines = { ("check of '%s', t = %s to %s: %s (%s)"):format(plain(own.name), text_of(own.start, "s"),
    text_of(own.time, "s"), own.verdict, plain(own.reason)) }
  local all, widths = {}, {}
  for i, row in ipairs(own.rows) do
    all[i] = cells(row)
    for c, text in ipairs(all[i]) do widths[c] = math.max(widths[c] or 0, number.columns(text)) end
  end
  for i, row in ipairs(own.rows) do
    for c, text in ipairs(all[i]) do all[i][c] = pad(text, widths[c]) end
    lines[#lines + 1] = ("  " .. table.concat(all[i], "  ")):gsub("%s+$", "")
    if row.note then lines[#lines + 1] = "        " .. plain(row.note) end
  end
  if #own.skipped > 0 then
    lines[#lines + 1] = "  left out by the script: " .. plain(table.concat(own.skipped, ", "))
  end
  return table.concat(lines, "\n")
end

-- --- files ---------------------------------------------------------------------------------------------

local function check_path(path, name, extension)
  if type(path) == "string" and path ~= "" then return end
  error(("check:%s expects the name of %s file, got %s"):format(name, extension, path == "" and "''"
    or type(path)), 3)
end

local function quoted(text)
  if text:find '[",;\r\n\t#]' or text:find "^%s" or text:find "%s$" then
    return '"' .. plain(text):gsub('"', '""') .. '"'
  end
  return text
end

local function cell(value)
  if value == nil then return "" end
  return type(value) == "number" and sink.number(value) or quoted(tostring(value))
end

--- Rows as CSV; a cell is empty where there is no value.
function Check:csv(path)
  check_path(path, "csv", "a .csv")
  return sink.write_file(path, function(write)
    write(table.concat(columns, ",") .. "\n")
    for _, row in ipairs(sealed.fields(self).rows) do
      local line = {}
      for c, name in ipairs(columns) do line[c] = cell(row[name]) end
      write(table.concat(line, ",") .. "\n")
    end
  end)
end

-- Numbers that JSON does not have are texts: "inf", "nan".
local function known(value)
  if type(value) == "number" and value - value ~= 0 then return sink.number(value) end
  return value
end

--- The check as JSON: name, verdict, reason, start, time, use, skipped, rows.
function Check:json(path)
  check_path(path, "json", "a .json")
  local own, list = sealed.fields(self), {}
  for i, row in ipairs(own.rows) do
    list[i] = json.object{}
    for _, name in ipairs(columns) do list[i][name] = known(row[name]) end
  end
  local document = json.object{ name = own.name, verdict = own.verdict, reason = own.reason,
    start = own.start, time = own.time, use = own.use, skipped = own.skipped, rows = list }
  return sink.write_file(path, function(write)
    json.write(document, write)
    write "\n"
  end)
end

local entities = { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;" }

-- XML 1.0 has no control characters and no bytes that are not UTF-8.
local function xml(text)
  text = plain(text)
  if not utf8.len(text) then
    text = text:gsub("[\128-\255]", function(byte) return utf8.char(byte:byte()) end)
  end
  return (text:gsub('[&<>"]', entities))
end

local tags = { FAIL = "failure", OPEN = "error" }

local function write_case(write, suite, row)
  write(('  <testcase classname="%s" name="%s%s" time="0">\n    <properties>\n'):format(xml(suite),
    xml(row.name), row.side and "." .. row.side or ""))
  for _, name in ipairs(columns) do
    if row[name] ~= nil then
      write(('      <property name="%s" value="%s"/>\n'):format(name,
        xml(type(row[name]) == "number" and sink.number(row[name]) or row[name])))
    end
  end
  write "    </properties>\n"
  local tag = tags[row.verdict]
  if tag then
    local text = xml(table.concat(cells(row), " "):gsub("%s+", " ") .. (row.note and ": " .. row.note or ""))
    write(('    <%s type="%s" message="%s"/>\n'):format(tag, row.verdict, text))
  end
  write "  </testcase>\n"
end

--- JUnit XML: a case for each row, which fails where it is FAIL and has an error where it is OPEN.
function Check:junit(path)
  check_path(path, "junit", "an .xml")
  local own, count = sealed.fields(self), { FAIL = 0, OPEN = 0, PASS = 0 }
  for _, row in ipairs(own.rows) do count[row.verdict] = count[row.verdict] + 1 end
  return sink.write_file(path, function(write)
    write('<?xml version="1.0" encoding="UTF-8"?>\n')
    write(('<testsuite name="%s" tests="%d" failures="%d" errors="%d" skipped="0" time="0">\n'):format(
      xml(own.name), #own.rows, count.FAIL, count.OPEN))
    for _, row in ipairs(own.rows) do write_case(write, own.name, row) end
    write "</testsuite>\n"
  end)
end

-- --- the object ----------------------------------------------------------------------------------------

--- The first row of that name, also without its object.
function Check:row(name)
  local names = {}
  for _, row in ipairs(sealed.fields(self).rows) do
    local full = row.object and row.object .. "." .. checks.shown(name)
    if row.name == name or row.name == full then return row end
    names[#names + 1] = row.name
  end
  local near = core.nearest(checks.shown(name), names)
  error(("check:row: there is no row '%s'; %s"):format(checks.shown(name), near
    and ("did you mean '%s'?"):format(near) or "there are: " .. table.concat(names, " ")), 2)
end

local fields = { "verdict", "ok", "reason", "rows", "skipped", "name", "start", "time" }

--- Names of methods and fields, for completion at the prompt.
function Check.__names()
  local names = table.move(fields, 1, #fields, 1, {})
  for name in pairs(Check) do
    if name:sub(1, 2) ~= "__" then names[#names + 1] = name end
  end
  return names
end

methods.guard_table("check", Check)

function Check:__index(key)
  local value = rawget(sealed.fields(self), key)
  if value ~= nil then return value end
  if Check[key] ~= nil then return Check[key] end
  local near = core.nearest(checks.shown(key), Check.__names())
  error(("a check has no '%s'; %s"):format(checks.shown(key), near and "did you mean '" .. near .. "'?"
    or "it has: " .. table.concat(Check.__names(), " ")), 2)
end

function Check.__newindex(_, key)
  error(("a check has no '%s' to set; what it found can only be read"):format(checks.shown(key)), 2)
end

--- A check of these fields.
function writing.new(own) return sealed.new(Check, own) end

return writing
