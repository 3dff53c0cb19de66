-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that take two cables side by side, with a place s. Both fingers close by the same way, so they come to
-- the cables at the same time only if they stand in the middle of both. At the middle of one cable, a finger
-- came to the other by a diameter earlier, and bent both aside: 9 N of 20 were borne by clamps beside them.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local vec = require "softworld.vec"
local t = require "spec.physics.tools"

local force = 20

local function radius(cable)
  return sw.scene{}:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }.radius
end

-- Takes two cables that lie side by side and touch. angle: of the scene about z [rad]. Returns the forces on
-- both across them, from their pads inwards, what the clamps beside the pads bear, and the margin.
local function taken(o)
  local turn = vec.turn({ 0, 0, 1 }, o.angle or 0)
  local function at(x, y) return vec.rotate(turn, { x, y, 0 }) end
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  scene:force{ kind = "damping", mass = 8, stiffness = 0.003 }
  scene:wire_contact{ friction = 0.4 }
  local wires, clamps = {}, {}
  for k, side in ipairs{ -1, 1 } do
    local y = side * radius(o[k])
    wires[k] = scene:wire{ cable = o[k], from = at(-0.1, y), to = at(0.1, y), segments = 57 + 3 * k }
    clamps[k] = scene:clamp(wires[k], { s = 0.08 })
  end
  local hand = scene:gripper({ name = "hand", pads = { width = 0.016, height = 0.014, opening = 0.014 },
    rotation = o.turned and { axis = { 0, 0, 1 }, angle = o.angle } or nil })
  local inwards, borne, margin = {}, 0, nil
  scene:process(function(p)
    local list = o.swapped and { wires[2], wires[1] } or wires
    hand:grasp(list, { s = 0.1, approach = "plates", force = force })
    p:wait(0.2)
    local y = at(0, 1)
    for k, side in ipairs{ 1, -1 } do
      inwards[k] = side * vec.dot(hand:force{ wire = wires[k] }, y)
      borne = math.max(borne, math.abs(vec.dot(clamps[k]:force(), y)))
    end
    margin = hand:state().margin
  end)
  t.fine(scene:run{ dt = o.dt or 0.005, quasistatic = o.poses })
  return inwards, borne, margin
end

describe("pads that take two cables side by side", function()
  for _, o in ipairs{
    { "GXL 1.5", "GXL 1.5" }, { "GXL 1.5", "GXL 1.5", swapped = true, angle = 0.7 },
    { "GXL 1.5", "GXL 1.5", poses = true, dt = 0.01 }, { "FLRY-B 0.5", "FLRY-B 0.5", angle = 2 },
    { "GXL 1.5", "GXL 1.5", angle = 2, turned = true },
    { "H07V-K 4", "FLRY-B 0.5" }, { "FLRY-B 0.5", "H07V-K 4", swapped = true, poses = true, dt = 0.01 },
  } do
    it(("stand in their middle: %s and %s%s%s%s"):format(o[1], o[2], o.swapped and ", swapped" or "",
      o.turned and ", with a rotation" or "", o.poses and ", in poses" or ""), function()
        local inwards, borne, margin = taken(o)
        for k = 1, 2 do t.near(force, inwards[k], 0.02 * force, "force of one pad") end
        t.below(0.02 * force, borne, "borne by a clamp beside the pads")
        t.below(0.1, margin, "margin: nothing pulls the cables")
      end)
  end
end)
