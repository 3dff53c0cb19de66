-- SPDX-License-Identifier: GPL-3.0-or-later
-- Frequencies of twisted wires.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local modal = require "spec.modal.tools"

-- A straight wire of 1 m, EI = 1 N m2, GJ = 0.7 N m2 between clamps, one of which turns until `torque` [N
-- m].
local function twisted(torque, segments)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 1e6, EI = 1, GJ = 0.7, mass_per_length = 1, radius = 0.001,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = segments or 100 }
  scene:clamp(wire, { s = 0 })
  local far = scene:clamp(wire, { s = 1 })
  for i = 1, 8 do
    far:pose({ 1, 0, 0 }, { axis = { 1, 0, 0 }, angle = torque / 0.7 * i / 8 })
    t.fine(scene:settle())
  end
  t.share(torque, wire:twist_moment(0.5), 1e-6, "torque")
  return wire, scene
end

local function squared(f) return (2 * math.pi * f) ^ 2 end

describe("frequencies of a twisted wire", function()
  -- Greenhill: clamped at both ends and not pulled, it buckles at a torque of 8.986819 EI / L
  -- (independent solution, 1e-10), where the first omega^2 passes through zero.
  it("fall to zero at the torque that buckles it", function()
    local straight = squared(modal.wire("clamps"):frequencies()[1])
    local a, b = 8.6, 8.9
    local x, y = squared(twisted(a):frequencies()[1]), squared(twisted(b):frequencies()[1])
    assert.is_true(x < 0.2 * squared(twisted(0.01):frequencies()[1]) and y < x and straight > 0)
    t.share(8.986819, a + (b - a) * x / (x - y), 0.003, "torque at zero")
  end)

  it("without torque are those of a straight wire, in pairs", function()
    local f = twisted(0.001):frequencies{ modes = 4 }
    t.share(22.37328545, 2 * math.pi * f[1], 0.001, "first")
    t.share(f[1], f[2], 1e-4, "both planes")
  end)

  -- Slack, bent and twisted: no plane curve. The twist of the whole span resists further winding.
  it("are those measured in a run", function()
    local scene = sw.scene{}
    local wire = scene:wire{ EA = 1e4, EI = 2e-3, GJ = 2e-3, mass_per_length = 0.03, radius = 0.002,
      from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 30 }
    scene:clamp(wire, { s = 0 })
    local far = scene:clamp(wire, { s = 1 })
    for i = 1, 10 do
      far:pose({ 1 - 0.015 * i, 0, 0 }, { axis = { 1, 0, 0 }, angle = 0.25 * i })
      t.fine(scene:settle())
    end
    local f = wire:frequencies{ modes = 3, shapes = true }
    assert.are.equal(0, f.unstable)
    for i = 1, 3 do
      local image = modal.mass_times(wire, f.shapes[i])
      for j = 1, 3 do
        t.near(i == j and 1 or 0, modal.dot(image, f.shapes[j]), 1e-9, "orthogonal")
      end
    end
    local rest, dt = wire:positions(), 1 / (150 * f[3])
    wire:set_velocity({ 0, 1e-3, 0.7e-3 }, { 0, 4e-3, 3e-3 }, { 0.4, 0, 0 })
    local frames = t.fine(scene:run{ duration = 1000 * dt, dt = dt, frame = dt,
      integrator = "implicit-midpoint" }):frames()
    for mode = 1, 3 do
      local measured = modal.swings(wire, f.shapes[mode], rest, frames)
      t.share(f[mode], measured, 3e-3, "mode " .. mode)
    end
  end)
end)
