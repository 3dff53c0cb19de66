-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes rows of checks as lines of a terminal, as CSV and as JSON.
-- @module softworld.check.cells
local json = require "softworld.output.json"
local number = require "softworld.output.number"
local sink = require "softworld.output.sink"

local cells = {}

--- Returns a text without control characters.
function cells.one_line(text) return (tostring(text):gsub("%c", " ")) end

--- Returns a text also without the Unicode characters that change the order of what follows, U+202A to U+202E
-- and U+2066 to U+2069, so that a name cannot make a terminal show other numbers.
function cells.plain(text)
  return (cells.one_line(text):gsub("\226\128[\170-\174]", " "):gsub("\226\129[\166-\169]", " "))
end

--- Returns a number with its unit; "" for other values.
function cells.number(value, unit)
  if type(value) ~= "number" then return "" end
  return number.text(value, unit and unit ~= "-" and cells.plain(unit) or nil)
end

local function pad(text, width) return text .. (" "):rep(width - number.columns(text)) end

--- Adds lines of cells, aligned, with the note of each below it.
function cells.add_table(lines, list)
  local widths = {}
  for _, line in ipairs(list) do
    for c, text in ipairs(line) do widths[c] = math.max(widths[c] or 0, number.columns(text)) end
  end
  for _, line in ipairs(list) do
    local padded = {}
    for c, text in ipairs(line) do padded[c] = pad(text, widths[c]) end
    lines[#lines + 1] = ("  " .. table.concat(padded, "  ")):gsub("%s+$", "")
    if line.note then lines[#lines + 1] = "        " .. cells.plain(line.note) end
  end
end

-- --- files -----------------------------------------------------------------------------------------

--- Raises an error unless path is a file name. what: the method; extension: with its article.
function cells.check_path(what, path, extension)
  if type(path) == "string" and path ~= "" then return end
  error(("%s expects the name of %s file, got %s"):format(what, extension, path == "" and "''"
    or type(path)), 0)
end

--- Writes rows as CSV.
function cells.write_csv(path, columns, rows)
  return sink.write_file(path, function(write)
    write(table.concat(columns, ",") .. "\n")
    for _, row in ipairs(rows) do
      local line = {}
      for c, name in ipairs(columns) do line[c] = sink.cell(row[name]) end
      write(table.concat(line, ",") .. "\n")
    end
  end)
end

-- Returns numbers that JSON lacks as texts: "inf", "nan".
local function known(value)
  if type(value) == "number" and value - value ~= 0 then return sink.number(value) end
  return value
end

--- Returns rows with these columns, ready for JSON.
function cells.known_rows(columns, rows)
  local list = {}
  for i, row in ipairs(rows) do
    list[i] = json.object{}
    for _, name in ipairs(columns) do list[i][name] = known(row[name]) end
  end
  return list
end

--- Writes a document as JSON.
function cells.write_json(path, document)
  return sink.write_file(path, function(write)
    json.write(document, write)
    write "\n"
  end)
end

return cells
