-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads and writes CSV files of numbers. Read errors say where; files are written whole.
-- Cells are separated by `,` or `;` or tabs (whichever the first row uses),
-- numbers have a decimal point, `#` starts a comment line, empty lines are skipped.
-- A first row that is not numbers names the columns.
-- @module softworld.csv
local checks = require "softworld.checks"
local counted = require "softworld.output.number".count
local sink = require "softworld.output.sink"

local csv = {}

local function fail(name, line, column, format, ...)
  error(("%s:%d:%d: "):format(name, line, column) .. format:format(...), 0)
end

local function delimiter_of(line)
  for _, delimiter in ipairs { "\t", ";", "," } do
    if line:find(delimiter, 1, true) then return delimiter end
  end
  return ","
end

-- Reads the quoted cell that starts at position at. Returns its text and the position after it.
local function quoted(line, at, name, number)
  local parts, from = {}, at + 1
  while true do
    local stop = line:find('"', from, true)
    if not stop then fail(name, number, at, "a quoted cell does not end on its line") end
    parts[#parts + 1] = line:sub(from, stop - 1)
    if line:sub(stop + 1, stop + 1) ~= '"' then return table.concat(parts, '"'), stop + 1 end
    from = stop + 2
  end
end

-- Returns the cells of a line and the columns (of characters, from 1) where they begin.
local function split(line, delimiter, name, number)
  local cells, columns, at = {}, {}, 1
  while true do
    local first = line:find("[^ ]", at) or at
    local stop = line:find(delimiter, at, true) or #line + 1
    local cell = line:sub(at, stop - 1):match "^%s*(.-)%s*$"
    if line:sub(first, first) == '"' then
      local after
      cell, after = quoted(line, first, name, number)
      stop = line:find(delimiter, after, true) or #line + 1
      if line:sub(after, stop - 1):find "%S" then
        fail(name, number, after, "text after a quoted cell")
      end
    end
    cells[#cells + 1], columns[#columns + 1] = cell, math.min(first, stop)
    if stop > #line then return cells, columns end
    at = stop + 1
  end
end

local function number_in(cell)
  if cell:find "^[+-]?%.?%d" and not cell:find "[xX]" then return tonumber(cell) end
end

local function complain(data, line, column, cell, title)
  local why = "expected a number with a decimal point"
  if cell == "" then
    fail(data.name, line, column, "the cell of column '%s' is empty; %s", title, why)
  elseif cell:find "^[+-]?%d+,%d+$" then
    fail(data.name, line, column, "'%s' in column '%s' has a decimal comma; %s: %s", cell, title, why,
      (cell:gsub(",", ".")))
  end
  fail(data.name, line, column, "'%s' in column '%s' is not a number; %s", cell, title, why)
end

local function add_header(data, cells, columns, line)
  for i, cell in ipairs(cells) do
    local title = sink.of_cell(cell)
    if title == "" then fail(data.name, line, columns[i], "column %d has no name", i) end
    if data.columns[title] then
      fail(data.name, line, columns[i], "there are two columns named '%s'", title)
    end
    data.names[i], data.columns[title], data.places[title] = title, {}, {}
  end
  data.header, data.header_places = line, columns
end

local function add_row(data, cells, columns, line, text)
  if #cells ~= #data.names then
    fail(data.name, line, columns[math.min(#cells, #data.names + 1)],
      "%s in this row, but %s (%s)", counted(#cells, "cell"), counted(#data.names, "column"),
      table.concat(data.names, ", "))
  end
  local row = data.count + 1
  for i, title in ipairs(data.names) do
    local cell = cells[i]
    local value = text and text[title] and sink.of_cell(cell) or number_in(cell)
    if not value then complain(data, line, columns[i], cell, title) end
    if value == math.huge or value == -math.huge then
      fail(data.name, line, columns[i], "'%s' in column '%s' is too large", cell, title)
    end
    data.columns[title][row], data.places[title][row] = value, columns[i]
  end
  data.count, data.lines[row] = row, line
end

local function is_header(cells)
  for _, cell in ipairs(cells) do
    if cell ~= "" and not number_in(cell) and not cell:find "^[+-]?%d+,%d" then return true end
  end
  return false
end

-- Names the columns of a file whose first row is numbers already.
local function names_for(data, cells, line, names)
  if type(names) == "function" then names = names(#cells) end
  if not names then
    fail(data.name, line, 1, "the first row must name the columns, but '%s' is a number", cells[1])
  end
  return names
end

--- Reads CSV text. Returns `{ name, names = {...}, columns = { name = {numbers} },
-- count = rows, lines = { line of row }, places = { name = { column of row } },
-- header = line, header_places = { column of name } }`.
-- options: `names` (for files without a first row of names: an array, or a function that
-- takes the number of columns and returns one), `text` (set of columns that stay strings).
function csv.parse(text, name, options)
  options = options or {}
  local data = { name = name or "text", names = {}, columns = {}, places = {}, lines = {}, count = 0 }
  local delimiter, number = nil, 0
  text = text:gsub("^\239\187\191", ""):gsub("\r\n?", "\n")
  for line in (text:sub(-1) == "\n" and text or text .. "\n"):gmatch "(.-)\n" do
    number = number + 1
    if line:find "%S" and not line:find "^%s*#" then
      delimiter = delimiter or delimiter_of(line)
      local cells, columns = split(line, delimiter, data.name, number)
      if #data.names > 0 then
        add_row(data, cells, columns, number, options.text)
      elseif is_header(cells) then
        add_header(data, cells, columns, number)
      else
        add_header(data, names_for(data, cells, number, options.names), columns, number)
        add_row(data, cells, columns, number, options.text)
      end
    end
  end
  return data
end

--- Reads a CSV file, or CSV text (a string with a line end in it).
function csv.read(source, options)
  if type(source) ~= "string" then
    error("csv.read takes a file name or CSV text, got " .. type(source), 2)
  end
  if source:find "\n" then return csv.parse(source, "text", options) end
  local text = sink.read_file(source)
  return csv.parse(text, source, options)
end

local function lines_of(names, columns)
  local lines, count, head = {}, 0, {}
  for i, name in ipairs(names) do
    local column = columns[name]
    if type(column) ~= "table" then
      error(("csv.write: there is no column '%s'"):format(checks.shown(name)), 0)
    end
    head[i], count = sink.cell(name), math.max(count, #column)
  end
  lines[1] = table.concat(head, ",")
  for row = 1, count do
    local cells = {}
    for i, name in ipairs(names) do cells[i] = sink.cell(columns[name][row]) end
    lines[row + 1] = table.concat(cells, ",")
  end
  lines[#lines + 1] = ""
  return lines
end

--- Writes columns (tables by name) in the order of names. Numbers keep all their
-- digits. The file appears whole or not at all.
function csv.write(path, names, columns)
  return sink.write_file(path, table.concat(lines_of(names, columns), "\n"))
end

return csv
