-- SPDX-License-Identifier: GPL-3.0-or-later
-- A free cable that lies on a turning disc, whose friction suffices to carry it, goes with the disc.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local FROM_AXIS, LENGTH = 0.15, 0.2

-- Runs a scene that is turned by o.tilt [rad] about the disc's axis, which is at o.at. Returns how far the
-- cable's middle and ends are from where the disc should carry them [m], the heat [J], and the steps.
local function carried(o, dt, tolerance)
  local scene, at, a = sw.scene{}, o.at or { 0, 0, 0 }, o.tilt or 0
  local r = sw.cable(o.cable).outer_diameter.value / 2
  local function place(x, y, angle)
    local c, s = math.cos(a + angle), math.sin(a + angle)
    return { at[1] + c * x - s * y, at[2] + s * x + c * y, at[3] }
  end
  local wire = scene:wire{ cable = o.cable, segments = 30, from = place(-LENGTH / 2, FROM_AXIS, 0),
    to = place(LENGTH / 2, FROM_AXIS, 0) }
  scene:force{ kind = "damping", stiffness = 3e-3 }
  local disc = scene:obstacle{ name = "disc", shape = "cylinder", radius = 0.5, length = 0.02,
    at = { at[1], at[2], at[3] - 0.01 - r }, friction = 0.4, kinetic_friction = o.kinetic }
  disc:follow{ turn = { axis = { 0, 0, 1 }, angle = o.angle }, duration = 3 }
  local run = t.fine(scene:run{ duration = 3, dt = dt, tolerance = tolerance, max_steps = 5000 })
  local off = 0
  for k = 0, 2 do
    local want = place((k - 1) * LENGTH / 2, FROM_AXIS, o.angle)
    local is = wire:position(k * LENGTH / 2)
    off = math.max(off, math.sqrt((is[1] - want[1]) ^ 2 + (is[2] - want[2]) ^ 2))
  end
  return off, run:ledger().lost.friction, run.steps
end

describe("a cable that lies on a turning disc", function()
  -- Before: runs failed at t = 0.5 to 2.5 s, because a slip seemed to turn round within the step. The slip
  -- at the step's start was taken with the disc's velocity where the wire was at the step's end.
  for _, o in ipairs{ { cable = "GXL 1.5", angle = 6 }, { cable = "GXL 0.5", angle = -6, tilt = 0.7 },
    { cable = "FLRY-B 2.5", angle = 6, tilt = 2, at = { 0.3, -0.2, 0.4 } },
    { cable = "H07V-K 4", angle = 6.3, tilt = -1 } } do
    it(("goes with it: %s, %g rad"):format(o.cable, o.angle), function()
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002, 0.001 } do
        local off, heat = carried(o, dt)
        t.below(1e-6, off, ("off its place [m] at %g ms"):format(1e3 * dt))
        t.below(1e-9, math.abs(heat), "heat of friction [J]")
      end
    end)
  end

  -- Before: 40 000 steps, and the run ended.
  it("goes with it in steps by tolerance", function()
    local off, _, steps = carried({ cable = "GXL 1.5", angle = 6 }, 0.02, 1e-4)
    t.below(1e-6, off, "off its place [m]")
    t.below(1000, steps, "steps")
  end)

  -- Before: it lost the friction of sticking although it did not slide, and went 1.2 m off the disc.
  it("keeps the friction of sticking where that of sliding is less", function()
    for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.001 } do
      local off = carried({ cable = "GXL 1.5", angle = 6, kinetic = 0.1 }, dt)
      t.below(1e-6, off, ("off its place [m] at %g ms"):format(1e3 * dt))
    end
  end)
end)
