-- SPDX-License-Identifier: GPL-3.0-or-later
--- Events after which the forces of a run are wrong, or a wire is lost: crashes, holds driven against
-- anything, sections folded through themselves, tubes pressed flat, wires pulled beyond their load or out
-- of their pads, or crushed there, ties and clips that broke or left the range of their model.
-- @module softworld.check.spoilt
local count = require "softworld.check.events"

local of_run = count "crash overload breaking walls tie clip"
local of_gripper = { slip = "slips", lost = "is lost", crushed = "is crushed" }

local function value(_, context)
  local v = of_run(nil, context)
  local run = context.run
  for _, g in ipairs(context.grippers) do
    for _, e in ipairs(g.object.events) do
      local inside = e.time > run.start and e.time <= run.time -- a slip may end the run before
      if inside and of_gripper[e.kind] then
        v.value = v.value + 1
        if not v.time or e.time < v.time then
          v.s, v.time, v.note = e.s, e.time, ("gripper '%s': the wire %s"):format(g.name, of_gripper[e.kind])
        end
      end
    end
  end
  for _, w in ipairs(context.wires) do
    local s, time = w.object:folded()
    if s then
      v.value = v.value + 1
      v.note = v.note or ("wire '%s': a section has folded through itself"):format(w.name)
      v.s, v.time = v.s or s, v.time or time
    end
  end
  if v.low then v.low = v.value end
  return v
end

return { name = "events", unit = "-", side = "max", on = "run", label = "crashes, overloads, slips, losses",
  missing = "allowed events", value = value,
  limit = function() return { value = 0, from = "definition", source = "forces are wrong after such an "
    .. "event" } end }
