-- SPDX-License-Identifier: GPL-3.0-or-later
-- Strain and stress of the outermost fibres.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A wire of 1 m along x without weight, clamped at its start.
local function cantilever(o)
  local scene = sw.scene{ gravity = o.gravity or { 0, 0, 0 } }
  local args = { from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = o.segments or 50, model = o.model }
  for k, v in pairs(o.section) do args[k] = v end
  local wire = scene:wire(args)
  scene:clamp(wire, { s = 0 })
  return wire, scene
end

local solid = { E = 2e9, density = 1150, radius = 1e-3 }

describe("strain and stress", function()
  it("of a pulled wire are force over stiffness and over area", function()
    for _, model in ipairs{ "rod", "string" } do
      local wire, scene = cantilever{ section = solid, model = model }
      scene:force{ kind = "point", on = wire, s = 1, force = { 5, 0, 0 } }
      t.fine(scene:settle())
      local area = math.pi * 1e-6
      for _, s in ipairs{ 0.1, 0.333, 1 } do
        local strain, least = wire:strain(s)
        t.share(5 / (2e9 * area), strain, 1e-6, "strain")
        t.share(5 / (2e9 * area), least, 1e-6, "strain on the other side")
        t.share(5 / area, (wire:stress(s)), 1e-6, "stress")
      end
      t.share(5 / area, (wire:max_stress()), 1e-6, "largest stress")
      scene:force{ kind = "point", on = wire, s = 1, force = { -5.001, 0, 0 } }
      if model == "string" then
        t.fine(scene:settle())
        t.share(-0.001 / area, (wire:stress(0.5)), 1e-4, "stress of a pressed wire")
      end
    end
  end)

  -- Small load across: moment P (L - s), so the strain is r P (L - s) / EI outside and its negative inside.
  it("of a bent wire are curvature times radius", function()
    local wire, scene = cantilever{ section = solid }
    local EI, load = wire.beam.EI, 2e-4
    scene:force{ kind = "point", on = wire, s = 1, force = { 0, 0, -load } }
    t.fine(scene:settle())
    for _, s in ipairs{ 0, 0.2, 0.5 } do
      local strain, least = wire:strain(s)
      t.share(load * (1 - s) / EI * 1e-3, strain, 2e-3, "outside")
      t.share(-load * (1 - s) / EI * 1e-3, least, 2e-3, "inside")
      local stress, inside = wire:stress(s)
      t.share(2e9 * strain, stress, 1e-12, "stress outside")
      t.share(2e9 * least, inside, 1e-12, "stress inside")
    end
    local largest, s = wire:max_strain()
    t.share(load / EI * 1e-3, largest, 2e-3, "largest")
    assert.are.equal(0, s)
    t.share(2e9 * largest, (wire:max_stress()), 1e-12, "largest stress")
  end)

  it("at a clamp are those of a beam, even with few segments", function()
    for _, n in ipairs{ 5, 10, 20, 40 } do
      local wire, scene = cantilever{ section = solid, segments = n, gravity = { 0, 0, -0.01 } }
      t.fine(scene:settle())
      local w = 1150 * math.pi * 1e-6 * 0.01
      t.share(w / 2 / wire.beam.EI * 1e-3, (wire:max_strain()), 1e-4, "strain at the clamp")
    end
  end)

  it("of a section given by its stiffness use EA over the area", function()
    local wire, scene = cantilever{ section = { EA = 500, EI = 1e-4, mass_per_length = 0.02,
      radius = 0.002 } }
    scene:force{ kind = "point", on = wire, s = 1, force = { 1, 0, 0 } }
    t.fine(scene:settle())
    t.share(1 / 500, (wire:strain(0.5)), 1e-6, "strain")
    t.share(1 / (math.pi * 0.002 ^ 2), (wire:stress(0.5)), 1e-6, "stress")
    local both, other = cantilever{ section = { E = 1e8, EA = 500, EI = 1e-4, mass_per_length = 0.02,
      radius = 0.002 } }
    other:force{ kind = "point", on = both, s = 1, force = { 1, 0, 0 } }
    t.fine(other:settle())
    t.share(1e8, both:stress(0.5) / both:strain(0.5), 1e-12, "E that is given counts")
  end)

  it("report their largest value, with place and time, over the run", function()
    local wire, scene = cantilever{ section = solid, gravity = { 0, 0, -9.81 } }
    t.fine(scene:run{ duration = 0.6, dt = 0.005 })
    local value, s, time = wire:max_strain()
    local now = wire:max_strain{ now = true }
    local sampled = 0
    for i = 0, 50 do sampled = math.max(sampled, (wire:strain(i / 50))) end
    t.share(sampled, now, 1e-3, "now")
    assert.is_true(value > now and time > 0 and time < 0.6 and s >= 0 and s <= 1)
    local before = scene:snapshot()
    local stress = { wire:max_stress() }
    t.share(2e9 * value, stress[1], 1e-12, "stress")
    t.fine(scene:run{ duration = 0.1, dt = 0.005 })
    scene:restore(before)
    assert.are.same(stress, { wire:max_stress() })
    t.fine(scene:settle()) -- the largest values start again
    assert.is_true(wire:max_strain() < value)
    assert.are.equal(wire:max_strain{ now = true }, (wire:max_strain()))
  end)

  it("refuse places off the wire and wrong arguments", function()
    local wire = cantilever{ section = solid }
    assert.is_false(pcall(wire.strain, wire, 1.5))
    assert.is_false(pcall(wire.strain, wire))
    assert.is_false(pcall(wire.stress, wire, "0"))
    assert.is_false(pcall(wire.max_stress, wire, { when = true }))
  end)
end)
