-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of motion: a sequence of equilibrium poses, or dynamics.
-- @module softworld.model.motion
local build = require "softworld.scene.build"
local coarsest = require "softworld.run.coarsest"
local core = require "softworld.core"
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local quantity = require "softworld.quantity"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"

local POSES = 4       -- time between two poses over the step of a dynamic run [-]
local PERIODS = 10    -- motions of at least this many first periods are slow [-]
local INERTIA = 0.1   -- largest inertia over weight or forces, over the tolerance, that poses may omit [-]
local SAFETY = 3     -- on changes: coarse steps do not show all of a swing [-]
local SMALL = 0.1    -- acceleration over weight below which wires hardly swing [-]
local GROWN = 2      -- acceleration over an earlier one up to which inertia acts as it did [-]
local TINY = 1e-9    -- over the time, or 1 s: frames this near count as one [-]
local COSTLY = 2     -- iterations of poses over those of dynamics, on level ENDS, that are no saving [-]
local ENDS = 3       -- level on which poses mostly end [-]
local MANY = 30      -- iterations per pose above which costs are compared; a step needs about five [-]
local usual_dt = 0.01 -- step of a run if none is given [s]

local motion = { name = "motion", safety = SAFETY, instead = true, rough = true, by_state = true, rungs = {
  { name = "poses", as = "poses", leaves = "inertia: what swings, falls, strikes or jumps" },
  { name = "dynamic", as = "dynamics", leaves = "nothing" } } }

-- Returns the largest speed component of the wires [m/s].
local function speed(scene)
  local most = 0
  for _, w in ipairs(build.data(scene).wires) do
    for _, v in ipairs(w.object:velocities()) do most = math.max(most, math.abs(v)) end
  end
  return most
end

function motion.given(context)
  if context.args.quasistatic ~= nil then
    return "as the script says, quasistatic = " .. tostring(context.args.quasistatic),
      context.args.quasistatic and 1 or 2
  end
  if context.args.integrator then return "as the script says, integrator = " .. context.args.integrator, 2 end
  local v = speed(context.scene)
  if v > 0 then return ("the scene begins in motion, at %s"):format(number.text(v, "m/s")), 2 end
end

function motion.apply(context, rung, changes)
  changes.unsettled = false -- another model is taken instead
  if context.args.quasistatic ~= nil then return end
  changes.quasistatic = rung == 1 or nil
  if rung == 1 then
    changes.dt = (context.args.dt or usual_dt) * POSES
    changes.each_frame = true
  end
end

--- Widens the steps of dynamics: the longest step is that of poses, and the error of a step is that of steps
-- longer by the same factor. Third-order errors grow with its cube.
function motion.widen(options)
  options.dt = options.dt * POSES
  options.tolerance = options.tolerance and options.tolerance * POSES ^ 3
end

-- Returns the first period of wire w about its rest position [s]; nil if it has none, or if it is joined to
-- others and `alone` is not set.
local function period_of(w, alone)
  local fine, list = pcall(w.object.frequencies, w.object, { modes = 1, alone = alone })
  return fine and list[1] and list.unstable == 0 and 1 / list[1] or nil
end

-- Returns the longest first period of all wires [s]; nil if one of them has none.
local function period(scene)
  local longest
  for _, w in ipairs(build.data(scene).wires) do
    local own = period_of(w)
    if not own then return nil end
    longest = math.max(longest or 0, own)
  end
  return longest
end

-- Returns the longest first period of single wires with everything they are joined to held fixed [s]. It is a
-- lower bound on the period of all together, which is not held there (Rayleigh). 0: no wire has one.
local function period_alone(scene)
  local longest = 0
  for _, w in ipairs(build.data(scene).wires) do longest = math.max(longest, period_of(w, true) or 0) end
  return longest
end

-- True if a wire has no period even with all it is joined to held fixed.
local function lacks_period(scene)
  for _, w in ipairs(build.data(scene).wires) do
    if not period_of(w, true) then return true end
  end
  return false
end

-- Takes the longest period at the end of the first poses into account: a wire that is lifted off a table
-- swings more slowly than it did there. If the scene is not at rest at its start, this tells how it swings,
-- but not whether the motion is slow.
local function look_at_end(context)
  if context.period_of_end or speed(context.scene) > 0 then return end
  context.period_of_end = period(context.scene) or 0
  if not context.period and context.period_of_end == 0 then
    context.alone = math.max(context.alone or 0, period_alone(context.scene))
  end
  if context.period then context.period = math.max(context.period, context.period_of_end) end
end

-- Returns the first period of swings [s], if known; for joined wires a lower bound.
local function swing(context)
  local ends = context.period_of_end or 0
  local alone = context.alone or 0
  return context.period or ends > 0 and ends or alone > 0 and alone or nil
end

