-- SPDX-License-Identifier: GPL-3.0-or-later
-- Means over a window: raw peaks beside them, long windows, blows of few steps, edges that change.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local window = require "softworld.run.window"
local t = require "spec.physics.tools"
local windowed = require "spec.physics.windowed"

local steps, even = windowed.steps, windowed.even
local W, G = 0.01, 9.81

describe("peaks are printed together with raw peaks", function()
  local function lifted(more)
    local s = sw.scene{}
    s:obstacle{ name = "table", shape = "plane", friction = 0.3 }
    local w = s:wire{ E = 5e6, density = 1200, radius = 0.003, from = { 0, 0, 0.003 }, to = { 0.3, 0, 0.003 },
      segments = 24 }
    local g = s:gripper{ name = "left" }
    s:process(function(p)
      g:grasp(w, { s = 0.02 })
      g:move{ by = { 0, 0, 0.1 }, duration = 0.2, law = "linear" }
      p:wait(0.1)
    end)
    local args = { dt = 1e-3 }
    for k, v in pairs(more or {}) do args[k] = v end
    return s, w, g, t.fine(s:run(args))
  end

  it("in the summary", function()
    local _, _, g, run = lifted()
    local out = io.tmpfile()
    run:summary(out)
    out:seek "set"
    local text = out:read "a"
    out:close()
    assert.matches("left: peak force .*%(10 ms mean; raw [%d.]+ m?N in 1 ms%)", text)
    assert.matches("wire1: largest tension .*%(10 ms mean; raw [%d.]+ m?N in 1 ms%)", text)
    local m = g:over()
    assert.are.equal(m.peak_force, g.peak_force)
    t.above(m.peak_force * 1.05, m.raw_peak_force, "the jerk at the start")
    assert.are.equal(m.raw_peak_force, g:over(nil, nil, { window = 0 }).peak_force)
    t.above(0, m.impulse_size, "impulse")
    local origin = { 0, 0, 0 }
    assert.are.equal(g:over(0.1, 0.2, origin).peak_moment, g:over(0.1, 0.2, { at = origin }).peak_moment)
    local ok, message = pcall(g.over, g, nil, nil, { windw = 0 })
    assert.is_false(ok)
    assert.is_truthy(message:find("did you mean 'window'", 1, true), message)
  end)

  it("in error bars, whose values are means", function()
    local s, w, g, run = lifted{ levels = 3,
      tolerance = { ["left.peak_force"] = 1, max_tension = 1, ["table.impulse"] = 1 } }
    local q = run.quantities
    assert.are.equal(g:over().peak_force, q["left.peak_force"].value)
    assert.are.equal((w:max_tension()), q.max_tension.value)
    assert.are.same(s:find("table"):over().impulse, q["table.impulse"].value)
    local text = tostring(run:error_bars())
    assert.matches("left.peak_force = .*%(10 ms mean; raw .*%)", text)
    assert.matches("max_tension = .*%(10 ms mean; raw .*%)", text)
  end)
end)

describe("a run shorter than its window", function()
  -- A rod hangs from one end; its tension is m g of what hangs below the first edge. A window longer than
  -- the run counts as the run. Steps are shorter and longer than the usual window of 10 ms.
  for _, dt in ipairs{ 2e-3, 0.01, 0.02 } do
    for _, width in ipairs{ 0.05, 2 } do
      it(("of %g s with steps of %g s has the mean of all"):format(width, dt), function()
        local scene = sw.scene{}
        local wire = scene:wire{ E = 1e8, density = 1000, radius = 0.003, segments = 10, from = { 0, 0, 0 },
          to = { 0, 0, -0.5 } }
        scene:clamp(wire, { s = 0 })
        t.fine(scene:settle())
        local run = scene:run{ duration = 0.1, dt = dt, window = width }
        t.fine(run)
        local held = 1000 * math.pi * 0.003 ^ 2 * 0.5 * G * 0.95 -- the middle of the first edge
        t.share(held, (wire:max_tension()), 1e-3, "mean")
        t.share(held, (wire:max_tension{ window = 0 }), 1e-3, "raw")
        t.share(held, (wire:max_tension{ window = width }), 1e-3, "by name")
        local fine, message = pcall(wire.max_tension, wire, { window = 0.03 })
        assert.is_false(fine)
        assert.is_truthy(message:find("scene:run{ window = }", 1, true), message)
      end)
    end
  end
end)

