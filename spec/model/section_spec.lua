-- SPDX-License-Identifier: GPL-3.0-or-later
-- The choice of section: its free checks, and squeezed wires whose force is known.
local sw = require "softworld"
local flat = require "softworld.model.flat"
local mesh = require "softworld.model.mesh"
local probe = require "softworld.model.probe"
local squeeze = require "spec.model.plates"

local R, E = 0.01, 1e6

-- Reference case 11b, plane strain, nu = 0.3: approach over diameter, force per length over E R.
local SOLID = { { 0.01, 0.004979935294 }, { 0.05, 0.03443902533 }, { 0.1, 0.08402912013 } }
local TUBE_1, TUBE_10 = 0.0004365450778, 0.004049114355 -- inner radius 0.7 R, at 1 % and 10 %
local SOLID_STUCK_10 = 0.08485878573                    -- between plates that stick

-- A round wire, or a tube of the same material given by its stiffness.
local function section(inner)
  if not inner then return { E = E, nu = 0.3, density = 1000, radius = R } end
  local area, EI = math.pi * R ^ 2 * (1 - inner ^ 2), E * math.pi / 4 * R ^ 4 * (1 - inner ^ 4)
  return { EA = E * area, EI = EI, GJ = EI / 1.3, mass_per_length = 1000 * area, radius = R }
end

local function wire_of(scene, args, more)
  local all = { name = "w", from = { 0, 0, 0 }, to = { R, 0, 0 }, segments = 4 }
  for key, value in pairs(args) do all[key] = value end
  for key, value in pairs(more or {}) do all[key] = value end
  return scene:wire(all)
end

local function body(args) return flat.body(wire_of(sw.scene {}, args)) end

-- A piece of a long wire between long plates that approach by a share of its width.
local function plates(args, share, more)
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  local w = wire_of(scene, args, { model = "auto" })
  squeeze(scene, w, R, share, 0.3)
  local all = { duration = 0.4, quasistatic = true, tolerance = { ["top.force"] = { relative = 0.1 } } }
  for key, value in pairs(more or {}) do all[key] = value end
  return scene, w, all
end

local function force_of(run) return run.quantities["top.force"].value[3] / (E * R * R) end

-- A wire on a table under its weight: pressed, but hardly.
local function lying()
  local scene = sw.scene {}
  scene:obstacle { name = "table", shape = "plane", friction = 0 }
  local w = scene:wire { name = "w", E = 5e6, density = 1500, radius = R, from = { 0, 0, R },
    to = { 0.4, 0, R }, segments = 12, model = "auto" }
  scene:clamp(w, { s = 0 })
  return scene:run { duration = 0.1, quasistatic = true, tolerance = { tip = 0.001 } }, w
end

describe("flattening", function()
  -- Johnson's line contact is for narrow strips; it is off by 0.1 to 0.5 % up to a tenth.
  it("agrees with a solid cylinder between plates", function()
    local b = body(section())
    assert.is_nil(b.inner)
    for _, row in ipairs(SOLID) do
      assert.is_near(row[1], flat.share(b, row[2] * E * R), 0.01 * row[1])
    end
  end)

  -- Roark's ring includes shear and stretch of the wall; a thin ring alone is 20 % too stiff here.
  it("agrees with a thick ring, for a tube given by EA and EI", function()
    local b = body(section(0.7))
    assert.is_near(0.7 * R, b.inner, 1e-6 * R)
    assert.is_near(E, b.E, 1e-6 * E)
    assert.is_near(0.3, b.nu, 1e-6)
    assert.is_near(0.01, flat.share(b, TUBE_1 * E * R), 0.04 * 0.01)
    -- (pi/4 - 2/pi) F R^3/EI of a wall so thin that it neither shears nor stretches
    local thin = body(section(0.98))
    local mean, EI = 0.99 * R, E * (0.02 * R) ^ 3 / 12 / (1 - 0.3 ^ 2)
    assert.is_near(flat.thin * mean ^ 3 / EI, flat.ring(thin), 0.002 * flat.ring(thin))
  end)

  it("is not known where EA and EI fit no single material; then E is an upper bound", function()
    local b = body { EA = 1e4, EI = 2e-3, GJ = 2e-3, mass_per_length = 0.03, radius = 0.0018 }
    assert.is_false(b.known)
    assert.is_near(1e4 / (math.pi * 0.0018 ^ 2), b.E, 1)
  end)

  it("is consistent with its stiffness", function()
    local b = body(section())
    local K = flat.stiffness(b, 0.05)
    assert.is_near(0.05, flat.share(b, K * 0.05 * 2 * R), 1e-6)
    assert.is_near(flat.stiffness(b, 0.1), flat.stiffness(b, 0.5), 1e-9 * K) -- at most a tenth counts
  end)
end)

