-- SPDX-License-Identifier: GPL-3.0-or-later
-- Natural frequencies of straight wires against beam and string theory.
package.path = "./?.lua;" .. package.path
local t = require "spec.physics.tools"
local modal = require "spec.modal.tools"

-- omega sqrt(m L^4 / EI) of Euler-Bernoulli beams without rotary inertia. Independent solution:
-- characteristic equations and Legendre-Galerkin, relative error 1e-9. load: m g L^3 / EI of a wire that
-- hangs from its clamp (negative: stands on it), or pull L^2 / EI.
local fine = { 100, 200, 400, 800 } -- the error changes its sign on coarser meshes
local beams = {
  { "clamped at one end", holds = "clamp", share = { 0.001, 0.005, 0.01 },
    3.516015269, 22.03449156, 61.69721441 },
  { "clamped at both ends", holds = "clamps", share = { 0.005, 0.01, 0.02 },
    22.37328545, 61.67282287, 120.9033917 },
  { "hanging, load 1", holds = "clamp", weight = 1, meshes = { 10, 50, 100, 200 },
    share = { 0.001, 0.005, 0.01 }, 3.732625699, 22.22979694, 61.89903885 },
  { "hanging, load 100", holds = "clamp", weight = 100, meshes = fine, share = { 0.001, 0.005, 0.01 },
    12.86874191, 36.50916711, 78.98032862 },
  { "standing, load 4", holds = "clamp", weight = -4, share = { 0.001, 0.005, 0.01 },
    2.462967202, 21.23432813, 60.88200906 },
  { "pulled, load 100", holds = "clamps", pull = 100, meshes = fine,
    share = { 0.005, 0.01, 0.02 }, 40.993161, 91.2643111, 156.3954927 },
  { "pulled, load 1000", holds = "clamps", pull = 1000, meshes = { 400, 800, 1600 },
    share = { 0.005, 0.01, 0.02 }, 106.5808807, 216.2878233, 332.0611423 },
}

local function of(case, segments)
  local EI, mass = 0.01, 0.03
  local weight = case.weight or 0
  local wire, _, unit = modal.wire(case.holds, { segments = segments, along = { 0, 0, -1 },
    gravity = { 0, 0, -weight * EI / mass }, EA = 1e9 * EI,
    pull = case.pull and case.pull * EI })
  return modal.pairs(wire, 3, unit)
end

describe("frequencies of a straight wire", function()
  for _, case in ipairs(beams) do
    it("are a beam's: " .. case[1], function()
      local f = of(case, 50)
      for i = 1, 3 do t.share(case[i + 1], f[i], case.share[i], "mode " .. i) end
    end)

    it("converge with second order: " .. case[1], function()
      local errors, meshes = {}, case.meshes or { 10, 20, 40, 80 }
      for _, n in ipairs(meshes) do
        local f = of(case, n)
        errors[n] = {}
        for i = 1, 3 do errors[n][i] = math.abs(f[i] / case[i + 1] - 1) end
      end
      for i = 1, 3 do
        t.order_at_least(1.8, meshes, function(n) return errors[n][i] end, "mode " .. i)
      end
    end)
  end

  it("are n^2 pi^2 between pins", function()
    local wire, _, unit = modal.wire "pins"
    local f = modal.pairs(wire, 3, unit)
    for i = 1, 3 do t.share((i * math.pi) ^ 2, f[i], 1e-4, "mode " .. i) end
  end)

  -- A free beam has the frequencies of a beam clamped at both ends, after five zeros: two translations
  -- across, one along, and two turns.
  it("begin with five zeros when the wire is free", function()
    local wire, _, unit = modal.wire ""
    local f = wire:frequencies{ modes = 9 }
    for i = 1, 5 do assert.are.equal(0, f[i]) end
    t.share(22.37328545, f[6] / unit, 1e-4, "first")
    t.share(f[6], f[7], 1e-9, "the other plane's")
    t.share(61.67282287, f[8] / unit, 1e-3, "second")
    assert.are.equal(0, f.unstable)
  end)

  it("do not depend on the wire's direction", function()
    local random = t.random(4)
    local first = modal.wire("clamps"):frequencies{ modes = 8 }
    for _ = 1, 5 do
      local a = { random(), random(), random() }
      local n = t.norm(a)
      local f = modal.wire("clamps", { along = { a[1] / n, a[2] / n, a[3] / n } })
        :frequencies{ modes = 8 }
      for i = 1, 8 do t.share(first[i], f[i], 1e-7, "mode " .. i) end
    end
  end)

  it("include stretching", function()
    local EA, L, mass = 50, 1, 0.03
    local wire = modal.wire("clamps", { EA = EA, EI = 1e3, segments = 100 })
    local f = wire:frequencies{ modes = 2 }
    for i = 1, 2 do t.share(i / (2 * L) * (EA / mass) ^ 0.5, f[i], 5e-4, "mode " .. i) end
  end)
end)

