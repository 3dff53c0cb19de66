-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mixed grip takes a cable from a table, from pose to pose. A section of eight particles with corners at
-- the pads stands on a corner, too. That is no state of rest: a pose rolled it towards its side before the
-- pads closed, and they held it askew, like a nut. The margin was 0.43 to 0.55 then, whatever the cable
-- weighed (one of the cables lay on a side, and its height was 6 % too small).
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local vec = require "softworld.vec"

local MU, FORCE = 0.3, 20
local STRAIGHT, TURNED = { 0.02, 0, false }, { 0.05, 0.7, true } -- step [s], yaw of the scene [rad], swapped

-- Returns margin and height of the section after the lift. yaw: of the scene [rad]; swapped: the wire's ends.
local function lifted(cable, dt, yaw, swapped)
  local scene <close> = sw.scene{}
  local turn = { math.cos(yaw / 2), 0, 0, math.sin(yaw / 2) }
  local r = sw.cable(cable).outer_diameter.value / 2
  local half = swapped and -20 * r or 20 * r
  local wire = scene:wire{ cable = cable, from = vec.rotate(turn, { -half, 0, r }),
    to = vec.rotate(turn, { half, 0, r }), segments = 20 }
  scene:obstacle{ shape = "plane", friction = MU }
  local hand = scene:gripper{ name = "hand", rotation = turn,
    pads = { width = 5 * r, height = 1.6 * r, friction = MU, opening = 2.6 * r } }
  scene:process(function()
    hand:grasp(wire, { s = 20 * r, approach = "mixed", force = FORCE })
    hand:move{ by = { 0, 0, 5 * r }, duration = 0.1 }
  end)
  t.fine(scene:run{ dt = dt, quasistatic = true })
  local weight = wire.beam.mass_per_length * 40 * r * 9.81
  t.share(weight, hand:force()[3], 1e-3, cable .. ": weight")
  return hand:state().margin, hand:squeeze().height / (2 * r), weight / (2 * MU * FORCE)
end

describe("a cable that a mixed grip lifts from a table in poses", function()
  for _, cable in ipairs{ "GXL 1.5", "H07V-K 4", "FLRY-B 0.5" } do
    it("is not held askew: " .. cable, function()
      for _, case in ipairs(cable == "GXL 1.5" and { STRAIGHT, TURNED } or { TURNED }) do
        local margin, height, least = lifted(cable, table.unpack(case))
        t.above(0.7 * least, margin, "margin, at least that of the weight")
        -- a section turned by an angle between its pads needs the share tan(angle)/mu of their friction
        t.below(least + math.tan(math.rad(1)) / MU, margin, "margin, of a section turned by up to 1 degree")
        -- corners of ten particles are 1.7 % outside of the circle; the force takes some of it
        t.share(1, height, 0.02, "height over the cable's diameter")
      end
    end)
  end
end)
