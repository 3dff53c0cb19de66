-- SPDX-License-Identifier: GPL-3.0-or-later
--- Draws outlines of a wire's sections over one another, as seen along the wire.
-- @module softworld.output.outlines
local gnuplot = require "softworld.output.gnuplot"
local vec = require "softworld.vec"

local outlines = {}

-- Returns the points of an outline across the wire and upwards, closed, as lines of text [mm].
local function flat(section)
  local up = vec.unit(vec.across({ 0, 0, 1 }, section.tangent))
    or vec.unit(vec.across({ 0, 1, 0 }, section.tangent))
  local side, lines = vec.cross(up, section.tangent), {}
  for i = 0, #section.outline do
    local p = vec.sub(section.outline[i % #section.outline + 1], section.middle)
    lines[#lines + 1] = ("%.9g %.9g"):format(1e3 * vec.dot(p, side), 1e3 * vec.dot(p, up))
  end
  return lines
end

--- Draws a list of { name, section } into a file (.svg, .png, .pdf).
function outlines.draw(path, list, title)
  local script, plots = gnuplot.script(), {}
  script.add [[
set size ratio -1
set xlabel 'across [mm]'
set ylabel 'up [mm]'
set key outside right center vertical]]
  if title then script.add("set title " .. gnuplot.quote(title) .. " noenhanced") end
  for i, item in ipairs(list) do
    plots[i] = ("%s using 1:2 with linespoints pt 7 ps 0.5 lw 2 lc rgb '%s' title %s"):format(
      script.data(flat(item[2])), gnuplot.colours[(i - 1) % #gnuplot.colours + 1], gnuplot.quote(item[1]))
  end
  script.add("plot " .. table.concat(plots, ", "))
  return gnuplot.draw(script, path, { 560, 420 })
end

return outlines
