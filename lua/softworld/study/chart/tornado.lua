-- SPDX-License-Identifier: GPL-3.0-or-later
--- How far each parameter moves a result: the result's mean in the lowest and in the highest fifth of each.
-- @module softworld.study.chart.tornado
local chart = require "softworld.study.chart"
local gnuplot = require "softworld.output.gnuplot"
local judge = require "softworld.study.judge"
local output = require "softworld.study.output"
local matters = require "softworld.study.matters"

local MOST = 15 -- most bars

-- Returns rows of bars for gnuplot: middle, place, ends, upper and lower edge; for the low or the high fifth.
local function rows_of(list, middle, key)
  local rows = {}
  for k, m in ipairs(list) do
    local a, b = math.min(middle, m[key]), math.max(middle, m[key])
    rows[k] = ("%s %d %s %s %g %g"):format(gnuplot.number(0.5 * (a + b)), #list - k, gnuplot.number(a),
      gnuplot.number(b), #list - k - 0.35, #list - k + 0.35)
  end
  return rows
end

local function names_of(list)
  local tics = {}
  for k, m in ipairs(list) do
    tics[k] = ("%s %d"):format(gnuplot.quote(("%s (%.0f %%%%)"):format(m.name, 100 * m.share)), #list - k)
  end
  return table.concat(tics, ", ")
end

local function draw(own, o, records)
  local sum = 0
  local list = matters.of(own, records, function(r) return judge.value(own, o.y, r) end)
  if not list then
    error(("study:chart: '%s' does not vary, or there are fewer than 20 evaluations"):format(o.y), 0)
  end
  for _, r in ipairs(records) do sum = sum + judge.value(own, o.y, r) end
  local middle, script = sum / #records, gnuplot.script()
  table.sort(list, function(a, b)
    local wide_a, wide_b = math.abs(a.high - a.low), math.abs(b.high - b.low)
    if wide_a == wide_b then return a.name < b.name end
    return wide_a > wide_b
  end)
  for k = #list, MOST + 1, -1 do list[k] = nil end
  local low, high = script.data(rows_of(list, middle, "low")), script.data(rows_of(list, middle, "high"))
  script.add("set title %s noenhanced", gnuplot.quote(own.name))
  script.add("set xlabel %s noenhanced", gnuplot.quote("mean of " .. chart.label(own, o.y)
    .. " (share of its variance)"))
  script.add("set ytics (%s)\nset yrange [-0.6:%g]", names_of(list), #list - 0.4)
  script.add('set arrow from first %s, graph 0 to first %s, graph 1 nohead lc rgb "#444444"',
    gnuplot.number(middle), gnuplot.number(middle))
  if o.path then script.add "set style fill solid 0.8 noborder" end
  script.add("plot %s using 1:2:3:4:5:6 with boxxyerror lc rgb '%s' title 'lowest fifth', "
    .. "%s using 1:2:3:4:5:6 with boxxyerror lc rgb '%s' title 'highest fifth'",
    low, gnuplot.colours[1], high, gnuplot.colours[2])
  return gnuplot.draw(script, o.path, chart.size(o, 640, 120 + 44 * #list))
end

-- Returns the records of sweeps and spreads if there are any, because searches correlate parameters.
local function records_of(own)
  local list = {}
  for part, asked in pairs(own.asked) do
    if asked.method == "spread" or asked.method == "sweep" then
      for _, record in ipairs(output.records(own, part)) do list[#list + 1] = record end
    end
  end
  table.sort(list, function(a, b)
    if a.part == b.part then return a.number < b.number end
    return a.part < b.part
  end)
  return #list > 0 and list or nil
end

return { doc = "how far each parameter moves the mean of y", needs = "y", draw = draw, records = records_of }
