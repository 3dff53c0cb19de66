-- SPDX-License-Identifier: GPL-3.0-or-later
-- Events about orders that replace another one, in runs for error bars: each level begins at the state from
-- which the run began, with its orders.
local sw = require "softworld"

-- Returns the number of events `replaced`. before: number of orders to the ball before the run.
local function replaced(before)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ E = 1e7, density = 1000, radius = 0.002, from = { 0, 0, 0 }, to = { 0.3, 0, 0 },
    segments = 8 }
  scene:clamp(wire, { s = 0 })
  local hold = scene:clamp(wire, { name = "end", s = 0.3 })
  local ball = scene:obstacle{ name = "ball", shape = "sphere", radius = 0.01, at = { 0, 0, 1 } }
  local motion = { points = { { 0, 0, 0 }, { 0, 0, 0.01 } }, relative = true, duration = 0.1 }
  for _ = 1, before do ball:follow(motion) end
  scene:process(function(p)
    ball:follow(motion)
    p:wait(0.1)
    hold:follow(motion)
    p:wait(0.1)
  end)
  local run = scene:run{ dt = 0.01, tolerance = { ["end.peak_force"] = 0.1 }, levels = 3 }
  assert.is_true(run.ok, run.reason)
  local count = 0
  for _, e in ipairs(run.events) do count = count + (e.kind == "replaced" and 1 or 0) end
  return count
end

describe("an order that replaces another, in a run for error bars", function()
  it("is not told of orders of another level", function() assert.equal(0, replaced(0)) end)
  it("is told of an order before the run", function() assert.equal(1, replaced(1)) end)
end)
