-- SPDX-License-Identifier: GPL-3.0-or-later
--- Shows a study: rows, files, a text, a chart.
-- @module softworld.study.output
local campaign = require "softworld.study.campaign"
local checks = require "softworld.checks"
local core = require "softworld.core"
local csv = require "softworld.csv"
local json = require "softworld.output.json"
local judge = require "softworld.study.judge"
local counted = require "softworld.output.number".count
local parameters = require "softworld.study.parameters"
local sink = require "softworld.output.sink"

local output = {}

local REASONS = 5 -- most reasons of failures shown

--- Returns a record as a row: part, number, parameters, results, pass, failed, machine, events.
function output.row(own, record)
  local row = { part = record.part, number = record.number, failed = record.failed, machine = record.machine,
    pass = judge.pass(own, record), events = record.events }
  for i, p in ipairs(own.parameters) do row[p.name] = parameters.shown(p, record.values[i]) end
  for name, value in pairs(record.results or {}) do row[name] = value end
  return row
end

-- Returns the records of a part that only the journal has.
local function from_journal(own, part)
  local records = {}
  for number in pairs(own.journal:numbers(part)) do
    local status, rest, word = own.journal:find(part, number)
    local values = status and parameters.values(own.parameters, word)
    local record = values and campaign.record(part, number, values, status, rest)
    if record then
      judge.complete(own, record)
      records[number] = record
    end
  end
  judge.alike(records)
  return records
end

