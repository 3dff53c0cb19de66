-- SPDX-License-Identifier: GPL-3.0-or-later
-- The contact force of a taut wire does not depend on its weight. A limp, weightless string under 1 N over
-- a cylinder presses with T/R = 19 N/m. Touches of 100,000 times their usual stiffness were too soft for
-- that: the string sank in by 0.1 to 0.7 mm at rest, and the first steps turned this into 83 J (100 edges).
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local capstan = require "spec.check.capstan"
local t = require "spec.physics.tools"

describe("a taut string without weight", function()
  for _, edges in ipairs{ 100, 200, 250 } do
    it("lies on a cylinder without sinking in: " .. edges .. " edges", function()
      local scene, wire, pin = capstan.scene{ friction = 0, angle = math.pi, segments = edges }
      t.fine(scene:settle())
      t.below(55e-6, (scene:penetration()), "depth [m]")
      for _, dt in ipairs{ 0.01, 0.001 } do
        t.fine(scene:run{ duration = 0.05, dt = dt })
        t.share(1, t.norm(pin:force()), 2e-3, "force at its end [N]")
        t.share(1, wire:tension(0.02), 2e-3, "tension [N]")
      end
    end)
  end
end)

-- The ends are pulled down until the cable is stretched by half a percent: contact forces of 150 to 900 N,
-- thousands of times its weight. A touch that is too deep becomes stiffer from the next step on, at the
-- same force. Stiffening within the step makes energy when the touch comes out, so such steps were refused:
-- at 1 ms 4,075 of 4,732 steps, at 20 times the solves.
local function pulled(cable, dt)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.6, 0, 0 }, segments = 60 }
  scene:obstacle{ shape = "cylinder", radius = 0.04, length = 0.2, friction = 0.3,
    at = { 0.3, 0, -0.04 - wire.radius }, rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 1e-3 }
  for end_of, side in pairs{ [0] = 1, [wire.length] = -1 } do
    scene:clamp(wire, { s = end_of }):follow{ duration = 1, relative = true,
      points = { { 0, 0, 0 }, { 0.06 * side, 0, -0.15 }, { 0.055 * side, 0, -0.174 } } }
  end
  return t.fine(scene:run{ duration = 1.5, dt = dt }), wire:tension(0.3), (scene:penetration())
end

describe("a cable that is pulled hard over a thick cylinder", function()
  for _, cable in ipairs{ "GXL 1.5", "H07V-K 10" } do
    it("has the same tension and depth at every step size, few refused steps and no " ..
      "energy gain: " .. cable, function()
      local _, coarse, sunk = pulled(cable, 0.01)
      t.below(1e-4, sunk, "depth [m]")
      for _, dt in ipairs{ 0.002, 0.001 } do
        local run, tension, depth = pulled(cable, dt)
        t.share(tension, coarse, 0.04, "tension at 10 ms [N]")
        t.below(1e-4, depth, "depth [m]")
        t.below(0.05, run.rejected / run.steps, "refused steps")
        t.below(1e-3, run:ledger().gained / run:ledger().play, "energy from nowhere, of that in play")
      end
    end)
  end
end)
