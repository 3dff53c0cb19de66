-- SPDX-License-Identifier: GPL-3.0-or-later
-- What every wire model, hold and shape must fulfil, over the registries.
local sw = require "softworld"
local samples = require "contract.samples"

local G = 9.81
local MASS = 0.1 -- mass of 1 m of the sample wire [kg]

local function near(expected, value, tolerance, what)
  local size = math.max(1, math.abs(expected))
  assert.is_true(math.abs(value - expected) <= tolerance * size,
    ("%s%.12g instead of %.12g"):format(what and what .. ": " or "", value, expected))
end

for _, model in ipairs(samples.registry.models) do
  describe("wire model " .. model.name, function()
    it("rests where it was made", function()
      local scene, wire = samples.wire{ segments = 9, model = model.name }
      local before = wire:positions()
      local run = scene:run{ duration = 0.1 }
      assert.is_true(run.ok)
      near(0, samples.norm(samples.along(before, wire:positions(), -1)), 1e-12)
      near(0, scene:energy().total, 1e-15)
    end)

    it("has the mass it was given", function()
      local scene, wire = samples.wire{ segments = 9, model = model.name }
      wire:set_velocity{ 3, 0, 4 }
      near(0.5 * MASS * 25, scene:energy().kinetic, 1e-12)
      scene:gravity{ 0, 0, -G }
      scene:run{ duration = 0.2 } -- falls freely, as a whole
      near(4 - 0.2 * G, wire:velocity(0.41)[3], 1e-9)
      near(0, wire:max_tension(), 1e-9)
    end)

    it("hangs with its weight on the clamp", function()
      local scene, wire = samples.wire{ segments = 9, model = model.name, gravity = { 0, 0, -G } }
      local clamp = scene:clamp(wire, { s = 0, direction = { 0, 0, -1 } })
      assert.is_true(scene:settle().ok)
      local force = clamp:force()
      near(0, force[1], 1e-7)
      near(MASS * G, force[3], 1e-7)
      assert.is_true(wire:position(1)[3] < -0.9)
    end)

    it("gives its length, ends and energies", function()
      local scene, wire = samples.wire{ segments = 9, model = model.name }
      if not model.mesh then assert.are.equal(9, wire.segments) end
      near(1, wire.length, 1e-15)
      near(0, samples.norm(wire:position(0)), model.mesh and 1e-17 or 0)
      near(1, wire:position(wire.length)[1], 1e-15)
      near(1, wire:tangent(0.5)[1], 1e-15)
      local sum, energy = 0, scene:energy()
      for kind, value in pairs(energy) do
        if kind ~= "total" then sum = sum + value end
      end
      near(energy.total, sum, 1e-15)
      assert.has_error(function() wire:position(-0.001) end)
      assert.has_error(function() wire:position(1.001) end)
      assert.has_error(function() wire:position(0 / 0) end)
    end)

    it("keeps its arc length on a bent path", function()
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local points = {}
      for i = 0, 600 do -- finer than the slices of any mesh, which lie as drawn
        points[#points + 1] = { math.sin(i / 300), 1 - math.cos(i / 300), 0 }
      end
      local args = samples.values(model.name)
      args.path, args.segments = points, not model.mesh and 20 or nil
      local wire = scene:wire(args)
      near(2, wire.length, 1e-3)
      -- Edges are unstressed. Springs of a bent mesh follow chords; the scale of that effect is EA times
      -- the square of the outer strain, 60 N times 0.05^2.
      -- Bending of a string pulls with EI curvature^2 (spec/force/flex_spec.lua), here of a polygon: 1e-3.
      local bent = model.name == "string" and wire.beam.EI * wire:curvature(1) ^ 2 or 0
      near(bent, wire:tension(1), model.mesh and 0.1 * 60 * 0.05 ^ 2 or math.max(1e-12, 1e-3 * bent))
      near(1, wire:curvature(1), 2e-2) -- bent by force: the path is not its rest shape
    end)
  end)
end

-- Arguments of a hold. A slider's rail has friction that holds the weight and the swings of these wires.
local function hold_arguments(hold)
  local args = { s = 0.37 }
  for _, row in ipairs(hold.params) do
    if row.name == "width" then args.width = 0.1 end
    if row.name == "path" then args.direction, args.friction = { 0, 1, 0 }, 0.1 end
  end
  return args
end

for _, hold in ipairs(samples.registry.holds) do
  describe("hold " .. hold.name, function()
    local function make(segments)
      local scene, wire = samples.wire{ segments = segments or 10, gravity = { 0, 0, -G } }
      return scene, wire, scene[hold.name](scene, wire, hold_arguments(hold))
    end

    it("holds its place exactly, on any mesh", function()
      for _, segments in ipairs{ 2, 3, 7, 10, 31 } do
        local scene, wire, handle = make(segments)
        near(0.37, handle:pose()[1], 1e-12)
        local run = scene:run{ duration = 0.2 }
        assert.is_true(run.ok, run.reason)
        local p = wire:position(0.37)
        near(0.37, p[1], 1e-9, segments .. " segments")
        near(0, p[3], 1e-9)
        assert.are.equal(hold.name, handle.kind)
        assert.is_true(handle.held)
      end
    end)

    it("carries the weight at rest", function()
      local scene, _, handle = make()
      scene:force{ kind = "damping", mass = 6 }
      local run = scene:run{ duration = 6, dt = 0.02 }
      assert.is_true(run.ok, run.reason)
      near(MASS * G, handle:force()[3], 1e-3)
    end)

    it("follows a motion and stops", function()
      local scene, wire, handle = make()
      local duration = handle:follow{ points = { { 0, 0, 0 }, { 0.05, 0, 0.1 } }, speed = 0.5,
        relative = true }
      scene:run{ duration = duration }
      local p = wire:position(0.37)
      near(0.42, p[1], 1e-9)
      near(0.1, p[3], 1e-9)
      handle:follow(nil)
      scene:run{ duration = 0.1 }
      near(0.1, wire:position(0.37)[3], 1e-9)
    end)

    it("keeps its rotation when only its place is set", function()
      local _, _, handle = make()
      local place = handle:pose()
      handle:pose(place, { axis = { 0, 1, 0 }, angle = 0.2 })
      local rotation = select(2, handle:pose())
      near(math.cos(0.1), rotation[1], 1e-15)
      handle:pose{ place[1], 0, 0.01 }
      assert.are.same(rotation, select(2, handle:pose()))
      handle:pose(place, { 1, 0, 0, 0 })
      assert.are.same({ 1, 0, 0, 0 }, select(2, handle:pose()))
    end)

    it("is released once, for good", function()
      local scene, wire, handle = make()
      handle:release()
      handle:release()
      assert.is_false(handle.held)
      assert.has_error(function() handle:force() end)
      assert.has_error(function() handle:pose{ 0, 0, 0 } end)
      assert.has_error(function() handle:follow(nil) end)
      assert.are.equal("table", type(handle:pose()))
      assert.is_truthy(tostring(handle):find "released")
      scene:run{ duration = 0.1 }
      near(-0.5 * G * 0.01, wire:position(0.37)[3], 1e-2)
    end)

    it("refuses places that are held or not on the wire", function()
      local scene, wire = make()
      for _, s in ipairs{ 0.37, 1.01, -0.1, 1 / 0, 0 / 0 } do
        local args = hold_arguments(hold)
        args.s = s
        assert.has_error(function() scene[hold.name](scene, wire, args) end)
      end
      assert.are.equal(1, #sw.core.data(scene).holds)
    end)

    it("gives its arguments as finite numbers only", function()
      local _, _, handle = make()
      local function finite(value)
        if type(value) == "table" then for _, v in pairs(value) do finite(v) end end
        if math.type(value) == "float" then assert.is_true(value - value == 0) end
      end
      assert.are.equal("table", type(handle:get()))
      finite(handle:get())
    end)

    it("has a name and a text, and refuses unknown fields", function()
      local scene, wire = make()
      local args = hold_arguments(hold)
      args.s, args.name = 0.8, "the other"
      local other = scene[hold.name](scene, wire, args)
      assert.are.equal("the other", other.name)
      assert.is_truthy(tostring(other):find "'the other'")
      assert.has_error(function() other.nonsense = 1 end)
    end)
  end)
end

for _, shape in ipairs(samples.registry.shapes) do
  describe("obstacle " .. shape.name, function()
    local function make()
      local scene = samples.wire{ segments = 5 }
      local args = samples.obstacle(shape)
      args.at = { 1, 2, 30 }
      return scene, scene:obstacle(args)
    end

    it("is made from its rows, placed, moved and removed", function()
      local scene, obstacle = make()
      assert.are.same({ 1, 2, 30 }, obstacle:pose())
      assert.are.same({ 0, 0, 0 }, obstacle:force())
      obstacle:pose({ 3, 2, 40 }, { axis = { 0, 0, 1 }, angle = 0.5 })
      local place, rotation = obstacle:pose()
      assert.are.same({ 3, 2, 40 }, place)
      near(math.cos(0.25), rotation[1], 1e-15)
      obstacle:pose{ 4, 2, 40 } -- its rotation stays
      assert.are.same({ 4, 2, 40 }, obstacle:pose())
      assert.are.same(rotation, select(2, obstacle:pose()))
      assert.is_true(scene:run{ duration = 0.02 }.ok)
      obstacle:remove()
      assert.has_error(function() obstacle:pose() end)
      assert.is_truthy(tostring(obstacle):find "removed")
      local run = scene:run{ duration = 0.02 }
      assert.is_true(run.ok)
      run:document() -- the series of what was removed are still there
    end)

    it("has a name, a text and a kind", function()
      local _, obstacle = make()
      assert.are.equal(shape.name .. "1", obstacle.name)
      assert.is_truthy(tostring(obstacle):find(shape.name, 1, true))
      assert.are.equal(shape.name, obstacle.shape:kind())
    end)
  end)
end
