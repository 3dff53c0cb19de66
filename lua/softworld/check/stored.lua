-- SPDX-License-Identifier: GPL-3.0-or-later
--- Values of a wire at its nodes, of the stored frames. What passes between two of them is not there: whoever
-- judges by them says so.
-- @module softworld.check.stored
local build = require "softworld.scene.build"

local stored = {}

-- Arc lengths of the nodes, in equal parts of the wire as it is; nil where the mesh is uneven.
local function place(wire, k, count) return count > 1 and wire.length * (k - 1) / (count - 1) or 0 end

--- Call look(values, k, time, s) at every node k of every frame of the run. Returns how many frames of steps
-- there are, without that of its begin; nil where they cannot be told apart: wires were taken away.
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

--- Do the frames have every step?
function stored.whole(context, count) return count ~= nil and count >= context.run.steps end

return stored
