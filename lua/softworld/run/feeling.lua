-- SPDX-License-Identifier: GPL-3.0-or-later
--- The force that a process waits for, as a sensor feels it: where steps are shorter than the sensor's time,
-- it is their mean. A hold that starts at once drives a stiff cable with a force that has no exact value: it
-- grows as steps get shorter, to a hundred newtons for half a microsecond. Of an obstacle the sensor feels
-- blows in all parts of a step.
-- @module softworld.run.feeling
local core = require "softworld.core"
local number = require "softworld.output.number"
local vec = require "softworld.vec"

local feeling = {}

local SENSE = 1e-3 -- time of the mean [s]
local FAR = 1.1 -- a force above this share of the one that was waited for is told [-]

-- Returns the mean over the sensor's time; before the first step the force was that of the first look.
local function mean_of(seen, first)
  local left, sum = SENSE, { 0, 0, 0 }
  for i = #seen, 1, -1 do
    local part = math.min(left, seen[i].h)
    sum, left = vec.add(sum, vec.scale(seen[i].f, part)), left - part
  end
  return vec.scale(vec.add(sum, vec.scale(first, left)), 1 / SENSE)
end

-- Forgets steps that ended before the sensor's time.
local function forget(seen)
  local time = 0
  for i = #seen, 1, -1 do
    if time >= SENSE then table.remove(seen, i) else time = time + seen[i].h end
  end
end

--- Returns a function that looks at the force of an object and returns what a sensor feels [N], and a table
-- of the last looks: .before, .now [N] and .step, the time between them [s].
function feeling.of(object, scene)
  local seen, first, start, time = {}, nil, nil, nil
  local told = {}
  local blows = core.type(object) == "obstacle"
  local function look()
    local f, now = object:force(), scene.time
    if not time or now < time or (now == time and #seen == 0) then
      seen, first, start, time = {}, f, now, now
      return vec.norm(f)
    end
    if now > time then
      told.before = told.now
      seen[#seen + 1], time, told.step = { h = now - time }, now, now - time
      forget(seen)
    end
    local last = seen[#seen]
    last.f = f -- another process may have gone on at this time
    if blows then
      local from = math.max(start, now - last.h - SENSE)
      last.blow = last.blow or object:over(from, now, { window = SENSE }).peak_force
      return last.blow
    end
    return vec.norm(last.h < SENSE and mean_of(seen, first) or f)
  end
  return function()
    told.now = look()
    return told.now
  end, told
end

--- Tells that the force rose far beyond the wanted one within the last step before the process went on.
function feeling.tell(p, wanted)
  local last, on = wanted.last, wanted.on
  if not last.before or wanted.force <= 0 then return end
  local force = math.max(last.now, vec.norm(on:force()))
  if force <= FAR * wanted.force then return end
  p.scene:tell{ kind = "late", object = on.name, value = force, text = ("the force of '%s' rose from %s to "
    .. "%s within a step of %s: process %d went on with it, not with %s. Take a shorter dt or a lower speed")
    :format(tostring(on.name), number.text(last.before, "N"), number.text(force, "N"),
      number.text(last.step, "s"), p.number, number.text(wanted.force, "N")) }
end

return feeling
