-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shared by the specs of vibrations: wires, reference numbers, products with the mass.
local sw = require "softworld"
local t = require "spec.physics.tools"

local modal = {}

--- A wire of 1 m, 0.03 kg, EI = 0.01 N m2 from the origin along `along`. holds: any of "clamp",
--- "clamps", "pin", "pins", "" (free). Options: gravity, EA, model, EI, segments, along, pull.
-- Returns the wire, its scene and the unit of omega sqrt(m L^4 / EI) in Hz.
function modal.wire(holds, o)
  o = o or {}
  local along = o.along or { 1, 0, 0 }
  local EI, mass = o.EI or 0.01, 0.03
  local scene = sw.scene{ gravity = o.gravity or { 0, 0, 0 } }
  local wire = scene:wire{ EA = o.EA or 1e7 * 0.01, EI = EI, mass_per_length = mass, radius = 0.002,
    from = { 0, 0, 0 }, to = along, segments = o.segments or 50, model = o.model }
  local hold = holds:find "clamp" and scene.clamp or scene.pin
  local last
  if holds ~= "" then hold(scene, wire, { s = 0 }) end
  if holds:find "s$" then last = hold(scene, wire, { s = wire.length }) end
  if o.pull then
    local far = 1 + o.pull / wire.beam.EA
    last:pose{ far * along[1], far * along[2], far * along[3] }
  end
  t.fine(scene:settle())
  return wire, scene, (EI / mass) ^ 0.5 / (2 * math.pi)
end

--- Every other frequency of a straight wire, in the given unit; both planes must agree.
function modal.pairs(wire, count, unit, tolerance)
  local f, list = wire:frequencies{ modes = 2 * count }, {}
  for i = 1, count do
    t.share(f[2 * i - 1], f[2 * i], tolerance or 1e-6, "the other plane's")
    list[i] = f[2 * i - 1] / unit
  end
  return list
end

--- Returns M x with the consistent mass of a wire's nodes.
function modal.mass_times(wire, x)
  local _, s = wire:positions()
  local mass, y = wire.beam.mass_per_length, {}
  for i = 1, #x do y[i] = 0 end
  for e = 1, #s - 1 do
    local m = mass * (s[e + 1] - s[e]) / 6
    for k = 3 * e - 2, 3 * e do
      y[k] = y[k] + m * (2 * x[k] + x[k + 3])
      y[k + 3] = y[k + 3] + m * (x[k] + 2 * x[k + 3])
    end
  end
  return y
end

function modal.dot(a, b)
  local sum = 0
  for i = 1, #a do sum = sum + a[i] * b[i] end
  return sum
end

--- Share of a shape's movement that is along axis k (1, 2, 3).
function modal.share_along(shape, k)
  local part = 0
  for i = k, #shape, 3 do part = part + shape[i] ^ 2 end
  return part / modal.dot(shape, shape)
end

--- Roots of f between low and high, found in steps.
function modal.roots(f, low, high, step)
  local list = {}
  for a = low, high, step do
    local x, y = a, a + step
    if f(x) * f(y) < 0 then
      for _ = 1, 60 do
        local z = (x + y) / 2
        if f(x) * f(z) <= 0 then y = z else x = z end
      end
      list[#list + 1] = x
    end
  end
  return list
end

-- Frequency at which a run swings in a shape [Hz], from the zeros of the shape's share in the nodes'
-- displacement.
function modal.swings(wire, shape, rest, frames)
  local weights, crossings, before = modal.mass_times(wire, shape), {}, nil
  for _, frame in ipairs(frames) do
    local q = 0
    for i = 1, #rest do q = q + weights[i] * (frame.wires[1][i] - rest[i]) end
    if before and before.q * q < 0 then
      crossings[#crossings + 1] = before.t + (frame.t - before.t) * before.q / (before.q - q)
    end
    before = { t = frame.t, q = q }
  end
  assert(#crossings > 3, "the shape does not swing")
  return (#crossings - 1) / 2 / (crossings[#crossings] - crossings[1])
end

return modal
