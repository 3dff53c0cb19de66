-- SPDX-License-Identifier: GPL-3.0-or-later
-- Steps of given lengths with their forces, for specs of windows.
package.path = "./?.lua;" .. package.path
local core = require "softworld.core"

-- Returns steps of these lengths, one after another, with the force f at each one's middle.
local function steps(lengths, f)
  local list, time = {}, 0
  for i, h in ipairs(lengths) do
    list[i] = { t0 = time, t1 = time + h, f(time + 0.5 * h), 0, 0 }
    time = time + h
  end
  return list
end

-- Returns equal step lengths h that fill the duration.
local function even(h, duration)
  local list = {}
  for i = 1, math.floor(duration / h + 0.5) do list[i] = h end
  return list
end

-- Returns the peak of such steps over windows of this width [s].
local function peak(list, width)
  local flat = {}
  for _, step in ipairs(list) do
    table.move({ step.t0, step.t1, step[1], step[2], step[3] }, 1, 5, #flat + 1, flat)
  end
  return core.peak(flat, width)
end

return { steps = steps, even = even, peak = peak }
