-- SPDX-License-Identifier: GPL-3.0-or-later
-- Calibration of known cables: data from independent solutions, noise, photographs, files, entries.
local sw = require "softworld"
local plane = require "softworld.calibration.plane"
local program = require "host.program"
local twisted = require "softworld.calibration.twisted"
local sagging = require "spec.calibration.sagging"

local SHAPES, mirrored = sagging.SHAPES, sagging.mirrored
local G = 9.81

local function near(expected, value, tolerance, what)
  local off = math.abs(value / expected - 1)
  assert.is_true(off <= tolerance, ("%s: %.9g instead of %.9g"):format(what or "value", value, expected))
end

local function holds(q, truth)
  assert.is_true(q.low <= truth and truth <= q.high, ("%.6g is not in %.6g to %.6g"):format(truth, q.low,
    q.high))
end

local function generator(seed)
  math.randomseed(seed)
  return function(sigma)
    return sigma * math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
  end
end

describe("sw.calibration of independent solutions", function()
  -- gamma = weight L^3 / EI. The points are on the elastica within 1e-9; rods of 60 and 120 segments are
  -- beside it by some 1e-5 of the length, which sets sigma.
  for _, shape in ipairs(SHAPES) do
    it(("finds EI of a stiff catenary, gamma = %g"):format(shape.gamma), function()
      local EI = 0.02 * G / shape.gamma
      local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004,
        sag = { points = mirrored(shape), length = 1, to = { 1 / shape.ratio, 0 }, sigma = 5e-5 } }
      assert.is_true(found.fit.ok, found.fit.reason)
      holds(found.EI, EI)
      near(EI, found.EI.value, 5e-3)
    end)
  end

  it("finds the same EI from the other side", function()
    local points, shape = mirrored(SHAPES[1]), SHAPES[1]
    local function of(list, sag)
      sag.points, sag.length, sag.sigma = list, 1, 5e-5
      return sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004, sag = sag }.EI
    end
    local turned = {}
    for k, p in ipairs(points) do turned[k] = { 3 - p[1], p[2] + 1 } end
    local one = of(points, { to = { 1 / shape.ratio, 0 } })
    local two = of(turned, { from = { 3, 1 }, to = { 3 - 1 / shape.ratio, 1 } })
    near(one.value, two.value, 1e-6)
    near(one.error, two.error, 1e-4)
  end)

  -- Tip of a heavy cantilever, by shooting, error 1e-9: gamma, x / L, z / L.
  it("finds EI from one tip of a cantilever", function()
    for _, tip in ipairs { { 1, 0.9912463953, -0.123471402 },
      { 4.641588834, 0.8622773968, -0.4721301176 } } do
      local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.008,
        sag = { ends = "cantilever", points = { { tip[2], tip[3] } }, length = 1, sigma = 1e-4 } }
      near(0.02 * G / tip[1], found.EI.value, 1e-3, "gamma = " .. tip[1])
      holds(found.EI, 0.02 * G / tip[1])
    end
  end)

  -- Twist at which a clamped rod buckles: m = M L / EI over t = T L^2 / EI, from the determinant of the
  -- exact equations, error 1e-10. Hinged: (m / 2)^2 - t = pi^2 (Greenhill 1883).
  it("gives the twist at which a rod buckles", function()
    for _, row in ipairs { { -39, 0.8016683171 }, { -20, 5.771135703 }, { 0, 8.986818916 },
      { 20, 11.80032954 }, { 100, 20.98350083 } } do
      near(row[2], twisted.moment(row[1]), 1e-9, "t = " .. row[1])
    end
    assert.is_nil(twisted.moment(-39.5)) -- below -4 pi^2 the rod buckles without a twist
    near(2 * math.pi, twisted.moment(0, true), 1e-15)
    near(2 * math.sqrt(math.pi ^ 2 + 30), twisted.moment(30, true), 1e-15)
    assert.is_nil(twisted.moment(-9.9, true))
    -- smooth where the formulas change, and tends to 2 sqrt(t)
    for _, t in ipairs { -0.02, 0.02 } do
      near(twisted.moment(t * (1 - 1e-9)), twisted.moment(t * (1 + 1e-9)), 1e-9)
    end
    near(2000, twisted.moment(1e6), 1e-5)
    -- q = pi solves 2 q (cos q - cos(m / 2)) = t sin q where m / 2 is an odd multiple k of pi: t = (k^2 - 1)
    -- pi^2. There it was nil, and a tension was said to be a compression that buckles the wire.
    for k = 3, 9, 2 do near(2 * k * math.pi, twisted.moment((k * k - 1) * math.pi ^ 2), 1e-9, "k = " .. k) end
  end)

  it("finds GJ from the twist of buckling, with a known EI", function()
    local EI, GJ, L, T = 2e-3, 1.4e-3, 0.5, 100 * 2e-3 / 0.25
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004, EI = EI,
      twist = { length = L, tension = T, angle = 20.98350083 * EI / GJ, sigma = 0.1 } }
    near(GJ, found.GJ.value, 1e-7)
    assert.is_nil(found.EI)
    -- the relative error is that of the angle
    near(0.1 / (20.98350083 * EI / GJ), found.GJ.error / GJ, 1e-4)
  end)
