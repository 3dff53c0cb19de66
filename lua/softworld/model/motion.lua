-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of motion: a row of poses in equilibrium, or dynamics.
-- @module softworld.model.motion
local build = require "softworld.scene.build"
local core = require "softworld.core"
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local trust = require "softworld.run.trust"

local POSES = 4       -- steps between two poses, of those of a dynamic run [-]
local PERIODS = 10    -- of the first swing: a motion that lasts longer is slow [-]
local INERTIA = 0.1   -- of the tolerance: how much of the weight inertia may be [-]
local SAFETY = 3     -- coarse steps do not see all that swings [-]
local SMALL = 0.1    -- acceleration over weight of what hardly swings [-]
local TINY = 1e-9    -- of a time, or of 1 s: frames no further apart are one [-]
local COSTLY = 2     -- iterations of poses over those of steps, on the level where poses mostly end [-]
local ENDS = 3       -- that level [-]
local MANY = 30      -- iterations of a pose, of those which steps need some five each [-]
local usual_dt = 0.01 -- of a run that is told none [s]

local motion = { name = "motion", safety = SAFETY, instead = true, rough = true, by_state = true, rungs = {
  { name = "poses", as = "poses", leaves = "inertia: what swings, falls, strikes or jumps" },
  { name = "dynamic", as = "dynamics", leaves = "nothing" } } }

-- Largest speed of the wires [m/s].
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
  if context.args.quasistatic ~= nil then return end
  changes.quasistatic = rung == 1 or nil
  if rung == 1 then
    changes.dt = (context.args.dt or usual_dt) * POSES
    changes.each_frame = true
  end
end

-- First period of wire w about where it rests [s]; nil where it rests nowhere, or is joined to others and
-- not taken alone.
local function period_of(w, alone)
  local fine, list = pcall(w.object.frequencies, w.object, { modes = 1, alone = alone })
  return fine and list[1] and list.unstable == 0 and 1 / list[1] or nil
end

-- The longest first period of all wires [s]; nil where one of them has none.
local function period(scene)
  local longest
  for _, w in ipairs(build.data(scene).wires) do
    local own = period_of(w)
    if not own then return nil end
    longest = math.max(longest or 0, own)
  end
  return longest
end

-- The longest first period of those wires that have one while what they are joined to stays where it is [s]:
-- no more than that of all together, which nothing holds there (Rayleigh). 0: none has one.
local function period_alone(scene)
  local longest = 0
  for _, w in ipairs(build.data(scene).wires) do longest = math.max(longest, period_of(w, true) or 0) end
  return longest
end

-- A wire that lay on a table and is lifted swings more slowly than it did: the longest period also counts of
-- where the first poses end. Where the scene does not rest as it begins, that tells how it swings, not
-- whether motion is slow.
local function look_at_end(context)
  if context.period_of_end or speed(context.scene) > 0 then return end
  context.period_of_end = period(context.scene) or 0
  if not context.period and context.period_of_end == 0 then
    context.alone = math.max(context.alone or 0, period_alone(context.scene))
  end
  if context.period then context.period = math.max(context.period, context.period_of_end) end
end

-- First period of swings [s], where one is known; of wires that are joined less than that.
local function swing(context)
  local ends = context.period_of_end or 0
  local alone = context.alone or 0
  return context.period or ends > 0 and ends or alone > 0 and alone or nil
end

function motion.look(context, run)
  local scene = context.scene
  look_at_end(context)
  local _, _, acceleration, slower = facts.swept()
  return { jumps = run.jumps, lasts = run.time - run.start, acceleration = acceleration, slower = slower,
    weight = (scene:gravity()[1] ^ 2 + scene:gravity()[2] ^ 2 + scene:gravity()[3] ^ 2) ^ 0.5,
    period = context.period, swing = swing(context),
    dt = run.steps > 0 and (run.time - run.start) / run.steps or math.huge }
end

