-- SPDX-License-Identifier: GPL-3.0-or-later
-- A gripper turns stiff rods fast. Its moment is I times the angular acceleration, however stiff the rod
-- and however fine its mesh.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L, MASS, ANGLE, DURATION = 0.2, 0.05, math.pi, 0.5

-- Returns the angular acceleration of a minimum-jerk turn, angle(t) = ANGLE (10 x^3 - 15 x^4 + 6 x^5), x =
-- t / DURATION [rad/s2].
local function acceleration(time)
  local x = time / DURATION
  return ANGLE / DURATION ^ 2 * (60 * x - 180 * x ^ 2 + 120 * x ^ 3)
end

local function turned(EI, segments, axis, along)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 1e6, EI = EI, GJ = EI, mass_per_length = MASS, radius = 0.004,
    segments = segments, from = { 0, 0, 0 }, to = { L * along[1], L * along[2], L * along[3] } }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function()
    hand:grasp(wire, { s = L / 2 })
    hand:rotate{ axis = axis, angle = ANGLE, duration = DURATION }
  end)
  return scene, hand
end

describe("a stiff rod that is turned fast", function()
  local inertia, peak = MASS * L ^ 3 / 12, 0
  for i = 0, 50 do peak = math.max(peak, inertia * acceleration(0.01 * i)) end

  -- If a step counts as solved when no edge turns by more than 0.02 rad in the last update, the moment of a
  -- stiff hinge is wrong by EI / l times the square of an update: by 21 times its peak here.
  for _, case in ipairs{ { 1, 20 }, { 40, 4 }, { 40, 20 }, { 40, 80 } } do
    local EI, segments = case[1], case[2]
    for name, way in pairs{ level = { { 0, 0, 1 }, { 1, 0, 0 } },
      askew = { { 1 / 3, 2 / 3, -2 / 3 }, { 2 / 3, 1 / 3, 2 / 3 } } } do
      it(("%s, EI = %g N m2, %d segments"):format(name, EI, segments), function()
        local scene, hand = turned(EI, segments, way[1], way[2])
        for _ = 1, 4 do
          local run = scene:run{ duration = 0.1, dt = 0.01 }
          assert.is_true(run.ok, run.reason)
          assert.are.equal(0, #run.events)
          local moment, along = hand:moment(), 0
          for k = 1, 3 do along = along + moment[k] * way[1][k] end
          t.near(inertia * acceleration(scene.time), along, 0.12 * peak, "moment")
          t.below(0.05, run:ledger().gap / run:ledger().play, "gap")
        end
      end)
    end
  end
end)
