-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rods with material frames compared with rods without, and what is refused.
local sw = require "softworld"
local core = sw.core
local tools = require "spec.physics.tools"

local PI = math.pi
local near, below, fine = tools.near, tools.below, tools.fine

-- Two values of EI that hardly differ choose the frames for a wire that does not need them. The results
-- must be those of the twist of whole spans.
describe("a straight round wire with frames", function()
  local function pair(make)
    local results = {}
    for i, EI in ipairs{ 1, { 1, 1 + 1e-12 } } do
      results[i] = make(EI, type(EI) == "table" and { 0, 0, 1 } or nil)
    end
    below(1e-7, tools.largest_difference(results[1], results[2]), "difference")
  end

  it("is twisted, bent and held like one without", function()
    pair(function(EI, normal)
      local s = core.scene{ gravity = { 0, -1, 0 } }
      local w = s:wire{ EA = 1e6, EI = EI, normal = normal, GJ = 0.7, mass_per_length = 5,
        radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 50 }
      local a, b = s:clamp(w, { s = 0 }), s:clamp(w, { s = 1 })
      local out = {}
      for turn = 1, 4 do
        b:pose({ 0.8, 0.1, 0.05 }, { axis = { 1, 0, 0 }, angle = turn })
        fine(s:settle())
        for _, p in ipairs{ w:position(0.4), a:force(), a:moment(), b:moment() } do
          table.move(p, 1, 3, #out + 1, out)
        end
        local e = s:energy()
        out[#out + 1] = w:twist_moment(0.5)
        out[#out + 1] = e.bend
        out[#out + 1] = e.twist
      end
      return out
    end)
  end)

  it("swings like one without", function()
    pair(function(EI, normal)
      local s = core.scene{}
      local w = s:wire{ EA = 1e5, EI = EI, normal = normal, GJ = 0.7, mass_per_length = 1,
        radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 20 }
      s:clamp(w, { s = 0 })
      local c = s:clamp(w, { s = 0.6 })
      fine(s:advance({ dt = 0.005 }, 0.1))
      c:release()
      fine(s:advance({ dt = 0.005 }, 0.3))
      return w:positions()
    end)
  end)

  it("adds up turns, splits them when grasped in the middle, and evens them out when let go", function()
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e6, EI = { 1, 1 + 1e-12 }, normal = { 0, 0, 1 }, GJ = 1e-3,
      mass_per_length = 1, radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 50 }
    s:clamp(w, { s = 0 })
    local b = s:clamp(w, { s = 1 })
    for k = 1, 80 do
      b:pose({ 1, 0, 0 }, { axis = { 1, 0, 0 }, angle = k * PI / 2 })
      fine(s:settle())
    end
    near(1e-3 * 40 * PI, w:twist_moment(0.5), 1e-9, "after twenty turns")
    near(1e-3 * 40 * PI, b:moment()[1], 1e-9, "moment")
    local middle = s:clamp(w, { s = 0.413 })
    fine(s:settle())
    near(1e-3 * 40 * PI, w:twist_moment(0.2), 2e-3, "grasped")
    middle:release()
    fine(s:settle())
    near(1e-3 * 40 * PI, w:twist_moment(0.5), 1e-9, "let go")
  end)
end)

describe("a free strip in flight", function()
  it("keeps its momentum and its energy", function()
    local path = {}
    for i = 0, 200 do
      local u = 3 * i / 200
      path[i + 1] = { math.sin(u) / 3, (1 - math.cos(u)) / 3, 0.05 * u }
    end
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e3, EI = { 1e-2, 5e-2 }, normal = { 0, 0.2, 1 }, GJ = 1e-2,
      mass_per_length = 0.1, radius = 0.003, path = path, segments = 40, rest = "path" }
    w:set_velocity({ 0, 0, 1 }, { 1, 2, 15 }, { 0, 0, 0 })
    local p0, l0 = tools.momentum(w)
    local before = s:energy().total
    fine(s:advance({ dt = 0.002 }, 0.5))
    local p1, l1 = tools.momentum(w)
    below(1e-12, tools.distance(p0, p1), "momentum")
    below(1e-4 * tools.norm(l0), tools.distance(l0, l1), "angular momentum")
    near(before, s:energy().total, 2e-3 * before, "energy")
  end)

  it("is let go on edge without a failure", function()
    local s = sw.scene{}
    local w = s:wire{ EA = 1e3, EI = { 8e-3, 1.5e-3 }, normal = { 0, 0, 1 }, GJ = 2e-3,
      mass_per_length = 0.03, radius = 0.0025, from = { 0, 0, 0.3 }, to = { 1, 0, 0.3 } }
    s:obstacle{ shape = "plane", friction = 0.3 }
    local c = s:clamp(w, { s = 0.5 })
    c:pose({ 0.5, 0, 0.3 }, { axis = { 1, 0.2, 0 }, angle = 0.4 })
    fine(s:settle())
    c:release()
    fine(s:advance({ dt = 0.005 }, 1))
    below(0.02, w:position(0.5)[3], "height")
  end)
end)

describe("a soft coil of ten turns", function()
  it("hangs down many times its length at rest, and its clamp bears it", function()
    local path = {}
    for i = 0, 2000 do
      local u = PI * i / 100
      path[i + 1] = { 0.02 * math.sin(u), 0.02 * (1 - math.cos(u)), -0.0005 * u }
    end
    local s = core.scene{}
    local w = s:wire{ E = 2e7, nu = 0.3, density = 1500, radius = 0.001, path = path,
      segments = 200, rest = "path" }
    local c = s:clamp(w, { s = 0 })
    assert.are.equal(0, fine(s:settle()).unstable)
    below(-0.7, w:position(w.length)[3], "lower end")
    local weight = w.beam.mass_per_length * w.length * 9.81
    near(weight, c:force()[3], 1e-6 * weight, "weight")
  end)
end)

describe("a gripped strip", function()
  local function strip()
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e4, EI = { 4, 1 }, normal = { 0, 0, 1 }, GJ = 0.3, mass_per_length = 1,
      radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 40 }
    return s, w, s:grip(w, { s = 0.5, width = 0.11 })
  end

  it("turns with the grip, all of it", function()
    local s, w, grip = strip()
    for k = 1, 3 do
      grip:pose({ 0.5, 0, 0 }, { axis = { 1, 0, 0 }, angle = k * PI / 6 })
      fine(s:settle())
    end
    near(0, s:energy().total, 1e-12, "energy turned")
    grip:release()
    s:clamp(w, { s = 0.5 })
    near(0, s:energy().total, 1e-12, "energy let go")
    -- now on edge: the first stiffness is the one across z
    local f = s:force{ kind = "point", on = w, s = 1, force = { 0, 0, 1e-3 } }
    fine(s:settle())
    near(1e-3 * 0.5 ^ 3 / 3, w:position(1)[3], 1e-3 * 1e-3 * 0.5 ^ 3 / 3, "droop")
    f:release()
  end)

  it("is turned over and over by a trajectory", function()
    local s, w, grip = strip()
    s:clamp(w, { s = 0 })
    grip:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true, duration = 4,
      turn = { axis = { 1, 0, 0 }, angle = 4 * PI } }
    s:force{ kind = "damping", mass = 20 }
    fine(s:advance({ dt = 0.01 }, 6))
    near(0.3 * 4 * PI / 0.445, w:twist_moment(0.2), 1e-3, "twist moment")
  end)
end)

