-- SPDX-License-Identifier: GPL-3.0-or-later
-- A spring of limited force from a place of a wire to a point.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH, MASS = 0.2, 0.01

-- A stiff short rod without weight, at rest, pulled at its middle.
local function pulled(args)
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  local wire = scene:wire { EA = 1e5, EI = 5, mass_per_length = MASS / LENGTH, radius = 0.003, segments = 4,
    from = { 0, 0, 0 }, to = { LENGTH, 0, 0 } }
  local force = scene:force { kind = "pull", on = wire, s = LENGTH / 2, to = { LENGTH / 2, 0, args.height },
    force = args.force, stiffness = args.stiffness }
  return scene, wire, force
end

describe("the force pull", function()
  -- Along z the rod is one mass: z = F t^2 / (2 m) as long as the spring is beyond its limit.
  it("pulls with its limit from afar, and with k d near by", function()
    local scene, wire, force = pulled { height = 1, force = 0.02, stiffness = 50 }
    assert.near(0.02, force:read(wire).tension, 1e-12)
    t.fine(scene:run { duration = 0.1, dt = 1e-3 })
    t.share(0.5 * 0.02 / MASS * 0.1 ^ 2, wire:position(LENGTH / 2)[3], 0.01, "way")
    force:set { to = { LENGTH / 2, 0, wire:position(LENGTH / 2)[3] + 1e-4 } }
    assert.near(50 * 1e-4, force:read(wire).tension, 1e-9)
  end)

  -- E = F (d - d0 / 2) with d0 = F / k beyond d0, 1/2 k d^2 below.
  it("has the energy of its formula, which moving the rod gives back", function()
    local scene = pulled { height = 0.5, force = 2, stiffness = 50 }
    t.near(2 * (0.5 - 0.02), scene:energy().pull, 1e-12)
    t.near(0.5 * 50 * 0.01 ^ 2, (pulled { height = 0.01, force = 2, stiffness = 50 }):energy().pull, 1e-12)
    local before = scene:energy().total
    t.fine(scene:run { duration = 0.1, dt = 2e-4 })
    t.share(before, scene:energy().total, 1e-3, "energy")
  end)

  it("refuses wrong forces and stiffnesses", function()
    assert.error_matches(function() pulled { height = 1, force = 0, stiffness = 50 } end,
      "force = 0 N is not allowed")
    assert.error_matches(function() pulled { height = 1, force = 1, stiffness = -1 } end,
      "stiffness = %-1 N/m")
  end)
end)
