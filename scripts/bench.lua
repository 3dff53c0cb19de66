-- SPDX-License-Identifier: GPL-3.0-or-later
-- Measures error against time for cases x models x resolutions x integrators x steps.
--   build/softworld scripts/bench.lua [quick] [case=..] [model=..] [integrator=..] [n=..] [out=folder]
-- Writes one CSV row for each to out/bench/bench.csv and a summary to the terminal. Values may be lists:
-- case=droop,walls. Further cases: meshes: cost of wires that are meshes of particles (terminal only);
-- grip: grippers; crowds: many obstacles, nodes and wires; report: the player's page; bundle: wires that lie
-- along each other; view: cost of a live view; study: gain and cost of a study's workers; calibration: 1,000
-- known cables, and how often the intervals contain the true values; auto: runs that choose their model,
-- against fixed models, with seed=, count= (of scenes) and kind= (of scenes).
-- Compare only numbers of the same run, because machines and their loads differ.
package.path = (arg[0]:match "^(.*/)" or "") .. "?.lua;" .. package.path
package.cpath = (arg[-1]:match "^(.*/)" or "") .. "lib/?.so;" .. package.cpath -- softworld.probe
local bench = require "bench.rows"
local choice = require "bench.choice"
local special = require "bench.special"
local summary = require "bench.summary"
local sink = require "softworld.output.sink"
require("softworld.unread").quiet()

-- Choice of rows -------------------------------------------------------------------

local wanted, numbers, quick, out = {}, {}, false, "out/bench"
for _, word in ipairs(arg) do
  local key, value = word:match "^(%w+)=(.+)$"
  if word == "quick" then
    quick = true
  elseif key == "out" then
    out = value
  elseif key == "case" or key == "model" or key == "integrator" or key == "n" or key == "kind" then
    wanted[key] = {}
    for item in value:gmatch "[^,]+" do wanted[key][item] = true end
  elseif (key == "seed" or key == "count") and math.tointeger(tonumber(value)) then
    numbers[key] = math.tointeger(tonumber(value))
  else
    io.stderr:write("bench: '", word, "' is none of quick case= model= integrator= n= seed= count= kind= "
      .. "out=\n")
    os.exit(2)
  end
end

local function chosen(entry)
  local c = entry.config
  local function fits(key, value) return not wanted[key] or wanted[key][tostring(value)] end
  return fits("case", entry.case.name) and fits("model", c.model) and fits("n", c.segments)
    and fits("integrator", c.integrator or "static")
end

local jobs = choice.jobs(quick, chosen)
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
if #rows > 0 then bench.write(path, rows) end -- else the old file stays

-- Summary --------------------------------------------------------------------------

summary.print(rows)
if not next(wanted) then
  special.bars()
  special.links()
end
if not next(wanted) or wanted.case and wanted.case.report then special.report(out) end
if not next(wanted) or wanted.case and wanted.case.meshes then special.meshes() end
if not next(wanted) or wanted.case and wanted.case.grip then special.grips(out) end
if wanted.case and wanted.case.view then special.view() end
if wanted.case and wanted.case.study then special.study() end
if wanted.case and wanted.case.calibration then special.calibration() end
if wanted.case and wanted.case.auto then
  require("bench.auto").print(numbers.seed, wanted.kind, numbers.count)
end
if wanted.case and wanted.case.crowds then special.crowds() end
if wanted.case and wanted.case.bundle then special.bundles() end
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
