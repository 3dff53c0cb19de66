-- SPDX-License-Identifier: GPL-3.0-or-later
-- The velocity of a hold jumps along a stiff, damped cable: a clamp that reverses at once. The peak of its
-- force, a mean over 10 ms, is the momentum m dv over 10 ms. The first part after the jump gave 1.01 to 1.16
-- times the momentum, and the next took it back. It is now computed by implicit Euler. The held node has its
-- velocity at once: the mass of half an edge is not in the force, nor is that between the ends of a grip.
local sw = require "softworld"
local t = require "physics.tools"

local LENGTH, SPEED, WINDOW = 0.4, 0.1, 0.01 -- [m], [m/s], [s]

local function reversed(cable, segments, make, dt, along)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local function at(x) return { x * along[1], x * along[2], x * along[3] } end
  local wire = scene:wire{ cable = cable, from = at(0), to = at(-LENGTH), segments = segments }
  scene:force{ kind = "damping", mass = 1, stiffness = 1e-3 }
  local hold, held = make(scene, wire) -- held: length whose mass is not in the force [m]
  hold:follow{ relative = true, points = { { 0, 0, 0 }, at(2 * SPEED * WINDOW * 10), { 0, 0, 0 } },
    times = { 0, 0.2, 0.4 }, law = "linear" }
  t.fine(scene:run{ dt = dt, duration = 0.1 })
  t.fine(scene:run{ dt = dt, duration = 0.25 })
  local mass = wire.beam.mass_per_length * (LENGTH - held)
  return hold:over().peak_force * WINDOW / (mass * 2 * SPEED)
end

local makers = {
  clamp = function(scene, wire) return scene:clamp(wire, { s = 0 }), 0.5 * LENGTH / wire.segments end,
  grip = function(scene, wire)
    return scene:grip(wire, { s = 0.1, width = 0.02 }), 0.02 + LENGTH / wire.segments
  end,
}

describe("a hold whose velocity jumps along a stiff cable", function()
  for kind, make in pairs(makers) do
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
      it(("bears its momentum, no more: %s, %s"):format(kind, cable), function()
        for k, dt in ipairs{ 0.02, 0.01, 0.005, 0.002, 5e-4, 2e-4, 5e-5 } do
          local along = k % 2 == 0 and { 0.6, 0, 0.8 } or { 1, 0, 0 }
          local share = reversed(cable, k % 3 == 0 and 57 or 40, make, dt, along)
          t.share(1, share, 0.03, ("%g ms: peak over m dv"):format(1e3 * dt))
        end
      end)
    end
  end
end)
