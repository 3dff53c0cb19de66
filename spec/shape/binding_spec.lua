-- SPDX-License-Identifier: GPL-3.0-or-later
-- Making shapes from Lua: errors, life cycle, memory.
local core = require "softworld.core"
local samples = require "contract.samples"
local tools = require "shape.tools"

local function refused(text, ...)
  local fine, message = pcall(...)
  assert.is_false(fine)
  assert.is_truthy(message:find(text, 1, true), message)
end

describe("core.shape", function()
  it("names object, parameter, value, unit and range in errors", function()
    local cases = {
      { { shape = "cylnder" }, "did you mean 'cylinder'?" },
      { { shape = 3 }, "obstacle: shape = number is not one of: plane, sphere" },
      { {}, "obstacle: shape is required" },
    }
    for _, case in ipairs(cases) do refused(case[2], core.shape, case[1]) end
    for _, kind in ipairs(samples.registry.shapes) do
      assert.is_true(#kind.wrong > 0, kind.name)
      for _, wrong in ipairs(kind.wrong) do
        refused(wrong.message, core.shape, samples.obstacle(kind, wrong.args))
      end
    end
    refused("one table", core.shape)
    refused("one table", core.shape, "box")
  end)

  it("checks the arguments of the queries", function()
    local box = core.shape { shape = "box", size = { 1, 1, 1 } }
    refused("shape:distance: point", box.distance, box)
    refused("shape:distance: point, item 2,", box.distance, box, { 1, "x", 3 })
    refused("shape:distance: reach must be a number [m]", box.distance, box, { 1, 2, 3 }, {})
    refused("shape:segment: second end", box.segment, box, { 1, 2, 3 }, { 1, 2, 0 / 0 })
    refused("must be at least 0 m", box.sweep, box, { 0, 0, 2 }, { 0, 1, 2 }, { 0, 0, 0 },
      { 0, 1, 0 }, -1)
    refused("shape expected", box.kind, 3)
  end)

  it("lists kinds and their parameters", function()
    local names = {}
    for i, kind in ipairs(samples.registry.shapes) do names[i] = kind.name end
    assert.same(names, core.shape_params())
    for _, kind in ipairs(core.shape_params()) do
      for _, row in ipairs(core.shape_params(kind)) do
        assert.is_true(#row.doc > 0 and #row.unit > 0)
      end
    end
    refused("there is no shape 'cone'", core.shape_params, "cone")
  end)

  it("closes cleanly and says so", function()
    local sphere = core.shape { shape = "sphere", radius = 1 }
    assert.equal("sphere", sphere:kind())
    assert.equal("shape: sphere", tostring(sphere))
    sphere:close()
    sphere:close()
    refused("the shape has been closed", sphere.kind, sphere)
    assert.equal("shape (closed)", tostring(sphere))
  end)

  it("gives bounds, and no triangles where there are none", function()
    local low, high = core.shape({ shape = "capsule", radius = 1, length = 2 }):bounds()
    assert.same({ -1, -1, -2 }, low)
    assert.same({ 1, 1, 2 }, high)
    low, high = core.shape({ shape = "plane" }):bounds()
    assert.same({ -math.huge, -math.huge, -math.huge }, low)
    assert.same({ math.huge, math.huge, 0 }, high)
    local vertices, indices = core.shape({ shape = "plane" }):triangles()
    assert.same({ {}, {} }, { vertices, indices })
    for _, around in ipairs { 0, 4, 30, 1028 } do
      refused("must be a multiple of 4 in [8, 1024]", function()
        core.shape({ shape = "sphere", radius = 1 }):triangles(around)
      end)
    end
  end)

  it("frees everything, whichever request for memory fails", function()
    local points, triangles = tools.box_triangles(1, 1, 1)
    local recipes = {
      { shape = "plane" },
      { shape = "box", size = { 1, 1, 1 } },
      { shape = "hull", points = points },
      { shape = "mesh", data = tools.stl_binary(points, triangles), format = "stl" },
    }
    for _, recipe in ipairs(recipes) do
      collectgarbage()
      collectgarbage()
      local before = core.allocated()
      local n, shape = 0, nil
      repeat
        n = n + 1
        core.fail_allocation(n)
        local fine, made = pcall(core.shape, recipe)
        core.fail_allocation(0)
        if fine then
          shape = made
        else
          assert.is_truthy(made:find("memory", 1, true) or made:find("not readable", 1, true), made)
          collectgarbage()
          assert.equal(before, (core.allocated()), recipe.shape .. " request " .. n)
        end
      until shape or n > 100
      assert.is_not_nil(shape, recipe.shape)
      assert.is_true(core.allocated() > before)
      shape:close()
      assert.equal(before, (core.allocated()))
    end
  end)

  it("uses no memory in queries", function()
    for _, shape in ipairs(tools.every_kind()) do
      local _, before = core.allocated()
      shape:distance { 0.1, 0.2, 0.9 }
      shape:segment({ -1, 0.1, 0.4 }, { 1, 0.1, 0.5 }, 10)
      shape:sweep({ -1, 0.1, 2 }, { 1, 0.1, 2 }, { -1, 0.1, -2 }, { 1, 0.1, -2 }, 0.01)
      local _, after = core.allocated()
      assert.equal(before, after)
    end
  end)

  it("refuses wrong shapes without keeping anything", function()
    collectgarbage()
    collectgarbage()
    local before = core.allocated()
    for _ = 1, 50 do
      pcall(core.shape, { shape = "hull", points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 } })
      pcall(core.shape, { shape = "mesh", data = "rubbish", format = "stl" })
      pcall(core.shape, { shape = "box", size = { 0, 0, 0 } })
    end
    collectgarbage()
    assert.equal(before, (core.allocated()))
  end)
end)
