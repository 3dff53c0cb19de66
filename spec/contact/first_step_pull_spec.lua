-- SPDX-License-Identifier: GPL-3.0-or-later
-- A straight cable that two holds keep sinks onto a table in its first step. Nothing pushes it along itself:
-- it sinks by about a micrometre beside the holds, which makes it longer by 1e-9 of itself or less. A
-- solution whose last update turned edges by u had a false axial force of EA u^2/2, up to 1.2 times the
-- cable's weight.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Returns the largest axial force of a cable on its holds in its first three steps, over its weight [-].
local function largest(o)
  local r, scene = sw.cable(o.cable).outer_diameter.value / 2, sw.scene{}
  local c, s = math.cos(o.turn), math.sin(o.turn)
  scene:obstacle{ shape = "plane", friction = o.friction, at = { 0, 0, -r } }
  local wire = scene:wire{ cable = o.cable, from = { 0, 0, 0 }, to = { o.length * c, o.length * s, 0 },
    segments = o.segments }
  scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
  local far = scene[o.far](scene, wire, { s = wire.length })
  local near = o.near == "grip" and scene:grip(wire, { s = 0.005, width = 0.01 })
    or scene:clamp(wire, { s = 0 })
  local most = 0
  for _ = 1, 3 do
    t.fine(scene:run{ dt = o.dt, duration = o.dt })
    for _, hold in ipairs{ near, far } do
      local f = hold:force()
      most = math.max(most, math.abs(f[1] * c + f[2] * s))
    end
  end
  return most / (9.81 * wire.length * wire.beam.mass_per_length)
end

describe("a straight cable between two holds on a table", function()
  for k, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    it("is not pushed along itself in its first steps: " .. cable, function()
      for segments = 26, 40, 2 do
        for i, dt in ipairs{ 0.008, 0.009, 0.01, 0.012 } do
          local share = largest{ cable = cable, segments = segments, dt = dt, length = 0.25 + 0.01 * i,
            turn = 0.3 * k * i, friction = 0.2 * k, near = i % 2 == 0 and "clamp" or "grip",
            far = i > 2 and "pin" or "clamp" }
          -- An update may leave a hundredth of the weight in each of the two stages of a step.
          t.below(0.02, share, ("axial force over weight, %d segments, %g s"):format(segments, dt))
        end
      end
    end)
  end
end)
