-- SPDX-License-Identifier: GPL-3.0-or-later
-- Core and shell of solid elements: against closed forms of a circle in a ring of another material, against
-- beams of finite length, and refusals.
local sw = require "softworld"
local beam = require "calibrate.beam"
local tools = require "physics.tools"
local near, share = tools.near, tools.share
local calibrate = sw.calibrate

local R = 0.005

local function with(base, more)
  local args = { mesh = "composite", section = "solid", radius = R }
  for _, t in ipairs { base, more or {} } do
    for key, value in pairs(t) do args[key] = value end
  end
  return args
end

-- Returns the area of a ring and its second moment.
local function ring(outer, inner)
  return math.pi * (outer ^ 2 - inner ^ 2), math.pi / 4 * (outer ^ 4 - inner ^ 4)
end

-- Returns EA, EI, GJ of sections that stay plane.
local function sums(args)
  local rc = args.core_radius or 0.6 * R
  local As, Is = ring(R, rc)
  local Ac, Ic = ring(rc, 0)
  local nu, core_nu = args.nu, args.core_nu or args.nu
  return args.E * As + args.core_E * Ac, args.E * Is + args.core_E * Ic,
    args.E / (1 + nu) * Is + args.core_E / (1 + core_nu) * Ic
end

local JACKET = { E = 1e7, nu = 0.4, core_E = 1e8, core_nu = 0.3, core_radius = 0.7 * R }
local SOFT = { E = 1e8, nu = 0.35, core_E = 2e6 }
local COPPER = { E = 2e7, nu = 0.45, core_E = 1.2e11, core_nu = 0.34, core_radius = 0.3 * R }

