-- SPDX-License-Identifier: GPL-3.0-or-later
-- Measures the largest stable steps, and the behaviour in scenes in which methods are known to fail.
--   build/softworld scripts/stability.lua [quick] [out=folder]
-- Writes rows to out/bench/stability.csv, maps beside it, and tables to the terminal.
package.path = (arg[0]:match "^(.*/)" or "") .. "?.lua;" .. package.path
local bench = require "bench.rows"
local benchcases = require "bench.cases"
local benchenergy = require "bench.energy"
local benchpeaks = require "bench.peaks"
local benchlimits = require "bench.limits"
local benchsqueeze = require "bench.squeeze"
local benchstable = require "bench.stable"
local chart = require "softworld.output.chart"
local sink = require "softworld.output.sink"
require("softworld.unread").quiet()

local quick, out = false, "out/bench"
for _, word in ipairs(arg) do
  if word == "quick" then quick = true
  elseif word:match "^out=.+" then out = word:sub(5)
  else
    io.stderr:write("stability: '", word, "' is neither quick nor out=folder\n")
    os.exit(2)
  end
end
sink.run("mkdir -p " .. sink.quote(out))

local columns = { "group", "item", "model", "segments", "integrator", "dt", "expected", "ratio",
  "own_limit", "clean_dt", "gain", "change", "steps", "rejected", "wall", "status", "note", "reason" }
