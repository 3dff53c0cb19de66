-- SPDX-License-Identifier: GPL-3.0-or-later
-- The surface of a solid mesh. Its particles reach further out than the wire's radius, so that as a beam it
-- is as stiff as the wire. Whatever touches it meets the wire's own radius.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, pi = 0.004, math.pi

local function make(scene, args)
  local p = { body = "solid", E = 2e6, nu = 0.4, density = 1200, radius = R, from = { 0, 0, 0 },
    to = { 0.08, 0, 0 } }
  for k, v in pairs(args) do p[k] = v end
  return scene:wire(p)
end

describe("the surface of a solid mesh", function()
  it("is at the wire's radius on average over all directions, and so is its outline", function()
    for _, args in ipairs{ { model = "radial" }, { model = "radial", particles = 24, layers = 3 },
      { model = "cubic" }, { model = "cubic", across = 8 }, { model = "composite" },
      { model = "radial", from = { 0.1, 0.2, 0.3 }, to = { 0.12, 0.17, 0.35 } } } do
      local wire = make(sw.scene{}, args)
      local c, sum, n = wire:section(wire.length / 2), 0, 360
      local u, v = c.least_direction, {}
      for k = 1, 3 do -- across both
        local i, j = k % 3 + 1, (k + 1) % 3 + 1
        v[k] = c.tangent[i] * u[j] - c.tangent[j] * u[i]
      end
      for k = 1, n do
        local x, y, way = math.cos(2 * pi * k / n), math.sin(2 * pi * k / n), {}
        for i = 1, 3 do way[i] = x * u[i] + y * v[i] end
        sum = sum + c:width(way)
      end
      t.share(2 * R, sum / n, 1e-4, "mean width") -- of sums over directions
      local far = 0
      for _, p in ipairs(c.outline) do far = far + t.distance(p, c.middle) / #c.outline end
      -- corners of as few as eight sides are 3 % further out than their mean
      t.share(R, far, 0.035, "corners of the outline")
    end
  end)

  it("lies on tables, boxes and edges at its radius", function()
    for _, obstacle in ipairs{ { shape = "plane" },
      { shape = "box", size = { 0.2, 0.1, 0.02 }, at = { 0.04, 0, -0.01 } },
      { shape = "box", size = { 0.01, 0.1, 0.02 }, at = { 0.04, 0, -0.01 } } } do
      local scene = sw.scene{ gravity = { 0, 0, -9.81 } }
      local wire = make(scene, { model = "radial", particles = 24, layers = 2, E = 2e7,
        from = { 0.02, 0, R }, to = { 0.06, 0, R } })
      obstacle.friction = 0.3
      scene:obstacle(obstacle)
      t.fine(scene:settle())
      -- a side of 24 is 0.9 % nearer than a corner; both are half of that from the mean
      t.near(R, wire:position(0.02)[3], 0.006 * R, obstacle.shape)
    end
  end)

  it("is where pads begin to press, whichever way they come", function()
    for _, turned in ipairs{ 0, 0.1, pi / 4 } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      scene:force{ kind = "damping", mass = 50 }
      local wire = make(scene, { model = "radial", particles = 24, layers = 3 })
      local g = scene:gripper{ pads = { opening = 3 * R, width = 0.01, friction = 0.3 },
        at = { 0.04, 0, 0 }, rotation = { math.cos(turned / 2), math.sin(turned / 2), 0, 0 } }
      scene:process(function()
        g:grasp(wire, { s = 0.04, approach = "plates", distance = 2.02 * R })
        assert.equal(0, g:state().squeeze)
        g:close_jaws{ distance = 1.98 * R }
        t.above(0, g:state().squeeze, "force")
      end)
      local run = scene:run{ dt = 0.005 }
      assert(run.ok, run.reason)
    end
  end)
end)
