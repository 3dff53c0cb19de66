-- SPDX-License-Identifier: GPL-3.0-or-later
-- A slow pull along pads, beyond their friction: no equilibrium exists, and nearer poses cannot find one. The
-- reason names the gripper and its friction.
local sw = require "softworld"

local function pulled(shape, fingers, quasistatic)
  local scene = sw.scene{ name = "slip", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", cable = "GXL 2.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
    segments = 40 }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.002 }
  local gripper = scene:gripper{ name = "g", pads = { shape = shape, fingers = fingers, width = 0.02,
    friction = 0.15 }, rating = { force = 20, moment = 1, stroke = 0.05 } }
  local pull = scene:force{ kind = "point", on = wire, s = 0.2, force = { 0, 0, 0 } }
  scene:process(function(p)
    gripper:grasp(wire, { s = 0.1, approach = "plates", force = 10 })
    for k = 1, 100 do
      pull:set{ force = { 0.06 * k, 0, 0 } }
      p:wait(0.02)
    end
  end)
  return scene:run{ dt = 0.02, quasistatic = quasistatic }
end

describe("a slow pull beyond the friction of pads", function()
  for _, case in ipairs{ { "flat", 2, 3 }, { "round", 3, 4.5 } } do
    it(("tells which pads slip, and what they hold: %s, %d fingers"):format(case[1], case[2]), function()
      local run = pulled(case[1], case[2], true)
      print("measured: " .. run.reason)
      assert.is_false(run.ok)
      local friction, margin = run.reason:match
        "pads of gripper 'g' use up their friction of (%S+) N %(margin (%S+)%)"
      assert.is_near(case[3], tonumber(friction), 0.02 * case[3])
      assert.is_near(1, tonumber(margin), 0.05)
      assert.truthy(run.reason:find("no equilibrium exists", 1, true))
      assert.truthy(run.reason:find("try a run without quasistatic", 1, true))
      assert.falsy(run.reason:find("dt =", 1, true))
    end)
  end
end)
