-- SPDX-License-Identifier: GPL-3.0-or-later
--- Charts of cost against error on logarithmic axes, with their Pareto front.
-- @module softworld.output.front

local checks = require "softworld.checks"
local gnuplot = require "softworld.output.gnuplot"
local sink = require "softworld.output.sink"

local front = {}

local quote, finite = gnuplot.quote, gnuplot.finite

local function check_points(points)
  if type(points) ~= "table" or #points == 0 then sink.fail("a chart: points are expected") end
  for i, p in ipairs(points) do
    local function positive(key)
      if not finite(p[key]) or p[key] <= 0 then
        sink.fail("a chart: point %d: %s = %s cannot stand on a logarithmic axis", i, key,
          checks.shown(p[key]))
      end
    end
    positive "x"
    if not p.failed then positive "y" end
  end
end

--- Returns the points that no other point beats in both x and y, by rising x.
-- Failed points take no part.
-- @tparam table points see front.draw
-- @treturn table
function front.pareto(points)
  local order, list = {}, {}
  for _, p in ipairs(points) do
    if not p.failed then order[#order + 1] = p end
  end
  table.sort(order, function(a, b)
    if a.x ~= b.x then return a.x < b.x end
    return a.y < b.y
  end)
  local best = math.huge
  for _, p in ipairs(order) do
    if p.y < best then
      list[#list + 1], best = p, p.y
    end
  end
  return list
end

local function log_range(points, key, below, above)
  local low, high = math.huge, 0
  for _, p in ipairs(points) do
    if finite(p[key]) and p[key] > 0 and not (key == "y" and p.failed) then
      low, high = math.min(low, p[key]), math.max(high, p[key])
    end
  end
  if high == 0 then low, high = 1, 1 end
  return low / below, high * above
end

local function by_series(points)
  local groups, index = {}, {}
  for _, p in ipairs(points) do
    local name = p.series or ""
    if not index[name] then
      index[name] = { name = name, good = {}, failed = {}, labels = {} }
      groups[#groups + 1] = index[name]
    end
    local list = p.failed and index[name].failed or index[name].good
    list[#list + 1] = p
  end
  return groups
end

local function rows_of(points, y)
  local rows = {}
  for i, p in ipairs(points) do rows[i] = gnuplot.number(p.x) .. " " .. gnuplot.number(y or p.y) end
  return rows
end

--- Shapes of points, one per series.
front.point_types = { 7, 5, 9, 11, 13, 6, 4, 8, 10, 12 }

local function group_plots(script, groups, top, size)
  local plots = {}
  for k, group in ipairs(groups) do
    local colour = quote(gnuplot.colours[(k - 1) % #gnuplot.colours + 1])
    -- a series of failures only still gets its line in the key
    local block = script.data(#group.good > 0 and rows_of(group.good) or { "NaN NaN" })
    plots[#plots + 1] = string.format("%s using 1:2 with points pt %d ps %g lc rgb %s %s", block,
      front.point_types[(k - 1) % #front.point_types + 1], size, colour,
      group.name ~= "" and "title " .. quote(group.name) or "notitle")
    if #group.failed > 0 then
      plots[#plots + 1] = string.format("%s using 1:2 with points pt 2 ps %g lw 2 lc rgb %s notitle",
        script.data(rows_of(group.failed, top)), 1.2 * size, colour)
    end
  end
  return plots
end

local function point_labels(script, points, top)
  for _, p in ipairs(points) do
    if p.label then
      script.add("set label %s at %s,%s left offset 0.8,%s noenhanced font ',9' textcolor rgb '#555555'",
        quote(p.label), gnuplot.number(p.x), gnuplot.number(p.failed and top or p.y),
        p.failed and "-0.8" or "0.4")
    end
  end
end

--- Labels 1, 2 and 5 of each power of ten on an axis of less than two decades, which has few powers of ten.
function front.narrow_tics(script, axis, low, high)
  if high / low >= 100 then return end
  local tics = {}
  for decade = math.floor(math.log(low, 10)), math.ceil(math.log(high, 10)) do
    for _, digit in ipairs{ 1, 2, 5 } do
      local x = digit * 10.0 ^ decade
      if x >= low and x <= high then
        tics[#tics + 1] = quote(("%g"):format(x)) .. " " .. gnuplot.number(x)
      end
    end
  end
  if #tics == 0 then return end
  script.add("set m%stics default\nset %stics (%s)", axis, axis, table.concat(tics, ", "))
end

--- Draws a log-log chart of cost against error, or similar quantities.
-- A line marks the Pareto front; failures are crosses at the top edge.
-- @tparam table options `points = { { x=, y=, series=name, failed=bool, label= }, ... }`
-- with positive x and y (y is not needed for a failure); `xlabel`, `ylabel`,
-- `title`; `path`; `size`
-- @treturn string the path, or the drawing
function front.draw(options)
  check_points(options.points)
  local points, script = options.points, gnuplot.script()
  local any_failed = false
  for _, p in ipairs(points) do any_failed = any_failed or p.failed end
  local x1, x2 = log_range(points, "x", 1.6, 1.6)
  local y1, y2 = log_range(points, "y", 2, any_failed and 6 or 2)
  local top = y2 / 1.5
  script.add "set logscale xy\nset mxtics 10\nset mytics 10"
  if options.path then script.add "set key outside right center vertical" end
  script.add(options.path and "set format xy '10^{%L}'\nset tics enhanced" or "set format xy '%.0e'")
  script.add("set xrange [%s:%s]\nset yrange [%s:%s]", gnuplot.number(x1), gnuplot.number(x2),
    gnuplot.number(y1), gnuplot.number(y2))
  front.narrow_tics(script, "x", x1, x2)
  front.narrow_tics(script, "y", y1, y2)
  script.add("set xlabel %s noenhanced\nset ylabel %s noenhanced", quote(options.xlabel or "x"),
    quote(options.ylabel or "y"))
  if options.title then script.add("set title %s noenhanced", quote(options.title)) end
  if options.path then point_labels(script, points, top) end
  local plots, best = {}, front.pareto(points)
  local dot = options.path and sink.extension(options.path) == "svg" and 0.75 or 1.1 -- same to the eye
  if #best > 0 then
    plots[1] = script.data(rows_of(best))
      .. " using 1:2 with lines lw 5 lc rgb '#c8c8c8' title 'Pareto front'"
  end
  table.move(group_plots(script, by_series(points), top, dot), 1, #points * 2, #plots + 1, plots)
  if any_failed then
    plots[#plots + 1] = string.format("NaN with points pt 2 ps %g lw 2 lc rgb '#666666' title 'failed'", dot)
  end
  script.add("plot " .. table.concat(plots, ", "))
  return gnuplot.draw(script, options.path, gnuplot.size_of(options, 900, 600))
end

return front
