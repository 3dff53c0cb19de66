-- SPDX-License-Identifier: GPL-3.0-or-later
-- wire:folded() reports voxels of springs that were pressed through themselves.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r = 0.01

local function squeeze(options, share)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local args = { E = 1e7, density = 1200, radius = r, from = { 0, 0, 0 }, to = { 0.05, 0, 0 },
    segments = 10 }
  for key, value in pairs(options) do args[key] = value end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", mass = 20 }
  local function plate(z)
    return scene:obstacle{ shape = "box", size = { 0.2, 0.2, 2 * r }, at = { 0.025, 0, z },
      friction = 0.3 }
  end
  plate(-2 * r)
  plate(2 * r):follow{ points = { { 0, 0, 0 }, { 0, 0, -2 * r * share } }, duration = 1,
    relative = true }
  return wire, t.fine(scene:run{ duration = 1, dt = 0.005 })
end

describe("wire:folded", function()
  it("reports where and when voxels of springs have folded, and so does the summary", function()
    local wire, run = squeeze({ model = "cubic" }, 0.4)
    local s, when = wire:folded()
    assert.is_true(s >= 0 and s <= wire.length)
    assert.is_true(when > 0.5 and when < 1)
    local text = {}
    run:summary{ write = function(self, ...)
      for _, part in ipairs{ ... } do text[#text + 1] = part end
      return self
    end }
    assert.is_truthy(table.concat(text):find "FOLDED")
  end)

  it("reports nothing where no voxel has folded", function()
    for _, options in ipairs{ { model = "cubic" }, { model = "tube" }, { model = "radial" } } do
      assert.is_nil((squeeze(options, 0.1):folded()))
    end
    assert.is_nil((squeeze({ model = "radial", section = "solid" }, 0.3):folded()))
    local scene = sw.scene{}
    assert.is_nil(scene:wire{ E = 1e7, density = 1200, radius = r, from = { 0, 0, 0 },
      to = { 0.1, 0, 0 } }:folded())
  end)
end)
