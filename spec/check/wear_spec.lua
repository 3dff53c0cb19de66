-- SPDX-License-Identifier: GPL-3.0-or-later
-- The records that runs keep of every step with wear = true, and the rows that run:check makes of them:
-- cycles of tension and bending against counts by hand, also for loads between two frames.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = require "softworld.core"
local bent = require "spec.check.bent"
local capstan = require "spec.check.capstan"
local rainflow = require "softworld.check.rainflow"

local R, L, RADIUS = capstan.R, 0.1, capstan.RADIUS

-- Miner's sum for a slope, of a flat list of range, mean, number.
local function damage(flat, slope)
  local sum = 0
  for i = 1, #flat, 3 do sum = sum + flat[i + 2] * flat[i] ^ slope end
  return sum
end

describe("cycles counted during the run", function()
  local seed = 7
  local function random()
    seed = (seed * 1103515245 + 12345) % 2 ^ 31
    return seed / 2 ^ 31
  end
  local histories = {
    noise = random,
    steps = function() return math.floor(10 * random()) end,
    ["a swing that dies away, with noise"] = function(i)
      return math.sin(i) * math.exp(-0.004 * i) + 0.05 * random()
    end,
    ["a swing that grows"] = function(i) return math.sin(i) * math.exp(0.004 * i) end,
    ["beats with ripples"] = function(i)
      return math.sin(0.37 * i) * (1 + 0.5 * math.sin(0.003 * i)) + 0.2 * math.sin(2.1 * i)
    end,
    ["a slow decay with ripples"] = function(i)
      return math.sin(0.37 * i) * math.exp(-0.0005 * i) + 0.1 * math.sin(3.1 * i) * math.sin(0.01 * i)
    end,
    ["a slow rise with ripples"] = function(i) return 0.01 * i + math.sin(2 * i) end,
  }
  -- The memory is bounded, so ranges within 4 % of each other may be merged, and of more than 32 reversals
  -- that wait two are closed: 1 % in these histories, 2 % by the manual.
  for name, of in pairs(histories) do
    it("give the damage of the whole history: " .. name, function()
      for try = 1, 20 do
        local history = {}
        for i = 1, 20 + 70 * try do history[i] = of(i) end
        for _, slope in ipairs{ 3, 5, 8 } do
          local whole, streamed = damage(rainflow.flat(history), slope), damage(core.cycles(history), slope)
          assert.is_near(whole, streamed, 0.01 * whole)
        end
      end
    end)
  end

  it("are the exact ones, with their means, where there are few", function()
    local history = { -2, 1, -3, 5, -1, 3, -4, 4, -2 } -- ASTM E1049-85, figure 6
    local function sorted(flat)
      local list = {}
      for i = 1, #flat, 3 do list[#list + 1] = ("%g about %g"):format(flat[i], flat[i + 1]) end
      table.sort(list)
      return list
    end
    local means = sorted(rainflow.flat(history))
    for _, words in ipairs{ "4 about 1", "8 about 1", "9 about 0.5" } do
      assert.truthy(table.concat(means, ";"):find(words, 1, true))
    end
    assert.is_near(damage(rainflow.flat(history), 3), damage(core.cycles(history), 3), 1e-9)
    assert.same({}, core.cycles{ 1, 1, 0 / 0, 1 })
    assert.same({ 1e300, 5e299, 0.5 }, core.cycles{ 0, 1e300, math.huge, 1e300 })
  end)
end)

local function wave(t) return math.sin(math.pi * t / 2) / R end

local curve = { { 1, 1e6 }, { 100, 1 } } -- slope -3: 1e6 / range^3 cycles [1/m]

local function share(run, more)
  local given = { bending = curve, source = "this spec", flag = "guessed" }
  for key, value in pairs(more or {}) do given[key] = value end
  return run:check{ fatigue = given }:row "fatigue"
end

