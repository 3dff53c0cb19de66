-- SPDX-License-Identifier: GPL-3.0-or-later
-- Invalid objects of particles are refused, with a message that names the fault.
local sw = require "softworld"
local nets = require "spec.scene.nets"

local net = nets.net
local core = sw.core

describe("particles", function()
  local good = { positions = { 0, 0, 0, 1, 0, 0, 2, 0, 0 }, masses = 1 }
  local nan, huge = 0 / 0, math.huge
  local cases = {
    { "no particle", { positions = {} } },
    { "which is not a multiple of 3", { positions = { 1, 2 } } },
    { "must be finite", { positions = { 0, 0, nan } } },
    { "must be finite", { positions = { 0, 0, huge } } },
    { "got string x", { positions = { 0, 0, "x" } }, "got string" },
    { "must be {x, y, z}", { positions = { { 0, 0 } } } },
    { "in [-1e9, 1e9]", { positions = { 0, 0, 1e12 } } },
    { "mass 1 = -1 kg", { masses = -1 } },
    { "mass 1 = 0 kg", { masses = 0 } },
    { "mass 2 = -3 kg", { masses = { 1, -3, 1 } } },
    { "2 items for 3", { masses = { 1, 1 } } },
    { "mass 1 = ", { masses = nan } },
    { "must be a list", { links = 3 } },
    { "names particle 4", { links = { { 1, 4, k = 1 } } } },
    { "from 1 on", { links = { { 0, 1, k = 1 } } } },
    { "from 1 on", { links = { { 1.5, 1, k = 1 } } } },
    { "twice", { links = { { 1, 1, k = 1 } } } },
    { "k is required", { links = { { 1, 2 } } } },
    { "k = -1 N/m", { links = { { 1, 2, k = -1 } } } },
    { "k = inf", { links = { { 1, 2, k = nan } } } },
    { "rest = 0 m", { links = { { 1, 2, k = 1, rest = 0 } } } },
    { "yield = -1", { links = { { 1, 2, k = 1, yield = -1 } } } },
    { "hardening = -1", { links = { { 1, 2, k = 1, yield = 1, hardening = -1 } } } },
    { "did you mean 'rest'", { links = { { 1, 2, k = 1, rset = 0 } } } },
    { "must name 2 particles", { links = { { 1, 2, 3, k = 1 } } } },
    { "which is not a multiple of 2", { links = { { pairs = { 1, 2, 3 }, k = 1 } } } },
    { "k must have 2 items, got 1", { links = { { pairs = { 1, 2, 2, 3 }, k = { 1 } } } } },
    { "links 1 and 2 both join particles 1 and 2", { links = { { 1, 2, k = 1 }, { 2, 1, k = 2 } } } },
    { "at the same place", { positions = { 0, 0, 0, 0, 0, 0, 1, 0, 0 }, links = { { 1, 2, k = 1 } } } },
    { "stiffness is required", { folds = { { 1, 2, 3 } } } },
    { "stiffness = 0", { folds = { { 1, 2, 3, stiffness = 0 } } } },
    { "twice", { folds = { { 1, 2, 1, stiffness = 1 } } } },
    { "must name 6 or 8 particles", { elements = { { 1, 2, E = 1, nu = 0 } } } },
    { "give mu and lambda", { elements = { { hexes = {} }, { prisms = { 1, 2, 3, 1, 2, 3 } } } } },
    { "or a list of edges", { surface = "all" } },
    { "{i, j} or {i, j, k}", { surface = { { 1 } } } },
    { "names particle 9", { surface = { { 1, 2, 9 } } } },
    { "radius is required", { radius = false } },
    { "distance is required", { repel = { stiffness = 1 } } },
    { "stiffness", { repel = { distance = 1, stiffness = -1 } } },
    { "did you mean 'links'", { link = {} } },
  }
  for _, case in ipairs(cases) do
    it("are refused: " .. case[1], function()
      local scene = sw.scene{}
      local args = { radius = 0.01 }
      for k, v in pairs(good) do args[k] = v end
      for k, v in pairs(case[2]) do args[k] = v end
      if args.radius == false then args.radius = nil end
      local ok, message = pcall(scene.particles, scene, args)
      assert.is_false(ok)
      assert.is_truthy(message:find(case[3] or case[1], 1, true), message)
      assert.are.equal(0, #core.data(scene).particles)
      assert.is_truthy(scene:particles{ positions = { 0, 0, 0 }, masses = 1, radius = 1 })
    end)
  end

  it("refuse elements that are inside out or have a negative modulus", function()
    local scene = sw.scene{}
    local corners = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1 }
    local function make(nodes, E)
      nodes.E, nodes.nu = E or 1, 0.3
      return scene:particles{ positions = corners, masses = 1, elements = { nodes } }
    end
    assert.are.equal(6, make{ 1, 2, 3, 4, 5, 6 }.count)
    assert.has_error(function() make{ 1, 3, 2, 4, 6, 5 } end)
    assert.has_error(function() make({ 1, 2, 3, 4, 5, 6 }, -1) end)
  end)

  it("refuse invalid particle numbers in later calls", function()
    local scene = sw.scene{}
    local object = net(scene, 3)
    assert.has_error(function() object:particle(0) end)
    assert.has_error(function() object:particle(10) end)
    assert.has_error(function() object:particle(nan) end)
    assert.has_error(function() object:set_velocity{ 1, 2 } end)
    assert.has_error(function() object:set_velocity{ 1, 2, 3, 4 } end)
    for _, list in ipairs{ {}, { 10 }, { 0 }, { 1, 1 }, { 1.5 }, 7 } do
      assert.has_error(function() scene:hold(object, { particles = list }) end)
    end
    scene:hold(object, { particles = { 1, 2 } })
    assert.has_error(function() scene:hold(object, { particles = { 2, 3 } }) end)
    assert.has_error(function()
      scene:force{ kind = "push", on = object, particles = { 10 }, force = { 0, 0, 1 } }
    end)
    assert.are.equal(1, #core.data(scene).holds)
  end)

  it("raise an error once their scene is closed, and in another scene", function()
    local scene = sw.scene{}
    local object = net(scene, 3)
    scene:close()
    assert.has_error(function() object:positions() end)
    assert.is_truthy(tostring(object):find "closed")
    local other = sw.scene{}
    assert.has_error(function() other:hold(object, { particles = { 1 } }) end)
  end)

  it("name the object that is torn apart", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local object = net(scene, 3, { name = "net" })
    local v = object:velocities()
    v[3 * 9] = 1e4
    object:set_velocity(v)
    local run = scene:run{ duration = 0.1, dt = 0.01 }
    assert.is_false(run.ok)
    assert.is_truthy(run.reason:find "net", run.reason)
    assert.has_error(function() object:positions() end)
  end)
end)
