-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sections of meshes between plates, in plane strain: reference case 11b, and the constants of
-- sections (case 12) that the models are calibrated to.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, E = 0.01, 1e6

-- Quadratic finite elements, neo-Hookean, nu = 0.3, plates that stick: approach over diameter, line force
-- over E R. Frictionless plates have 1 % less; sticking plates leave no motion undetermined.
local solid = { { 0.05, 0.03478504828 }, { 0.1, 0.08485878573 }, { 0.2, 0.2240633922 },
  { 0.3, 0.4279565997 } }
-- The same for nu = 0.4 with a bonded core of 0.7 R that has 10 E and nu = 0.3, frictionless.
local composite = { { 0.01, 0.009962264458 }, { 0.02, 0.02559981177 }, { 0.05, 0.09731707676 },
  { 0.1, 0.286466611 }, { 0.15, 0.5592745038 } }
-- The same for a tube of inner radius 0.7 R, frictionless.
local tube = { { 0.05, 0.002121184817 }, { 0.1, 0.004049114355 }, { 0.2, 0.007463310733 },
  { 0.3, 0.01079826821 } }

--- Puts two slices of a wire between plates. Returns line forces over E R at the approaches of the rows.
-- With own, approaches count from the particles instead of the wire's radius: the mesh by itself, without
-- the definition of its surface.
local function squeeze(model, rows, length, friction, own)
  local p = { radius = R, segments = 2, from = { 0, 0, 0 }, to = { length, 0, 0 } }
  for k, v in pairs(model) do p[k] = v end
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire(p)
  scene:force{ kind = "plane_strain", on = wire, direction = { 1, 0, 0 } }
  local x = wire:particles()
  local plates, skin = {}, own and wire:section(length / 2).skin or 0
  for k = 1, 2 do
    plates[k] = scene:obstacle{ shape = "box", size = { 0.1, 0.1, 0.02 }, friction = friction or 5,
      at = { 0, 0, (2 * k - 3) * (R + skin + 0.01) } }
  end
  local forces, before = {}, 0
  for i, row in ipairs(rows) do
    local steps = math.ceil((row[1] - before) / 0.05 - 1e-9)
    for n = 1, steps do
      local z = R * (1 - before - (row[1] - before) * n / steps) + skin + 0.01
      plates[1]:pose{ 0, 0, -z }
      plates[2]:pose{ 0, 0, z }
      t.fine(scene:settle())
    end
    before = row[1]
    forces[i] = plates[2]:force()[3] / (E * R * length)
    t.near(forces[i], -plates[1]:force()[3] / (E * R * length), 1e-6, "forces of the plates")
  end
  local now = wire:particles()
  for i = 1, #x, 3 do t.near(x[i], now[i], 2e-3 * R, "place along the wire") end
  return forces
end

local function compare(model, rows, length, allowed)
  for i, force in ipairs(squeeze(model, rows, length)) do
    t.share(rows[i][2], force, allowed, ("force at %g %%"):format(100 * rows[i][1]))
  end
end