-- EA and EI give the inner radius up to rounding, which must not ask for more cubes across.
it("a tube whose wall is a quarter of its radius has elements, with 16 cubes across", function()
  for _, inner in ipairs{ 0.75, 0.7500000001, 0.7499999999 } do
    local b = body(section(inner))
    assert.is_near(0.25 * R, b.wall, 1e-9 * R)
    local time = mesh.time({ body = b, share = 0.1, length = 0.1 }, mesh.elements, 1)
    assert.is_true(time > 0 and time < math.huge, tostring(time))
  end
end)

-- A mesh that cannot be made must not be planned as the next level.
it("a solid wire has elements on all levels that are expected to take a time", function()
  local made = 0
  for k = 1, 8 do
    local w = { object = wire_of(sw.scene {}, section()), body = body(section()), share = 0.1, length = R }
    if mesh.time(w, mesh.elements, k) < math.huge then
      assert.is_nil(mesh.make(w, mesh.elements, k))
      made = made + 1
    end
  end
  assert.is_true(made >= 3, made) -- levels of which each refines the one before
end)

-- Expected time: the rule, times what the level before took over the rule, with the growth of that factor.
it("a level is expected to take the time of those before it, and to grow as they did", function()
  local wire = { body = body(section(0.7)), share = 0.1, length = 0.1 }
  local context = { probes = {}, pressed_fixed = { wire }, iterations = 100 }
  local rungs = { motion = 1, twist = 1, contact = 1, grip = 1, section = mesh.springs }
  local function rule(k) return mesh.time(wire, mesh.springs, k, 100) end
  assert.is_near(rule(3), probe.expected(context, rungs, 3), 1e-9 * rule(3))
  local function took(k, time) context.probes[probe.key(rungs, k)] = { level = { ok = true, cpu = time } } end
  took(1, 10 * rule(1))
  assert.is_near(10 * rule(3), probe.expected(context, rungs, 3), 1e-9 * rule(3))
  took(2, 15 * rule(2))
  assert.is_near(15 * 1.5 * rule(3), probe.expected(context, rungs, 3), 1e-6 * rule(3))
  assert.is_near(15 * 1.5 ^ 2 * rule(4), probe.expected(context, rungs, 4), 1e-6 * rule(4))
  local levels = { [3] = { ok = true, cpu = rule(3) } } -- faster than expected
  assert.is_near(rule(4), probe.expected(context, rungs, 4, levels), 1e-9 * rule(4))
  rungs.section = 1
  assert.is_nil(probe.expected(context, rungs, 3))
end)