describe("a blow of few steps", function()
  -- A pulse of 8 ms on a small steady force, in even steps; and forces that are steady.
  local function peak(h, f)
    return windowed.peak(steps(even(h, 0.2), f), W)
  end
  local function blow(time) return time > 0.1 and time < 0.108 and 5 or 0.5 end

  it("is reported; a blow of many steps and a steady force are not", function()
    for _, h in ipairs{ 4e-3, 8e-3 } do
      local p = peak(h, blow)
      assert.is_true(p.coarse, ("%g s"):format(h))
      assert.is_truthy(window.text(p, "N"):find "blow lasts few steps: a smaller dt may give another peak%)$")
    end
    for _, h in ipairs{ 1e-4, 1e-3, 2e-3 } do assert.is_nil(peak(h, blow).coarse, ("%g s"):format(h)) end
    for _, h in ipairs{ 1e-3, 0.01, 0.02 } do
      assert.is_nil(peak(h, function() return 3 end).coarse)
      assert.is_nil(peak(h, function(time) return 3 + time end).coarse)
    end
  end)

  -- A cable swings against a peg: 0.491 N with whole steps of 10 ms, 0.505 to 0.518 N with steps of 5 to
  -- 0.3 ms. Steps that are divided into parts (substeps) do not count as coarse.
  it("is noted with a wire's largest tension", function()
    local function swung(dt, parts)
      local s = sw.scene{}
      local w = s:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.5, 0, 0 }, segments = 50 }
      s:force{ kind = "damping", on = w, mass = 1, stiffness = 1e-3 }
      s:pin(w, { s = 0 })
      s:obstacle{ shape = "cylinder", radius = 0.012, length = 0.2, at = { 0.03, 0, -0.25 },
        rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 }, friction = 0.3 }
      t.fine(s:run{ duration = 0.8, dt = dt, parts = parts })
      local T, _, _, note = window.tension(s, w)
      return T, note
    end
    local T, note = swung(0.01, false)
    assert.is_truthy(note:find "the blow lasts few steps: a smaller dt may give another peak$", note)
    local finer, said = swung(2.5e-3, false)
    assert.is_nil(said:find "few steps", said)
    t.share(finer, T, 0.1, "tension [N] of whole steps")
    local by_parts, told = swung(0.01)
    assert.is_nil(told:find "few steps", told)
    t.share(finer, by_parts, 0.1, "tension [N] of steps in parts")
  end)
end)

describe("edges that change within a run", function()
  -- A step that counts in a mean is followed by steps as long as the window, of a wire with other edges.
  it("have their own tension", function()
    for _, segments in ipairs{ 4, 40 } do
      local scene = sw.scene{}
      local wire = scene:wire{ E = 1e8, density = 1000, radius = 0.003, segments = 12, from = { 0, 0, 0 },
        to = { 0, 0, -0.5 } }
      scene:clamp(wire, { s = 0 })
      t.fine(scene:settle())
      scene:process(function(p)
        p:wait(0.005)
        wire:remodel{ model = "rod", segments = segments }
        p:wait(0.06)
      end)
      t.fine(scene:run{ dt = 0.01 })
      local held = 1000 * math.pi * 0.003 ^ 2 * 0.5 * G
      t.share(held, (wire:max_tension()), 0.15, segments .. " segments") -- half an edge, and the change
      t.share(held, (wire:max_tension{ window = 0 }), 0.15, segments .. " segments, raw")
      scene:save(os.tmpname())
    end
  end)
end)
