-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire in a clamp, for specs of callbacks.
local sw = require "softworld"

local function make(options)
  local scene = sw.scene(options or {})
  local wire = scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 6,
    from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  return scene, wire, scene:clamp(wire, { s = 0 })
end

return { make = make }
