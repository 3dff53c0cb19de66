-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires side by side on a table, for specs of handling.
local sw = require "softworld"

-- A table with wires side by side, 3 cm apart.
local function scene_with(count)
  local scene, wires = sw.scene{ name = "handling" }, {}
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  for i = 1, count do
    local y = 0.03 * (i - 1)
    wires[i] = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 16,
      from = { 0, y, 0.0025 }, to = { 0.4, y, 0.0025 } }
  end
  return scene, wires
end

local function column(run, name)
  local series = run:series()
  for _, c in ipairs(series.columns) do
    if c.name == name then return c.values, series.time end
  end
end

return { scene_with = scene_with, column = column }
