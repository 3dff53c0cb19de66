-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cables that are pushed by their ends onto something, as connectors are. Pushed with the speed v, a cable's
-- force rises as EA v t/L, and for a moment it stays straight by its inertia: its bending grows at the rate
-- P/(2 sqrt(EI m)) under the force P. Steps that are longer than this moment let it buckle at once, or slip
-- off, as chance has it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Pokes random cables at balls, tilted walls and drums; returns the peak force and the end's place.
local function poked(seed, dt)
  local random, pick = t.choices(seed)
  local cable = pick{ "GXL 1.5", "FLRY-B 2.5", "H07V-K 4", "FLRY-B 0.5" }
  local kind = pick{ "ball", "wall", "drum" }
  local free, speed, off = 0.03 + 0.12 * random(), 0.05 + 0.25 * random(), 0.3 * (2 * random() - 1)
  local scene, R = sw.scene{}, 0.02
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { free, 0, 0 },
    segments = 8 + math.floor(16 * random()) }
  scene:settle()
  scene:force{ kind = "damping", mass = 2, stiffness = 0.002 }
  local z, mu = wire:position(free)[3], pick{ 0.1, 0.3 }
  local obstacle
  if kind == "wall" then
    obstacle = scene:obstacle{ shape = "box", size = { 2 * R, 0.1, 0.2 }, at = { free + 0.02 + R, 0, z },
      friction = mu, rotation = { axis = { 0, 1, 0 }, angle = 1.5 * off } }
  else
    obstacle = scene:obstacle{ shape = kind == "ball" and "sphere" or "cylinder", radius = R,
      length = kind == "drum" and 0.1 or nil, at = { free + 0.02 + R, 0, z + off * R }, friction = mu,
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  end
  local way = 0.03 + 0.3 * free
  scene:clamp(wire, { s = 0 }):follow{ relative = true, points = { { 0, 0, 0 }, { way, 0, 0 } },
    duration = way / speed, law = "linear" }
  t.fine(scene:run{ duration = way / speed + 0.1, dt = dt })
  return obstacle:over().peak_force, ("%s at a %s"):format(cable, kind)
end

describe("cables poked at balls, walls and drums", function()
  -- Regression: parts of 0.1 ms and more. A quarter of such pokes had peaks that were 10 to 50 % off,
  -- without a word, at all steps above 0.05 ms; some slipped off that should have buckled.
  -- What is left are ends that are about to slip, where a little decides.
  it("bear the same peak force at every step", function()
    local off, scenes = 0, 40
    for seed = 1, scenes do
      local force, what = poked(seed, 5e-5)
      local worst = 0
      for _, dt in ipairs{ 0.02, 0.01, 0.002, 0.0005 } do
        worst = math.max(worst, math.abs(poked(seed, dt) / force - 1))
      end
      if worst > 0.1 then print(("measured: %d, %s: %.2f off"):format(seed, what, worst)) end
      off = off + (worst > 0.1 and 1 or 0)
    end
    t.below(0.1, off / scenes, "share of pokes whose peak is more than 10 % off")
  end)
end)
