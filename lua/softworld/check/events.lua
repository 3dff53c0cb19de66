-- SPDX-License-Identifier: GPL-3.0-or-later
--- Counts events of some kinds in a run.
-- @module softworld.check.events
local checks = require "softworld.checks"
local counted = require "softworld.output.number".count

--- Returns a function that counts events of these kinds (a text of words), with place and time of the first.
return function(kinds)
  local wanted = checks.set(kinds)
  return function(_, context)
    local v = { value = 0 }
    for _, e in ipairs(context.run.events) do
      if wanted[e.kind] then
        v.value = v.value + 1
        if v.value == 1 then v.s, v.time, v.note = e.s, e.first or e.time, e.text end
      end
    end
    local _, lost = context.scene:events()
    if lost > 0 then -- of any kind
      v.low, v.high = v.value, math.huge
      v.note = ("%s%s had no room in the record"):format(v.note and v.note .. "; " or "",
        counted(lost, "event"))
    end
    return v
  end
end
