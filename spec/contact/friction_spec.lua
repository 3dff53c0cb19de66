-- SPDX-License-Identifier: GPL-3.0-or-later
-- Coulomb friction of a wire on a table. A wire pulled by less than mu N holds for any time; one that is
-- pulled harder slides with (F - mu N)/m.
local scenes = require "spec.contact.scenes"
local core = require "softworld.core"

local G, MASS, MU = 9.81, 0.03, 0.3
local WEIGHT = MASS * G -- of the 1 m wire [N]
local CREEP = 10e-6     -- largest drift of a held wire in 100 s [m]
local SLIDE = 0.01      -- relative error of a sliding acceleration [-]

local function pulled(share, options)
  local s, w, _, L = scenes.lying(options)
  s:advance({ dt = 0.01 }, 0.5)
  s:force{ kind = "point", on = w, s = L, force = { share * MU * WEIGHT, 0, 0 } }
  return s, w, L
end

describe("a wire on a table", function()
  for _, share in ipairs{ 0.5, 0.9, 0.98 } do
    it(("holds %g mu N for 100 s"):format(share), function()
      local s, w, L = pulled(share)
      s:advance({ dt = 0.01 }, 10)
      local at10 = w:position(L)[1]
      s:advance({ dt = 0.01 }, 110)
      assert.is_true(math.abs(w:position(L)[1] - at10) < CREEP)
      -- at first the wire gives way by its own stretch, F L/(2 EA) at most, and by the friction springs
      assert.is_true(at10 - L < 2e-4, "gave way " .. at10 - L)
    end)
  end

  for _, share in ipairs{ 1.02, 1.2, 2 } do
    it(("slides at %g mu N"):format(share), function()
      local s, w, L = pulled(share)
      s:advance({ dt = 0.01 }, 1.5) -- past the start, while slip spreads
      local v0, t0 = w:velocity(L / 2)[1], s.time
      s:advance({ dt = 0.01 }, 2.5)
      local a = (w:velocity(L / 2)[1] - v0) / (s.time - t0)
      local expected = (share - 1) * MU * G
      assert.is_true(math.abs(a - expected) < SLIDE * expected,
        ("%g instead of %g m/s2"):format(a, expected))
    end)
  end

  it("slides sideways with the same friction", function()
    local s, w = scenes.lying()
    s:advance({ dt = 0.01 }, 0.5)
    s:force{ kind = "line", on = w, force = { 0, 1.5 * MU * WEIGHT, 0 } }
    s:advance({ dt = 0.01 }, 1.5)
    local v0 = w:velocity(0.5)[2]
    s:advance({ dt = 0.01 }, 2.5)
    local expected = 0.5 * MU * G
    assert.is_true(math.abs(w:velocity(0.5)[2] - v0 - expected) < SLIDE * expected)
    assert.is_true(math.abs(w:position(0.5)[1] - 0.5) < 1e-4)
  end)

  it("comes to rest where friction has taken its energy: v^2/(2 mu g)", function()
    local s, w = scenes.lying()
    s:advance({ dt = 0.01 }, 0.5)
    local x0 = w:position(0.5)[1]
    w:set_velocity{ 1, 0, 0 }
    s:advance({ dt = 0.01 }, 2.5)
    local way = w:position(0.5)[1] - x0
    local expected = 1 / (2 * MU * G)
    assert.is_true(math.abs(way - expected) < 0.01 * expected, way .. " instead of " .. expected)
    assert.is_true(math.abs(w:velocity(0.5)[1]) < 1e-6)
  end)

  it("stays at rest once it has stopped, at whatever instant of a step", function()
    for _, wire in ipairs{ scenes.wire, scenes.cable "GXL 1.5" } do
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
        for k = 0, 20 do
          local s, w = scenes.lying{ segments = 5, wire = wire }
          assert.is_true(s:advance({ dt = dt }, 0.1).ok)
          w:set_velocity{ 0.3 + 1.3 * k * dt, 0, 0 }
          s:advance({ dt = dt }, 0.8)
          local x = w:position(0.5)[1]
          s:advance({ dt = dt }, 1)
          assert.is_true(math.abs(w:position(0.5)[1] - x) < 1e-9, ("%g m in 0.2 s: dt %g, number %d"):format(
            w:position(0.5)[1] - x, dt, k))
        end
      end
    end
  end)

  it("keeps its hold when a clamp elsewhere is put on and taken off", function()
    local s, w, L = pulled(0.9)
    s:advance({ dt = 0.01 }, 2)
    local before = w:position(L)[1]
    local clamp = s:clamp(w, { s = 0.0 })
    s:advance({ dt = 0.01 }, 3)
    clamp:release()
    s:advance({ dt = 0.01 }, 6)
    assert.is_true(math.abs(w:position(L)[1] - before) < 2 * CREEP,
      "moved " .. w:position(L)[1] - before)
  end)

  it("is carried by a table that moves slowly and left behind by one that jerks", function()
    for _, case in ipairs{ { a = 0.5 * MU * G, carried = true }, { a = 3 * MU * G, carried = false } } do
      local s = core.scene{}
      local w = scenes.add_wire(s, { 0, 0, 0.0025 }, { 1, 0, 0.0025 }, 20)
      local plate = s:obstacle{ shape = "box", size = { 8, 2, 0.1 }, at = { 0, 0, -0.05 },
        friction = MU }
      s:advance({ dt = 0.005 }, 0.3)
      local a = case.a
      plate:follow{ func = function(t) return { 0.5 * a * t * t, 0, 0 } end, relative = true }
      s:advance({ dt = 0.005 }, 1.3)
      local moved = w:position(0.5)[1] - 0.5
      local wanted = case.carried and 0.5 * a or 0.5 * MU * G
      assert.is_true(math.abs(moved - wanted) < 0.02 * wanted,
        ("a = %g: moved %g, expected %g"):format(a, moved, wanted))
    end
  end)
end)

-- A wire on a slope whose tangent is below or above mu. Below, it holds: friction's spring of 1000 m/hbar^2
-- gives way under the weight by less than g h^2/1000. Above, it slides by the formula; the first step
-- causes a relative error of h over the time.
describe("a cable on a slope, in steps of any size", function()
  for _, segments in ipairs{ 10, 40 } do
    for _, dt in ipairs{ 2e-2, 1e-2, 1e-3, 1e-4, 5e-5, 2e-5 } do
      local duration = math.min(0.3, 1500 * dt)
      local function way(slope)
        local s = core.scene{ gravity = { G * math.sin(slope), 0, -G * math.cos(slope) } }
        local w = s:wire{ E = 3e9, density = 3000, radius = 0.0015, from = { 0, 0, 0.0015 },
          to = { 0.3, 0, 0.0015 }, segments = segments }
        s:obstacle{ shape = "plane", friction = MU }
        local r = s:advance({ dt = dt }, duration)
        assert.is_true(r.ok, r.reason)
        return w:position(0.15)[1] - 0.15
      end

      it(("holds, %d edges, %g ms"):format(segments, 1e3 * dt), function()
        local off = way(0.25)
        assert.is_true(math.abs(off) < 1e-3 * G * dt ^ 2, ("gave way by %g m"):format(off))
      end)

      it(("slides, %d edges, %g ms"):format(segments, 1e3 * dt), function()
        local slope = 0.5
        local want = 0.5 * G * (math.sin(slope) - MU * math.cos(slope)) * duration ^ 2
        local off = way(slope) / want - 1
        assert.is_true(math.abs(off) < 0.1 * dt / duration + 1e-6, ("off by %g"):format(off))
      end)
    end
  end
end)
