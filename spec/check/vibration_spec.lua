-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of vibration: natural frequencies of the laid wire against bands, amplitudes under a spectrum.
local sw = require "softworld"

local EI, MASS = 0.01, 0.03
-- omega sqrt(m L^4 / EI) of a rod clamped at both ends, characteristic equation cosh x cos x = 1
local LAMBDA = { 22.373285, 61.672823, 120.903392 }

local function frequency(n) return LAMBDA[n] / (2 * math.pi) * math.sqrt(EI / MASS) end

local function beam(options)
  local scene = sw.scene{ gravity = options and options.gravity or { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", EA = 1e5, EI = EI, mass_per_length = MASS, radius = 0.002,
    segments = options and options.segments or 50, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  scene:clamp(wire, { s = 0 })
  if not (options and options.free) then scene:clamp(wire, { s = 1 }) end
  return scene:run{ duration = 0.02, dt = 0.01 }
end

local function fails(run, words, given)
  local fine, why = pcall(run.check, run, { vibration = given })
  assert.is_false(fine)
  assert.truthy(why:find(words, 1, true), why)
end

describe("run:check of natural frequencies", function()
  local run = beam()
  local function row(bands, more)
    local given = { bands = bands }
    for key, value in pairs(more or {}) do given[key] = value end
    return run:check{ vibration = given }:row "frequency_gap"
  end

  it("gives the distance of the nearest frequency from the bands", function()
    local f1, f2 = frequency(1), frequency(2)
    -- between the first and the second frequency: 10 % above the first, 20 % below the second
    local r = row{ { 1.1 * f1, f2 / 1.2 } }
    assert.is_near(1 - 1 / 1.1, r.value, 0.002)
    assert.same({ "PASS", 0, "definition" }, { r.verdict, r.limit, r.from })
    assert.truthy(r.note:find("mode 2", 1, true) or r.note:find("mode 1", 1, true), r.note)
    r = row{ { 1.3 * f1, f2 / 1.2 } }
    assert.is_near(0.2, r.value, 0.01)
    assert.truthy(r.note:find("mode 3", 1, true) or r.note:find("mode 4", 1, true), r.note)
  end)

  it("fails where a frequency is in a band, also with several bands", function()
    local f2 = frequency(2)
    local r = row{ { 1e-4, 1e-3 }, { 0.95 * f2, 1.2 * f2 } }
    assert.equal("FAIL", r.verdict)
    assert.is_near(-(1 / 0.95 - 1), r.value, 0.005)
    assert.equal("PASS", row({ { 0.95 * f2, 1.2 * f2 } }, { modes = 2 }).verdict, "of the lowest two")
    assert.equal("FAIL", run:check{ vibration = { bands = { { 1e-4, 1e-3 } } }, limits = { frequency_gap = {
      min = 1e9, sure = true } } }:row "frequency_gap".verdict)
  end)

  it("computes modes up to the top of the bands, or is open", function()
    local f3 = frequency(3)
    assert.equal("FAIL", row{ { 0.99 * f3, 1.01 * f3 } }.verdict)
    local long = beam{ segments = 150 }
    local r = long:check{ vibration = { bands = { { 1e5, 2e5 } } } }:row "frequency_gap"
    assert.equal("OPEN", r.verdict)
    assert.truthy(r.note:find("200 modes reach up to", 1, true), r.note)
  end)

  -- With 10 edges the fourth frequency is 17.1, not 18.4 Hz; with 4 edges there is none near 16 Hz. So the
  -- value would be wrong. k^4 = m (2 pi f)^2 / EI gives 14 edges of 1 rad for 16 Hz. From there on the range
  -- of the row contains the exact gap of the fourth, cosh x cos x = 1 at x = 14.137165. Measured errors are
  -- 0.0255 phase^3 for 10 to 60 edges, and twice that for the first frequencies of a cantilever.
  it("is open where edges are too long for waves of the bands, and says how many would do", function()
    local f4 = frequency(1) * (14.137165 / 4.730041) ^ 2
    local function coarse(segments, band)
      return beam{ segments = segments }:check{ vibration = { bands = { band } } }:row "frequency_gap"
    end
    local band = { 15, 16 }
    local k = (MASS * (2 * math.pi * band[2]) ^ 2 / EI) ^ 0.25
    for _, segments in ipairs{ 4, 6, 10 } do
      local r = coarse(segments, band)
      assert.equal("OPEN", r.verdict)
      assert.truthy(r.note:find(("segments = %d would do"):format(math.ceil(k)), 1, true), r.note)
    end
    for _, segments in ipairs{ 14, 20, 60 } do
      local r = coarse(segments, band)
      assert.equal("PASS", r.verdict)
      assert.is_true(r.low <= f4 / band[2] - 1 and r.high >= f4 / band[2] - 1, r.low .. " " .. r.high)
    end
    assert.equal("OPEN", coarse(5, { 1e5, 2e5 }).verdict)
  end)

  -- Two halves of 0.5 m are clamped and joined in the middle. Each by itself is clamped at both ends. The
  -- joint bends as half an edge more: 2 x 2.5 mm / 0.5 m = 1 %.
  it("needs alone = true for joined wires, and then gives each with the others fixed", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local ends = {}
    for k, name in ipairs{ "a", "b" } do
      local wire = scene:wire{ name = name, EA = 1e5, EI = EI, mass_per_length = MASS, radius = 0.002,
        segments = 100, from = { 0.5 * k - 0.5, 0, 0 }, to = { 0.5 * k, 0, 0 } }
      scene:clamp(wire, { s = 0.5 * k - 0.5 })
      ends[k] = { wire, s = 1 - 0.5 * k }
    end
    scene:join{ ends = ends }
    local joined = scene:run{ duration = 0.02, dt = 0.01 }
    local function row_of(alone)
      return joined:check{ vibration = { bands = { { 1, 2 } }, alone = alone } }:row "a.frequency_gap"
    end
    assert.equal("FAIL", row_of().verdict)
    assert.truthy(row_of().note:find("give vibration = { alone = true }", 1, true), row_of().note)
    local f = 4 * frequency(1)
    assert.is_near(f, 2 * (1 + row_of(true).value), 0.015 * f)
    assert.truthy(row_of(true).note:find("the other wires stay fixed", 1, true), row_of(true).note)
  end)

  it("fails for a wire that still moves", function()
    local r = beam{ gravity = { 0, 0, -9.81 }, free = true }:check{ vibration = { bands = { { 1, 2 } } } }
      :row "frequency_gap"
    assert.equal("FAIL", r.verdict)
    assert.truthy(r.note:find("cannot be computed", 1, true), r.note)
    assert.truthy(r.note:find("let the run last until the wire is at rest", 1, true), r.note)
    assert.is_nil(r.note:find("settle", 1, true))
  end)

  -- Frequencies are read when the check is made: without the far clamp they are those of a cantilever.
  it("is open if a hold was released or made after the run, whatever the value", function()
    local bands = { bands = { { 1, 2 } } }
    local spectrum = { spectrum = { { 1, 1 }, { 100, 1 } }, damping = 0.1 }
    for _, change in ipairs{ "release", "pin" } do
      local other = beam()
      local scene = other.scene
      local before = other:check{ vibration = bands }:row "frequency_gap"
      assert.is_true(before.verdict == "PASS" and before.low > 0)
      if change == "pin" then scene:pin(scene:wires()[1], { s = 0.5 })
      else scene:find "clamp2":release() end
      for name, given in pairs{ frequency_gap = bands, vibration_amplitude = spectrum } do
        local after = other:check{ vibration = given, limits = { vibration_amplitude = 1e-9 } }:row(name)
        assert.equal("OPEN", after.verdict, name .. " " .. change)
        assert.truthy(after.note:find((change == "release" and "'clamp2' was released" or "'pin3' was made")
          .. " after the run", 1, true), after.note)
      end
      local again = scene:run{ duration = 0.02, dt = 0.01 }:check{ vibration = bands }:row "frequency_gap"
      assert.is_true(again.verdict ~= "OPEN", again.note) -- a run with these holds
    end
  end)

  it("refuses bands and spectra that make no sense", function()
    local r = run:check{ limits = { frequency_gap = 0.1 } }:row "frequency_gap"
    assert.equal("FAIL", r.verdict)
    fails(run, "bands = { { from, to } } [Hz] or spectrum", {})
    fails(run, "vibration.bands has no band", { bands = {} })
    fails(run, "from = 20 Hz is not below to = 10 Hz", { bands = { { 20, 10 } } })
    fails(run, "vibration.bands[1] must be a pair of numbers, got 20", { bands = { 20, 200 } })
    fails(run, "vibration.bands[1][1] = -1 Hz", { bands = { { -1, 10 } } })
    fails(run, "damping, the ratio of each mode, is required", { spectrum = { { 1, 1 }, { 2, 1 } } })
    fails(run, "each frequency must be above 0 Hz and higher",
      { spectrum = { { 1, 1 }, { 1, 1 } }, damping = 0.1 })
    fails(run, "fewer than 2 points", { spectrum = { { 1, 1 } }, damping = 0.1 })
    fails(run, "must not be the zero vector", { bands = { { 1, 2 } }, direction = { 0, 0, 0 } })
  end)
end)

describe("run:check of amplitudes under a spectrum", function()
  local run = beam()
  local function value(more)
    local given = { spectrum = { { 0.1, 2 }, { 100, 2 } }, damping = 0.02, direction = { 0, 0, 1 } }
    for key, item in pairs(more or {}) do given[key] = item end
    return run:check{ vibration = given, limits = { vibration_amplitude = 1 } }:row "vibration_amplitude"
  end

  -- Shaking along a straight wire does not make it swing sideways. Half the spectrum gives 1/sqrt(2) of the
  -- amplitude.
  it("depends on direction, damping and spectrum as the formula says", function()
    local all = value()
    assert.is_near(0.5, all.s, 1e-6)
    assert.is_near(all.value / 2, value{ damping = 0.08 }.value, 1e-6 * all.value)
    assert.is_near(all.value / math.sqrt(2), value{ spectrum = { { 0.1, 1 }, { 100, 1 } } }.value,
      1e-6 * all.value)
    assert.is_true(value{ direction = { 1, 0, 0 } }.value < 1e-3 * all.value)
    assert.equal(0, value{ spectrum = { { 0.1, 2 }, { 0.2, 2 } } }.value)
    -- the spectrum is linear in logarithms: W = 2 (f / 0.1)^-1
    local f = frequency(1)
    local sloping = value{ spectrum = { { 0.1, 2 }, { 100, 0.002 } }, modes = 2 }.value
    assert.is_near(value{ modes = 2 }.value * math.sqrt(0.1 / f), sloping, 0.01 * sloping)
    assert.equal("PASS", all.verdict)
    assert.truthy(all.note:find("damping ratio 0.02", 1, true), all.note)
  end)

  -- One mode within the spectrum: 3 sqrt(W / (2 damping) / (32 pi^3 f^3)) times participation and shape of
  -- the clamped beam in its middle, 0.830862 and 1.588147. Straight edges give up to 28 % more, and nothing
  -- where the coarse beam's frequency leaves the spectrum. The range has the exact value; with 40 edges it is
  -- within phase^2/8 and the error of the frequency, 0.5 %.
  it("has a range by the length of edges that contains the exact one", function()
    local f = frequency(1)
    local sigma = math.sqrt(2 / 0.04 / (32 * math.pi ^ 3 * f ^ 3)) * 0.830862 * 1.588147
    local function row(segments, spectrum, limit)
      return beam{ segments = segments }:check{ limits = { vibration_amplitude = limit }, vibration = {
        spectrum = spectrum, damping = 0.02, direction = { 0, 0, 1 } } }:row "vibration_amplitude"
    end
    for _, spectrum in ipairs{ { { 0.5 * f, 2 }, { 2 * f, 2 } }, { { 0.97 * f, 2 }, { 2 * f, 2 } } } do
      for _, segments in ipairs{ 4, 6, 10, 20, 40 } do
        local r = row(segments, spectrum, 1)
        assert.is_true(r.low <= 3 * sigma and r.high >= 3 * sigma, ("%d %g %g"):format(segments, r.low,
          r.high))
      end
    end
    local wide = { { 0.5 * f, 2 }, { 2 * f, 2 } }
    for segments, verdict in pairs{ [6] = "OPEN", [40] = "PASS" } do
      assert.equal(verdict, row(segments, wide, 3 * sigma * 1.005).verdict)
    end
    local r = row(4, wide, 1)
    assert.truthy(r.note:find("edges of 0.25 m are too long for waves of", 1, true), r.note)
  end)

  it("is open without a limit", function()
    local row = run:check{ vibration = { spectrum = { { 1, 1 }, { 2, 1 } }, damping = 0.1 } }
      :row "vibration_amplitude"
    assert.equal("OPEN", row.verdict)
  end)
end)