describe("the choice of section", function()
  it("stays round at no cost where almost nothing presses", function()
    local run, w = lying()
    assert.equal("round", run.model.section, tostring(run:why()))
    assert.equal("rod", w.model)
    for _, c in ipairs(run.model.choices) do
      if c.name == "section" then assert.equal("free", c.by) end
    end
  end)

  it("takes springs for a tube between plates, with a force within the stated error", function()
    local scene, w, args = plates(section(0.7), 0.1)
    local run = scene:run(args)
    assert.equal("springs", run.model.section, tostring(run:why()))
    assert.equal("tube", w.model)
    assert.is_true(run.met, tostring(run:why()))
    assert.truthy(tostring(run:why()):find("is squeezed from both sides, which a line cannot compute", 1,
      true))
    assert.equal("held", run.model.twist) -- a mesh rolls by itself, also where something rubs it on the way
    for _, e in ipairs(run.events) do assert.are_not.equal("model", e.kind) end
    local q = run.quantities["top.force"]
    assert.is_true(q.model_error > 0)
    assert.is_true(math.abs(force_of(run) - TUBE_10) <= q.error / (E * R * R),
      ("%g, not %g"):format(force_of(run), TUBE_10))
  end)

  it("reports that the wall of a thin-walled hose has no mesh, and is not met", function()
    local scene, _, args = plates(section(0.9), 0.1)
    local run = scene:run(args)
    assert.is_false(run.met)
    local why = tostring(run:why())
    assert.truthy(why:find("the wall of 'w', 1.000 mm thick, is too thin for a mesh: its middle is at a "
      .. "radius of 9.513 mm", 1, true), why)
    assert.truthy(why:find("a mesh has particles up to radius = ", 1, true), why)
    assert.truthy(why:find("NOT enough: 'w' is squeezed from both sides", 1, true), why)
    assert.truthy(why:find("no mesh of it can be computed", 1, true), why)
  end)

  -- The second level of a wall of 0.3 R needs 20 cubes across; at most 16 are possible.
  it("computes no elements for one level only, and is not met where springs leave out too much", function()
    local scene, _, args = plates(section(0.7), 0.1, { tolerance = { ["top.force"] = { relative = 0.03 } } })
    local run = scene:run(args)
    assert.equal("springs", run.model.section, tostring(run:why()))
    assert.is_false(run.met)
    assert.truthy(tostring(run:why()):find("cannot be computed on finer edges: there is no such mesh", 1,
      true))
    assert.is_true(run.model.probes <= 4)
  end)

  it("takes elements for a solid wire between plates, with a force within the stated error", function()
    local scene, w, args = plates(section(), 0.1)
    local run = scene:run(args)
    assert.equal("elements", run.model.section, tostring(run:why()))
    assert.equal("radial", w.model)
    assert.is_true(run.met, tostring(run:why()))
    local q = run.quantities["top.force"]
    assert.is_true(math.abs(force_of(run) - SOLID_STUCK_10) <= q.error / (E * R * R) + 0.01 * SOLID_STUCK_10,
      ("%g, not %g"):format(force_of(run), SOLID_STUCK_10))
  end)

  -- Rods find no equilibrium here; what was stored before shows how they are pressed.
  for _, row in ipairs { { 0.16, 0.12 }, { 0.1, 0.05 } } do
    local length, at = table.unpack(row)
    it(("makes a mesh of a hose of %g m also where poses of lines fail"):format(length), function()
      local r, inner = 0.006, 0.75 * 0.006
      local area, EI = math.pi * (r ^ 2 - inner ^ 2), 5e6 * math.pi / 4 * (r ^ 4 - inner ^ 4)
      local scene = sw.scene {}
      local w = scene:wire { name = "w", EA = 5e6 * area, EI = EI, GJ = EI / 1.4,
        mass_per_length = 1200 * area, radius = r, from = { 0, 0, 0 }, to = { length, 0, 0 },
        segments = length < 0.12 and 10 or 24, model = "auto" }
      scene:clamp(w, { s = 0 })
      for k, name in ipairs { "low", "top" } do
        local side = 2 * k - 3
        scene:obstacle { name = name, shape = "box", size = { 0.02, 0.1, 0.02 }, friction = 0.3,
          at = { at, 0, side * (r + 0.0101) } }:follow { relative = true, duration = 1,
          points = { { 0, 0, 0 }, { 0, 0, -side * (1e-4 + 0.1 * r) } } }
      end
      local run = scene:run { duration = 1, quasistatic = true,
        tolerance = { ["top.force"] = { relative = 0.2 } } }
      assert.equal("springs", run.model.section, tostring(run:why()))
      assert.is_true(run.met, tostring(run:why()))
      assert.equal("tube", w.model)
    end)
  end

  -- The choices use frames of their own: the script's may be too few to show any pressure.
  it("sees the pressure although the script keeps no frames, or few", function()
    for _, row in ipairs { { frames = false }, { frame = 10 } } do
      local scene, _, args = plates(section(0.7), 0.1, row)
      local run = scene:run(args)
      assert.equal("springs", run.model.section, tostring(run:why()))
      assert.is_true(run.met)
      assert.equal(row.frame and 2 or 0, #run:frames()) -- of the start and the end
    end
  end)

  -- Each choice alone leaves out less than 3/4 of the tolerance: springs two thirds, poses an eighth.
  it("keeps what all choices leave out together within 3/4 of the tolerance", function()
    local scene, _, args = plates(section(0.7), 0.115, { duration = 0.05 })
    args.quasistatic = nil
    for _, name in ipairs { "low", "top" } do
      local side = name == "top" and 1 or -1
      scene:find(name):follow { relative = true, duration = 0.05,
        points = { { 0, 0, 0 }, { 0, 0, -side * 0.115 * R } } }
    end
    local run = scene:run(args)
    local q = run.quantities["top.force"]
    assert.is_true(run.met, tostring(run:why()))
    assert.is_true(q.model_error <= 0.75 * q.tolerance, ("%g of %g"):format(q.model_error, q.tolerance))
  end)

  it("gives the same bits in a second run, and chooses again after leaving a mesh", function()
    local values = {}
    for k = 1, 2 do
      local scene, _, args = plates(section(0.7), 0.05)
      values[k] = force_of(scene:run(args))
    end
    assert.equal(values[1], values[2])
    local scene, w, args = plates(section(0.7), 0.05)
    local start = scene:snapshot()
    scene:run(args)
    assert.equal("tube", w.model)
    scene:restore(start)
    assert.equal("rod", w.model)
    assert.equal(values[1], force_of(scene:run(args)))
    for _, name in ipairs { "low", "top" } do scene:find(name):follow(nil) end
    local again = scene:run { duration = 0.1, quasistatic = true, tolerance = { tip = 0.001 } }
    assert.truthy(again.model)
  end)

  it("reads quantities that only a changing section has", function()
    local scene, w, args = plates(section(0.7), 0.1)
    args.tolerance = { { name = "height", relative = 0.1, unit = "m",
      of = function() return w:width(R / 2, { 0, 0, 1 }) end } }
    local run = scene:run(args)
    assert.equal("springs", run.model.section, tostring(run:why()))
    assert.is_near(0.9 * 2 * R, run.quantities.height.value, 0.02 * R)
  end)

  -- A ring of particles lies within 0.9 of the radius, so the wall of a tube cannot be thinner.
  it("reports that the wire cannot be such a mesh", function()
    local scene, w, args = plates(section(0.95), 0.1)
    local run = scene:run(args)
    assert.is_not_true(run.ok and run.met)
    assert.equal("round", run.model.section)
    assert.truthy(tostring(run.model):find("NOT known: whether this model suffices", 1, true))
    assert.truthy(tostring(run.model):find("particles up to radius", 1, true), tostring(run.model))
    assert.is_nil(tostring(run.model):find("at t = ", 1, true), tostring(run.model))
    assert.equal("rod", w.model)
  end)

  -- Springs do not feel walls that touch. The event `walls`: the middles of walls are one thickness apart.
  it("is not met where the walls of a mesh have passed through each other", function()
    for share, enough in pairs{ [0.6] = true, [0.85] = false } do
      local scene, w, args = plates(section(0.75), share)
      args.tolerance = { ["top.force"] = { relative = 0.9 } }
      local run = scene:run(args)
      assert.is_true(run.ok, run.reason)
      assert.equal("tube", w.model)
      assert.equal(enough, run.met, tostring(run:why()))
      if not enough then
        assert.matches("NOT enough: tube 'w' is flat at s = .* do not touch each other", tostring(run:why()))
        assert.matches("^tube 'w' is flat", run.advice)
      end
    end
  end)

  -- If E of the section is not given, the squeezing force is unknown.
  it("is not met where the stiffness of the section is unknown", function()
    local scene, _, args = plates({ EA = 2e3, EI = 5e-4, GJ = 4e-4, mass_per_length = 0.3, radius = R }, 0.1)
    local fine, run = pcall(scene.run, scene, args)
    assert.is_true(fine, tostring(run))
    assert.is_not_true(run.ok and run.met)
  end)
end)
