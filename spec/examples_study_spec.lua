-- SPDX-License-Identifier: GPL-3.0-or-later
-- Examples of tuning, studies, fits and checks: the numbers that they print.
local examples = require "spec.examples"
require "softworld"

local example, after, near, program = examples.run, examples.after, examples.near, examples.program
local g = 9.81

describe("example", function()
  teardown(program.clean)

  -- Independent shooting solution of the heavy cantilever: w L^3 / EI = 4.641588834 has the droop
  -- 0.4721301176 L, which is 0.37770 m at 0.8 m. So EI = w L^3 / 4.641588834. 60 segments are off by about
  -- 2e-4 in the droop, so by about the same share in EI.
  it("05: finds the bending stiffness from a droop", function()
    local out = example "05_tuning"
    near(0.03 * g * 0.8 ^ 3 / 4.641588834, after(out, "EI ="), 1e-3, "EI")
    near(0.3777, after(out, "droop"), 1e-4, "droop")
    assert.is_true(after(out, "after") <= 40)
  end)

  -- Holding at rest takes weight / (2 mu). Lifting by d = 0.25 m in T = 0.5 s accelerates by at most 5.77 d
  -- / T^2, and the wire's ends swing: the force is above that of g + 5.77 d / T^2 and below four times the
  -- force at rest.
  it("18: the least force that lifts a wire", function()
    local out = example "18_least_force"
    local least, rest = after(out, "least force"), after(out, "(2 mu) =")
    local heavier = 1 + 5.77 * 0.25 / 0.5 ^ 2 / g
    assert(least > heavier * rest and least < 4 * rest, ("%g N, at rest %g N"):format(least, rest))
    local failed, held = 0, math.huge
    for force, what in out:gmatch "(%S+) N: (%a+)" do
      if what == "slips" then failed = math.max(failed, tonumber(force))
      else held = math.min(held, tonumber(force)) end
    end
    assert(failed < held and held <= 1.021 * failed + 1e-3, "bracket")
    near(held, least, 1e-3, "least force")
  end)

  -- The same gripper as in 18, which halves an interval until it is 2 % wide, so both values are right to 2
  -- %. The force is proportional to 1 / friction, so twice the least force at 0.4 holds from 0.2 on. For a
  -- normal distribution about 0.4 with sigma 0.1, cut 2.5 sigma below it, that is a share of 1 - (0.02275 -
  -- 0.00621) / (1 - 0.00621).
  it("20: a study of the least force, and how often twice this force holds", function()
    local out = example "20_study"
    local least = after(example "18_least_force", "least force")
    near(least, after(out, "least force "), 0.022, "least force")
    local share = after(out, "twice that holds in")
    local low, high = out:match "interval (%S+) to (%S+) %%"
    assert.is_true(tonumber(low) < share and share < tonumber(high))
    local expected = 100 * (1 - (0.02275 - 0.00621) / (1 - 0.00621))
    assert.is_true(tonumber(low) < expected and expected < tonumber(high), out)
    assert.truthy(out:find("study 'least force': %d+ evaluations\n"))
  end)

  -- A hanging wire is lifted by h in T along a polynomial of degree 5 (T. Flash, N. Hogan 1985), whose
  -- largest acceleration is 10 / sqrt(3) h / T^2; it pulls with m (g + this acceleration). A row with a lift
  -- higher than needed is dominated by others sooner or later. m of the catalogue's cable: 0.01929 kg/m over
  -- 0.4 m.
  it("21: the front of time and force", function()
    local out = example "21_pareto"
    local count, lean, before = 0, 0, math.huge
    local shape = "(%S+) s: (%S+) N, lifted by (%S+) m; a rigid body would pull with (%S+) N"
    for time, peak, height, rigid in out:gmatch(shape) do
      time, peak, height, rigid = tonumber(time), tonumber(peak), tonumber(height), tonumber(rigid)
      near(rigid, peak, 0.02, "peak")
      near(0.01929 * 0.4 * (g + 5.7735 * height / time ^ 2), peak, 0.02, "peak by hand")
      assert.is_true(peak <= before and height >= 0.2499 and height < 0.32, ("lifted by %g"):format(height))
      count, before, lean = count + 1, peak, lean + (height < 0.262 and 1 or 0)
    end
    assert.is_true(count >= 20 and lean > count / 2)
    assert.truthy(out:find "front of time, peak: %d+ of 400 evaluations, 0 failed")
    assert.truthy(out:find "knee: evaluation")
  end)

  -- Points of a stiff catenary between level clamps, weight L^3 / EI = 100 and L / span = 1.05
  -- (boundary-value solver, error 1e-9), seen by an oblique camera, with normal noise of 0.6 mm and rounding
  -- to pixels; twists at which a clamped rod buckles at T L^2 / EI = 20 and 100 (determinant, error 1e-10),
  -- with noise of 0.2 rad, GJ = 0.0032 N m2; a pull of EA = 140 kN, with noise of 3 um.
  it("22: the stiffnesses of a cable from measurements", function()
    local out = example "22_calibration"
    for name, truth in pairs { EI = 0.0268 * g / 100, GJ = 0.0032, EA = 1.4e5 } do
      local shape = "\n  " .. name .. " +(%S+) N%S* ?%S*, 95 %% interval (%S+) to (%S+)"
      local value, low, high = out:match(shape)
      assert.is_true(tonumber(low) < truth and truth < tonumber(high), out)
      near(truth, tonumber(value), 0.05, name)
    end
    assert.truthy(out:find("EI +0.0026%d* *N m2 +0.002%d+ .. 0.002%d+ +measured  bench, photo"), out)
  end)

  -- A small droop is w L^4 / (8 EI), to half a per cent. With log EI uniform from a to b and L uniform, the
  -- share is the mean over L of the share of EI above w L^4 / (8 limit).
  it("23: how often a cable's end is within reach", function()
    local out = example "23_cluster"
    local low, high = out:match "interval (%S+) to (%S+) %%"
    local w, limit, a, b, sum = 0.02 * g, 0.003, 0.002, 0.02, 0
    for k = 1, 1000 do
      local length = 0.1 + 0.1 * (k - 0.5) / 1000
      local least = w * length ^ 4 / (8 * limit)
      sum = sum + math.max(0, math.min(1, math.log(b / least) / math.log(b / a)))
    end
    local share = after(out, "within reach in")
    assert.is_true(tonumber(low) < share and share < tonumber(high))
    assert.is_true(tonumber(low) < sum / 10 and sum / 10 < tonumber(high), out .. sum / 10)
    local droop, EI, free = out:match "worst: (%S+) mm at EI = (%S+) N m2 with (%S+) mm"
    near(1e3 * w * (1e-3 * free) ^ 4 / (8 * EI), tonumber(droop), 0.02, "droop")
  end)

  -- Half a circle of length L: the inside radius is L / pi less the wire's radius, 1.5 mm, and the moment is
  -- pi EI / L. IEC 62440 allows 5 diameters, 15 mm, so the first length lacks 16.5 mm - 40 mm / pi. The
  -- curvatures of 50 edges, which inertia bends slightly, are printed to four digits: 0.3 %. With 5 % in
  -- reserve the length is pi (1.05 * 15 + 1.5) mm, found to 1 % of its range, 0.6 mm. Slopes: 1 / pi, and pi
  -- EI / L^2; a parabola through +- 1.5 and 3 mm is 7.65 mm^2 / L^2 = 0.5 % steeper.
  it("24: a report that fails, proposes a change, and passes", function()
    local out = example "24_check"
    local radii, moments = {}, {}
    for verdict, radius in out:gmatch "(%u+)  cable.min_bend_radius +(%S+) mm +>= 15.00 mm +standard" do
      radii[#radii + 1] = { verdict, tonumber(radius) }
    end
    for verdict, value in out:gmatch "(%u+)  moment on the plug +(%S+) mN m +<= 90.00 mN m  user" do
      moments[#moments + 1] = { verdict, tonumber(value) }
    end
    assert.same({ 2, 2 }, { #radii, #moments })
    local EI = require "softworld".cable "GXL 1.5".EI.value
    local found = after(out, "raise free from 40.00 mm to ")
    for i, length in ipairs{ 40, found } do
      local wanted = i == 1 and "FAIL" or "PASS"
      assert.same({ wanted, wanted }, { radii[i][1], moments[i][1] })
      near(length / math.pi - 1.5, radii[i][2], 3e-3, "inside radius")
      near(1e6 * math.pi * EI / length, moments[i][2], 3e-3, "moment")
    end
    near(math.pi * (1.05 * 15 + 1.5) + 0.3, found, 8e-3, "length")
    local radius, more = out:match "; margin (%S+) mm for each 10.-; margin (%S+) mN m for each 10"
    near(10 / math.pi, tonumber(radius), 3e-3, "slope of the radius")
    near(1.0048 * 1e7 * math.pi * EI / 40 ^ 2, tonumber(more), 3e-3, "slope of the moment")
    assert.is_truthy(out:find "duration does not help.*FAIL %-> PASS  cable.min_bend_radius")
    local _, err, code = program.run{ "--check", "examples/24_check.lua" }
    assert.equal(0, code, err)
  end)
end)