describe("a composite of two materials", function()
  it("has EA and EI of a circle in a ring exactly, and GJ nearly", function()
    for _, material in ipairs { JACKET, SOFT, COPPER, { E = 1e8, nu = 0.3, core_E = 1e8 } } do
      -- allowed shift of nu, which makes GJ of the polygon; Poisson's bulging does not fit flat sides
      for _, mesh in ipairs { { {}, 0.003 }, { { particles = 8 }, 0.01 },
        { { particles = 24, layers = 3, core_layers = 3 }, 0.002 } } do
        local args = with(material, mesh[1])
        local c = calibrate(args)
        local EA, EI, GJ = sums(args)
        share(EA, c.EA, 1e-12, "EA")
        share(EI, c.EI, 1e-12, "EI")
        share(EI, c.EI2, 1e-9, "EI of the other plane")
        share(GJ, c.GJ, 1e-6, "GJ")
        assert.is_nil(next(c.springs))
        -- corners are made up for by one scale and one factor of both moduli
        share(args.core_E / args.E, c.core_modulus / c.modulus, 1e-12, "ratio of moduli")
        share(args.E, c.modulus, 0.005, "modulus")
        near(1, c.scale, mesh[1].particles == 8 and 0.06 or 0.03)
        -- and by one shift of both nu, for GJ
        near(args.nu, c.nu, mesh[2])
        near((args.core_nu or args.nu) - args.nu, c.core_nu - c.nu, 1e-12)
      end
    end
  end)

  it("has parts with their own EA, EI and GJ", function()
    for _, material in ipairs { JACKET, SOFT, COPPER } do
      local args = with(material, { particles = 40, layers = 3, core_layers = 3 })
      local c = calibrate(args)
      local rc = args.core_radius or 0.6 * R
      local As, Is = ring(R, rc)
      local Ac, Ic = ring(rc, 0)
      -- 40 sides: second moments are 0.2 % off
      share(args.E * As, c.shell.EA, 0.003)
      share(args.E * Is, c.shell.EI, 0.004)
      share(args.E * Is / (1 + args.nu), c.shell.GJ, 0.004)
      share(args.core_E * Ac, c.core.EA, 0.003)
      share(args.core_E * Ic, c.core.EI, 0.004)
      share(args.core_E * Ic / (1 + (args.core_nu or args.nu)), c.core.GJ, 0.004)
    end
  end)

  it("has its interface at the core's radius", function()
    local c = calibrate(with(JACKET, { particles = 16, layers = 2, core_layers = 3 }))
    local rc, core = 0.7 * R * c.scale, 0
    for i, p in ipairs(c.particles) do
      local r = math.sqrt(p[1] ^ 2 + p[2] ^ 2)
      if c.part[i] == 1 then core = core + 1 end
      assert.are.equal(c.part[i] == 1, r < rc * (1 + 1e-9))
    end
    assert.are.equal(1 + 3 * 16, core)
    assert.are.equal(2 * 16, c.count.solid)
    assert.are.equal(3 * 16, c.count.core_solid)
    share(0.7 * R, c.core_radius, 1e-12)
    share(0.7 * R, c.bore, 1e-12)
    share(R * c.scale, c.ring_radius, 1e-12)
    for _, e in ipairs(c.elements) do
      local inside = true
      for _, p in ipairs(e.particles) do inside = inside and c.part[p] == 1 end
      assert.are.equal(inside and c.core_modulus or c.modulus, e.modulus)
      assert.are.equal(inside and c.core_nu or c.nu, e.nu)
    end
  end)

  -- Parts with different nu press on each other when the wire is stretched (Hill 1964). For a circle (c) in
  -- a ring (s), EA = sum + 4 (nu_c - nu_s)^2 Ac As/A / (vc/ks + vs/kc + 1/Gs), k of plane strain.
  it("has the EA that different Poisson's ratios add", function()
    local args = with({ E = 1e7, nu = 0.45, core_E = 3e7, core_nu = 0.1, core_radius = 0.6 * R,
      particles = 40, layers = 5, core_layers = 3 })
    local c = calibrate(args)
    local corners = 40 / 2 / math.pi * math.sin(2 * math.pi / 40) * c.scale ^ 2 -- of areas
    local A, Ac = math.pi * R ^ 2 * corners, math.pi * (0.6 * R) ^ 2 * corners
    local function k(E, nu) return E / (2 * (1 + nu) * (1 - 2 * nu)) end
    local E, core_E, vc = c.modulus, c.core_modulus, 0.36
    local more = 4 * (0.45 - 0.1) ^ 2 * Ac * (A - Ac) / A
      / (vc / k(E, 0.45) + (1 - vc) / k(core_E, 0.1) + 2 * (1 + 0.45) / E)
    local extra = c.EA - E * (A - Ac) - core_E * Ac
    tools.above(0.005 * c.EA, more, "what is added") -- large enough to matter
    share(more, extra, 0.03, "what is added to EA") -- with 3 + 5 layers
  end)

  it("is the wire as a beam of finite length", function()
    for _, more in ipairs { {}, { core_nu = 0.4 }, { particles = 8 }, { core_layers = 1 } } do
      local c = calibrate(with(JACKET, more))
      local b = beam.stiffness(c, 16, 6)
      -- the ends' effect fades within a few diameters
      share(c.EA, b.EA, 1e-4, "EA of beams")
      share(c.EI, b.EI, 1e-4, "EI of beams, by a moment")
      share(c.EI, b.EI_by_force, 1e-3, "EI of beams, by a force")
      share(c.GJ, b.GJ, 1e-4, "GJ of beams")
      local again = calibrate.cell { spacing = c.spacing, particles = c.particles, links = c.links,
        stiffness = c.springs, elements = c.elements }
      for _, name in ipairs { "EA", "EI", "GJ", "squeeze" } do share(c[name], again[name], 1e-9, name) end
    end
  end)

  it("of one material is that material", function()
    local c = calibrate(with { E = 1e8, nu = 0.3 })
    share(1e8, c.modulus, 0.002)
    share(c.modulus, c.core_modulus, 1e-9)
    near(0.3, c.core_nu, 0.003)
    near(c.nu, c.core_nu, 1e-12)
    share(math.pi * R ^ 2 * 1e8, c.EA, 1e-12)
  end)

  it("prints both materials", function()
    local text = tostring(calibrate(with(JACKET)))
    assert.is_truthy(text:find("composite of 37 particles", 1, true), text)
    assert.is_truthy(text:find("12 elements, nu = 0.39%d+, section times 1.02"), text)
    assert.is_truthy(text:find("core_modulus +1.0%d+e%+08 Pa +24 elements, nu = 0.29%d+"), text)
  end)
end)

