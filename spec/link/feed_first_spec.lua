-- SPDX-License-Identifier: GPL-3.0-or-later
-- A feed with a force holds a wire that is drawn straight and begins without scene:settle. From the first
-- instant on its drive has the asked force: this is what its speed is searched for. What is logged was the
-- mean over the first step, whose stages before the end had less force: 0.04 to 0.8 of the asked one.
local sw = require "softworld"
local t = require "physics.tools"

-- Returns the part of a feed's first logged force along its direction [N].
local function first_along(run, direction)
  local sum, found = 0, 0
  for _, column in ipairs(run:series().columns) do
    local axis = column.name:match "^feed%.force_([xyz])$"
    if axis then
      sum, found = sum + column.values[1] * direction[axis], found + 1
    end
  end
  t.near(3, found, 0, "columns of the feed's force")
  return sum
end

describe("a feed with a force", function()
  for name, d in pairs{ level = { 1, 0, 0 }, downwards = { 0, 0, -1 }, upwards = { 0, 0, 1 },
    askew = { 0.48, 0.6, -0.64 } } do
    it("logs the asked force from the first step on: " .. name, function()
      for _, cable in ipairs{ "FLRY-B 0.5", "H07V-K 4" } do
        for _, dt in ipairs{ 0.02, 0.005, 5e-4 } do
          for k, share in ipairs{ -0.5, -1, 0.3 } do
            local scene, far = sw.scene{}, { 0.3 * d[1], 0.3 * d[2], 0.3 * d[3] }
            local ends = { { 0, 0, 0 }, far }
            local last = k == 2 -- the feed is at the wire's other end
            local wire = scene:wire{ cable = cable, from = ends[last and 2 or 1], to = ends[last and 1 or 2],
              segments = 20 }
            scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
            local weight = wire.beam.mass_per_length * 9.81 * wire.length
            scene:feed(wire, { s = last and wire.length or 0, force = share * weight, name = "feed" })
            if k == 3 then scene:clamp(wire, { s = wire.length }) end
            local run = scene:run{ dt = dt, duration = 0.02 }
            t.fine(run)
            local f = first_along(run, { x = d[1], y = d[2], z = d[3] })
            -- The search stops at 1e-7 of the weight. In a first step of 0.5 us a place of 0.3 m that is
            -- rounded by 6e-17 m is a force of EA 1e-3 s 6e-17 m / (15 mm 0.5 us) = 3 uN of the dashpots,
            -- 2e-5 of the weight; a few of these add up.
            t.near(math.abs(share) * weight, math.abs(f), 1e-3 * weight,
              ("%s, dt = %g s, %g of the weight [N]"):format(cable, dt, share))
          end
        end
      end
    end)
  end
end)