end)

describe("sw.calibration with errors", function()
  -- GJ = m EI / angle without tension: the relative variances of EI and of the angle add up.
  it("passes the error of EI on to GJ", function()
    local EI, GJ = 2e-3, 1.4e-3
    local angle = 8.986818916 * EI / GJ
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004,
      EI = { EI, sigma = 0.04 * EI }, twist = { length = 0.1, angle = angle, sigma = 0.03 * angle } }
    near(GJ, found.GJ.value, 1e-6)
    near(0.05, found.GJ.error / GJ, 1e-3)
    near(0.8, found.fit.correlation.EI.GJ, 1e-3)
  end)

  -- The sag gives EI / weight: 3 % of the weight are 3 % of EI.
  it("passes the error of the weight on to EI", function()
    local shape = SHAPES[1]
    local function of(mass)
      return sw.calibration { mass_per_length = mass, outer_diameter = 0.004,
        sag = { points = mirrored(shape), length = 1, to = { 1 / shape.ratio, 0 }, sigma = 5e-5 } }.EI
    end
    local sure, unsure = of(0.02), of { 0.02, sigma = 0.0006 }
    near(math.sqrt((sure.error / sure.value) ^ 2 + 0.03 ^ 2), unsure.error / unsure.value, 0.02)
  end)

  -- GJ = 4 pi^2 I L / period^2: its relative error is twice that of the period.
  it("takes the period of a torsional pendulum", function()
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004,
      twist = { length = 0.8, inertia = 2e-5, period = 0.7, sigma = 0.007 } }
    near(4 * math.pi ^ 2 * 2e-5 * 0.8 / 0.49, found.GJ.value, 1e-7)
    near(0.02, found.GJ.error / found.GJ.value, 1e-4)
  end)

  -- A line with an unknown offset: slope Sxy / Sxx, error sigma / sqrt(Sxx).
  it("takes a pull and a squeeze with unknown offsets", function()
    local noise = generator(3)
    local pull, squeeze = { length = 0.5, points = {}, sigma = 1e-5 }, { length = 0.02, points = {} }
    local mean, sxx = 0, 0
    for k = 1, 15 do
      pull.points[k] = { 4 * k, 4 * k * 0.5 / 5e4 + 3e-4 + noise(1e-5) }
      squeeze.points[k] = { k, k / (0.02 * 2e6) - 2e-5 + noise(1e-6) }
      mean = mean + 4 * k / 15
    end
    for k = 1, 15 do sxx = sxx + (4 * k - mean) ^ 2 end
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004, pull = pull,
      squeeze = squeeze }
    holds(found.EA, 5e4)
    holds(found.squeeze, 2e6)
    near(1e-5 / math.sqrt(sxx) * found.EA.value / 0.5, found.EA.error / found.EA.value, 1e-3)
    assert.truthy(found.remarks[1]:find("sigma of plates was not given; ", 1, true), found.remarks[1])
  end)

  it("reports a section that is not linear", function()
    local points = {}
    for k = 1, 15 do points[k] = { k ^ 1.5, k * 1e-4 } end
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004,
      squeeze = { length = 0.02, points = points } }
    assert.truthy(table.concat(found.remarks, "\n"):find("residuals of plates are not random", 1, true))
  end)

  it("reports a sag that tells nothing of EI", function()
    local points = {}
    for k = 1, 9 do -- a catenary with a = 0.2
      local x = k / 10
      local a = 0.2
      local function cosh(v) return (math.exp(v) + math.exp(-v)) / 2 end
      points[k] = { x, a * (cosh((x - 0.5) / a) - cosh(0.5 / a)) }
    end
    local length = 2 * 0.2 * (math.exp(2.5) - math.exp(-2.5)) / 2
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004,
      sag = { points = points, length = length, to = { 1, 0 }, ends = "hung", sigma = 0.002 } }
    local told = table.concat(found.remarks, "\n")
    assert.truthy(told:find "interval of EI reaches an end" or told:find "the wire hangs like a chain", told)
  end)
