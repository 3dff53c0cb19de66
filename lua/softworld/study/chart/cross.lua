-- SPDX-License-Identifier: GPL-3.0-or-later
--- A result over each parameter, side by side.
-- @module softworld.study.chart.cross
local chart = require "softworld.study.chart"
local parts = require("softworld.output.chart").parts
local gnuplot = require "softworld.output.gnuplot"

local ACROSS, MOST = 3, 12 -- charts in a row, and at most
local TICS = 5             -- on each axis, about

local function block_of(script, curve)
  local rows = {}
  for k, x in ipairs(curve.x) do rows[k] = gnuplot.number(x) .. " " .. gnuplot.number(curve.y[k]) end
  return script.data(rows)
end

-- Returns 1, 2 or 5 times a power of ten, at least `width`.
local function step_of(width)
  local power = 10 ^ math.floor(math.log(width, 10))
  for _, k in ipairs { 1, 2, 5 } do
    if k * power >= width * (1 - 1e-9) then return k * power end
  end
  return 10 * power
end

local function add_panel(script, own, o, p, list)
  local plots = {}
  for k, curve in ipairs(chart.points(own, p.name, o.y, list)) do
    local broken = curve.name == "breaks constraints"
    plots[k] = ("%s using 1:2 with points pt 7 ps %g lc rgb '%s' notitle"):format(block_of(script, curve),
      o.path and 0.35 or 1, gnuplot.colours[broken and 2 or 1])
  end
  script.add("%sset logscale x", p.log and "" or "un")
  script.add("%sset logscale y", (o.log or ""):find "y" and "" or "un")
  script.add("set xlabel %s noenhanced", gnuplot.quote(chart.label(own, p.name)))
  if p.kind == "choice" then
    local tics = {}
    for k, c in ipairs(p.choices) do tics[k] = ("%s %d"):format(gnuplot.quote(tostring(c)), k) end
    script.add("set xtics (%s)\nset xrange [0.5:%g]", table.concat(tics, ", "), #p.choices + 0.5)
  else
    script.add("set xrange [%s:%s]", gnuplot.number(p.low), gnuplot.number(p.high))
    if p.log then
      script.add "set xtics autofreq"
      parts.narrow_tics(script, "x", p.low, p.high)
    else
      script.add("set xtics %s", gnuplot.number(step_of((p.high - p.low) / TICS)))
    end
  end
  script.add("plot " .. table.concat(plots, ", "))
end

local function draw(own, o, list)
  local script, count = gnuplot.script(), math.min(MOST, #own.parameters)
  local across = math.min(ACROSS, count)
  local down = math.ceil(count / across)
  if o.path then
    local title = own.name .. (#own.constraints > 0 and " (orange: breaks constraints)" or "")
    script.add("set multiplot layout %d,%d title %s noenhanced", down, across, gnuplot.quote(title))
  end
  script.add("set ylabel %s noenhanced", gnuplot.quote(chart.label(own, o.y)))
  for i = 1, count do add_panel(script, own, o, own.parameters[i], list) end
  if o.path then script.add "unset multiplot" end
  return gnuplot.draw(script, o.path, chart.size(o, 90 + 260 * across, 50 + 240 * down))
end

return { doc = "y over each parameter, side by side", needs = "y", draw = draw }
