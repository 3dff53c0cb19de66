-- SPDX-License-Identifier: GPL-3.0-or-later
-- p:wait_until for a contact sees a touch that begins and ends within a step.
local sw = require "softworld"
local t = require "spec.physics.tools"

local HEIGHT, RADIUS, BACK = 0.05, 0.0015, 0.9 -- [m], of GXL 1.5 [m], restitution [-]

-- A cable falls level on a table and jumps. Returns when the process saw the first and the second touch [s].
local function seen(o)
  local scene = sw.scene{ name = "tap", gravity = o.gravity }
  local floor = scene:obstacle{ name = "table", shape = "plane", restitution = BACK }
  scene:wire{ name = "wire", cable = "GXL 1.5", segments = 20, from = { 0, 0, HEIGHT },
    to = { 0.1, 0, HEIGHT } }
  local times = {}
  scene:process(function(p)
    for i = 1, 2 do
      local wanted = o.force and { force = o.force, on = floor } or { contact = floor }
      times[i] = p:wait_until(wanted, { timeout = 0.4 }) and p.time or false
      p:wait(0.03)
    end
  end)
  t.fine(scene:run{ dt = o.dt, tolerance = o.tolerance })
  return times
end

describe("waiting for a contact", function()
  -- The first touch lasts 0.1 ms, in a part of a step. It was seen at the second one, after 0.28 s.
  it("ends with the step in which something touches, however short the touch", function()
    local fall = (2 * (HEIGHT - RADIUS) / 9.81) ^ 0.5
    for _, o in ipairs{ { dt = 0.02 }, { dt = 0.01 }, { dt = 0.005 }, { dt = 0.001 },
      { tolerance = 1e-5 } } do
      local times = seen(o)
      t.near(fall + 0.5 * (o.dt or 0.01), times[1], 0.5 * (o.dt or 0.01) + 1e-4, "first touch")
      t.near((1 + 2 * BACK) * fall, times[2], (o.dt or 0.01) + 0.003, "second touch")
    end
  end)

  -- 35 N for 0.1 ms, 3.6 N as a mean over 1 ms.
  it("sees the force of such a blow, as a mean over 1 ms", function()
    local fall = (2 * (HEIGHT - RADIUS) / 9.81) ^ 0.5
    for _, o in ipairs{ { dt = 0.02 }, { dt = 0.005 }, { dt = 0.001 }, { dt = 2e-4 } } do
      o.force = 2.5
      t.near(fall + 0.5 * o.dt, seen(o)[1], 0.5 * o.dt + 1e-3, "first blow")
      o.force = 5
      assert.same({ false, false }, seen(o))
    end
  end)

  it("goes on if nothing touches", function()
    assert.same({ false, false }, seen{ dt = 0.01, gravity = { 0, 0, 9.81 } })
  end)
end)
