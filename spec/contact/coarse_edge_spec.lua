-- SPDX-License-Identifier: GPL-3.0-or-later
-- A limp wire with coarse edges falls on a thin wall and hangs over its edges. The smooth curve that touches
-- them is up to 3.6 mm nearer than the chords, more than the radius. In short steps, which look little
-- further than that, these touches were not found: the wire sank in by 0.3 mm, was thrown out, and made 6 %
-- of the energy in play at steps of 0.5 and 0.1 ms (drop 9 of the ledger's check by seed 7, 9).
local sw = require "softworld"

local X, ANGLE, HEIGHT = 0.20306, 0.08294, 0.11225 -- of the wall, and of the fall [m], [rad], [m]

-- Returns the largest rise of the energy over its lowest value so far [J], and the run. turned: the scene's
-- turn about z [rad].
local function fall(dt, segments, turned)
  local c, s = math.cos(turned or 0), math.sin(turned or 0)
  local scene = sw.scene {}
  scene:obstacle { shape = "plane", friction = 0.3 }
  scene:obstacle { shape = "box", size = { 0.01, 1, 0.1 }, at = { c * X, s * X, 0.05 }, friction = 0.3,
    rotation = { axis = { 0, 0, 1 }, angle = ANGLE + (turned or 0) } }
  scene:wire { E = 5e6, density = 1500, radius = 0.0025, from = { 0, 0, HEIGHT }, to = { c, s, HEIGHT },
    segments = segments }
  local lowest, rise = scene:energy().total, 0
  scene:process(function(p)
    p:wait_until(function()
      local e = scene:energy().total
      lowest = math.min(lowest, e)
      rise = math.max(rise, e - lowest)
      return scene.time >= 0.4
    end)
  end)
  return rise, scene:run { dt = dt }
end

describe("a limp wire on the edges of a wall", function()
  for _, case in ipairs { { 5e-4, 20 }, { 2e-4, 20 }, { 1e-4, 20 }, { 5e-4, 20, 2 }, { 2e-4, 23, 1 } } do
    local dt, segments, turned = table.unpack(case)
    it(("makes no energy in steps of %g ms with %d segments, turned by %g rad"):format(1e3 * dt, segments,
      turned or 0), function()
      local rise, run = fall(dt, segments, turned)
      assert.is_true(run.ok, run.reason)
      local play = run:ledger().play
      assert.is_true(rise < 1e-3 * play, ("%.3g %%"):format(100 * rise / play)) -- measured: 0.03 % at most
      for _, e in ipairs(run.events) do
        assert.is_nil(e.text:find("more than 1 % of all", 1, true), e.text)
      end
    end)
  end
end)
