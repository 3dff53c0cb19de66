-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire between a clamp and a slider is drawn along the rail in poses: it only shifts, as a whole.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Regression: at ways of 20 to 58 mm ahead the run failed ("an edge would turn over"), at any dt. The rail's
-- place in the last pose was taken to be where the wire had gone. The clamp, its way and the rail are exact;
-- the wire hangs in the same shape at each place: 1e-6 m of tolerances of poses.
describe("a slider in a quasi-static run", function()
  for _, tilt in ipairs{ 0, 0.7 } do
    it(("goes as far as the wire, along a rail at %g rad"):format(tilt), function()
      local c, s = math.cos(tilt), math.sin(tilt)
      for _, cable in ipairs{ "GXL 1.5", "H07V-K 4" } do
        for _, segments in ipairs{ 5, 20, 41 } do
          for _, way in ipairs{ 0.1, -0.1 } do
            for _, dt in ipairs{ 0.1, 0.02 } do
              local scene = sw.scene{}
              local wire = scene:wire{ cable = cable, segments = segments, from = { 0, 0, 0 },
                to = { 0.2 * c, 0.2 * s, 0 } }
              local rail = scene:slider(wire, { s = 0, direction = { c, s, 0 } })
              local clamp = scene:clamp(wire, { s = 0.2 })
              t.fine(scene:settle())
              local before = rail:place()
              clamp:follow{ points = { { 0, 0, 0 }, { way * c, way * s, 0 } }, relative = true, duration = 1,
                law = "linear" }
              t.fine(scene:run{ duration = 1, dt = dt, quasistatic = true })
              local what = ("%s, %d segments, way %g m, dt %g s"):format(cable, segments, way, dt)
              t.below(1e-6, math.abs(rail:place() - before - way), what .. ": place less way [m]")
            end
          end
        end
      end
    end)
  end
end)