-- Returns the mean step in the part of length `span` in which a run took most steps [s]. While wires swing
-- after a snap, steps are shortened, because their error is limited. nil: not known.
local function shortest_mean(context, run, span)
  local most, w = 0, context.data.wires[1]
  if not span or not core.exists(w.object) then return nil end
  local rows, count = w.object:log(run.start)
  local first = 0
  for i = 1, count - 1 do
    while rows[3 * i + 1] - rows[3 * first + 1] > span do first = first + 1 end
    most = math.max(most, i - first)
  end
  return most > 0 and span / most or nil
end

-- Returns the mass of all wires [kg] and the length of the longest one [m].
local function mass_of(scene)
  local mass, longest = 0, 0
  for _, w in ipairs(build.data(scene).wires) do
    if core.exists(w.object) then
      mass = mass + w.object:get().mass_per_length * w.object.length
      longest = math.max(longest, w.object.length)
    end
  end
  return mass, longest
end

-- Returns the acceleration that inertia is compared with: of weight; without weight, the one at which all
-- wires together would push as much as the least of the forces and moments asked for [m/s2]. nil: there is no
-- such force. How inertia changes places, bends, peaks or own quantities is not known without weight.
local function reference(context, weight)
  if weight > 0 then return weight end
  local least, mass, length = math.huge, mass_of(context.scene)
  for _, q in ipairs(context.job.quantities) do
    local lever = q.unit == "N" and 1 or q.unit == "N m" and length or nil
    local value = context.finest and context.finest.values[q.name]
    if q.own or q.row or q.plain or not lever or value == nil then return nil end
    local push = quantity.size(value) / (lever * mass)
    local pushes = push > 0 -- false for NaN
    if not pushes then return nil end
    least = math.min(least, push)
  end
  return least < math.huge and least or nil
end

-- Returns what inertia is compared with, as text.
local function base(f) return f.weight > 0 and "the weight" or "the forces asked for" end

-- Returns the number of jumps from pose to pose. A jump in the first pose alone does not count if the scene
-- rests at its start: on the edges of a level, cut from those of the script, it does not rest yet.
local function jumps_of(context, run)
  local first = run.start + 1.5 * (run.time - run.start) / math.max(1, run.steps)
  local alone = run.jumps == 1 and context.job.rests and (run.last_jump or math.huge) <= first
  return alone and 0 or run.jumps
end

--- True if poses now, with other rungs of other choices, act as they did before: none jumps, and inertia has
-- not grown much.
function motion.alike(before, now)
  if before.jumps + now.jumps > 0 then return false end
  return (now.acceleration or math.huge) <= GROWN * (before.acceleration or 0)
end

--- True if poses jump, and what dynamics change of a peak grows much as edges get shorter. Coarse edges snap
-- into a clip more softly: the change of a bend was 0.015, 0.10 and 1.6 of what is allowed on three levels.
-- grows: true if a peak is asked for and the change grows.
function motion.doubtful(f, _, grows) return grows and f.jumps > 0 end

--- True if poses need so many iterations each that they may cost more than dynamics.
function motion.toils(rung, run) return rung == 1 and run.iterations > MANY * run.steps end

-- True if poses may have jumped only because edges are too long for a bend: round a peg a wire then moves
-- edge by edge. A jump that needs many iterations leads farther.
local function is_coarse(run)
  if motion.toils(1, run) then return false end
  for _, e in ipairs(run.events) do
    if e.kind == "edges" then return true end
  end
  return false
end

function motion.look(context, run)
  local scene = context.scene
  look_at_end(context)
  local _, _, acceleration, slower = facts.swept()
  local gravity = quantity.size(scene:gravity())
  return { jumps = jumps_of(context, run), lasts = run.time - run.start,
    coarse = not context.watching and is_coarse(run),
    acceleration = acceleration, slower = slower, weight = gravity, against = reference(context, gravity),
    period = context.period, swing = swing(context),
    dt = run.steps > 0 and (run.time - run.start) / run.steps or math.huge,
    shortest = not context.watching and shortest_mean(context, run, swing(context)) or nil }
end

--- Finds the first period of the scene at rest at its start [s]. It takes the coarsest edges, because the
-- cost of all modes grows with the cube of their number. look_at_end may find a longer period. Edges on which
-- a scene at rest has no equilibrium are too coarse for any model. On edges about as long as the radius of
-- what a wire lies on, it hardly rests and no modes are found; then edges of half the length tell the period.
function motion.begin(context)
  local job, scene = context.job, context.scene
  if not job.rests then return end
  core.remesh(scene, trust.counts(job, 1))
  local rests = unread.excused(scene.settle, scene).ok
  if not rests and coarsest.finer(job) then
    job.restore()
    return motion.begin(context)
  end
  context.period = rests and period(scene) or nil
  if rests and not context.period and lacks_period(scene) then
    job.restore()
    core.remesh(scene, trust.counts(job, 2))
    context.period = unread.excused(scene.settle, scene).ok and period(scene) or nil
  end
  context.alone = rests and not context.period and period_alone(scene) or nil
  job.restore()
end

