-- SPDX-License-Identifier: GPL-3.0-or-later
-- What every force must fulfil, over the whole registry: a new force is covered by its file and its line in
-- list.def. Forces that users make get arguments from their rows; inner forces are tested in the wire
-- models that use them.
local sw = require "softworld"
local samples = require "contract.samples"

local along, dot, norm, apart = samples.along, samples.dot, samples.norm, samples.apart

-- Central differences with step H lose about 1e-16/H to rounding, and H^2 times the next derivative, which
-- sharp and yielding hinges make large.
local H = 3e-6

local TOLERANCE = 2e-7
local EXACT = 1e-11 -- sums and rotations: rounding only
local SIZE = 1e-3 -- smaller forces count as this when errors are compared [N]

local shapes = {
  { name = "stretched", stretch = 1.15, turn = 0.3 },
  { name = "slack", stretch = 0.8, turn = 0.5 },
  { name = "sharp, beyond 60 degrees", stretch = 1.1, turn = math.rad(75) },
  { name = "sharper, 120 degrees", stretch = 0.85, turn = math.rad(120) },
}

local counts = { 2, 3, 4, 7, 16 }
local function subject_is_wire(object) return samples.type(object) == "wire" end

-- Positions of a mesh of particles in a shape: stretched, and shaken by up to a twentieth of a slice per
-- radian of the shape's turn.
local function mesh_shape(wire, shape, random)
  local slice = subject_is_wire(wire) and wire.length / wire.segments or 0.04
  return samples.shaken(wire, shape.stretch, 0.05 * slice * shape.turn, random)
end

-- Bends a wire in two planes, far enough for a force with memory to keep a trace.
local function used(scene, wire, share)
  for _, pull in ipairs{ { 0, 3, 9 }, { 0, 9, -2 } } do
    local clamp = sw.core.type(wire) == "particles" and scene:hold(wire, { particles = { 1 } })
      or scene:clamp(wire, { s = 0 })
    local force = scene:force{ kind = "line", on = wire,
      force = along({ 0, 0, 0 }, pull, share or 1) }
    local run = scene:run{ duration = 0.3, dt = 0.01 }
    assert(run.ok, run.reason)
    force:release()
    clamp:release()
  end
end

