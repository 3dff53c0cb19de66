-- SPDX-License-Identifier: GPL-3.0-or-later
--- A weightless column whose ends are pushed together by d L: post-buckled elastica,
-- started from a bow of the right length.
-- Options: ends = "pinned" | "clamped", d (0.2; 0.01, 0.05, 0.2 have exact values),
-- axial (EA L^2/EI, 1e8), points of the path (segments).
-- error(): relative error of the end force.
-- @module softworld.cases.column
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

-- Elliptic integrals, error 1e-12: d, P L^2/EI, deflection at midspan/L, largest
-- moment L/EI.
local exact = {
  pinned = {
    { 0.001, 9.874541981, 0.02012539271, 0.1987290352 },
    { 0.01, 9.919231635, 0.06346272176, 0.6295014373 },
    { 0.05, 10.12349265, 0.140110606, 1.41840869 },
    { 0.2, 10.98229097, 0.266318588, 2.924788223 },
  },
  clamped = {
    { 0.001, 39.49816792, 0.02012539271, 0.3974580703 },
    { 0.01, 39.67692654, 0.06346272176, 1.259002875 },
    { 0.05, 40.4939706, 0.140110606, 2.83681738 },
    { 0.2, 43.92916387, 0.266318588, 5.849576447 },
  },
}

return function(options)
  local f = frame.new(options)
  local kind, d = options.ends or "pinned", options.d or 0.2
  local row
  for _, r in ipairs(exact[kind]) do if r[1] == d then row = r end end
  local p = wires.parameters{ gamma = 10, g = 9.81, segments = options.segments,
    model = options.model, axial = options.axial or 1e8 }
  local scene = sw.scene{ name = "column", gravity = { 0, 0, 0 } }
  p.path = wires.arch(f, options.points or p.segments, 1 - d, function(u)
    return kind == "pinned" and math.cos(math.pi * u) or math.sin(2 * math.pi * u)
  end)
  local wire = scene:wire(p)
  local axis = kind == "clamped" and f.vector(1, 0, 0) or nil
  local make = kind == "pinned" and scene.pin or scene.clamp
  local left, right = make(scene, wire, { s = 0, direction = axis }),
    make(scene, wire, { s = wire.length, direction = axis })
  local c = { name = "column", scene = scene, wire = wire, clamp = left, right = right, frame = f,
    parameters = p, EI = p.EI, exact = row and { P = row[2] * p.EI, w = row[3], M = row[4] * p.EI,
      source = "elliptic integrals" } }

  function c.run(o) return scene:settle(o or {}) end

  function c.measured()
    local F, M = f.local_vector(right:force()), f.local_vector(right:moment())
    return { P = -F[1], w = f.local_point(wire:position(wire.length / 2))[3], side = F[3], M = M[2] }
  end

  function c.error() return math.abs(c.measured().P / c.exact.P - 1) end
  return c
end
