-- SPDX-License-Identifier: GPL-3.0-or-later
--- A straight cantilever of rubber cord with a small axial and transverse shake, in which
-- explicit methods lose stability.
-- Options: segments (25, 50 or 100 have exact limits), shake [m/s] (1e-3).
-- exact.leapfrog, exact.rk4: largest stable step of the undamped lumped-mass wire [s].
-- @module softworld.cases.cord
local sw = require "softworld"
local frame = require "softworld.cases.frame"

-- Eigenvalues of the lumped chain with the clamp's half hinge: N, leapfrog [s], RK4 [s].
-- The axial wave sets the limit: 2/omega_max, omega_max = (2 c/h) cos(pi/(4N)) or similar.
local exact = {
  { 25, 0.000490139803, 0.0006931623262 },
  { 50, 0.0002449791968, 0.0003464528873 },
  { 100, 0.0001224782647, 0.0001732104153 },
}

return function(options)
  local f = frame.new(options)
  local n = options.segments or 50
  local scene = sw.scene{ name = "cord", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ E = 1e7, density = 1500, radius = 0.0025, segments = n,
    from = f.point(0, 0, 0), to = f.point(1, 0, 0), model = options.model }
  local clamp = scene:clamp(wire, { s = 0 })
  local c = { name = "cord", scene = scene, wire = wire, clamp = clamp, frame = f }
  for _, row in ipairs(exact) do
    if row[1] == n then
      c.exact = { leapfrog = row[2], rk4 = row[3], source = "eigenvalues of the lumped chain" }
    end
  end
  local shake = options.shake or 1e-3
  wire:set_velocity(f.vector(shake, 0, shake))
  c.energy0 = scene:energy().total

  function c.run(o) return scene:run(o or { duration = 0.5 }) end

  --- Returns the energy over the energy at the start.
  function c.growth() return scene:energy().total / c.energy0 end
  return c
end
