-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rods with material frames: curved at rest, or stiffer in one direction than in
-- the other. All reference figures are independent solutions: shooting with
-- quaternions, and for the release a Cosserat rod extrapolated from four meshes.
local core = require "softworld.core"
local tools = require "spec.physics.tools"

local PI = math.pi
local near, share, below, fine = tools.near, tools.share, tools.below, tools.fine

-- Points of an arc in the plane z = 0 that starts along x and turns to y.
local function arc(length, angle, rise)
  local points, r = {}, length / angle
  for i = 0, 2000 do
    local u = angle * i / 2000
    points[#points + 1] = { r * math.sin(u), r * (1 - math.cos(u)), (rise or 0) * u }
  end
  return points
end

local function off(p, x, y, z) return tools.distance(p, { x, y, z }) end

describe("an arc that hangs out of its plane", function()
  -- quarter circle of length 1, EI = GJ = 1: weight, tip, moment at the clamp
  local cases = {
    { 5, { 0.5526037988, 0.5442878988, -0.4427589746 }, { -0.9883727488, 1.857608424 }, 5e-4 },
    { 20, { 0.3134018081, 0.2903053724, -0.7818443273 }, { -1.998056717, 5.223173599 }, 1e-3 },
    { 80, { 0.1471340051, 0.1160624307, -0.9128043087 }, { -2.410363908, 11.8422479 }, 2e-3 },
  }

  local function hang(weight, n)
    local s = core.scene{ gravity = { 0, 0, -1 } }
    local w = s:wire{ EA = 1e6, EI = 1, GJ = 1, mass_per_length = weight, radius = 0.001,
      path = arc(1, PI / 2), segments = n, rest = "path" }
    local c = s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
    local r = fine(s:settle())
    assert.are.equal(0, r.unstable)
    return w, c, r
  end

  for _, case in ipairs(cases) do
    it("has its tip and clamp moment, weight " .. case[1], function()
      local w, c, r = hang(case[1], 50)
      below(case[4], off(w:position(w.length), table.unpack(case[2])), "tip")
      local m = c:moment()
      near(-case[3][1], m[1], 0.01 * case[3][2], "moment about x")
      near(-case[3][2], m[2], 0.002 * case[3][2], "moment about y")
      below(20, r.iterations, "iterations")
      near(case[1] * w.length, c:force()[3], 1e-6 * case[1], "weight")
      near(m[1], -w:twist_moment(0), 0.05 * math.abs(m[1]), "twist at the clamp")
      near(0, w:twist_moment(w.length), 1e-9, "twist at the end")
    end)
  end

  it("has the same tip as the benchmark's case, turned in any way", function()
    local cases_of = require "softworld.cases"
    for _, options in ipairs{ {}, { rotation = { 0.5, 0.1, -0.3, 0.7 }, at = { 1, 2, 3 } },
      { gravity = { 3, -4, 2 }, weight = 5 } } do
      options.segments = 50
      local c = cases_of.arc(options)
      fine(c.run())
      below(2e-4, c.error(), "tip")
    end
    assert.has_error(function() cases_of.arc{ weight = 6 } end, "arc: weight must be one of 5, 20, 80")
  end)

  it("is second order in the number of segments", function()
    tools.order_at_least(1.8, { 25, 50, 100 }, function(n)
      local w = hang(5, n)
      return off(w:position(w.length), table.unpack(cases[1][2]))
    end, "tip")
  end)
end)

describe("the 45-degree bend of Bathe and Bolourchi 1979", function()
  for _, case in ipairs{ { 300, 58.77968539, 22.24503474, 40.18828384 },
    { 600, 47.1512944, 15.68507816, 53.46859844 } } do
    it("has the reference's tip under an end force: " .. case[1], function()
      local s = core.scene{ gravity = { 0, 0, 0 } }
      local w = s:wire{ EA = 1e7, EI = 1e7 / 12, GJ = 0.5e7 / 6, mass_per_length = 1, radius = 0.5,
        path = arc(25 * PI, PI / 4), segments = 50, rest = "path" }
      s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
      s:force{ kind = "point", on = w, s = w.length, force = { 0, 0, case[1] } }
      fine(s:settle())
      below(0.2, off(w:position(w.length), case[2], case[3], case[4]), "tip")
    end)
  end
end)

-- Lateral buckling under its own weight (nu = 0.5, height over thickness): GJ over the
-- smaller EI, and the weight at which the strip leaves its plane.
describe("a strip on edge", function()
  local cases = { { 3, 1.053267724, 15.72915728 }, { 5, 1.165267017, 14.68602725 },
    { 10, 1.24930015, 14.56721612 }, { 50, 1.316526697, 14.75667164 } }

  local function strip(case, weight)
    local s = core.scene{ gravity = { 0, 0, -1 } }
    local w = s:wire{ EA = 1e7, EI = { case[1] ^ 2, 1 }, normal = { 0, 0, 1 }, GJ = case[2],
      mass_per_length = weight, radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 50 }
    s:clamp(w, { s = 0 })
    return fine(s:settle()), w, s
  end

  for _, case in ipairs(cases) do
    it("buckles sideways at its critical weight within 1 %, height " .. case[1], function()
      assert.are.equal(0, (strip(case, 0.99 * case[3])).unstable)
      local r, w = strip(case, 1.01 * case[3])
      assert.is_true(r.unstable == 1 or math.abs(w:position(1)[2]) > 0.01, "still in its plane")
    end)
  end

  it("leaves its plane and finds a stable rest well above that weight", function()
    local _, w, s = strip(cases[2], 1.3 * cases[2][3])
    s:force{ kind = "point", on = w, s = 1, force = { 0, 0.05, 0 } }
    local r = fine(s:settle())
    assert.are.equal(0, r.unstable)
    tools.above(0.05, math.abs(w:position(1)[2]), "sideways")
  end)

  it("bends with the stiffness of the plane it is loaded in", function()
    for _, normal in ipairs{ { 0, 0, 1 }, { 0, 1, 0 } } do
      local s = core.scene{ gravity = { 0, 0, 0 } }
      local w = s:wire{ EA = 1e6, EI = { 4, 1 }, normal = normal, GJ = 1, mass_per_length = 1,
        radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 50 }
      s:clamp(w, { s = 0 })
      s:force{ kind = "point", on = w, s = 1, force = { 0, 0, 1e-4 } }
      fine(s:settle())
      share(1e-4 / 3 / (normal[3] == 1 and 4 or 1), w:position(1)[3], 1e-3, "droop")
    end
  end)

  it("has two stiffnesses in wire.beam.EI", function()
    local s = core.scene{}
    local w = s:wire{ EA = 1e6, EI = { 4, 1 }, normal = { 0, 0, 1 }, GJ = 1, mass_per_length = 1,
      radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    assert.are.same({ 4, 1 }, w.beam.EI)
  end)
end)

-- Wire from a spool, of natural angle phi, hung from a clamp that points down: does it
-- stay in its plane? Lambda = (weight/(EI curvature^3))^(1/3) at which it does.
describe("a curl that hangs down", function()
  local function out_of_plane(nu, phi, lambda)
    local s, path = core.scene{ gravity = { 0, 0, -1 } }, {}
    for i, p in ipairs(arc(1, phi)) do path[i] = { p[2], 0, -p[1] } end
    local w = s:wire{ EA = 1e7, EI = 1, GJ = 1 / (1 + nu), mass_per_length = (lambda * phi) ^ 3,
      radius = 0.001, path = path, segments = 50, rest = "path" }
    s:clamp(w, { s = 0, direction = { 0, 0, -1 } })
    assert.are.equal(0, fine(s:settle()).unstable)
    local x, most = w:positions(), 0
    for i = 2, #x, 3 do most = math.max(most, math.abs(x[i])) end
    return most
  end

  for _, case in ipairs{ { 0.5, 2, 0.5789202249 }, { 0.5, 4, 0.6206878392 }, { 0, 4, 0.5165085683 } } do
    it(("leaves its plane at the weight it should, +-3 %%: nu %g, %g pi"):format(case[1], case[2]),
      function()
        below(1e-6, out_of_plane(case[1], case[2] * PI, 1.03 * case[3]), "heavier")
        tools.above(0.02, out_of_plane(case[1], case[2] * PI, 0.97 * case[3]), "lighter")
      end)
  end
end)

-- Tip of a quarter circle of 1 m that is let go: radius 2.5 mm, nu = 0.3, weight 10.
describe("a quarter circle that is let go", function()
  local tip = { { 0.25, 0.6039620852, 0.5746864788, -0.3925761022 },
    { 0.5, 0.146602, 0.146017, -0.829389 }, { 1, 0.565548, 0.461574, -0.554890 } }

  it("swings in space like the reference and keeps its energy", function()
    local s = core.scene{}
    local w = s:wire{ E = 941760000, nu = 0.3, density = 1500, radius = 0.0025,
      path = arc(1, PI / 2), segments = 50, rest = "path" }
    s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
    local before, drift = s:energy().total, 0
    for _, row in ipairs(tip) do
      fine(s:advance({ dt = 0.005 }, row[1]))
      below(4e-3, off(w:position(w.length), row[2], row[3], row[4]), "tip at " .. row[1])
      drift = math.max(drift, math.abs(s:energy().total - before))
    end
    below(1e-3 * w.beam.mass_per_length * 9.81, drift, "energy drift")
  end)
end)

describe("a wire that is curved at rest", function()
  local shapes = { ring = arc(1, 1.96 * PI), coil = arc(1, 4 * PI, 0.01) }

  local function wire(path, options)
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e5, EI = options and options.EI or 1, GJ = 0.8, mass_per_length = 1,
      radius = 0.001, path = path, segments = 40, rest = "path",
      normal = options and options.normal }
    return s, w
  end

  local function no_force(s, w, what)
    local sum = {}
    local before = s:energy()
    for kind, term in pairs(s:evaluate(w)) do
      for i, f in ipairs(term.force) do sum[i] = (sum[i] or 0) + f end
      if kind ~= "bend" and kind ~= "frame" then near(0, term.energy, 1e-12, kind .. what) end
    end
    for _, f in ipairs(sum) do near(0, f, 1e-8, "force" .. what) end
    near(0, before.total, 1e-11, "energy" .. what)
    near(0, (w:max_strain{ now = true }), 1e-12, "strain" .. what)
    near(0, (w:strain(0.37)), 1e-12, "strain in the middle" .. what)
  end

  for name, path in pairs(shapes) do
    it("is free of force as drawn: " .. name, function()
      local s, w = wire(path)
      no_force(s, w, " free")
      s:clamp(w, { s = 0 })
      local middle = s:clamp(w, { s = 0.4137 }) -- between two nodes
      s:grip(w, { s = 0.7, width = 0.07 })
      no_force(s, w, " held")
      local x = w:positions()
      fine(s:settle())
      below(1e-10, tools.largest_difference(x, w:positions()), "shift")
      fine(s:advance({ dt = 0.01 }, 0.1))
      middle:release()
      fine(s:settle())
      no_force(s, w, " let go")
    end)
  end

  it("is free of force as drawn with two stiffnesses", function()
    local s, w = wire(shapes.coil, { EI = { 1, 5 }, normal = { 0, 1, 0.3 } })
    s:clamp(w, { s = 0.21 })
    no_force(s, w, "")
  end)

  it("springs back to its own curve from a straight one", function()
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e5, EI = 1, GJ = 0.8, mass_per_length = 1, radius = 0.001,
      path = arc(1, 1), segments = 40, rest = "path" }
    s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
    fine(s:settle()) -- the chords' tangent at the clamp differs a little from the given one
    local p = w:position(w.length)
    local f = s:force{ kind = "point", on = w, s = w.length, force = { 0.3, -0.4, 0.5 } }
    fine(s:settle())
    tools.above(0.05, off(w:position(w.length), table.unpack(p)), "moved")
    f:release()
    fine(s:settle())
    below(1e-8, off(w:position(w.length), table.unpack(p)), "back")
  end)

  it("moves the same in a turned world", function()
    local q = { 0.5, -0.5, 0.1, (1 - 0.51) ^ 0.5 }
    local function turned(a)
      local u = { q[2], q[3], q[4] }
      local t = tools.cross(u, a)
      local v = tools.cross(u, t)
      return { a[1] + 2 * (q[1] * t[1] + v[1]), a[2] + 2 * (q[1] * t[2] + v[2]),
        a[3] + 2 * (q[1] * t[3] + v[3]) }
    end
    local function same(a) return a end
    local function tip(turn)
      local path = {}
      for i, p in ipairs(arc(1, 2, 0.05)) do path[i] = turn(p) end
      local s = core.scene{ gravity = turn{ 1, 0.5, -9 } }
      local w = s:wire{ EA = 1e5, EI = { 1, 3 }, GJ = 0.8, mass_per_length = 1, radius = 0.001,
        path = path, segments = 30, rest = "path", normal = turn{ 0.1, 1, 0.5 } }
      s:clamp(w, { s = 0 })
      fine(s:settle())
      fine(s:advance({ dt = 0.01 }, 0.05))
      s:force{ kind = "point", on = w, s = 0.5, force = turn{ 2, 1, 1 } }
      fine(s:advance({ dt = 0.01 }, 0.2))
      return w:position(0.99)
    end
    below(1e-9, off(tip(turned), table.unpack(turned(tip(same)))), "difference")
  end)

  it("keeps its frames exactly in snapshots", function()
    local s, w = wire(shapes.coil, { EI = { 1, 5 }, normal = { 0, 1, 0.3 } })
    s:gravity{ 0, 0, -3 }
    local c = s:clamp(w, { s = 0 })
    fine(s:advance({ dt = 0.01 }, 0.1))
    local snapshot = s:snapshot()
    local function go()
      c:pose({ 0, 0, 0.01 }, { axis = { 1, 0, 0 }, angle = 0.4 })
      fine(s:advance({ dt = 0.01 }, 0.2))
      return w:positions()
    end
    local first = go()
    s:clamp(w, { s = 0.5 })
    fine(s:settle())
    s:restore(snapshot)
    assert.are.same(first, go())
  end)
end)

