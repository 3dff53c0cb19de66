-- SPDX-License-Identifier: GPL-3.0-or-later
-- Draws charts of error against time from the rows of scripts/bench.lua.
--   build/softworld scripts/chart.lua [from=out/bench/bench.csv] [out=out/bench] [readme=.readme]
package.path = (arg[0]:match "^(.*/)" or "") .. "?.lua;" .. package.path
local bench = require "bench.rows"
local benchcases = require "bench.cases"
local chart = require "softworld.output.chart"
local gnuplot = require "softworld.output.gnuplot"
local sink = require "softworld.output.sink"

local options = { from = "out/bench/bench.csv", out = "out/bench", readme = ".readme" }
for _, word in ipairs(arg) do
  local key, value = word:match "^(%w+)=(.+)$"
  if not options[key] then
    io.stderr:write("chart: '", word, "' is none of from= out= readme=\n")
    os.exit(2)
  end
  options[key] = value
end

local file = io.open(options.from)
if not file then
  io.stderr:write("chart: there is no ", options.from, "; run make bench first\n")
  os.exit(1)
end
file:close()
local rows = bench.read(options.from)

local useless = 20 -- a larger error counts as failed [%]

-- Points of a chart. name(row) returns the series of a row, or nil to leave the row out;
-- label(row) returns a text beside the point, or nil.
local function points_of(case, name, most, label)
  local points = {}
  for _, r in ipairs(rows) do
    local series = r.case == case and r.wall and name(r)
    if series then
      local failed = r.status ~= "ok" or not r.error or r.error > (most or math.huge)
      points[#points + 1] = { x = 1e3 * r.wall, y = not failed and math.max(r.error, 1e-7) or nil,
        series = series, failed = failed, label = label and label(r) or nil }
    end
  end
  return points
end

local function draw(path, points, title, ylabel, xlabel, size)
  if #points == 0 then return end
  chart.front{ path = path, points = points, title = title, xlabel = xlabel or "computing time [ms]",
    ylabel = ylabel, size = size or { 900, 560 } }
  print(path)
end

local function both(name, ...)
  for _, extension in ipairs{ ".svg", ".png" } do draw(options.out .. "/" .. name .. extension, ...) end
end

local function model_and_method(r)
  local method = r.tolerance and r.integrator .. " adaptive" or r.integrator
  return r.model == "rod" and method or r.model .. ", " .. method
end

local tip = "tip error, RMS [% of length]"

-- Series of the release: all methods with the rod; the string with the default method only.
local function release_series(r)
  if r.model == "string" and r.integrator ~= "tr-bdf2" then return end
  return model_and_method(r)
end

local function rest_of(case)
  return function(r)
    if case == "walls" then
      return model_and_method(r) .. (r.dt < 1e-4 and (", N = %d"):format(r.segments) or "")
    end
    return r.model
  end
end

sink.run("mkdir -p " .. sink.quote(options.out))
both("release", points_of("release", release_series, useless), "Released cantilever, 1 s: all methods", tip)
for _, case in ipairs{ "droop", "arc", "catenary", "lift", "mesh_droop" } do
  if benchcases[case] then
    both(case, points_of(case, rest_of(case)), benchcases[case].title, "error [%]")
  end
end
both("mesh_release", points_of("mesh_release", function(r) return r.model end, useless),
  benchcases.mesh_release.title, tip)
both("transport", points_of("transport", release_series, useless), benchcases.transport.title, tip)
both("walls", points_of("walls", rest_of "walls", nil, function(r)
  return r.segments ~= 100 and r.integrator == "tr-bdf2" and ("N = %d"):format(r.segments) or nil
end), "Laying over three thin walls, 5 s: contact depth",
  "deepest penetration [mm]")

-- The README's chart ----------------------------------------------------------------
-- One line for each method, through its best settings; few series, plain numbers on the axes.

