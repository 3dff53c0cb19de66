-- SPDX-License-Identifier: GPL-3.0-or-later
-- Frequencies about sagged equilibria and about equilibria with contact, also against runs.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local modal = require "spec.modal.tools"

-- A nylon wire between level clamps 1 m apart. Independent solution: geometrically exact Hermite elements
-- and the eigenvalues of the exact Hessian, relative error 1e-5. The frequencies are those of the modes in
-- the plane of the sag [Hz].
local nylon = {
  { name = "taut", length = 0.9995, sag = 0.001272555461, tension = 3.16969699,
    15.66381165, 31.31295496, 47.53488902 },
  { name = "slack", length = 1.005, sag = 0.04533523839, tension = 0.01941786933,
    6.869191615, 11.08168389, 21.21870812 },
}

local function hung(case, segments)
  local scene = sw.scene{}
  local wire = scene:wire{ E = 2e9, density = 1150, radius = 1e-3, from = { 0, 0, 0 },
    to = { case.length, 0, 0 }, segments = segments or 50 }
  scene:clamp(wire, { s = 0 })
  local far = scene:clamp(wire, { s = wire.length })
  for i = 1, 5 do
    far:pose{ case.length + (1 - case.length) * i / 5, 0, 0 }
    t.fine(scene:settle())
  end
  return wire, scene
end

-- The frequencies whose shapes stay in the plane of x and z.
local function in_plane(wire, modes)
  local f, list = wire:frequencies{ modes = modes, shapes = true }, {}
  for i = 1, #f do
    local across = modal.share_along(f.shapes[i], 2)
    assert.is_true(across < 1e-6 or across > 1 - 1e-6, "neither in the plane nor across it")
    if across < 0.5 then list[#list + 1] = f[i] end
  end
  return list
end

describe("a wire between two clamps", function()
  for _, case in ipairs(nylon) do
    it("has the frequencies of its sag: " .. case.name, function()
      local wire = hung(case)
      t.share(case.sag, -wire:position(wire.length / 2)[3], 0.01, "sag")
      t.share(case.tension, wire:tension(wire.length / 2), 0.01, "tension")
      local f = in_plane(wire, 8)
      for i = 1, 3 do t.share(case[i], f[i], i == 1 and 0.01 or 0.02, "mode " .. i) end
    end)

    it("converges to them with shorter segments: " .. case.name, function()
      local f = in_plane(hung(case, 200), 8)
      for i = 1, 3 do t.share(case[i], f[i], 5e-4, "mode " .. i) end
    end)
  end

  -- A mode's share of the motion, x' M (x - x0), is a sine with the mode's frequency.
  it("swings at its frequencies", function()
    local wire, scene = hung(nylon[2], 30)
    local f = wire:frequencies{ modes = 4, shapes = true }
    local rest, steps, dt = wire:positions(), 1000, 1 / (150 * f[3])
    wire:set_velocity({ 0, 1e-3, 0.7e-3 }, { 0, 4e-3, 3e-3 }, { 0.5, 0, 0 })
    local run = t.fine(scene:run{ duration = steps * dt, dt = dt, frame = dt,
      integrator = "implicit-midpoint" })
    local frames = run:frames()
    for _, mode in ipairs{ 1, 2, 3 } do
      local measured = modal.swings(wire, f.shapes[mode], rest, frames)
      t.share(f[mode], measured, 2e-3, "mode " .. mode)
    end
  end)

  it("of 20000 segments has the frequencies of a pulled string", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e5, EI = 1e-2, mass_per_length = 0.03, radius = 0.003,
      from = { 0, 0, 0 }, to = { 20, 0, 0 }, segments = 20000 }
    scene:pin(wire, { s = 0 })
    scene:pin(wire, { s = 20 }):pose{ 20.02, 0, 0 }
    t.fine(scene:settle())
    local clock = os.clock()
    local f = wire:frequencies{ modes = 8 }
    t.below(10, os.clock() - clock, "seconds")
    local T, L = 100, 20
    for i = 1, 4 do
      -- a string's, stretched by T / EA, with a beam's stiffness
      local k = i * math.pi / L
      local string = (T / 0.03 * k ^ 2 + 1e-2 / 0.03 * k ^ 4) ^ 0.5 / (2 * math.pi)
      t.share(string / (1 + T / 1e5) ^ 0.5, f[2 * i - 1], 1e-3, "mode " .. i)
    end
  end)

  -- Bending alone with 20000 segments: the matrix has entries 10^16 times larger than what the first mode
  -- feels.
  it("of 20000 stiff segments is still a beam", function()
    local wire, _, unit = modal.wire("clamps", { segments = 20000, EA = 1e4 })
    local f = wire:frequencies{ modes = 4 }
    t.share(22.37328545, f[1] / unit, 1e-4, "mode 1")
    t.share(61.67282287, f[3] / unit, 1e-4, "mode 2")
  end)
end)

