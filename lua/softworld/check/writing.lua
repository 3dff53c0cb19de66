-- SPDX-License-Identifier: GPL-3.0-or-later
--- The result of run:check: prints as a table, writes CSV, JSON, JUnit XML and a page, all with the same
-- numbers.
-- @module softworld.check.writing
local build = require "softworld.scene.build"
local cells = require "softworld.check.cells"
local checks = require "softworld.checks"
local core = require "softworld.core"
local json = require "softworld.output.json"
local letters = require "softworld.output.letters"
local methods = require "softworld.methods"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local sink = require "softworld.output.sink"

local writing = {}
local Check = { __name = "check" }

-- Columns of files, in order; numbers are in the row's unit, s in m, time in s.
writing.columns = { "verdict", "name", "object", "what", "value", "error", "low", "high", "unit", "side",
  "limit", "limit_low", "limit_high", "from", "source", "margin", "s", "time", "step", "note" }

local columns = writing.columns

-- --- the terminal ------------------------------------------------------------------------------------

local WIDE = 100 -- longest line of missing limits [characters]

local sign = { max = "<= ", min = ">= " }

local function line_of(row)
  local bar = row.error and row.error > 0 and (" +- %s"):format(cells.number(row.error, row.unit)) or ""
  local limit = row.side and sign[row.side] .. cells.number(row.limit, row.unit) or ""
  local place = {}
  if row.s then place[1] = "s = " .. cells.number(row.s, "m") end
  if row.time then place[#place + 1] = "t = " .. cells.number(row.time, "s") end
  if row.step then place[#place + 1] = row.step end
  return { row.verdict, cells.plain(row.name), cells.number(row.value, row.unit) .. bar, limit,
    row.from or "", row.margin and "margin " .. cells.number(row.margin, row.unit) or "",
    cells.plain(table.concat(place, ", ")), note = row.note }
end

-- Adds the limits that are missing, to be copied into the script.
local function add_missing(lines, missing)
  if #missing < 2 then return end -- the row says it
  local line = "  limits are missing; give numbers, or false where none is needed:"
  lines[#lines + 1] = line
  line = "    limits = {"
  for i, one in ipairs(missing) do
    local part = (" [%q] = [%s]%s"):format(cells.plain(one.name), one.unit, i < #missing and "," or " }")
    if #line + #part > WIDE then
      lines[#lines + 1], line = line, "     "
    end
    line = line .. part
  end
  lines[#lines + 1] = line
end

-- True if any row has an error bar of edges and steps.
local function has_bars(list)
  for _, row in ipairs(list) do
    if row.error then return true end
  end
  return false
end

function Check:__tostring()
  local own = sealed.fields(self)
  local lines = { ("check of '%s', t = %s to %s: %s (%s)"):format(cells.plain(own.name),
    cells.number(own.start, "s"), cells.number(own.time, "s"), own.verdict, cells.plain(own.reason)) }
  local list = {}
  for i, row in ipairs(own.rows) do list[i] = line_of(row) end
  cells.add_table(lines, list)
  add_missing(lines, own.missing)
  if not own.no_numbers and #own.rows > 0 and not has_bars(own.rows) then
    lines[#lines + 1] = "  values have no error bars for edges and steps; scene:run{ check = {...} } "
      .. "computes them"
  end
  if #own.skipped > 0 then
    lines[#lines + 1] = "  left out by the script: " .. cells.plain(table.concat(own.skipped, ", "))
  end
  return table.concat(lines, "\n")
end

-- --- files ---------------------------------------------------------------------------------------------

--- Writes the rows as CSV; a cell is empty if there is no value.
function Check:csv(path)
  cells.check_path("check:csv", path, "a .csv")
  return cells.write_csv(path, columns, sealed.fields(self).rows)
end

--- Writes the check as JSON: name, verdict, reason, start, time, use, version, skipped, rows.
function Check:json(path)
  cells.check_path("check:json", path, "a .json")
  local own = sealed.fields(self)
  return cells.write_json(path, json.object{ name = own.name, verdict = own.verdict, reason = own.reason,
    start = own.start, time = own.time, use = own.use, version = core.version, skipped = own.skipped,
    rows = cells.known_rows(columns, own.rows) })
end

local function xml(text) return letters.xml(tostring(text)) end

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
    local text = xml(table.concat(line_of(row), " "):gsub("%s+", " ")
      .. (row.note and ": " .. row.note or ""))
    write(('    <%s type="%s" message="%s"/>\n'):format(tag, row.verdict, text))
  end
  write "  </testcase>\n"
end

--- Writes JUnit XML: a case for each row, with a failure for FAIL and an error for OPEN.
function Check:junit(path)
  cells.check_path("check:junit", path, "an .xml")
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

for _, name in ipairs{ "csv", "json", "junit" } do Check[name] = build.placed(Check[name]) end

-- --- the object ----------------------------------------------------------------------------------------

--- Returns the first row of this name, also without its object.
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

rows.later(Check, "softworld.check.page", "report")
methods.found("check", Check,
  { "verdict", "ok", "reason", "rows", "skipped", "name", "start", "time" }, "use")

--- Returns a check with these fields.
function writing.new(own) return sealed.new(Check, own) end

return writing
