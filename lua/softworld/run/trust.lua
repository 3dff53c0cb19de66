-- SPDX-License-Identifier: GPL-3.0-or-later
--- Error bars: scene:settle and scene:run with tolerance = { quantity = value }.
--
--     local run = scene:run{ tolerance = { ["left.peak_force"] = 0.05, max_tension = 0.1,
--       { name = "sag", value = 1e-4, unit = "m",
--         of = function() return -wire:position(0.5)[3] end } } }
--     print(run:error_bars())
--     print(run.quantities.sag.value, run.quantities.sag.error)
--
-- The scene is computed from the same start on coarser and finer meshes, in a run with
-- time steps that are halved with the edges. The changes of the quantities from level to
-- level show the error of the finest level. A failed level is left out if a finer one
-- succeeds; otherwise there are no numbers.
-- @module softworld.run.trust
local coarsest = require "softworld.run.coarsest"
local bars = require "softworld.run.bars"
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local estimate = require "softworld.run.estimate"
local kept = require "softworld.run.kept"
local number = require "softworld.output.number"
local process = require "softworld.run.process"
local quantity = require "softworld.quantity"
local replaced = require "softworld.run.replaced"
local sealed = require "softworld.sealed"

local trust = {}

local first_share = 1 / 4 -- segments of the coarsest level over those asked for [-]
local fewest = 6          -- least segments of the coarsest level, unless fewer were asked for
local most_levels = { ["scene:settle"] = 7, ["scene:run"] = 5 } -- default
local finest_level = 12   -- its edges are 1/512 of those asked for
local failures = 3        -- levels that may fail before giving up

--- True if the argument table asks for error bars.
function trust.wanted(args) return type(checks.field(args, "tolerance")) == "table" end

-- --- results ----------------------------------------------------------------------------

trust.error_bars, trust.unmet, trust.watch = bars.error_bars, bars.unmet, bars.watch

--- For the __index of results: raises an error if the quantities of a refused result are read.
function trust.refuse(result, key)
  if key == "quantities" and sealed.fields(result).refused then
    error(("there are no numbers: %s (%s)"):format(result.reason, result.advice), 2)
  end
end

-- --- levels -----------------------------------------------------------------------------

--- Returns the number of segments of every wire on level k, counted from 1; all edges of a wire are equal.
function trust.counts(job, k)
  local list = {}
  for i, n in ipairs(job.first) do list[i] = n << (k - 1) end
  return list
end

local function first_counts(scene)
  local counts, least = {}, math.huge
  for i, w in ipairs(build.data(scene).wires) do
    counts[i] = core.segments(w.object)
    least = math.min(least, counts[i])
  end
  local share = math.min(1, math.max(first_share, fewest / least))
  for i, n in ipairs(counts) do counts[i] = math.max(2, math.ceil(n * share - 1e-9)) end
  return counts, share
end

-- Takes the levels out of the table of arguments and checks them.
local function take_levels(what, args)
  local levels = args.levels
  args.levels = nil
  if levels == nil then return most_levels[what] end
  if math.type(levels) ~= "integer" or levels < coarsest.LEAST
    or levels > finest_level then
    error(("%s: levels = %s is not allowed; it must be a whole number from %d to %d"):format(what,
      checks.shown(levels), coarsest.LEAST, finest_level), 0)
  end
  return levels
end

