-- SPDX-License-Identifier: GPL-3.0-or-later
-- Hoses with thin walls as rings of springs, given as the manual says (wire_mesh): EA, EI and GJ of the wall.
-- Their ring lies far out: a ring of particles that has both EA and EI has the radius sqrt(2 EI / EA) and a
-- little more, which is 0.98 of the outer radius for a wall of a tenth of it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local r, L, E, nu, density = 0.005, 0.1, 5e6, 0.45, 1150

local function hose(scene, args, bore)
  local A, I = math.pi * (r ^ 2 - bore ^ 2), math.pi * (r ^ 4 - bore ^ 4) / 4
  args.EA, args.EI, args.GJ = E * A, E * I, E * I / (1 + nu)
  args.mass_per_length, args.radius = density * A, r
  args.from, args.to = { 0, 0, args.height or 0 }, { L, 0, args.height or 0 }
  args.height = nil
  return scene:wire(args)
end

describe("a hose with a thin wall", function()
  for _, case in ipairs{ { 0.75, 8 }, { 0.8, 8 }, { 0.85, 8 }, { 0.9, 12 } } do
    local bore, particles = case[1] * r, case[2]
    local function mesh() return { model = "tube", core = false, particles = particles } end

    local name = (": bore %g of it, %d particles"):format(case[1], particles)
    it("hangs, stretches and twists as the rod" .. name, function()
      local function held(args)
        local scene = sw.scene{}
        local wire = hose(scene, args, bore)
        scene:clamp(wire, { s = 0 })
        assert(scene:settle().ok)
        local fall = wire:position(L)[3]
        scene = sw.scene{ gravity = { 0, 0, 0 } }
        wire = hose(scene, args, bore)
        scene:clamp(wire, { s = 0 })
        local clamp = scene:clamp(wire, { s = L })
        clamp:pose({ 1.001 * L, 0, 0 }, { axis = { 1, 0, 0 }, angle = 0.02 })
        assert(scene:settle().ok)
        return fall, clamp:force()[1], clamp:moment()[1]
      end
      local fall, pull, twist = held{ segments = 100 }
      local fell, pulled, twisted = held(mesh())
      print(("measured: %.4f %.4f %.4f of the rod"):format(fell / fall, pulled / pull, twisted / twist))
      assert.is_near(fall, fell, 0.03 * math.abs(fall)) -- shear of a thin tube (Timoshenko): 2.6 %
      assert.is_near(pull, pulled, 0.02 * pull) -- held sections cannot contract: 1 %
      assert.is_near(twist, twisted, 0.01 * twist)
    end)

    it("lies on a table at its radius" .. name, function()
      local scene = sw.scene{}
      local floor = scene:obstacle{ shape = "plane", friction = 0.3 }
      local args = mesh()
      args.height = 1.02 * r
      local wire = hose(scene, args, bore)
      scene:force{ kind = "damping", on = wire, mass = 20 }
      assert(scene:run{ duration = 0.4, dt = 0.01, frames = false }.ok)
      local weight = wire.beam.mass_per_length * L * 9.81
      local height, load = wire:position(L / 2)[3] / r, math.abs(floor:force()[3]) / weight
      print(("measured: at %.3f radii, %.4f weights"):format(height, load))
      assert.is_near(1, height, 0.08) -- over a flat side of 8 particles: 0.924
      assert.is_near(1, load, 0.01)
    end)
  end
end)
