-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable is laid down on a table by its end, at an even speed (`law = "linear"`), so that the hold stops at
-- once while the last piece lands. Its blows decide which friction is left at rest, mu N nearly in fine
-- steps: 0.2 to -0.88 for -0.93 to -0.99 in steps of 2 to 20 ms. An event tells it wherever the force at rest
-- is off.
local sw = require "softworld"
local lay = require "contact.laid_down"
local t = require "physics.tools"

local laid = {}
for i, c in ipairs{ -- cable, friction, length, segments, height, duration, way, damping, direction
  { "GXL 1.5", 0.32, 0.29, 42, 0.027, 0.369, 0.124, 1.7e-3, 0 },
  { "FLRY-B 10", 0.44, 0.57, 28, 0.020, 0.422, 0.051, 0.7e-3, 1 },
  { "H07V-K 10", 0.36, 0.26, 34, 0.015, 0.727, 0.038, 1.9e-3, 2 },
  { "GXL 0.5", 0.41, 0.46, 51, 0.020, 0.692, 0.077, 1.9e-3, 4 },
} do
  laid[i] = { cable = c[1], mu = c[2], length = c[3], segments = c[4], height = c[5], duration = c[6],
    way = c[7], damping = c[8], turn = c[9], law = "linear" }
end

-- Returns the case without height.
local function flat(case)
  local copy = {}
  for key, value in pairs(case) do copy[key] = value end
  copy.height = 0
  return copy
end

describe("a cable that lands as its hold stops at once", function()
  for k, case in ipairs(laid) do
    it("has an event if its force at rest is off: " .. case.cable, function()
      local fine, told = lay(case, 5e-4)
      assert(not told, "0.5 ms: an event")
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
        local share, event = lay(case, dt, k % 2 == 0)
        -- told, or right: to a tenth of mu m g
        if not event then t.near(fine, share, 0.1, ("%g ms: pull over mu N"):format(1e3 * dt)) end
      end
    end)

    it("has none if it only slid: " .. case.cable, function()
      for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
        local _, told = lay(flat(case), dt, k % 2 == 1)
        assert(not told, ("%g ms: an event"):format(1e3 * dt))
      end
    end)
  end

  it("has none if it hangs from the hold over an edge", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
      local scene, r = sw.scene{}, sw.cable "FLRY-B 2.5".outer_diameter.value / 2
      scene:obstacle{ shape = "plane", friction = 0.3 }
      scene:obstacle{ shape = "box", size = { 0.02, 1, 0.06 }, at = { 0.1, 0, 0.03 }, friction = 0.3 }
      scene:force{ kind = "damping", mass = 1, stiffness = 1e-3 }
      local wire = scene:wire{ cable = "FLRY-B 2.5", from = { 0, 0, r }, to = { -0.5, 0, r }, segments = 56 }
      local hold = scene:clamp(wire, { s = 0 })
      hold:follow{ relative = true, duration = 0.6,
        points = { { 0, 0, 0 }, { 0, 0, 0.12 }, { 0.16, 0, 0.12 } } }
      t.fine(scene:run{ dt = dt, duration = 0.8 })
      hold:follow{ relative = true, duration = 0.4, law = "linear", points = { { 0, 0, 0 }, { 0.05, 0, 0 } } }
      local run = t.fine(scene:run{ dt = dt, duration = 1 })
      for _, e in ipairs(run.events) do assert(not e.text:find("forces at rest", 1, true), e.text) end
    end
  end)
end)