describe("run:check of fatigue by bending", function()
  -- From straight to 1/R, -1/R and back: half a cycle of 2/R and two halves of 1/R. No frame shows any of
  -- it: the run has frames only at its start and end, when the wire is straight. The bends of a chain of
  -- chords are 0.15 % sharper than its circle, which is three times that in the sum.
  it("counts to and fro as one range, also between frames", function()
    local run = bent(wave)
    assert.is_true(run.scene:frame_count() <= 2)
    local row = share(run)
    local wanted = (0.5 * (2 / R) ^ 3 + 2 * 0.5 * (1 / R) ^ 3) / 1e6
    print(("measured: damage %.6g, by hand %.6g"):format(row.value, wanted))
    assert.is_near(wanted, row.value, 0.01 * wanted)
    assert.equal("PASS", row.verdict)
    assert.truthy(row.note:find("this spec, guessed", 1, true), row.note)
    assert.truthy(row.note:find("1/m", 1, true), row.note)
    -- When the run is repeated it swings from 1/R to -1/R: one range of 2/R each time.
    local again = share(run, { repeats = 100 })
    assert.is_near(wanted + 99 * (2 / R) ^ 3 / 1e6, again.value, 0.01 * again.value)
    assert.is_near(row.value / 2, share(run, { repeats = 0.5 }).value, 1e-9)
    assert.equal("FAIL", share(run, { repeats = 1e6 }).verdict)
  end)

  -- One turn about its axis while it stays bent: each fibre goes from +1/R to -1/R and back, one cycle of
  -- 2/R; the phase at which a fibre starts decides its half cycles. A frame that does not roll with the wire
  -- would see no cycle.
  for name, wire in pairs{ ["a wire"] = {}, ["a wire with frames"] = { rest = "path" } } do
    it("counts rolling while bent: " .. name, function()
      local function hold(t) return math.min(1, t) / R end
      local still = share((bent(hold, nil, nil, wire)))
      local rolled = share((bent(hold, function(t) return 2 * math.pi * math.max(0, math.min(1, t - 1)) end,
        { dt = 0.01 }, wire)))
      -- of the worst fibre: 0, 1/R, -1/R, 1/R: two halves of 2/R, half of 1/R
      local wanted = ((2 / R) ^ 3 + 0.5 * (1 / R) ^ 3) / 1e6
      print(("measured: damage %.6g, by hand %.6g"):format(rolled.value, wanted))
      assert.is_near(0.5 * (1 / R) ^ 3 / 1e6, still.value, 0.01 * still.value)
      assert.is_near(wanted, rolled.value, 0.015 * wanted)
    end)
  end

  -- The far end is turned by two turns relative to the near one, so the middle has rolled once.
  it("follows how far the wire between two holds has rolled", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local path = {}
    for i = 0, 40 do path[i + 1] = { R * math.sin(i / 20), 0, R * (1 - math.cos(i / 20)) } end
    local wire = scene:wire{ name = "w", EA = 1e4, EI = 1, GJ = 1e-6, mass_per_length = 0.02,
      radius = RADIUS, path = path, segments = 40 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = wire.length }):follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true,
      turn = { axis = { math.cos(2), 0, math.sin(2) }, angle = 4 * math.pi }, duration = 1 }
    scene:run{ duration = 1, dt = 0.01, quasistatic = true, wear = true }
    local function largest(s)
      local most = 0
      for k, place in ipairs(core.worn(wire)) do
        if math.abs(place.s - s) < 1e-3 and place.side == 0 then
          for way = 1, 12 do
            local flat = core.worn_cycles(wire, k, way)
            for i = 1, #flat, 3 do most = math.max(most, flat[i]) end
          end
        end
      end
      return most * R
    end
    assert.is_near(2, largest(wire.length / 2), 0.03)
    -- a quarter of a turn: the worst fibre goes from cos(45 degrees) to cos(135 degrees)
    assert.is_near(math.sqrt(2), largest(wire.length / 8), 0.03)
  end)

  it("continues when a wire gets other holds and loses them", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.02,
      radius = RADIUS, from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 20 }
    scene:clamp(wire, { s = 0 })
    local hand = scene:gripper{ name = "hand" }
    scene:process(function(p)
      hand:grasp(wire, { s = 0.09 })
      hand:move{ by = { 0, 0, 0.03 }, duration = 0.3 }
      hand:move{ by = { 0, 0, -0.03 }, duration = 0.3 }
      hand:release()
      p:wait(0.1)
    end)
    scene:run{ dt = 0.005, wear = true }
    local sharpest, widest, least = 1 / wire:min_bend_radius(), 0, math.huge
    for way = 1, 12 do
      local top = 0
      for k in ipairs(core.worn(wire)) do
        local flat = core.worn_cycles(wire, k, way)
        for i = 1, #flat, 3 do top = math.max(top, flat[i]) end
      end
      widest, least = math.max(widest, top), math.min(least, top)
    end
    -- Directions are 15 degrees apart; across the plane of bending the range is at most sin(7.5 degrees). So
    -- no direction jumped when the gripper took hold and let go.
    assert.is_true(widest >= math.cos(math.rad(7.6)) * sharpest, widest .. " " .. sharpest)
    assert.is_true(least <= math.sin(math.rad(7.6)) * 1.5 * sharpest, least .. " " .. sharpest)
  end)

  it("is open where wear was not recorded, and says how to record it", function()
    local row = share((bent(wave, nil, { wear = false })))
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("scene:run{ wear = true }", 1, true), row.note)
  end)

  it("starts anew with each run", function()
    local run, scene = bent(wave)
    local before = share(run).value
    assert.is_true(before > 0)
    local after = scene:run{ duration = 0.1, dt = 0.02, wear = true }
    assert.is_true(share(after).value < 1e-6 * before)
  end)
