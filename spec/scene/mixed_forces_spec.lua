-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mixed grasp makes the wire a mesh and a rod again. A force that goes with one of them only is refused
-- there with its name: the program crashed (found by random calls).
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Grasps a wire, calls act(scene, gripper, wire, process) and lets go.
local function grasped(freeze, act)
  local scene = sw.scene{}
  local wire = scene:wire{ E = 8.68e7, density = 1400, radius = 0.003, from = { 0, 0, 0.1 },
    to = { 0.3, 0, 0.1 }, segments = 13 }
  local hand = scene:gripper{ pads = { width = 0.01, friction = 0.8, opening = 0.01 } }
  scene:clamp(wire, { s = 0 })
  scene:process(function(p)
    hand:grasp(wire, { s = 0.1, approach = "mixed", force = 8, speed = 0.2, spacing = 0.002, region = 0.02,
      freeze = freeze })
    p:wait(0.02)
    act(scene, hand, wire, p)
    hand:release()
  end)
  t.fine(scene:run{ dt = 4e-3 })
  return wire
end

local function refused(text, f, ...)
  local fine, why = pcall(f, ...)
  assert.is_false(fine)
  assert.matches(text, why, 1, true)
end

describe("a force of one model on a wire in a mixed grasp", function()
  it("is refused by the freeze, and the mesh stays between the pads", function()
    local wire = grasped(false, function(scene, hand, wire, p)
      local force = scene:force{ kind = "plastic_springs", yield = 0.01 }
      refused("force plastic_springs: wire 'wire1' is a rod", hand.freeze, hand)
      assert.equal("radial", wire.model)
      force:release()
      p:wait(0.01)
      hand:freeze()
      assert.equal("rod", wire.model)
    end)
    assert.equal("rod", wire.model)
  end)

  it("is refused by the thaw, and the grip holds", function()
    grasped(true, function(scene, hand, wire)
      local force = scene:force{ kind = "plastic", yield_moment = 1e-3 }
      refused("force plastic: wire 'wire1' is a radial", hand.thaw, hand)
      assert.equal("rod", wire.model)
      force:release()
      hand:thaw()
      assert.equal("radial", wire.model)
    end)
  end)
end)
