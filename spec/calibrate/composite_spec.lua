-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shells around cores, made of springs: the stated values against calibrate.cell of the whole mesh and of
-- its parts, and against beams of finite length.
local sw = require "softworld"
local beam = require "calibrate.beam"
local tools = require "physics.tools"
local near, share = tools.near, tools.share
local calibrate = sw.calibrate

-- Tolerance of the values that the springs are fitted to; the search itself ends at 1e-11.
local FITTED = 1e-8

local function with(base, more)
  local args = { mesh = "composite" }
  for _, t in ipairs { base, more or {} } do
    for key, value in pairs(t) do args[key] = value end
  end
  return args
end

local SOLID = { E = 1e8, nu = 0.35, radius = 0.005 }
local EA = 1e8 * math.pi * 0.005 ^ 2
local EI = EA * 0.005 ^ 2 / 4
local WIRE = { EA = EA, EI = EI, GJ = EI / 1.35, radius = 0.005 }
local CABLE = { EA = 137e3, EI = 1.28e-3, GJ = 1.6e-3, radius = 1.2e-3 } -- strands that slip

-- The mesh of one part, about the part's own axis.
local function part_of(c, number)
  local centre, index, particles, links = c.centres[number] or { 0, 0 }, {}, {}, {}
  for i, p in ipairs(c.particles) do
    if c.part[i] == number then
      particles[#particles + 1] = { p[1] - centre[1], p[2] - centre[2], p[3] }
      index[i] = #particles
    end
  end
  for _, l in ipairs(c.links) do
    if index[l.from] and index[l.to] then
      links[#links + 1] = { from = index[l.from], to = index[l.to], slices = l.slices, group = l.group,
        weight = l.weight, bend = l.bend }
    end
  end
  return { spacing = c.spacing, particles = particles, links = links, stiffness = c.springs }
end

local function whole(c)
  return calibrate.cell { spacing = c.spacing, particles = c.particles, links = c.links,
    stiffness = c.springs }
end

-- { title, arguments }
local cases = {}
for _, core in ipairs { "line", "radial", "cubic" } do
  for cores = 1, 7 do
    cases[#cases + 1] = { cores .. " x " .. core, with(WIRE, { core = core, cores = cores }) }
  end
  cases[#cases + 1] = { core .. " with most of EA",
    with(WIRE, { core = core, core_EA = 0.5 * EA, core_EI = 0.1 * EI }) }
  cases[#cases + 1] = { core .. " in a wire with 5 EA", with(WIRE, { core = core, EA = 5 * EA }) }
  cases[#cases + 1] = { core .. " in a wire that hardly twists", with(WIRE, { core = core, GJ = 1.3 * EI }) }
  cases[#cases + 1] = { core .. " in a wire that twists easily", with(WIRE, { core = core, GJ = 0.2 * EI }) }
  cases[#cases + 1] = { core .. " that is thin", with(WIRE, { core = core, core_radius = 0.0015 }) }
  cases[#cases + 1] = { core .. " in a thin wall", with(WIRE, { core = core, core_radius = 0.0045 }) }
  cases[#cases + 1] = { core .. " with room around it",
    with(WIRE, { core = core, core_radius = 0.003, wall = 0.001 }) }
  cases[#cases + 1] = { core .. " in a stranded cable", with(CABLE, { core = core }) }
  for _, particles in ipairs { 3, 8, 24 } do
    cases[#cases + 1] = { core .. " in a ring of " .. particles,
      with(WIRE, { core = core, particles = particles }) }
  end
end
cases[#cases + 1] = { "a fine radial core", with(WIRE, { core_layers = 3, core_particles = 12 }) }
cases[#cases + 1] = { "a fine cubic core", with(WIRE, { core = "cubic", core_across = 8 }) }
cases[#cases + 1] = { "long slices", with(WIRE, { spacing = 0.003 }) }
cases[#cases + 1] = { "3 fine cores", with(WIRE, { cores = 3, core_layers = 2, core_particles = 8 }) }

-- Checks that EA, EI and GJ are those asked for.
local function asked(args, c, what)
  for _, name in ipairs { "EA", "EI", "GJ" } do
    share(args[name], c[name], FITTED, what .. ": " .. name)
    near(0, c.residuals[name], FITTED, what .. ": residual of " .. name)
  end
end

describe("a bonded composite", function()
  it("is the wire, by calibrate.cell of its links", function()
    for _, case in ipairs(cases) do
      local c = calibrate(case[2])
      local b = whole(c)
      asked(case[2], c, case[1])
      for _, name in ipairs { "EA", "EI", "EI2", "GJ" } do
        share(c[name], b[name], 1e-9, case[1] .. ": " .. name .. " of the cell") -- the same sums
      end
      tools.above(0, c.springs.bond, "bonds")
      assert.is_true(#c.particles <= 512)
    end
  end)

  it("has parts with the stated EA, EI and GJ", function()
    for _, case in ipairs(cases) do
      local c = calibrate(case[2])
      for number = 0, #c.centres do
        local b, said = calibrate.cell(part_of(c, number)), number == 0 and c.shell or c.core
        for _, name in ipairs { "EA", "EI", "GJ" } do
          -- a line has GJ = 0; turning cores off the axis rounds their places
          near(said[name], b[name], 1e-8 * c[name], case[1] .. ": " .. name .. " of part " .. number)
        end
      end
      for _, name in ipairs { "EA", "EI", "GJ" } do
        local given = case[2]["core_" .. name]
        if given then share(given, c.core[name], FITTED, case[1] .. ": core_" .. name) end
      end
    end
  end)

  it("bends alike in all planes, except with two cores", function()
    for _, case in ipairs(cases) do
      local args, c = case[2], calibrate(case[2])
      local C4 = args.core == "cubic" and (args.cores or 1) % 6 == 1 -- a square in the middle
      if args.cores == 2 then
        tools.below(0.9, c.EI2 / c.EI, case[1]) -- the two lie in the plane of EI
      elseif not (C4 and (args.cores == 7 or (args.particles or 12) % 4 ~= 0)) then
        share(c.EI, c.EI2, 1e-9, case[1]) -- by symmetry, to rounding
      else
        share(c.EI, c.EI2, 0.02, case[1]) -- a square in a ring without its symmetry
      end
    end
  end)

  -- A section that stays plane has the EI of its parts plus EA a^2 of the parts off the axis. The rest is
  -- carried by the bonds, up to a tenth of the smaller EA (2.5 % of the whole for two equal parts), and by
  -- parts that resist each other's contraction.
  it("acts as one section", function()
    for _, case in ipairs(cases) do
      local c = calibrate(case[2])
      local EI_plane, EA_sum = c.shell.EI, c.shell.EA
      for _, p in ipairs(c.centres) do
        EI_plane, EA_sum = EI_plane + c.core.EI + c.core.EA * p[1] ^ 2, EA_sum + c.core.EA
      end
      near(1, EI_plane / c.EI, 0.08, case[1] .. ": EI")
      near(1, EA_sum / c.EA, 0.05, case[1] .. ": EA")
    end
  end)

  -- The zones at the ends, where bonds pass loads between shell and core, add the same at each length.
  it("is the wire as a beam of finite length", function()
    for _, more in ipairs { {}, { core = "line" }, { cores = 3, core = "line" } } do
      local args = with(WIRE, more)
      local c = calibrate(args)
      local b = beam.stiffness(c, 36, 8)
      share(c.EA, b.EA, 1e-4, "EA of beams")
      share(c.EI, b.EI, 1e-4, "EI of beams, by a moment")
      share(c.EI, b.EI_by_force, 1e-3, "EI of beams, by a force") -- a third difference
      share(c.GJ, b.GJ, 1e-4, "GJ of beams")
    end
  end)

  it("has bonds as stiff as asked for", function()
    local usual = calibrate(with(WIRE))
    local soft = calibrate(with(WIRE, { bond = 0.1 }))
    share(0.1, soft.springs.bond / usual.springs.bond, 1e-9)
    share(EI, soft.EI, FITTED)
    -- soft bonds leave each part to itself: the sums are closer to the whole
    tools.below(math.abs(1 - usual.shell.EI / EI - usual.core.EI / EI),
      math.abs(1 - soft.shell.EI / EI - soft.core.EI / EI), "what bonds carry")
  end)
end)

describe("a sliding composite", function()
  it("has the sums of its parts' EA, EI and GJ, each about its own axis", function()
    for _, case in ipairs(cases) do
      local args = with(case[2], { bonded = false })
      local c = calibrate(args)
      asked(args, c, case[1])
      share(c.EI, c.EI2, 1e-9, case[1]) -- with any number of cores
      local sum = { EA = 0, EI = 0, EI2 = 0, GJ = 0 }
      for number = 0, #c.centres do
        local b = calibrate.cell(part_of(c, number))
        for name, value in pairs(sum) do sum[name] = value + b[name] end
      end
      for name, value in pairs(sum) do share(c[name], value, FITTED, case[1] .. ": sum of " .. name) end
      assert.are.equal(0, c.springs.bond)
    end
  end)

  -- calibrate.cell of all particles keeps sections plane, so it bends cores off the axis about the wire's
  -- axis. With one core it is the same.
  it("differs from its cell by EA a^2 only", function()
    for _, cores in ipairs { 1, 2, 3, 7 } do
      local c = calibrate(with(WIRE, { cores = cores, bonded = false }))
      local b, aside = whole(c), 0
      for _, p in ipairs(c.centres) do aside = aside + c.core.EA * p[1] ^ 2 end
      share(c.EA, b.EA, 1e-8, "EA")
      share(c.GJ, b.GJ, 1e-8, "GJ")
      share(c.EI + aside, b.EI, 1e-8, "EI")
    end
  end)

  it("names the particles that face each other", function()
    for _, case in ipairs(cases) do
      local c = calibrate(with(case[2], { bonded = false }))
      local slides, shell, touched = 0, 0, {}
      for _, l in ipairs(c.links) do
        if l.slide then
          slides = slides + 1
          assert.are_not.equal(c.part[l.from], c.part[l.to])
          assert.are.equal(0, l.weight)
          assert.are.equal(0, l.slices)
          local p, q, along, length = c.particles[l.from], c.particles[l.to], 0, 0
          for i = 1, 3 do
            along = along + (q[i] - p[i]) * l.direction[i]
            length = length + l.direction[i] ^ 2
          end
          share(1, length, 1e-12, case[1])
          share(tools.distance(p, q), along, 1e-12, case[1])
          tools.above(-1e-12, l.gap, case[1] .. ": gap [m]")
          if c.part[l.from] == 0 then shell = shell + 1 end
          if #c.centres == 1 then near(c.bore - c.core_radius, l.gap, 1e-12, case[1] .. ": gap [m]") end
          touched[c.part[l.from]], touched[c.part[l.to]] = true, true
        end
      end
      assert.are.equal(slides, c.count.bond)
      local least = #c.centres == 1 and (case[2].particles or 12) or 2
      tools.above(least, shell, case[1] .. ": pairs of the shell")
      for number = 0, #c.centres do assert.is_true(touched[number], case[1] .. ": part " .. number) end
    end
  end)
end)

describe("a composite's mass", function()
  -- A ring at the shell's radius of gyration has the shell's moment of inertia. Cores of few layers have up
  -- to a fifth more than solid ones, because their outermost particles are on the surface.
  it("is the wire's, and distributed as in a wire", function()
    for _, cores in ipairs { 1, 3, 7 } do
      for _, core in ipairs { "line", "radial", "cubic" } do
        local c = calibrate(with(SOLID, { density = 1200, cores = cores, core = core }))
        local mass, shares, moment = 0, 0, { 0, 0 }
        for i, p in ipairs(c.particles) do
          mass, shares = mass + c.mass[i] / c.spacing, shares + c.shares[i]
          for k = 1, 2 do moment[k] = moment[k] + c.mass[i] / c.spacing * p[k] ^ 2 end
        end
        share(1, shares, 1e-12)
        share(1200 * math.pi * 0.005 ^ 2, mass, 1e-12)
        share(moment[1], moment[2], 1e-9, "moments of inertia in two planes")
        if cores == 1 then
          -- of a solid section; a line core has no moment of its own, an eighth of the whole
          share(mass * 0.005 ^ 2 / 4, moment[1], 0.15, core .. ": moment of inertia")
        else
          -- more mass is outside, at most all of it at the surface
          tools.above(mass * 0.005 ^ 2 / 4, moment[1], core .. ": moment of inertia")
          tools.below(mass * 0.005 ^ 2 / 2, moment[1], core .. ": moment of inertia")
        end
      end
    end
  end)

  it("has the core's share", function()
    local c = calibrate(with(WIRE, { mass_per_length = 0.1, core_mass = 0.02, cores = 3 }))
    local cores = { 0, 0, 0 }
    for i, number in ipairs(c.part) do
      if number > 0 then cores[number] = cores[number] + c.mass[i] / c.spacing end
    end
    for _, mass in ipairs(cores) do share(0.02, mass, 1e-12) end
  end)
end)

describe("composites", function()
  it("of one material share EA and EI by their sections", function()
    local c = calibrate(with(SOLID, { bonded = false }))
    share(0.36 * EA, c.core.EA, 1e-9)
    share(0.1296 * EI, c.core.EI, FITTED)
    share(0.64 * EA, c.shell.EA, FITTED)
    local three = calibrate(with(SOLID, { cores = 3, core_radius = 0.0015, wall = 0.001 }))
    local wall, core = 0.005 ^ 2 - 0.004 ^ 2, 0.0015 ^ 2
    -- wall and cores share EI by their second moments; the rest of the section is empty
    local I = (0.005 ^ 4 - 0.004 ^ 4) / 4 + 3 * core ^ 2 / 4 + 1.5 * core * 0.0025 ^ 2
    local E = EI / (math.pi * I)
    share(EI * core ^ 2 / 4 / I, calibrate(with(SOLID, { cores = 3, core_radius = 0.0015, wall = 0.001,
      EA = E * math.pi * (wall + 3 * core) })).core.EI, FITTED)
    assert.are.equal(3, #three.centres)
    share(0.0025, math.sqrt(three.centres[2][1] ^ 2 + three.centres[2][2] ^ 2), 1e-12)
  end)

  it("take a catalogue's cable", function()
    local c = calibrate { mesh = "composite", cable = "GXL 1.5" }
    share(sw.cable "GXL 1.5".EI.value, c.EI, FITTED)
    tools.above(0.9, c.core.EA / c.EA, "share of EA in the core") -- the shell bears bending, not pull
  end)

  it("give the same springs again, and scaled ones in other units", function()
    local c, again = calibrate(with(SOLID)), calibrate(with(SOLID))
    local big = calibrate(with { E = 1e11, nu = 0.35, radius = 5 })
    for group, k in pairs(c.springs) do
      assert.are.equal(k, again.springs[group])
      share(k * 1e6, big.springs[group], 1e-6, group)
    end
  end)

  it("print themselves", function()
    local text = tostring(calibrate(with(SOLID)))
    for _, word in ipairs { "composite of 25 particles", "diagonal", "bond", "core_line", "core_hoop" } do
      assert.is_truthy(text:find(word, 1, true), text)
    end
    assert.is_truthy(tostring(calibrate(with(SOLID, { core = "line" }))):find("core_bend +%S+ N m"))
  end)
end)

describe("a composite refuses", function()
  local function refused(args, ...)
    local ok, message = pcall(calibrate, args)
    assert.is_false(ok)
    for _, text in ipairs { "composite_spec", ... } do
      assert.is_truthy(message:find(text, 1, true), message)
    end
  end

  it("wrong arguments", function()
    refused(with(SOLID, { core = "radail" }), "'radail' is not one of: line, radial, cubic; did you mean")
    refused(with(SOLID, { core = true }), "core")
    refused(with(SOLID, { coers = 3 }), "no parameter 'coers'; did you mean 'cores'?")
    refused(with(SOLID, { cores = 8 }), "cores = 8 is not allowed; it must be in [1, 7]")
    refused(with(SOLID, { particles = 2 }), "particles = 2 is not allowed; it must be 0 (chooses) or "
      .. "in [3, 64]")
    refused(with(SOLID, { particles = 16, cores = 5 }), "particles = 16 must be a multiple of the 5 cores "
      .. "around the axis", "give 20")
    refused(with(SOLID, { particles = 8, reach = 4 }), "reach = 4 must be below half of particles = 8")
    refused(with(SOLID, { core_particles = 2 }), "core_particles = 2 is not allowed")
    refused(with(SOLID, { core = "line", core_layers = 2 }),
      "core_layers = 2 goes with core = 'radial', not with 'line'")
    refused(with(SOLID, { core_across = 2 }), "core_across = 2 goes with core = 'cubic', not with 'radial'")
    refused(with(SOLID, { core = "line", core_GJ = 0.01 }), "core_GJ = 0.01 N m2: core = 'line' does not "
      .. "resist twist", "leave core_GJ out")
    refused(with(SOLID, { bonded = false, bond = 2 }), "bond = 2 goes with bonded = true")
    refused(with(SOLID, { bond = 0 }), "bond = 0 is not allowed; it must be in (0, 100]")
    refused(with(SOLID, { squeeze = 1e6 }), "squeeze = 1e+06 Pa goes with mesh = 'tube', 'radial' or 'cubic'")
    refused(with(SOLID, { density = 1000, spin_inertia = 1e-9 }),
      "spin_inertia = 1e-09 kg m goes with mesh = 'tube'")
    refused(with(SOLID, { core_mass = 0.1 }), "core_mass = 0.1 kg/m goes with the wire's mass_per_length")
    refused(with(SOLID, { mass_per_length = 0.1, cores = 3, core_mass = 0.04 }),
      "core_mass = 0.04 kg/m with cores = 3 must be in (0, 0.0333333) kg/m")
  end)

  it("cores that do not fit", function()
    refused(with(SOLID, { core_radius = 0.005 }), "core_radius = 0.005 m must be in (0, 0.005) m")
    refused(with(SOLID, { core_radius = 0.004, wall = 0.002 }), "core_radius = 0.004 m is not allowed; "
      .. "1 core fits in a bore of 0.003 m with a radius in (0, 0.003] m: reduce core_radius or wall")
    refused(with(SOLID, { cores = 3, core_radius = 0.002 }), "core_radius = 0.002 m is not allowed; "
      .. "3 cores fit in a bore of 0.004 m with a radius in (0, 0.00181928] m")
    refused(with(SOLID, { cores = 7, core_radius = 0.0015 }), "7 cores fit in a bore of 0.004 m")
    refused(with(SOLID, { wall = 0.006 }), "wall = 0.006 m must be in (0, 0.005) m, below the wire's radius")
    refused(with(SOLID, { cores = 7, core_layers = 6, core_particles = 20 }),
      "121 of each core (cores = 7) are 859 in a slice; at most 512: reduce core_layers")
  end)

  it("a part that has more than the wire", function()
    refused(with(WIRE, { core_EA = 1.1 * EA }),
      "core_EA = 8639.38 N with cores = 1 must be in (0, 7853.98) N", "reduce core_EA")
    refused(with(WIRE, { cores = 3, core_EI = 0.5 * EI }), "core_EI = 0.0245437 N m2 with cores = 3 "
      .. "must be in (0, 0.0163625) N m2")
    refused(with(WIRE, { core_GJ = EI }), "core_GJ = 0.0490874 N m2 with cores = 1 must be in (0, ")
    refused(with(WIRE, { core_EA = 0.9 * EA }), "with core_EA = 7068.58 N", "would be at 0.01043 m, outside "
      .. "of its wall from 0.003 m to 0.005 m: give a core_EA between about 0 N and 4435.9 N")
    refused(with(WIRE, { cores = 3, core_EA = 0.3 * EA, core_EI = 1e-3, EI = 0.2 * EI, GJ = 0.2 * EI }),
      "3 bonded cores with core_EA = 2356.19 N off the axis alone have more than EI", "or bonded = false")
    refused(with(CABLE, { cores = 3 }), "cores = 3 bonded off the axis add their whole EA to bending",
      "give bonded = false, cores = 1 or a larger EI")
    refused(with(WIRE, { EA = 0.5 * EA }), "with the rest of EI = 0.0490874 N m2 would have more than the "
      .. "wire's EA",
      "give a core_EI above")
  end)

  it("targets that cannot be reached, and says what helps", function()
    refused(with(WIRE, { core_EA = 0.01 * EA }), "no springs of the core give core_EA = 78.5398 N",
      "core_EI/core_EA is 8.1e-05 m2, and that of a solid core of this radius is 2.25e-06 m2")
    refused(with(WIRE, { core = "cubic", core_across = 1 }), "increase core_across = 1")
    refused(with(WIRE, { spacing = 0.008 }), "spacing = 0.008 m must be less than about")
    refused(with(WIRE, { core = "line", spacing = 0.02 }), "with spacing = 0.02 m the shell's particles "
      .. "would be at", "make spacing less than about")
    near(0, calibrate(with(WIRE, { core = "line", spacing = 0.006 })).residuals.EI, FITTED)
    refused(with(WIRE, { GJ = 0.02 * EI }), "no springs of the shell give the whole GJ",
      "reduce bond = 1 or core_GJ, or give bonded = false")
    share(0.02 * EI, calibrate(with(WIRE, { GJ = 0.02 * EI, bond = 0.1 })).GJ, FITTED)
    refused(with(WIRE, { core_radius = 0.00498 }), "outside of its wall from 0.00498 m to 0.005 m")
    local nearest = calibrate(with(WIRE, { GJ = 0.02 * EI, tolerance = 1 }))
    tools.above(1e-3, math.abs(nearest.residuals.GJ), "what is off")
  end)
end)
