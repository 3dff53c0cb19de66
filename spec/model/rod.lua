-- SPDX-License-Identifier: GPL-3.0-or-later
--- The soft wire of the specs of chosen models.
local rod = { radius = 0.0025 } -- [m]

function rod.wire(scene, more)
  local args = { name = "w", E = 5e6, density = 1500, radius = rod.radius, from = { 0, 0, 0 },
    to = { 0.6, 0, 0 }, segments = 24, model = "auto" }
  for key, value in pairs(more or {}) do args[key] = value end
  return scene:wire(args)
end

return rod
