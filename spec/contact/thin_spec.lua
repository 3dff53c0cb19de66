-- SPDX-License-Identifier: GPL-3.0-or-later
-- The allowed depth of a touch is a share of the radius for wires thinner than 1 mm. With the depth of thick
-- wires, one of 0.05 mm radius lay 12 % of its radius deep in the table, and crossing wires overlapped by as
-- much. Two wires that cross on a table stand 3 radii high at the crossing.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local function crossing(r)
  local scene, half = sw.scene{}, 100 * r
  scene:obstacle{ shape = "plane", friction = 0.3 }
  local function wire(from, to)
    return scene:wire{ E = 1e8, density = 2000, radius = r, from = from, to = to, segments = 40 }
  end
  local below = wire({ -half, 0, r }, { half, 0, r })
  local above = wire({ 0, -half, 3.2 * r }, { 0, half, 3.2 * r })
  scene:wire_contact{ friction = 0.3 }
  return scene, below, above
end

-- Heights at the crossing over the radius [-].
local function heights(r, below, above)
  return below:position(below.length / 2)[3] / r, above:position(above.length / 2)[3] / r
end

describe("wires that cross on a table", function()
  for _, r in ipairs{ 1e-3, 2e-4, 5e-5 } do
    it(("touch, with a radius of %g mm"):format(r * 1e3), function()
      local scene, below, above = crossing(r)
      assert.truthy(scene:settle().ok)
      local function check(when)
        local low, high = heights(r, below, above)
        t.share(1, low, 0.01, "height of the lower one, " .. when .. " [radii]")
        t.share(3, high, 0.01, "height of the upper one, " .. when .. " [radii]")
        t.below(0.03, scene:penetration() / r, "depth in the table, " .. when .. " [radii]")
      end
      check "at rest"
      t.fine(scene:run{ dt = 0.01, duration = 0.2 })
      check "after a run"
    end)
  end
end)