describe("frequencies of the string model", function()
  it("are those of a string", function()
    local wire = modal.wire("pins", { model = "string", EI = 0, EA = 1e6, pull = 10, segments = 100 })
    local f = modal.pairs(wire, 3, 0.5 * (10 / 0.03) ^ 0.5)
    for i = 1, 3 do t.share(i, f[i], 1e-3, "mode " .. i) end
  end)

  -- Zeros of the Bessel function J0, divided by 2.
  it("are those of a hanging chain", function()
    local wire = modal.wire("pin", { model = "string", EI = 0, EA = 1e6, along = { 0, 0, -1 },
      gravity = { 0, 0, -9.81 }, segments = 200 })
    local f = modal.pairs(wire, 3, 9.81 ^ 0.5 / (2 * math.pi))
    for i, zero in ipairs{ 2.404825558, 5.520078110, 8.653727913 } do
      t.share(zero / 2, f[i], 1e-3, "mode " .. i)
    end
  end)

  it("are those of the rod while the wire is straight", function()
    local rod = modal.wire("clamps", { pull = 0.5 }):frequencies()
    local string = modal.wire("clamps", { pull = 0.5, model = "string" }):frequencies()
    for i = 1, 6 do t.share(rod[i], string[i], 1e-4, "mode " .. i) end
  end)
end)

describe("shapes", function()
  it("are orthogonal in the mass matrix, with modal mass 1", function()
    local wire = modal.wire("clamp", { along = { 0.6, 0, 0.8 }, gravity = { 0, 0, -5 } })
    local shapes = wire:frequencies{ modes = 12, shapes = true }.shapes
    assert.are.equal(12, #shapes)
    for i = 1, 12 do
      assert.are.equal(3 * (wire.segments + 1), #shapes[i])
      local image = modal.mass_times(wire, shapes[i])
      for j = 1, 12 do t.near(i == j and 1 or 0, modal.dot(image, shapes[j]), 1e-9, "product") end
    end
  end)

  -- K x of all forces together equals omega^2 M x at every free node.
  it("balance stiffness and inertia", function()
    local wire, scene = modal.wire("clamp", { along = { 0.6, 0, 0.8 }, gravity = { 0, 0, -5 } })
    local f = wire:frequencies{ modes = 4, shapes = true }
    for i = 1, 4 do
      local inertia, sum, largest = modal.mass_times(wire, f.shapes[i]), {}, 0
      for _, force in pairs(scene:evaluate(wire, { direction = f.shapes[i] })) do
        for k, value in ipairs(force.product) do sum[k] = (sum[k] or 0) + value end
      end
      local omega2 = (2 * math.pi * f[i]) ^ 2
      for k = 4, #sum do
        largest = math.max(largest, math.abs(inertia[k]))
      end
      for k = 4, #sum do t.near(inertia[k], sum[k] / omega2, 1e-3 * largest, "node " .. k) end
    end
  end)

  it("of a clamped wire are those of a beam", function()
    local wire = modal.wire "clamp"
    local shape = wire:frequencies{ modes = 1, shapes = true }.shapes[1]
    local b, c = 1.875104069, 0.7340955 -- from cosh b cos b = -1
    local tip = (shape[#shape] ^ 2 + shape[#shape - 1] ^ 2) ^ 0.5
    for i = 0, 50 do
      local x = b * i / 50
      local u = math.cos(x) - (math.exp(x) + math.exp(-x)) / 2
        - c * (math.sin(x) - (math.exp(x) - math.exp(-x)) / 2)
      local here = (shape[3 * i + 2] ^ 2 + shape[3 * i + 3] ^ 2) ^ 0.5
      t.near(-u / 2, here / tip, 1e-3, "at " .. i)
    end
  end)
end)
