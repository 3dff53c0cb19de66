-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable is laid down by its end and has just landed when the hold stops softly. It still trembles, and the
-- last milliseconds decide which friction is left at rest: steps of 2 to 20 ms leave -0.33 to 0.95 of mu m g
-- for 0.36 to 0.57. Steps of 0.5 ms are right. An event tells it wherever the force at rest is off.
local lay = require "contact.laid_down"
local t = require "physics.tools"

local function laid(cable, mu, turn, height, dt)
  return lay({ cable = cable, mu = mu, turn = turn, height = height, length = 0.4, segments = 40,
    duration = 0.6, way = 0.1, damping = 1e-3, law = "trapezoidal", rest = 0.4 }, dt)
end

describe("a cable that has just landed when its hold stops", function()
  for k, case in ipairs{ { "FLRY-B 0.5", 0.3 }, { "GXL 1.5", 0.3 }, { "H07V-K 4", 0.2 } } do
    it("has an event if its force at rest is off: " .. case[1], function()
      for _, height in ipairs{ 0.03, 0.02, 0.04, 0.01 } do
        local fine, told = laid(case[1], case[2], k, height, 5e-4)
        assert(not told, ("%g m, 0.5 ms: an event"):format(height))
        for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
          local share, event = laid(case[1], case[2], k, height, dt)
          -- told or right: within 0.05 of mu m g, twice what steps of 0.5 and 0.1 ms differ by
          local what = ("%g m, %g ms: pull over mu N"):format(height, 1e3 * dt)
          if not event then t.near(fine, share, 0.05, what) end
        end
      end
    end)
  end

  it("has none if it only slid", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
      local _, told = laid("GXL 1.5", 0.3, 1, 0, dt)
      assert(not told, ("%g ms: an event"):format(1e3 * dt))
    end
  end)
end)
