-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes the time series of a run as CSV and JSON files.
-- Numbers have 17 significant digits and read back unchanged.
-- @module softworld.output.series

local checks = require "softworld.checks"
local counted = require "softworld.output.number".count
local json = require "softworld.output.json"
local sink = require "softworld.output.sink"

local series = {}

--- Returns the series of a run after checks.
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
      sink.fail("series: column %s has %s for %s", column.name, counted(#column.values, "value"),
        counted(#data.time, "time"))
    end
  end
  return data
end

--- Returns the energies stored with the frames of a run, as a series.
-- @tparam table run with `frames = { { t [s], energy = { kinetic, elastic, gravity } [J] } }`
-- @treturn table see series.of; gravity is counted from its lowest value
function series.energy(run)
  local kinds = { "kinetic", "elastic", "gravity" }
  local data, lowest = { time = {}, columns = {} }, math.huge
  for c, kind in ipairs(kinds) do data.columns[c] = { name = kind, unit = "J", values = {} } end
  for i, frame in ipairs(run.frames or {}) do
    if not frame.energy then sink.fail("series: the run's frames hold no energies") end
    data.time[i] = frame.t
    for c, kind in ipairs(kinds) do data.columns[c].values[i] = frame.energy[kind] end
    lowest = math.min(lowest, frame.energy.gravity)
  end
  for i, value in ipairs(data.columns[3].values) do data.columns[3].values[i] = value - lowest end
  return data
end

-- Returns the running mean of samples over width [s] of time, by trapezoids; a gap stays a gap.
local function running_mean(time, values, width)
  local out, first, last, sum, span = {}, 1, 1, 0.0, 0.0
  local function piece(i) -- between samples i and i + 1
    local h = time[i + 1] - time[i]
    local area = 0.5 * h * (values[i] + values[i + 1])
    if area ~= area then return 0.0, 0.0 end
    return area, h
  end
  for i, t in ipairs(time) do
    while last < #time and time[last + 1] <= t + width / 2 do
      local area, h = piece(last)
      sum, span, last = sum + area, span + h, last + 1
    end
    while first < last and time[first] < t - width / 2 do
      local area, h = piece(first)
      sum, span, first = sum - area, span - h, first + 1
    end
    out[i] = values[i] ~= values[i] and values[i] or span > 1e-12 and sum / span or values[i]
  end
  return out
end

--- Returns the series with every column replaced by its running mean.
-- @tparam table data see series.of
-- @tparam number width of the window [s]
-- @treturn table a series
function series.mean(data, width)
  if type(width) ~= "number" or not (width > 0 and width < math.huge) then
    sink.fail("series: mean = %s is not allowed; it must be a time above 0 s", checks.shown(width))
  end
  local smooth = { time = data.time, columns = {} }
  for i, c in ipairs(data.columns) do
    smooth.columns[i] = { name = c.name, unit = c.unit, values = running_mean(data.time, c.values, width) }
  end
  return smooth
end

--- Returns a name with its unit, as in column heads: `left.force [N]`.
-- @tparam string name
-- @tparam ?string unit nothing is added without one
-- @treturn string
function series.head(name, unit)
  if not unit or unit == "" then return name end
  return name .. " [" .. unit .. "]"
end

--- Writes the series as CSV through a function.
-- First line: `t [s]`, then each name with its unit; then one line per time.
-- @tparam table source see series.of
-- @tparam function write called with strings
function series.write_csv(source, write)
  local data = series.of(source)
  local heads = { "t [s]" }
  for _, column in ipairs(data.columns) do
    heads[#heads + 1] = sink.cell(series.head(column.name, column.unit))
  end
  write(table.concat(heads, ",") .. "\n")
  local row, number = {}, sink.number
  for i, time in ipairs(data.time) do
    row[1] = number(time)
    for c, column in ipairs(data.columns) do row[c + 1] = number(column.values[i]) end
    write(table.concat(row, ",") .. "\n")
  end
end

--- Writes the series as a CSV file.
-- @tparam table source see series.of
-- @tparam string path
-- @treturn string the path
function series.csv(source, path)
  series.of(source) -- raises an error before a file is touched
  return sink.write_file(path, function(write) series.write_csv(source, write) end)
end

--- Returns the series as a plain table in the shape of the JSON file.
-- @tparam table source see series.of
-- @treturn table `name, ok, reason, quantities` of the run where known, `time` and
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
    document.quantities = source.quantities -- with their error bars
  end
  return json.object(document)
end

--- Writes the series as a JSON file; NaN becomes null.
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

--- Writes the series in the format that the path's extension names.
-- @tparam table source see series.of
-- @tparam string path ending in .csv or .json
-- @treturn string the path
function series.write(source, path)
  local kind = writers[sink.extension(path)]
  if not kind then sink.fail("series: %s ends neither in .csv nor in .json", path) end
  return kind(source, path)
end

return series
