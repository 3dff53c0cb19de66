-- SPDX-License-Identifier: GPL-3.0-or-later
-- Bends in a feed's guide while wire passes. The hinge between guide and wire has a length that grows and
-- shrinks with the first edge.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

describe("a cable with dashpots that bends out of its guide", function()
  -- The moment in the guide is EI (curvature + beta rate of curvature). Along the cable the curvature
  -- changes by 2/L of itself, so wire that flows at v adds at most 2 beta v/L = 0.5 %; measured 0.6 %.
  -- Regression: length that the hinge gained counted as turning. The curvature of wire drawn in at 0.3 m/s
  -- was up to 1.62 times too large, and 0.79 of the right one as it was paid out (1.14 and 0.93 times at
  -- 0.1 m/s and 1 ms), at some places of the nodes. Where a step of 10 or 20 ms began with a first edge of
  -- more than half an edge and would end with less, the node beside the guide was removed and made again
  -- eight times. It stayed, and for this step the curvature was 0.54 to 0.91 of the right one. No event.
  it("has the curvature of its moment, in both directions, whatever the speed", function()
    local length = 0.25
    for _, at_end in ipairs{ false, true } do
      for _, p in ipairs{ { -1, 0.3, 2e-3, 1e-3 }, { -1, 0.1, 1e-3, 1e-3 }, { 1, 0.3, 2e-3, 1e-3 },
        { -1, 0.3, 2e-3, 0.02 }, { -1, 0.15, 2e-3, 0.01 }, { 1, 0.15, 2e-3, 0.01 } } do
        local sign, speed, stiffness, dt = p[1], p[2], p[3], p[4]
        local scene, least, most = sw.scene{}, 1, 1
        local wire = scene:wire{ cable = "GXL 0.5", segments = 26,
          from = { at_end and length or 0, 0, 0 }, to = { at_end and 0 or length, 0, 0 } }
        scene:force{ kind = "damping", mass = 3, stiffness = stiffness }
        local feed = scene:feed(wire, { s = at_end and length or 0 })
        t.fine(scene:settle())
        scene:observe{ call = function()
          local m = feed:moment()
          local moment = math.sqrt(m[1] ^ 2 + m[2] ^ 2 + m[3] ^ 2)
          local ratio = wire:curvature(at_end and wire.length or 0) * wire.beam.EI / moment
          least, most = math.min(least, ratio), math.max(most, ratio)
        end }
        feed:feed{ length = sign * 0.04, speed = speed }
        t.fine(scene:run{ duration = 0.1 + 0.04 / speed, dt = dt })
        local what = ("%g m/s, %g s, steps of %g s"):format(sign * speed, stiffness, dt)
        t.near(1, most, 0.02, "largest curvature over that of the moment, " .. what)
        t.near(1, least, 0.02, "smallest, " .. what)
      end
    end
  end)
end)

describe("a wire with permanent bends that leaves its guide", function()
  -- The guide's walls push it out with the energy per length of the elastic bend. Regression: with that of
  -- the whole bend. Runs failed with 11 to 33 % of the energy from nowhere.
  it("takes its energy from the feed", function()
    for _, eta in ipairs{ 1e-5, 3e-5, 1e-4 } do
      for _, dt in ipairs{ 0.01, 0.002 } do
        local scene = sw.scene{}
        local wire = scene:wire{ EA = 2e4, EI = 3e-3, mass_per_length = 0.03, radius = 0.002, segments = 20,
          from = { 0, 0, 0 }, to = { 0.4, 0, 0 } }
        scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.002 }
        scene:force{ kind = "plastic", on = wire, yield_moment = 0.004, hardening = 1e-3 }
        scene:force{ kind = "viscous_bend", on = wire, eta = eta }
        local feed = scene:feed(wire)
        feed:feed{ length = 0.2, duration = 1 }
        local ledger = t.fine(scene:run{ duration = 1.5, dt = dt }):ledger()
        -- measured 1.25 % at 10 ms, where the wire yields within a step, and 0.01 % at 2 ms
        t.near(0, ledger.gap / ledger.play, 2 * dt, ("energy from nowhere, %g s"):format(dt))
      end
    end
  end)
end)
