-- SPDX-License-Identifier: GPL-3.0-or-later
-- A stiff cable that is pushed into a bend of a channel. Its end pokes at one wall behind the corner of the
-- other, within an edge: it turns about that corner, and is not pinched between both.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local CABLE = "FLRY-B 2.5"

-- Returns the push of the hand at rest [N], and how deep the cable is in the walls [m].
local function pushed(length, segments, friction, dt)
  local scene, r = sw.scene{}, sw.cable(CABLE).outer_diameter.value / 2
  scene:channel{ points = { { -0.05, 0, 0 }, { 0.2, 0, 0 }, { 0.2878, 0.0479, 0 } }, width = 3.2 * r,
    depth = 6.5 * r, friction = friction }
  local wire = scene:wire{ cable = CABLE, from = { 0.16 - length, 0, r }, to = { 0.16, 0, r },
    segments = segments }
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 2e-3 }
  local clamp = scene:clamp(wire, { s = 0 })
  clamp:follow{ points = { { 0, 0, 0 }, { 0.046, 0, 0 } }, duration = 1, relative = true }
  t.fine(scene:run{ duration = 1.2, dt = dt, frames = false })
  return clamp:force()[1], scene:penetration()
end

describe("a cable pushed into a bend", function()
  -- Regression: 0.63 N for 0.84 N in steps of 20 ms, 0.18 mm deep.
  for _, friction in ipairs{ 0, 0.38 } do
    local length, segments = 0.15, 15
    it(("pushes back equally hard at any step, friction %g"):format(friction), function()
      local right = pushed(length, segments, friction, 0.0005)
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
        local force, depth = pushed(length, segments, friction, dt)
        t.share(right, force, 0.05, ("push at %g s"):format(dt))
        t.below(20e-6, depth, ("depth at %g s"):format(dt))
      end
    end)
  end
end)