describe("a wire with frames", function()
  local function bad(text, change)
    local args = { EA = 1e5, EI = { 1, 2 }, normal = { 0, 0, 1 }, GJ = 1, mass_per_length = 1,
      radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    for key, value in pairs(change) do args[key] = value or nil end
    local s = core.scene{}
    local ok, message = pcall(s.wire, s, args)
    assert.is_false(ok)
    assert.is_truthy(message:find(text, 1, true), message)
  end

  it("says what is missing", function()
    bad("normal", { normal = false })
    bad("along", { normal = { 2, 0, 0 } })
    bad("GJ", { GJ = false })
    bad("model", { model = "string" })
    bad("EI", { EI = { 1 } })
    bad("EI", { EI = { 1, -1 } })
  end)

  it("is refused by explicit methods and plastic springs if it is curved at rest", function()
    local s = core.scene{}
    local w = s:wire{ EA = 1e5, EI = 1, GJ = 1, mass_per_length = 1, radius = 0.001,
      path = { { 0, 0, 0 }, { 0.5, 0.1, 0 }, { 1, 0, 0 } }, rest = "path" }
    s:clamp(w, { s = 0 })
    for _, case in ipairs{ { s.advance, s, { dt = 1e-5, integrator = "rk4" }, 0.1 },
      { s.force, s, { kind = "plastic", on = w, yield_moment = 1, hardening = 0 } } } do
      local ok, message = pcall(table.unpack(case))
      assert.is_false(ok)
      assert.is_truthy(message:find("curved at rest", 1, true), message)
    end
  end)
end)
