-- SPDX-License-Identifier: GPL-3.0-or-later
--- Draws a table of numbers as a map of coloured cells, each with its number.
-- Reached as chart.map.
-- @module softworld.output.map

local checks = require "softworld.checks"
local gnuplot = require "softworld.output.gnuplot"
local number = require "softworld.output.number"
local sink = require "softworld.output.sink"

local map = {}

-- Dark blue to yellow with evenly rising brightness, readable with every colour vision.
local stops = {
  { 0, 34, 78 }, { 60, 77, 110 }, { 124, 123, 120 }, { 188, 175, 111 }, { 254, 232, 56 },
}
local empty = "0xeeeeee"

local function colour(share)
  local place = math.max(0, math.min(1, share)) * (#stops - 1)
  local i = math.min(math.floor(place), #stops - 2)
  local a, b, f = stops[i + 1], stops[i + 2], place - i
  local c = {}
  for k = 1, 3 do c[k] = math.floor(a[k] + f * (b[k] - a[k]) + 0.5) end
  return string.format("0x%02x%02x%02x", c[1], c[2], c[3])
end

local function finite(x)
  return type(x) == "number" and x == x and math.abs(x) < math.huge
end

local function check(options)
  local rows, columns, values = options.rows, options.columns, options.values
  if type(rows) ~= "table" or type(columns) ~= "table" or type(values) ~= "table" then
    sink.fail("a map: rows, columns and values are expected")
  end
  if #rows == 0 or #columns == 0 then sink.fail("a map: no rows or no columns") end
  for r = 1, #rows do
    if type(values[r]) ~= "table" then sink.fail("a map: no values for the row %s", checks.shown(rows[r])) end
  end
end

-- Returns a function that maps a value to 0..1 on the colours; logarithmic if
-- the values are positive and span more than a factor of 20.
local function scale_of(options)
  local low, high = math.huge, -math.huge
  for r = 1, #options.rows do
    for c = 1, #options.columns do
      local x = options.values[r][c]
      if finite(x) then low, high = math.min(low, x), math.max(high, x) end
    end
  end
  if low > 0 and high / low > 20 then
    return function(x) return math.log(x / low) / math.log(high / low) end
  end
  return function(x) return high > low and (x - low) / (high - low) or 0.5 end
end

local function cell_text(x)
  if not finite(x) then return "-" end
  return number.digits(x + 0.0, 3)
end

-- Returns the names of tics. Unlike other texts, gnuplot reads them as formats.
local function tics(names)
  local list = {}
  for i, name in ipairs(names) do
    list[i] = gnuplot.quote((checks.shown(name):gsub("%%", "%%%%"))) .. " " .. i
  end
  return "(" .. table.concat(list, ", ") .. ")"
end

local function fill(script, options)
  local share, boxes = scale_of(options), {}
  for r = 1, #options.rows do
    for c = 1, #options.columns do
      local x = options.values[r][c]
      local part = finite(x) and share(x)
      boxes[#boxes + 1] = string.format("%d %d %.2f %.2f %.2f %.2f %s", c, r,
        c - 0.49, c + 0.49, r - 0.48, r + 0.48, part and colour(part) or empty)
      script.add("set label %s at %d,%d center front noenhanced textcolor rgb %s",
        gnuplot.quote(cell_text(x)), c, r, part and part < 0.55 and "'#ffffff'" or "'#222222'")
    end
  end
  return script.data(boxes)
end

local function pad(text, width)
  return string.rep(" ", width - number.columns(text)) .. text
end

local function as_text(options)
  local lines, widths = {}, { 0 }
  local grid = { { options.ylabel and options.xlabel and options.ylabel .. " \\ " .. options.xlabel or "" } }
  for c, name in ipairs(options.columns) do grid[1][c + 1] = checks.shown(name) end
  for r, name in ipairs(options.rows) do
    grid[r + 1] = { checks.shown(name) }
    for c = 1, #options.columns do grid[r + 1][c + 1] = cell_text(options.values[r][c]) end
  end
  for _, row in ipairs(grid) do
    for c, text in ipairs(row) do widths[c] = math.max(widths[c] or 0, number.columns(text)) end
  end
  if options.title then lines[1] = options.title end
  for _, row in ipairs(grid) do
    local cells = {}
    for c, text in ipairs(row) do cells[c] = pad(text, widths[c]) end
    lines[#lines + 1] = table.concat(cells, "  ")
  end
  return table.concat(lines, "\n") .. "\n"
end

--- Draws a map: rows downwards, columns to the right, colour and number in
-- each cell; a missing or not finite value is a grey cell with a dash.
-- @tparam table options `rows`, `columns` (names); `values[row][column]`;
-- `title`, `xlabel`, `ylabel`; `path` (.svg .png .pdf, nil for a text table); `size`
-- @treturn string the path, or the table as text
function map.draw(options)
  check(options)
  if not options.path then return as_text(options) end
  local script = gnuplot.script()
  script.add "unset grid\nunset key\nset border 0\nset tics scale 0\nset style fill solid 1.0 noborder"
  script.add("set xrange [0.5:%d.5]\nset yrange [%d.5:0.5]", #options.columns, #options.rows)
  script.add("set xtics %s\nset ytics %s", tics(options.columns), tics(options.rows))
  for axis, label in pairs { x = options.xlabel or "", y = options.ylabel or "" } do
    script.add("set %slabel %s noenhanced", axis, gnuplot.quote(label))
  end
  if options.title then script.add("set title %s noenhanced", gnuplot.quote(options.title)) end
  local block = fill(script, options)
  script.add("plot %s using 1:2:3:4:5:6:7 with boxxyerror lc rgb variable", block)
  local size = options.size or { 240 + 90 * #options.columns, 140 + 42 * #options.rows }
  if not options.size and sink.extension(options.path) == "pdf" then size = { 7, 5 } end
  return gnuplot.draw(script, options.path, size)
end

return map
