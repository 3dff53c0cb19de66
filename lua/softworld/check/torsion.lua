-- SPDX-License-Identifier: GPL-3.0-or-later
--- Torsion per metre, M_t / GJ, of the stored frames. Nothing is kept of the steps between them, so a run
-- that is to pass needs a frame of each.
-- @module softworld.check.torsion
local stored = require "softworld.check.stored"

local function value(entry, context)
  local GJ, best = entry.object.beam.GJ, { value = 0 }
  if not (GJ and GJ > 0) then return nil end
  local count = stored.each(context, entry, function(values, k, time, s)
    local now = math.abs(values.twist_moment[k]) / GJ
    if now > best.value then best = { value = now, s = s, time = time } end
  end)
  if not stored.whole(context, count) then
    best.low, best.high = best.value, math.huge
    best.note = ("of %d frames, the steps between are not known: scene:run{ frame = } as short as a step")
      :format(count or 0)
  end
  return best
end

return { name = "max_torsion", unit = "rad/m", side = "max", on = "wire", asked = true,
  label = "largest torsion per metre", missing = "allowed torsion", value = value,
  reference = function(entry) return 0.1 / entry.object.radius end }
