-- SPDX-License-Identifier: GPL-3.0-or-later
-- Messages that lead on: an obstacle that is given an axis is turned with rotation; the spacing that is too
-- long for a mesh is the wire's length over its segments.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local function message_of(build)
  local scene <close> = sw.scene{}
  local fine, raised = pcall(build, scene)
  assert.is_true(not fine)
  return raised
end

describe("a message about a parameter that an object lacks", function()
  local shapes = { cylinder = { radius = 0.01, length = 0.1 }, torus = { radius = 0.02, tube = 0.002 },
    capsule = { radius = 0.01, length = 0.1 }, box = { size = { 1, 1, 1 } } }
  for shape, args in pairs(shapes) do
    it("tells how to turn a " .. shape, function()
      args.shape, args.axis = shape, { 0, 1, 0 }
      local text = message_of(function(scene) scene:obstacle(args) end)
      assert.is_true(text:find("no parameter 'axis'", 1, true) ~= nil, text)
      assert.is_true(text:find("rotation = { axis = { x, y, z }, angle = [rad] }", 1, true) ~= nil, text)
      assert.is_equal(shape ~= "box", text:find("its axis is z", 1, true) ~= nil)
    end)
  end

  it("turns a cylinder as it says", function()
    local scene <close> = sw.scene{}
    local peg = scene:obstacle{ shape = "cylinder", radius = 0.01, length = 0.1,
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    local _, q = peg:pose()
    assert.is_true(math.abs(q[1] - math.cos(math.pi / 4)) < 1e-12 and math.abs(q[2] - q[1]) < 1e-12)
  end)
end)

describe("a message about a mesh with too long slices", function()
  local function tube(more)
    return message_of(function(scene)
      local args = { EA = 300, EI = 2e-3, GJ = 1.5e-3, mass_per_length = 0.03, radius = 0.004,
        from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, model = "tube" }
      for key, value in pairs(more) do args[key] = value end
      scene:wire(args)
    end)
  end

  it("names segments if they were given", function()
    local text = tube{ segments = 20 }
    assert.is_true(text:find("spacing = 0.015 m must be less", 1, true) ~= nil, text)
    assert.is_true(text:find("spacing is the wire's length over segments", 1, true) ~= nil, text)
  end)

  it("does not name them if spacing was given", function()
    local text = tube{ spacing = 0.015 }
    assert.is_true(text:find("spacing = 0.015 m must be less", 1, true) ~= nil, text)
    assert.is_nil(text:find("segments", 1, true))
  end)
end)
