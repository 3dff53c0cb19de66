-- SPDX-License-Identifier: GPL-3.0-or-later
--- A wire clamped level at one end droops under its own weight, static.
-- Options: gamma (10), axial (EA L^2/EI; default that of the round section), radius (0.0025 m),
-- section (of meshes).
-- error(): distance of the tip from the exact tip over L.
-- @module softworld.cases.droop
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

-- Inextensible elastica integrated from the free end by shooting (Dormand-Prince of
-- order 8, relative tolerance 1e-13), error 1e-9: gamma, tip x/L, tip z/L, clamp
-- moment M0 L/EI.
local exact = {
  { 0.1, 0.9999107322, -0.01249843785, 0.0499968756 },
  { 0.215443469, 0.9995859585, -0.02691482476, 0.1076905123 },
  { 0.4641588834, 0.9980846804, -0.05786435613, 0.2317682244 },
  { 1, 0.9912463953, -0.123471402, 0.4969333999 },
  { 2.15443469, 0.9620176276, -0.2551173797, 1.048459568 },
  { 4.641588834, 0.8622773968, -0.4721301176, 2.093529977 },
  { 10, 0.6563537612, -0.7001997155, 3.742191111 },
  { 21.5443469, 0.4248491808, -0.8392427509, 6.013474363 },
  { 46.41588834, 0.2571644941, -0.9037640892, 9.159586568 },
  { 100, 0.1592233826, -0.9375239354, 13.69323874 },
  { 215.443469, 0.1031437554, -0.9584206348, 20.32168626 },
  { 464.1588834, 0.06850838123, -0.9720689649, 30.03978846 },
  { 1000, 0.04598645476, -0.9811412693, 44.29765839 },
}

return function(options)
  local f = frame.new(options)
  local gamma = options.gamma or 10
  local row = wires.row(exact, gamma)
  local p = wires.parameters{ gamma = gamma, g = f.g, segments = options.segments,
    model = options.model, axial = options.axial, radius = options.radius, section = options.section }
  local scene = sw.scene{ name = "droop", gravity = f.gravity }
  local wire = wires.straight(scene, f, p, { 0, 0, 0 }, { 1, 0, 0 })
  local clamp = scene:clamp(wire, { s = 0 })
  local c = { name = "droop", scene = scene, wire = wire, clamp = clamp, frame = f,
    parameters = p, all = exact,
    exact = row and { x = row[2], z = row[3], M0 = row[4] * p.EI, weight = p.mass_per_length * f.g,
      source = "shooting solution of the inextensible elastica, error 1e-9" } }

  function c.run(o) return scene:settle(o or {}) end

  function c.measured()
    local tip = f.local_point(wire:position(wire.length))
    local F, M = f.local_vector(clamp:force()), f.local_vector(clamp:moment())
    return { x = tip[1], y = tip[2], z = tip[3], force = F, moment = M, M0 = -M[2] }
  end

  function c.error()
    local m = c.measured()
    return ((m.x - row[2]) ^ 2 + m.y ^ 2 + (m.z - row[3]) ^ 2) ^ 0.5
  end
  return c
end