end)

describe("run:check of fatigue by tension", function()
  -- From 0 to 100 N and back, in the middle of a run whose frames do not show it.
  local function pulled(more)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, mass_per_length = 0.02, radius = RADIUS,
      from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 10, breaking_load = 500 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 0.3 }):follow{ points = { { 0, 0, 0 }, { 3e-3, 0, 0 }, { 0, 0, 0 } },
      relative = true, duration = 1, law = "linear" }
    return scene:run{ duration = 1, dt = 0.01, quasistatic = true, frame = 1, wear = true }:check{
      fatigue = { curve = { { 10, 1e6 }, { 100, 1e3 } }, mean = more and more.mean, strength = more
        and more.strength, bending = more and more.bending } }:row "fatigue"
  end

  it("finds a peak between two frames", function()
    local row = pulled()
    assert.is_near(1e-3, row.value, 0.01e-3)
    assert.equal("PASS", row.verdict)
  end)

  it("applies Goodman's rule for the mean", function()
    -- a range of 100 N about a mean of 50 N, with a strength of 500 N: as 100 / 0.9 N
    assert.is_near(1e-3 / 0.9 ^ 3, pulled{ mean = "goodman" }.value, 0.01e-3)
    assert.is_near(1e-3 / 0.5 ^ 3, pulled{ mean = "goodman", strength = 100 }.value, 0.08e-3)
    local row = pulled{ mean = "goodman", strength = 40 }
    assert.same({ math.huge, "FAIL" }, { row.value, row.verdict }) -- the mean alone breaks the wire
  end)

  it("adds the damage of bending", function()
    assert.is_near(pulled().value, pulled{ bending = curve }.value, 1e-5)
  end)
end)

describe("run:check of torsion", function()
  -- To 1 rad and back between two frames, 1 rad over 0.3 m.
  it("is the largest over all steps", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.02,
      radius = RADIUS, from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 10 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 0.3 }):follow{ duration = 1, func = function(t)
      return { 0.3, 0, 0 }, { axis = { 1, 0, 0 }, angle = math.sin(math.pi * t) }
    end }
    local run = scene:run{ duration = 1, dt = 0.01, quasistatic = true, frame = 1 }
    local row = run:check{ limits = { max_torsion = { max = 4, sure = true } } }:row "max_torsion"
    assert.is_near(1 / 0.3, row.value, 0.001)
    assert.same({ 0.5, "PASS" }, { row.time, row.verdict })
    assert.is_near(0, (wire:max_torsion{ now = true }), 1e-9)
    assert.equal("FAIL", run:check{ limits = { max_torsion = 3 } }:row "max_torsion".verdict)
  end)

  it("is known for a mesh of particles without a frame of each step", function()
    local scene = sw.scene{}
    local wire = scene:wire{ name = "w", E = 5e6, density = 1200, radius = 0.004, model = "tube",
      segments = 8, from = { 0, 0, 0 }, to = { 0.06, 0, 0 } }
    local run = scene:run{ duration = 0.02, dt = 0.01, frame = 1 }
    assert.equal("PASS", run:check{ limits = { max_torsion = 9 } }:row "max_torsion".verdict)
    assert.is_near(0, (wire:max_torsion()), 1e-6)
  end)
end)