local function parts_of(own)
  local list, seen = {}, {}
  for _, parts in ipairs { own.asked, own.journal.parts } do
    for part in pairs(parts) do
      if not seen[part] then list[#list + 1] = part end
      seen[part] = true
    end
  end
  table.sort(list)
  return list
end

--- Returns the records of one part, or of all, by their numbers.
function output.records(own, part)
  local list = {}
  for _, number in ipairs(part and { part } or parts_of(own)) do
    local records = own.asked[number] and own.asked[number].records or from_journal(own, number)
    for _, record in ipairs(judge.sorted(records)) do list[#list + 1] = record end
  end
  return list
end

-- Returns the names of results, sorted.
local function result_names(list)
  local names, seen = {}, {}
  for _, record in ipairs(list) do
    for name in pairs(record.results or {}) do
      if not seen[name] then names[#names + 1] = name end
      seen[name] = true
    end
  end
  table.sort(names)
  return names
end

output.result_names = result_names

local MOST = 20 -- rows of a table that are printed

-- Returns columns side by side; lists: of texts, the first of which is the heading.
local function side_by_side(lists)
  local lines, widths = {}, {}
  for k, list in ipairs(lists) do
    widths[k] = 0
    for _, word in ipairs(list) do widths[k] = math.max(widths[k], #word) end
  end
  for i = 1, #lists[1] do
    local words = {}
    for k, list in ipairs(lists) do words[k] = list[i] .. (" "):rep(widths[k] - #list[i]) end
    lines[i] = (table.concat(words, "  "):gsub("%s+$", ""))
  end
  return table.concat(lines, "\n")
end

local WIDEST = 60 -- longest text in a printed table [characters]

local function word_of(value)
  if type(value) == "string" and #value > WIDEST then return value:sub(1, WIDEST - 3) .. "..." end
  if math.type(value) == "float" then return ("%.6g"):format(value) end
  return value == nil and "" or tostring(value)
end

-- Adds the column of events if there are any and no result has this name.
local function add_events_column(names, list)
  local any = false
  for _, record in ipairs(list) do
    if record.results and record.results.events then return end
    any = any or record.events ~= nil
  end
  if any then names[#names + 1] = "events" end
end

--- Returns the rows of one part, or of all; their print is a table.
function output.rows(own, part)
  local list, names = output.records(own, part), { "number" }
  for _, p in ipairs(own.parameters) do names[#names + 1] = p.name end
  for _, name in ipairs(result_names(list)) do names[#names + 1] = name end
  if #own.constraints > 0 then names[#names + 1] = "pass" end
  local failed
  add_events_column(names, list)
  for i, record in ipairs(list) do
    list[i], failed = output.row(own, record), failed or record.failed
  end
  if failed then names[#names + 1] = "failed" end
  return setmetatable(list, { __tostring = function(rows)
    local lists = {}
    for k, name in ipairs(names) do
      lists[k] = { name }
      for i = 1, math.min(MOST, #rows) do lists[k][i + 1] = word_of(rows[i][name]) end
    end
    local rest = #rows > MOST and ("\n... %d rows; study:csv(path) writes all"):format(#rows) or ""
    return side_by_side(lists) .. rest
  end })
end

-- Raises an error unless name is a parameter or a result.
function output.check_name(own, what, name, list)
  local results, known = result_names(list), {}
  for i, p in ipairs(own.parameters) do known[i] = p.name end
  table.move(results, 1, #results, #known + 1, known)
  for _, there in ipairs(known) do
    if there == name then return end
  end
  local near = type(name) == "string" and core.nearest(name, known)
  error(("%s: there is no parameter or result %s; %s"):format(what, checks.got(name), near
    and ("did you mean '%s'?"):format(near) or "known are: " .. table.concat(known, " ")), 0)
end

-- Returns the record with the smallest value that meets the constraints, or nil.
local function best_of(own, name, list)
  local p, best, least = own.by_name[name], nil, nil
  for _, record in ipairs(list) do
    local value = judge.pass(own, record) and judge.value(own, name, record)
    if p and value then value = parameters.shown(p, value) end
    if type(value) == "number" and (not least or value < least) then best, least = record, value end
  end
  return best
end

--- Returns the same as a row.
function output.best(own, name)
  local list = output.records(own)
  output.check_name(own, "study:best", name, list)
  local best = best_of(own, name, list)
  return best and output.row(own, best)
end

--- Returns parameters and results of a record, as text.
function output.values(own, record)
  local texts = {}
  for i, p in ipairs(own.parameters) do
    local value = parameters.shown(p, record.values[i])
    texts[i] = type(value) == "number" and ("%s = %.6g"):format(p.name, value)
      or ("%s = %s"):format(p.name, tostring(value))
  end
  for _, name in ipairs(result_names { record }) do
    texts[#texts + 1] = ("%s = %.6g"):format(name, record.results[name])
  end
  return table.concat(texts, ", ")
end

-- --- text --------------------------------------------------------------------------------------

local function add_part(lines, part, asked, list)
  local count, failed = 0, 0
  for _, record in ipairs(list) do
    if record.part == part then
      count, failed = count + 1, failed + (record.failed and 1 or 0)
    end
  end
  lines[#lines + 1] = ("  %d. %s: %d evaluation%s, %d failed"):format(part, asked and asked.method
    or "in the journal", count, count == 1 and "" or "s", failed)
  if asked and asked.says then lines[#lines + 1] = "     " .. asked.says:gsub("\n", "\n   ") end
end

-- Adds the reasons of failures, the most common first.
local function add_reasons(lines, list)
  local reasons, count = {}, {}
  for _, record in ipairs(list) do
    local why = record.failed
    if why then
      if not count[why] then
        reasons[#reasons + 1] = why
        count[why] = { 0, record.part, record.number }
      end
      count[why][1] = count[why][1] + 1
    end
  end
  table.sort(reasons, function(a, b)
    if count[a][1] == count[b][1] then return a < b end
    return count[a][1] > count[b][1]
  end)
  for i = 1, math.min(REASONS, #reasons) do
    local c = count[reasons[i]]
    lines[#lines + 1] = ("  %d failed (first %d.%d): %s"):format(c[1], c[2], c[3], reasons[i])
  end
  if #reasons > REASONS then lines[#lines + 1] = "  and " .. counted(#reasons - REASONS, "more reason") end
end

-- Adds how many evaluations have runs with events that evaluate did not look at, and the first of them.
local function add_events(lines, list)
  local count, first = 0, nil
  for _, record in ipairs(list) do
    if record.events then count, first = count + 1, first or record end
  end
  if not first then return end
  lines[#lines + 1] = ("  %s ok, but with events (first %d.%d): %s"):format(counted(count, "evaluation"),
    first.part, first.number, first.events)
end

--- Returns the text for print.
function output.text(own)
  local list = output.records(own)
  local lines = { ("study '%s': %d evaluation%s%s"):format(own.name, #list, #list == 1 and "" or "s",
    own.file and ", kept in " .. own.file or "") }
  for _, p in ipairs(own.parameters) do lines[#lines + 1] = "  " .. parameters.describe(p, true) end
  for _, part in ipairs(parts_of(own)) do add_part(lines, part, own.asked[part], list) end
  add_reasons(lines, list)
  add_events(lines, list)
  for _, part in ipairs(parts_of(own)) do
    local result = own.asked[part] and own.asked[part].method:match "^minimise (.*)$"
    local best = result and best_of(own, result, list)
    if best then
      lines[#lines + 1] = ("  best %s, evaluation %d.%d: %s"):format(result, best.part, best.number,
        output.values(own, best))
      if best.events then lines[#lines + 1] = "    its run had an event: " .. best.events end
    end
  end
  return table.concat(lines, "\n")
end

-- --- files -------------------------------------------------------------------------------------

local function check_path(what, path)
  if type(path) ~= "string" or path == "" then
    error(("%s: the name of a file is wanted, got %s"):format(what, checks.got(path)), 0)
  end
end

--- Writes the table.
function output.csv(own, path)
  check_path("study:csv", path)
  if own.task then return path end -- a task of a cluster writes no files of the study
  local list = output.records(own)
  local names, columns = { "part", "number" }, {}
  for _, p in ipairs(own.parameters) do names[#names + 1] = p.name end
  for _, name in ipairs(result_names(list)) do names[#names + 1] = name end
  table.move({ "pass", "failed" }, 1, 2, #names + 1, names)
  add_events_column(names, list)
  for _, name in ipairs(names) do columns[name] = {} end
  for k, record in ipairs(list) do
    local row = output.row(own, record)
    for _, name in ipairs(names) do
      local value = row[name]
      if type(value) == "boolean" then
        value = own.by_name[name] and tostring(value) or value and 1 or 0 -- a choice, or pass
      end
      columns[name][k] = value == nil and "" or value
    end
  end
  return csv.write(path, names, columns)
end

--- Writes the table with the study's definition.
function output.json(own, path)
  check_path("study:json", path)
  if own.task then return path end
  local list = {}
  for i, p in ipairs(own.parameters) do
    list[i] = { name = p.name, unit = p.unit, low = p.low, high = p.high, log = p.log, kind = p.kind,
      choices = p.choices }
  end
  return sink.write_file(path, json.encode { name = own.name, seed = own.seed, version = core.version,
    parameters = list, constraints = own.constraints, rows = output.rows(own) } .. "\n")
end

return output
