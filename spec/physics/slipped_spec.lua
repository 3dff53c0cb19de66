-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that cross, are drawn taut and slip off each other have the same peaks at all steps. As one slips
-- off, a part of a step may be far too long. If more than 64 parts were needed, the step stayed whole: of 50
-- random pairs 5 had a value that was off by 12 % up to 7 times at 20 or 12.5 ms, without a report.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local CABLES = { "GXL 1.5", "FLRY-B 2.5", "H07V-K 4", "FLRY-B 0.5", "soft" }

-- A cable that is held at one end is lifted by another one, which is carried by both ends, until it slips
-- off. Mirrored, with other ends held, and turned about the vertical by `turn`.
local function slipped(seed, dt)
  local random, pick = t.choices(seed, 3)
  local turn, side, swapped = 6 * random(), pick{ -1, 1 }, random() < 0.5
  local function at(x, y, z)
    y = side * y
    return { math.cos(turn) * x - math.sin(turn) * y, math.sin(turn) * x + math.cos(turn) * y, z }
  end
  local scene = sw.scene{}
  local a, b = at(0, 0, 0), at(0.12, 0, 0)
  local held = t.damped(scene, pick(CABLES), swapped and b or a, swapped and a or b,
    { segments = 20 + math.floor(20 * random()) })
  scene:clamp(held, { s = swapped and held.length or 0 })
  local x = 0.07 + 0.04 * random()
  local lifts = t.damped(scene, pick(CABLES), at(x, -0.12, -0.012), at(x, 0.12, -0.012),
    { segments = 20 + math.floor(20 * random()) })
  scene:wire_contact{ friction = 0.2 }
  local out, hands = {}, {}
  for k, s in ipairs{ 0, lifts.length } do
    hands[k] = scene:clamp(lifts, { s = s })
    hands[k]:follow{ points = { { 0, 0, 0 }, at(0.02 * random(), 0, 0.12) }, duration = 0.5, relative = true }
  end
  t.fine(scene:run{ duration = 0.7, dt = dt })
  for _, wire in ipairs{ held, lifts } do
    -- half the weight is added: smaller loads do not count
    out[#out + 1] = wire:max_tension() + 0.5 * 9.81 * wire:get().mass_per_length * wire.length
  end
  local weight = 0.5 * 9.81 * held:get().mass_per_length * held.length
  for _, hand in ipairs(hands) do out[#out + 1] = hand:over().peak_force + weight end
  return out
end

describe("a cable that slips off another one", function()
  -- 10 %: what peaks promise for pairs of cables ("help peaks"). All of 150 other pairs keep it.
  it("has the same peaks at every step", function()
    for seed = 1, 24 do
      local right = slipped(seed, 5e-4)
      for _, dt in ipairs{ 0.02, 0.0125, 0.01, 0.005 } do
        for k, value in ipairs(slipped(seed, dt)) do
          t.share(right[k], value, 0.1, ("value %d of pair %d at %g s"):format(k, seed, dt))
        end
      end
    end
  end)
end)
