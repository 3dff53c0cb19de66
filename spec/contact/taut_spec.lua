-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a taut wire presses with has nothing to do with its weight. A limp, weightless string of 1 N over a
-- cylinder presses with T/R = 19 N/m; touches as stiff as 100,000 times their usual stiffness let it sink in
-- by 0.1 to 0.7 mm, at rest, and the first steps threw 83 J of that out (100 edges).
package.path = "./?.lua;" .. package.path
local capstan = require "spec.check.capstan"
local t = require "spec.physics.tools"

describe("a taut string without weight", function()
  for _, edges in ipairs{ 100, 200, 250 } do
    it("lies on a cylinder, of " .. edges .. " edges", function()
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
