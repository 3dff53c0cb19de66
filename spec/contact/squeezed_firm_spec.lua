-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mixed grasp of a mesh on a table has nearly the same forces at all steps. Pads hold the sides of the
-- section by friction, and the section widens down into the table. The last slice of a mesh lay on a softer
-- touch than the first. The grasp waited for 0.04 to 0.12 s for a steady force, with the push on the table,
-- because jaws arrive with 0 to 2 % less than their force and steps of 20 ms are rounded. Peaks were 1.18 N
-- at 20 to 5 ms, 0.98 N at 1 ms; mean forces 0.37, 0.22, 0.20, 0.18 N at 20, 10, 5, 1 ms; no event said so.
-- The manual's page `mixed` has this grasp.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH, LIFT = 0.12, 0.3 -- [m], [s]

local function lying(o)
  local scene, turn = sw.scene{}, o.turn or 0
  local r = o.cable and sw.cable(o.cable).outer_diameter.value / 2 or 0.003
  scene:force{ kind = "damping", mass = 80, stiffness = o.cable and 1e-3 }
  local from, to = { 0, 0, r }, { LENGTH * math.cos(turn), LENGTH * math.sin(turn), r }
  if o.swapped then from, to = to, from end
  local E = not o.cable and (o.E or 1e7) or nil
  local wire = scene:wire{ cable = o.cable, E = E, nu = E and 0.4, density = E and 1200, radius = r,
    from = from, to = to, segments = 12 }
  scene:obstacle{ shape = "plane", friction = 0 }
  local hand = scene:gripper{ pads = { width = 0.012, friction = 0.6, opening = 3 * r } }
  local s = o.s or LENGTH / 2
  return scene, wire, hand, { s = o.swapped and LENGTH - s or s, approach = "mixed", force = o.force or 10,
    region = not o.cable and 0.02 or nil, model = o.model, layers = o.layers }
end

-- Returns the gripper's peak and mean force [N], and the largest part of the mean that comes from the end of
-- the grasp at a step's end [N].
local function lifted(o, dt)
  local scene, wire, hand, how = lying(o)
  scene:process(function()
    hand:grasp(wire, how)
    hand:move{ by = { 0, 0, 0.02 }, duration = LIFT }
  end)
  local run = t.fine(scene:run{ dt = dt, frames = false })
  local peak, mean = hand.peak_force, hand.mean_force
  local time = run.time
  scene:close()
  return peak, mean, peak * dt / time
end

describe("a mesh that a mixed grasp squeezes on a table", function()
  for _, o in ipairs{
    {}, -- peaks were 17 % off, the mean at 20 ms by 64 %
    { turn = 0.7, s = 0.045 },
    { swapped = true, s = 0.045 },
    { E = 1e6, force = 1 },
    { E = 1e8, force = 60 },
    { layers = 3 },
    { cable = "GXL 1.5", model = "tube", force = 4 },
  } do
    local name = ("E = %g, %s"):format(o.E or 1e7, o.cable or o.model or "radial")
    it("has nearly the same peak and mean force at all steps: " .. name, function()
      local peak, mean, late = lifted(o, 5e-4)
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.001 } do
        local near_peak, near_mean, later = lifted(o, dt)
        local at = (" at %g ms"):format(1e3 * dt)
        -- friction's springs in the pads give way, most in long steps: measured 11 %
        t.share(peak, near_peak, 0.13, "peak" .. at)
        -- looks at the force are 20 ms apart, at a step's end
        t.near(mean, near_mean, 0.08 * mean + late + later, "mean force" .. at)
      end
    end)
  end

  it("lies on its last slice as firmly as on its first", function()
    for _, dt in ipairs{ 0.01, 0.001 } do
      local scene, wire, hand, how = lying{}
      local before, after
      scene:process(function() hand:grasp(wire, how) end)
      scene:process(function(p)
        p:wait(0.1) -- the pads do not touch yet
        before, after = wire:position(0.055)[3], wire:position(0.065)[3]
      end)
      t.fine(scene:run{ dt = dt })
      t.near(before, after, 3e-7, "height of the mesh on both sides [m]") -- was 1.6 um at 10 ms
      scene:close()
    end
  end)
end)