end)

-- 120 cables with noise, as in the bench. Each 95 % interval holds the truth in 114 +- 2.4 of them; fewer
-- than 105 have a probability of 6e-4 (binomial), all 120 one of 2e-3.
it("intervals of calibrations hold the truth in 95 % of cases", function()
  local bench = dofile "scripts/bench/calibration.lua"
  local EI, GJ, _, _, bad = bench.coverage(120, 2)
  for name, share in pairs { EI = EI, GJ = GJ } do
    assert.is_true(share >= 105 / 120 and share < 1, ("%s: %g"):format(name, share))
  end
  assert.equal(0, bad)
end)

describe("a photograph", function()
  -- A slanted camera: a projective map of the plane's points.
  local function camera(x, z)
    local below = 1 + 0.15 * x - 0.1 * z
    return (400 + 1500 * x + 90 * z) / below, (300 - 60 * x - 1450 * z) / below
  end
  local KNOWN = {}
  for i, p in ipairs { { -0.1, 0.1 }, { 1.1, 0.1 }, { 1.1, -0.4 }, { -0.1, -0.4 } } do
    local u, v = camera(p[1], p[2])
    KNOWN[i] = { u, v, p[1], p[2] }
  end

  it("is mapped back to the plane by four or more known points", function()
    local map = plane.map("test", KNOWN)
    for _, p in ipairs { { 0, 0 }, { 0.5, -0.3 }, { 0.9, 0.05 } } do
      local x, z = map(camera(p[1], p[2]))
      assert.is_true(math.abs(x - p[1]) < 1e-9 and math.abs(z - p[2]) < 1e-9)
    end
    local u, v = camera(0.5, -0.1)
    local five = { KNOWN[1], KNOWN[2], KNOWN[3], KNOWN[4], { u, v, 0.5, -0.1 } }
    local x = plane.map("test", five)(camera(0.3, -0.2))
    assert.is_true(math.abs(x - 0.3) < 1e-9)
    -- the area of a pixel, from differences of the camera: 1 / |d(u, v) / d(x, z)|
    local h = 1e-6
    local u1, v1 = camera(0.5 + h, -0.1)
    local u2, v2 = camera(0.5, -0.1 + h)
    local area = math.abs((u1 - u) * (v2 - v) - (u2 - u) * (v1 - v)) / h ^ 2
    near(1 / math.sqrt(area), plane.scale(map, u, v), 1e-3)
  end)

  it("gives the same EI as the points themselves", function()
    local shape, pixels = SHAPES[1], {}
    local points = mirrored(shape)
    for k, p in ipairs(points) do pixels[k] = { camera(p[1], p[2]) } end
    local function of(sag)
      sag.length, sag.to = 1, { 1 / shape.ratio, 0 }
      return sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004, sag = sag }.EI
    end
    local straight = of { points = points, sigma = 5e-5 }
    local askew = of { points = pixels, pixels = KNOWN, pixel_sigma = 0.075 }
    near(straight.value, askew.value, 1e-4)
    assert.is_true(askew.error > 0.5 * straight.error and askew.error < 2 * straight.error)
  end)

  for text, known in pairs {
    ["at least four known points { u, v, x, z }, got 3"] = { KNOWN[1], KNOWN[2], KNOWN[3] },
    ["at least four known points { u, v, x, z }, got 7"] = 7,
    ["pixels[2] must be { u, v, x, z }"] = { KNOWN[1], { 1, 2, 3 }, KNOWN[3], KNOWN[4] },
    ["pixels[4] must be { u, v, x, z }"] = { KNOWN[1], KNOWN[2], KNOWN[3], { 0 / 0, 1, 2, 3 } },
    ["lie on a line in the picture"] = { KNOWN[1], KNOWN[2], KNOWN[3], { KNOWN[1][1], KNOWN[1][2], 0, 0 } },
    ["lie on a line in the plane"] = { KNOWN[1], KNOWN[2], KNOWN[3], { 9, 9, 0.5, 0.1 } },
    ["in the same order in the picture and in the plane"] = { KNOWN[1], KNOWN[2], KNOWN[3],
      { KNOWN[4][1], KNOWN[4][2], 0.7, 0.0 } },
  } do
    it("is refused: " .. text, function()
      local fine, why = pcall(plane.map, "test", known)
      assert.is_false(fine)
      assert.truthy(why:find(text, 1, true), why)
    end)
  end
