-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires and obstacles that are added to a scene which has run, a little inside each other: the wires come
-- out at 5 mm/s, as those of a new scene do. Before, their way out counted as energy from nowhere: events
-- `energy` from 10 um on, and at 0.3 mm a failed run.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH = 0.1 -- [m]

-- A wire lies on the floor. Then another one comes, `sunk` deep in the floor, or a table whose top is as much
-- higher than the floor under a wire beside it. Returns the force on what the wire lies in, at most and at
-- the end, over the weight, how far it rose [m], and the number of events.
local function added(o, sunk, dt)
  local scene, r = sw.scene{}, sw.cable(o.cable).outer_diameter.value / 2
  local c, s = math.cos(o.turn or 0), math.sin(o.turn or 0)
  local function wire(y, z, model)
    return scene:wire{ cable = o.cable, model = model, section = model and o.section,
      from = { -s * y, c * y, z }, to = { LENGTH * c - s * y, LENGTH * s + c * y, z } }
  end
  local floor = scene:obstacle{ shape = "plane", friction = 0.3, name = "floor" }
  wire(0.05, r)
  local later, on = nil, floor
  if o.table then later = wire(0, r, o.model) end
  t.fine(scene:run{ dt = 0.01, duration = 0.1 })
  if o.table then
    on = scene:obstacle{ shape = "box", size = { 1, 0.06, 0.1 }, at = { 0, 0, sunk - 0.05 },
      rotation = { axis = { 0, 0, 1 }, angle = o.turn or 0 }, friction = 0.3, name = "table" }
  else
    later = wire(0, r - sunk, o.model)
  end
  local from = later:position(LENGTH / 2)[3]
  local run = t.fine(scene:run{ dt = dt, duration = 0.2 })
  local weight = 9.81 * LENGTH * sw.cable(o.cable).mass_per_length.value
  local below = o.table and 0 or weight -- the other wire's
  local peak, last = on:over(0.1).peak_force - below, -on:force()[3] - below
  local rise = later:position(LENGTH / 2)[3] - from
  scene:close()
  return peak / weight, last / weight, rise, #run.events
end

describe("a wire that is inside an obstacle, of which one was added late,", function()
  for k, o in ipairs{
    { cable = "GXL 1.5", model = "rod" }, { cable = "H07V-K 10", model = "rod", turn = 0.7 },
    { cable = "GXL 1.5", model = "tube" }, { cable = "FLRY-B 0.5", model = "rod", turn = 2 },
    { cable = "GXL 1.5", table = true, turn = 0.4 },
    -- Its particles have no skin: the table was not there for them, they lay on under it, without an event.
    { cable = "GXL 1.5", table = true, turn = 1, model = "radial", section = "solid" },
    { cable = "FLRY-B 0.5", table = true },
  } do
    it(("comes out slowly: %d, %s"):format(k, o.cable), function()
      for _, sunk in ipairs{ 1e-5, 1e-4, 3e-4 } do
        for _, dt in ipairs{ 0.02, 0.01, 0.001 } do
          local what = (" of %g mm in steps of %g ms"):format(1e3 * sunk, 1e3 * dt)
          local peak, last, rise, events = added(o, sunk, dt)
          assert.equal(0, events)
          t.near(1, last, 1e-3, "force at the end" .. what)
          -- 5 mm/s are reached within the window of 10 ms: 0.005/(9.81 0.01) = 0.05 of the weight more
          t.below(1.07, peak, "force" .. what)
          -- Touches are up to 0.4 % of the radius deep.
          t.near(sunk, rise, 2e-6, "way out" .. what)
        end
      end
    end)
  end
end)
