-- SPDX-License-Identifier: GPL-3.0-or-later
--- Torsion per metre, M_t / GJ: the largest of all steps. For a mesh of particles, the largest of the stored
-- frames; nothing is known of the steps between, so a run can pass only with a frame of each step.
-- @module softworld.check.torsion
local stored = require "softworld.check.stored"
local worn = require "softworld.check.worn"

local LINE = { rod = true, string = true } -- models that keep the largest torsion of all steps

local function of_frames(entry, context, GJ)
  local best = { value = 0 }
  local count = stored.each(context, entry, function(values, k, time, s)
    local now = math.abs(values.twist_moment[k]) / GJ
    if now > best.value then best = { value = now, s = s, time = time } end
  end)
  if stored.whole(context, count) then return best end
  return worn.at_least(best, ("of %d frames, without the steps between them: scene:run{ frame = } as short "
    .. "as a step"):format(count or 0))
end

local function value(entry, context)
  local GJ = entry.object.beam.GJ
  if not (GJ and GJ > 0) then return nil end
  if not LINE[entry.object.model] then return of_frames(entry, context, GJ) end
  local torsion, s, time = entry.object:max_torsion()
  return { value = torsion, s = s, time = time }
end

return { name = "max_torsion", unit = "rad/m", side = "max", on = "wire", asked = true,
  label = "largest torsion per metre", missing = "allowed torsion", value = value,
  reference = function(entry) return 0.1 / entry.object.radius end }