describe("a solid section between plates", function()
  local function round(args)
    args.E, args.nu, args.density, args.body = E, 0.3, 1000, "solid"
    return args
  end

  it("has the exact force within 3 % with 48 x 6 particles", function()
    compare(round{ model = "radial", particles = 48, layers = 6 }, solid, 0.001, 0.03)
  end)

  it("has the exact force within 10 % with 12 voxels across and with 16 x 4 particles", function()
    -- Particles meet the plates one pair after the other: 16 x 4 are up to 12 % too soft with a corner
    -- first, up to 5 % too stiff with a side first. The mean does not depend on how the section lies.
    compare(round{ model = "cubic", across = 12 }, solid, 0.002, 0.1)
    local coarse = round{ model = "radial", particles = 16, layers = 4 }
    for i, force in ipairs(squeeze(coarse, solid, 0.002, 5, true)) do
      t.share(solid[i][2], force, 0.1, ("force of the particles at %g %%"):format(100 * solid[i][1]))
    end
    local sum = { 0, 0, 0, 0 }
    for _, turn in ipairs{ 0, math.pi / 16 } do
      local model = round{ model = "radial", particles = 16, layers = 4,
        normal = { 0, math.cos(turn), math.sin(turn) } }
      for i, force in ipairs(squeeze(model, solid, 0.002)) do sum[i] = sum[i] + force / 2 end
    end
    for i, force in ipairs(sum) do
      t.share(solid[i][2], force, 0.1, ("force at %g %%"):format(100 * solid[i][1]))
    end
  end)

  it("has the exact force's order of magnitude at default resolution", function()
    -- eight sides meet plates with a corner or a flat first: measured 59 % too much at 5 %, -25
    -- to 9 % beyond; voxels -22 to 4 %
    local forces = squeeze(round{ model = "radial" }, solid, 0.01)
    for i, force in ipairs(forces) do t.share(solid[i][2], force, i == 1 and 1.5 or 0.5, "force") end
    forces = squeeze(round{ model = "cubic" }, solid, 0.008)
    for i, force in ipairs(forces) do t.share(solid[i][2], force, 0.3, "force") end
  end)

  it("resists if it is made of springs", function()
    for _, model in ipairs{ "radial", "cubic" } do
      local forces = squeeze({ model = model, E = E, nu = 0.3, density = 1000 }, solid, 0.008)
      -- springs are fitted to EA, EI and GJ; the section's stiffness that follows is not the material's
      for i, force in ipairs(forces) do
        t.above(0.02 * solid[i][2], force, ("force at %g %% of %s"):format(100 * solid[i][1], model))
        t.below(4 * solid[i][2], force, ("force at %g %% of %s"):format(100 * solid[i][1], model))
      end
    end
  end)
end)

describe("a section of core and shell between plates", function()
  -- friction is 0.1 % of the force here, but leaves no motion undetermined
  local SLIPPERY = 0.01

  local function cable(args)
    args.model, args.body, args.density = "composite", "solid", 1000
    args.E, args.nu, args.core_E, args.core_nu, args.core_radius = E, 0.4, 10 * E, 0.3, 0.7 * R
    return args
  end

  it("has the exact force within 3 % with 60 particles and 3 + 3 layers", function()
    local model = cable{ particles = 60, core_layers = 3, layers = 3 }
    -- measured 2.1, -0.1, -0.1, 0.4 and 2.5 % with sticking plates, which settle at once and push up to 2.5
    -- % more; with slippery ones 2.0, -0.2, -0.5, -0.9 and 0.1 %
    for i, force in ipairs(squeeze(model, composite, 0.001)) do
      t.share(composite[i][2], force, 0.03, ("force at %g %%"):format(100 * composite[i][1]))
    end
  end)

  it("has the exact force within 3 % from 5 % on with 48 particles, corner or flat first", function()
    -- measured within 1 %; in the first per cents the contact is narrower than two particles: 9 % off
    local rows = { composite[3], composite[4], composite[5] }
    for _, turn in ipairs{ 0, math.pi / 48 } do
      local model = cable{ particles = 48, core_layers = 3, layers = 3,
        normal = { 0, math.cos(turn), math.sin(turn) } }
      for i, force in ipairs(squeeze(model, rows, 0.001, SLIPPERY)) do
        t.share(rows[i][2], force, 0.03, ("force at %g %%"):format(100 * rows[i][1]))
      end
    end
  end)

  it("has the exact force's order of magnitude at default resolution", function()
    -- twelve sides meet the plates with a corner or a flat first: measured -2, -34, -11 % and -2, 7, 3 %
    -- with plates at the true approach; the mean of both does not depend on how the section lies
    local rows, sum = { composite[3], composite[4], composite[5] }, { 0, 0, 0 }
    for i, force in ipairs(squeeze(cable{}, rows, 0.01, SLIPPERY, true)) do
      t.share(rows[i][2], force, 0.25, ("force of the particles at %g %%"):format(100 * rows[i][1]))
    end
    for _, turn in ipairs{ 0, math.pi / 12 } do
      local model = cable{ normal = { 0, math.cos(turn), math.sin(turn) } }
      for i, force in ipairs(squeeze(model, rows, 0.01, SLIPPERY)) do sum[i] = sum[i] + force end
    end
    for i, force in ipairs(sum) do
      t.share(rows[i][2], force / 2, 0.25, ("force at %g %%"):format(100 * rows[i][1]))
    end
  end)

  -- The places and forces are those of one mesh: the parts differ only in name.
  it("equals a solid section where both parts are of one material", function()
    local rows = { { 0.05, 0 }, { 0.1, 0 }, { 0.2, 0 } }
    local one = squeeze({ model = "radial", body = "solid", E = E, nu = 0.3, density = 1000, particles = 24,
      layers = 4 }, rows, 0.002)
    local two = squeeze({ model = "composite", body = "solid", E = E, nu = 0.3, density = 1000,
      particles = 24, layers = 2, core_layers = 2, core_radius = 0.5 * R }, rows, 0.002)
    for i, force in ipairs(two) do t.share(one[i], force, 1e-6, "force") end
  end)
end)