-- Returns the share of a swing that the damping of tr-bdf2 leaves after a step of this phase [rad]: the
-- magnitude of its stability function (Bank et al., IEEE Trans. CAD 4, 1985).
local function kept(phase)
  local g = 2 - 2 ^ 0.5
  local up = (2 * (2 - g)) ^ 2 + ((1 + (1 - g) ^ 2) * phase) ^ 2
  local down = (2 * (2 - g) - g * (1 - g) * phase ^ 2) ^ 2 + ((2 - g ^ 2) * phase) ^ 2
  return (up / down) ^ 0.5
end

--- Returns the share of a swing that the steps of a dynamic computation show: what is left of it after half
-- of the first period, at the step next to its peak. 1 if the wires hardly accelerate. snaps: the swing
-- follows a snap; then its own steps count, not those of the whole run.
function motion.shows(f, snaps)
  if f.acceleration and f.acceleration <= SMALL * f.weight then return 1 end
  local dt = snaps and f.shortest or f.dt
  local steps = f.swing and f.swing / dt or 0
  return steps > 2 and kept(2 * math.pi / steps) ^ (steps / 2) * math.cos(math.pi / steps) or 0
end

--- True if the coarsest steps damp something away: ringing after a jump, or motion in which inertia counts.
function motion.blurred(poses, dynamics, share)
  local fast = dynamics.weight > 0 and (dynamics.acceleration or 0) > share * dynamics.weight
  return fast or poses.jumps > 0
end

-- Returns the factor by which the acceleration grows from the coarsest run's frames to the finest run's,
-- which are four times as dense [-]. Doubling the density leaves that of smooth motion unchanged and doubles
-- that of a sudden start or stop. So the ratio measured against every second frame is squared.
local function growth(f)
  return f.slower and f.slower > 0 and math.max(1, f.acceleration / f.slower) ^ 2 or 1
end

function motion.free(context, rung, f, share)
  if rung ~= 1 then return nil end
  if f.jumps > 0 then
    return nil, ("poses jump from one equilibrium to another, %s"):format(number.count(f.jumps, "time"))
  end
  local against = reference(context, f.weight) -- now known even if f is of the first run
  if not f.acceleration or not f.period or not against then return nil end
  local inertia, long = growth(f) * f.acceleration / against, f.lasts / f.period
  if long < PERIODS or inertia > INERTIA * share then return nil end
  local count = (long < 1000 and "%.3g" or "%.0f"):format(long)
  return ("the run lasts %s first periods of %s (slow from %d on), and inertia is at most %s of %s "
    .. "(limit %s)"):format(count, number.text(f.period, "s"), PERIODS, facts.percent(inertia), base(f),
    facts.percent(INERTIA * share))
end

--- True if the free check of poses is worth a second look, at poses of finer edges: it failed by jumps on
-- edges too long for a bend, or by inertia that only successive poses show. Such edges cause both where a
-- wire is drawn over something round. The finer poses belong to the run anyway, unless dynamics are chosen.
function motion.again(context, rung, f, share)
  local against = reference(context, f.weight)
  if rung ~= 1 or not f.period or not against or f.lasts < PERIODS * f.period then return false end
  if f.jumps > 0 then return f.coarse end
  return (f.slower or math.huge) <= INERTIA * share * against
end

--- Returns why the free check of poses no longer holds, by what the run showed so far; nil: it holds.
function motion.broken(f, share)
  if f.jumps > 0 then return "poses jumped from one equilibrium to another" end
  local inertia = f.against and f.acceleration and f.acceleration / f.against or 0
  if inertia <= INERTIA * share then return nil end
  return ("inertia was %s of %s (limit %s)"):format(facts.percent(inertia), base(f),
    facts.percent(INERTIA * share))
end

--- Switches to dynamics from here on; wires keep the speed of the last poses.
function motion.onward(context, options)
  local scene = context.scene
  options.quasistatic, options.dt = nil, options.dt / POSES
  for i = scene:frame_count(), 1, -1 do
    local frame = scene:frame(i)
    if frame.t < scene.time - TINY * math.max(1, scene.time) then
      for k, w in ipairs(build.data(scene).wires) do
        core.came_from(w.object, frame.wires[k], scene.time - frame.t)
      end
      return
    end
  end
end

--- Returns a sentence if poses cost no less than dynamics. On finer levels poses are nearer to each other and
-- need fewer iterations each, unlike steps: from level to level dynamics take twice as many, poses hardly
-- more, and dynamics need one level more because they ring. in_doubt: if it is not known whether poses
-- suffice, they are no saving as soon as they need as many iterations.
function motion.costly(rung, here, above, k, in_doubt)
  local least = (in_doubt and 1 or COSTLY) * 2 ^ math.max(0, ENDS - k)
  if rung == 1 and here.iterations >= least * above.iterations then
    return ("poses cost more: %s on a mesh on which dynamics take %d"):format(
      number.count(here.iterations, "iteration"), above.iterations)
  end
end

return motion
