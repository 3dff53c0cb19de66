-- SPDX-License-Identifier: GPL-3.0-or-later
--- Time series of a run as CSV and JSON files.
-- Numbers are written with 17 significant digits and read back unchanged.
-- @module softworld.output.series

local json = require "softworld.output.json"
local sink = require "softworld.output.sink"

local series = {}

--- The series of a run, checked.
-- @tparam table source a run (with a field series) or a series itself:
-- `time = {...}` [s], `columns = { { name=, unit=, values = {...} }, ... }`
-- @treturn table the series; raises if a column is not as long as the time
function series.of(source)
  local data = type(source) == "table" and (source.series or source)
  if not data or type(data.time) ~= "table" or type(data.columns) ~= "table" then
    sink.fail("series: a run with time series is expected")
  end
  for i, column in ipairs(data.columns) do
    if type(column.name) ~= "string" or type(column.values) ~= "table" then
      sink.fail("series: column %d lacks a name or values", i)
    end
    if #column.values ~= #data.time then
      sink.fail("series: column %s has %d values for %d times", column.name, #column.values, #data.time)
    end
  end
  return data
end

--- A name with its unit, as in column heads: `left.force [N]`.
-- @tparam string name
-- @tparam ?string unit nothing is added without one
-- @treturn string
function series.head(name, unit)
  if not unit or unit == "" then return name end
  return name .. " [" .. unit .. "]"
end

local function cell(text)
  if text:find('[",\r\n]') or text:find("^%s") or text:find("%s$") then
    return '"' .. text:gsub('"', '""') .. '"'
  end
  return text
end

--- Write the series as CSV through a function.
-- First line: `t [s]`, then each name with its unit; then one line per time.
-- @tparam table source see series.of
-- @tparam function write called with strings
function series.write_csv(source, write)
  local data = series.of(source)
  local heads = { "t [s]" }
  for _, column in ipairs(data.columns) do heads[#heads + 1] = cell(series.head(column.name, column.unit)) end
  write(table.concat(heads, ",") .. "\n")
  local row, number = {}, sink.number
  for i, time in ipairs(data.time) do
    row[1] = number(time)
    for c, column in ipairs(data.columns) do row[c + 1] = number(column.values[i]) end
    write(table.concat(row, ",") .. "\n")
  end
end

--- Write the series as a CSV file.
-- @tparam table source see series.of
-- @tparam string path
-- @treturn string the path
function series.csv(source, path)
  series.of(source) -- complain before a file is touched
  return sink.write_file(path, function(write) series.write_csv(source, write) end)
end

--- The series as a plain table in the shape of the JSON file.
-- @tparam table source see series.of
-- @treturn table `name, ok, reason` of the run where known, `time` and
-- `columns`, each with `name, unit, values`
function series.document(source)
  local data = series.of(source)
  local columns = {}
  for i, column in ipairs(data.columns) do
    columns[i] = { name = column.name, unit = column.unit or "", values = column.values }
  end
  local document = { time = { name = "t", unit = "s", values = data.time }, columns = columns }
  if source ~= data then
    document.name, document.ok, document.reason = source.name, source.ok, source.reason
  end
  return json.object(document)
end

--- Write the series as a JSON file; NaN becomes null.
-- @tparam table source see series.of
-- @tparam string path
-- @treturn string the path
function series.json(source, path)
  local document = series.document(source)
  return sink.write_file(path, function(write)
    json.write(document, write)
    write "\n"
  end)
end

local writers = { csv = series.csv, json = series.json }

--- Write the series in the format that the path's extension names.
-- @tparam table source see series.of
-- @tparam string path ending in .csv or .json
-- @treturn string the path
function series.write(source, path)
  local kind = writers[sink.extension(path)]
  if not kind then sink.fail("series: %s ends neither in .csv nor in .json", path) end
  return kind(source, path)
end

return series
