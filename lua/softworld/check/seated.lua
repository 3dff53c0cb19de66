-- SPDX-License-Identifier: GPL-3.0-or-later
--- Whether a wire is in the clip's seat at the end of the run: 1 if so.
-- @module softworld.check.seated
local askew = require "softworld.check.askew"

return { name = "seated", unit = "-", side = "min", on = "clip", label = "wire in the seat at the end",
  missing = "wanted state",
  value = function(entry, context)
    local clip = entry.object
    local state = clip:state()
    local into = clip.inserted
    local now = into and into.time > context.run.start
    return { value = state == "seated" and 1 or 0, time = context.run.time, s = into and into.s or nil,
      note = state ~= "seated" and ("it is %s"):format(state) or nil,
      doubt = now and askew.why(clip, context.run) or nil }
  end,
  limit = function()
    return { value = 1, from = "definition", source = "a clip is there to hold a wire" }
  end,
  reference = function() return 1 end }
