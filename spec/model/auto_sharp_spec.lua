-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cases where a cheap rung is just good enough: it is not given up for lack of a closer look, nor looked at
-- longer than needed. The quantity is made up: it shows by which rungs and on which level it was computed.
local motion = require "softworld.model.motion"
local rod = require "spec.model.rod"
local sw = require "softworld"

local SHARE = 0.1 -- of the value: the tolerance [-]

local function is_moving(w)
  for _, v in ipairs(w:velocities()) do
    if v ~= 0 then return true end
  end
  return false
end

-- One end of a wire on a rough table is drawn aside within `duration` [s]. parts(moves, rolls, level): by
-- how many tolerances the quantity exceeds its value with the cheapest rungs.
local function drawn(parts, duration)
  local scene = sw.scene { name = "drawn" }
  scene:force { kind = "damping", mass = 5 }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local w = rod.wire(scene, { from = { 0, 0, rod.radius }, to = { 0.6, 0, rod.radius } })
  scene:clamp(w, { s = 0 }):follow { relative = true, duration = duration or 1,
    points = { { 0, 0, 0 }, { 0, 0.02, 0 } } }
  scene:settle()
  local function odd()
    local level = math.tointeger(math.log(sw.core.segments(w) / 6, 2) // 1) + 1
    return 1 + SHARE * parts(is_moving(w), w:get().spin_inertia ~= nil, level)
  end
  return scene:run { duration = duration or 1, model = "auto",
    tolerance = { { name = "odd", value = SHARE, unit = "-", of = odd } } }
end

describe("model = 'auto', where poses are just good enough,", function()
  it("leaves an eighth of the tolerance to edges and steps, and the rest to poses", function()
    local run = drawn(function(moves) return moves and 0.8 or 0 end)
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.is_true(run.met, tostring(run:why()))
    assert.is_near(0.8 * SHARE, run.quantities.odd.model_error, 1e-9)
    run = drawn(function(moves) return moves and 0.95 or 0 end)
    assert.equal("dynamic", run.model.motion, tostring(run:why()))
  end)

  it("returns to poses where rolling, which made them too cheap, turns out not to be needed", function()
    local run = drawn(function(moves, rolls) return moves and 0.3 or rolls and 2 or 0 end)
    assert.equal("held", run.model.twist, tostring(run:why()))
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.is_true(run.met, tostring(run:why()))
    assert.is_near(0.3 * SHARE, run.quantities.odd.model_error, 1e-9)
  end)

  it("does not return where both are needed", function()
    local run = drawn(function(moves, rolls) return (moves and 2 or 0) + (rolls and 2 or 0) end)
    assert.equal("rolling", run.model.twist, tostring(run:why()))
    assert.equal("dynamic", run.model.motion, tostring(run:why()))
  end)
end)

describe("model = 'auto' looks no longer than needed:", function()
  local function probes_of(...)
    return drawn(...).model.probes
  end

  it("at no third level where a change that is too large grows", function()
    local function growing(rate)
      return function(moves, _, level) return moves and 1.1 * rate ^ (level - 1) or 0 end
    end
    local grows, shrinks = drawn(growing(1.2)), drawn(growing(0.8))
    assert.equal("dynamic", grows.model.motion, tostring(grows:why()))
    assert.truthy(tostring(grows:why()):find("with dynamics odd changes by", 1, true))
    assert.is_true(probes_of(growing(1.2)) < probes_of(growing(0.8)), tostring(shrinks:why()))
  end)

  it("at one level of a fast motion that changes little, with four times the change as its error", function()
    local function run_of(part) return drawn(function(moves) return moves and part or 0 end, 0.2) end
    local little, more = run_of(0.01), run_of(0.2)
    for _, run in ipairs { little, more } do
      assert.equal("poses", run.model.motion, tostring(run:why()))
      assert.equal("compared", run.model.choices[1].by)
    end
    local error = little.quantities.odd.model_error -- coarse steps show a third of the swing: it counts
    assert.is_true(error > 4 * 1.5 * 0.01 * SHARE and error < 4 * 4 * 1.5 * 0.01 * SHARE)
    assert.is_true(more.model.probes > little.model.probes)
    assert.is_near(0.2 * SHARE, more.quantities.odd.model_error, 3e-3)
  end)

  -- Seven eighths of the tolerance are allowed; the stated error is known from a change of a hundredth of
  -- it.
  it("at one level, up to an error of two thirds of the allowed one", function()
    local function run_of(part) return drawn(function(moves) return moves and part or 0 end, 0.2) end
    local little = run_of(0.01)
    local stated = little.quantities.odd.model_error / (0.01 * SHARE)
    local function probes_at(share) return run_of(share * 7 / 8 / stated).model.probes end
    assert.equal(little.model.probes, probes_at(0.63))
    assert.is_true(probes_at(0.7) > little.model.probes)
  end)
end)

describe("model = 'auto' and the first period of a wire", function()
  it("is computed on coarse edges, however fine the edges are that are asked for", function()
    local class, most = sw.core.class.wire, 0
    local frequencies = class.frequencies
    function class.frequencies(w, ...)
      most = math.max(most, sw.core.segments(w))
      return frequencies(w, ...)
    end
    local periods = {}
    local fine, why = pcall(function()
      for i, segments in ipairs { 24, 96 } do
        local scene = sw.scene { name = "hung" }
        scene:force { kind = "damping", mass = 5 }
        local w = rod.wire(scene, { segments = segments })
        scene:clamp(w, { s = 0 })
        local right = scene:clamp(w, { s = 0.6, name = "right" })
        scene:settle()
        right:follow { points = { { 0.6, 0, 0 }, { 0.5, 0, 0 } }, duration = 40 }
        local run = scene:run { duration = 40, tolerance = { min_bend_radius = { relative = 0.1 } } }
        periods[i] = tonumber(tostring(run:why()):match "first periods of ([%d.]+) ms")
      end
    end)
    class.frequencies = frequencies
    assert.is_true(fine, tostring(why))
    assert.is_true(most <= 24, ("on %d segments"):format(most)) -- a quarter of those asked for
    assert.is_near(periods[2], periods[1], 0.05 * periods[2])
  end)
end)

describe("poses that need more iterations than dynamics", function()
  local function costly(times, k, in_doubt)
    return motion.costly(1, { iterations = 100 * times }, { iterations = 100 }, k, in_doubt) ~= nil
  end

  it("count as dearer from 8 times as many on level 1, and from 2 times on level 3", function()
    assert.same({ false, true }, { costly(7.9, 1), costly(8, 1) })
    assert.same({ false, true }, { costly(1.9, 3), costly(2, 3) })
    assert.same({ true, true }, { costly(2, 4), costly(2, 5) })
  end)

  it("count as dearer from half of that where it is unknown whether they suffice", function()
    assert.same({ false, true }, { costly(3.9, 1, true), costly(4, 1, true) })
    assert.same({ false, true }, { costly(0.9, 3, true), costly(1, 3, true) })
  end)
end)
