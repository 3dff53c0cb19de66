-- SPDX-License-Identifier: GPL-3.0-or-later
-- Jaws that close on two wires side by side reach their force at any step.
local sw = require "softworld"
local mm = sw.units.mm

local function close(dt)
  local scene, wires = sw.scene{}, {}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i = 1, 2 do
    local y = i == 1 and -1.5e-3 or 1.5e-3
    wires[i] = scene:wire{ cable = "GXL 1.5", segments = 40, from = { -0.1, y, 1.5e-3 },
      to = { 0.1, y, 1.5e-3 } }
  end
  scene:wire_contact{ friction = 0.3 }
  scene:force{ kind = "damping", mass = 8, stiffness = 0.002 }
  local hand = scene:gripper{ name = "hand",
    pads = { width = mm(20), friction = 0.5, opening = mm(12) } }
  local at, state
  scene:process(function(p)
    hand:grasp(wires, { s = 0.1, approach = "plates", force = 20 })
    at = scene.time
    p:wait(0.1)
    state = hand:state()
  end)
  local run = scene:run{ dt = dt }
  assert.is_true(run.ok, run.reason)
  return at, state
end

describe("jaws on two wires side by side", function()
  it("reach their force soon after they touch, at the same opening", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.005 } do
      local at, state = close(dt)
      assert.near(0.36, at, 0.1) -- the free way takes 0.3 s
      assert.near(20, state.squeeze, 0.02)
      assert.near(5.99e-3, state.opening, 0.02e-3)
    end
  end)
end)
