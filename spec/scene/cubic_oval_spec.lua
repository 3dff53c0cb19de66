-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ovalisation of a section of cubes, whose outline has steps although the section is round.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local r, L = 0.005, 0.015

-- Two plates come closer until the wire between them has this share of its width; angle: how its cubes are
-- turned about its axis [rad].
local function pressed(args, angle, share)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  args.E, args.nu, args.density, args.radius = 2e6, 0.4, 1100, r
  args.from, args.to, args.normal = { 0, 0, 0 }, { L, 0, 0 }, { 0, math.sin(angle), math.cos(angle) }
  local wire = scene:wire(args)
  local before = wire:max_ovalisation{ now = true }
  scene:force{ kind = "damping", on = wire, mass = 20 }
  for side = -1, 1, 2 do
    local plate = scene:obstacle{ shape = "box", size = { 0.05, 0.05, 0.01 },
      at = { L / 2, 0, side * (r + 0.0051) } }
    plate:follow{
      points = { { 0, 0, 0 }, { 0, 0, -side * (1e-4 + (1 - share) * r) } }, duration = 0.3, relative = true }
  end
  assert(scene:run{ duration = 0.4, dt = 0.01, frames = false }.ok)
  return before, wire:section(L / 2).ovalisation, (wire:max_ovalisation{ now = true })
end

describe("ovalisation of a round section of cubes", function()
  for _, angle in ipairs{ 0, 0.4 } do
    it(("is none at rest, and that of finer cubes between plates, turned by %g rad"):format(angle), function()
      local before, coarse, most = pressed({ model = "cubic", body = "solid" }, angle, 0.9)
      local _, fine = pressed({ model = "cubic", body = "solid", across = 6 }, angle, 0.9)
      print(("measured: %.3g, %.4f, of finer cubes %.4f"):format(before, coarse, fine))
      assert.is_near(0, before, 1e-9)
      assert.is_near(fine, coarse, 0.12 * fine) -- the coarse section is wider at its corners: 0.09
      assert.is_true(most >= 0.999 * coarse)
    end)
  end

  it("is none in a wire of springs at rest, and none after it has been turned and bent", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ model = "cubic", E = 2e6, density = 1100, radius = r, from = { 0, 0, 0 },
      to = { 2 * L, 0, 0 } }
    local clamp = scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 2 * L }):pose({ 1.98 * L, 0, 0.002 }, { axis = { 1, 0, 0 }, angle = 0.5 })
    assert.is_near(0, (wire:max_ovalisation{ now = true }), 1e-9)
    assert(scene:settle().ok and clamp.held)
    local oval = wire:max_ovalisation{ now = true }
    print(("measured: %.4f"):format(oval))
    assert.is_true(oval < 0.01)
  end)
end)
