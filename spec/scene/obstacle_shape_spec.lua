-- SPDX-License-Identifier: GPL-3.0-or-later
-- Obstacles give their shape and its triangles; energies of the first frame.
local sw = require "softworld"

local tetrahedron = [[
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
]]

describe("obstacle", function()
  it("gives its shape, until it is removed", function()
    local scene = sw.scene {}
    local mesh = scene:obstacle { shape = "mesh", data = tetrahedron, format = "obj", at = { 5, 0, 0 } }
    local vertices, indices = mesh.shape:triangles()
    assert.are.equal(12, #vertices)
    assert.are.equal(12, #indices)
    assert.are.equal("box", scene:obstacle { shape = "box", size = { 1, 1, 1 } }.shape:kind())
    mesh:remove()
    assert.error(function() return mesh.shape end)
  end)

  it("gives pictures the triangles of a mesh, with indices from 0", function()
    local scene = sw.scene {}
    scene:wire { E = 1e9, density = 1000, radius = 0.001, from = { 0, 0, 3 }, to = { 1, 0, 3 } }
    scene:obstacle { shape = "mesh", data = tetrahedron, format = "obj" }
    local drawn = scene:run { duration = 0.01 }:document().obstacles[1]
    local lowest, highest = math.huge, -math.huge
    for _, corner in ipairs(drawn.indices) do
      lowest, highest = math.min(lowest, corner), math.max(highest, corner)
    end
    assert.are.equal(0, lowest)
    assert.are.equal(3, highest)
  end)
end)

describe("the first frame", function()
  it("holds the energies of the start, with grips in place", function()
    local scene = sw.scene {}
    local wire = scene:wire { E = 5e7, density = 1500, radius = 0.0025,
      from = { 0, 0, 0 }, to = { -1, 0, 0 } }
    scene:grip(wire, { s = 0.03, width = 0.02 })
    scene:run { duration = 0.1 }
    local energy = scene:frame(1).energy
    assert.are.equal(0, energy.kinetic)
    assert.is_true(math.abs(energy.elastic) < 1e-12) -- straight and unstressed
  end)
end)
