-- SPDX-License-Identifier: GPL-3.0-or-later
-- Friction along a wire acts at the axis of a rod, and at the surface of a mesh or of a rod that rolls. Round
-- a peg of radius R an element of a wire of radius r has the balance of moments V (R + r) = f R r (V shear
-- force, f friction per length of the surface), and so dT/dphi = f R^2 / (R + r): a mesh is drawn like a rod
-- whose friction is mu R / (R + r), if r / R is small against 1 / mu^2.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local R, r, MU, PULL = 0.01, 0.002, 0.3, 10
local ALONG_Y = { math.cos(math.pi / 4), math.sin(math.pi / 4), 0, 0 }

-- The wire's path: up, half round the peg, down.
local function round_the_peg(from)
  local path, a = {}, R + r
  for k = 0, 10 do path[#path + 1] = { -a, 0, from * (1 - k / 10) } end
  for k = 1, 40 do
    local phi = math.pi * k / 40
    path[#path + 1] = { -a * math.cos(phi), 0, a * math.sin(phi) }
  end
  for k = 1, 5 do path[#path + 1] = { a, 0, -0.01 * k } end
  return path
end

-- Ratio of the pulls at both ends of a wire that is drawn over the peg, mean over the last 0.2 s.
local function ratio(model, mu, segments, rolls)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  scene:obstacle{ shape = "cylinder", radius = R, length = 0.1, friction = mu, rotation = ALONG_Y }
  local wire = scene:wire{ E = 2e7, density = 1200, radius = r, nu = 0.4, model = model, rolls = rolls,
    segments = segments,
    path = round_the_peg(-0.06) }
  scene:force{ kind = "damping", on = wire, mass = 20, stiffness = 1e-3 }
  scene:force{ kind = "point", on = wire, s = 0, force = { 0, 0, -PULL } }
  local hold = scene:clamp(wire, { s = wire.length })
  assert(scene:run{ dt = 0.005, duration = 0.3, frames = false }.ok)
  hold:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.02 } }, relative = true, duration = 0.6, law = "linear" }
  assert(scene:run{ dt = 0.005, duration = 0.5, frames = false }.ok)
  return hold:over(0.6, 0.8).mean_force / PULL
end

describe("a thick wire drawn round a peg", function()
  it("is drawn at its surface as a mesh, at its axis as a rod", function()
    local mesh = ratio("tube", MU)
    local rod, smaller = ratio("rod", MU, 150), ratio("rod", MU * R / (R + r), 150)
    local rolls = ratio("rod", MU, 150, true)
    print(("measured: ratio of pulls: mesh %.3f, rod that rolls %.3f, rod %.3f, rod with mu R/(R + r) %.3f")
      :format(mesh, rolls, rod, smaller))
    -- Its bending keeps the wire off the peg near both ends: below exp(mu pi), and within 4 % of each other.
    assert.is_near(smaller, mesh, 0.04 * smaller)
    -- the mesh yields under the peg, so its lever is a little shorter
    assert.is_near(rolls, mesh, 0.05 * rolls)
    assert.is_near(rolls, smaller, 0.02 * smaller)
    assert.is_true(rod > 1.1 * mesh)
    assert.is_true(rod < math.exp(MU * math.pi))
  end)
end)
