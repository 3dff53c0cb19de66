-- SPDX-License-Identifier: GPL-3.0-or-later
-- What friction takes in a quasi-static run does not depend on the distance of its poses.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local MU, WAY = 0.3, 0.2

-- Draws a cable that lies on a table along itself, in poses; returns the run, the table's force on it
-- and its weight [N].
local function drawn(cable, segments, dt, wear)
  local scene = sw.scene{}
  local r = sw.cable(cable).outer_diameter.value / 2
  local table_top = scene:obstacle{ shape = "plane", friction = MU }
  local wire = scene:wire{ name = "w", cable = cable, segments = segments, from = { 0, 0, r },
    to = { 0.3, 0, r } }
  scene:clamp(wire, { s = 0.3 }):follow{ points = { { 0, 0, 0 }, { WAY, 0, 0 } }, relative = true,
    duration = 1, law = "linear" }
  local run = t.fine(scene:run{ duration = 1, dt = dt, quasistatic = true, wear = wear })
  return run, math.abs(table_top:force()[3]), wire.beam.mass_per_length * 0.3 * 9.81
end

-- Coulomb: mu N way, with N on the table; the clamp bears 4 % of the weight or less, its node and what bends
-- beside it. Regression: only the last part of each pose's path counted, of at most 0.4 edges: 0.30, 0.55,
-- 1.10 and 1.77 mJ for poses of 40 to 4 mm, right 3.29 mJ; the rest was the method's loss.
describe("friction in poses", function()
  it("takes mu N times the way, in poses of any distance", function()
    for _, cable in ipairs{ "GXL 1.5", "H07V-K 4" } do
      for _, segments in ipairs{ 30, 60 } do
        local first
        for _, dt in ipairs{ 0.2, 0.1, 0.05, 0.02, 0.005 } do
          local run, N, weight = drawn(cable, segments, dt)
          local lost = run:ledger().lost
          first = first or lost.friction
          local what = ("%s, %d segments, poses of %g mm"):format(cable, segments, 1e3 * WAY * dt)
          t.share(MU * N * WAY, lost.friction, 1e-3, what .. ": friction [J]")
          t.share(weight, N, 0.04, what .. ": force on the table [N]")
          t.share(first, lost.friction, 1e-3, what .. ": friction beside that of the longest poses [J]")
          t.below(1e-3 * first, lost.integrator, what .. ": loss of the method [J]")
        end
      end
    end
  end)

  -- Regression: friction work per area was 2.9 J/m2 in poses of 10 mm (limit 5: PASS), 8.8 in short ones.
  it("gives the same wear", function()
    local first
    for _, dt in ipairs{ 0.1, 0.05, 0.02, 0.005 } do
      local run = drawn("GXL 1.5", 30, dt, true)
      local value = run:check{ use = "movement", limits = { friction_work = 5 } }:row "w.friction_work".value
      first = first or value
      t.share(first, value, 1e-3, ("friction work in poses of %g mm [J/m2]"):format(1e3 * WAY * dt))
      t.above(7.5, value, "friction work: mu m g way over the radius is 7.57 J/m2")
    end
  end)
end)
