-- SPDX-License-Identifier: GPL-3.0-or-later
-- Damping by stiffness in a frozen grip. The grip gives where the wire leaves its pads, about one axis more
-- than about the other. Its damping there must give as much. With damping beta times stiffness everywhere,
-- all shapes of a wire without inertia come to rest as exp(-t/beta), whatever its stiffness is where.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local cables = { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" }

-- A force bends a cable's free end, first along the pads' faces, then across them. Returns for both
-- which share of the way its end has gone after beta [-].
local function gone(cable, dt, beta)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.075, 0, 0 }, segments = 23 }
  local damping = scene:force{ kind = "damping", on = wire, mass = 8 }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, height = 0.012 } }
  local share = {}
  scene:process(function(p)
    hand:grasp(wire, { s = 0.04, approach = "mixed", force = 20 })
    damping:set{ stiffness = beta }
    for k, way in ipairs{ { 0, 0, 1 }, { 0, 1, 0 } } do
      local function tip() return wire:position(0.075)[k == 1 and 3 or 2] end
      local before = tip()
      local force = scene:force{ kind = "point", on = wire, s = 0.075,
        force = { 0, 0.01 * way[2], 0.01 * way[3] } }
      p:wait(beta)
      local after = tip()
      p:wait(12 * beta)
      share[k] = (after - before) / (tip() - before)
      force:set{ force = { 0, 0, 0 } }
      p:wait(12 * beta)
    end
  end)
  t.fine(scene:run{ dt = dt })
  assert.equal("frozen", hand.events[1].kind)
  return share
end

-- A hand draws a cable over a peg and stops. Returns its force at the stop and a second later [N].
local function drawn(cable, dt, beta)
  local scene = sw.scene{}
  local r = sw.scene{}:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }.radius
  local wire = scene:wire{ cable = cable, from = { 0, 0, r }, to = { 0.4, 0, r }, segments = 80 }
  scene:force{ kind = "damping", on = wire, mass = 8, stiffness = beta }
  scene:obstacle{ shape = "cylinder", radius = 0.02, length = 0.1, friction = 0.3,
    at = { 0.25, 0, -0.02 }, rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  scene:tie(wire, { s = 0, to = { -0.05, 0, r }, slack = 0.05, stiffness = 100 })
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, height = 0.005, friction = 0.6 } }
  local held = scene:clamp(wire, { s = 0.39 })
  local stop, later
  local function pull() return hand:force():norm() end
  scene:process(function(p)
    hand:grasp(wire, { s = 0.36, approach = "mixed", force = 40 })
    held:release()
    hand:move{ by = { 0.02, 0, -0.06 }, duration = 2 }
    stop = pull()
    p:wait(1)
    later = pull()
  end)
  t.fine(scene:run{ dt = dt })
  return stop, later
end

describe("damping by stiffness in a frozen grip", function()
  for _, cable in ipairs(cables) do
    it(("brings %s to rest in the time of its free part"):format(cable), function()
      for _, dt in ipairs{ 0.01, 0.005 } do
        local share = gone(cable, dt, 0.2)
        -- 0.008 to 0.022 short where the give is damped like a clamp without give
        t.near(1 - math.exp(-1), share[1], 0.001, "along the pads")
        t.near(1 - math.exp(-1), share[2], 0.001, "towards the pads")
      end
    end)
  end

  it("does not lose the friction at a peg after its hand has stopped", function()
    local free = drawn("GXL 1.5", 0.01, 0)
    for _, dt in ipairs{ 0.01, 0.005 } do
      local stop, later = drawn("GXL 1.5", dt, 0.003)
      t.share(free, stop, 0.005, "as without damping")
      t.share(stop, later, 0.001, "a second later")
    end
  end)
end)