local rows = {}
local function add(row) rows[#rows + 1] = row end
local function say(format, ...) io.stderr:write(format:format(...), "\n") end

-- Explicit methods -----------------------------------------------------------------

local explicit = bench.integrators(false)

local function measure_explicit()
  local map = { rows = {}, columns = explicit, values = {} }
  for k, w in ipairs(benchstable.wires) do
    for _, model in ipairs{ "rod", "string" } do
      if w.segments <= (quick and 40 or 100) then
        local name = ("%s N=%d %s"):format(w.name, w.segments, model)
        say("[%d/%d] %s", k, #benchstable.wires, name)
        local modes, values, fastest = benchstable.modes(w, model), {}, 0
        for _, mode in ipairs(modes) do fastest = math.max(fastest, mode.omega) end
        for i, integrator in ipairs(explicit) do
          if w.segments < 100 or not integrator:find "^gsl" then
            local found, expected, how, own = benchstable.measure(integrator, w, model, modes)
            add{ group = "explicit", item = w.name, model = model, segments = w.segments,
              integrator = integrator, dt = found, expected = expected, ratio = found / expected,
              own_limit = own * bench.limit(integrator, 2000, 1e4) / 2, status = how }
            values[i] = found * fastest
          end
        end
        map.rows[#map.rows + 1], map.values[#map.values + 1] = name, values
      end
    end
  end
  return map
end

-- Meshes: compares the program's bound on the step, which needs no frequencies, with the stable step.
local function measure_meshes()
  for _, integrator in ipairs{ "symplectic-euler", "velocity-verlet", "rk4" } do
    for _, mesh in ipairs(quick and { benchsqueeze.meshes[1] } or benchsqueeze.meshes) do
      local name = mesh[1] .. (mesh[2] == "solid" and ", solid" or "")
      say("%s %s", name, integrator)
      local found, how, own = benchsqueeze.measure(integrator, mesh, bench.limit(integrator, 2000, 1e4) / 2)
      add{ group = "meshes", item = "0.1 m", model = name, segments = 20, integrator = integrator, dt = found,
        own_limit = own, ratio = found / own, status = how }
    end
  end
end

local function print_meshes()
  print "\nexplicit methods on meshes: largest stable step, against the program's bound\n"
  print "  model          integrator          dt measured    dt bound    ratio"
  for _, r in ipairs(rows) do
    if r.group == "meshes" then
      print(("  %-14s %-17s %9.4g us %9.4g us  %7.3f  %s"):format(r.model, r.integrator, 1e6 * r.dt,
        1e6 * r.own_limit, r.ratio, r.status ~= "found" and r.status or ""))
    end
  end
end

local function print_explicit()
  print "explicit methods: largest stable step, against theory (weightless, straight, clamped)\n"
  print("  wire            N   model   integrator         dt measured   dt theory    ratio  "
    .. "own limit/theory")
  for _, r in ipairs(rows) do
    if r.group == "explicit" then
      print(("  %-13s %4d   %-6s  %-17s %9.4g us  %9.4g us  %7.4f  %7.4f%s"):format(r.item, r.segments,
        r.model, r.integrator, 1e6 * r.dt, 1e6 * r.expected, r.ratio, r.own_limit / r.expected,
        r.status ~= "found" and "  " .. r.status or math.abs(r.ratio - 1) > 0.02 and "  off" or ""))
    end
  end
end

-- Implicit methods -----------------------------------------------------------------

local implicit = bench.integrators(true)
local ladder = { 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 0.1, 0.2, 0.5, 1 } -- [s]

-- Returns a row: the largest step of the ladder up to which all pass, the largest without a rejected step.
local function climb(case, segments, integrator)
  local row = { group = "implicit", item = case, model = "rod", segments = segments,
    integrator = integrator, status = "ok" }
  local clean = true
  for _, dt in ipairs(ladder) do
    local state = benchcases[case].make{ segments = segments }
    local r = state.scene:advance({ dt = dt, integrator = integrator, parts = false }, state.duration)
    state.scene:close()
    if not r.ok then
      row.status, row.reason = "diverged", r.reason
      row.note = ("at %g ms"):format(1e3 * dt)
      break
    end
    row.dt = dt
    clean = clean and r.rejected == 0
    if clean then row.clean_dt = dt end
  end
  return row
end

local function measure_implicit()
  local tasks = quick and { { "release", 20 } } or { { "release", 20 }, { "release", 160 }, { "walls", 100 } }
  for _, task in ipairs(tasks) do
    for _, integrator in ipairs(implicit) do
      say("%s N=%d %s", task[1], task[2], integrator)
      add(climb(task[1], task[2], integrator))
    end
  end
end

local function print_implicit()
  print "\nimplicit methods: largest step of 1, 2, 5, ... 1000 ms that runs (and without one rejected step)\n"
  for _, r in ipairs(rows) do
    if r.group == "implicit" then
      local function ms(x) return x and ("%g ms"):format(1e3 * x) or "none" end
      print(("  %-8s N=%-4d %-18s %8s  (%s)  %s"):format(r.item, r.segments, r.integrator, ms(r.dt),
        ms(r.clean_dt), r.status ~= "ok" and r.status .. " " .. r.note .. ": " .. r.reason or ""))
    end
  end
end

-- Where methods fail ---------------------------------------------------------------

local function measure_limits()
  for _, row in ipairs(benchlimits.run(implicit, function(k, count, item)
    say("[%d/%d] %s", k, count, item)
  end)) do add(row) end
end

local function print_limits()
  print "\nwhere methods fail: energy in % of m g L/2 (of what is stored or flies, where that is meant)\n"
  print("  scene                            model            N     integrator         dt ms     gain"
    .. "   change  rejected")
  for _, r in ipairs(rows) do
    if r.group == "limits" then
      local function percent(x) return x and ("%.2f"):format(100 * x) or "-" end
      print(("  %-32s %-14s %5d  %-18s %5g %8s %8s  %8s  %s%s"):format(r.item, r.model, r.segments,
        r.integrator, 1e3 * r.dt, percent(r.gain), percent(r.change), r.rejected or "-", r.status,
        r.note and ", " .. r.note or r.reason and ": " .. r.reason or ""))
    end
  end
end

-- Returns a map of the energy change in one scene: rows of integrators, columns of steps.
local function energy_map(item)
  local steps, map = { 0.01, 0.005, 0.002, 0.001 }, { rows = implicit, columns = {}, values = {} }
  for c, dt in ipairs(steps) do map.columns[c] = ("%g ms"):format(1e3 * dt) end
  for i in ipairs(implicit) do map.values[i] = {} end
  for _, r in ipairs(rows) do
    for i, name in ipairs(implicit) do
      for c, dt in ipairs(steps) do
        if r.item == item and r.integrator == name and r.dt == dt and r.change then
          map.values[i][c] = 100 * r.change
        end
      end
    end
  end
  return map
end

local function draw(map, name, title, xlabel)
  for _, extension in ipairs{ ".svg", ".png" } do
    map.path, map.title, map.xlabel = out .. "/" .. name .. extension, title, xlabel
    map.size = { 280 + 130 * #map.columns, 140 + 42 * #map.rows }
    chart.map(map)
  end
end

local explicit_map = measure_explicit()
measure_meshes()
measure_implicit()
if not quick then measure_limits() end
benchenergy.measure(implicit, quick, add, say)
benchpeaks.measure(quick, add, say)
bench.write(out .. "/stability.csv", rows, columns)
print_explicit()
print_meshes()
print_implicit()
if not quick then print_limits() end
benchenergy.print(rows)
benchpeaks.print(rows)
draw(explicit_map, "stability_explicit", "Largest stable step times the highest natural frequency [-]")
if not quick then
  draw(energy_map "release 1 s", "energy_release",
    "Energy change of a released cantilever [% of m g L/2 per s]", "time step")
  draw(energy_map "falls on a floor", "energy_floor",
    "Energy change of a cantilever that falls on a floor [% of m g L/2 in 1 s]", "time step")
end
print(("\n%d rows in %s/stability.csv"):format(#rows, out))
