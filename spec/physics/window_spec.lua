-- SPDX-License-Identifier: GPL-3.0-or-later
-- Peaks as means over a window of time: their values for given forces, that they do not grow with shorter
-- steps and edges, and that raw peaks are reported beside them.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local window = require "softworld.run.window"
local t = require "spec.physics.tools"
local windowed = require "spec.physics.windowed"

local steps, even = windowed.steps, windowed.even
local W, G = 0.01, 9.81

local function uneven(seed, count, least, most)
  local random, list = t.random(seed), {}
  for i = 1, count do list[i] = least + (most - least) * 0.5 * (1 + random()) end
  return list
end

describe("the largest mean over a window", function()
  it("is exact for a constant force, in uneven steps", function()
    for seed = 1, 20 do
      local p = windowed.peak(steps(uneven(seed, 300, 1e-6, 2e-3), function() return -7 end), W)
      t.share(7, p.value, 1e-12, "mean")
      t.share(7, p.raw, 1e-15, "raw")
      assert.is_nil(p.whole)
    end
  end)

  it("loses as little of a ramp as help says", function()
    for _, h in ipairs{ 1e-3, 1e-4 } do
      for _, T in ipairs{ 0.25, 0.5, 2 } do
        local up = windowed.peak(steps(even(h, T), function(time) return time / T end), W).value
        t.near(1 - W / (2 * T), up, 1e-9, "ends on top")
        t.above(0.98 - 1e-9, up, "ends on top")
        local stays = windowed.peak(steps(even(h, T + W), function(time) return math.min(1, time / T) end), W)
        t.near(1, stays.value, 1e-9, "stays")
        local falls = windowed.peak(steps(even(h, 2 * T), function(time)
          return 1 - math.abs(time - T) / T
        end), W).value
        t.near(1 - W / (4 * T), falls, 1e-9, "falls again")
      end
    end
  end)

  it("is for a blow its impulse over the window, whatever the steps", function()
    for seed = 1, 20 do
      for _, span in ipairs{ 5e-3, 4e-4, 1e-6 } do
        local list = uneven(seed, 200, 1e-4, 1e-3)
        list[77] = span
        local before = 0
        for i = 1, 76 do before = before + list[i] end
        local p = windowed.peak(steps(list, function(time)
          return time > before and time < before + span and 0.3 / span or 0
        end), W)
        t.share(0.3 / W, p.value, 1e-9, "mean")
        t.share(0.3 / span, p.raw, 1e-9, "raw")
        t.share(span, p.raw_span, 1e-6, "step of the raw one")
      end
    end
  end)

  it("is a step's own force where steps are longer than the window, and says so", function()
    local p = windowed.peak(steps({ 0.02, 0.02, 0.02 }, function(time) return time end), W)
    t.near(0.05, p.value, 1e-15, "value")
    assert.are.equal("50 mN (raw, in one step of 20 ms; the window is 10 ms)", window.text(p, "N"))
    p = windowed.peak({ { t0 = 1, t1 = 1, 3, 4, 0 } }, W)
    assert.are.equal("5 N (at rest)", window.text(p, "N"))
  end)

  it("is the mean of the whole record where that is shorter, and says so", function()
    local p = windowed.peak(steps({ 1e-3, 2e-3, 1e-3 }, function(time) return time < 1e-3 and 10 or 2 end), W)
    t.near(4, p.value, 1e-12, "mean of all")
    assert.are.equal("4 N (mean of all 4 ms; raw 10 N in 1 ms)", window.text(p, "N"))
  end)

  it("is raw without a window", function()
    local p = windowed.peak(steps({ 4e-4, 1e-3 }, function(time) return time < 4e-4 and 41 or 0 end), 0)
    assert.are.equal("41 N (raw, in 400 us)", window.text(p, "N"))
    p = windowed.peak({}, W)
    assert.are.same({ 0, 0 }, { p.value, p.raw })
  end)

  it("is a mean of vectors, without force in gaps", function()
    local list = {}
    for i = 0, 99 do list[i + 1] = { t0 = i * 1e-3, t1 = (i + 1) * 1e-3, i % 2 == 0 and 5 or -5, 0, 0 } end
    t.near(0, windowed.peak(list, W).value, 0.5 + 1e-9, "to and fro")
    list = { { t0 = 0, t1 = 0.004, 5, 0, 0 }, { t0 = 0.006, t1 = 0.01, 5, 0, 0 } }
    t.near(4, windowed.peak(list, W).value, 1e-9, "8 of 10 ms")
  end)

  it("equals the best of all windows tried", function()
    for seed = 1, 4 do
      local random = t.random(seed)
      local list = steps(uneven(seed + 50, 150, 1e-5, 4e-3), function() return random() end)
      local last, best = list[#list].t1, 0
      for k = 0, 2000 do
        local from, sum = (last - W) * k / 2000, 0
        for _, s in ipairs(list) do
          sum = sum + s[1] * math.max(0, math.min(s.t1, from + W) - math.max(s.t0, from))
        end
        best = math.max(best, math.abs(sum) / W)
      end
      local p = windowed.peak(list, W)
      t.near(best, p.value, 0.01, "tried")
      t.above(best - 1e-12, p.value, "tried")
    end
  end)
end)

-- A cable falls flat on a table.
local function fall(dt, segments, more)
  local s = sw.scene{}
  local o = s:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local w = s:wire{ cable = "GXL 1.5", from = { 0, 0, 0.02 }, to = { 0.3, 0, 0.025 }, segments = segments }
  w:set_velocity{ 0, 0, -2 }
  local args = { duration = 0.1, dt = dt }
  for k, v in pairs(more or {}) do args[k] = v end
  return s, o, w, t.fine(s:run(args))
end

describe("peaks of a blow", function()
  it("stay with shorter steps and edges; the raw ones do not", function()
    local least, most, raw_least, raw_most = math.huge, 0, math.huge, 0
    for _, segments in ipairs{ 15, 60 } do
      for _, dt in ipairs{ 1e-3, 2e-4, 5e-5 } do
        local _, o = fall(dt, segments)
        local m = o:over()
        least, most = math.min(least, m.peak_force), math.max(most, m.peak_force)
        raw_least, raw_most = math.min(raw_least, m.raw_peak_force), math.max(raw_most, m.raw_peak_force)
        assert.matches("^.* m?N %(10 ms mean; raw .* N in .* [mu]s%)$", m.peak_force_text)
      end
    end
    t.below(1.6, most / least, "means") -- rebounds and second falls differ
    t.above(2, raw_most / raw_least, "raw")
  end)

  it("are raw with a window of 0, in a run or in a call", function()
    local _, o, w = fall(2e-4, 30)
    local m, raw = o:over(), o:over(nil, nil, { window = 0 })
    assert.are.equal(m.raw_peak_force, raw.peak_force)
    t.above(2 * m.peak_force, raw.peak_force, "raw")
    local tension, at, span = w:max_tension{ raw = true }, select(2, w:max_tension()), select(4,
      w:max_tension{ raw = true })
    t.above(w:max_tension(), tension, "raw tension")
    assert.is_true(at >= 0 and at <= w.length and span > 0 and span <= 2e-4 * (1 + 1e-9))
    _, o, w = fall(2e-4, 30, { window = 0 })
    assert.are.equal(raw.peak_force, o:over().peak_force)
    assert.are.equal(tension, (w:max_tension()))
    assert.are.equal(m.peak_force, o:over(nil, nil, { window = W }).peak_force)
  end)

  it("are raw in steps as long as the window", function()
    local _, _, _, run = fall(0.005, 30)
    local _, o, w = fall(0.005, 30, { window = run.smallest_dt })
    assert.are.equal(w:max_tension{ raw = true }, (w:max_tension()))
    assert.are.equal(o:over().raw_peak_force, o:over().peak_force)
    assert.matches("raw, in one step of .*; the window is", o:over().peak_force_note)
  end)

  it("refuse windows that make no sense", function()
    local s, o = fall(0.01, 10)
    for _, value in ipairs{ -1, 0 / 0, "x" } do
      assert.is_false(pcall(s.run, s, { duration = 0.01, window = value }))
      assert.is_false(pcall(o.over, o, nil, nil, { window = value }))
    end
  end)
end)

local function rod(scene, radius, to, segments)
  return scene:wire{ E = 5e6, density = 1200, radius = radius, from = { 0, 0, 0 }, to = to,
    segments = segments }
end

describe("the largest tension", function()
  -- By hand: forces at the ends of steps, added up by trapezoids, which are 1/12 dt^2 T'' off the mean over
  -- a step: 6e-5 of the largest tension here at 1 ms, and six times that at 2.5 ms.
  it("is the largest mean of any edge, as computed by hand", function()
    for dt, allowed in pairs{ [1e-3] = 2e-4, [2.5e-3] = 1.2e-3 } do
      local s = sw.scene{}
      local w = rod(s, 0.003, { 0.4, 0, 0 }, 8)
      s:clamp(w, { s = 0 })
      local seen, n = {}, math.floor(W / dt + 0.5)
      local function look()
        local row = {}
        for e = 1, 8 do row[e] = w:tension(0.05 * (e - 0.5)) end
        return row
      end
      s:process(function(p)
        seen[0] = look()
        for i = 1, math.floor(0.3 / dt + 0.5) do
          p:wait(dt)
          seen[i] = look()
        end
      end)
      t.fine(s:run{ dt = dt })
      local best, place, raw = -math.huge, nil, -math.huge
      for i = 1, #seen do
        for e = 1, 8 do
          local function mean(k) return 0.5 * (seen[k - 1][e] + seen[k][e]) end
          raw = math.max(raw, mean(i))
          local sum = 0
          for k = math.max(1, i - n + 1), i do sum = sum + mean(k) end
          if i >= n and sum / n > best then best, place = sum / n, 0.05 * (e - 0.5) end
        end
      end
      local value, at = w:max_tension()
      t.share(best, value, allowed, "mean")
      t.near(place, at, 1e-12, "place")
      t.share(raw, w:max_tension{ raw = true }, allowed, "raw")
      t.above(value * 1.005, raw, "they differ")
    end
  end)

  it("is exact for a wire at rest, and close for a pull that grows", function()
    local s = sw.scene{ gravity = { 0, 0, 0 } }
    local w = rod(s, 0.003, { 0.2, 0, 0 }, 10)
    s:clamp(w, { s = 0 })
    s:force{ kind = "damping", mass = 50 }
    local g = s:gripper{}
    s:process(function(p)
      g:grasp(w, { s = 0.19 })
      g:move{ by = { 0.01, 0, 0 }, duration = 0.5, law = "linear" }
      p:wait(0.05)
    end)
    t.fine(s:run{ dt = 5e-4 })
    t.share((w:max_tension{ now = true }), w:max_tension(), 1e-3, "stays")
    s:process(function() g:move{ by = { 0.01, 0, 0 }, duration = 0.5, law = "linear" } end)
    t.fine(s:run{ dt = 5e-4 })
    local top = g:over(s.time - 0.1, s.time).raw_peak_force
    t.share(top, w:max_tension(), 0.02, "tension of a ramp")
    t.share(top, g:over(s.time - 0.5).peak_force, 0.02, "force of a ramp")
    s = sw.scene{}
    w = rod(s, 0.003, { 0, 0, -0.2 }, 10)
    s:clamp(w, { s = 0 })
    t.fine(s:settle())
    local hangs = w:max_tension()
    t.fine(s:run{ duration = 0.05, tolerance = 1e-4, dt = 3e-3 })
    t.share(hangs, w:max_tension(), 1e-6, "rest")
  end)

  it("takes equilibria without a mean", function()
    local s = sw.scene{}
    local w = rod(s, 0.003, { 0.2, 0, 0 }, 10)
    s:clamp(w, { s = 0 })
    local clamp = s:clamp(w, { s = 0.2 })
    t.fine(s:settle())
    assert.are.equal(w:max_tension{ now = true }, (w:max_tension()))
    clamp:follow{ points = { { 0.2, 0, 0 }, { 0.202, 0, 0 }, { 0.2, 0, 0 } }, duration = 0.02 }
    t.fine(s:run{ duration = 0.02, dt = 1e-3, quasistatic = true })
    assert.are.equal(w:max_tension{ raw = true }, (w:max_tension()))
    t.above(w:max_tension{ now = true } * 2, w:max_tension(), "pulled")
  end)

  it("covers wire that is fed, and meshes", function()
    local s = sw.scene{}
    local w = rod(s, 0.002, { 0, 0, -0.2 }, 20)
    s:feed(w, { s = 0, speed = 0.3 })
    t.fine(s:run{ duration = 0.3, dt = 4e-5, integrator = "velocity-verlet" })
    local value, raw = w:max_tension(), w:max_tension{ raw = true }
    local weight = w.beam.mass_per_length * G * w.length
    assert.is_true(value < raw and value > 0.1 * weight, ("%g of %g"):format(value, raw))
    t.above(20, w.segments, "segments, with those that were added")
    s = sw.scene{}
    w = s:wire{ model = "radial", E = 2e6, nu = 0.4, density = 1200, radius = 0.005, from = { 0, 0, 0 },
      to = { 0.05, 0, 0 } }
    s:clamp(w, { s = 0 })
    t.fine(s:run{ duration = 0.05, dt = 2e-3 })
    value, raw = w:max_tension(), w:max_tension{ raw = true }
    assert.is_true(value <= raw and value > 0, ("%g of %g"):format(value, raw))
  end)

  it("and its window are kept by snapshots and files", function()
    local s, _, w = fall(1e-3, 20, { window = 0.02 })
    local function read(wire)
      return { { wire:max_tension() }, { wire:max_tension{ raw = true } }, sw.core.window(s) }
    end
    local here, snapshot = read(w), s:snapshot()
    t.fine(s:run{ duration = 0.013, dt = 7e-4 })
    local there = read(w)
    assert.are_not.same(here, there)
    s:restore(snapshot)
    assert.are.same(here, read(w))
    local file = os.tmpname()
    s:save(file)
    local loaded = sw.load(file)
    os.remove(file)
    assert.are.same(here[1], { loaded:find("wire1"):max_tension() })
    assert.are.equal(0.02, sw.core.window(loaded))
    t.fine(s:run{ duration = 0.013, dt = 7e-4 })
    assert.are.same(there, read(w))
  end)
end)
