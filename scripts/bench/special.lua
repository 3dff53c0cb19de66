-- SPDX-License-Identifier: GPL-3.0-or-later
--- Benches without rows in the table; they print to the terminal.
local bench = require "bench.rows"
local sink = require "softworld.output.sink"

local special = {}

-- Prints the cost of error bars.
function special.bars()
  print "\nerror bars of the tip, N = 50    levels    wall ms  over the finest alone       bar"
  for _, r in ipairs(bench.error_bars()) do
    print(("  %-30s %6d  %9.3f  %20.2f x  %6.3f mm  %s"):format(r.case, r.levels, 1e3 * r.wall, r.ratio,
      1e3 * r.error, r.ok and "as asked" or "NOT as asked"))
  end
end

-- Prints the cost of wires that touch or are joined.
function special.links()
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

-- Prints the cost of wires that are meshes of particles.
function special.meshes()
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

-- Prints cost and results of each way of handling in the two-plate test; writes out/bench/grip.csv.
function special.grips(out)
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

-- Prints the cost of many obstacles, nodes and wires.
function special.crowds()
  local crowds = require "bench.crowds"
  for _, count in ipairs{ 10, 1000, 10000 } do
    local made, step = crowds.boxes(count)
    print(("%6d boxes: made in %.3f s, %.2f ms a step of 500 segments"):format(count, made, 1e3 * step))
  end
  for _, nodes in ipairs{ 10000, 100000 } do
    print(("%6d nodes land at once: at most %.3f s a step, then %.3f s"):format(nodes, crowds.landing(nodes)))
  end
  for _, count in ipairs{ 1, 100, 1000 } do
    for _, touching in ipairs{ false, true, "crossed" } do
      local landing, lying = crowds.wires(count, touching)
      local how = touching == "crossed" and ", one falls across two" or touching and ", which may touch" or ""
      print(("%6d wires on a table%s: %.2f us a node and step landing, %.2f lying"):format(count, how,
        1e6 * landing, 1e6 * lying))
    end
  end
  local alone = crowds.board(0)
  for _, count in ipairs{ 10, 40 } do
    print(("%6d clamped wires on a table, and one is laid there: %.1f times the time of it alone"):format(
      count, crowds.board(count) / alone))
  end
end

function special.bundles()
  local crowds = require "bench.crowds"
  for _, count in ipairs{ 7, 10, 20 } do
    for _, cable in ipairs{ false, "GXL 1.5" } do
      local falling, lying, fell, lay, second = crowds.bundle(count, cable)
      local alone, still = crowds.bundle(count, cable, true)
      print(("%6d wires%s in a bundle: the first second in %.2f s; per simulated second %.2f s falling, "
        .. "%.1f solves a step; %.2f s lying, %.1f"):format(count, cable and " " .. cable or "", second,
        falling, fell, lying, lay))
      print(("       over wires that do not touch each other: %.0f times falling, %.0f lying"):format(
        falling / alone, lying / still))
      io.stdout:flush()
    end
  end
end

-- Prints the cost of a player's page, also in a browser that renders in software.
function special.report(out)
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

-- Prints the cost of a live view for a run.
function special.view()
  local view = require "bench.view"
  local plain, alone, page, rate = view.costs(5)
  print(("\nlive view: %.2f s of CPU time without, %+.1f %% with a view that no page looks at,"):format(plain,
    100 * (alone / plain - 1)))
  print(("  %+.1f %% with a page that gets %.0f frames a second (within %g %%: %s)"):format(
    100 * (page / plain - 1), rate, 100 * view.aim, page / plain - 1 <= view.aim and "met" or "missed"))
end

-- Prints gain and cost of a study's workers.
function special.study()
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

-- Prints, for calibrations of known cables, the time and the share of intervals that contain the true value.
function special.calibration()
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

return special
