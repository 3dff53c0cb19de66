-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cables at rest on obstacles, in clips, ties and holds: forces of holds and obstacles and the weight add up
-- to zero. Regression: of 527 random scenes that came to rest, 48 had forces that did not, by up to 50 times
-- the weight. Friction of clips was not that of the push at rest, and where the last iteration of the search
-- failed (seed 78, without a clip: a pin's force 45 % off), forces of holds were those of this iteration.
local random_scenes = require "contact.random_scenes"
local vec = require "softworld.vec"
local t = require "physics.tools"

local SEEDS = 120

-- Returns the sum of all forces over the weight, and what holds the wires; nil: no rest, or no weight.
local function imbalance(seed)
  local plan = random_scenes.plan(seed)
  if vec.norm(plan.gravity) == 0 then return nil end
  local scene <close>, wires, obstacles, holds = random_scenes.scene(plan)
  if not scene:settle{ max_iterations = 2000 }.ok then return nil end
  local sum, weight = { 0, 0, 0 }, 0
  for _, h in ipairs(holds) do sum = vec.add(sum, h:force()) end
  for _, o in ipairs(obstacles) do sum = vec.add(sum, o:force(), -1) end
  for _, w in ipairs(wires) do
    local mass = w.beam.mass_per_length * w.length
    sum, weight = vec.add(sum, plan.gravity, mass), weight + mass * vec.norm(plan.gravity)
  end
  return vec.norm(sum) / weight
end

describe("random cables at rest", function()
  -- Where the last iteration of the search fails, the state is that of the last step of continuation. That
  -- step shifts wires by less than 1e-9 m, and its inertia bears what is left of the imbalance: measured
  -- 1.1e-3 of the weight at most (seed 92), before 50 times the weight (seed 23). 5e-3 leaves room for that.
  it("are in balance", function()
    local count, worst, which = 0, 0, 0
    for seed = 1, SEEDS do
      local off = imbalance(seed)
      if off then count = count + 1 end
      if off and off > worst then worst, which = off, seed end
    end
    t.above(0.7 * SEEDS, count, "scenes that come to rest")
    t.below(5e-3, worst, ("largest imbalance over the weight, seed %d"):format(which))
  end)
end)
