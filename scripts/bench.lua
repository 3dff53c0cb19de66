-- SPDX-License-Identifier: GPL-3.0-or-later
-- Error against time of cases x models x resolutions x integrators x steps.
--   build/softworld scripts/bench.lua [quick] [case=..] [model=..] [integrator=..] [n=..] [out=folder]
-- One CSV row each in out/bench/bench.csv, a summary on the terminal. Values may be lists: case=droop,walls.
-- case=meshes: what wires that are meshes of particles cost, on the terminal only; case=grip: what
-- grippers do; case=crowds: many obstacles, nodes and wires; case=report: the
-- player's page; case=bundle: wires that lie along each other; case=view: what a live view costs a run;
-- case=study: what a study's workers bring and cost; case=calibration: 1,000 known cables, and how often
-- intervals hold the truth; case=auto: runs that choose their model, against fixed models.
-- Compare numbers of one run only: machines differ, and so do their loads.
package.path = (arg[0]:match "^(.*/)" or "") .. "?.lua;" .. package.path
package.cpath = (arg[-1]:match "^(.*/)" or "") .. "lib/?.so;" .. package.cpath -- softworld.probe
local bench = require "bench.rows"
local benchcases = require "bench.cases"
local sink = require "softworld.output.sink"

-- What to run --------------------------------------------------------------------

local plan = {} -- of { case, config }
local function add(case, config)
  if not benchcases[case] then return end
  config.model = config.model or "rod"
  plan[#plan + 1] = { case = benchcases[case], config = config }
end

-- A second-order step that keeps its error near the mesh's: 5 ms at 20 segments of the release.
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
  for _, n in ipairs{ 10, 20, 40 } do -- a first-order method wants steps of its own
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

-- Slices of meshes: springs have coarsest ones, beyond which there are none of EA, EI and GJ.
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

-- Choosing -------------------------------------------------------------------------

local wanted, quick, out = {}, false, "out/bench"
for _, word in ipairs(arg) do
  local key, value = word:match "^(%w+)=(.+)$"
  if word == "quick" then
    quick = true
  elseif key == "out" then
    out = value
  elseif key == "case" or key == "model" or key == "integrator" or key == "n" then
    wanted[key] = {}
    for item in value:gmatch "[^,]+" do wanted[key][item] = true end
  else
    io.stderr:write("bench: '", word, "' is none of quick case= model= integrator= n= out=\n")
    os.exit(2)
  end
end

local function chosen(entry)
  local c = entry.config
  local function fits(key, value) return not wanted[key] or wanted[key][tostring(value)] end
  return fits("case", entry.case.name) and fits("model", c.model) and fits("n", c.segments)
    and fits("integrator", c.integrator or "static")
end

add_statics(quick)
add_implicit_release(quick)
add_explicit_release(quick)
add_transport(quick)
add_walls(quick)
add_scale(quick)
add_meshes(quick)

local order = { "droop", "arc", "catenary", "lift", "release", "transport", "walls", "scale", "curved",
  "flat", "rolling", "mesh_droop", "mesh_release" }
local jobs = {}
for _, name in ipairs(order) do
  for _, entry in ipairs(plan) do
    if entry.case.name == name and chosen(entry) then jobs[#jobs + 1] = entry end
  end
end
if #jobs == 0 and not (wanted.case and (wanted.case.meshes or wanted.case.grip
  or wanted.case.crowds or wanted.case.report or wanted.case.bundle or wanted.case.view
  or wanted.case.study or wanted.case.calibration or wanted.case.auto)) then
  io.stderr:write("bench: nothing fits these options\n")
  os.exit(2)
end

-- Running --------------------------------------------------------------------------

