-- SPDX-License-Identifier: GPL-3.0-or-later
-- Draws error against time from the rows of scripts/bench.lua.
--   build/softworld scripts/chart.lua [from=out/bench/bench.csv] [out=out/bench] [readme=.readme]
local bench = require "softworld.bench"
local benchcases = require "softworld.benchcases"
local chart = require "softworld.output.chart"
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

local useless = 20 -- an error above this is no result: drawn as failed [%]

-- Points of a chart: name(row) gives a row's series, nil leaves it out.
local function points_of(case, name, most)
  local points = {}
  for _, r in ipairs(rows) do
    local series = r.case == case and r.wall and name(r)
    if series then
      local failed = r.status ~= "ok" or not r.error or r.error > (most or math.huge)
      points[#points + 1] = { x = 1e3 * r.wall, y = not failed and math.max(r.error, 1e-7) or nil,
        series = series, failed = failed }
    end
  end
  return points
end

-- Of each series only the points that no other of its own beats, and one failure.
local function best_of_each(points)
  local groups, kept, failed = {}, {}, {}
  for _, p in ipairs(points) do
    groups[p.series] = groups[p.series] or {}
    table.insert(groups[p.series], p)
  end
  local fronts = {}
  for _, list in pairs(groups) do
    for _, p in ipairs(chart.pareto(list)) do fronts[p] = true end
  end
  for _, p in ipairs(points) do -- in the order they came
    if fronts[p] or p.failed and not failed[p.series] then kept[#kept + 1] = p end
    failed[p.series] = failed[p.series] or p.failed
  end
  return kept
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

-- The release: all methods with the rod; the string with the default one.
local function release_series(r)
  if r.model == "string" and r.integrator ~= "tr-bdf2" then return end
  return model_and_method(r)
end

local function rest_of(case)
  return function(r)
    if case == "walls" then return model_and_method(r) end
    return r.model
  end
end

sink.run("mkdir -p " .. sink.quote(options.out))
both("release", points_of("release", release_series, useless), "Released cantilever, 1 s: all methods", tip)
for _, case in ipairs{ "droop", "catenary", "lift" } do
  if benchcases[case] then
    both(case, points_of(case, rest_of(case)), benchcases[case].title, "error [%]")
  end
end
both("transport", points_of("transport", release_series, useless), benchcases.transport.title, tip)
both("walls", points_of("walls", rest_of "walls"), "Laying over three thin walls, 5 s: contact depth",
  "deepest penetration [mm]")

-- The README's chart: few series, names a newcomer understands.
local names = { ["tr-bdf2"] = "TR-BDF2 (default)", ["implicit-euler"] = "implicit Euler",
  ["symplectic-euler"] = "symplectic Euler", ["velocity-verlet"] = "velocity Verlet", rk4 = "Runge-Kutta 4",
  bdf2 = "BDF2", ["implicit-midpoint"] = "implicit midpoint" }
local readme = best_of_each(points_of("release", function(r)
  if r.tolerance or (r.model == "string" and r.integrator ~= "tr-bdf2") then return end
  if r.model == "string" then return "string model, TR-BDF2" end
  return names[r.integrator]
end, useless))
if #readme > 0 then
  sink.run("mkdir -p " .. sink.quote(options.readme))
  draw(options.readme .. "/speed-accuracy.svg", readme, "One second of a released wire: error against computing time",
    tip, "computing time [ms]", { 880, 440 })
  draw(options.out .. "/speed-accuracy.png", readme, "One second of a released wire: error against computing time", tip,
    "computing time [ms]", { 880, 440 })
end
