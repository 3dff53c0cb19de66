-- SPDX-License-Identifier: GPL-3.0-or-later
-- The generalized-alpha method with forces that depend on velocities, with moving holds and at rest. The
-- contract measures its order and how it damps what is too fast.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local METHOD = "generalized-alpha"

describe("generalized-alpha", function()
  -- Mass and velocity have separate factors; a wrong one shows with damping. A string is moved by its end,
  -- with all kinds of damping; the goal is tr-bdf2 at a sixteenth of the finer step.
  it("is of second order with damping and a hold that moves", function()
    local function tip(method, dt)
      local scene = sw.scene{}
      local wire = scene:wire{ EA = 40, EI = 0.02, GJ = 0.02, mass_per_length = 0.1, radius = 0.005,
        segments = 5, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
      scene:clamp(wire, { s = 0 }):follow{ func = function(time)
        return { 0.05 * (1 - math.cos(6 * time)), 0, 0.03 * (1 - math.cos(9 * time)) }
      end, duration = 0.4, step = 1e-4 }
      scene:force{ kind = "damping", mass = 1, stiffness = 2e-3 }
      scene:force{ kind = "drag", quadratic = 0.05 }
      t.fine(scene:run{ duration = 0.4, dt = dt, integrator = method })
      return wire:position(1)
    end
    local goal = tip("tr-bdf2", 0.4 / 12800)
    local one, two = t.distance(goal, tip(METHOD, 0.4 / 400)), t.distance(goal, tip(METHOD, 0.4 / 800))
    t.near(2, math.log(one / two, 2), 0.15, "order")
  end)

  -- Any method of second order solves a free fall exactly, and weight at rest.
  it("falls and hangs exactly", function()
    local scene = sw.scene{}
    local wire = scene:wire{ E = 5e7, density = 1500, radius = 0.0025, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    t.fine(scene:run{ duration = 0.3, dt = 0.01, integrator = METHOD })
    t.near(-0.5 * 9.81 * 0.09, wire:position(0.5)[3], 1e-12, "fallen")
    scene = sw.scene{}
    wire = scene:wire{ E = 5e7, density = 1500, radius = 0.0025, from = { 0, 0, 0 }, to = { 0, 0, -1 } }
    local pin = scene:pin(wire, { s = 0 })
    t.fine(scene:settle())
    local weight = pin:force()[3]
    t.fine(scene:run{ duration = 0.3, dt = 0.01, integrator = METHOD })
    t.share(weight, pin:force()[3], 1e-6, "weight on the pin")
  end)

  -- 1 s of a released cantilever in steps of 2 ms. Motion that is too fast loses a fifth in each step, with
  -- tr-bdf2 all of it.
  it("changes the energy of a swinging wire by less than tr-bdf2", function()
    local function change(method)
      local scene = sw.scene{}
      local wire = scene:wire{ EA = 60, EI = 0.02, GJ = 0.02, mass_per_length = 0.1, radius = 0.005,
        segments = 10, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
      scene:clamp(wire, { s = 0 })
      local before = scene:energy().total
      t.fine(scene:run{ duration = 1, dt = 2e-3, integrator = method })
      return (scene:energy().total - before) / (0.1 * 9.81 / 2)
    end
    local own, other = change(METHOD), change("tr-bdf2")
    t.below(math.abs(other), math.abs(own), "change of energy; tr-bdf2 is the limit")
  end)
end)
