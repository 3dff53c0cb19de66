-- SPDX-License-Identifier: GPL-3.0-or-later
--- Measures error against time: one row for each configuration. A case (bench.cases) makes a scene and knows
-- its exact result. It is run once for the error and then, from the same snapshot, until the time is steady.
-- @module bench.rows
local core = require "softworld.core"
local csv = require "softworld.csv"

local bench = {}

--- Columns of a row, in the file's order.
bench.columns = { "case", "model", "segments", "integrator", "dt", "tolerance", "error", "unit",
  "wall", "cpu", "runs", "steps", "rejected", "iterations", "evaluations", "penetration",
  "crossings", "looked", "bytes", "status", "reason" }

bench.batch = 0.02 -- shortest time of a batch of runs [s]
bench.batches = 3  -- batches; the best one counts [-]
bench.patience = 1 -- longer runs are not repeated [s]

-- The cases with error bars: case, tolerance of the tip [m], and how it is computed.
local bars = {
  { "droop", 1e-4, function(c, tolerance) return c.scene:settle{ tolerance = tolerance } end },
  { "release", 1e-3, function(c, tolerance)
    return c.scene:run{ duration = 0.5, tolerance = tolerance, frame = 1e9 }
  end },
}

--- Cost of error bars: one row for each case with its levels, the time of all levels and of the finest alone
-- [s], their ratio, the error bar and the tolerance [m].
function bench.error_bars()
  local cases, rows = require "softworld.cases", {}
  for i, entry in ipairs(bars) do
    local best
    for _ = 1, bench.batches do
      local c = cases[entry[1]]{ segments = 50 }
      local t = core.clock()
      local r = entry[3](c, { tip = entry[2] })
      t = core.clock() - t
      local row = { case = entry[1], ok = r.ok and r.met, levels = #r.levels, wall = t,
        finest = r.levels[#r.levels].cpu, asked = entry[2], error = r.ok and r.quantities.tip.error }
      row.ratio = row.wall / math.max(row.finest, 1e-6) -- resolution of the clock [s]
      if not best or row.wall < best.wall then best = row end
      c.scene:close()
    end
    rows[i] = best
  end
  return rows
end

local function by_name(list, name)
  for _, entry in ipairs(list) do
    if entry.name == name then return entry end
  end
end

local registry
--- Returns the registry row of an integrator: { name, order, implicit, adaptive, leapfrog_limit }.
function bench.integrator(name)
  registry = registry or core.registry()
  return by_name(registry.integrators, name)
end

--- Returns the names of all implicit, or all explicit, integrators in the registry's order.
function bench.integrators(implicit)
  registry = registry or core.registry()
  local names = {}
  for _, m in ipairs(registry.integrators) do
    if implicit == nil or m.implicit == implicit then names[#names + 1] = m.name end
  end
  return names
end

-- Coefficients of the stability polynomial 1 + z + z^2/2 + ... after the terms of the exponential series;
-- found by stepping y' = z y on a circle of complex z.
local tails = {
  ["gsl-rkf45"] = { order = 5, 1 / 2080 },
  ["gsl-rkck"] = { order = 5, 0.00125 },
  ["gsl-rk8pd"] = { order = 8, 2.7521279901e-06, 2.4231996587e-07, 2.43897182054e-08,
    -2.03461528969e-10 },
}

-- Returns |R(i y)| of a polynomial.
local function amplification(tail, y)
  local re, im, power, factorial = 0, 0, 1, 1
  for k = 0, tail.order + #tail do
    if k > 0 then power, factorial = power * y, factorial * k end
    local c = (k <= tail.order and 1 / factorial or tail[k - tail.order]) * power
    if k % 4 == 0 then re = re + c elseif k % 4 == 1 then im = im + c
    elseif k % 4 == 2 then re = re - c else im = im - c end
  end
  return (re * re + im * im) ^ 0.5
end

--- Returns |R(i y)|: the growth of an undamped motion in one step of an explicit method, y = h omega [-].
function bench.growth(name, y)
  if name == "symplectic-euler" or name == "velocity-verlet" then -- both are leapfrog methods
    return y <= 2 and 1 or y * y / 2 - 1 + y * (y * y / 4 - 1) ^ 0.5
  end
  if name == "gsl-rk4" then return amplification({ order = 4 }, y / 2) ^ 2 end -- it takes two half steps
  return amplification(tails[name] or { order = bench.integrator(name).order }, y)
end

--- Returns the largest h omega [-] up to which amplitudes grow less than by the factor `growth` in `steps`
-- steps. For methods with a sharp limit it does not depend on the count; some methods of odd order grow
-- slowly at every step.
function bench.limit(name, steps, growth)
  local allowed, y = growth ^ (1 / steps), 0
  while y < 20 and bench.growth(name, y + 1e-3) <= allowed do y = y + 1e-3 end
  return y
end

local function options_of(config)
  if not config.integrator then return {} end
  return { dt = config.dt, tolerance = config.tolerance, integrator = config.integrator,
    unstable = true, parts = false } -- to find limits, and the errors of undivided steps dt
end

-- Runs a made case from its start to its end.
local function examine(case, state, config)
  local total = { steps = 0, rejected = 0, iterations = 0, evaluations = 0 }
  local r = case.run(state, options_of(config))
  for key in pairs(total) do total[key] = r[key] or 0 end
  if case.static then total.evaluations = total.iterations end -- one evaluation an iteration
  return total, r.ok and "ok" or case.static and "failed" or "diverged", r.ok and "" or r.reason
end

--- Measures a function in batches. Returns wall (the fastest single call) [s], cpu (the best mean of a batch)
-- [s], number of calls. `again` restores the state before each call.
function bench.time(again, work)
  local wall, cpu, runs = math.huge, math.huge, 0
  for _ = 1, bench.batches do
    local sum, cpu_sum, count = 0, 0, 0
    repeat
      again()
      local c, t = os.clock(), core.clock()
      work()
      t, c = core.clock() - t, os.clock() - c
      wall, sum, cpu_sum, count = math.min(wall, t), sum + t, cpu_sum + c, count + 1
    until sum >= bench.batch
    cpu, runs = math.min(cpu, cpu_sum / count), runs + count
    if sum > bench.patience then break end
  end
  return wall, cpu, runs
end

-- Returns wall and cpu time of a run [s], number of runs, last report. A case with `remake` starts each time
-- from a new scene instead of the snapshot.
local function measure_time(case, state, snapshot, config)
  local options, report = options_of(config), nil
  local function again()
    if not case.remake then return state.scene:restore(snapshot) end
    state.scene:close()
    state = case.make(config)
    state.scene:snapshot() -- makes the system, whose time does not count for the run
  end
  local function work()
    if case.static then report = case.run(state, options)
    else report = state.scene:advance(options, state.duration) end
  end
  local wall, cpu, runs = bench.time(again, work)
  state.scene:close()
  return wall, cpu, runs, report
end

local function empty_row(case, config)
  return { case = case.name, model = config.model or "rod", segments = config.segments,
    integrator = config.integrator or "static", dt = config.dt or "",
    tolerance = config.tolerance or "", error = "", unit = case.unit or "% of L", wall = "", cpu = "",
    runs = 0, steps = 0, rejected = 0, iterations = 0, evaluations = 0, penetration = "",
    crossings = "", looked = "", bytes = "", status = "ok", reason = "" }
end

-- Returns the step of an explicit method from its share of the stable step.
local function fixed_step(state, config)
  if not config.share then return config end
  local copy = {}
  for k, v in pairs(config) do copy[k] = v end
  local limit = bench.limit(config.integrator, 20000, 100)
  copy.dt = config.share * limit / 2 * state.scene:stable_dt()
  return copy
end

local function in_use()
  collectgarbage()
  collectgarbage()
  return (core.allocated())
end

-- Returns the core's memory per node of a scene that has made one step [B].
local function weigh(case, config)
  local before = in_use()
  local state = case.make(config)
  state.scene:advance(options_of(config), config.dt)
  local bytes = in_use() - before
  state.scene:close()
  return bytes / (config.segments + 1)
end

-- Returns the first line of a message.
local function line_of(text) return (tostring(text):match "[^\n]*") end

--- Runs one configuration { model =, segments =, integrator =, dt = or tolerance = or share = } of a case.
-- share: step over the stable step of an explicit method. It does not raise if the simulation fails: the
-- row's status is ok, diverged (a run), failed (an equilibrium), refused (the arguments) or unrepeatable (a
-- snapshot did not give the same equilibrium), with the reason.
function bench.row(case, config, untimed)
  local fine, state = pcall(case.make, config)
  if not fine then
    local row = empty_row(case, config)
    row.status, row.reason = "refused", line_of(state)
    return row
  end
  config = fixed_step(state, config)
  local row = empty_row(case, config)
  local snapshot = state.scene:snapshot()
  local done, total, status, reason = pcall(examine, case, state, config)
  if not done then
    if core.interrupted() then error(total, 0) end
    row.status, row.reason = "refused", line_of(total)
  else
    for key, value in pairs(total) do row[key] = value end
    row.status, row.reason = status, reason
  end
  if case.weigh then row.bytes = weigh(case, config) end
  if row.status == "ok" then
    case.judge(state, row)
    if row.error ~= row.error then row.error, row.status, row.reason = "", "failed", "not a number" end
  end
  if not done or untimed then
    state.scene:close()
    return row
  end
  local report
  row.wall, row.cpu, row.runs, report = measure_time(case, state, snapshot, config)
  if case.static and report.iterations ~= row.iterations then
    row.status = "unrepeatable"
    row.reason = ("%d iterations, then %d from a snapshot"):format(row.iterations, report.iterations)
  end
  return row
end

--- Writes rows as CSV.
function bench.write(path, rows, names)
  names = names or bench.columns
  local columns = {}
  for _, name in ipairs(names) do
    columns[name] = {}
    for i, row in ipairs(rows) do
      local value = row[name]
      columns[name][i] = value == nil and "" or value
    end
  end
  csv.write(path, names, columns)
end

--- Reads rows back; cells with numbers become numbers, empty cells become nil.
function bench.read(path)
  local data = csv.read(path, { text = setmetatable({}, { __index = function() return true end }) })
  local rows = {}
  for i = 1, data.count do
    local row = {}
    for _, name in ipairs(data.names) do
      local cell = data.columns[name][i]
      if cell ~= "" then row[name] = tonumber(cell) or cell end
    end
    rows[i] = row
  end
  return rows
end

return bench
