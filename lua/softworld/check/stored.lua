-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads values at a wire's nodes from the stored frames. Values between two frames are missing; a check that
-- uses them says so.
-- @module softworld.check.stored
local build = require "softworld.scene.build"

local stored = {}

-- Returns the arc lengths of a frame's nodes [m]: those of the wire, now; if its nodes have changed since,
-- those of the line through the frame's nodes. Nodes need not be equally far apart.
local function places_of(x, now)
  if #x == 3 * #now then return now end
  local list = { 0 }
  for k = 4, #x, 3 do
    local way = math.sqrt((x[k] - x[k - 3]) ^ 2 + (x[k + 1] - x[k - 2]) ^ 2 + (x[k + 2] - x[k - 1]) ^ 2)
    list[#list + 1] = list[#list] + way
  end
  return list
end

--- Calls look(values, k, time, s) at every node k of every frame of the run. Returns the number of frames
-- without the one at its start; nil if wires were removed, because frames cannot tell wires apart then.
function stored.each(context, entry, look)
  local scene, run = context.scene, context.run
  if #(build.data(scene).gone or {}) > 0 then return nil end
  local count = 0
  local _, now = entry.object:positions()
  for i = 1, scene:frame_count() do
    local frame = scene:frame(i)
    local values = frame.values[entry.number]
    if values and frame.t >= run.start then
      if frame.t > run.start then count = count + 1 end
      local s = places_of(frame.wires[entry.number], now)
      for k = 1, #values.tension do look(values, k, frame.t, s[k]) end
    end
  end
  return count
end

--- True if the frames contain every step.
function stored.whole(context, count) return count ~= nil and count >= context.run.steps end

return stored
