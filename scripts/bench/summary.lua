-- SPDX-License-Identifier: GPL-3.0-or-later
--- Prints the rows of a bench on the terminal: aims, costs, errors.
local summary = {}

local rows -- the rows to print

local with_frames = { "curved", "flat", "rolling" }

local function number(format, x) return x and x ~= "" and format:format(x) or "-" end

local function step_of(row)
  if row.tolerance ~= "" then return ("tol %g"):format(row.tolerance) end
  return row.dt ~= "" and ("%.3g ms"):format(1e3 * row.dt) or ""
end

local function row_name(row)
  return ("%s N=%d %s %s"):format(row.model, row.segments, row.integrator, step_of(row))
end

-- Returns the fastest row of a case with status ok for which passes(row) is true.
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

-- Prints the ratio of the largest to the smallest cost per node and step, and the bytes per node of the
-- largest wire.
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

-- Prints the cost of material frames (of curved, flat and rolling wires) over that of a wire without frames.
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

--- Prints all.
function summary.print(list)
  rows = list
  print_aims()
  scale_ratio()
  frames_ratio()
  print_best()
  print_walls()
  print_scale()
end

return summary
