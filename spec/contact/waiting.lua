-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shared by the specs of wires that wait at rest.
local waiting = { DT = 0.01 } -- step [s]

--- Advances a scene by so many steps; raises if that fails.
function waiting.steps(scene, count)
  local row = scene:advance({ dt = waiting.DT }, scene.time + count * waiting.DT)
  assert(row.ok, row.reason)
  return row
end

--- Returns the coordinates of all nodes of wires as one list [m].
function waiting.places(wires)
  local list = {}
  for _, wire in ipairs(wires) do
    for _, x in ipairs(wire:positions()) do list[#list + 1] = x end
  end
  return list
end

--- Returns a displacement by a vector [m] within a time [s], for hold:follow and obstacle:follow.
function waiting.lever(point, duration)
  return { relative = true, duration = duration, points = { { 0, 0, 0 }, point } }
end

return waiting
