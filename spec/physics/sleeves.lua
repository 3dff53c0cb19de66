-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that comes out of a feed, for specs of feeds.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local g, mass, EI, GJ = 9.81, 0.03, 3e-3, 2e-3

-- A wire of `length` along x from the origin with a feed at its start.
local function sleeve(length, segments, options)
  local o = options or {}
  local scene = sw.scene { gravity = o.gravity or { 0, 0, -g } }
  local wire = scene:wire { EA = 1e5, EI = o.EI or EI, GJ = GJ, mass_per_length = mass,
    radius = 0.002, from = { 0, 0, 0 }, to = { length, 0, 0 }, segments = segments,
    normal = o.normal, model = o.model }
  return scene, wire, scene:feed(wire, o.feed)
end

return { sleeve = sleeve }