describe("a tube's section between plates", function()
  local ri = 0.7
  local EA, EI = E * math.pi * R ^ 2 * (1 - ri ^ 2), E * math.pi / 4 * R ^ 4 * (1 - ri ^ 4)

  it("has the exact force within 25 % with voxels", function()
    -- 14 voxels across leave two in the wall: elements of first order, too stiff in bending
    compare({ model = "cubic", body = "solid", section = "annulus", inner = ri * R, across = 14,
      EA = EA, EI = EI, GJ = EI / 1.3, nu = 0.3, mass_per_length = 0.1 }, tube, 0.002, 0.25)
  end)

  it("has the given stiffness with a ring of springs, and stays between the plates", function()
    local per_approach = tube[2][2] * E / 0.2 -- line force over approach at 10 % [Pa]
    local rows = { { 0.005, per_approach * 0.01 / E }, { 0.1, 0 }, { 0.2, 0 }, { 0.3, 0 } }
    local forces = squeeze({ model = "tube", core = false, particles = 16, EA = EA, EI = EI,
      GJ = EI / 1.3, mass_per_length = 0.1, squeeze = per_approach }, rows, 0.004)
    t.share(rows[1][2], forces[1], 0.05, "force at 0.5 %") -- linear, but for 0.5 % of shape
    -- links buckle inwards from 10 % on; beyond, the force only has the tube's order of magnitude
    for i = 2, 4 do t.above(1e-3, forces[i], ("force at %g %%"):format(100 * rows[i][1])) end
  end)
end)

describe("a hollow tube pressed flat", function()
  it("reports that its walls meet, because they do not touch each other", function()
    local r, wall, length = 0.01, 0.001, 0.03
    local EI, outer = math.pi * r ^ 3 * 1e7 * wall, r + 1.3e-3
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "hose", model = "tube", core = false, particles = 16,
      EA = 2 * math.pi * r * 1e7 * wall, EI = EI, GJ = EI / 2, wall_bending = 1e7 * wall ^ 3 / 12,
      radius = outer, mass_per_length = 0.1, from = { 0, 0, 0 }, to = { length, 0, 0 }, normal = { 0, 0, 1 } }
    scene:force{ kind = "plane_strain", on = wire, direction = { 1, 0, 0 } }
    local plates, told = {}, nil
    for k = 1, 2 do
      plates[k] = scene:obstacle{ shape = "box", size = { 0.2, 0.1, 0.02 }, friction = 0.3,
        at = { length / 2, 0, (2 * k - 3) * (outer + 0.01) } }
    end
    for i = 1, 19 do
      local half = outer * (1 - i * 0.045)
      plates[1]:pose{ length / 2, 0, -half - 0.01 }
      plates[2]:pose{ length / 2, 0, half + 0.01 }
      t.fine(scene:settle())
      told = scene:events()[1]
      -- where the walls lie on the plates, their middles are a skin inside them; they come nearer only
      -- where they have folded inwards
      if half > outer - r + 3 * wall then assert.is_nil(told) end
    end
    assert.equal(1, #scene:events())
    assert.equal("walls", told.kind)
    assert.equal("hose", told.object)
    assert.matches("^tube 'hose' is flat at s = [%d.]+ m: the middles of opposite walls are %S+ m apart, the "
      .. "walls 0.001 m thick", told.text)
  end)
end)

