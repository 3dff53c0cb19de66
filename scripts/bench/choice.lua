-- SPDX-License-Identifier: GPL-3.0-or-later
--- The rows that a bench runs: cases x models x resolutions x integrators x steps.
local bench = require "bench.rows"
local benchcases = require "bench.cases"

local choice = {}

local plan = {} -- list of { case, config }
local function add(case, config)
  if not benchcases[case] then return end
  config.model = config.model or "rod"
  plan[#plan + 1] = { case = benchcases[case], config = config }
end

-- { segments, step [s] } at which a second-order method's error is near the mesh's: 5 ms at 20 segments of
-- the release.
local matched = { { 5, 0.02 }, { 10, 0.01 }, { 12, 1 / 120 }, { 20, 0.005 }, { 40, 0.002 }, { 80, 0.001 },
  { 160, 0.0005 } }

local function add_statics(quick)
  local many, few = { 10, 20, 50, 100, 200, 500, 1000 }, { 20, 50, 100, 200, 500 }
  if quick then many, few = { 10, 100, 1000 }, { 50 } end
  for case, counts in pairs{ droop = many, catenary = few, lift = few } do
    for _, model in ipairs{ "rod", "string" } do
      for _, n in ipairs(counts) do add(case, { model = model, segments = n }) end
    end
  end
  for _, n in ipairs(many) do add("arc", { segments = n }) end
end

local function add_implicit_release(quick)
  for _, model in ipairs{ "rod", "string" } do
    for _, pair in ipairs(matched) do
      local n, dt = pair[1], pair[2]
      for _, name in ipairs(bench.integrators(true)) do
        for _, factor in ipairs(quick and { 1 } or { 0.5, 1, 2 }) do
          add("release", { model = model, segments = n, integrator = name, dt = factor * dt })
        end
      end
    end
  end
  if quick then return end
  for _, n in ipairs{ 10, 20, 40 } do -- a first-order method needs other steps
    for _, dt in ipairs{ 1e-3, 5e-4, 2e-4, 1e-4 } do
      add("release", { segments = n, integrator = "implicit-euler", dt = dt })
    end
  end
  for _, n in ipairs{ 10, 20, 40, 80 } do
    for _, tolerance in ipairs{ 1e-3, 1e-4, 1e-5, 1e-6 } do
      add("release", { segments = n, integrator = "tr-bdf2", dt = 0.05, tolerance = tolerance })
    end
  end
end

local function add_explicit_release(quick)
  for _, name in ipairs(bench.integrators(false)) do
    for _, n in ipairs(quick and { 5, 10 } or { 5, 10, 20, 40 }) do
      if n < 40 or not name:find "^gsl" then
        add("release", { segments = n, integrator = name, share = 0.9 })
      end
    end
    if not quick then
      add("release", { model = "string", segments = 10, integrator = name, share = 0.9 })
      add("release", { segments = 10, integrator = name, share = 1.15 })
    end
  end
end

local function add_transport(quick)
  for _, n in ipairs(quick and { 25 } or { 12, 25, 50, 100 }) do
    for _, model in ipairs{ "rod", "string" } do
      for _, name in ipairs(bench.integrators(true)) do
        add("transport", { model = model, segments = n, integrator = name, dt = 0.1 / n })
      end
    end
    if n <= 25 then
      for _, name in ipairs(bench.integrators(false)) do
        add("transport", { segments = n, integrator = name, share = 0.9 })
      end
    end
  end
end

local function add_walls(quick)
  for _, name in ipairs(bench.integrators(true)) do
    for _, dt in ipairs(quick and { 0.01 } or { 0.02, 0.01, 0.005, 0.002, 0.001 }) do
      add("walls", { segments = 100, integrator = name, dt = dt })
    end
  end
  add("walls", { model = "string", segments = 100, integrator = "tr-bdf2", dt = 0.01 })
  if quick then return end
  for _, n in ipairs{ 20, 50, 200 } do
    add("walls", { segments = n, integrator = "tr-bdf2", dt = 0.01 })
  end
  for _, name in ipairs{ "symplectic-euler", "velocity-verlet" } do
    add("walls", { segments = 20, integrator = name, share = 0.9 })
  end
end

local with_frames = { "curved", "flat", "rolling" }

local function add_scale(quick)
  for _, n in ipairs(quick and { 100, 1000, 10000 } or { 100, 1000, 10000, 100000 }) do
    add("scale", { segments = n, integrator = "tr-bdf2", dt = 1e-3 })
  end
  for _, case in ipairs(with_frames) do
    add(case, { segments = 1000, integrator = "tr-bdf2", dt = 1e-3 })
  end
  if quick then return end
  for _, n in ipairs{ 100, 10000 } do
    add("scale", { model = "string", segments = n, integrator = "tr-bdf2", dt = 1e-3 })
    add("scale", { segments = n, integrator = "symplectic-euler", dt = 1e-6 })
  end
end

-- Numbers of slices. Springs have a coarsest mesh; a coarser one cannot have the EA, EI and GJ.
local slices = { rod = { 10, 20, 40, 80, 160 }, tube = { 80, 120, 160, 240 }, radial = { 120, 160, 240 },
  cubic = { 120, 160, 240 }, composite = { 120, 160 }, ["radial, solid"] = { 10, 20, 40, 80, 160 },
  ["cubic, solid"] = { 10, 20, 40, 80, 160 } }

local function add_meshes(quick)
  for _, model in ipairs(benchcases.meshes) do
    for i, n in ipairs(slices[model]) do
      if not quick or i == 1 then
        add("mesh_droop", { model = model, segments = n })
        add("mesh_release", { model = model, segments = n, integrator = "tr-bdf2", dt = 0.005 })
      end
    end
  end
end

local order = { "droop", "arc", "catenary", "lift", "release", "transport", "walls", "scale", "curved",
  "flat", "rolling", "mesh_droop", "mesh_release" }

--- Returns all rows { case =, config = } for which fits(entry) is true, case by case.
function choice.jobs(quick, fits)
  plan = {}
  add_statics(quick)
  add_implicit_release(quick)
  add_explicit_release(quick)
  add_transport(quick)
  add_walls(quick)
  add_scale(quick)
  add_meshes(quick)
  local jobs = {}
  for _, name in ipairs(order) do
    for _, entry in ipairs(plan) do
      if entry.case.name == name and fits(entry) then jobs[#jobs + 1] = entry end
    end
  end
  return jobs
end

return choice
