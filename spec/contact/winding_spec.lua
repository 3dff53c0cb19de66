-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable wound on a drum against a brake. Friction keeps in the wound part the tension that it came with:
-- the brake's and what bends the cable, EI/(2 R^2) (energy per length that goes in where it comes on).
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, BRAKE, TURNS, TIME, LENGTH = 0.05, 4, 1.5, 3, 0.8 -- [m], [N], [-], [s], [m]

-- The drum turns and goes sideways by 2.5 wire radii a turn; the wire is clamped on its top.
local function wound(edges, dt)
  local other = sw.scene{}:wire{ cable = "GXL 1.5", from = { 0, 1, 0 }, to = { 1, 1, 0 }, segments = 2 }
  local r = other.radius
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local top, turned = R + r, 2 * math.pi * TURNS
  local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, top }, to = { LENGTH, 0, top },
    segments = edges }
  local drum = scene:obstacle{ shape = "cylinder", radius = R, length = 0.2, friction = 0.25,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
  scene:feed(wire, { s = 0.15, force = BRAKE })
  local along = 2.5 * r * TURNS
  scene:clamp(wire, { s = 0 }):follow(function(time)
    local u = math.min(time / TIME, 1)
    local share = u ^ 3 * (10 - 15 * u + 6 * u ^ 2) -- minimum jerk, as the drum
    local a = turned * share
    return { -top * math.sin(a), along * share, top * math.cos(a) }, { axis = { 0, 1, 0 }, angle = -a }
  end)
  drum:follow{ points = { { 0, 0, 0 }, { 0, along, 0 } }, duration = TIME, relative = true,
    turn = { axis = { 0, 1, 0 }, angle = -turned } }
  t.fine(scene:run{ duration = TIME, dt = dt })
  return wire, top
end

describe("a cable wound on a drum", function()
  -- Edges of 10 and 5 mm around 51 mm; 4.4 to 5.2 N measured. Friction locked in 273 and 184 N once: chords
  -- that roll onto the drum and stick are stretched by h^2/(12 R^2), times EA = 137 kN.
  for _, case in ipairs{ { 80, 0.01 }, { 80, 0.002 }, { 160, 0.01 } } do
    it(("has the brake's tension: %d edges, steps of %g s"):format(case[1], case[2]), function()
      local wire, top = wound(case[1], case[2])
      local bends = wire.beam.EI / (2 * top ^ 2)
      local largest = wire:max_tension()
      print(("measured: largest %.3g N, at 0.2 m %.3g N, bent %.4g m"):format(largest, wire:tension(0.2),
        1 / wire:curvature(0.2)))
      assert.is_true(largest < 1.3 * (BRAKE + bends), largest)
      for _, s in ipairs{ 0.1, 0.2, 0.3 } do
        t.share(BRAKE + bends, wire:tension(s), 0.2, "tension at " .. s)
        t.share(top, 1 / wire:curvature(s), 0.03, "radius at " .. s)
        local p = wire:position(s)
        t.share(top, (p[1] ^ 2 + p[3] ^ 2) ^ 0.5, 0.01, "distance from the axis at " .. s)
      end
    end)
  end
end)
