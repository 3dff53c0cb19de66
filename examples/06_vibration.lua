-- SPDX-License-Identifier: GPL-3.0-or-later
-- A nylon wire of 1.005 m sags between two clamps 1 m apart. The base of the machine shakes sideways.
-- Which frequencies should the machine avoid, and how large are motion and stress of the wire?
local sw = require "softworld"

local scene = sw.scene { name = "vibration" }
local wire = scene:wire { E = 2e9, density = 1150, radius = 0.001,
  from = { 0, 0, 0 }, to = { 1.005, 0, 0 }, segments = 50 }
local clamps = { scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = wire.length }) }
clamps[2]:pose { 1, 0, 0 }
assert(scene:settle().ok)

local f = wire:frequencies { modes = 6 }
print(("frequencies %.4f %.4f %.4f %.4f %.4f %.4f Hz"):format(table.unpack(f)))
print(("stress at rest %.4f MPa"):format(wire:max_stress() / 1e6))

-- Damping: 3 % of the critical damping at the first frequency.
scene:force { kind = "damping", on = wire, mass = 2 * 0.03 * 2 * math.pi * f[1] }
local rest = scene:snapshot()

local function shake(frequency)
  local amplitude, omega = 0.2e-3, 2 * math.pi * frequency
  for _, clamp in ipairs(clamps) do
    clamp:follow { func = function(t) return { 0, amplitude * math.sin(omega * t), 0 } end,
      relative = true, duration = 60 }
  end
  scene:run { duration = 40 / f[1], dt = 0.01 / f[1] } -- until the vibration is steady
  local run = scene:run { duration = 2 / frequency, dt = 0.01 / f[1], frame = 0.01 / f[1] }
  local largest = 0
  for _, frame in ipairs(run:frames()) do
    if frame.t > run.start then largest = math.max(largest, math.abs(frame.wires[1][3 * 25 + 2])) end
  end
  local stress, s = wire:max_stress()
  print(("shaken at %.4f Hz: the middle moves %.3f times as far; peak stress %.4f MPa at s = %.3f m"):format(
    frequency, largest / amplitude, stress / 1e6, s))
  scene:restore(rest)
end

shake(f[1])
shake(1.5 * f[1])
