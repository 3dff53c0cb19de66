-- SPDX-License-Identifier: GPL-3.0-or-later
--- Sidewall pressure of a wire drawn round something: tension over the bend radius, T/R, where it touches
-- [N/m]. With scene:run{ wear = true } it is the largest mean over the run's window. Otherwise it is the
-- largest stored in frames; the largest tension times the sharpest bend of each step, which may be at two
-- places, is an upper bound for the time between frames.
-- @module softworld.check.sidewall
local bendrule = require "softworld.wire.bendrule"
local build = require "softworld.scene.build"
local core = require "softworld.core"
local counted = require "softworld.output.number".count
local stored = require "softworld.check.stored"
local tension = require "softworld.check.tension"

-- Returns the largest product of both over the steps of the run [N/m].
local function bound(entry, start)
  local rows, count = entry.object:log(start)
  local most = 0
  for i = 0, count - 1 do
    if rows[3 * i + 1] >= start then most = math.max(most, rows[3 * i + 2] * rows[3 * i + 3]) end
  end
  return most
end

-- Returns T/R at a node that touches. On a round body, chords turn alternately too much and too little; if
-- the next node touches too, the mean of both counts.
local function pressure(values, k)
  local T, bent, touches = values.tension, values.curvature, values.contact
  if touches[k] <= 0 then return 0 end
  local here, next_touches = T[k] * bent[k], (touches[k + 1] or 0) > 0
  if next_touches then return (here + T[k + 1] * bent[k + 1]) / 2 end
  return (touches[k - 1] or 0) > 0 and 0 or here
end

local function value(entry, context)
  local best, data = { value = 0 }, build.data(context.scene)
  local kept, place, when = core.worn_sidewall(entry.object)
  if kept and kept > 0 then return { value = kept, s = place, time = when } end
  if kept then return #data.obstacles + #data.fixings > 0 and best or nil end
  local count = stored.each(context, entry, function(values, k, time, s)
    local now = pressure(values, k)
    if now > best.value then best = { value = now, s = s, time = time } end
  end)
  if best.value == 0 and #data.obstacles + #data.fixings == 0 then return nil end
  if not stored.whole(context, count) then
    best.low, best.high = best.value, math.max(best.value, bound(entry, context.run.start))
    best.note = ("of %s; at every step at most %.4g N/m"):format(counted(count or 0, "frame"),
      best.high)
  end
  return best
end

return { name = "max_sidewall", unit = "N/m", side = "max", peaks = true, on = "wire", edges = "both",
  label = "largest sidewall pressure T/R at contacts", missing = "allowed sidewall pressure",
  value = value,
  reference = function(entry)
    return tension.reference(entry) / (bendrule.table.fixed[1] * 2 * entry.object.radius)
  end }