-- A beam clamped at 0, propped at b, free at a + b: roots k of the characteristic determinant.
local function propped(a, b)
  local function cosh(x) return (math.exp(x) + math.exp(-x)) / 2 end
  local function sinh(x) return (math.exp(x) - math.exp(-x)) / 2 end
  local cos, sin = math.cos, math.sin
  return modal.roots(function(k)
    local B, A = k * b, k * a
    local c1, c2 = sinh(B) - sin(B), cos(B) - cosh(B) -- no shift at the prop
    local slope = c1 * (sinh(B) + sin(B)) + c2 * (cosh(B) - cos(B))
    local moment = c1 * (cosh(B) + cos(B)) + c2 * (sinh(B) + sin(B))
    local end_moment = moment * (cosh(A) + cos(A)) / 2 + slope * (sinh(A) - sin(A)) / 2
    local end_shear = moment * (sinh(A) - sin(A)) / 2 + slope * (cosh(A) - cos(A)) / 2
    return end_moment * (cosh(A) + cos(A)) / 2 - end_shear * (sinh(A) + sin(A)) / 2
  end, 0.1 / a, 5 / a, 0.05 / a)
end

describe("a wire that hangs over the edge of a table", function()
  local a, E, density, radius = 0.2, 1e9, 1200, 0.002
  local unit = (E * radius ^ 2 / 4 / density) ^ 0.5 / (2 * math.pi)
  local function table_with_wire()
    local scene = sw.scene{}
    local top = scene:obstacle{ shape = "box", size = { 1, 1, 0.1 }, at = { -0.5, 0, -0.05 },
      friction = 0.3 }
    local wire = scene:wire{ E = E, density = density, radius = radius, from = { -0.6, 0, radius },
      to = { a, 0, radius }, segments = 160 }
    t.fine(scene:settle())
    return wire, scene, top
  end

  -- The overhang's weight lifts a length of sqrt(2) a behind the edge; at its end there is no moment, shift
  -- or slope.
  it("vibrates like a beam that is clamped where it lies and propped at the edge", function()
    local wire = table_with_wire()
    local f = wire:frequencies{ modes = 6, shapes = true }
    local k = propped(a, 2 ^ 0.5 * a)
    local count = 0
    for i = 1, #f do
      if modal.share_along(f.shapes[i], 3) > 0.5 then
        count = count + 1
        t.share(k[count] ^ 2 * unit, f[i], 0.01, "mode " .. count)
      end
    end
    assert.are.equal(3, count)
    -- between a cantilever as long as the overhang and one longer by the lifted part
    assert.is_true(f[1] < 3.516 / a ^ 2 * unit and f[1] > 3.516 / (2.42 * a) ^ 2 * unit)
  end)

  it("swings at that frequency when released", function()
    local wire, scene = table_with_wire()
    local f, all = wire:frequencies{ modes = 2, shapes = true }, {}
    local mode = modal.share_along(f.shapes[1], 3) > 0.5 and 1 or 2
    local weights, rest = modal.mass_times(wire, f.shapes[mode]), wire:positions()
    local push = scene:force{ kind = "point", on = wire, s = wire.length, force = { 0, 0, -2e-4 } }
    t.fine(scene:settle())
    push:release()
    local dt = 1 / (100 * f[mode])
    local run = t.fine(scene:run{ duration = 500 * dt, dt = dt, frame = dt })
    local before
    for _, frame in ipairs(run:frames()) do
      local q = 0
      for i = 1, #rest do q = q + weights[i] * (frame.wires[1][i] - rest[i]) end
      if before and before.q * q < 0 then
        all[#all + 1] = before.t + (frame.t - before.t) * before.q / (before.q - q)
      end
      before = { t = frame.t, q = q }
    end
    assert.is_true(#all > 4)
    t.share(f[mode], (#all - 1) / 2 / (all[#all] - all[1]), 0.02, "frequency")
  end)

  it("is left unchanged by wire:frequencies, contact included", function()
    local wire, scene, top = table_with_wire()
    local function look()
      local x, force = wire:positions(), top:force()
      return { x, force, scene:energy(), scene:penetration(), scene:contacts(), wire:tension(0.3) }
    end
    local before = look()
    wire:frequencies{}
    assert.are.same(before, look())
    local at = scene:snapshot()
    t.fine(scene:run{ duration = 0.1, dt = 0.01 })
    local after = look()
    scene:restore(at)
    wire:frequencies{}
    t.fine(scene:run{ duration = 0.1, dt = 0.01 })
    assert.are.same(after, look())
  end)

  it("has nearly the same frequencies after a run, with the run's contact stiffness", function()
    local wire, scene = table_with_wire()
    local before = wire:frequencies{ modes = 4 }
    scene:force{ kind = "damping", on = wire, mass = 5 }
    t.fine(scene:run{ duration = 3, dt = 0.01 })
    local after = wire:frequencies{ modes = 4 }
    for i = 1, 4 do t.share(before[i], after[i], 0.01, "mode " .. i) end
  end)
end)
