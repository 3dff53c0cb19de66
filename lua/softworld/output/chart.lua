-- SPDX-License-Identifier: GPL-3.0-or-later
--- Charts through gnuplot: SVG, PNG or PDF files, or characters for the terminal.
-- Without a path each function returns the drawing as text. Sizes are in px
-- (default {900, 480}), in inches for .pdf, in characters without a path.
-- Names are drawn as they are, whatever characters they contain.
-- @module softworld.output.chart

local checks = require "softworld.checks"
local front = require "softworld.output.front"
local gnuplot = require "softworld.output.gnuplot"
local map = require "softworld.output.map"
local number = require "softworld.output.number"
local range = require "softworld.output.range"
local series = require "softworld.output.series"
local sink = require "softworld.output.sink"

local chart = {}

local quote, size_of, finite = gnuplot.quote, gnuplot.size_of, gnuplot.finite
local most_points = 4000 -- in one curve; more are thinned, and peaks are kept

-- Returns the lowest and the highest sample of each stretch, in the order of time.
local function thinned(time, values)
  local rows, stretch = {}, math.max(1, math.ceil(2 * #time / most_points))
  local function put(i) rows[#rows + 1] = gnuplot.number(time[i]) .. " " .. gnuplot.number(values[i]) end
  for first = 1, #time, stretch do
    local low, high = first, first
    for i = first, math.min(first + stretch - 1, #time) do
      if not finite(values[low]) or values[i] < values[low] then low = i end
      if not finite(values[high]) or values[i] > values[high] then high = i end
    end
    put(math.min(low, high))
    if low ~= high then put(math.max(low, high)) end
  end
  return rows
end

local many = 8 -- curves of one unit; with more, components of vectors are drawn only if named

-- True for a component of a vector whose length is among the columns.
local function is_component(column, lengths)
  local vector = column.name:match "^(.*)_[xyz]$"
  return vector and lengths[vector]
end

local function usual_columns(data)
  local count, lengths, most, list = {}, {}, 0, {}
  for _, column in ipairs(data.columns) do
    local unit = column.unit or ""
    count[unit] = (count[unit] or 0) + 1
    lengths[column.name], most = true, math.max(most, count[unit])
  end
  if most <= many then return data.columns end
  for _, column in ipairs(data.columns) do
    if not is_component(column, lengths) then list[#list + 1] = column end
  end
  return list
end

local function wanted_columns(data, names)
  if not names then return usual_columns(data) end
  local list = {}
  for i, name in ipairs(names) do
    for _, column in ipairs(data.columns) do
      if column.name == name then list[i] = column end
    end
    if not list[i] then
      local known = {}
      for k, column in ipairs(data.columns) do known[k] = column.name end
      sink.fail("a chart: the run has no series named %s; it has: %s", checks.shown(name),
        table.concat(known, ", "))
    end
  end
  return list
end

local straight = 1e6 -- bend radii above this are rounding [m]

local function is_bend(name) return name:find "%.bend_radius$" ~= nil end

local function has_values(column)
  local most = is_bend(column.name) and straight or math.huge
  for _, x in ipairs(column.values) do
    if finite(x) and x < most then return true end
  end
  return false
end

local steep = 100 -- bend radii above this multiple of the smallest count as straight [-]

-- Returns bend radii without those of almost straight wire, which would leave no room for the others.
local function tight(all)
  local least, values = straight / steep, {}
  for _, x in ipairs(all) do if x > 0 then least = math.min(least, x) end end
  for i, x in ipairs(all) do values[i] = x <= steep * least and x or 0 / 0 end
  return values
end

-- Returns one panel per unit, in the order of first use; bend radii have a panel of their own.
local function panels_of(columns)
  local panels, by_unit = {}, {}
  for _, column in ipairs(columns) do
    if has_values(column) then
      local unit, bend = column.unit or "", is_bend(column.name)
      local key = bend and "bend" or unit
      if not by_unit[key] then
        by_unit[key] = { unit = unit, bend = bend }
        panels[#panels + 1] = by_unit[key]
      end
      table.insert(by_unit[key],
        bend and { name = column.name, unit = column.unit, values = tight(column.values) } or column)
    end
  end
  if by_unit["N m"] then by_unit["N m"].rounding = range.moment_rounding(columns) end
  if #panels == 0 then sink.fail("a chart: no series has a finite value to draw") end
  return panels
end

local function curve(script, time, column, k, title)
  local block = script.data(thinned(time, column.values))
  local colours = gnuplot.colours
  return string.format("%s using 1:2 with lines lw 1.6 lc rgb %s dt %d %s", block,
    quote(colours[(k - 1) % #colours + 1]), (k - 1) // #colours % 5 + 1, title)
end

-- Returns 1, 2 or 5 times a power of ten, so that about five steps fit into the span.
local function nice_step(span)
  local power = 10.0 ^ math.floor(math.log(span / 5, 10))
  local lead = span / 5 / power
  return power * (lead < 1.5 and 1 or lead < 3.5 and 2 or lead < 7.5 and 5 or 10)
end

-- Names the peaks beyond the range above the panel's corner.
local function peaks_label(script, peaks, unit)
  if #peaks == 0 then return end
  script.add("set label 1 %s at graph 1, graph 1 right offset 0,0.6 noenhanced font ',11' %s",
    quote(range.beyond(peaks, unit)), "textcolor rgb '#555555'")
end

-- Sets the vertical axis; only peaks of few steps may be beyond it, and are named.
local function value_axis(script, time, panel)
  script.add(panel.bend and "set logscale y" or "unset logscale y")
  script.add "unset label 1"
  if panel.bend then
    script.add "set yrange [*:*]\nset ytics autofreq"
    return
  end
  local low, high, peaks = range.of(time, panel)
  if panel.rounding and math.max(-low, high) <= panel.rounding then
    script.add("set yrange [%g:%g]\nset ytics (0)", -panel.rounding, panel.rounding)
    return
  end
  if high - low <= 1e-12 * math.max(math.abs(low), math.abs(high)) then
    script.add "set yrange [*:*]\nset ytics autofreq"
    return
  end
  local step = nice_step(high - low)
  script.add("set yrange [%s:%s]\nset ytics %s", gnuplot.number(math.floor(low / step) * step),
    gnuplot.number(math.ceil(high / step) * step), gnuplot.number(step))
  peaks_label(script, peaks, panel.unit)
end

local quantities = { N = "force", ["N m"] = "moment", J = "energy", m = "length", ["m/s"] = "speed",
  Pa = "pressure", K = "temperature", Hz = "frequency" }

-- Draws a panel. A single curve is named on its axis, several in the key. Drawings of characters have
-- no room beside the axis, so the key names every curve there.
local function panel_plot(script, time, panel, text)
  local curves, single = {}, #panel == 1
  for k, column in ipairs(panel) do
    local title = single and "notitle" or "title " .. quote(column.name)
    if text then title = "title " .. quote(series.head(column.name, panel.unit)) end
    curves[k] = curve(script, time, column, k, title)
  end
  if not text then value_axis(script, time, panel) end
  local name = single and panel[1].name or panel.bend and "bend radius" or quantities[panel.unit] or ""
  local axis = text and "" or series.head(name, panel.unit)
  script.add("set ylabel %s noenhanced", quote(axis))
  script.add("plot " .. table.concat(curves, ", "))
end

local function time_range(time)
  local low, high = math.huge, -math.huge
  for _, t in ipairs(time) do low, high = math.min(low, t), math.max(high, t) end
  if low >= high then low, high = low - 0.5, low + 0.5 end
  return low, high
end

-- Returns the room for the longest name in a key, at the right of all panels alike [px].
local function key_room(panels)
  local longest = 0
  for _, panel in ipairs(panels) do
    for _, column in ipairs(#panel > 1 and panel or {}) do
      longest = math.max(longest, number.columns(column.name))
    end
  end
  return longest > 0 and 68 + 8.2 * longest or 26
end

local key_line = 20 -- height of a name in a key [px]

-- Returns the size that a chart needs for its panels and their keys [px].
local function natural_size(panels)
  local most = 0
  for _, panel in ipairs(panels) do most = math.max(most, #panel) end
  local panel_height = math.max(184, key_line * (most + 1))
  local height = #panels > 1 and 108 + (panel_height + 36) * #panels or math.max(420, panel_height + 110)
  return math.max(900, 116 + key_room(panels) + 480), math.ceil(height)
end

-- Starts a stack of panels of equal width and height, with room for the title and their keys.
local function stack(script, panels, title, size, path)
  local dot = sink.extension(path) == "pdf" and 1 / 96 or 1
  local wide, high = dot / size[1], dot / size[2]
  script.add("set multiplot layout %d,1%s margins %.4f,%.4f,%.4f,%.4f spacing 0,%.4f", #panels,
    title and " title " .. quote(title) .. " noenhanced" or "", 116 * wide,
    math.max(0.3, 1 - key_room(panels) * wide), 66 * high, 1 - (title and 52 or 20) * high, 36 * high)
  script.add "set format x ''\nset key at graph 1.02,graph 1 left top vertical"
end

--- Draws time series: one panel per unit, a common time axis.
-- @tparam table options `run` (or `series`, see series.of); `columns`, names
-- of the series wanted (default all); `energy = true` draws the energies of
-- the run's frames instead; `mean` draws running means over this time [s]
-- instead of the samples, and the title says so; `title` (default the run's name); `path`; `size`
-- @treturn string the path, or the drawing
function chart.series(options)
  local source = options.run or options.series
  local data = options.energy and series.energy(source) or series.of(source)
  local script, title = gnuplot.script(), options.title or source.name
  if options.mean then
    data = series.mean(data, options.mean)
    title = (title and title .. ", " or "") .. ("means over %g s"):format(options.mean)
  end
  local panels = panels_of(wanted_columns(data, options.columns))
  local size = size_of(options, natural_size(panels))
  local low, high = time_range(data.time)
  script.add("set xrange [%s:%s]", gnuplot.number(low), gnuplot.number(high))
  local text = not options.path
  if not text then
    stack(script, panels, title, size, options.path)
  elseif title then
    script.add("set title %s noenhanced", quote(title))
  end
  for i, panel in ipairs(panels) do
    if i == #panels or text then script.add "set format x '%g'\nset xlabel 't [s]'" end
    panel_plot(script, data.time, panel, text)
    if i == 1 and text then script.add "unset title" end
  end
  if not text then script.add "unset multiplot" end
  return gnuplot.draw(script, options.path, size)
end

--- Cost against error; see softworld.output.front.
-- @function chart.front
chart.front = front.draw

--- The points of the Pareto front.
-- @function chart.pareto
chart.pareto = front.pareto

--- A map of coloured cells; see softworld.output.map.
-- @function chart.map
chart.map = map.draw

--- For softworld.output.plot.
chart.parts = { size_of = size_of, finite = finite, thinned = thinned, stack = stack, tight = tight,
  is_bend = is_bend, natural_size = natural_size, quantities = quantities,
  narrow_tics = front.narrow_tics, point_types = front.point_types }

return chart
