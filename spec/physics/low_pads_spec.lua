-- SPDX-License-Identifier: GPL-3.0-or-later
-- Flat pads of small height, 2 mm, that close along gravity on a wire that sinks by its sag meanwhile: the
-- lower one lifts it. A pad presses a rod by the width along the wire, with about 12 samples there, 5 um deep
-- at the wanted force. The spacing came from the height: 120 samples, ten times too stiff. Poses then found
-- no rest, or threw the wire out of four fingers.
local sw = require "softworld"
local t = require "spec.physics.tools"

local FORCE = 5

-- Returns the scene, its wire and a gripper whose first finger is above the wire, or beside it.
local function setting(cable, fingers, off)
  local scene = sw.scene {}
  local wire = scene:wire { cable = cable, segments = 40, from = { -0.1, 0, 0.3 }, to = { 0.1, 0, 0.3 } }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = 0.2 })
  local hand = scene:gripper { name = "hand", at = { 0, -off, 0.3 - off },
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 },
    pads = { fingers = fingers, shape = "flat", width = 0.02, height = 0.002,
      opening = off > 0 and 0.0095 or nil } }
  return scene, wire, hand
end

describe("flat pads of small height in poses", function()
  for _, cable in ipairs { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    for _, dt in ipairs { 0.02, 0.005 } do
      it(("press with their force, %s, %g s"):format(cable, dt), function()
        for fingers = 2, 4, 2 do
          local scene, wire, hand = setting(cable, fingers, 0)
          scene:process(function() hand:grasp(wire, { s = 0.1, approach = "plates", force = FORCE }) end)
          local run = t.fine(scene:run { dt = dt, quasistatic = true })
          assert.same({}, t.events(run, "energy"))
          local x = wire:position(0.1)
          t.near(0, x[2], 1e-5, "the wire is at the centre, within twice the samples' depth, y")
          t.near(0.3, x[3], 1e-5, "z")
          for k = 1, fingers do
            t.near(FORCE, hand:force { finger = k }:norm(), 0.1, "but for the wire's bending and weight")
          end
          t.below(2 * wire.radius, hand:state().opening, "opening: the wire is squeezed")
          t.above(2 * wire.radius - 1e-5, hand:state().opening, "by the samples' depth of 5 um on both sides")
        end
      end)
    end
  end

  it("close beside a wire that is in the corner of two fingers, and say so", function()
    local scene, wire, hand = setting("H07V-K 4", 4, 0.0032)
    local why
    scene:process(function()
      why = select(2, pcall(hand.grasp, hand, wire, { approach = "plates", force = 2 }))
    end)
    scene:run { dt = 0.01, quasistatic = true }
    assert.truthy(why:find("closed beside the wire: it is not between the 4 fingers", 1, true), why)
  end)
end)
