-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that are meshes of particles touch other wires: what they bear, friction, blows, steps, turned
-- scenes, saving, and walls of one tube.
local sw = require "softworld"
local t = require "physics.tools"

local G, R, r = 9.81, 0.005, 0.003

-- Turns points about the vertical, so that meshes lie askew to the axes.
local function turned(angle)
  local c, s = math.cos(angle), math.sin(angle)
  return function(x, y, z) return { c * x - s * y, s * x + c * y, z } end
end

local function wire(scene, name, model, radius, from, to, E)
  local solid, whole = model == "radial" or model == "cubic", model == "composite"
  return scene:wire{ name = name, model = model, radius = radius, from = from, to = to, density = 1200, E = E,
    segments = not (solid or whole) and 24 or nil, spacing = (solid or whole) and 0.004 or nil,
    body = solid and "solid" or nil, core = whole and "line" or nil }
end

-- A wire across two others whose ends are clamped. o: models, angle, gap, gravity's tilt along x, damping, E
-- of the wire across.
local function bridge(lower, upper, o)
  o = o or {}
  local at = turned(o.angle or 0)
  local tilt = o.tilt or 0
  local scene = sw.scene{ gravity = at(G * math.sin(tilt), 0, -G * math.cos(tilt)) }
  local supports = {}
  for i, y in ipairs{ -0.04, 0.04 } do
    local support = wire(scene, "support" .. i, lower, R, at(-0.03, y, R), at(0.05, y, R), 5e6)
    scene:clamp(support, { s = 0 })
    scene:clamp(support, { s = support.length })
    supports[i] = support
  end
  local z = 2 * R + r + (o.gap or 0)
  local b = wire(scene, "across", upper, r, at(0.001, -0.06, z), at(0.001, 0.06, z), o.E or 5e7)
  scene:wire_contact{ friction = o.friction or 0.3 }
  scene:force{ kind = "damping", mass = o.damping or 0, stiffness = 1e-3 }
  return scene, b, supports, at
end

local function weight(b) return b.beam.mass_per_length * 0.12 * G end

-- Sum of the touches' forces on a body.
local function borne(scene, name)
  local sum = { 0, 0, 0 }
  for _, touch in ipairs(scene:touches()) do
    local sign = touch.wires[1] == name and 1 or touch.wires[2] == name and -1 or 0
    for k = 1, 3 do sum[k] = sum[k] + sign * touch.force[k] end
  end
  return sum
end

local PAIRS = { { "tube", "rod" }, { "rod", "tube" }, { "tube", "tube" }, { "radial", "rod" },
  { "cubic", "rod" }, { "composite", "rod" } }

