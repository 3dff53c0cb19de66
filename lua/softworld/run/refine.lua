-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:run with error bars: repeats the run level by level, with edges and time steps
-- halved together, so that both errors shrink alike.
-- @module softworld.run.refine
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local process = require "softworld.run.process"
local quantity = require "softworld.quantity"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"
local working = require "softworld.run.working"

local refine = {}

-- Error allowed per step with n segments, over L / n^3. With this value the steps' error in a
-- swing is about that of the edges.
local step_share = 0.02
-- Least error allowed per step beside obstacles, over the length. Friction agrees with its law to 1 % of the
-- force: below this value the estimate of a step's error shows only that. With three pegs 1e-9 m and 1e-10 m
-- end with the same tension within 0.15 %, in three to four times as many steps.
local least_share = 1e-9
local longest_step = 0.01 -- default dt [s]
local at_rest = 1e-6      -- a scene is at rest if settling moves a wire by less, over its length [-]

local integrators -- by name; the core lists all its registries anew at each call, which costs half a ms

-- Returns the registry's entry of an integrator.
local function method_of(name)
  if not integrators then
    integrators = {}
    for _, m in ipairs(core.registry().integrators) do integrators[m.name] = m end
  end
  return integrators[name or "tr-bdf2"]
end

-- Returns the function that gives the options of the run of level k.
local function steps_of(job, args)
  local dt = args.dt or longest_step
  local adaptive = not args.quasistatic and method_of(args.integrator).adaptive
  local error_of_step, least, data = math.huge, math.huge, build.data(job.scene)
  for i, w in ipairs(data.wires) do
    error_of_step = math.min(error_of_step, step_share * w.object.length / job.first[i] ^ 3)
    least = math.min(least, least_share * w.object.length)
  end
  if #data.obstacles == 0 then least = 0 end
  return function(k)
    local options = {}
    for key, value in pairs(args) do options[key] = value end
    options.dt = dt / job.share / 2 ^ (k - 1)
    if options.parts == nil then options.parts = false end -- all levels have the same kind of steps
    if adaptive then options.tolerance = math.max(least, error_of_step / 8 ^ (k - 1)) end
    return options
  end
end

--- True if the argument table of a run asks for error bars.
function refine.wanted(args) return trust.wanted(args) or checks.field(args, "check") ~= nil end

local function positions_of(scene)
  local list = {}
  for i, w in ipairs(build.data(scene).wires) do list[i] = (w.object:positions()) end
  return list
end

local function moves(scene)
  for _, w in ipairs(build.data(scene).wires) do
    for _, v in ipairs(w.object:velocities()) do
      if v ~= 0 then return true end
    end
  end
  return false
end

-- True if the scene is in the equilibrium that settling finds. Each level then starts at rest too.
local function is_at_rest(scene)
  if moves(scene) then return false end
  local before, wires = positions_of(scene), build.data(scene).wires
  local settled = unread.excused(scene.settle, scene, { max_iterations = 100 })
  local rest = settled.ok
  for i, now in ipairs(rest and positions_of(scene) or {}) do
    local limit = at_rest * wires[i].object.length
    for k, x in ipairs(now) do rest = rest and math.abs(x - before[i][k]) <= limit end
  end
  return rest
end

-- Starts processes that read the quantities with a time of their own.
local function sample(job)
  for _, q in ipairs(job.quantities) do
    if q.at then
      q.sample = nil
      job.scene:process(function(p)
        p:wait(q.at)
        q.sample = quantity.read(q, p.scene.time - q.at)
        q.sample.when = p.scene.time
      end)
    end
  end
end

--- Checks everything and returns the job for trust.work. job.steps(changes): options of the run of each
-- level; changes replace options given by the script.
function refine.job(scene, given, check)
  local args = {}
  for key, value in pairs(given) do args[key] = value end
  local job = trust.job(scene, "scene:run", args)
  check(scene, args)
  if args.max_steps then
    error("scene:run: max_steps does not go with error bars, because finer levels need more steps", 0)
  end
  for _, q in ipairs(job.quantities) do
    if q.at and args.duration and q.at > args.duration then
      error(("scene:run: tolerance: quantity '%s': at = %g s is after the end of the run, %g s")
        :format(q.name, q.at, args.duration), 0)
    end
  end
  job.advice = method_of(args.integrator).implicit
    and "a smaller dt [s], more segments or a gentler motion may help"
    or "a dt [s] below scene:stable_dt() or an implicit integrator may help"
  function job.steps(changes)
    local own = {}
    for key, value in pairs(args) do own[key] = value end
    for key, value in pairs(changes or {}) do own[key] = value end
    return steps_of(job, own)
  end
  return job
end

--- Finds out whether the scene starts at rest, as each level then does too; leaves the scene unchanged.
function refine.look(job)
  job.rests = is_at_rest(job.scene)
  job.restore()
end

-- Returns why there is no equilibrium at the start, or nil.
local function unsettled(scene)
  local settled = unread.excused(scene.settle, scene)
  return not settled.ok and "no equilibrium to begin with: " .. settled.reason or nil
end

-- Makes the models of wires of level k and finds its start; returns why it cannot begin, or nil.
local function prepare(job, options, k, name)
  local _ <close> = working.prepares(options, job.scene, name)
  job.unmade = job.shape and job.shape(k)
  process.renew(job.scene, {}) -- settling must not start them
  local rests = job.rests and not options.quasistatic and not job.unmade
  return job.unmade or rests and unsettled(job.scene) or nil
end

--- Returns the function compute(k, name), which runs level k on the restored and remeshed scene; if that
-- cannot start, the result is a failed run. total: its wall and cpu are summed up. job.shape(k), if there is
-- one, makes other models of wires; it returns why it cannot, or nil, which is kept in job.unmade.
function refine.computer(job, steps, run_once, total)
  local scene = job.scene
  return function(k, name)
    local options = steps(k)
    job.moves = not options.quasistatic
    local hindrance = prepare(job, options, k, name)
    job.begin_processes()
    sample(job)
    local r = run_once(scene, options, name, hindrance)
    total.wall, total.cpu = total.wall + r.wall, total.cpu + r.cpu
    return r
  end
end

--- Returns the run of the finest level, with quantities.
function refine.run(job, run_once)
  local steps, total = job.steps(), { wall = 0, cpu = 0 }
  if not steps(1).quasistatic then
    function job.prepare() refine.look(job) end
  end
  local result = trust.once(job, refine.computer(job, steps, run_once, total))
  result.wall, result.cpu = total.wall, total.cpu
  return result
end

return refine
