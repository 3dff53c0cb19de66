-- SPDX-License-Identifier: GPL-3.0-or-later
-- Solid elements fitted to a wire: against formulas of sections, beams of finite length, and a cylinder
-- between plates.
local sw = require "softworld"
local beam = require "calibrate.beam"
local plates = require "calibrate.plates"
local tools = require "physics.tools"
local near, share = tools.near, tools.share
local calibrate = sw.calibrate

local R = 0.005
local function round(more)
  local args = { mesh = "radial", section = "solid", E = 1e8, nu = 0.3, radius = R }
  for key, value in pairs(more) do args[key] = value end
  return args
end

-- Beam stiffness of the elements alone, with modulus 1 and slices every spacing.
local function alone(c, spacing, nu)
  return calibrate.cell { spacing = spacing or c.spacing, particles = c.particles, links = {},
    stiffness = {}, elements = c.elements, modulus = 1, nu = nu or c.nu }
end

describe("a beam of solid elements", function()
  it("has the EA, EI and GJ of its polygon, at any length of the elements", function()
    for _, nu in ipairs { 0, 0.3, 0.45, 0.49 } do
      -- 8 and 12 particles are coarse: Poisson's bulging does not fit flat sides
      for _, mesh in ipairs { { 8, 2, 8e-3 }, { 12, 2, 5e-3 }, { 16, 3, 1e-3 }, { 24, 6, 2e-4 } } do
        local c = calibrate(round { particles = mesh[1], layers = mesh[2], nu = nu })
        local r, n, first = R * c.scale, mesh[1], nil
        local sine = r * r * math.sin(2 * math.pi / n)
        local A, I = n / 2 * sine, n / 24 * sine * r * r * (2 + math.cos(2 * math.pi / n))
        for _, ratio in ipairs { 0.25, 0.5, 1, 2 } do
          local b = alone(c, ratio * R, nu)
          share(A, b.EA, 1e-9)
          share(I, b.EI, mesh[3])
          share(I / (1 + nu), b.GJ, 1e-9) -- no particle warps: all lie on lines of symmetry
          first = first or b.EI
          share(first, b.EI, 1e-9, "EI does not depend on the spacing")
        end
      end
    end
  end)

  it("tends to the circle with finer sections", function()
    local c = calibrate(round { particles = 48, layers = 6 })
    local b = alone(c)
    near(1, c.scale, 0.002)
    share(math.pi * R ^ 2, b.EA, 1e-4)
    share(math.pi * R ^ 4 / 4, b.EI, 1e-4)
    share(math.pi * R ^ 4 / 4 / 1.3, b.GJ, 1e-4)
  end)

  it("bends exactly with any number of voxels, and twists like Saint-Venant's square", function()
    for _, nu in ipairs { 0, 0.3, 0.49 } do
      for _, across in ipairs { 1, 2, 3, 12 } do
        local a = 0.01
        local G = 0.5e8 / (1 + nu)
        local c = calibrate { mesh = "cubic", body = "solid", section = "rectangle", width = a, height = a,
          across = across, nu = nu, tolerance = 1,
          EA = 1e8 * a ^ 2, EI = 1e8 * a ^ 4 / 12, GJ = G * 0.140577 * a ^ 4 }
        for _, ratio in ipairs { 0.25, 2 } do
          local b = alone(c, ratio * a / 2, nu)
          share(a ^ 2, b.EA, 1e-9)
          share(a ^ 4 / 12, b.EI, 1e-9)
          -- one voxel and two by two cannot warp: they have the polar moment, a^4/6
          local allowed = ({ [1] = 0.19, [2] = 0.19, [3] = 0.1 })[across] or 0.008
          share(0.140577 * a ^ 4, b.GJ * 2 * (1 + nu), allowed, "GJ of " .. across)
        end
      end
    end
  end)
end)

local STRANDS = { EA = 137e3, EI = 1.28e-3, radius = 1.2e-3 }
local cases = {
  { "one material", round {}, 1e-6 },
  { "one nearly incompressible material", round { nu = 0.45, particles = 12 }, 1e-6 },
  { "one material of one layer", round { nu = 0.45, layers = 1 }, 1e-8, springs = true },
  { "one material whose Poisson's ratio is not given", round { nu = false }, 1e-6 },
  { "voxels", round { mesh = "cubic" }, 1e-6 },
  { "voxels of a tube", { mesh = "cubic", body = "solid", section = "annulus", inner = 0.6 * R, radius = R,
    across = 10, EA = 1e8 * math.pi * 0.64 * R ^ 2, EI = 1e8 * math.pi / 4 * 0.8704 * R ^ 4,
    GJ = 1e8 / 1.3 * math.pi / 4 * 0.8704 * R ^ 4, nu = 0.3 }, 1e-6 },
  { "strands that slip", { GJ = 1.6e-3, STRANDS }, 1e-8, springs = true },
  { "strands that twist easily", { GJ = 0.4e-3, STRANDS }, 1e-8, springs = true },
  { "strands of voxels", { mesh = "cubic", GJ = 1.6e-3, STRANDS }, 1e-8, springs = true },
  { "a catalogue's cable", { mesh = "radial", section = "solid", cable = "GXL 1.5", nu = 0.4 }, 1e-8,
    springs = true },
}
for _, case in ipairs(cases) do
  local args = case[2]
  if args.nu == false then args.nu = nil end
  if args[1] then
    for key, value in pairs(args[1]) do args[key] = value end
    args[1], args.section, args.mesh = nil, "solid", args.mesh or "radial"
  end
