-- SPDX-License-Identifier: GPL-3.0-or-later
--- A histogram of values.
-- @module softworld.study.chart.histogram
local chart = require "softworld.study.chart"
local gnuplot = require "softworld.output.gnuplot"
local judge = require "softworld.study.judge"

local MOST, FEWEST = 60, 5 -- bins

-- Returns bins of equal width: twice the interquartile range over the cube root of the count (D. Freedman,
-- P. Diaconis 1981).
local function bins_of(values)
  table.sort(values)
  local n, low, high = #values, values[1], values[#values]
  if low == high then return { low - 0.5, 1, 1 } end
  local quarter = values[math.ceil(0.75 * n)] - values[math.ceil(0.25 * n)]
  local count = quarter > 0 and math.ceil((high - low) / (2 * quarter / n ^ (1 / 3))) or FEWEST
  count = math.max(FEWEST, math.min(MOST, count))
  return { low, (high - low) / count, count }
end

-- Returns how many values are in each bin.
local function counts_of(values, bins)
  local low, width, count = bins[1], bins[2], bins[3]
  local counts = {}
  for k = 1, count do counts[k] = 0 end
  for _, v in ipairs(values) do
    local k = math.max(1, math.min(count, 1 + math.floor((v - low) / width)))
    counts[k] = counts[k] + 1
  end
  return counts
end

local function rows_of(values, bins)
  local rows = {}
  for k, c in ipairs(counts_of(values, bins)) do
    rows[k] = ("%s %d"):format(gnuplot.number(bins[1] + (k - 0.5) * bins[2]), c)
  end
  return rows
end

-- Adds limits of the constraint on the result, as lines.
local function add_limits(script, own, name)
  for _, c in ipairs(own.constraints) do
    for _, key in ipairs(c.name == name and { "min", "max" } or {}) do
      if c[key] then
        script.add('set arrow from first %s, graph 0 to first %s, graph 1 nohead lc rgb "#D55E00" lw 1.6',
          gnuplot.number(c[key]), gnuplot.number(c[key]))
      end
    end
  end
end

return { doc = "histogram of x, with the limits of its constraint", needs = "x",
  bins = bins_of, counts = counts_of,
  draw = function(own, o, list)
    local values, script = {}, gnuplot.script()
    for i, record in ipairs(list) do values[i] = judge.value(own, o.x, record) end
    local bins = bins_of(values)
    local block = script.data(rows_of(values, bins))
    script.add("set title %s noenhanced", gnuplot.quote(own.name))
    script.add("set xlabel %s noenhanced", gnuplot.quote(chart.label(own, o.x)))
    script.add("set ylabel 'evaluations'\nset yrange [0:*]")
    add_limits(script, own, o.x)
    script.add("set boxwidth %s", gnuplot.number(0.95 * bins[2]))
    if o.path then script.add "set style fill solid 0.7 noborder" end
    script.add('plot %s using 1:2 with boxes lc rgb "#0072B2" notitle', block)
    return gnuplot.draw(script, o.path, chart.size(o, 640, 400))
  end }
