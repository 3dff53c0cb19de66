-- SPDX-License-Identifier: GPL-3.0-or-later
-- A tie is put on a bent wire at rest as it is: it must not pull. Its place is on the chord between two
-- nodes, k h^2/8 inside the curve. With the distance from the curve a tie of 100 kN/m began with a pull of
-- 22 N.
local sw = require "softworld"
local t = require "physics.tools"

describe("a tie that is put on a bent wire at rest", function()
  for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    for _, segments in ipairs{ 43, 86 } do
      for _, way in ipairs{ "to a point", "where it is", "to another wire" } do
        it(("does not pull: %s, %d segments, %s"):format(cable, segments, way), function()
          local scene = sw.scene{}
          local function arch(y)
            local wire = scene:wire{ cable = cable, segments = segments,
              from = { 0, y, 0 }, to = { 0.4, y, 0 } }
            scene:clamp(wire, { s = 0 })
            scene:clamp(wire, { s = 0.4 }):follow{ relative = true, duration = 1,
              points = { { 0, 0, 0 }, { -0.2, 0.03, 0.01 } } }
            return wire
          end
          scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
          local wire, other = arch(0), arch(0.3)
          t.fine(scene:run{ duration = 2.5 })
          t.fine(scene:settle())
          t.fine(scene:run{ duration = 0.02 })
          local before, p = wire:min_bend_radius(), wire:position(0.2017)
          local tie = scene:tie(wire, { s = 0.2017, to = way == "to a point" and { p[1], p[2], p[3] - 0.005 }
            or way == "to another wire" and { other, s = 0.1531 } or nil })
          t.near(0, tie:tension(), 1e-6, "pull when it is made [N]")
          t.fine(scene:run{ duration = 0.2 })
          -- The wire sinks by nanometres on its way to rest: 1e5 N/m makes 0.1 mN of one.
          t.below(0.02 * wire.beam.mass_per_length * 9.81 * wire.length, tie.peak_force, "largest pull [N]")
          t.near(before, wire:min_bend_radius(), 0.01 * before, "smallest bend radius [m]")
        end)
      end
    end
  end
end)
