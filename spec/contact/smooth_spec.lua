-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sharp edges meet the smooth curve of a wire, not the chords between its nodes. So no place along an edge
-- of the wire holds better than another.
local core = require "softworld.core"

local T = 1 -- pull [N]

-- Adds an edge along y at the origin. Its faces go down by `slope` on both sides. It belongs to a box, or
-- to a hull in the form of a wedge.
local function add_edge(s, slope)
  if slope == math.pi / 4 then
    return s:obstacle{ shape = "box", size = { 1, 1, 1 }, at = { 0, 0, -math.sqrt(0.5) },
      rotation = { axis = { 0, 1, 0 }, angle = slope }, friction = 0 }
  end
  local points, x, z = {}, math.cos(slope), -math.sin(slope)
  for _, y in ipairs{ -0.5, 0.5 } do
    for _, p in ipairs{ { 0, 0 }, { x, z }, { -x, z } } do
      points[#points + 1], points[#points + 2], points[#points + 3] = p[1], y, p[2]
    end
  end
  return s:obstacle{ shape = "hull", points = points, friction = 0 }
end

-- Draws a wire that is bent over an edge along by three of its own edges. Returns the least and largest
-- pull over T.
local function drawn(o)
  local h, n, r, slope = o.h or 0.01, 20, 0.0005, o.angle / 2
  local s = core.scene{ gravity = { 0, 0, 0 } }
  local x, z = math.cos(slope), math.sin(slope)
  local path, R = {}, 3 * h -- it begins round, and clear of the edge
  local top = r + 0.1 * h
  for i = -60, 60 do
    local a = i / 60 * slope
    path[#path + 1] = { R * math.sin(a), 0, top + R * (math.cos(a) - 1) }
  end
  local foot, arm = path[1], n * h - R * slope
  table.insert(path, 1, { foot[1] - arm * x, 0, foot[3] - arm * z })
  path[#path + 1] = { -foot[1] + arm * x, 0, foot[3] - arm * z }
  local w = s:wire{ EA = 1e5, EI = T * h * h / o.taut, mass_per_length = 0.05, radius = r, path = path,
    segments = 2 * n }
  add_edge(s, slope + math.rad(15)) -- the wire stays off its faces
  s:force{ kind = "point", on = w, s = 0, force = { -T * x, 0, -T * z } }
  s:force{ kind = "damping", mass = 20, on = w }
  local drag = 20 * 0.05 * w.length * h -- damping force at one edge per second [N]
  local pin = s:pin(w, { s = w.length })
  local dt = o.dt or 0.002
  assert.is_true(s:advance({ dt = dt }, 1).ok)
  pin:follow{ points = { { 0, 0, 0 }, { 3 * h * x, 0, -3 * h * z } }, relative = true, speed = h,
    law = "linear" }
  local least, most = math.huge, 0
  for i = 1, 100 do
    assert.is_true(s:advance({ dt = dt }, 1.5 + 0.02 * i).ok)
    local f = pin:force()
    local pull = ((f[1] ^ 2 + f[3] ^ 2) ^ 0.5 - drag) / T
    least, most = math.min(least, pull), math.max(most, pull)
  end
  return least, most
end

describe("a sharp edge without friction", function()
  -- With chords the pull is 54, 140 and 200 % more than T at T h^2/EI = 0.5, 2 and 10.
  for _, case in ipairs{ { 0.5, 90 }, { 2, 90 }, { 10, 90 }, { 2, 60 }, { 10, 60 }, { 10, 30 },
    { 2, 90, dt = 0.01 }, { 2, 90, dt = 0.0005 }, { 10, 90, h = 0.003 } } do
    local name = ("T h^2/EI %g, %d degrees, dt %g, edges of %g"):format(case[1], case[2],
      case.dt or 0.002, case.h or 0.01)
    it("lets a taut wire slide: " .. name, function()
      local least, most = drawn{ taut = case[1], angle = math.rad(case[2]), dt = case.dt, h = case.h }
      assert.is_true(least > 0.98 and most < 1.02, ("%.4f to %.4f of the pull"):format(least, most))
    end)
  end
end)

-- Reference case 16: a heavy elastica on a frictionless table hangs over its edge by b, in units
-- of l = (EI/w)^(1/3); its far end is held by H, in units of w l.
local EI, WEIGHT = 1e-3, 0.3 -- [N m2], [N/m]
local l = (EI / WEIGHT) ^ (1 / 3)

-- Returns x on the wire's smooth curve, u edges from its first node [m].
local function on_curve(p, u)
  local c = math.floor(u + 0.5)
  local v = u - c + 0.5
  local a, e = (1 - v) ^ 2 / 2, v ^ 2 / 2
  return a * p[3 * c - 2] + (1 - a - e) * p[3 * c + 1] + e * p[3 * c + 4]
end

local function over_table(b, onto, shift)
  local n, r = 50, 2e-4 * l
  local length = b * l * n / (n - onto - shift)
  local a = length - b * l
  local s = core.scene{}
  local w = s:wire{ EA = 1e4, EI = EI, mass_per_length = WEIGHT / 9.81, radius = r,
    from = { -a, 0, r }, to = { b * l, 0, r }, segments = n }
  s:obstacle{ shape = "box", size = { 2, 1, 1 }, at = { -1, 0, -0.5 }, friction = 0 }
  local pin, x = s:pin(w, { s = 0 }), -a
  for _ = 1, 12 do
    local settled = s:settle()
    assert.is_true(settled.ok, settled.reason)
    local p, low, high = w:positions(), 1, n - 1
    for _ = 1, 50 do
      local middle = (low + high) / 2
      if on_curve(p, middle) < 0 then low = middle else high = middle end
    end
    local off = (n - low) * length / n - b * l -- overhang in excess of b [m]
    if math.abs(off) < 1e-6 * l then return math.abs(pin:force()[1]) / (WEIGHT * l), p[#p] / l end
    x = x - off
    pin:pose{ x, 0, r }
  end
  error "the overhang was not met"
end

describe("a wire over the edge of a table (case 16)", function()
  for _, case in ipairs{ { b = 1.25, H = 0.5089041795, onto = 32 },
    { b = 2.25, H = 1.943825807, onto = 28 } } do
    for eighth = 0, 7 do
      it(("is held by the exact force: b = %g, mesh shifted by %d/8"):format(case.b, eighth), function()
        local H, tip = over_table(case.b, case.onto, eighth / 8)
        -- with chords: up to 78 % off. The reference asks for 1 % of H, and for 0.5 % of b.
        assert.is_true(math.abs(H / case.H - 1) < 0.01, H .. " instead of " .. case.H)
        assert.is_true(math.abs(tip + case.H) < 0.005 * case.b, tip .. " instead of " .. -case.H)
      end)
    end
  end
end)

-- Coarse wires over thin walls: touches come and go at edges that are nearer to each other than the nodes.
describe("a wire dropped on a thin wall", function()
  for _, case in ipairs{ { 8, 0.003 }, { 14, 0.001 }, { 20, 0.01 }, { 35, 0.003 } } do
    for _, dt in ipairs{ 1e-2, 2e-3, 5e-4 } do
      it(("gains no energy: %d segments, wall of %g m, dt %g"):format(case[1], case[2], dt), function()
        local s, h = core.scene{}, 0.16
        s:obstacle{ shape = "plane", friction = 0.3 }
        s:obstacle{ shape = "box", size = { case[2], 1, 0.1 }, at = { 0.43, 0, 0.05 }, friction = 0.3,
          rotation = { axis = { 0, 0, 1 }, angle = 0.3 } }
        local m = 1500 * math.pi * 0.0025 ^ 2
        s:wire{ EA = 1e3, EI = 1.5e-3, mass_per_length = m, radius = 0.0025, from = { 0, 0, h },
          to = { 1, 0, h }, segments = case[1] }
        local lowest, rise = math.huge, 0
        for i = 1, 60 do
          assert.is_true(s:advance({ dt = dt }, 0.01 * i).ok)
          local e = s:energy().total
          lowest = math.min(lowest, e)
          rise = math.max(rise, e - lowest)
        end
        local share = rise / (m * 9.81 * h)
        assert.is_true(share < 0.02, ("%.3g of what it fell with"):format(share))
      end)
    end
  end
end)

-- The facets approximate a round peg. The wire meets them with its chords; if it met each facet with its
-- smooth curve, they would hinder each other.
describe("a wire that falls on a round peg of 256 facets", function()
  it("takes less than 4000 iterations", function()
    local s, points, R = core.scene{}, {}, 0.03
    for i = 0, 255 do
      local a = 2 * math.pi * (i + 0.37) / 256
      for _, y in ipairs{ -0.05, 0.05 } do
        points[#points + 1], points[#points + 2], points[#points + 3] = R * math.cos(a), y, R * math.sin(a)
      end
    end
    s:obstacle{ shape = "hull", points = points, friction = 0.3 }
    local w = s:wire{ EA = 1e3, EI = 1.5e-4, mass_per_length = 0.03, radius = 0.0025,
      from = { -0.45, 0, R + 0.01 }, to = { 0.55, 0, R + 0.01 }, segments = 100 }
    local r = s:advance({ dt = 0.002 }, 0.6)
    assert.is_true(r.ok, r.reason)
    assert.is_true(w:position(0)[3] > 0, "it has slid off")
    assert.is_true(r.iterations < 4000, r.iterations) -- measured: 2570; with its smooth curve 6700
  end)
end)
