-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that is shorter than the mesh of a mixed grasp: the message tells the way out, which works.
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Returns the error of the grasp, or nil, and the margin that the grip has then.
local function grasped(o)
  local scene = sw.scene{ name = "short" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, 0.0015 },
    to = { o.long, 0, 0.0015 }, segments = 4 }
  local hand = scene:gripper{ name = "hand", pads = { width = o.width or 0.02 } }
  if o.mesh then wire:remodel{ model = "radial" } end
  local why, margin
  scene:process(function()
    local fine, text = pcall(hand.grasp, hand, wire, { s = o.long / 2, approach = "mixed", force = 5,
      region = o.region })
    why, margin = not fine and text or nil, fine and hand:state().margin
  end)
  t.fine(scene:run{ dt = 0.01 })
  return why, margin
end

describe("a mixed grasp of a short wire", function()
  it("says how long it is, and the way out", function()
    assert.matches("gripper 'hand': wire 'wire' is 5%.000 mm long, and the mesh of a mixed grasp, from s = 0 "
      .. "m to 5%.000 mm, .*takes all of it%. Make all of it a mesh before: wire:remodel{ model = 'radial' "
      .. "}; or give a smaller region", (grasped{ long = 0.005 }))
  end)

  it("takes it as a mesh, or with a smaller region", function()
    for _, o in ipairs{ { long = 0.005, mesh = true }, { long = 0.03, region = 0.018, width = 0.01 } } do
      local why, margin = grasped(o)
      assert.is_nil(why)
      t.below(0.9, margin, "margin")
    end
  end)
end)