end)

describe("a calibrated cable", function()
  teardown(program.clean)
  local function calibrate(more)
    local points = mirrored(SHAPES[1])
    local args = { name = "bench cable", source = "bench 2", mass_per_length = 0.02, outer_diameter = 0.004,
      sag = { points = points, length = 1, to = { 1 / 1.05, 0 }, sigma = 5e-5 },
      twist = { length = 0.5, tension = 2, angle = 12, sigma = 0.2 } }
    for key, value in pairs(more or {}) do args[key] = value end
    return sw.calibration(args)
  end

  it("is an entry flagged measured, with its source and interval", function()
    local found = calibrate()
    local entry = found.cable
    assert.equal("measured", entry.EI.flag)
    assert.equal("bench 2: sag of 19 points", entry.EI.source)
    assert.equal("bench 2: twist that buckles it, 1 reading", entry.GJ.source)
    assert.same({ found.EI.value, found.EI.low, found.EI.high }, { entry.EI.value, entry.EI.low,
      entry.EI.high })
    assert.equal("guessed", entry.EA.flag)
    assert.equal("guessed", entry.friction.flag)
    local scene = sw.scene {}
    local wire = scene:wire { cable = entry, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    near(found.EI.value, wire:get().EI, 1e-12)
    assert.error_matches(function() return sw.cable "bench cable" end, "there is no cable 'bench cable'")
  end)

  it("takes missing values from a similar cable", function()
    local entry = calibrate({ like = "GXL 1.5" }).cable
    assert.equal(sw.cable "GXL 1.5".friction.value, entry.friction.value)
    assert.equal("that of GXL 1.5, assumed to be alike", entry.friction.source)
    assert.equal("guessed", entry.EA.flag)
  end)

  it("can be saved as a Lua file that defines it", function()
    local path = program.folder() .. "/cable.lua"
    local found = calibrate { name = 'odd "name"' }
    assert.equal(path, found:save(path))
    local out = program.script(('local c = dofile(%q)\nprint(("%%a %%s"):format(c.EI.low, c.EI.flag))'
      .. '\nprint(require "softworld".cable(%q).name)'):format(path, 'odd "name"'))
    assert.equal(("%a measured\nodd \"name\"\n"):format(found.EI.low), out)
  end)

  it("has no entry without EI", function()
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004,
      twist = { length = 0.8, inertia = 2e-5, period = 0.7, sigma = 0.007 } }
    assert.error_matches(function() return found.cable end, "a catalogue entry needs EI; give a sag, or EI")
  end)

  it("is drawn, measured and computed", function()
    local path = program.folder() .. "/sag.svg"
    local found = calibrate()
    assert.equal(path, found:chart { path = path })
    local svg = assert(io.open(path)):read "a"
    assert.truthy(svg:find("measured", 1, true) and svg:find("computed", 1, true))
    assert.truthy(found:chart { of = "twist" }:find("tension", 1, true))
    assert.error_matches(function() found:chart { of = "pull" } end, "pull was not measured")
  end)

  it("prints what was found", function()
    local text = tostring(calibrate())
    assert.truthy(text:find("calibration of 'bench cable' from sag of 19 points, twist that buckles it", 1,
      true), text)
    assert.truthy(text:find "EI      0.0%d* N m2, 95 %% interval", text)
  end)
end)
