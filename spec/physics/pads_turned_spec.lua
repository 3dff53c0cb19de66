-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that are turned against a cable close on it. They bend it, and it slides between them until friction
-- locks. A micrometre that it slid less is a tenth of a newton more along the cable to its clamp.
-- Regression: from the first touch to the wanted force it took a few steps, each of which moved the jaws by
-- 0.04 to 0.4 mm. In 160 random runs 40 peaks of the gripper's force were more than 15 % off.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local CABLES = { "GXL 1.5", "GXL 0.5", "FLRY-B 2.5", "FLRY-B 0.5" }

local function draw()
  local r = math.random
  return { cable = CABLES[r(#CABLES)], segments = r(20, 60), damped = r() < 0.3, both = r() < 0.4,
    at = 0.04 + 0.14 * r(), off = r() < 0.5 and 0 or (r() - 0.5) * 0.003, yaw = 0.6 * (r() - 0.5),
    friction = 0.3 + 0.5 * r(), force = 1 + 9 * r() }
end

-- Returns the peak of the gripper's force [N].
local function peak(p, dt)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = p.cable, segments = p.segments, from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
  if p.damped then scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 } end
  scene:clamp(wire, { s = 0 })
  if p.both then scene:clamp(wire, { s = 0.3 }) end
  local hand = scene:gripper{ at = { p.at, p.off, 0 }, rotation = { axis = { 0, 0, 1 }, angle = p.yaw },
    pads = { opening = 0.0125, friction = p.friction } }
  scene:process(function(q)
    hand:grasp(wire, { s = p.at, approach = "plates", force = p.force })
    q:wait(0.05)
  end)
  t.fine(scene:run{ dt = dt })
  return hand.peak_force
end

describe("pads turned against a cable", function()
  -- Fine steps move the jaws by 4 um, less than the 5 um of a part; in five of six scenes peaks of finer
  -- steps are within 4 % of them. Peaks below 0.02 N, 2 % of the least squeeze, are left out. Where the cable
  -- locks is chance in some scenes, so a share of the peaks may be off: measured 0.03 and 0.11, before 0.23
  -- and 0.22. SHARE is twice the mean.
  local SHARE, OFF, LEAST = 0.14, 0.15, 0.02
  for _, seed in ipairs{ 11, 23 } do
    it("lock the same force in at all steps, seed " .. seed, function()
      math.randomseed(seed)
      local off, runs = 0, 0
      for _ = 1, 24 do
        local p = draw()
        local fine = peak(p, 2e-4)
        for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
          if fine > LEAST then
            runs = runs + 1
            if math.abs(peak(p, dt) / fine - 1) > OFF then off = off + 1 end
          end
        end
      end
      t.above(40, runs, "runs with a force")
      t.below(SHARE, off / runs, ("share of %d peaks more than 15 %% off"):format(runs))
    end)
  end
end)