describe("the derivatives of a wire with frames", function()
  -- at an equilibrium all spins are in balance, and the force is a gradient
  it("agree with differences", function()
    local s = core.scene{ gravity = { 0, 0, -1 } }
    local w = s:wire{ EA = 1e4, EI = { 1, 3 }, GJ = 1.7, normal = { 0, 0.3, 1 },
      mass_per_length = 2, radius = 0.001, path = arc(1.5, 1.5, 0.2), segments = 8, rest = "path" }
    local c = s:clamp(w, { s = 0 })
    s:clamp(w, { s = w.length })
    c:pose({ 0, 0, 0 }, { axis = { 1, 0, 0 }, angle = 0.7 })
    fine(s:settle())
    local x, random, h = w:positions(), tools.random(5), 1e-5
    local function ask(sign, d)
      local at = {}
      for i = 1, #x do at[i] = x[i] + sign * h * d[i] end
      return s:evaluate(w, { positions = at, direction = d }).frame
    end
    for _ = 1, 5 do
      local d, slope = {}, 0
      for i = 1, #x do d[i] = random() end
      local plus, minus, here = ask(1, d), ask(-1, d), ask(0, d)
      for i = 1, #x do
        slope = slope - here.force[i] * d[i]
        near(-(plus.force[i] - minus.force[i]) / (2 * h), here.product[i], 1e-4, "stiffness")
      end
      near((plus.energy - minus.energy) / (2 * h), slope, 1e-5, "force")
    end
  end)
end)
