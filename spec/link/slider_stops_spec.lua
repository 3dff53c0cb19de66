-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cables are drawn along a rail, and stop at its ends. In steps of 20 ms the shortest part is 0.3 ms, which
-- may be too long for the stop: where its error is 64 times the allowed one, an event `coarse` says so.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local CABLES = { "GXL 1.5", "FLRY-B 2.5", "H07V-K 4", "FLRY-B 0.5", "soft" }

-- Returns forces of a random cable that its clamp draws along a rail to its ends, and whether it is told.
local function drawn(seed, dt)
  local random, pick = t.choices(seed, 3)
  local scene, cable = sw.scene{}, pick(CABLES)
  local wire = t.damped(scene, cable, { 0, 0, 0 }, { 0.3, 0, 0 },
    { segments = 24 + math.floor(16 * random()) })
  local clamp = scene:clamp(wire, { s = 0 })
  local rail = scene:slider(wire, { s = 0.15 + 0.1 * random(), direction = { 0.6, 0.8, 0 }, from = -0.03,
    to = 0.05, friction = pick{ 0, 0.1, 0.3 } })
  clamp:follow{ points = { { 0, 0, 0 }, { 0.05, 0.03, 0.03 }, { -0.01, 0, 0.05 } }, duration = 0.6,
    relative = true }
  local run, told = t.fine(scene:run{ duration = 0.8, dt = dt }), false
  for _, e in ipairs(run.events) do told = told or e.kind == "coarse" end
  -- half the weight is added: smaller loads do not count
  local weight = 0.5 * 9.81 * wire:get().mass_per_length * wire.length
  return { wire:max_tension() + weight, clamp:over().peak_force + weight, rail:over().peak_force + weight },
    told
end

describe("a cable that stops at the end of a rail", function()
  -- 10 %: what peaks promise ("help peaks"). Of 150 runs one is more than 10 % off, and three are told.
  it("has the same forces at all steps, or says that they may be wrong", function()
    local runs, told = 0, 0
    for seed = 1, 14 do
      local right = drawn(seed, 0.001)
      for _, dt in ipairs{ 0.02, 0.01, 0.005 } do
        local values, event = drawn(seed, dt)
        runs, told = runs + 1, told + (event and 1 or 0)
        for k, value in ipairs(event and {} or values) do
          t.share(right[k], value, 0.1, ("value %d of seed %d at %g s"):format(k, seed, dt))
        end
      end
    end
    t.below(0.1, told / runs, "share of runs that are told")
  end)
end)
