-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest pull on a wire in a clip in this run, over the clip's retention; also for a wire that came out in
-- the run. A wire that is pulled askew is peeled out by less than the retention: its share is known between
-- bounds.
-- @module softworld.check.retention_used
local askew = require "softworld.check.askew"

local HELD = 1 - 1e-9 -- largest share of a wire that is still held [-]
local NOTED = 1.05    -- upper bound over value from which the row says why [-]

-- Returns the upper bound of the share of a held wire: its pull over that at which it comes out. Under a
-- moment the wire's far end has passed the lips when its tilt is about 1, however small the pull is. A
-- wire that was pressed in askew is first turned back, with little tilt. Found with random pulls, see help
-- "check".
local function most(share, tilt)
  return math.min(HELD, math.max(1.4 * tilt, share + 0.4 * tilt) + math.min(0.05, 2 * tilt))
end

-- Bounds the share of a held wire.
local function bound(value, tilt)
  local high = most(value.value, tilt)
  if value.value <= 0 or high <= NOTED * value.value then return end
  value.low, value.high = value.value, high
  value.note = ("it is pulled askew (it rises by %.2g of the lips' inner flank within the clip) and comes "
    .. "out at less than %.4g of the retention"):format(tilt, math.min(1, value.value / high))
end

return { name = "retention_used", unit = "-", side = "max", peaks = true, on = "clip",
  label = "largest pull out of the clip, as a share of its retention",
    missing = "allowed share of the retention",
  value = function(entry, context)
    local clip, out = entry.object, entry.object.pulled_out
    local value = { value = clip:run_ratio() }
    if out and out.time > context.run.start then
      value.value = math.max(1, value.value, out.peak_force / clip.retention)
      local why = askew.why(clip, context.run)
      value.time = out.time
      value.note = ("'%s' came out%s"):format(out.wire.name, why and "; " .. why or "")
    elseif clip:state() ~= "seated" then
      return nil
    else
      bound(value, clip:tilt())
    end
    return value
  end,
  limit = function()
    return { value = HELD, from = "definition", source = "at its retention a clip lets go" }
  end,
  reference = function() return 1 end }