describe("a composite of EA, EI and GJ", function()
  it("finds the two materials that have them", function()
    for _, material in ipairs { JACKET, SOFT } do
      local known = with(material)
      local EA, EI, GJ = sums(known)
      local c = calibrate(with({ EA = EA, EI = EI, GJ = GJ, core_radius = known.core_radius,
        core_nu = known.core_nu }))
      share(EA, c.EA, 1e-12)
      share(EI, c.EI, 1e-12)
      share(GJ, c.GJ, 1e-6)
      assert.is_nil(next(c.springs))
      share(known.E, c.modulus, 0.005)
      share(known.core_E, c.core_modulus, 0.005)
      near(known.nu, c.nu, 0.005) -- nu makes GJ, with the corners' correction
    end
  end)

  it("takes the core's material from any of its given values", function()
    local EA, EI, GJ = sums(with(JACKET))
    local Ac = math.pi * (0.7 * R) ^ 2
    for _, given in ipairs { { core_E = 1e8 }, { core_EA = 1e8 * Ac }, { core_EA = 1e8 * Ac, E = 1e7 } } do
      local c = calibrate(with({ EA = EA, EI = EI, GJ = GJ, core_radius = 0.7 * R, nu = 0.4, core_nu = 0.3 },
        given))
      share(10, c.core_modulus / c.modulus, 1e-9)
      share(1e7, c.modulus, 0.005)
    end
    -- core_radius follows from wall
    share(0.7 * R, calibrate(with({ E = 1e7, wall = 0.3 * R })).core_radius, 1e-12)
  end)

  it("adds springs where two materials do not suffice, and then meets every target", function()
    for _, case in ipairs {
      { EA = 137e3, EI = 1.28e-3, GJ = 1.6e-3, radius = 1.2e-3 }, -- strands that slip
      { EA = 137e3, EI = 1.28e-3, GJ = 0.4e-3, radius = 1.2e-3 },
      { cable = "GXL 1.5", nu = 0.4, radius = false }, -- a catalogue's
      { EA = 5000, EI = 0.002, GJ = 0.0015, nu = 0.3, core_E = 1e8 },
    } do
      local args = with(case)
      if args.radius == false then args.radius = nil end
      local c = calibrate(args)
      for _, name in ipairs { "EA", "EI", "GJ" } do near(0, c.residuals[name], 1e-8, name) end
      assert.is_truthy(next(c.springs))
      tools.above(0, c.modulus)
      tools.above(0, c.core_modulus)
      local again = calibrate.cell { spacing = c.spacing, particles = c.particles, links = c.links,
        stiffness = c.springs, elements = c.elements }
      for _, name in ipairs { "EA", "EI", "GJ" } do share(c[name], again[name], 1e-9, name) end
    end
  end)
end)

