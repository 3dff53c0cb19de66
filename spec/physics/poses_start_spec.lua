-- SPDX-License-Identifier: GPL-3.0-or-later
-- The largest tension and the sharpest bend of slow handling include the equilibrium that it begins with.
local sw = require "softworld"

-- A cable settles between two clamps, drawn straight: its tension is largest, and falls as the clamps
-- approach. With `bent`, it settles with the clamps near each other, and they draw it straight: it is bent
-- most at the start. Returns the values at rest and those of a run in poses of dt.
local function values(cable, dt, bent, turned)
  local scene, length, near = sw.scene{}, 0.5, bent and 0.3 or 0.5
  local wire = scene:wire{ cable = cable, segments = 40, from = { 0, 0, 0 }, to = { length, 0, 0 } }
  local left, right = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = length })
  local hand = turned and left or right
  local function move(x, z)
    hand:follow{ relative = true, points = { { 0, 0, 0 }, { turned and -x or x, 0, z } }, duration = 1 }
  end
  if bent then
    move(near - length, 0.02)
    assert(scene:run{ duration = 1, dt = 0.02, quasistatic = true }.ok)
  end
  local rest = scene:settle()
  assert(rest.ok, rest.reason)
  local tension, radius = wire:max_tension(), wire:min_bend_radius()
  move(bent and 0.18 or -0.1, 0)
  local run = scene:run{ duration = 1, dt = dt, quasistatic = true }
  assert(run.ok, run.reason)
  local moved = { tension = wire:max_tension(), radius = wire:min_bend_radius() }
  scene:close()
  return { tension = tension, radius = radius }, moved
end

describe("the start of slow handling", function()
  -- The values are those of the same state, so they are equal but for rounding.
  for _, cable in ipairs { "GXL 1.5", "FLRY-B 0.5", "H07V-K 10" } do
    for _, dt in ipairs { 0.2, 0.05, 0.01 } do
      it(("counts for tension and bend: %s, poses of %g s"):format(cable, dt), function()
        for _, turned in ipairs { false, true } do
          local rest, moved = values(cable, dt, false, turned)
          assert.near(1, moved.tension / rest.tension, 1e-6)
          rest, moved = values(cable, dt, true, turned)
          assert.near(1, moved.radius / rest.radius, 1e-6)
        end
      end)
    end
  end
end)
