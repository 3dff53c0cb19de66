-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire with edges longer than a post's radius falls on the top of the post. Its chords meet the rim, while
-- its smooth curve would meet the round side. Touches on the rim were placed on the curve, not on the chord:
-- the wire went in by 2.5 to 6 mm, more than its radius, with no force.
local sw = require "softworld"

local R = 0.03 -- of the post [m]

local function fall(dt, segments, tilt, turned)
  local c, s = math.cos(turned), math.sin(turned)
  local scene = sw.scene {}
  scene:obstacle { shape = "plane", friction = 0 }
  local post = scene:obstacle { shape = "cylinder", radius = R, length = 0.1, friction = 0,
    at = { 0.228 * c - 0.015 * s, 0.228 * s + 0.015 * c, 0.05 },
    rotation = { axis = { c, s, 0 }, angle = tilt } }
  scene:wire { E = 5e7, density = 1500, radius = 0.0025, from = { 0, 0, 0.206 },
    to = { c, s, 0.206 }, segments = segments }
  local run = scene:run { duration = 0.3, dt = dt }
  return run, scene:penetration(), post
end

describe("a wire that falls on the top of a post", function()
  for _, case in ipairs { { 1e-2, 20, 0.2, 0 }, { 2e-3, 20, 0.2, 0 }, { 5e-4, 20, 0.2, 1 },
    { 2e-3, 13, 0.2, 0 }, { 2e-3, 13, 0, 2 } } do
    local dt, segments, tilt, turned = table.unpack(case)
    it(("stays out of it: dt = %g ms, %d segments, post tilted by %g rad, scene turned by %g rad"):format(
      1e3 * dt, segments, tilt, turned), function()
      local run, depth, post = fall(dt, segments, tilt, turned)
      assert.is_true(run.ok, run.reason)
      assert.is_true(post:over().impulse_size > 0.005, "the wire strikes it")
      assert.is_true(depth < 1e-4, ("%.3g mm deep"):format(1e3 * depth)) -- 0.01 mm at most
    end)
  end
end)
