-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads values at a wire's nodes from the stored frames. Values between two frames are missing; a check that
-- uses them says so.
-- @module softworld.check.stored
local build = require "softworld.scene.build"

local stored = {}

-- Returns the arc length of node k, with equal edges.
local function place(wire, k, count) return count > 1 and wire.length * (k - 1) / (count - 1) or 0 end

--- Calls look(values, k, time, s) at every node k of every frame of the run. Returns the number of frames
-- without the one at its start; nil if wires were removed, because frames cannot tell wires apart then.
function stored.each(context, entry, look)
  local scene, run = context.scene, context.run
  if #(build.data(scene).gone or {}) > 0 then return nil end
  local count = 0
  for i = 1, scene:frame_count() do
    local frame = scene:frame(i)
    local values = frame.values[entry.number]
    if values and frame.t >= run.start then
      if frame.t > run.start then count = count + 1 end
      for k = 1, #values.tension do look(values, k, frame.t, place(entry.object, k, #values.tension)) end
    end
  end
  return count
end

--- True if the frames contain every step.
function stored.whole(context, count) return count ~= nil and count >= context.run.steps end

return stored
