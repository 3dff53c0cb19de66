-- SPDX-License-Identifier: GPL-3.0-or-later
-- The axial force of a wire that spins freely. Methods with implicit stages find a multiple of it in a
-- stage; the force that is read must be the true one. All steps have one size and are taken whole.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L, W, N = 0.5, 10, 20

local function spinning(damping)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = "GXL 1.5", from = { -L / 2, 0, 0 }, to = { L / 2, 0, 0 }, segments = N }
  if damping then scene:force{ kind = "damping", on = wire, stiffness = damping } end
  wire:set_velocity({ 0, 0, 0 }, { 0, 0, W })
  return scene, wire
end

-- rho A w^2 (L^2/4 - s^2)/2, s from the middle, at the wire's present speed. Between the middles of edges
-- the force is read on a chord, and an edge's own force is the mean over it.
local function exact(wire, s)
  local v = t.norm(wire:velocity(0))
  local r = s - L / 2
  return wire.beam.mass_per_length * (v / (L / 2)) ^ 2 * (L ^ 2 / 4 - r ^ 2) / 2
end

describe("the axial force of a wire that spins free", function()
  for _, damping in ipairs{ false, 1e-3 } do
    for _, case in ipairs{
      { "tr-bdf2", from = 1, off = 0.2 }, { "sdirk2", from = 1, off = 0.06 },
      { "implicit-euler", from = 2, off = 0.06 }, { "bdf2", from = 6, off = 0.02 },
    } do
      local method = case[1]
      for _, dt in ipairs{ 8e-3, 4e-3, 2e-3 } do
        local name = ("is that of turning with %s, steps of %g s%s"):format(method, dt,
          damping and ", damped" or "")
        it(name, function()
          local scene, wire = spinning(damping)
          for k = 1, 14 do
            t.fine(scene:run{ duration = dt, dt = dt, integrator = method, window = 0, parts = false })
            local late = method == "implicit-euler" and 0.08 or 0.01
            local off = k < case.from and math.huge or k < 10 and case.off or late
            for _, s in ipairs{ 0.25, 0.1 } do
              t.share(exact(wire, s), wire:tension(s), off, ("step %d, at %g m"):format(k, s))
            end
          end
          t.share(exact(wire, 0.25), (wire:max_tension()), 0.08, "largest")
        end)
      end
    end
  end

  -- These methods keep the wave of the wire's sudden stretching, of 0.4 ms: only the mean is that of
  -- turning.
  for _, method in ipairs{ "implicit-midpoint", "symplectic-euler", "velocity-verlet", "rk4", "gsl-rkf45" } do
    it("is that of turning on average with " .. method, function()
      local scene, wire = spinning()
      t.fine(scene:run{ duration = 0.012, dt = 0.4 * scene:stable_dt(), integrator = method, window = 0.01 })
      t.share(exact(wire, 0.25), (wire:max_tension()), 0.02, "largest")
    end)
  end

  -- A wire that hangs still has the tension of its weight from the first step on.
  for _, method in ipairs{ "tr-bdf2", "sdirk2", "bdf2", "implicit-euler" } do
    it("is that of the weight where nothing turns, with " .. method, function()
      local scene = sw.scene{}
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0, 0, -L }, segments = N }
      scene:clamp(wire, { s = 0 })
      assert.is_true(scene:settle().ok)
      local weight = 9.81 * wire.beam.mass_per_length
      for k = 1, 4 do
        t.fine(scene:run{ duration = 5e-3, dt = 5e-3, integrator = method, window = 0 })
        t.share(weight * (L - 0.2), wire:tension(0.2), 1e-3, ("step %d"):format(k))
      end
    end)
  end

  it("goes on with the same bits from a snapshot", function()
    local scene, wire = spinning()
    t.fine(scene:run{ duration = 12e-3, dt = 4e-3, integrator = "sdirk2" })
    local kept, T = scene:snapshot(), wire:tension(0.25)
    t.fine(scene:run{ duration = 8e-3, dt = 4e-3, integrator = "sdirk2" })
    local later = wire:tension(0.25)
    scene:restore(kept)
    assert.are.equal(T, wire:tension(0.25))
    t.fine(scene:run{ duration = 8e-3, dt = 4e-3, integrator = "sdirk2" })
    assert.are.equal(later, wire:tension(0.25))
  end)
end)
