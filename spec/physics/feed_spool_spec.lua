-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire with a spool's bend (rest = "path") that leaves its straight guide, or goes into it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local RADIUS, LENGTH = 0.15, 0.06 -- of the unloaded bend; fed [m]

-- Feeds LENGTH, at up to 0.2 m/s. Returns the least and the largest curvature at the guide, and the run.
local function fed(sign, stiffness, dt)
  local scene, points, least, most = sw.scene{}, {}, math.huge, 0
  for i = 0, 40 do
    local angle = 1.6 * i / 40
    points[i + 1] = { RADIUS * math.sin(angle), 0, RADIUS * (math.cos(angle) - 1) }
  end
  local wire = scene:wire{ cable = "GXL 0.5", segments = 26, path = points, rest = "path" }
  scene:force{ kind = "damping", mass = 3, stiffness = stiffness }
  local feed = scene:feed(wire)
  t.fine(scene:settle())
  scene:observe{ call = function()
    local curvature = wire:curvature(0)
    least, most = math.min(least, curvature), math.max(most, curvature)
  end }
  feed:feed{ length = sign * LENGTH, speed = 0.2 }
  local run = t.fine(scene:run{ duration = 0.7, dt = dt })
  return least, most, run
end

describe("a wire with a spool's bend at its guide", function()
  -- In the guide the wire is straight: it brings EI/(2 R^2) per length. Regression: the feed's work was
  -- without it. Here 22 to 26 % of the energy came from nowhere, at any step, and the runs failed. Measured
  -- 0.4 % as it leaves, 1.2 % as it goes in.
  it("brings its energy", function()
    for _, sign in ipairs{ 1, -1 } do
      for _, stiffness in ipairs{ 0, 2e-3 } do
        for _, dt in ipairs{ 0.01, 0.002 } do
          local _, _, run = fed(sign, stiffness, dt)
          local ledger = run:ledger()
          t.near(0, ledger.gap / ledger.play, 0.02, ("energy from nowhere, %g, %g s"):format(sign, dt))
        end
      end
    end
  end)

  -- 2 ms of damping hardly change the curvature of a wire that moves slowly: measured 1 %. Regression: length
  -- that the guide's hinge gained counted as turning; curvatures were 1.4 times as large.
  it("has the same curvature with dashpots", function()
    for _, sign in ipairs{ 1, -1 } do
      for _, dt in ipairs{ 0.01, 0.002 } do
        local least, most = fed(sign, 0, dt)
        local damped_least, damped_most = fed(sign, 2e-3, dt)
        t.share(least, damped_least, 0.03, ("least curvature, %g, %g s"):format(sign, dt))
        t.share(most, damped_most, 0.03, ("largest curvature, %g, %g s"):format(sign, dt))
      end
    end
  end)
end)
