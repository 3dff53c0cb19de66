-- SPDX-License-Identifier: GPL-3.0-or-later
-- A feed with a force limit pushes a cable against a tilted wall. It slips like a clutch, by the same
-- amount at all steps, and is neither driven back nor refused step after step.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LIMIT, LENGTH = 3, 0.15 -- [N], [m]

local function fed(cable, friction, dt)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0.1 }, to = { 0.06, 0, 0.1 }, segments = 6 }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
  scene:obstacle{ shape = "box", size = { 0.02, 0.4, 0.4 }, at = { 0.15, 0, 0.1 }, friction = friction,
    rotation = { axis = { 0, 1, 0 }, angle = 0.2 } }
  local feed = scene:feed(wire, { s = 0, force_limit = LIMIT })
  local pushed, way
  scene:process(function(p)
    local last = feed:feed{ length = LENGTH, speed = 0.1 }
    p:wait(0.7 * last)
    pushed, way = feed:drive_force(), feed:fed()
    p:wait(0.3 * last + 0.3)
  end)
  local run = t.fine(scene:run{ dt = dt })
  return { pushed = pushed, way = way, fed = feed:fed(), tip = wire:position(wire.length),
    refused = run.rejected / run.steps, gained = run:ledger().gained / run:ledger().play }
end

describe("a feed that pushes a cable against a wall", function()
  -- The column bears more than the limit: the wire stands and the drive slips.
  it("slips at its limit", function()
    for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4 } do
      local m, what = fed("FLRY-B 10", 0.6, dt), (" at steps of %g s"):format(dt)
      t.share(LIMIT, m.pushed, 0.01, "force [N]" .. what)
      t.near(0.07615, m.way, 2e-4, "fed [m]" .. what)
      t.near(m.way, m.fed, 2e-4, "fed at the end [m]" .. what)
      t.below(0.2, m.refused, "steps refused [-]" .. what)
      t.below(0.02, m.gained, "gained, of what is in play [-]" .. what)
    end
  end)

  -- The wall's angle is beyond that of friction: the wire slides up, and the drive slips no more.
  it("goes on where the wire gives way", function()
    for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4 } do
      local m, what = fed("GXL 1.5", 0.1, dt), (" at steps of %g s"):format(dt)
      t.share(LENGTH, m.fed, 0.01, "fed [m]" .. what)
      t.near(0.217, m.tip[3], 5e-4, "height of the end [m]" .. what)
      t.below(0.2, m.refused, "steps refused [-]" .. what)
    end
  end)

  -- The wall holds the end and the wire bows, at first against the limit.
  it("is not driven back where the end sticks", function()
    for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4 } do
      for _, friction in ipairs{ 0.3, 0.6 } do
        local m = fed("GXL 1.5", friction, dt)
        t.share(LENGTH, m.fed, 0.02, ("fed [m] at steps of %g s, friction %g"):format(dt, friction))
      end
    end
  end)
end)