--- Returns a job: a computation to be done level by level.
-- @tparam table args a copy of the caller's, from which tolerance and levels are taken
-- @treturn table a job; the caller sets its advice, for when nothing can be computed, and its moves,
--   true before a level with inertia is judged
function trust.job(scene, what, args)
  local data = build.data(scene)
  if data.running then
    error(("%s: a run of scene '%s' is under way; error bars need computations from the start: ask for them "
      .. "outside of processes"):format(what, scene.name), 0)
  end
  local bodies, under_way = process.bodies(scene)
  if not bodies then
    error(("%s: %s is under way and cannot begin again, which error bars need; run the scene without error "
      .. "bars until it has ended, or ask for them from the start"):format(what, tostring(under_way)), 0)
  end
  if #data.wires + #data.particles == 0 then
    error(("%s: scene '%s': there is no wire"):format(what, scene.name), 0)
  end
  local job = { scene = scene, what = what, values = {}, levels = {}, skipped = 0, gone = #(data.gone or {}),
    scripted = #bodies > 0 }
  local count = (data.process_count or 0) - #bodies
  function job.begin_processes()
    data.process_count = count -- the same numbers again
    process.renew(scene, bodies)
  end
  local asked, check = args.tolerance, what == "scene:run" and args.check or nil
  if check and asked ~= nil and type(asked) ~= "table" then
    error(("%s: with check, tolerance must be a table of quantities or be left out, got %s"):format(what,
      checks.got(asked)), 0)
  end
  job.quantities = asked and quantity.list(scene, asked, what) or {}
  if #data.particles > 0 then
    error(("%s: error bars go with wires only, and '%s' is an object of particles; give dt, or tolerance "
      .. "as a number"):format(what, data.particles[1].name), 0)
  end
  args.tolerance = nil
  job.most = take_levels(what, args)
  job.first, job.share = first_counts(scene)
  coarsest.pass(job)
  for _, q in ipairs(job.quantities) do job.values[q.name] = {} end
  if check then require("softworld.check.bars").take(job, args) end
  return job
end

-- True if more than 1 % of the steps were redone by first-order methods. Differences between levels are then
-- no estimate of what follows.
local function was_redone(scene)
  local l = core.ledger(scene)
  return l.redone.count > 0.01 * l.steps
end

--- True if anything touches, or has touched in this run.
function trust.touches(scene)
  if scene:contacts() > 0 or build.data(scene).touching then return true end
  for _, o in ipairs(build.data(scene).obstacles) do
    local rows, count = o.object:log()
    for i = 0, count - 1 do
      if rows[5 * i + 2] ~= 0 or rows[5 * i + 3] ~= 0 or rows[5 * i + 4] ~= 0 then return true end
    end
  end
  return false
end

--- Returns the values of the quantities after a computation, by their names. The same one is read only once.
function trust.read(job, result)
  if job.result ~= result then
    if job.rows then job.rows(result) end
    job.found, job.result = quantity.read_all(job.quantities, result.start), result
  end
  return job.found
end

--- Adds the value on level k to those of a quantity. Lists of other lengths cannot be compared.
function trust.add(q, values, k, value)
  if k > 1 and not quantity.alike(values[k - 1], value) then
    error(("quantity '%s': its list must have the same length on every mesh; evaluate it at the same places")
      :format(q.name), 0)
  end
  values[k] = value
end

-- Reads the quantities on the level just computed. Returns whether all tolerances are met, and whether finer
-- levels are in vain: a bar is more than `hopeless` times too long, even without the extra caution for coarse
-- levels of a motion, which ends with finer levels. A row of a check with such a bar does not hold up the
-- others: its value is practically at its limit.
local function judge(job, result, hopeless)
  local met, vain = true, false
  job.contact = job.contact or trust.touches(job.scene) or was_redone(job.scene)
  job.read = trust.read(job, result)
  for _, q in ipairs(job.quantities) do
    local now, values = job.read[q.name], job.values[q.name]
    trust.add(q, values, #values + 1, now.value)
    now.error, now.rate = estimate.bar(q, values, job.contact, job.moves)
    now.least = estimate.bar(q, values, job.contact)
    local asked = quantity.asked(q, now.value)
    local aim = q.aim and q.aim(asked) or asked
    if now.error > aim then
      local far = now.least > hopeless * aim
      met, vain = met and far and q.row, vain or far and not q.row
    end
  end
  return met, vain
end

local function describe(job, k)
  local most = 0
  for _, n in ipairs(trust.counts(job, k)) do most = math.max(most, n) end
  return ("level %d, %s"):format(k, number.count(most, "segment"))
end

-- Returns the longest edges of level k and the wire that has them, in words.
local function edges_of(job, k)
  local longest, text = 0, ""
  for i, n in ipairs(trust.counts(job, k)) do
    local wire = build.data(job.scene).wires[i]
    local edge = wire and wire.object.length / n or 0
    if edge > longest then
      longest = edge
      text = (", wire '%s' has edges of %s, where the script asks for %s"):format(wire.name,
        number.text(edge, "m"), number.text(edge * 2 ^ (k - 1) * job.share, "m"))
    end
  end
  return text
end

-- Computes level k. An error of the script or of one of its calls tells the level: its edges may be longer
-- than those that the script asks for.
local function computed(job, k, compute)
  local fine, result = pcall(compute, k, describe(job, k))
  if fine then return result end
  if type(result) ~= "string" or checks.is_interrupt(result) then error(result, 0) end
  error(("%s (in %s for error bars: on level %d%s)"):format(result, job.what, k, edges_of(job, k)), 0)
end

-- Raises an error if wires came or went: levels have segments for the wires that exist at their start.
local function check_wires(job)
  local data = build.data(job.scene)
  local gone = #(data.gone or {}) > job.gone and data.gone[#data.gone]
  if gone then
    error(("%s: '%s' was taken away during the run, so the computation cannot be repeated for error bars")
      :format(job.what, gone.label), 0)
  end
  local wires = data.wires
  local new = wires[#job.first + 1]
  if not new then return end
  error(("%s: wire '%s' was made during the run, so the computation cannot be repeated for error bars; make "
    .. "it before the run"):format(job.what, new.name), 0)
end

-- Forgets the values of all levels so far.
local function forget(job, why)
  job.known, job.failure = 0, why
  for name in pairs(job.values) do job.values[name] = {} end
end

-- Computes level after level until the bars are short enough. Returns the last result.
local function climb(job, compute)
  local first = math.min(job.begun or 0, job.most - 1) -- levels with known values
  local good, bad, result = first, 0, nil
  if job.prepare then job.prepare() end
  for k = first + 1, job.most do
    if k > first + 1 and job.enough and job.enough(k, good) then break end
    if k > first + 1 then
      check_wires(job)
      job.restore()
    end
    local known, begun = job.kept and job.kept(k), nil
    if known then
      result, job.levels[#job.levels + 1] = known.run, known.level
    else
      if job.arrange then job.arrange() end
      core.remesh(job.scene, trust.counts(job, k))
      begun = os.clock()
      result = computed(job, k, compute)
      job.levels[#job.levels + 1] = { segments = trust.counts(job, k), ok = result.ok, reason = result.reason,
        cpu = os.clock() - begun }
    end
    if result.ok then
      local jammed = coarsest.is_jammed(result)
      if job.jammed and not jammed and k < job.most then -- the coarser edges show nothing
        forget(job, "a wire jams or tears on it")
        good = 0
      end
      job.jammed = jammed
      local most = estimate.HOPED ^ (job.most - k)
      job.known = good
      local met, vain = judge(job, result, most)
      if begun then job.levels[#job.levels].cpu = os.clock() - begun end -- reading long records takes time
      good, bad, job.finest, job.known = good + 1, 0, k, good + 1
      if good >= coarsest.LEAST and (met or vain) then break end
    else
      good, bad = 0, bad + 1
      forget(job, result.reason)
      if bad == failures then break end
    end
  end
  return result
end

-- Returns what to do about bars that are too long.
local function advice_of(job)
  local worst, slow = 0, nil
  for _, q in ipairs(job.quantities) do
    local now = job.read[q.name]
    local levels = now.error > 0 and math.log(now.error / q.tolerance) / math.log(now.rate) or 0
    if levels > worst then worst, slow = levels, q end
  end
  if not slow then return nil end
  local now, more = job.read[slow.name], math.ceil(worst)
  local k = job.finest + more
  local reached = ("%s has an error bar of %s on %s; "):format(slow.name, number.text(now.error, slow.unit),
    describe(job, job.finest))
  local less = slow.row and "leave a larger margin to its limit" or "give a larger tolerance"
  if now.rate <= 1 then
    return ("%sit does not converge: find what jumps in the run, or %s"):format(reached, less)
  end
  local asked = number.text(slow.tolerance, slow.unit)
  if k > finest_level then
    return reached .. ("an error bar of %s needs more than levels = %d: %s"):format(asked, finest_level, less)
  end
  return reached .. ("an error bar of %s needs about levels = %d (%s)"):format(asked, k, describe(job, k))
end

local function conclude(job, result)
  result.asked, result.levels, result.checked = {}, job.levels, job.check
  if not result.ok or job.known < 2 then
    if result.ok then result.reason = "all levels but the last failed: " .. job.failure end
    result.ok, result.refused, result.met = false, true, false
    result.where = ("%s: %s"):format(describe(job, #job.levels), result.reason)
    result.advice = job.advice
    return result
  end
  result.quantities, result.met = {}, true
  for _, q in ipairs(job.quantities) do
    local now = job.read[q.name]
    if now.value == now.value then -- else there is nothing to measure
      local met = now.error <= q.tolerance
      result.met, result.asked[#result.asked + 1] = result.met and met, q.name
      result.quantities[q.name] = setmetatable({ name = q.name, value = now.value, error = now.error,
        unit = q.unit, tolerance = q.tolerance, met = met, where = now.where, when = now.when,
        note = now.note, row = q.row, levels = job.values[q.name] }, bars.Quantity)
    end
  end
  if not result.met then result.advice = advice_of(job) end
  return result
end

--- Stores the start of the job; job.restore() returns to it.
function trust.open(job)
  local scene, data = job.scene, build.data(job.scene)
  kept.begin(scene)
  local start, restores, orders = scene:snapshot(), data.restores, replaced.image(scene)
  function job.restore()
    local fine, why = pcall(scene.restore, scene, start, true)
    data.restores = restores -- the records of earlier runs still exist
    replaced.back(scene, orders)
    if not fine then error(why, 0) end -- of a `<close>` variable of a process
  end
  function job.close() start:close() end
end

--- Does the job: compute(level, name) returns a result with ok and reason. After an error or
-- a refusal the scene is as it was before; else in the final state of the finest level. Needs trust.open.
function trust.work(job, compute)
  local fine, result = pcall(climb, job, compute)
  if fine then result = conclude(job, result) end
  local tidy, why = true, nil
  if not fine or result.refused then
    tidy, why = pcall(job.restore)
    job.begin_processes()
  end
  if not fine then error(result, 0) end
  if not tidy then error(why, 0) end
  return result
end

--- Same for a job whose start is not needed any more.
function trust.once(job, compute)
  trust.open(job)
  local fine, result = pcall(trust.work, job, compute)
  job.close()
  if not fine then error(result, 0) end
  return result
end

return trust