end

describe("calibrate makes of solid elements", function()
  for _, case in ipairs(cases) do
    it(case[1] .. " a wire whose beams of finite length are the wire", function()
      local c = calibrate(case[2])
      near(0, c.residuals.EA, 1e-8)
      near(0, c.residuals.EI, 1e-8)
      near(0, c.residuals.GJ, case[3])
      assert.are.equal(case.springs or false, next(c.springs) ~= nil)
      assert.is_true(c.modulus > 0)
      if case[2].E then
        share(1e8, c.modulus, 0.05)
        near(1, c.scale, 0.06)
      end
      local b = beam.stiffness(c, 16, 6)
      -- the ends' effect fades within a few diameters; beams with thin walls are fewer diameters long
      local ends = case[2].inner and 2e-4 or 1e-5
      share(c.EA, b.EA, ends, "EA of beams")
      share(c.EI, b.EI, ends, "EI of beams, by a moment")
      share(c.EI, b.EI_by_force, 10 * ends, "EI of beams, by a force")
      share(c.GJ, b.GJ, ends, "GJ of beams")
      local again = calibrate.cell { spacing = c.spacing, particles = c.particles, links = c.links,
        stiffness = c.springs, elements = c.elements, modulus = c.modulus, nu = c.nu }
      for _, name in ipairs { "EA", "EI", "GJ", "squeeze" } do share(c[name], again[name], 1e-9, name) end
      local sum = 0
      for _, part in ipairs(c.shares) do sum = sum + part end
      share(1, sum, 1e-12, "masses")
    end)
  end

  -- the wire has nu = 0.3; the elements' nu and scale make up for flat sides and missing warp
  it("a wire that prints its elements, their nu and scale", function()
    local text = tostring(calibrate(round {}))
    assert.is_truthy(text:find("16 elements, nu = 0.2977, section times 1.05", 1, true), text)
  end)
end)

describe("calibrate refuses, of solid elements:", function()
  local function refused(args, text)
    local ok, message = pcall(calibrate, args)
    assert.is_false(ok)
    assert.is_truthy(message:find(text, 1, true), message)
  end

  it("wrong arguments", function()
    refused(round { mesh = "tube" }, "one ring of particles")
    refused(round { squeeze = 1e6 }, "squeeze = 1e+06 Pa goes with body = 'springs'")
    refused(round { nu = 0.5 }, "nu = 0.5 of solid elements must be in [0, 0.4999]")
    refused(round { nu = -0.2 }, "must be in [0, 0.4999]")
    refused(round { body = "solids" }, "solid")
    refused(round { spin_inertia = 1e-9, density = 1000 }, "spin_inertia")
    refused({ mesh = "radial", section = "solid", EA = 1e4, EI = 0.3, GJ = 0.05, radius = R },
      "EI/EA = 3e-05 m2 is too close to half of radius^2 = 2.5e-05 m2")
  end)

  it("wrong elements of a cell", function()
    local c = calibrate(round {})
    local function cell(change)
      local args = { spacing = c.spacing, particles = c.particles, links = {}, stiffness = {},
        elements = { { particles = { 1, 2, 3, 1, 2, 3 } } }, modulus = 1, nu = 0.3 }
      change(args)
      local ok, message = pcall(calibrate.cell, args)
      assert.is_false(ok)
      return message
    end
    local function says(text, change)
      local message = cell(change)
      assert.is_truthy(message:find(text, 1, true), message)
    end
    says("element 1 has no volume", function(a) a.elements[1].particles = { 1, 3, 2, 1, 3, 2 } end)
    says("element 1 must have a list of 6 or 8", function(a) a.elements[1].particles = { 1, 2, 3 } end)
    says("particle that does not exist", function(a) a.elements[1].particles[2] = 99 end)
    says("nu must be a number", function(a) a.nu = nil end)
    says("nu = 0.5 must be in", function(a) a.nu = 0.5 end)
    says("modulus must be a number", function(a) a.modulus = nil end)
  end)
end)

-- Case 11b of the reference: a neo-Hookean cylinder in plane strain, nu = 0.3. Particles meet the plates
-- one pair after the other; with coarse meshes the force shows this.
describe("a squeezed cylinder of solid elements", function()
  local reference = { 0.03444, 0.0840, 0.2226, 0.4272 }
  local function squeezed(args, allowed)
    local forces = plates.squeeze(calibrate(args), 0.3, { 0.05, 0.1, 0.2, 0.3 }, 0.05)
    for i, force in ipairs(forces) do share(reference[i], force, allowed, "force " .. i) end
  end

  it("has the exact force within 3 % with 48 particles and 6 layers", function()
    squeezed(round { particles = 48, layers = 6 }, 0.03)
  end)

  it("has the exact force within 5 % with 32 particles and 6 layers, and 12 voxels across", function()
    squeezed(round { particles = 32, layers = 6 }, 0.05)
    squeezed(round { mesh = "cubic", across = 12 }, 0.05)
  end)
end)