-- Returns each way to meet a force: { name, kind, make = function(segments) -> scene, wire }, and the kinds
-- met.
local function subjects()
  local list, met = {}, {}
  for _, model in ipairs(samples.registry.models) do
    local bend = model.name == "tube" or nil -- a tube with bend also has folds
    local scene, wire = samples.wire{ segments = 4, model = model.name, bend = bend }
    for kind in pairs(scene:evaluate(wire)) do
      met[kind] = true
      list[#list + 1] = { name = kind .. " of " .. model.name, kind = kind, inner = true,
        mesh = model.mesh, make = function(segments)
          return samples.wire{ segments = segments, model = model.name, gravity = { 1, -2, -9 },
            bend = bend }
        end }
    end
  end
  -- Parts that slide: without friction, all stuck, and some slipping. There are few elements, so that the
  -- differences rarely meet the place where one begins to slip.
  for _, how in ipairs{ { "free", 0, 0 }, { "stuck", 100, 1e6 }, { "slipping", 0.3, 60 } } do
    local more = { bonded = false, core = "line", particles = 3, to = { 0.2, 0, 0 },
      friction = how[2], grip = how[3] }
    local function make() return samples.wire{ model = "composite", more = more } end
    list[#list + 1] = { name = "slide of composite, " .. how[1], kind = "slide", inner = true,
      mesh = true, make = make }
    list[#list + 1] = { name = "slide of composite, " .. how[1] .. ", after use", kind = "slide",
      mesh = true, make = function()
        local scene, wire = make()
        used(scene, wire, 0.3) -- small enough for its section to keep its shape
        return scene, wire
      end }
  end
  met.slide = true
  -- The wall of a hollow tube, as drawn and pulled out of round.
  local function walled()
    return samples.wire{ segments = 3, model = "tube",
      more = { core = false, wall_bending = 0.7, particles = 8 } }
  end
  list[#list + 1] = { name = "crease of tube", kind = "crease", inner = true, mesh = true, make = walled }
  met.crease = true
  for index, force in ipairs(samples.registry.forces) do
    if not force.inner then
      met[force.name] = true
      local function make(segments)
        local scene, wire = samples.wire{ segments = segments }
        -- few springs, so that the differences rarely meet the place where one yields
        if force.of_web then wire = samples.sheet(scene) end
        local args = samples.force(force, index)
        args.on = wire
        scene:force(args)
        return scene, wire
      end
      list[#list + 1] = { name = force.name, kind = force.name, mesh = force.of_web, make = make }
      if force.name == "damping" then -- its springs of a mesh differ from a rod's
        list[#list + 1] = { name = "damping of tube", kind = force.name, mesh = true,
          make = function()
            local scene, wire = samples.wire{ model = "tube" }
            scene:force{ kind = "damping", on = wire, mass = 0.3, stiffness = 0.1 }
            return scene, wire
          end }
      end
      if force.history then
        list[#list + 1] = { name = force.name .. " after use", kind = force.name, mesh = force.of_web,
          make = function(segments)
            local scene, wire = make(segments)
            used(scene, wire)
            return scene, wire
          end }
      end
    end
  end
  table.sort(list, function(a, b) return a.name < b.name end)
  return list, met
end

local list, met = subjects()
local declared = {}
for _, f in ipairs(samples.registry.forces) do declared[f.name] = f end

-- Calls check(ask, x, v, random, what) for every shape and count. ask(x, v, more) returns the force's
-- answer there.
local function everywhere(subject, check)
  for _, shape in ipairs(shapes) do
    for _, segments in ipairs(subject.mesh and { 2 } or counts) do
      local random = samples.random(segments * 100 + #shape.name)
      local scene, wire = subject.make(segments)
      local x = subject.mesh and mesh_shape(wire, shape, random) or
        samples.shape(segments, shape.stretch, shape.turn, random)
      local v = samples.flat(#x, 1, random)
      local function ask(positions, velocities, more)
        local q = { positions = positions, velocities = velocities }
        for k, value in pairs(more or {}) do q[k] = value end
        return scene:evaluate(wire, q)[subject.kind]
      end
      check(ask, x, v, random, ("%s, %d segments"):format(shape.name, segments))
      scene:close()
    end
  end
end

local function small(value, limit, what)
  assert.is_true(value <= limit, ("%s: %.3g is above %.3g"):format(what, value, limit))
end

describe("the force registry", function()
  it("is covered as a whole", function()
    for name, force in pairs(declared) do
      -- a user's function is tested in force_cases_spec.lua, frames in spec/physics/frames_spec.lua
      assert.is_true(met[name] or (force.inner and force.explicit) or name == "frame",
        name .. " is in no wire model and cannot be made by scene:force")
    end
  end)

  it("has a summary of every force, and at most one class: dissipative, explicit or driven", function()
    for name, force in pairs(declared) do
      assert.is_true(#force.summary > 10, name)
      local kinds = (force.dissipative and 1 or 0) + (force.explicit and 1 or 0) + (force.driven and 1 or 0)
      assert.is_true(kinds <= 1, name)
    end
  end)
end)

for _, subject in ipairs(list) do
  local force = declared[subject.kind]
  describe("force " .. subject.name, function()
    if not force.dissipative and not force.driven and not force.explicit then
      it("is minus the derivative of its energy", function()
        everywhere(subject, function(ask, x, v, random, what)
          local f = ask(x, v).force
          for _ = 1, 3 do
            local d = samples.flat(#x, 1, random)
            local slope = (ask(along(x, d, H), v).energy - ask(along(x, d, -H), v).energy) / (2 * H)
            small(math.abs(slope + dot(f, d)) / math.max(norm(f) * norm(d), SIZE), TOLERANCE, what)
          end
        end)
      end)

      it("keeps its memory while it is evaluated", function()
        if not force.history then return end
        for _, segments in ipairs(subject.mesh and { 2 } or counts) do
          local scene, wire = subject.make(segments)
          local x = wire:positions()
          local before = scene:evaluate(wire)[subject.kind]
          scene:evaluate(wire, { positions = subject.mesh and mesh_shape(wire, shapes[1], samples.random(3))
            or samples.shape(segments, 1, 1, samples.random(3)) })
          assert.are.same(before, scene:evaluate(wire)[subject.kind])
          assert.are.same(x, wire:positions())
        end
      end)

      it("does not depend on velocities", function()
        everywhere(subject, function(ask, x, v, _, what)
          local a, b = ask(x, v), ask(x, samples.zeros(#x))
          assert.are.same(a.force, b.force, what)
          assert.are.equal(a.energy, b.energy)
        end)
      end)

      if not force.frozen then
        it("has the derivative of its force as stiffness", function()
          everywhere(subject, function(ask, x, v, random, what)
            local d = samples.flat(#x, 1, random)
            local product = ask(x, v, { direction = d }).product
            local plus, minus = ask(along(x, d, H), v).force, ask(along(x, d, -H), v).force
            local slope = {}
            for i = 1, #x do slope[i] = (minus[i] - plus[i]) / (2 * H) end
            small(apart(product, slope, SIZE), TOLERANCE, what)
          end)
        end)
      end
    end

    it("has a symmetric stiffness", function()
      everywhere(subject, function(ask, x, v, random, what)
        local a, b = samples.flat(#x, 1, random), samples.flat(#x, 1, random)
        local ka = ask(x, v, { direction = a, rate = 10 }).product
        local kb = ask(x, v, { direction = b, rate = 10 }).product
        small(math.abs(dot(ka, b) - dot(kb, a)) / math.max(norm(ka) * norm(b), SIZE), EXACT, what)
      end)
    end)

    if force.dissipative then
      it("is zero at rest and takes power from a moving wire", function()
        everywhere(subject, function(ask, x, v, _, what)
          assert.are.equal(0, norm(ask(x, samples.zeros(#x)).force), what)
          local still = ask(x, v)
          assert.is_true(dot(still.force, v) < 0, what)
          assert.are.equal(0, still.energy)
        end)
      end)
    end

    if force.driven then
      it("has no energy, and its power is in the ledger", function()
        everywhere(subject, function(ask, x, v, _, what) assert.are.equal(0, ask(x, v).energy, what) end)
        local scene, wire = subject.make(4)
        scene:clamp(wire, { s = 0 })
        local ledger = scene:run{ duration = 0.2, dt = 1e-3 }:ledger()
        assert.is_true(ledger.work.forces ~= 0)
        small(math.abs(ledger.lost.integrator) / math.abs(ledger.work.forces), 0.01, "unexplained")
      end)
    end

    if force.dissipative or force.driven then
      it("adds the rate times its damping to the stiffness", function()
        everywhere(subject, function(ask, x, v, random, what)
          local d, rate = samples.flat(#x, 1, random), 50
          local with = ask(x, v, { direction = d, rate = rate }).product
          local without = ask(x, v, { direction = d }).product
          local added = along(with, without, -1)
          assert.is_true(dot(added, d) >= 0, what)
          if force.frozen and not force.driven then return end
          local plus, minus = ask(x, along(v, d, H)).force, ask(x, along(v, d, -H)).force
          local slope = {}
          for i = 1, #x do slope[i] = rate * (minus[i] - plus[i]) / (2 * H) end
          small(apart(added, slope, SIZE), TOLERANCE, what)
        end)
      end)
    end

    if subject.inner then
      it("is zero at rest", function()
        for _, segments in ipairs(counts) do
          local scene, wire = subject.make(segments)
          scene:gravity{ 0, 0, 0 }
          -- the springs of a mesh are stiffer than a rod, and so is their rounding error
          small(norm(scene:evaluate(wire)[subject.kind].force), subject.mesh and 1e-11 or 1e-12,
            segments .. " segments")
        end
      end)

      -- without gravity, an outer force, only inner forces are left
      it("adds up to no force and no moment", function()
        everywhere({ kind = subject.kind, mesh = subject.mesh, make = function(segments)
          local scene, wire = subject.make(segments)
          scene:gravity{ 0, 0, 0 }
          return scene, wire
        end }, function(ask, x, v, _, what)
          local f = ask(x, v).force
          local total, moment = samples.resultant(x, f)
          small(norm(total) / math.max(norm(f), SIZE), EXACT, what)
          small(norm(moment) / math.max(norm(f), SIZE), EXACT, what)
        end)
      end)

      it("turns and moves with the wire", function()
        everywhere({ kind = subject.kind, mesh = subject.mesh, make = function(segments)
          local scene, wire = subject.make(segments)
          scene:gravity{ 0, 0, 0 }
          return scene, wire
        end }, function(ask, x, v, _, what)
          local here, there = ask(x, v), ask(samples.turned(x, 0.7), v)
          small(math.abs(here.energy - there.energy) / math.max(here.energy, SIZE), 1e-10, what)
          small(apart(samples.turned(here.force, 0), there.force, SIZE), 1e-10, what)
        end)
      end)
    end
  end)
end
