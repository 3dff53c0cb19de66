-- SPDX-License-Identifier: GPL-3.0-or-later
-- The summary says where a rod's edges are too long for its sharpest bend. A cable drawn taut over a box in
-- edges of 17 mm has bends of 11 mm instead of 6.3 mm and a tension 60 % too high.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local function lifted(segments)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "H07V-K 4", from = { 0, 0, 0 }, to = { 0.52, 0, 0 }, segments = segments }
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 1e-3 }
  scene:clamp(wire, { s = 0 }):follow{ points = { { 0, 0, 0 }, { 0.04, 0, 0 } }, duration = 0.3 }
  scene:clamp(wire, { s = wire.length })
  scene:obstacle{ shape = "box", size = { 0.058, 0.2, 0.058 }, at = { 0.34, 0, -0.12 }, friction = 0.4,
    rotation = { axis = { 0, 1, 0 }, angle = 0.115 } }:follow{ duration = 0.9, relative = true,
    points = { { 0, 0, 0 }, { 0.047, 0, 0.172 } } }
  local run, file = t.fine(scene:run{ dt = 0.01, duration = 1.2 }), io.tmpfile()
  run:summary(file)
  file:seek "set"
  return wire:min_bend_radius(), wire:max_tension(), file:read "a"
end

describe("a summary", function()
  it("says that edges are too long for a bend, and how many would do", function()
    local radius, tension, text = lifted(31)
    local told = tonumber(text:match "edges of 16.77 mm are too long for it; try segments = (%d+)")
    assert.truthy(told, text)
    local fine, taut, silent = lifted(told)
    assert.falsy(silent:find("too long", 1, true), silent)
    local finest, tautest = lifted(2 * told)
    t.above(1.5, radius / finest, "radius with too long edges, of the right one")
    t.above(1.4, tension / tautest, "tension with too long edges, of the right one")
    t.share(finest, fine, 0.06, "radius with as many as told [m]")
    t.share(tautest, taut, 0.06, "tension with as many as told [N]")
  end)
end)