--- The first period, of the scene at rest as it begins, on the coarsest edges: what all modes of fine ones
-- take grows with their cube [s]. look_at_end may find a longer one.
function motion.begin(context)
  local job, scene = context.job, context.scene
  if not job.rests then return end
  core.remesh(scene, trust.counts(job, 1))
  local rests = scene:settle().ok
  context.period = rests and period(scene) or nil
  context.alone = rests and not context.period and period_alone(scene) or nil
  job.restore()
end

-- What the damping of tr-bdf2 leaves of a swing after a step of so much of its phase [rad]: the size of its
-- stability function (Bank et al., IEEE Trans. CAD 4, 1985).
local function kept(phase)
  local g = 2 - 2 ^ 0.5
  local up = (2 * (2 - g)) ^ 2 + ((1 + (1 - g) ^ 2) * phase) ^ 2
  local down = (2 * (2 - g) - g * (1 - g) * phase ^ 2) ^ 2 + ((2 - g ^ 2) * phase) ^ 2
  return (up / down) ^ 0.5
end

--- The share of a swing that the steps of a computation of dynamics show: what is left of it after half of
-- the first period, at the step next to its peak. All where it hardly speeds up.
function motion.shows(f)
  if f.acceleration and f.acceleration <= SMALL * f.weight then return 1 end
  local steps = f.swing and f.swing / f.dt or 0
  return steps > 2 and kept(2 * math.pi / steps) ^ (steps / 2) * math.cos(math.pi / steps) or 0
end

--- What the coarsest steps damp away: what rings after a jump, or where inertia counts.
function motion.blurred(poses, dynamics, share)
  local fast = dynamics.weight > 0 and (dynamics.acceleration or 0) > share * dynamics.weight
  return fast or poses.jumps > 0
end

-- Acceleration in the frames of the finest run over that in those of the coarsest, four times as far apart:
-- of what moves smoothly it is the same in frames twice as far apart, of a sudden start or stop half [-].
local function growth(f)
  return f.slower and f.slower > 0 and math.max(1, f.acceleration / f.slower) ^ 2 or 1
end

function motion.free(_, rung, f, share)
  if rung ~= 1 then return nil end
  if f.jumps > 0 then
    return nil, ("poses jump from one equilibrium to another, %d times"):format(f.jumps)
  end
  if not f.acceleration or not f.period or f.weight == 0 then return nil end
  local inertia, long = growth(f) * f.acceleration / f.weight, f.lasts / f.period
  if long < PERIODS or inertia > INERTIA * share then return nil end
  return ("the run lasts %.3g first periods of %s (slow from %d on), and inertia is at most %s of the weight "
    .. "(limit %s)"):format(long, number.text(f.period, "s"), PERIODS, facts.percent(inertia),
    facts.percent(INERTIA * share))
end

--- Why poses cannot go on being free, of what was seen of a run on the way; nil: nothing speaks against it.
function motion.broken(f, share)
  if f.jumps > 0 then return "poses jumped from one equilibrium to another" end
  local inertia = f.weight > 0 and f.acceleration and f.acceleration / f.weight or 0
  if inertia <= INERTIA * share then return nil end
  return ("inertia was %s of the weight (limit %s)"):format(facts.percent(inertia),
    facts.percent(INERTIA * share))
end

--- Dynamics from here on: wires go on with the speed with which they came.
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

--- Does a run of poses need so many iterations for each that it may cost more than one of dynamics?
function motion.toils(rung, run) return rung == 1 and run.iterations > MANY * run.steps end

--- Poses that need more iterations than steps do are no saving. Finer ones are nearer to each other and need
-- fewer each, which steps do not: from level k on dynamics take twice as many on each, poses hardly more, and
-- dynamics need a level more, as they ring. in_doubt: it is not known whether poses suffice; then they are no
-- saving already where they need as many.
function motion.costly(rung, here, above, k, in_doubt)
  local least = (in_doubt and 1 or COSTLY) * 2 ^ math.max(0, ENDS - k)
  if rung == 1 and here.iterations >= least * above.iterations then
    return ("poses cost more: %d iterations on a mesh on which dynamics take %d"):format(here.iterations,
      above.iterations)
  end
end

return motion
