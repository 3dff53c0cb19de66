-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable that swings about a slider with friction. Above some friction the slide locks (dynamic jamming):
-- the place sticks and slips at the rate of waves along the wire, and short steps give another way and other
-- peaks than long ones. An event tells; below that friction all steps agree, and there is none.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Returns the peak force [N], the last place [m] and the events `jam` of 0.8 s.
local function swing(friction, dt)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 30 }
  scene:force{ kind = "damping", on = wire, mass = 0.5, stiffness = 1e-3 }
  local slider = scene:slider(wire, { s = 0, direction = { 1, 0, 0.3 }, friction = friction })
  local run = scene:run{ duration = 0.8, dt = dt, frames = false }
  t.fine(run)
  local jams = {}
  for _, e in ipairs(run.events) do
    if e.kind == "jam" then jams[#jams + 1] = e end
  end
  return slider:over().peak_force, slider:place(), jams
end

describe("a cable that swings about a slider", function()
  it("has the same peak and way at any step, if friction does not lock", function()
    local force, place, jams = swing(0.15, 0.0005)
    assert.are.equal(0, #jams)
    for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002, 0.001 } do
      local F, p, told = swing(0.15, dt)
      t.share(force, F, 0.02, ("peak force at %g s"):format(dt))
      t.share(place, p, 0.005, ("place at %g s"):format(dt))
      assert.are.equal(0, #told, ("events at %g s"):format(dt))
    end
  end)

  -- Regression: peaks of 0.155 to 0.37 N and ways of 0.47 to 0.56 m, and no event.
  it("tells where friction locks", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005 } do
      local _, _, jams = swing(0.35, dt)
      assert.is_true(#jams > 0, ("an event at %g s"):format(dt))
      assert.is_true(jams[1].value > 0.8)
      assert.are.equal("slider1", jams[1].object)
    end
  end)
end)