describe("mass of a composite of elements", function()
  local rc = 0.7 * R
  local function mass_of(c)
    local whole, moment = 0, 0
    for i, p in ipairs(c.particles) do
      local m = c.mass[i] / c.spacing
      whole, moment = whole + m, moment + m * (p[1] ^ 2 + p[2] ^ 2)
    end
    return whole, moment
  end

  it("is that of both densities", function()
    local core, shell = 8960 * math.pi * rc ^ 2, 1400 * math.pi * (R ^ 2 - rc ^ 2)
    for _, given in ipairs { { density = 1400, core_density = 8960 },
      { mass_per_length = core + shell, core_mass = core },
      { mass_per_length = core + shell, core_density = 8960 } } do
      local c = calibrate(with(with(JACKET, { particles = 32, layers = 4, core_layers = 6 }), given))
      local whole, moment = mass_of(c)
      share(core + shell, whole, 1e-12, "mass per length")
      -- about the axis; the particles' half layers at the interface and outside: 2 %
      share((core * rc ^ 2 + shell * (R ^ 2 + rc ^ 2)) / 2, moment, 0.02, "moment of inertia")
    end
  end)

  it("is spread by area where the core's mass is not given", function()
    local whole = mass_of(calibrate(with(JACKET, { density = 1000 })))
    share(1000 * math.pi * R ^ 2, whole, 1e-12)
    local c = calibrate(with(JACKET, { particles = 12, layers = 1, core_layers = 2 }))
    -- a particle's area reaches half the way to the next layer
    share((0.35 * 0.5) ^ 2, c.shares[1], 1e-12)
    share((1 - 0.85 ^ 2) / 12, c.shares[#c.shares], 1e-12)
  end)
end)

describe("a composite of elements refuses", function()
  local function refused(more, ...)
    local ok, message = pcall(calibrate, with({ E = 1e7, nu = 0.4 }, more))
    assert.is_false(ok)
    for _, text in ipairs { "composite_solid_spec", ... } do
      assert.is_truthy(message:find(text, 1, true), message)
    end
  end

  it("combinations that are not possible", function()
    refused({ cores = 3 }, "cores = 3 does not go with body = 'solid'", "take cores = 1, or body = 'springs'")
    refused({ bonded = false }, "bonded = false does not go with body = 'solid'", "take bonded = true")
    refused({ bonded = false, friction = 0.3, grip = 5 }, "bonded = false does not go with")
    refused({ core = "line" }, "core = 'line' does not go with body = 'solid'; take core = 'radial'")
    refused({ core = "cubic" }, "core = 'cubic' does not go")
    refused({ core_EI = 1e-3 }, "core_EI = 0.001 N m2 does not go with body = 'solid'", "leave it out")
    refused({ core_GJ = 1e-3 }, "core_GJ = 0.001 N m2")
    refused({ bond = 2 }, "bond = 2 - does not go with body = 'solid'")
    refused({ reach = 2 }, "reach = 2")
    refused({ core_particles = 8 }, "core_particles = 8", "follows from particles")
    refused({ squeeze = 1e6 }, "squeeze = 1e+06 Pa goes with body = 'springs'")
    refused({ density = 1000, spin_inertia = 1e-9 }, "spin_inertia goes with mesh = 'tube'")
    refused({ friction = 0.2 }, "friction = 0.2 goes with bonded = false")
  end)

  it("wrong numbers", function()
    refused({ core_e = 1e8 }, "no parameter 'core_e'; did you mean 'core_E'?")
    refused({ core_E = -1 }, "core_E = -1 Pa is not allowed; it must be above 0 Pa")
    refused({ core_nu = 0.5 }, "core_nu = 0.5 is not allowed; it must be in [0, 0.4999]")
    refused({ nu = 0.5 }, "nu = 0.5 of solid elements must be in [0, 0.4999]")
    refused({ layers = 7 }, "layers = 7 is not allowed; it must be in [0, 6]")
    refused({ particles = 64, layers = 4, core_layers = 5 }, "577 in a slice; at most 512",
      "reduce particles, core_layers or layers")
    refused({ core_E = 1e8, core_EA = 5 }, "core_E = 1e+08 Pa and core_EA = 5 N describe the same stiffness")
    refused({ core_mass = 1e-3, core_density = 1e3, density = 1 }, "describe the same mass; give one of them")
    refused({ core_density = 1e3 }, "core_density = 1000 kg/m3 goes with the shell's density")
    refused({ core_mass = 1, density = 1000 }, "core_mass = 1 kg/m with cores = 1 must be in")
    refused({ core_density = 1e4, mass_per_length = 0.1 },
      "core_density = 10000 kg/m3 must be in (0, 3536.78)",
      "the wire's mass of 0.1 kg/m")
    refused({ core_radius = R }, "core_radius = 0.005 m must be in (0, 0.005) m")
    refused({ wall = R }, "wall = 0.005 m must be in (0, 0.005) m")
    refused({ wall = 0.2 * R, core_radius = 0.5 * R }, "leave a gap", "leave one of them out")
    refused({ core_E = 1e14 }, "makes the core 1e+07 times as stiff as the shell", "1e-06 to 1e+06 times")
    local EA, EI, GJ = 5000, 0.02, 0.015
    local ok, message = pcall(calibrate, with { EA = EA, EI = EI, GJ = GJ, core_EA = 6000 })
    assert.is_false(ok)
    assert.is_truthy(message:find("core_EA = 6000 N must be in (0, 5000) N", 1, true), message)
    ok, message = pcall(calibrate, with { EA = EA, EI = EI, GJ = GJ, core_E = 1e9 })
    assert.is_false(ok)
    assert.is_truthy(message:find("core_E = 1e+09 Pa must be in (0, 1.76839e+08) Pa", 1, true), message)
  end)

  it("parameters of elements for a body of springs", function()
    for key, value in pairs { core_E = 1e8, core_nu = 0.3, core_density = 1e3, layers = 2 } do
      refused({ section = "springs", [key] = value }, key .. " = ", "goes with body = 'solid'")
    end
  end)
end)
