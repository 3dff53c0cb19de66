-- SPDX-License-Identifier: GPL-3.0-or-later
--- A weightless wire clamped level, a dead force down at its end, static.
-- Options: load = P L^2/EI (1), axial (EA L^2/EI, default 1e8).
-- error(): distance of the tip from the exact tip over L.
-- @module softworld.cases.end_load
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

-- Elliptic integrals (Bisshopp and Drucker 1945), error 1e-15: P L^2/EI, tip x/L,
-- tip z/L, tip angle [deg], clamp moment M0 L/EI.
local exact = {
  { 0.5, 0.9840810375, -0.1621435757, -14.01074593, 0.4920405188 },
  { 1, 0.9435667637, -0.3017207738, -26.43351959, 0.9435667637 },
  { 2, 0.8393582792, -0.4934574804, -44.79096598, 1.678716558 },
  { 4, 0.6710587578, -0.6699641813, -64.24228244, 2.684235031 },
  { 6, 0.5654111713, -0.7445711489, -73.55043665, 3.392467028 },
  { 10, 0.4450044022, -0.8106090249, -81.94932487, 4.450044022 },
}

return function(options)
  local f = frame.new(options)
  local load = options.load or 1
  local row = wires.row(exact, load)
  local p = wires.parameters{ gamma = 10, g = 9.81, segments = options.segments,
    model = options.model, axial = options.axial or 1e8 }
  local scene = sw.scene{ name = "end load", gravity = { 0, 0, 0 } }
  local wire = wires.straight(scene, f, p, { 0, 0, 0 }, { 1, 0, 0 })
  local clamp = scene:clamp(wire, { s = 0 })
  local P = load * p.EI
  scene:force{ kind = "point", on = wire, s = wire.length, force = f.vector(0, 0, -P) }
  local c = { name = "end load", scene = scene, wire = wire, clamp = clamp, frame = f,
    parameters = p, all = exact,
    exact = row and { x = row[2], z = row[3], angle = math.rad(row[4]), M0 = row[5] * p.EI, P = P,
      source = "elliptic integrals, Bisshopp and Drucker 1945" } }

  function c.run(o) return scene:settle(o or {}) end

  function c.measured()
    local tip = f.local_point(wire:position(wire.length))
    local t = f.local_vector(wire:tangent(wire.length))
    local F, M = f.local_vector(clamp:force()), f.local_vector(clamp:moment())
    return { x = tip[1], y = tip[2], z = tip[3], angle = math.atan(t[3], t[1]), force = F,
      moment = M, M0 = -M[2] }
  end

  function c.error()
    local m = c.measured()
    return ((m.x - row[2]) ^ 2 + m.y ^ 2 + (m.z - row[3]) ^ 2) ^ 0.5
  end
  return c
end
