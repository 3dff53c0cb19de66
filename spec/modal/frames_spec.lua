-- SPDX-License-Identifier: GPL-3.0-or-later
-- Frequencies of wires with frames: flat, curved at rest, or with inertia against spin.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local modal = require "spec.modal.tools"

local PI = math.pi

local function straight(o, hold)
  local scene = sw.scene{ gravity = { 0, 0, o.weight and -1 or 0 } }
  local wire = scene:wire{ EA = 1e7, EI = o.EI or 1, GJ = o.GJ or 0.7, mass_per_length = o.weight or 1,
    radius = 0.01, normal = o.normal, rolls = o.rolls, spin_inertia = o.spin_inertia,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = o.segments or 50 }
  for _, s in ipairs(hold or { 0 }) do scene:clamp(wire, { s = s }) end
  t.fine(scene:settle())
  return wire, scene
end

describe("frequencies of a straight wire with frames", function()
  it("are those of a wire without frames", function()
    local plain = straight({}):frequencies{ modes = 6 }
    for _, o in ipairs{ { rolls = true }, { EI = { 1, 1 + 1e-12 }, normal = { 0, 0, 1 } } } do
      local f = straight(o):frequencies{ modes = 6 }
      assert.are.equal(0, f.unstable)
      for i = 1, 6 do t.share(plain[i], f[i], 1e-7, "mode " .. i) end
    end
  end)

  it("are those of both planes of a strip", function()
    local f = straight{ EI = { 4, 1 }, normal = { 0, 0, 1 } }:frequencies{ modes = 4 }
    local exact = { 3.516015269, 2 * 3.516015269, 22.03449156, 2 * 22.03449156 }
    for i = 1, 4 do t.share(exact[i], 2 * PI * f[i], 1e-3, "mode " .. i) end
  end)

  -- lateral buckling, as in spec/physics/frames_spec.lua
  for _, case in ipairs{ { 3, 1.053267724, 15.72915728 }, { 10, 1.24930015, 14.56721612 } } do
    it("fall to zero where a strip on edge buckles, height " .. case[1], function()
      local omega2 = {}
      for k, share in ipairs{ 0.98, 0.99 } do
        local wire = straight{ EI = { case[1] ^ 2, 1 }, GJ = case[2], normal = { 0, 0, 1 },
          weight = share * case[3] }
        omega2[k] = (2 * PI * wire:frequencies{ modes = 1 }[1]) ^ 2
      end
      t.share(1, 0.99 + 0.01 * omega2[2] / (omega2[1] - omega2[2]), 0.003, "weight at zero")
    end)
  end
end)

describe("frequencies of a wire that rolls", function()
  -- a soft GJ makes twist slower than bending
  local function torsion(o, hold)
    o.rolls, o.GJ = true, 1e-6
    local wire, scene = straight(o, hold)
    return wire:frequencies{ modes = 3 }, (1e-6 / wire.beam.spin_inertia) ^ 0.5, wire, scene
  end

  it("include its twist", function()
    local f, speed = torsion({}, { 0 })
    for i = 1, 3 do t.share((2 * i - 1) * speed / 4, f[i], 2e-3, "clamped once, mode " .. i) end
    f, speed = torsion({ spin_inertia = 1e-4 }, { 0, 1 })
    for i = 1, 3 do t.share(i * speed / 2, f[i], 5e-3, "clamped twice, mode " .. i) end
  end)

  it("are second order in the mesh", function()
    t.order_at_least(1.8, { 10, 20, 40 }, function(n)
      local f, speed = torsion({ segments = n }, { 0 })
      return math.abs(f[2] / (3 * speed / 4) - 1)
    end, "second twist")
  end)

  it("begin with the free turn where nothing holds the twist", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e7, EI = 1, GJ = 1e-6, mass_per_length = 1, radius = 0.01,
      rolls = true, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    scene:pin(wire, { s = 0 })
    scene:pin(wire, { s = 1 })
    t.fine(scene:settle())
    local f = wire:frequencies{ modes = 3 }
    t.below(1e-6, f[1], "free turn")
    local speed = (1e-6 / wire.beam.spin_inertia) ^ 0.5
    for i = 1, 2 do t.share(i * speed / 2, f[i + 1], 2e-3, "twist " .. i) end
  end)

  it("leave out the wire inside a grip", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e7, EI = 1, GJ = 1e-6, mass_per_length = 1, radius = 0.01,
      rolls = true, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    scene:grip(wire, { s = 0.1, width = 0.2 })
    t.fine(scene:settle())
    local speed = (1e-6 / wire.beam.spin_inertia) ^ 0.5
    t.share(speed / 4 / 0.8, wire:frequencies{ modes = 1 }[1], 2e-3, "twist")
  end)

  it("are refused while it spins", function()
    local _, _, wire = torsion({}, { 0 })
    wire:set_velocity({ 0, 0, 0 }, { 10, 0, 0 }, { 0, 0, 0 })
    local ok, message = pcall(wire.frequencies, wire)
    assert.is_false(ok)
    assert.truthy(message:find("moves", 1, true), message)
  end)
end)

-- A quarter of a circle that sags out of its plane: every mode bends and twists.
describe("frequencies of a curved wire", function()
  local function arc(rolls)
    local scene, path = sw.scene{ gravity = { 0, 0, -1 } }, {}
    for i = 0, 400 do
      local u = PI / 2 * i / 400
      path[i + 1] = { 2 / PI * math.sin(u), 2 / PI * (1 - math.cos(u)), 0 }
    end
    local wire = scene:wire{ EA = 1e5, EI = 1, GJ = 0.7, mass_per_length = 5, radius = 0.05,
      path = path, segments = 24, rest = "path", rolls = rolls }
    scene:clamp(wire, { s = 0, direction = { 1, 0, 0 } })
    t.fine(scene:settle())
    return wire, scene
  end

  for _, rolls in ipairs{ false, true } do
    it("are those measured in a run" .. (rolls and ", with inertia against spin" or ""), function()
      local wire, scene = arc(rolls)
      local f = wire:frequencies{ modes = 3, shapes = true }
      assert.are.equal(0, f.unstable)
      local rest, dt = wire:positions(), 1 / (120 * f[3])
      wire:set_velocity({ 0, 0, 0 }, { 1e-3, 2e-3, 2e-3 }, { 0, 0, 0 })
      local frames = t.fine(scene:run{ duration = 1500 * dt, dt = dt, frame = dt,
        integrator = "implicit-midpoint" }):frames()
      for mode = 1, 3 do
        local measured = modal.swings(wire, f.shapes[mode], rest, frames)
        t.share(f[mode], measured, 3e-3, "mode " .. mode)
      end
    end)
  end

  it("have shapes that are orthogonal", function()
    local wire = arc(false)
    local f = wire:frequencies{ modes = 4, shapes = true }
    for i = 1, 4 do
      local image = modal.mass_times(wire, f.shapes[i])
      for j = 1, 4 do t.near(i == j and 1 or 0, modal.dot(image, f.shapes[j]), 1e-8, "product") end
    end
  end)
end)
