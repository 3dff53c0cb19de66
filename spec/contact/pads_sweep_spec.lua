-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads meet a mesh by its particles alone; those of elements have no skin. Pads that closed
-- past the outermost ones within a step went on to the next ones: on a FLRY-B 2.5 of radius 1.5 mm they
-- stopped 2.2 mm apart, for 3.1 mm in small steps, with its corners inside them. A swept test finds what
-- edges pass; now it looks at the particles that pads may pass too.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH = 0.06 -- [m]

-- Returns how far the pads are apart when they hold a wire [m], and their push on its table [N].
local function gripped(o, dt)
  local scene, c, s = sw.scene{}, math.cos(o.turn or 0), math.sin(o.turn or 0)
  local r = o.radius or sw.cable(o.cable).outer_diameter.value / 2
  local z = 1.03 * r -- it falls onto the table
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 20 }
  local wire = scene:wire{ cable = o.cable, E = o.E, nu = o.E and 0.4, density = o.E and 1200, radius = r,
    model = o.model, section = "solid", from = { 0, 0, z }, to = { LENGTH * c, LENGTH * s, z } }
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.5, opening = 2 * r + (o.wider or 3e-4) } }
  scene:process(function(p)
    p:wait(0.05)
    hand:grasp(wire, { s = o.s or LENGTH / 2, approach = "plates", force = o.force, speed = o.speed })
    p:wait(0.01)
  end)
  t.fine(scene:run{ dt = dt })
  local opening, force = hand:state().opening, -hand:force()[3]
  scene:close()
  return opening, force
end

describe("pads that close on a mesh of elements", function()
  for k, o in ipairs{
    { cable = "FLRY-B 2.5", model = "radial", force = 3, wider = 1.9e-4 },
    { cable = "GXL 1.5", model = "radial", force = 2, turn = 0.7, s = 0.02, wider = 1.72e-4 },
    { cable = "H07V-K 10", model = "cubic", force = 8, turn = 2, speed = 0.1 },
    { E = 5e6, radius = 0.004, model = "radial", force = 2, turn = 1, speed = 0.2 },
  } do
    it(("meet it where they meet it in small steps: %d, %s"):format(k, o.cable or o.model), function()
      local fine, push = gripped(o, 1e-3)
      for _, dt in ipairs{ 0.01, 0.0025 } do
        local what = (" at %g ms"):format(1e3 * dt)
        local opening, force = gripped(o, dt)
        -- the next corners are 30 % nearer to each other; touches are ten sections stiff or more
        t.share(fine, opening, 0.01, "distance of the pads" .. what)
        t.share(push, force, 1 - 1 / 1.1, "push on the table" .. what)
      end
    end)
  end
end)
