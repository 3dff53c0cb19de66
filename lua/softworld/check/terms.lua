-- SPDX-License-Identifier: GPL-3.0-or-later
--- Sizes of the terms whose difference a checked value is. A value that should be 0 is some units in the last
-- place of them, by rounding. Each is a lower bound, so that no value passes that is more than rounding.
-- @module softworld.check.terms
local build = require "softworld.scene.build"

local terms = {}

--- Of a ratio of two equal things less 1: strains, gaps of frequencies [-].
function terms.one() return 1 end

--- Of a distance of the wire's surface: coordinates of its nodes, and its radius [m].
function terms.places(entry)
  local far = 0
  for _, x in ipairs((entry.object:positions())) do far = math.max(far, math.abs(x)) end
  return far + entry.object.radius
end

--- The same of all wires of the scene [m].
function terms.places_of_all(_, context)
  local far = 0
  for _, w in ipairs(build.data(context.scene).wires) do
    far = math.max(far, terms.places{ object = w.object })
  end
  return far
end

--- Of a tension: EA times length over length without load, less EA [N].
function terms.tension(entry) return entry.object.beam.EA end

--- Of a stress: Young's modulus, at least EA over the area of the outer circle [Pa].
function terms.stress(entry)
  local wire = entry.object
  return wire.beam.EA / (math.pi * wire.radius ^ 2)
end

return terms
