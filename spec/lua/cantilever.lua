-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cantilever and its state, for specs of error bars.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local function make(segments)
  local scene = sw.scene{ name = "bench" }
  local wire = scene:wire{ EA = 600, EI = 0.02, mass_per_length = 0.1, radius = 0.005,
    segments = segments or 12, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  local clamp = scene:clamp(wire, { s = 0 })
  return scene, wire, clamp
end

return { make = make }