sink.run("mkdir -p " .. sink.quote(out))
local path, rows, last = out .. "/bench.csv", {}, nil
for i, job in ipairs(jobs) do
  if job.case.name ~= last then
    last = job.case.name
    io.stderr:write(("[%d/%d] %s\n"):format(i, #jobs, job.case.title))
  end
  rows[i] = bench.row(job.case, job.config)
  local row = rows[i]
  if row.status ~= "ok" then
    io.stderr:write(("[%d/%d]   %s %s N=%d dt=%s: %s %s\n"):format(i, #jobs, row.model, row.integrator,
      row.segments, row.dt == "" and "-" or ("%.3g"):format(row.dt), row.status, row.reason))
  end
end
if #rows > 0 then bench.write(path, rows) end -- else what is there stays

-- Summary --------------------------------------------------------------------------

local function number(format, x) return x and x ~= "" and format:format(x) or "-" end

local function step_of(row)
  if row.tolerance ~= "" then return ("tol %g"):format(row.tolerance) end
  return row.dt ~= "" and ("%.3g ms"):format(1e3 * row.dt) or ""
end

local function row_name(row)
  return ("%s N=%d %s %s"):format(row.model, row.segments, row.integrator, step_of(row))
end

-- The quickest good row of a case that passes.
local function quickest(case, passes)
  local best
  for _, row in ipairs(rows) do
    if row.case == case and row.status == "ok" and passes(row)
      and (not best or row.wall < best.wall) then best = row end
  end
  return best
end

local function aim(text, row, seconds, value)
  if not row then return end
  print(("  %-44s %9.3f ms %-16s %-5s %s"):format(text, 1e3 * row.wall, value or "",
    row.wall <= seconds and "met" or ("%.1fx"):format(row.wall / seconds), row_name(row)))
end

local function most_accurate(case)
  local best
  for _, row in ipairs(rows) do
    if row.case == case and row.status == "ok" and (not best or row.error < best.error) then best = row end
  end
  return best
end

local function print_aims()
  print "aim                                              measured"
  for _, t in ipairs{ { 1, nil }, { 0.3, nil }, { 0.2, 2e-4 }, { 0.1, nil }, { 0.05, 8e-4 },
    { 0.03, nil }, { 0.01, 8e-3 } } do
    local row = quickest("release", function(r) return r.error <= t[1] end)
    local default = quickest("release", function(r)
      return r.error <= t[1] and r.integrator == "tr-bdf2"
    end)
    local text = t[2] and ("S2 error <= %g %% in %g ms"):format(t[1], 1e3 * t[2])
      or ("S2 error <= %g %%"):format(t[1])
    if row and t[2] then aim(text, row, t[2], number("%.4f %%", row.error))
    elseif row then
      print(("  %-44s %9.3f ms %-16s       %s"):format(text, 1e3 * row.wall,
        number("%.4f %%", row.error), row_name(row)))
    end
    if t[2] and default ~= row then
      aim("   with tr-bdf2, the default", default, t[2], default and number("%.4f %%", default.error))
    end
  end
  local s1 = quickest("droop", function(r) return r.segments == 100 and r.error <= 0.003 end)
  aim("S1 N = 100, error <= 0.003 % in 0.15 ms", s1, 1.5e-4, s1 and number("%.5f %%", s1.error))
  local s3 = quickest("walls", function(r)
    return r.segments == 100 and r.penetration <= 1e-4 and r.crossings == 0
  end)
  aim("S3 N = 100, penetration <= 0.1 mm in 50 ms", s3, 0.05, s3 and number("%.4f mm", s3.error))
end

local function print_walls()
  local head = false
  for _, r in ipairs(rows) do
    if r.case == "walls" then
      if not head then
        print("\nS3, laying over walls           dt ms     wall ms  penetration mm  below tops  "
          .. "solves  rejected")
      end
      head = true
      print(("  %-28s %7.3f  %10.2f  %14s  %10s  %6d  %8d  %s"):format(("%s N=%d %s"):format(r.model,
        r.segments, r.integrator), 1e3 * r.dt, 1e3 * r.wall, number("%.4f", r.error),
        r.crossings ~= "" and r.crossings .. "/" .. r.looked or "-", r.iterations, r.rejected,
        r.status == "ok" and "" or r.status))
    end
  end
end

-- Cost per node and step: largest over smallest; bytes per node of the largest.
local function scale_ratio()
  local low, high, large = math.huge, 0, nil
  for _, r in ipairs(rows) do
    if r.case == "scale" and r.model == "rod" and r.integrator == "tr-bdf2" and r.status == "ok" then
      local cost = r.wall / (r.steps * (r.segments + 1))
      low, high = math.min(low, cost), math.max(high, cost)
      if not large or r.segments > large.segments then large = r end
    end
  end
  if not large then return end
  print(("  %-44s %9.2f x  %s"):format("cost per node and step within 1.5x", high / low,
    high / low <= 1.5 and "met" or "missed"))
  print(("  %-44s %9.0f B  %s"):format("memory per node < 1 kB (N = " .. large.segments .. ")", large.bytes,
    large.bytes < 1000 and "met" or "missed"))
end

-- What frames cost, over the same wire without.
local function frames_ratio()
  local plain = quickest("scale", function(r)
    return r.segments == 1000 and r.model == "rod" and r.integrator == "tr-bdf2"
  end)
  for _, case in ipairs(plain and with_frames or {}) do
    local row = quickest(case, function(r) return r.segments == 1000 and r.model == "rod" end)
    local ratio = row and row.wall / row.steps / (plain.wall / plain.steps)
    if row then
      print(("  %-44s %9.2f x  %s"):format("frames within 2.5x: " .. case, ratio,
        ratio <= 2.5 and "met" or "missed"))
    end
  end
end

local function print_scale()
  local first = {}
  for _, r in ipairs(rows) do
    if r.case == "scale" and r.status == "ok" then
      local cost = r.wall / (r.steps * (r.segments + 1))
      local key = r.model .. " " .. r.integrator
      if not next(first) then
        print "\ncost of a node                  N   ns/node/step     ratio  evaluations/step  bytes/node"
      end
      first[key] = first[key] or cost
      print(("  %-24s %8d  %12.1f  %8.2f  %16.2f  %10.0f"):format(key, r.segments, 1e9 * cost,
        cost / first[key], r.evaluations / r.steps, r.bytes))
    end
  end
end

local function print_best()
  print "\nmost accurate row of each case"
  for _, name in ipairs{ "droop", "arc", "catenary", "lift", "release", "transport", "mesh_droop",
    "mesh_release" } do
    local row = most_accurate(name)
    if row then
      print(("  %-12s %10.6f %%  %10.3f ms  %s"):format(name, row.error, 1e3 * row.wall, row_name(row)))
    end
  end
end

-- What it costs to know how far off a result is.
local function print_bars()
  print "\nerror bars of the tip, N = 50    levels    wall ms  over the finest alone       bar"
  for _, r in ipairs(bench.error_bars()) do
    print(("  %-30s %6d  %9.3f  %20.2f x  %6.3f mm  %s"):format(r.case, r.levels, 1e3 * r.wall, r.ratio,
      1e3 * r.error, r.ok and "as asked" or "NOT as asked"))
  end
end

-- What it costs that wires touch or are joined.
local function print_links()
  print "\nlinked nodes, N = 100            places   us/iteration  over the same without"
  for _, r in ipairs(require "bench.links".rows()) do
    if r.ok then
      print(("  %-30s %6d  %13.2f  %19.2f x  %s"):format(r.name, r.places, 1e6 * r.linked, r.ratio,
        r.aim and ("within %gx: %s"):format(r.aim, r.ratio <= r.aim and "met" or "missed") or ""))
    else
      print(("  %-30s failed: %s"):format(r.name, r.reason))
    end
  end
end

local function judged(r, value, unit)
  if not r.ok then return "failed: " .. r.reason end
  return r.aim and ("within %g %s: %s"):format(r.aim, unit, value <= r.aim and "met" or "missed") or ""
end

-- What wires that are meshes of particles cost.
local function print_meshes()
  local meshes = require "bench.meshes"
  print "\nmeshes of particles                       s/simulated s  rejected  us/iteration"
  local seconds = meshes.squeezes()
  table.insert(seconds, 1, meshes.second())
  for _, r in ipairs(seconds) do
    print(("  %-40s %12.4f  %8d  %12.1f  %s"):format(r.name, r.wall, r.rejected, 1e6 * r.iteration,
      judged(r, r.wall, "s")))
  end
  print "\nblocks of rings: unknowns      factor us   solve us  over plain C"
  for _, r in ipairs(meshes.blocks()) do
    print(("  %-26d %11.2f  %9.2f  %12.2f  %s"):format(r.n, 1e6 * r.factor, 1e6 * r.solve, r.ratio,
      r.ratio <= r.aim and "met" or "missed"))
  end
  print "\ncost of a ring in an iteration        us     ratio"
  for _, r in ipairs(meshes.rings()) do
    print(("  %-26s %13.2f  %8.2f"):format(r.name, 1e6 * r.ring, r.ratio))
  end
  for _, what in ipairs{ "cantilever", "wall" } do
    print(("\n%-26s particles  s/simulated s  over the rod  rejected"):format(what))
    for _, r in ipairs(meshes.costs(what)) do
      print(("  %-24s %9d  %13.4f  %12.1f  %8d  %s"):format(r.name, r.particles, r.wall, r.ratio, r.rejected,
        judged(r, 0, "")))
    end
  end
  print "\ncalibration of a default mesh        ms"
  for _, r in ipairs(meshes.calibrations()) do
    print(("  %-26s %12.2f  %s"):format(r.name, 1e3 * r.wall, judged(r, r.wall, "s")))
  end
end

print_aims()
scale_ratio()
frames_ratio()
print_best()
print_walls()
print_scale()
if not next(wanted) then
  print_bars()
  print_links()
end
-- What each way of handling costs and gives in the two-plate test; also as out/bench/grip.csv.
local function print_grips()
  local grip = require "bench.grip"
  local lines, carry = { "way,dt,carry,all,error" }, {}
  print("\ntwo-plate test, s/simulated s         dt    grasp     lift    carry      lay      all"
    .. "      force N  moment mN m  height mm  end's droop")
  grip.compare(function(r)
    local cells = {}
    for i, phase in ipairs(r.phases) do
      cells[i] = phase.time > 0 and ("%8.4f"):format(phase.wall / phase.time) or "       -"
    end
    print(("%-29s %6s %s %8.4f %8.4f %12.4f %10s %9s%s"):format(r.name, r.dt or "",
      table.concat(cells, " "),
      r.wall / r.time, r.force or 0 / 0, 1e3 * (r.moment or 0 / 0),
      r.height and ("%.4f"):format(1e3 * r.height) or "-",
      r.error and ("%.3f %%"):format(r.error) or "", r.ok and "" or "  FAILED: " .. r.reason))
    local p = r.phases[3]
    if r.ok and r.dt and not r.rough then
      lines[#lines + 1] = ('"%s",%g,%g,%g,%g'):format(r.name, r.dt, p.wall / p.time, r.wall / r.time,
        r.error)
      if r.dt == 0.01 then carry[r.name] = p.wall / p.time end
    end
  end)
  print(("carrying mixed costs 1/%.0f of carrying by the same mesh's plates, steps of 10 ms"):format(
    carry["plates, mesh near pads"] / carry.mixed))
  sink.run("mkdir -p " .. sink.quote(out))
  sink.write_file(out .. "/grip.csv", table.concat(lines, "\n") .. "\n")
end

-- Many obstacles, nodes, wires.
local function print_crowds()
  local crowds = require "bench.crowds"
  for _, count in ipairs{ 10, 1000, 10000 } do
    local made, step = crowds.boxes(count)
    print(("%6d boxes: made in %.3f s, %.2f ms a step of 500 segments"):format(count, made, 1e3 * step))
  end
  for _, nodes in ipairs{ 10000, 100000 } do
    print(("%6d nodes land at once: at most %.3f s a step, then %.3f s"):format(nodes, crowds.landing(nodes)))
  end
  for _, count in ipairs{ 1, 100, 1000 } do
    for _, touching in ipairs{ false, true } do
      local landing, lying = crowds.wires(count, touching)
      print(("%6d wires on a table%s: %.2f us a node and step landing, %.2f lying"):format(count,
        touching and ", which may touch" or "", 1e6 * landing, 1e6 * lying))
    end
  end
end

local function print_bundles()
  local crowds = require "bench.crowds"
  for _, count in ipairs{ 7, 10, 20 } do
    for _, cable in ipairs{ false, "GXL 1.5" } do
      local falling, lying, fell, lay = crowds.bundle(count, cable)
      local alone, still = crowds.bundle(count, cable, true)
      print(("%6d wires%s in a bundle: %.2f s a simulated second falling, %.1f solves each; lying %.2f, %.1f")
        :format(count, cable and " " .. cable or "", falling, fell, lying, lay))
      print(("       over wires that do not touch each other: %.0f times falling, %.0f lying"):format(
        falling / alone, lying / still))
      io.stdout:flush()
    end
  end
end

-- What a player's page costs, and in a browser that computes its graphics in software.
local function print_report()
  local report = require "bench.report"
  local function line(what, value, most, unit)
    print(("  %-14s %7.2f %-2s  within %g %s: %s"):format(what, value, unit, most, unit,
      value <= most and "met" or "missed"))
  end
  local run, scene = report.run(2000)
  sink.make_folder(out)
  local r, aims = report.write(run, scene, out .. "/report.html"), report.aims
  print(("\nplayer: %d frames of %d nodes, %d series of %d rows"):format(r.frames, r.nodes, r.columns,
    r.rows))
  line("page", 1e-6 * r.size, 1e-6 * aims.size, "MB")
  line("written in", r.write, aims.write, "s")
  line("  of CPU time", r.cpu, aims.write, "s")
  local found, browser = pcall(require, "spec.page.browser")
  local opened, page = pcall(found and browser.open or error, 1280, 720)
  if not opened then return print "  no Chromium to open it with: sh scripts/setup.sh --test" end
  local here = io.popen "pwd":read "l"
  page:go("file://" .. (r.path:sub(1, 1) == "/" and "" or here .. "/") .. r.path)
  local shown = page:run "return Number(document.body.dataset.picture)"
  line("first picture", shown / 1000, aims.picture, "s")
  line("new tube", page:run [[
    const w = player.view.actors.find((a) => a.kind === "wire");
    const look = { thick: 1, least: 0, ...player.view.colouring() };
    const begun = performance.now(), count = 100;
    for (let i = 0; i < count; i++) w.update({ frame: 10 * i, part: 0.5, time: 0 }, look, new Set());
    return (performance.now() - begun) / count;]], 1e3 * aims.tube, "ms")
  page:close()
end

-- What a live view costs a run.
local function print_view()
  local view = require "bench.view"
  local plain, alone, page, rate = view.costs(5)
  print(("\nlive view: %.2f s of CPU time without, %+.1f %% with a view that no page looks at,"):format(plain,
    100 * (alone / plain - 1)))
  print(("  %+.1f %% with a page that gets %.0f frames a second (within %g %%: %s)"):format(
    100 * (page / plain - 1), rate, 100 * view.aim, page / plain - 1 <= view.aim and "met" or "missed"))
end

-- Studies: what workers bring and cost.
local function print_study()
  local study = require "bench.study"
  local one, two, rate = study.laying(5, 200)
  print(("\nstudy of a laying of 4.5 s: %.0f a minute by two workers, %.2f times one (aim %g: %s)"):format(
    rate, one / two, study.aims.ratio, one / two >= study.aims.ratio and "met" or "missed"))
  local seconds, found = study.search()
  print(("  CMA-ES on three parameters of it, %d evaluations, %d failed, takes %.1f s (aim %g: %s)"):format(
    found.evaluations, found.failed, seconds, study.aims.search,
    seconds <= study.aims.search and found.ok and "met" or "missed"))
  local overhead = study.overhead(3, 5000)
  print(("  worker, pipe and journal take %.3f ms an evaluation (aim %g: %s)"):format(1e3 * overhead,
    1e3 * study.aims.overhead, overhead <= study.aims.overhead and "met" or "missed"))
  local opened = study.opening(1000000)
  print(("  a journal of 1e6 evaluations opens in %.2f s (aim %g: %s)"):format(opened, study.aims.opening,
    opened <= study.aims.opening and "met" or "missed"))
end

-- Calibrations of known cables: time, and the share of intervals that hold the truth.
local function print_calibration()
  local calibration = require "bench.calibration"
  local aims = calibration.aims
  for _, estimated in ipairs{ false, true } do
    local EI, GJ, longest, mean, bad = calibration.coverage(1000, 11, estimated)
    local met = math.min(EI, GJ) >= aims.low and math.max(EI, GJ) <= aims.high
    print(("\ncalibration by 20 points of a sag (sigma %s) and a critical twist: %.0f ms, at most %.0f ms "
      .. "(aim %g s: %s)"):format(estimated and "estimated" or "given", 1e3 * mean, 1e3 * longest, aims.time,
      longest <= aims.time and "met" or "missed"))
    print(("  of 1,000 cables %.1f %% of intervals hold EI, %.1f %% GJ (aim %g to %g %%: %s); %d not found")
      :format(100 * EI, 100 * GJ, 100 * aims.low, 100 * aims.high, met and "met" or "missed", bad))
  end
end

if not next(wanted) or wanted.case and wanted.case.report then print_report() end
if not next(wanted) or wanted.case and wanted.case.meshes then print_meshes() end
if not next(wanted) or wanted.case and wanted.case.grip then print_grips() end
if wanted.case and wanted.case.view then print_view() end
if wanted.case and wanted.case.study then print_study() end
if wanted.case and wanted.case.calibration then print_calibration() end
if wanted.case and wanted.case.auto then require("bench.auto").print(wanted.n and next(wanted.n)) end
if wanted.case and wanted.case.crowds then print_crowds() end
if wanted.case and wanted.case.bundle then print_bundles() end
local bad = {}
for _, row in ipairs(rows) do
  if row.status ~= "ok" then bad[row.status] = (bad[row.status] or 0) + 1 end
end
local counts = {}
for status, count in pairs(bad) do counts[#counts + 1] = count .. " " .. status end
table.sort(counts)
if #rows == 0 then return end
print(("\n%d rows in %s%s"):format(#rows, path,
  #counts > 0 and " (" .. table.concat(counts, ", ") .. ")" or ""))
