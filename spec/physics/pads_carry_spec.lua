-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that press and stick do not lose the wire because a step is long. A step begins with free flight: a
-- wire that is carried fast, or just hangs, is below the pads before any touch is found.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- The pads press with 6 N each at a friction of 0.5. Their 6 N hold a wire of 20 g that is accelerated by
-- 25 m/s^2 with less than 1 N.
local function carried(cable, at, acceleration, dt)
  local scene = sw.scene{}
  local radius = sw.cable(cable).outer_diameter.value / 2
  local wire = scene:wire{ cable = cable, from = { 0, 0, radius }, to = { 0.5, 0, radius }, segments = 37 }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
  scene:obstacle{ shape = "plane", friction = 0.4 }
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.5, width = 0.015 } }
  scene:process(function(p)
    hand:grasp(wire, { s = at, approach = "plates", force = 6 })
    for _, way in ipairs{ { 0, 0, 0.15 }, { 0.1, 0.1, 0 }, { -0.1, 0.1, 0 } } do
      hand:move{ by = way, speed = 3, acceleration = acceleration }
    end
    p:wait(0.2)
  end)
  local off = 0 -- largest relative error of the jaws' force in any step [-]
  scene:observe{ every = dt, call = function()
    local state = hand:state()
    if state.jaws == "holds" then off = math.max(off, math.abs(state.squeeze / 6 - 1)) end
  end }
  t.fine(scene:run{ dt = dt })
  local state = hand:state()
  return { jaws = state.jaws, slip = state.slip, off = off, peak = hand.peak_force,
    height = wire:position(at)[3] - radius }
end

-- A wire pinched by round fingers at one of its nodes bends round them very little, now one way and now the
-- other. The pads' softness must not depend on the number of touches at one place.
local function pinched(pads, shift, dt)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ E = 5e7, nu = 0.4, density = 1200, radius = 0.003,
    from = { -0.05 + shift, 2e-4, 0 }, to = { 0.05 + shift, 2e-4, 0 } }
  scene:force{ kind = "damping", mass = 20 }
  pads.opening, pads.width, pads.friction = 0.014, 0.02, 0.1
  local hand = scene:gripper{ at = { 0, 0, 0 }, rotation = { 1, 0, 0, 0 }, pads = pads }
  local off, held = 0, 0
  scene:observe{ every = dt, call = function()
    local state = hand:state()
    if state.jaws == "holds" then off, held = math.max(off, math.abs(state.squeeze / 2 - 1)), held + 1 end
  end }
  scene:process(function(p)
    hand:grasp(wire, { approach = "plates", force = 2 })
    p:wait(0.3)
  end)
  t.fine(scene:run{ dt = dt })
  return { off = off, held = held, aside = math.abs(wire:position(0.05)[2]) }
end

describe("fingers that pinch a wire", function()
  for _, pads in ipairs{ { shape = "round" }, { shape = "v" },
    { fingers = 3, height = 0.004, below = 0.002 } } do
    it(("hold it calmly: %s"):format(pads.shape or "three"), function()
      for _, shift in ipairs{ 0, 2e-4, 6e-4, 1e-3 } do -- of edges of 2 mm
        for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3 } do
          local m = pinched({ shape = pads.shape, fingers = pads.fingers, height = pads.height,
            below = pads.below }, shift, dt)
          local what = (" at steps of %g s, %g m along"):format(dt, shift)
          assert.is_true(m.held > 5)
          t.below(0.015, m.off, "error of the force per finger in any step [-]" .. what)
          t.below(1e-4, m.aside, "off the middle [m]" .. what)
        end
      end
    end)
  end
end)

describe("pads that carry a wire fast", function()
  for _, case in ipairs{ { "FLRY-B 2.5", 0.194, 26 }, { "GXL 1.5", 0.1, 25 }, { "FLRY-B 0.5", 0.3, 20 },
    { "GXL 0.5", 0.15, 100 }, { "GXL 1.5", 0.25, 150 } } do
    it(("hold %s by %g m/s^2 at all steps"):format(case[1], case[3]), function()
      local fine = carried(case[1], case[2], case[3], 1e-3)
      for _, dt in ipairs{ 2e-2, 1e-2, 5e-3 } do
        local m, what = carried(case[1], case[2], case[3], dt), (" at steps of %g s"):format(dt)
        assert.equal("holds", m.jaws, m.jaws .. what)
        t.below(0.02, m.off, "error of the jaws' force in any step [-]" .. what) -- 1e-3 except for jumps
        t.below(2e-3, m.slip, "slip [m]" .. what)
        t.near(0.15, m.height, 2e-3, "height of what is held [m]" .. what) -- slip included
        t.share(fine.peak, m.peak, 0.25, "largest force on the tool [N]" .. what) -- acceleration in steps
      end
    end)
  end
end)
