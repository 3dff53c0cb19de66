-- SPDX-License-Identifier: GPL-3.0-or-later
-- wire:remodel takes over the calibration of a recent mesh that is the same, and only of that.
local sw = require "softworld"

local function remodelled(E, args)
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  local wire = scene:wire { E = E, nu = 0.35, density = 1200, radius = 0.006, from = { 0, 0, 0 },
    to = { 0.1, 0, 0 }, segments = 20 }
  wire:remodel(args)
  return tostring(wire:calibration()), scene
end

local meshes = { { model = "radial", spacing = 0.002 }, { model = "tube", spacing = 0.003 },
  { model = "cubic", spacing = 0.002 }, { model = "radial", spacing = 0.002, squeeze = 2e6 },
  { model = "radial", spacing = 0.0025 }, { model = "radial", body = "solid", spacing = 0.006 } }

describe("wire:remodel, of wires that become the same mesh again,", function()
  it("has the same calibration, also after many others", function()
    local first = {}
    for i, args in ipairs(meshes) do first[i] = remodelled(2e7, args) end
    for i = #meshes, 1, -1 do
      assert.equal(first[i], remodelled(2e7, meshes[i]))
      assert.equal(first[i], remodelled(2e7, meshes[i])) -- of the mesh just made
    end
  end)

  it("has that of the wire, not of another one that is softer", function()
    for _, args in ipairs(meshes) do
      assert.not_equal(remodelled(2e7, args), remodelled(1e7, args))
    end
  end)

  it("keeps it after the first wire's scene is gone", function()
    local before, scene = remodelled(2e7, meshes[1])
    scene:close()
    collectgarbage()
    assert.equal(before, remodelled(2e7, meshes[1]))
  end)
end)
