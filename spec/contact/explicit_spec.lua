-- SPDX-License-Identifier: GPL-3.0-or-later
-- Explicit integrators in contact. Friction sticks, slides and carries along as Coulomb's law says, at
-- whichever instants of a step the method evaluates it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r, G, STEEP = 0.002, 9.81, 0.2
local methods = { "symplectic-euler", "velocity-verlet", "rk4", "gsl-rkf45" }

local function lying(friction, slope)
  local scene = sw.scene{ gravity = { G * math.sin(slope), 0, -G * math.cos(slope) } }
  local board = scene:obstacle{ shape = "box", size = { 2, 1, 0.1 }, at = { 0, 0, -0.05 },
    friction = friction }
  local wire = scene:wire{ E = 2e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r },
    to = { 0.1, 0, r }, segments = 8 }
  return scene, wire, board
end

describe("friction in explicit steps", function()
  for _, method in ipairs(methods) do
    it("is mu times the normal force, by " .. method, function()
      local time = 0.3
      for share, holds in pairs{ [0.8] = true, [1.25] = false } do
        local scene, wire = lying(math.tan(STEEP) / share, STEEP)
        t.fine(scene:run{ duration = time, dt = 2e-5, integrator = method })
        local way = wire:position(0.05)[1] - 0.05
        -- explicit contact bounces on its springs without damping, so a sticking wire slips a little
        -- whenever the normal force is low; without friction it would move 88 mm
        if holds then t.near(0, way, 1e-4, "way") end
        -- sliding starts late, because nothing presses at first: 1 to 2 % of the way
        if not holds then
          t.share(0.5 * time ^ 2 * G * math.sin(STEEP) * (1 - 1 / share), way, 0.02, "way")
        end
      end
    end)

    it("carries a wire along with a belt, by " .. method, function()
      local scene, wire, board = lying(0.5, 0)
      board:follow{ points = { { 0, 0, -0.05 }, { 0.01, 0, -0.05 } }, duration = 0.2 }
      t.fine(scene:run{ duration = 0.22, dt = 2e-5, integrator = method })
      t.near(0.01, wire:position(0.05)[1] - 0.05, 1e-5, "way")
    end)
  end

  it("lifts a rod between pads with the same squeeze as implicit steps", function()
    local squeeze = {}
    for method, dt in pairs{ ["symplectic-euler"] = 1e-5, ["velocity-verlet"] = 5e-6, ["tr-bdf2"] = 2e-3 } do
      local scene = sw.scene{ gravity = { 0, 0, -G } }
      scene:obstacle{ shape = "plane", friction = 0.3 }
      scene:force{ kind = "damping", mass = 20 }
      local wire = scene:wire{ E = 2e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r },
        to = { 0.1, 0, r }, segments = 10 }
      local g = scene:gripper{ pads = { opening = 2.2 * r, friction = 0.5 } }
      scene:process(function(p)
        g:grasp(wire, { s = 0.05, approach = "plates", distance = 1.95 * r })
        p:wait(0.02)
        squeeze[method] = g:state().squeeze
        g:move{ by = { 0, 0, 0.005 }, duration = 0.05 }
        t.near(0.005 + r, wire:position(0.05)[3], 5e-5, method .. ": height")
      end)
      local run = scene:run{ dt = dt, integrator = method }
      assert(run.ok, run.reason)
    end
    for method, force in pairs(squeeze) do t.share(squeeze["tr-bdf2"], force, 1e-3, method) end
  end)
end)
