-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads push a mesh that they squeeze on a table as hard whenever they come. The section widens down into the
-- table, and V is k_section times the way that the table takes from it. A wire that lay there before the
-- gripper came had touches as stiff as its weight asked for, and kept them: V was 0.013 N at 10 and 2.5 ms,
-- 0.054 N at 0.5 ms, 0.30 N at 0.1 ms for 0.37 N, and no event said so. With a gripper from the start, where
-- all touches are new, V was right.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH = 0.06 -- [m]

-- Returns the push on the table of a wire whose gripper comes at a time, without the wire's weight [N].
local function push(o, later, dt)
  local scene, turn = sw.scene{}, o.turn or 0
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 2, stiffness = o.stiffness }
  local r = o.radius or sw.cable(o.cable).outer_diameter.value / 2
  local wire = scene:wire{ cable = o.cable, E = o.E, nu = o.E and 0.4, density = o.E and 1200, radius = r,
    model = o.model, section = o.section, segments = o.segments, from = { 0, 0, r },
    to = { LENGTH * math.cos(turn), LENGTH * math.sin(turn), r } }
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.5, opening = 2 * r + (o.wider or 2e-4) } }
  scene:process(function(p)
    if later > 0 then p:wait(later) end
    hand:grasp(wire, { s = o.s or LENGTH / 2, approach = "plates", force = o.force or 2 })
    p:wait(0.02)
  end)
  t.fine(scene:run{ dt = dt })
  local force = -hand:force()[3]
  scene:close()
  return force
end

describe("pads that come to a mesh that lies on a table", function()
  for k, o in ipairs{
    { cable = "GXL 1.5", model = "tube" },
    { cable = "GXL 1.5", model = "radial", turn = 0.7, s = 0.02, stiffness = 1e-3 },
    { cable = "GXL 0.5", model = "tube", turn = 0.3, force = 1 },
    { E = 1e7, radius = 0.003, model = "radial", section = "solid", segments = 10, force = 8, wider = 1e-3 },
  } do
    it(("push it as hard as pads that were there: %d, %s"):format(k, o.cable or o.model), function()
      local fine = push(o, 0, 5e-4)
      t.above(0.1, fine, "push by far more than the weight [N]")
      for _, later in ipairs{ 0.0013, 0.1 } do
        for _, dt in ipairs{ 0.01, 0.0025 } do
          -- Touches are ten sections stiff or more, see squeezed_mesh_spec: 1 - 1/(1 + 1/10)
          local what = ("push, %g s later, at %g ms"):format(later, 1e3 * dt)
          t.share(fine, push(o, later, dt), 1 - 1 / 1.1, what)
        end
      end
    end)
  end
end)