describe("what a run keeps of wear", function()
  local given = { fatigue = { bending = curve, curve = { { 1, 1e9 }, { 10, 1e3 } } } }
  local path = os.tmpname()
  teardown(function() os.remove(path) end)

  local function scene_of()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
      segments = 16 }
    scene:clamp(wire, { s = 0 })
    scene:zone{ shape = "sphere", radius = 0.02, at = { 0.1, 0, 0.08 } }
    local hand = scene:gripper{ name = "hand" }
    scene:process(function(p)
      p:step("up", function()
        hand:grasp(wire, { s = 0.19 })
        hand:move{ by = { -0.02, 0, 0.05 }, duration = 0.1 }
      end)
      p:step("down", function() hand:move{ by = { 0, 0, -0.1 }, duration = 0.1 } end)
      p:step("let go", function()
        hand:release()
        p:wait(0.05)
      end)
    end)
    return scene
  end

  it("continues a resumed run, to the last bit", function()
    local whole = scene_of():run{ dt = 0.005, wear = true }:check(given)
    os.remove(path)
    local cut = scene_of()
    cut:observe{ every = 0.05, call = function(o) if cut.time > 0.14 then o:stop "enough" end end }
    cut:run{ dt = 0.005, wear = true, save = path }
    local rest = scene_of():run{ dt = 0.005, wear = true, resume = path }:check(given)
    for _, name in ipairs{ "fatigue", "clearance", "max_tension" } do
      assert.equal(whole:row(name).value, rest:row(name).value, name)
    end
    assert.is_true(whole:row "fatigue".value > 0)
  end)

  it("stops the run with an error when memory runs out, and does no other harm", function()
    local failed = 0
    for n = 1, 600, 7 do
      local scene = scene_of()
      core.fail_allocation(n)
      local fine, why = pcall(scene.run, scene, { dt = 0.005, duration = 0.02, wear = true, frames = false })
      core.fail_allocation(0)
      if not fine then
        failed = failed + 1
        assert.truthy(tostring(why):find("memory", 1, true), why)
      end
    end
    assert.is_true(failed > 0)
  end)

  it("is there for runs with error bars and for steps chosen by tolerance", function()
    local scene = sw.scene{}
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 },
      segments = 16 }
    scene:clamp(wire, { s = 0 })
    local bars = scene:run{ duration = 0.1, dt = 0.01, wear = true, tolerance = { max_tension = 0.5 } }
    assert.is_true(share(bars).value > 0)
    local run = scene:run{ duration = 0.1, tolerance = 1e-5, wear = true }
    assert.is_true(share(run).value > 0)
  end)
end)

describe("sidewall pressure", function()
  -- The pressure of single steps of an impact on a drum grows with every finer step; a mean over the window
  -- converges. (On a peg of 20 mm one place bears all, and the impact differs with every step size: 0.4 to
  -- 0.9 N/m.)
  it("of an impact is a mean over the window, as other peaks are", function()
    local function dropped(dt, window)
      local scene = sw.scene{}
      scene:obstacle{ shape = "cylinder", radius = 0.05, length = 0.1, friction = 0.2,
        rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
      scene:wire{ cable = "GXL 1.5", from = { -0.2, 0, 0.06 }, to = { 0.2, 0, 0.06 }, segments = 60 }
      scene:force{ kind = "damping", mass = 2 }
      local run = scene:run{ duration = 0.2, dt = dt, wear = true, window = window, frame = 1 }
      return run:check{ limits = { max_sidewall = 1e3 } }:row "max_sidewall".value
    end
    local coarse, fine, raw = dropped(0.002), dropped(0.0005), dropped(0.0005, 0)
    print(("measured: %.3f, %.3f N/m; of single steps %.3f N/m"):format(coarse, fine, raw))
    assert.is_near(coarse, fine, 0.15 * coarse)
    assert.is_true(fine > 0 and raw > 3 * fine, raw .. " and " .. fine)
  end)
end)

describe("fatigue arguments that make no sense", function()
  local run = bent(wave, nil, { duration = 0.04 })
  for words, given in pairs{ ["a curve is missing"] = { source = "mine" },
    ["fatigue.bending has fewer than 2 points"] = { bending = { { 1, 1 } } },
    ["fatigue.bending[1][1] = -1 1/m"] = { bending = { { -1, 5 }, { 2, 3 } } },
    ["is not one of: goodman none"] = { bending = curve, mean = "goodmann" },
    ["fatigue.flag = 'sure'"] = { bending = curve, flag = "sure" },
    ["strength = 0 N"] = { bending = curve, strength = 0 },
    ["spread = 0.5"] = { bending = curve, spread = 0.5 } } do
    it("are refused: " .. words, function()
      local fine, why = pcall(run.check, run, { fatigue = given })
      assert.is_false(fine)
      assert.truthy(why:find(words, 1, true), why)
    end)
  end

  it("fail where Goodman's strength is not known", function()
    local row = run:check{ fatigue = { bending = curve, mean = "goodman" } }:row "fatigue"
    assert.equal("FAIL", row.verdict)
    assert.truthy(row.note:find("give strength", 1, true), row.note)
  end)
end)