describe("a mesh that touches wires", function()
  for _, pair in ipairs(PAIRS) do
    it(("bears them: a %s, a %s across"):format(pair[1], pair[2]), function()
      for _, angle in ipairs{ 0, 0.7 } do
        local scene, b = bridge(pair[1], pair[2], { damping = 5, angle = angle, gap = 1e-4 })
        t.fine(scene:run{ dt = 0.01, duration = 0.8 })
        local f, W = borne(scene, "across"), weight(b)
        -- what still moves after 0.8 s with a damping of 5/s
        t.near(1, f[3] / W, 2e-3, "force of both supports over the weight")
        t.below(2e-3, math.abs(f[1]) / W + math.abs(f[2]) / W, "sideways force over the weight")
        for _, support in ipairs{ "support1", "support2" } do
          t.near(-0.5, borne(scene, support)[3] / W, 2e-3, support)
        end
      end
    end)
  end

  it("finds the same equilibrium by settle", function()
    for _, pair in ipairs{ { "tube", "rod" }, { "rod", "tube" } } do
      local scene, b = bridge(pair[1], pair[2])
      scene:settle{}
      t.near(1, borne(scene, "across")[3] / weight(b), 1e-4, "force of both supports over the weight")
    end
  end)

  -- Friction keeps the wire while tan(tilt) < mu. Then it slides with g (sin - mu cos). Meshes give way by
  -- up to 0.1 mm under it; landing from 10 um, or from where solid elements stand proud, adds as much.
  for _, case in ipairs{ { "tube", "rod", 1e-5 }, { "radial", "rod", 3.1e-4 } } do
    it(("rubs: a %s, a %s across"):format(case[1], case[2]), function()
      for _, times in ipairs{ 0.9, 1.5 } do
        for _, dt in ipairs{ 0.01, 0.002 } do
          local tilt, T = math.atan(0.3 * times), 0.15
          local scene, b, _, at = bridge(case[1], case[2], { tilt = tilt, angle = 0.4, gap = case[3] })
          local before = b:position(0.06)
          t.fine(scene:run{ dt = dt, duration = T })
          local after, along = b:position(0.06), at(1, 0, 0)
          local way = (after[1] - before[1]) * along[1] + (after[2] - before[2]) * along[2]
          local slid = math.max(0, 0.5 * G * (math.sin(tilt) - 0.3 * math.cos(tilt)) * T ^ 2)
          -- it also swings on the meshes, which changes the push from moment to moment: 5 % of the way
          t.near(slid, way, 2e-4 + 0.05 * slid, ("way at %g s, %g mu"):format(dt, times))
        end
      end
    end)
  end

  -- A wire lands in motion, by 14 mm/s along the tubes. Friction stops it within the blow. It is stiff: the
  -- ends of a soft one flap, its surface slides to and fro, and friction along the tubes is less.
  it("stops a wire that lands, at any step", function()
    for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.0005 } do
      local scene, b = bridge("tube", "rod", { tilt = math.atan(0.27), gap = 1.1e-3, E = 5e8 })
      t.fine(scene:run{ dt = dt, duration = 0.15 })
      -- steps of 0.2 ms: 0.422 mm
      t.near(4.22e-4, b:position(0.06)[1] - 0.001, 2e-5, ("way at %g s"):format(dt))
    end
  end)

  -- Nothing gets through at the speed of a thrown wire, and the blow makes no energy.
  for _, pair in ipairs{ { "tube", "rod" }, { "rod", "tube" }, { "tube", "tube" }, { "radial", "rod" } } do
    it(("keeps out a thrown wire: a %s, a %s"):format(pair[1], pair[2]), function()
      for _, v in ipairs{ 1, 3 } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local a = wire(scene, "a", pair[1], R, { -0.05, 0, 0 }, { 0.05, 0, 0 }, 5e6)
        scene:clamp(a, { s = 0 })
        scene:clamp(a, { s = a.length })
        local b = wire(scene, "b", pair[2], R, { 0.0013, -0.05, 0.03 }, { 0.0013, 0.05, 0.03 }, 5e6)
        b:set_velocity{ 0, 0, -v }
        scene:wire_contact{ friction = 0.3 }
        local books = t.fine(scene:run{ dt = 0.01, duration = 0.06 / v + 0.02 }):ledger()
        -- the middle of the thrown wire stays above the other one's axis
        t.below(b:position(0.05)[3], a:position(0.05)[3] + R, "height of the axis [m]")
        t.below(0.005, books.gap / books.play, "energy from nowhere over that in play")
      end
    end)
  end

  it("goes on to the same bits after a snapshot and from a file", function()
    local scene, b = bridge("tube", "rod", { gap = 2e-4 })
    t.fine(scene:run{ dt = 0.005, duration = 0.05 })
    local file, before = os.tmpname(), scene:snapshot()
    scene:save(file)
    t.fine(scene:run{ dt = 0.005, duration = 0.05 })
    local expected = b:position(0.05)
    scene:restore(before)
    t.fine(scene:run{ dt = 0.005, duration = 0.05 })
    assert.are.same(expected, b:position(0.05))
    local other = sw.load(file)
    os.remove(file)
    t.fine(other:run{ dt = 0.005, duration = 0.05 })
    assert.are.same(expected, other:find("across"):position(0.05))
  end)

  it("goes on touching when a wire becomes a mesh near the touch, and a rod again", function()
    local scene, b, supports = bridge("rod", "rod", { damping = 5, gap = 1e-5 })
    t.fine(scene:run{ dt = 0.01, duration = 0.4 })
    for _, to in ipairs{ { model = "tube", region = { 0.02, 0.04 } }, { model = "tube" },
      { model = "rod", segments = 24 } } do
      supports[1]:remodel(to)
      t.fine(scene:run{ dt = 0.01, duration = 0.8 })
      t.near(0.5, -borne(scene, "support1")[3] / weight(b), 3e-3, to.model)
    end
  end)

  -- A touch that sticks used to slide to and fro in the iterates until the step was halved: 6.9 iterations a
  -- step, and 98 refused steps.
  it("soon finds out whether touches stick", function()
    local steps, iterations, rejected = 0, 0, 0
    for _, angle in ipairs{ 0.3, 0.7, 1.2, 1.5 } do
      for _, gap in ipairs{ 1e-4, 1e-3 } do
        local scene, c, s = sw.scene{}, 0.1 * math.cos(angle), 0.1 * math.sin(angle)
        scene:obstacle{ shape = "plane", friction = 0.3 }
        local low, high = R + gap, 3 * R + 2 * gap
        wire(scene, "a", "tube", R, { -0.1, 0, low }, { 0.1, 0, low }, 5e6)
        wire(scene, "b", "tube", R, { -c, 0.003 - s, high }, { c, 0.003 + s, high }, 5e6)
        scene:wire_contact{ friction = 0.3 }
        scene:force{ kind = "damping", mass = 1, stiffness = 1e-3 }
        local run = t.fine(scene:run{ dt = 0.01, duration = 0.15 })
        steps, iterations = steps + run.steps, iterations + run.iterations
        rejected = rejected + run.rejected
      end
    end
    t.below(5.5, iterations / steps, "iterations a step") -- 4.7
    t.below(40, rejected, "refused steps") -- 14
  end)

  it("touches itself only where it meets itself", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local a = scene:wire{ model = "tube", E = 5e6, density = 1200, radius = R, from = { 0, 0, 0 },
      to = { 0.2, 0, 0 }, segments = 40 }
    scene:wire_contact{ friction = 0.3 }
    scene:clamp(a, { s = 0 })
    local hold = scene:clamp(a, { s = a.length })
    hold:follow{ points = { hold:pose(), { 0.06, 0, 0 } }, turn = { axis = { 0, 1, 0 }, angle = -math.pi },
      duration = 0.5 }
    t.fine(scene:run{ dt = 0.01, duration = 0.6 })
    t.below(0.025, a:min_bend_radius(), "bend radius at the axis [m]")
    assert.are.equal(0, #scene:touches())
  end)

  -- A tube with a wall of 1 mm is bent until it folds. Its particles lie a tenth of the radius below the
  -- surface: opposite ones stay at least two tenths apart.
  it("keeps the walls of a fold apart", function()
    local radius, wall, E, m = 0.01, 0.001, 5e6, 16
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local a = scene:wire{ model = "tube", core = false, particles = m, radius = radius, from = { 0, 0, 0 },
      to = { 0.12, 0, 0 }, spacing = 0.004, density = 1200, EA = E * 2 * math.pi * radius * wall,
      EI = 0.97 * E * math.pi * (0.9 * radius) ^ 3 * wall * 1.11, wall_bending = E * wall ^ 3 / 12 }
    scene:wire_contact{ friction = 0.2 }
    scene:force{ kind = "damping", mass = 2, stiffness = 2e-3 }
    scene:clamp(a, { s = 0 })
    local hold = scene:clamp(a, { s = a.length })
    hold:follow{ points = { hold:pose(), { 0.06, 0, 0 } }, turn = { axis = { 0, 1, 0 }, angle = -2.2 },
      duration = 0.5 }
    local run = t.fine(scene:run{ dt = 0.01, duration = 0.5 })
    for _, event in ipairs(run.events) do assert.are_not.equal("walls", event.kind) end
    local x, least = a:particles(), math.huge
    for ring = 0, #x // (3 * m) - 1 do
      for k = 0, m // 2 - 1 do
        local p, q, d = 3 * (ring * m + k), 3 * (ring * m + k + m // 2), 0
        for i = 1, 3 do d = d + (x[p + i] - x[q + i]) ^ 2 end
        least = math.min(least, math.sqrt(d))
      end
    end
    assert.is_true(#scene:touches() > 0)
    t.below(least, 0.19 * radius, "distance of opposite walls [m]")
  end)
end)
