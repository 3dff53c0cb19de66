-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mixed grips of real cables, which are far stiffer along their axis than their section is in shear. When
-- the rod that stood for the pads bent between them as no mesh would, the mesh that took over again was
-- torn by up to 0.16 mm beside the pads: ten times the energy in play, and the run failed at every step.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- The cable is lifted, swung to a side and let go.
local function carried(cable, length, at, width, hardness)
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  local radius = sw.cable(cable).outer_diameter.value / 2
  local wire = scene:wire{ cable = cable, from = { 0, 0, radius }, to = { length, 0, radius }, segments = 45 }
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 1e-3 }
  local weight = 9.81 * wire:get().mass_per_length * length
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.6, width = width } }
  scene:process(function(p)
    hand:grasp(wire, { s = at, approach = "mixed", force = hardness * weight })
    hand:move{ by = { 0, 0, 0.2 }, duration = 0.5 }
    hand:move{ by = { 0, -0.14, 0 }, duration = 0.5 }
    p:wait(0.05)
    hand:thaw()
    p:wait(0.02)
  end)
  t.fine(scene:run{ dt = 0.01 })
  return hand, weight
end

describe("a cable in a mixed grip", function()
  for _, case in ipairs{ { "FLRY-B 0.5", 0.4, 0.19, 0.024, 45 }, { "H07V-K 10", 0.43, 0.17, 0.018, 100 },
    { "FLRY-B 10", 0.46, 0.15, 0.011, 100 } } do
    it(case[1] .. ": goes back to the pads in balance", function()
      local hand, weight = carried(table.unpack(case))
      local kinds = {}
      for _, e in ipairs(hand.events) do
        kinds[#kinds + 1] = e.kind
        -- rod and mesh differ in how a section bends under the load: for a thin cable by a tenth of its
        -- lift
        t.below(0.15 * weight * 0.2, math.abs(e.energy), e.kind .. ": energy made")
      end
      assert.same({ "frozen", "thawed" }, kinds)
    end)
  end
end)
