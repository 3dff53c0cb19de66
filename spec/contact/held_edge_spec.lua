-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire leaves a clamp over an edge or a peg nearby. The clamp is below the face that ends at the edge,
-- but inside no obstacle. The clamp therefore does not impose the depth on the edge beside it, and this
-- depth is pushed out.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local share = 0.43 -- place of the clamp over the wire's length [-]
local x = -0.2 + 0.4 * share - 0.011
local obstacles = {
  ["a narrow box"] = { shape = "box", size = { 0.01, 0.2, 0.02 }, at = { x, 0, -0.0123 } },
  ["a wide box"] = { shape = "box", size = { 0.1, 0.2, 0.02 }, at = { x - 0.045, 0, -0.0123 } },
  ["a peg"] = { shape = "cylinder", radius = 0.005, length = 0.2, at = { x, 0, -0.0073 },
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } },
}

describe("a wire beside a clamp, over", function()
  for name, obstacle in pairs(obstacles) do
    for _, friction in ipairs{ 0, 0.4 } do
      it(("%s with friction %g, makes no energy at any step, and lies no deeper than elsewhere"):format(name,
        friction), function()
        for _, dt in ipairs{ 5e-3, 1e-3, 2e-4 } do
          local scene, own = sw.scene{}, { friction = friction }
          for key, value in pairs(obstacle) do own[key] = value end
          scene:obstacle(own)
          local wire = scene:wire{ E = 2e7, density = 1400, radius = 0.002, from = { -0.2, -0.03, 0.004 },
            to = { 0.2, 0.03, 0 }, segments = 24 }
          scene:clamp(wire, { s = share * wire.length }):follow{ points = { { 0, 0, 0 }, { 0, 0, -0.004 } },
            relative = true, duration = 0.2 }
          local run = t.fine(scene:run{ duration = 0.3, dt = dt })
          t.below(5e-3, run:ledger().gained / run:ledger().play, "gained, of what is in play [-]")
          t.below(1e-4, (scene:penetration()), "deepest penetration [m]")
        end
      end)
    end
  end
end)
