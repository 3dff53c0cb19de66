-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire pressed into a clip and drawn out again in poses (quasi-static steps): the wire springs over the
-- lips and comes to rest in the seat, not beyond, for any pose step.
local sw = require "softworld"
local t = require "spec.physics.tools"

local SPAN, HIGH, DOWN = 0.16, 0.035, 0.05

-- Moves the ends down past the clip within 1 s, in poses of dt [s]; dt = nil: in motion, then at rest.
-- Gravity to the side breaks the symmetry.
local function pressed(insertion, dt, side, segments)
  local scene = sw.scene { gravity = { 0, side, -9.81 } }
  local clip = scene:clip { name = "clip", at = { SPAN / 2, 0, 0 }, width = 0.01, insertion = insertion,
    retention = 3 * insertion, friction = 0.25 }
  local wire = scene:wire { E = 60e6, density = 1500, radius = 0.0025, from = { 0, 0, HIGH },
    to = { SPAN, 0, HIGH }, segments = segments }
  local ends = {}
  for k, s in ipairs { 0, SPAN } do
    ends[k] = scene:clamp(wire, { s = s })
    ends[k]:follow { relative = true, duration = 1, points = { { 0, 0, 0 }, { 0, 0, -DOWN } } }
  end
  scene:force { kind = "damping", mass = 5 }
  t.fine(scene:settle())
  local run = t.fine(scene:run { duration = 1, quasistatic = dt and true or nil, dt = dt or 0.002 })
  if not dt then t.fine(scene:run { duration = 1, dt = 0.005 }) end
  return clip, ends[1], run, scene, ends
end

describe("a wire that is pressed into a clip in poses", function()
  for _, insertion in ipairs { 0.5, 2 } do
    local _, hand = pressed(insertion, nil, 0, 32)
    local moved = hand:force()[3]
    for _, row in ipairs { { 0.1, 0, 32 }, { 0.02, 0, 32 }, { 0.02, 0.1, 32 }, { 0.02, 0, 16 } } do
      local dt, side, segments = table.unpack(row)
      it(("takes its %g N and comes to rest in the seat, dt %g s, %g m/s2 to the side, %d segments"):format(
        insertion, dt, side, segments), function()
        local clip, held, run = pressed(insertion, dt, side, segments)
        assert.is_true(clip:seated())
        -- the wire is bent over the clip's width, so its places do not all reach the lips' top at once
        t.share(insertion, clip.inserted.peak_force, 0.01, "peak of the lips")
        assert.equal(1, run.jumps)
        -- with 16 segments: edges of 10 mm bend 7 % less than edges of 5 mm
        t.share(moved, held:force()[3], segments == 32 and 0.01 or 0.1, "force of a hand")
      end)
    end
  end

  it("leaves the clip at the retention force", function()
    local clip, _, _, scene, ends = pressed(0.5, 0.02, 0, 32)
    for _, hand in ipairs(ends) do
      hand:follow { relative = true, duration = 1, points = { { 0, 0, 0 }, { 0, 0, DOWN } } }
    end
    local run = t.fine(scene:run { duration = 1, quasistatic = true, dt = 0.02 })
    assert.is_false(clip:seated())
    assert.equal(1, run.jumps)
    t.share(1.5, clip.pulled_out.peak_force, 0.01, "peak of the lips")
  end)
end)
