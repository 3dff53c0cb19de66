-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of peaks that an event of the run doubts: such a row does not pass, because the true peak may be
-- larger. A value with an error bar is not doubted: its bar comes from other steps.
-- @module softworld.check.doubted
local doubted = {}

-- For each kind of event: what the row says, before the step to compare with; and true if it holds only for
-- the wire that the event names.
local kinds = {
  coarse = { "a step was too long for peaks" },
  threshold = { "an end nearly slips, or hardly: little decides its peaks", true },
  rebound = { "an end strikes again: little decides its peaks", true },
}

--- Returns why the row of an object may not pass, or nil.
-- @tparam table member of softworld.check.registry; peaks: true if its value is a peak of the motion
-- @tparam table value of the row
-- @tparam table entry { name =, object = }
-- @tparam table run
function doubted.why(member, value, entry, run)
  if not member.peaks or value.error then return nil end
  for _, e in ipairs(run.events) do
    local kind = kinds[e.kind]
    if kind and (not kind[2] or e.object == entry.name) then
      local dt = e.text:match "with dt = ([%d.e-]+) s"
      return ("%s (event '%s')%s"):format(kind[1], e.kind, dt and (": dt = %s s, or tolerance, would tell")
        :format(dt) or "")
    end
  end
end

return doubted
