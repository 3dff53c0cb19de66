-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that squeeze a mesh on a table, pose by pose, push as hard as in slow motion. They hold its sides by
-- friction, and the section widens down into the table. With table touches for the wire's weight alone the
-- wire sank in, and the push was the weight of what is held: 0.07 N instead of 2.1 N.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- The table's touches are ten sections stiff in both, so that this is no difference. From pose to pose the
-- force grows by up to a fifth of the wanted one. Friction of the pose in which the touch begins acts with
-- its end's force instead of the mean one, half of that; that pose's part of V may be off by as much.
local SAME = 0.2 / 2

-- Returns the pads' push down on a wire that they hold on a table.
local function push(o, dt, speed, poses)
  local scene = sw.scene{}
  local r, turn = o.radius, o.turn
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 8, stiffness = 1e-3 }
  local wire = scene:wire{ model = "radial", section = "solid", E = o.E, nu = o.nu, density = 1200,
    radius = r, from = { 0, 0, r }, to = { 40 * r * math.cos(turn), 40 * r * math.sin(turn), r },
    segments = o.segments, layers = o.layers }
  local hand = scene:gripper{ name = "hand",
    pads = { width = 0.02, friction = 0.5, opening = 2 * r + 0.004 } }
  scene:process(function(p)
    hand:grasp(wire, { s = 20 * r + o.shift, approach = "plates", force = o.force, speed = speed })
    p:wait(0.1)
  end)
  local run = scene:run{ dt = dt, quasistatic = poses }
  assert(run.ok, "the run did not end well")
  t.share(o.force, hand:state().squeeze, 0.01, "force of a finger")
  local got = -hand:force()[3]
  scene:close()
  return got
end

describe("a mesh that pads squeeze on a table, pose by pose", function()
  for _, o in ipairs{
    { E = 1e7, nu = 0.4, radius = 0.003, segments = 12, turn = 0, shift = 0, force = 8 },
    { E = 1e8, nu = 0.4, radius = 0.003, segments = 12, turn = 0, shift = 0.001, force = 8, layers = 3 },
    { E = 1e6, nu = 0.4, radius = 0.003, segments = 12, turn = 0.5, shift = 0, force = 8 },
    { E = 1e7, nu = 0.4, radius = 0.003, segments = 13, turn = 1.2, shift = 0.002, force = 3 },
  } do
    it(("pushes as in slow motion: E = %g, %g N, turned by %g"):format(o.E, o.force, o.turn), function()
      local slow = push(o, 0.005, 0.001, false)
      local first
      for _, way in ipairs{ { 0.05, 0.02 }, { 0.02, 0.1 }, { 0.005, 0.02 } } do
        local got = push(o, way[1], way[2], true)
        t.share(slow, got, SAME, ("push in poses of %g s"):format(way[1]))
        first = first or got
        t.share(first, got, SAME, ("push in poses of %g s, beside those of 0.05 s"):format(way[1]))
      end
    end)
  end
end)
