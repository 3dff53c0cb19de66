-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable laid across another one, above a table, comes to rest on the crossing and one of its ends. Its
-- yaw about the crossing is nearly neutral: pseudo-transient steps a million times the first one carried it
-- to and fro by micrometres. 6 of 108 such settles ended "not at rest" after 4000 iterations, 12 more took
-- 400 or more. Rest is checked by motion: nothing may move in 0.4 s.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local CABLES = { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" }

-- across: how far the upper cable's ends are from one another along the lower one [m]
local function crossed(lower, upper, segments, across, swapped)
  local s = sw.scene{}
  s:obstacle{ shape = "plane", friction = 0.3 }
  local r = sw.cable(lower).outer_diameter.value / 2
  local from, to = { 0, 0, r }, { 0.4, 0, r }
  if swapped then from, to = to, from end
  s:wire{ cable = lower, segments = segments, from = from, to = to }
  local w = s:wire{ cable = upper, name = "upper", segments = 20, from = { 0.1, -0.08, 0.008 },
    to = { 0.1 + across, 0.08, 0.008 } }
  s:wire_contact{ friction = 0.3 }
  return s, w
end

local function moved(from, to)
  local most = 0
  for i = 1, #from do most = math.max(most, math.abs(to[i] - from[i])) end
  return most
end

describe("a cable across another one", function()
  for _, lower in ipairs(CABLES) do
    it("settles on the crossing and on the table: on " .. lower, function()
      for _, upper in ipairs(CABLES) do
        for _, segments in ipairs{ 20, 47 } do
          for _, across in ipairs{ 0, 0.03 } do
            for _, swapped in ipairs{ false, true } do
              local s, w = crossed(lower, upper, segments, across, swapped)
              local what = (": %s, %d edges, %g m, %s"):format(upper, segments, across, swapped)
              local result = t.fine(s:settle())
              t.below(2000, result.iterations, "iterations" .. what)
              local rest = w:positions()
              s:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
              t.fine(s:run{ duration = 0.4, dt = 0.005 })
              t.below(2e-6, moved(rest, w:positions()), "moves after it has settled [m]" .. what)
            end
          end
        end
      end
    end)
  end
end)
