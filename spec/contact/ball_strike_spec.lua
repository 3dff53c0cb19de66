-- SPDX-License-Identifier: GPL-3.0-or-later
-- A ball, an object of one particle, strikes another ball or a fixed sphere off its centre, without friction.
-- The direction of a strike is that at the end of a step: how far off it is (manual: particles).
local sw = require "softworld"

local R, V = 0.01, 1 -- [m], [m/s]

-- Returns how far the velocity after a strike is off the formula, over the speed before it [-]. way: of the
-- ball in a step, over its radius; aside: of the centres, over 2 R; fixed: an obstacle instead of a ball.
local function off(way, aside, fixed)
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  local ball = scene:particles { name = "ball", positions = { { 0, 0, 0 } }, masses = 0.01, radius = R }
  local at = { 0.1, 2 * R * aside, 0 }
  if fixed then
    scene:obstacle { shape = "sphere", radius = R, at = at, friction = 0 }
  else
    scene:particles { name = "other", positions = { at }, masses = 0.03, radius = R }
    scene:wire_contact { friction = 0 }
  end
  ball:set_velocity { V, 0, 0 }
  assert.is_true(scene:run { duration = 0.2, dt = way * R / V }.ok)
  local n = { (1 - aside ^ 2) ^ 0.5, aside }
  local lost = V * n[1] * (fixed and 1 or 0.75)
  local _, v = ball:particle(1)
  return ((v[1] - V + lost * n[1]) ^ 2 + (v[2] + lost * n[2]) ^ 2) ^ 0.5 / V
end

describe("a ball that strikes off its centre", function()
  it("has the velocity of the formula, the nearer the shorter its way in a step", function()
    for way, bound in pairs { [0.5] = 0.14, [0.1] = 0.025, [0.02] = 0.006 } do
      local most = 0
      for _, aside in ipairs { 0.05, 0.25, 0.5 } do
        most = math.max(most, off(way, aside), off(way, aside, true))
      end
      print(("measured: way of %g R in a step: %.3f of the speed"):format(way, most))
      assert.is_true(most < bound, ("%g: %.3f"):format(way, most))
    end
  end)
end)
