-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest pull on a wire in a clip in this run, over the clip's retention; also for a wire that came out in
-- the run.
-- @module softworld.check.retention_used
return { name = "retention_used", unit = "-", side = "max", peaks = true, on = "clip",
  label = "largest pull out of the clip, as a share of its retention",
    missing = "allowed share of the retention",
  value = function(entry, context)
    local clip, out = entry.object, entry.object.pulled_out
    local value = { value = clip:run_ratio() }
    if out and out.time > context.run.start then
      value.value = math.max(1, value.value, out.peak_force / clip.retention)
      value.time, value.note = out.time, ("'%s' came out"):format(out.wire.name)
    elseif clip:state() ~= "seated" then
      return nil
    end
    return value
  end,
  limit = function()
    return { value = 1 - 1e-9, from = "definition", source = "at its retention a clip lets go" }
  end,
  reference = function() return 1 end }
