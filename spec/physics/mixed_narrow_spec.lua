-- SPDX-License-Identifier: GPL-3.0-or-later
-- A soft wire in pads narrower than three of its radii turns between them as a whole. Its frozen grip, which
-- the table still bore when it was frozen, is stiffer: the mesh that comes back lies a few tenths of a radius
-- lower. It is brought there, in balance, and does not begin to swing.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A wire is frozen on the table, lifted and given back at rest. Returns force along z and moment across the
-- wire before the change, at once, and a second later; the weight; whether "unbalanced" was told.
local function given_back(case, dt)
  local r = case.radius
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  local wire = scene:wire{ E = case.E, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r },
    to = { 0.12, 0, r } }
  scene:force{ kind = "damping", mass = 20, stiffness = 1e-3 }
  local hand = scene:gripper{ name = "hand", pads = { width = case.width, friction = 0.6, opening = 3 * r } }
  local force, moment = {}, {}
  scene:process(function(p)
    local function note()
      force[#force + 1], moment[#moment + 1] = hand:force()[3], hand:moment()[2]
    end
    hand:grasp(wire, { s = 0.03, approach = "mixed", force = case.force, freeze = false })
    p:wait(0.5)
    hand:freeze()
    hand:move{ by = { 0, 0, 0.03 }, speed = 0.1 }
    p:wait(1.5)
    note()
    hand:thaw()
    note()
    p:wait(1)
    note()
  end)
  local told = false
  for _, e in ipairs(t.fine(scene:run{ dt = dt }).events) do told = told or e.kind == "unbalanced" end
  return force, moment, 9.81 * wire:get().mass_per_length * 0.12, told
end

describe("a soft wire in narrow pads that is given back at rest", function()
  for _, case in ipairs{ { E = 5e6, radius = 0.004, width = 0.01, force = 8 },
    { E = 5e6, radius = 0.004, width = 0.01, force = 2 },
    { E = 5e6, radius = 0.003, width = 0.006, force = 4 },
    { E = 2e7, radius = 0.003, width = 0.01, force = 8 } } do
    for _, dt in ipairs{ 0.01, 0.004 } do
      it(("weighs what it weighs: E = %g Pa, radius %g, pads of %g m, %g N, %g s"):format(case.E, case.radius,
        case.width, case.force, dt), function()
        local force, moment, weight, told = given_back(case, dt)
        -- 0.1 % as in mixed_spec.lua. Measured: 1e-6; before, from -1.8 to 4.3 times the weight
        t.share(weight, force[1], 1e-3, "force of the frozen wire")
        t.share(weight, force[2], 1e-3, "force at once")
        t.share(weight, force[3], 1e-3, "force a second later")
        -- 1 % as there, measured 0.05 %. If friction lets the wire stop in another place, an event tells
        -- a jump above 5 %: measured 5.7 % in the narrowest pads at 10 ms. No event comes without a jump.
        local off = math.abs(moment[2] / moment[1] - 1)
        assert.equal(off > 0.05, told)
        if not told then t.share(moment[3], moment[2], 0.01, "moment at once") end
      end)
    end
  end
end)
