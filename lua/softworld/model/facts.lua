-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads from a computation what the choices of a model need: whether obstacles rub, how near wires come to
-- each other, how they accelerate.
-- @module softworld.model.facts
local build = require "softworld.scene.build"
local core = require "softworld.core"
local quantity = require "softworld.quantity"

local facts = {}

--- Returns a share as text.
function facts.percent(share) return ("%.2g %%"):format(100 * share) end

--- Returns points of each wire that exists [m].
function facts.shape(scene)
  local list = {}
  for _, w in ipairs(build.data(scene).wires) do
    if core.exists(w.object) then list[#list + 1] = quantity.known.wire.position.of(w.object) end
  end
  return list
end

-- True if an obstacle pressed on something from a time on [s].
local function has_pressed(obstacle, from)
  local rows, count = obstacle:log(from)
  for i = 0, count - 1 do
    local pressed = rows[5 * i + 2] ~= 0 or rows[5 * i + 3] ~= 0 or rows[5 * i + 4] ~= 0
    if pressed and rows[5 * i + 1] >= from then return true end
  end
  return false
end

--- Returns the names of obstacles with friction that pressed on something in the run. seen: nil; or a table
-- for a run that is looked at several times while it goes on: what earlier looks found.
function facts.rubbing(scene, start, seen)
  local names = {}
  for _, o in ipairs(build.data(scene).obstacles) do
    local from = seen and seen[o.object] or start -- true: it has pressed
    local rubs = o.object:get().friction > 0 and (from == true or has_pressed(o.object, from))
    if rubs then names[#names + 1] = o.name end
    if seen then seen[o.object] = rubs or scene.time end
  end
  return names
end

local kept -- the run being read: scene, start [s], numbers of frames, and what wires swept

--- Calls f(...) with the frames of a run available to the functions below.
function facts.reading(scene, start, f, ...)
  kept = { scene = scene, start = start, numbers = {} }
  for i, t in ipairs(core.frame_times(scene)) do
    if t >= start then kept.numbers[#kept.numbers + 1] = i end
  end
  local fine, result, more = pcall(f, ...)
  kept = nil
  if not fine then error(result, 0) end
  return result, more
end

--- Calls look(forces, spacing, number) for each frame in which something presses on wire w, in order: forces
-- at its nodes [N], distance of the first two nodes [m], number of the frame.
function facts.touched(w, look)
  for _, number in ipairs(kept.numbers) do
    local forces, spacing = core.frame_contact(kept.scene, number, w)
    if forces then look(forces, spacing, number) end
  end
end

--- Returns what presses on line w in these frames, rows of five: see core.frames_press.
function facts.press(w, place, but)
  return core.frames_press(kept.scene, w, kept.start, place, but)
end

--- Returns the swept boxes of the wires { x1, y1, z1, x2, y2, z2, step = how far points move between frames }
-- [m]; the largest angle by which a wire turns along its length [rad]; the largest acceleration in the frames
-- by second differences, and the same with every second frame [m/s2]; these are nil with fewer than three and
-- five frames.
function facts.swept()
  if not kept.boxes then
    kept.boxes, kept.turning = {}, 0
    for w = 1, #kept.numbers > 0 and #build.data(kept.scene).wires or 0 do
      local box, turning, acceleration, slower = core.frames_sweep(kept.scene, w, kept.start)
      kept.boxes[w], kept.turning = box, math.max(kept.turning, turning)
      if acceleration then kept.acceleration = math.max(kept.acceleration or 0, acceleration) end
      if slower then kept.slower = math.max(kept.slower or 0, slower) end
    end
  end
  return kept.boxes, kept.turning, kept.acceleration, kept.slower
end

--- Returns the least distance of the axes of wires v and w, or of one wire to itself beyond half a turn [m],
-- reduced by the motion between frames. Joined places do not count. The search ends at a distance of `enough`
-- or less, and skips distances above `most`.
function facts.apart(v, w, enough, most)
  return core.frames_apart(kept.scene, v, w, kept.start, enough, most)
end

--- Same in the last frame, without motion; `most` if they are not nearer. straight: between the edges
-- themselves, as touches see them; else also without the bow of the wires beside them.
function facts.apart_at_end(v, w, most, straight)
  local times = core.frame_times(kept.scene)
  return core.frames_apart(kept.scene, v, w, times[#times], 0, most, straight)
end

--- True if wire w stays in a plane, with everything that pushes and turns it.
function facts.flat(w) return core.frames_flat(kept.scene, w, kept.start) end

--- Returns how much the lever of friction along wire w changes its tension: 0 to 1 [-].
function facts.lever(w) return core.frames_lever(kept.scene, w, kept.start) end

return facts
