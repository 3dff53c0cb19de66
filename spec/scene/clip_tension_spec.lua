-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tension of a wire inside a clip. Lips, floor and walls push across the wire. Without friction nothing pulls
-- along it, so T + EI k^2 / 2 (k: curvature) is the same on both sides and inside, but for its weight.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local vec = require "softworld.vec"
local t = require "spec.physics.tools"

local WIDTH, INTO, OUT = 0.012, 15, 40 -- [m], [N]

-- A wire is clamped straight on either side of a clip that has it a little beyond the top of its lips.
local function on_lips(p)
  local q = p.turn or { 1, 0, 0, 0 }
  local function at(x, y, z) return vec.rotate(q, { x, y, z }) end
  local scene, radius = sw.scene{ gravity = { 0, 0, 0 } }, sw.cable(p.cable).outer_diameter.value / 2
  local wire = scene:wire{ cable = p.cable, from = at(-0.06 + p.shift, 0, 0), to = at(0.06 + p.shift, 0, 0),
    segments = p.segments }
  local clip = scene:clip{ at = at(0, 0, -p.height * 1.5 * radius), direction = at(0, 0, 1),
    axis = at(1, 0, 0), width = WIDTH, insertion = INTO, retention = OUT, friction = 0 }
  for _, s in ipairs{ 0, wire.length } do scene:clamp(wire, { s = s }) end
  t.fine(scene:settle{})
  return wire, clip, 0.06 - p.shift, at(0, 0, 1)
end

-- Energy of the lips' top: (2/pi) INTO times the length of the outer flank.
local function top(wire) return 2 / math.pi * INTO * 1.5 * wire.radius * OUT / (INTO + OUT) end

describe("the tension of a wire on the lips of a clip", function()
  -- An energy U for each length of the wire gave the tension U chi / W more inside, chi up to 2. The sum over
  -- places W/16 apart leaves (2 pi / 16)^2 / 12 = 1.3 % of that, with U at most that of the lips' top.
  it("is that outside, at any edges, place and orientation", function()
    local random = t.random(3)
    for _, cable in ipairs{ "GXL 10", "FLRY-B 2.5" } do
      for _, segments in ipairs{ 24, 50, 120 } do
        for k, shift in ipairs{ 0, 0.0017 } do
          local wire, clip, s, up = on_lips{ cable = cable, segments = segments, shift = shift, height = 0.3,
            turn = k > 1 and t.turn(random) or nil }
          local EI, energy = wire.beam.EI, top(wire)
          local function sum(place) return wire:tension(place) + 0.5 * EI * wire:curvature(place) ^ 2 end
          local outside = sum(s - WIDTH)
          local high = math.abs(vec.dot(up, vec.sub(wire:position(s), wire:position(0))))
          t.below(0.1 * 1.5 * wire.radius, high, "way from the clamps' line [m]") -- on the top of the lips
          t.above(1e-3, t.norm(clip:force()), "push of the lips [N]")
          t.near(outside, sum(s + WIDTH), 0.013 * 2 * energy / WIDTH, "both sides [N]")
          for i = -7, 7 do
            t.near(outside, sum(s + i / 16 * WIDTH), 0.013 * 2 * energy / WIDTH,
              ("%s, %d edges, at %+d/16 of the width [N]"):format(cable, segments, i))
          end
        end
      end
    end
  end)
end)
