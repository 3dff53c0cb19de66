-- SPDX-License-Identifier: GPL-3.0-or-later
--- The touch that a process waits for. The process goes on at the end of the step in which it begins. Where a
-- hold or the obstacle pushes a stiff wire, the force rises until then, and depends on the step.
-- @module softworld.run.touching
local build = require "softworld.scene.build"
local core = require "softworld.core"
local number = require "softworld.output.number"
local vec = require "softworld.vec"

local touching = {}

local TOUCH = 1e-12 -- smaller forces are the rounding that a touch leaves [N]
local SENSE = 1e-3 -- time over which the force that is told is a mean [s]
local BLOW = 2 -- a blow has at most this share of the momentum before it [-]
local WEIGHTS = 10 -- smaller forces are left out; of all wires [-]
local G = 9.81 -- [m/s2]

-- Returns the mass of all that can touch [kg].
local function mass_of(scene)
  local mass = 0
  for _, entry in ipairs(build.data(scene).wires) do
    local wire = entry.object
    if core.exists(wire) and wire.present then
      mass = mass + wire.beam.mass_per_length * wire.length
    end
  end
  for _, entry in ipairs(build.data(scene).particles) do
    local object = entry.object
    if core.exists(object) and object.present then mass = mass + object.mass end
  end
  return mass
end

--- Returns a function that tells whether something touches the obstacle, or has touched it since the last
-- look, and what touching.tell needs.
function touching.of(obstacle, scene)
  local seen = { obstacle = obstacle }
  return function()
    local force, now = vec.norm(obstacle:force()), scene.time -- of the last part of a step that was divided
    local most = force
    if seen.now and now > seen.now then
      most = math.max(most, obstacle:over(seen.now, now).raw_peak_force)
      seen.before, seen.kinetic, seen.place = seen.now, seen.next_kinetic, seen.next_place
    end
    seen.now, seen.force = now, force
    seen.next_kinetic, seen.next_place = scene:energy().kinetic, obstacle:pose()
    return most > TOUCH
  end, seen
end

--- Tells that the force rose far within the step before the process went on. A wire that only strikes the
-- obstacle gives it no more than its momentum.
function touching.tell(p, seen)
  if not seen.before then return end
  local h, mass = seen.now - seen.before, mass_of(p.scene)
  local momentum = (2 * mass * seen.kinetic) ^ 0.5 + mass * vec.norm(vec.sub(seen.next_place, seen.place)) / h
  local least = BLOW * momentum / h + WEIGHTS * mass * G
  local last = seen.obstacle:over(seen.before, seen.now, { window = SENSE })
  if last.impulse_size / h <= least or seen.force <= least then return end
  local force = math.max(seen.force, last.peak_force)
  p.scene:tell{ kind = "late", object = seen.obstacle.name, value = force, text = ("the touch of '%s' that "
    .. "process %d waited for began within a step of %s, and its force rose to %s before the process went on "
    .. "at the step's end. Take a shorter dt or a lower speed"):format(seen.obstacle.name, p.number,
    number.text(h, "s"), number.text(force, "N")) }
end

return touching