local shown = {
  { "tr-bdf2", "TR-BDF2 (default)", "#0072B2", 7, 3 },
  { "implicit-midpoint", "implicit midpoint", "#009E73", 9, 1.5 },
  { "bdf2", "BDF2", "#CC79A7", 11, 1.5 },
  { "implicit-euler", "implicit Euler", "#D55E00", 5, 1.5 },
  { "string", "string model, TR-BDF2", "#888888", 13, 1.5 },
  { "symplectic-euler", "symplectic Euler", "#E69F00", 6, 1.5 },
  { "velocity-verlet", "velocity Verlet", "#56B4E9", 4, 1.5 },
  { "rk4", "Runge-Kutta 4", "#000000", 8, 1.5 },
}

local is_shown = {}
for _, s in ipairs(shown) do is_shown[s[1]] = true end

local function readme_series(r)
  if r.tolerance then return end
  if r.model == "string" then return r.integrator == "tr-bdf2" and "string" or nil end
  return is_shown[r.integrator] and r.integrator or nil
end

local function lines_of(points)
  local lines = {}
  for _, p in ipairs(chart.pareto(points)) do
    lines[#lines + 1] = gnuplot.number(p.x) .. " " .. gnuplot.number(p.y)
  end
  return lines
end

local function group(points)
  local groups, failed = {}, {}
  for _, p in ipairs(points) do
    groups[p.series] = groups[p.series] or {}
    table.insert(groups[p.series], p)
    if p.failed then failed[#failed + 1] = gnuplot.number(p.x) .. " 30" end
  end
  return groups, failed
end

local function draw_readme(path, points)
  local script, groups, failed = gnuplot.script(), group(points)
  local dot = path:find "svg$" and 0.7 or 1
  script.add [[
set logscale xy
set xrange [0.02:200]
set yrange [4e-4:50]
set xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100)
set ytics ('0.001 %%' 0.001, '0.01 %%' 0.01, '0.1 %%' 0.1, '1 %%' 1, '10 %%' 10)
set mxtics default
set key outside right center vertical spacing 1.25
set title 'One second of a released 1 m wire: error against computing time' noenhanced
set xlabel 'computing time on one core [ms]' noenhanced
set ylabel 'tip error, RMS, of the length' noenhanced]]
  local plots = {}
  for _, s in ipairs(shown) do
    local list = groups[s[1]] and lines_of(groups[s[1]]) or {}
    if #list > 0 then
      plots[#plots + 1] = ("%s using 1:2 with linespoints pt %d ps %g lw %g lc rgb '%s' title '%s'"):format(
        script.data(list), s[4], dot, s[5], s[3], s[2])
    end
  end
  if #failed > 0 then
    plots[#plots + 1] = script.data(failed) .. (" using 1:2 with points pt 2 ps %g lw 2 "):format(dot)
      .. "lc rgb '#aa2222' title 'step too large: diverges'"
  end
  script.add("plot " .. table.concat(plots, ", "))
  print(gnuplot.draw(script, path, { 880, 440 }))
end

local release = points_of("release", readme_series, useless)
if #release > 0 then
  sink.run("mkdir -p " .. sink.quote(options.readme))
  draw_readme(options.readme .. "/speed-accuracy.svg", release)
  draw_readme(options.out .. "/speed-accuracy.png", release)
end

-- The README's chart of meshes --------------------------------------------------------
-- At rest (left) and in motion (right); one line for each model.

local models = { { "rod", "rod", "#0072B2", 7 }, { "tube", "tube", "#009E73", 9 },
  { "radial", "radial", "#D55E00", 5 }, { "cubic", "cubic", "#CC79A7", 11 },
  { "composite", "composite", "#888888", 13 }, { "radial, solid", "radial, solid", "#E69F00", 4 },
  { "cubic, solid", "cubic, solid", "#56B4E9", 6 } }

local function mesh_plot(script, case, dot)
  local groups, plots = group(points_of(case, function(r) return r.model end, useless)), {}
  for _, m in ipairs(models) do
    local list = groups[m[1]] and lines_of(groups[m[1]]) or {}
    if #list > 0 then
      plots[#plots + 1] = ("%s using 1:2 with linespoints pt %d ps %g lw 2 lc rgb '%s' title '%s'"):format(
        script.data(list), m[4], dot, m[3], m[2])
    end
  end
  if #plots > 0 then script.add("plot " .. table.concat(plots, ", ")) end
end

local function draw_meshes(path)
  local script, dot = gnuplot.script(), path:find "svg$" and 0.7 or 1
  script.add [[
set multiplot
set logscale xy
set yrange [5e-3:5]
set ytics ('0.01 %%' 0.01, '0.1 %%' 0.1, '1 %%' 1)
set xlabel 'computing time on one core [ms]' noenhanced
set ylabel 'error of the tip, of the length' noenhanced
set lmargin at screen 0.1
set rmargin at screen 0.42
set xrange [0.005:2000]
set xtics ('0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100, '1000' 1000)
set title 'at rest' noenhanced
unset key]]
  mesh_plot(script, "mesh_droop", dot)
  script.add [[
set lmargin at screen 0.47
set rmargin at screen 0.79
set xrange [0.1:30000]
set xtics ('1' 1, '10' 10, '100' 100, '1000' 1000, '10 s' 10000)
set format y ''
set ytics ('' 0.01, '' 0.1, '' 1)
unset ylabel
set key outside right center vertical spacing 1.25
set title 'one second of motion' noenhanced]]
  mesh_plot(script, "mesh_release", dot)
  script.add "unset multiplot"
  print(gnuplot.draw(script, path, { 880, 400 }))
end

if #points_of("mesh_release", function(r) return r.model end) > 0 then
  sink.run("mkdir -p " .. sink.quote(options.readme))
  draw_meshes(options.readme .. "/meshes.svg")
  draw_meshes(options.out .. "/meshes.png")
end

-- The README's chart of grips ----------------------------------------------------------
-- The two-plate test with each way of handling, with steps of 20, 10 and 5 ms.

local ways = { { "imposed", "#0072B2", 7 }, { "plates, rod", "#56B4E9", 6 }, { "mixed", "#D55E00", 5 },
  { "plates, mesh near pads", "#009E73", 9 }, { "plates, radial", "#CC79A7", 11 } }

local function read_grips(path)
  local grip_file, groups = io.open(path), {}
  if not grip_file then return nil end
  for line in grip_file:lines() do
    local way, all, err = line:match '^"([^"]+)",[^,]+,[^,]+,([^,]+),(.+)$'
    if way then
      groups[way] = groups[way] or {}
      table.insert(groups[way], all .. " " .. err)
    end
  end
  grip_file:close()
  return groups
end

local function draw_grips(path, groups)
  local script, plots, dot = gnuplot.script(), {}, path:find "svg$" and 0.7 or 1
  script.add [[
set logscale xy
set yrange [5e-3:2]
set xrange [3e-4:2]
set ytics ('0.01 %%' 0.01, '0.1 %%' 0.1, '1 %%' 1)
set xtics ('1/1000' 1e-3, '1/100' 1e-2, '1/10' 0.1, 'real time' 1)
set xlabel 'computing time over simulated time' noenhanced
set ylabel 'error of the ends'' droop, of the length' noenhanced
set key outside right center vertical spacing 1.25]]
  for _, w in ipairs(ways) do
    if groups[w[1]] then
      plots[#plots + 1] = ("%s using 1:2 with linespoints pt %d ps %g lw 2 lc rgb '%s' title '%s'"):format(
        script.data(groups[w[1]]), w[3], dot, w[2], w[1])
    end
  end
  script.add("plot " .. table.concat(plots, ", "))
  print(gnuplot.draw(script, path, { 880, 360 }))
end

local grips = read_grips(options.from:gsub("[^/]*$", "") .. "grip.csv")
if grips and next(grips) then
  sink.run("mkdir -p " .. sink.quote(options.readme))
  draw_grips(options.readme .. "/grips.svg", grips)
  draw_grips(options.out .. "/grips.png", grips)
end
