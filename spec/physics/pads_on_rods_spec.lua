-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads on a wire that is a line. They press along their whole width, wherever its nodes are, and what they
-- hold stays at rest.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r, E, width = 0.003, 2e7, 0.02

-- A wire on a frictionless table, between pads; calls body(p, gripper, wire) when it is grasped.
local function grasped(args, dt, body)
  local scene = sw.scene{ gravity = { 0, 0, args.weightless and 0 or -9.81 } }
  scene:obstacle{ name = "table", shape = "plane", friction = 0, at = { 0, 0, args.weightless and -1 or 0 } }
  scene:force{ kind = "damping", mass = 8 }
  local wire = scene:wire{ E = E, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r },
    to = { 0.2, 0, r }, segments = args.segments }
  local g = scene:gripper{ name = "hand", pads = { opening = 0.01, width = width } }
  scene:process(function(p)
    g:grasp(wire, { s = args.s or 0.1, approach = "plates", force = args.force,
      distance = args.distance })
    body(p, g, wire)
  end)
  return scene:run{ dt = dt }, g, scene
end

describe("pads on a rod", function()
  it("press by their width, whatever its segments and wherever its nodes", function()
    -- A round section between plates acts as a line of springs of 0.84 E per length and side. Beyond the
    -- pads' edges a round surface d deep comes out over sqrt(2 r d), which counts two thirds. Samples are
    -- at most a twelfth of the width apart; half of that is 4 %.
    local deep = 1e-4
    local expected = 0.84 * E * deep * (width + 4 / 3 * math.sqrt(2 * r * deep))
    for _, segments in ipairs{ 4, 7, 20, 40, 90 } do
      for _, s in ipairs{ 0.1, 0.0975, 0.062 } do
        local squeeze
        local run = grasped({ segments = segments, s = s, distance = 2 * (r - deep), weightless = true },
          0.005, function(p, g)
            p:wait(0.2)
            squeeze = g:state().squeeze
          end)
        assert.truthy(run.ok)
        t.share(expected, squeeze, 0.04, ("%d segments, s = %g"):format(segments, s))
      end
    end
  end)

  for _, args in ipairs{ { force = 5 }, { distance = 0.0055 } } do
    it("stay at rest with it at any step, with few refused steps: " .. next(args), function()
      -- nodes lie just on the pads' edges here
      for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.001, 0.0005 } do
        args.segments = 40
        local run, g = grasped(args, dt, function(p) p:wait(0.8) end)
        assert.truthy(run.ok)
        t.below(run.steps * 0.05 + 3, run.rejected, "steps not taken")
        local q, last = g:series(), g:state().squeeze
        for i = #q.t, 1, -1 do
          if q.t[i] < run.time - 0.5 then break end
          -- the motion from closing dies out within the first 0.3 s
          t.near(0, q.force[i][2], 1e-3 * last, "force across")
          t.share(last, q.squeeze[i], 1e-3, "squeeze")
        end
      end
    end)
  end

  it("lift it with its weight, coarse or fine", function()
    local weight = 1200 * math.pi * r ^ 2 * 0.2 * 9.81
    for _, segments in ipairs{ 4, 10, 40 } do
      local run, g = grasped({ segments = segments, force = 5 }, 0.002, function(p, g)
        g:move{ by = { 0, 0, 0.4 }, duration = 1 }
        p:wait(1)
        t.near(0, g:state().slip, 1e-5, "slip")
      end)
      assert.truthy(run.ok)
      -- swinging is less than that by then
      t.share(weight, g:over(run.time - 0.1, run.time).mean_force, 5e-3, segments .. " segments")
    end
  end)
end)
