-- SPDX-License-Identifier: GPL-3.0-or-later
-- Forces in cases that the contract of all forces leaves out: at clamps, over a step, as functions, added
-- up.
local sw = require "softworld"
local samples = require "contract.samples"

local along, dot, norm, apart = samples.along, samples.dot, samples.norm, samples.apart

-- Central differences with step H lose about 1e-16/H to rounding, and H^2 times the next derivative, which
-- sharp and yielding hinges make large.
local H = 3e-6

local TOLERANCE = 2e-7
local SIZE = 1e-3 -- smaller forces count as this when errors are compared [N]

local function small(value, limit, what)
  assert.is_true(value <= limit, ("%s: %.3g is above %.3g"):format(what, value, limit))
end

describe("bending at clamps", function()
  for _, model in ipairs(samples.registry.models) do
    it("is minus the derivative of its energy, model " .. model.name, function()
      for _, turn in ipairs{ 0.3, math.rad(75), math.rad(120) } do
        local scene, wire = samples.wire{ segments = 7, model = model.name }
        scene:clamp(wire, { s = 0, direction = { 0.3, 1, 0.2 } })
        scene:clamp(wire, { s = 0.52, direction = { -0.1, 0.2, 1 } })
        local random = samples.random(5)
        local n = wire.segments
        local x = model.mesh and samples.shaken(wire, 0.9, 0.002 * turn, random) or
          samples.shape(n, 0.9, turn, random)
        for kind in pairs(scene:evaluate(wire)) do
          local d = samples.flat(#x, 1, random)
          local function ask(h, more)
            local q = { positions = along(x, d, h) }
            for k, value in pairs(more or {}) do q[k] = value end
            return scene:evaluate(wire, q)[kind]
          end
          local here = ask(0, { direction = d })
          local slope = (ask(H).energy - ask(-H).energy) / (2 * H)
          small(math.abs(slope + dot(here.force, d)) / math.max(norm(here.force) * norm(d), SIZE),
            TOLERANCE, kind)
          local plus, minus, change = ask(H).force, ask(-H).force, {}
          for i = 1, #x do change[i] = (minus[i] - plus[i]) / (2 * H) end
          small(apart(here.product, change, SIZE), TOLERANCE, kind .. ": stiffness")
        end
      end
    end)
  end
end)

describe("the axial stiffness of time steps", function()
  -- A step leaves out the geometric part of pushed edges, which would make the matrix indefinite. Pulled
  -- edges keep theirs.
  it("differs from the derivative only where edges are pushed", function()
    for _, case in ipairs{ { stretch = 1.2, same = true }, { stretch = 0.8, same = false } } do
      local scene, wire = samples.wire{ segments = 6, model = "rod" }
      local random = samples.random(3)
      local x = samples.shape(6, case.stretch, 0.4, random)
      local d = samples.flat(#x, 1, random)
      local function product(statics)
        return scene:evaluate(wire, { positions = x, direction = d, statics = statics }).stretch.product
      end
      assert.are.equal(case.same, apart(product(true), product(false), SIZE) < 1e-14)
      assert.is_true(dot(product(false), d) >= 0)
    end
  end)
end)

describe("a function as a force", function()
  it("acts with the force that it sets, without stiffness", function()
    local scene, wire = samples.wire{ segments = 5 }
    scene:force{ on = wire, kind = function(t, x, v, f)
      for i = 1, #f do f[i] = f[i] - 3 * x[i] + 2 * v[i] + t end
    end }
    local random = samples.random(11)
    local x, v = samples.flat(18, 1, random), samples.flat(18, 1, random)
    local r = scene:evaluate(wire, { positions = x, velocities = v, direction = x }).callback
    for i = 1, 18 do assert.is_true(math.abs(r.force[i] - (2 * v[i] - 3 * x[i])) < 1e-14) end
    assert.are.equal(0, norm(r.product))
  end)
end)

describe("the energies of a scene", function()
  -- The scene has every kind of force: more than 24 kinds.
  it("are listed however many there are, and add up to the total", function()
    local scene, y = sw.scene{ gravity = { 0, 0, -9.81 } }, 0
    local function wire(more)
      y = y + 0.3
      local args = { EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.05, from = { 0, y, 1 },
        to = { 1, y, 1 } }
      for key, value in pairs(more) do args[key] = value end
      return scene:wire(args)
    end
    local rod = wire{ segments = 4 }
    local rolling = wire{ segments = 4, rolls = true, from = { 1, 0.3, 1 }, to = { 2, 0.3, 1 } }
    for _, more in ipairs{ { model = "string", segments = 4 }, { model = "tube" },
      { model = "tube", core = false, wall_bending = 0.7, particles = 8 },
      { model = "radial", body = "solid" },
      { model = "composite", bonded = false, core = "line", particles = 3, grip = 5 } } do
      wire(more)
    end
    local sheet = scene:particles{ positions = { 0, 0, 3, 0.1, 0, 3, 0.2, 0, 3, 0.3, 0, 3 }, masses = 0.01,
      links = { { pairs = { 1, 2, 2, 3, 3, 4 }, k = 100 } }, folds = { { 1, 2, 3, stiffness = 0.01 } },
      repel = { distance = 0.05, stiffness = 10 } }
    for index, force in ipairs(samples.registry.forces) do
      if not force.inner then
        local args = samples.force(force, index)
        args.on = (force.on_some or force.name == "plastic_springs") and sheet or rod
        if force.on_some then args.particles = { 3, 1 } end
        scene:force(args)
      end
    end
    scene:force{ kind = function() end, on = rod }
    scene:obstacle{ shape = "plane", at = { 0, 0, 0 } }
    scene:join{ ends = { { rod, s = 1 }, { rolling, s = 0 } } }
    local energy, sum, count = scene:energy(), 0, 0
    for kind, value in pairs(energy) do
      if kind ~= "total" and kind ~= "dissipated" then sum, count = sum + value, count + 1 end
    end
    assert.is_true(count > 24, count .. " kinds")
    for _, kind in ipairs{ "kinetic", "gravity", "contact", "repel", "join", "callback", "push",
      "plastic_springs", "solid", "clip", "tether" } do
      assert.is_true(energy[kind] ~= nil, kind)
    end
    assert.is_true(math.abs(sum - energy.total) < 1e-9 * math.abs(sum))
  end)
end)