describe("a free mesh without weight between plates", function()
  it("is not thrown out, although nothing else holds it", function()
    -- six directions have no stiffness, so rounding decides there
    for _, model in ipairs{ { model = "tube" }, { model = "cubic" }, { model = "radial", body = "solid" } } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local p = { E = E, density = 1000, radius = R, from = { -0.02, 0, 0 }, to = { 0.02, 0, 0 } }
      for k, v in pairs(model) do p[k] = v end
      local wire = scene:wire(p)
      local plates = {}
      for k = 1, 2 do
        plates[k] = scene:obstacle{ shape = "box", size = { 0.2, 0.2, 0.02 }, friction = 0.3,
          at = { 0, 0, (2 * k - 3) * (R + 0.01) } }
      end
      for k = 1, 10 do -- voxels of springs lie 5 % within R: these are touched from k = 5 on
        plates[2]:pose{ 0, 0, R + 0.01 - 0.02 * k * R }
        t.fine(scene:settle())
        t.below(0.3 * R, math.abs(wire:position(0.02)[2]), "moved across")
        t.below(0.3 * R, math.abs(wire:position(0.02)[3]), "moved up")
      end
      local up = plates[2]:force()[3]
      t.above(1e-4 * E * R * 0.04, up, "force of the plate")
      t.near(-up, plates[1]:force()[3], 1e-3 * up, "force of the other plate")
    end
  end)
end)

describe("plane strain", function()
  it("refuses wrong arguments", function()
    local scene = sw.scene{}
    local wire = scene:wire{ model = "tube", E = E, density = 1000, radius = R, from = { 0, 0, 0 },
      to = { 0.1, 0, 0 } }
    assert.error_matches(function() scene:force{ kind = "plane_strain", on = wire } end, "direction")
    assert.error_matches(function()
      scene:force{ kind = "plane_strain", on = wire, direction = { 0, 0, 0 } }
    end, "must not be zero")
    assert.error_matches(function()
      scene:force{ kind = "plane_strain", on = wire, direction = { 1, 0, 0 }, stiffness = -1 }
    end, "stiffness")
  end)

  it("leaves a wire where it lies, whichever way it was drawn", function()
    for _, model in ipairs{ "tube", "rod" } do
      for _, ends in ipairs{ { 1, 1.1 }, { 1.1, 1 }, { -0.05, 0.05 } } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local wire = scene:wire{ model = model, E = E, density = 1000, radius = R,
          from = { ends[1], 2, 3 }, to = { ends[2], 2, 3 } }
        scene:force{ kind = "plane_strain", on = wire, direction = { 1, 0, 0 } }
        t.below(1e-12, scene:energy().plane_strain, "energy at first")
        t.fine(scene:settle())
        t.near(ends[1], wire:position(0)[1], 1e-9, "start")
        t.near(ends[2], wire:position(wire.length)[1], 1e-9, "end")
      end
    end
  end)

  it("moves a wire to a given place, and refuses wires that lie across", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = E, density = 1000, radius = R, from = { 1, 0, 0 }, to = { 1.1, 0, 0 } }
    assert.error_matches(function()
      scene:force{ kind = "plane_strain", on = wire, direction = { 0, 1, 0 } }
    end, "does not lie along direction")
    scene:force{ kind = "plane_strain", direction = { 1, 0, 0 }, at = { 1.02, 0, 0 } }
    t.fine(scene:settle())
    t.near(1.02, wire:position(0)[1], 1e-6, "start")
    scene:wire{ E = E, density = 1000, radius = R, from = { 0, 1, 0 }, to = { 0.1, 1, 0 } }
    assert.error_matches(function() scene:force{ kind = "plane_strain", direction = { 1, 0, 0 } } end,
      "at is required if it acts on several wires")
  end)

  it("carries a load along the wire", function()
    local scene = sw.scene{ gravity = { 9.81, 0, 0 } }
    local wire = scene:wire{ model = "tube", E = E, density = 1000, radius = R, from = { 0, 0, 0 },
      to = { 0.1, 0, 0 } }
    scene:force{ kind = "plane_strain", on = wire, direction = { 1, 0, 0 } }
    t.fine(scene:settle())
    -- weight per length over stiffness per length
    t.near(0, wire:position(0.05)[1] - 0.05, 1e-8, "sag along the wire")
    t.near(0, wire:tension(0.05), 1e-3 * wire.beam.EA, "tension")
  end)
end)
