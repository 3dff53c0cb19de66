-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs gnuplot in a separate process, from a temporary script that contains the data.
-- @module softworld.output.gnuplot

local letters = require "softworld.output.letters"
local sink = require "softworld.output.sink"
local whole = require "softworld.output.whole"

local gnuplot = {}

--- Colours that stay distinct with the common colour blindnesses (Okabe and Ito).
gnuplot.colours = { "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000" }

--- Returns a text as a gnuplot string without special meaning.
-- @tparam string text
-- @treturn string in quotes, on one line
function gnuplot.quote(text)
  text = letters.utf8(tostring(text)):gsub("%c", " ")
  -- gnuplot takes two single quotes at the start for an empty string
  if text:sub(1, 1) ~= "'" then return "'" .. text:gsub("'", "''") .. "'" end
  return '"' .. text:gsub('["\\`]', function(c) return ("\\%03o"):format(c:byte()) end) .. '"'
end

--- Returns width and height of a drawing; see softworld.output.chart.
function gnuplot.size_of(options, width, height)
  if options.size then return options.size end
  if not options.path then return { 79, 24 } end
  if sink.extension(options.path) == "pdf" then return { 7, math.max(4, height / 130) } end
  return { width, height }
end

--- True for a finite number.
function gnuplot.finite(x)
  return x ~= nil and x == x and x ~= math.huge and x ~= -math.huge
end

--- Returns a number for gnuplot; nil and numbers that are not finite leave a gap.
-- @tparam ?number x
-- @treturn string
function gnuplot.number(x)
  if not gnuplot.finite(x) then return "NaN" end
  return sink.number(x)
end

local terminals = {
  svg = 'svg enhanced size %g,%g background "#ffffff" font "Arial,13" name "%s"',
  png = 'pngcairo enhanced size %g,%g background "#ffffff" font "Sans,11"',
  pdf = 'pdfcairo enhanced size %g,%g background "#ffffff" font "Sans,11"',
  dumb = "dumb enhanced size %g,%g noattributes",
}

-- Style of all charts: the grid is light and lies behind.
local style = [[
set encoding utf8
set format "%g"
set border 3 lc rgb "#444444"
set tics nomirror out scale 0.6 textcolor rgb "#222222" noenhanced
set grid back lt 1 lc rgb "#dedede" lw 0.8
set key noenhanced above left horizontal Left reverse samplen 1.8 textcolor rgb "#222222"
set bmargin
]]

-- Style of drawings of characters, which read better without a grid.
local dumb_style = [[
set encoding utf8
set format "%g"
set tics nomirror noenhanced
set key noenhanced above left horizontal
]]

local function complaint(text, script)
  local kept = {}
  for line in text:gmatch("[^\n]+") do
    if line:find("%S") and not line:find("^%s*%^%s*$") then
      kept[#kept + 1] = line:gsub(script, "script", 1)
    end
  end
  return table.concat(kept, " ", math.max(1, #kept - 1))
end

--- Returns a new script: a table with add(format, ...), which appends a line, and
-- data(rows), which appends a data block and returns its name.
-- @treturn table
function gnuplot.script()
  local script = { lines = {}, blocks = 0 }
  function script.add(text, ...)
    script.lines[#script.lines + 1] = select("#", ...) > 0 and string.format(text, ...) or text
  end
  function script.data(rows)
    script.blocks = script.blocks + 1
    local name = "$data" .. script.blocks
    script.add(name .. " << END_OF_DATA")
    for _, row in ipairs(rows) do script.lines[#script.lines + 1] = row end
    script.add "END_OF_DATA"
    return name
  end
  return script
end

-- Runs gnuplot. It writes to its standard output, because it accepts no file name with a line end in it. The
-- id is part of the names within an SVG, so that several SVGs fit one page.
local function run(kind, size, script, output, id)
  local name = sink.scratch()
  local ok, failure = pcall(function()
    local file = assert(io.open(name, "wb"))
    local done, why = file:write(table.concat({
      "set terminal " .. string.format(terminals[kind], size[1], size[2], id),
      kind == "dumb" and dumb_style or style, table.concat(script.lines, "\n"), "unset output\n",
    }, "\n"))
    file:close()
    if not done then sink.fail("cannot write %s: %s", name, why) end
    local fine, said, exit = sink.run("exec gnuplot -d " .. sink.quote(name) .. " >" .. sink.quote(output))
    if not fine then
      sink.fail("gnuplot failed (exit code %d): %s", exit, complaint(said, name:gsub("%p", "%%%0")))
    end
  end)
  sink.discard(name)
  if ok then return end
  sink.discard(output)
  error(failure, 0)
end

-- Escapes "]]>" of titles and names in an SVG: gnuplot writes ">" as it is, and XML allows no "]]>" in texts.
-- Its own part of the file has none, because it has no CDATA without a mouse.
local function escape_ends(output)
  local text, count = sink.read_file(output):gsub("%]%]>", "]]&gt;")
  if count == 0 then return end
  local file = assert(io.open(output, "wb"))
  local good, why = file:write(text)
  if not (file:close() and good) then sink.fail("cannot write %s: %s", output, why) end
end

--- Draws a script into a file, or as characters.
-- @tparam table script from gnuplot.script
-- @tparam ?string path ending in .svg, .png or .pdf; nil for characters
-- @tparam {width,height} size [px], inches for .pdf, characters without a path
-- @treturn string the path, or the drawing as text without a path
-- @raise if gnuplot is missing or fails, or the path cannot be written
function gnuplot.draw(script, path, size)
  sink.need("gnuplot", "gnuplot-nox", "a chart")
  if not path then
    local output = sink.scratch()
    run("dumb", size, script, output)
    local text = sink.read_file(output)
    sink.discard(output)
    return (text:gsub("\f", ""):gsub("[ \t]+\n", "\n"):gsub("^\n+", ""):gsub("\n+$", "\n"))
  end
  local kind = sink.extension(path)
  if not terminals[kind] or kind == "dumb" then
    sink.fail("a chart: %s ends in none of .svg .png .pdf", path)
  end
  local output = sink.temporary(path)
  run(kind, size, script, output, "c_" .. sink.base(path):gsub("[^%w]", "_"))
  if kind == "svg" then escape_ends(output) end
  whole.commit(output, path)
  return path
end

return gnuplot
