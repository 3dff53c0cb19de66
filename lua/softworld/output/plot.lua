-- SPDX-License-Identifier: GPL-3.0-or-later
--- Draws charts of any curves through gnuplot: lines and points, error bars, logarithmic axes.
-- @module softworld.output.plot
local chart = require "softworld.output.chart"
local gnuplot = require "softworld.output.gnuplot"
local series = require "softworld.output.series"
local sink = require "softworld.output.sink"

local plot = {}

local quote, parts = gnuplot.quote, chart.parts
local finite = parts.finite

-- Returns one panel per unit, in the order of first use; only one panel if the user gives a label.
local function panels_of(o)
  local panels, by_unit = {}, {}
  for _, c in ipairs(o.curves) do
    local key = o.ylabel and "" or c.unit or ""
    if not by_unit[key] then
      by_unit[key] = { unit = c.unit or "" }
      panels[#panels + 1] = by_unit[key]
    end
    table.insert(by_unit[key], c)
  end
  return panels
end

-- Returns the lowest and highest finite value of x or y with errors; only above 0 on a logarithmic axis.
local function range_of(curves, key, log)
  local low, high = math.huge, -math.huge
  for _, c in ipairs(curves) do
    for i, x in ipairs(c[key]) do
      local e = key == "y" and c.error and c.error[i] or 0
      for _, v in ipairs { x - e, x, x + e } do
        if finite(v) and (not log or v > 0) then low, high = math.min(low, v), math.max(high, v) end
      end
    end
  end
  return low, high
end

local function check(o, log)
  for _, c in ipairs(o.curves) do
    for _, key in ipairs { "x", "y" } do
      local low, high = range_of({ c }, key, log[key])
      if low > high then
        local name = c.name ~= "" and c.name or "a curve"
        sink.fail("a chart: %s of '%s' has no %s", key, name,
          log[key] and "value above 0, which a logarithmic axis needs" or "finite value")
      end
    end
  end
end

local function axis(script, name, low, high, log)
  script.add("%sset logscale %s", log and "" or "un", name)
  if not log then return script.add("set %srange [*:*]\nset %stics autofreq", name, name) end
  script.add("set %srange [%s:%s]", name, gnuplot.number(low / 1.3), gnuplot.number(high * 1.3))
  script.add("set %stics autofreq", name)
  parts.narrow_tics(script, name, low / 1.3, high * 1.3)
end

local function rows_of(c)
  if not c.error and c.style == "line" then return parts.thinned(c.x, c.y) end
  local rows = {}
  for i, x in ipairs(c.x) do
    rows[i] = gnuplot.number(x) .. " " .. gnuplot.number(c.y[i])
    if c.error then rows[i] = rows[i] .. " " .. gnuplot.number(c.error[i]) end
  end
  return rows
end

-- Adds the plots of one curve: a line, points, error bars.
local function add_curve(script, plots, c, k, title)
  local block = script.data(rows_of(c))
  local colour = quote(gnuplot.colours[(k - 1) % #gnuplot.colours + 1])
  local point = ("pt %d ps 0.7"):format(parts.point_types[(k - 1) % #parts.point_types + 1])
  local look = "lw 1.6 lc rgb " .. colour
  local dash = (k - 1) // #gnuplot.colours % 5 + 1
  local function put(with) -- only the first has a title
    plots[#plots + 1] = ("%s %s %s"):format(block, with, title)
    title = "notitle"
  end
  if c.style == "line" then put(("using 1:2 with lines %s dt %d"):format(look, dash)) end
  if c.style == "both" then put(("using 1:2 with linespoints %s dt %d %s"):format(look, dash, point)) end
  if c.error then put(("using 1:2:3 with yerrorbars %s %s"):format(look, point))
  elseif c.style == "points" then put(("using 1:2 with points %s %s"):format(look, point)) end
end

local function draw_panel(script, o, panel, log, text)
  local plots, single = {}, #panel == 1 and not text
  for k, c in ipairs(panel) do
    local hidden = c.name == "" or single and (o.ylabel or c.of_run)
    local name = text and o.ylabel == nil and series.head(c.name, panel.unit) or c.name
    add_curve(script, plots, c, k, hidden and "notitle" or "title " .. quote(name))
  end
  local low, high = range_of(panel, "y", log.y)
  script.add("set format y '%s'", "%g")
  axis(script, "y", low, high, log.y)
  local name = single and panel[1].what or parts.quantities[panel.unit] or ""
  script.add("set ylabel %s noenhanced", quote(o.ylabel or text and "" or series.head(name, panel.unit)))
  script.add("plot " .. table.concat(plots, ", "))
end

local function x_axis(script, o, log)
  local low, high = range_of(o.curves, "x", log.x)
  if log.x then return axis(script, "x", low, high, true) end
  if low >= high then low, high = low - 0.5, low + 0.5 end
  local around = o.curves[1].of_run and 0 or 0.02 * (high - low)
  script.add("set xrange [%s:%s]", gnuplot.number(low - around), gnuplot.number(high + around))
end

--- Draws curves.
-- @tparam table o `curves`: { name, unit, x, y, error, style, of_run, what }; path, title, xlabel,
-- ylabel, log, size, see softworld.run.plot
-- @treturn string the path, or the drawing
function plot.draw(o)
  for _, c in ipairs(o.curves) do
    if c.of_run and parts.is_bend(c.what) then c.y = parts.tight(c.y) end
  end
  local log = { x = (o.log or ""):find "x" ~= nil, y = (o.log or ""):find "y" ~= nil }
  check(o, log)
  local panels, script, text = panels_of(o), gnuplot.script(), not o.path
  local size = parts.size_of(o, parts.natural_size(panels))
  local of_runs = o.curves[1].of_run
  x_axis(script, o, log)
  if not text then parts.stack(script, panels, o.title, size, o.path)
  elseif o.title then script.add("set title %s noenhanced", quote(o.title)) end
  for i, panel in ipairs(panels) do
    if i == #panels or text then
      script.add("set format x '%s'\nset xlabel %s noenhanced", "%g",
        quote(o.xlabel or of_runs and "t [s]" or ""))
    end
    draw_panel(script, o, panel, log, text)
    if i == 1 and text then script.add "unset title" end
  end
  if not text then script.add "unset multiplot" end
  return gnuplot.draw(script, o.path, size)
end

return plot
