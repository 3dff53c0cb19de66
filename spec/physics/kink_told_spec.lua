-- SPDX-License-Identifier: GPL-3.0-or-later
-- A tube that is bent beyond the curvature at which its wall buckles has an event, also where its mesh folds
-- gradually, or bears more than a tube can.
local sw = require "softworld"
local t = require "spec.physics.tools"
local pi = math.pi

local E, R, wall, L = 10e6, 0.009, 0.0012, 0.15

local function hose(particles, segments)
  local b, o = R - wall / 2, R + wall / 2
  local EI = E * pi * (o ^ 4 - b ^ 4) / 4
  local scene = sw.scene{ name = "hose", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "hose", model = "tube", core = false, particles = particles,
    segments = segments, radius = o, EA = E * pi * (o ^ 2 - b ^ 2), EI = EI, GJ = EI / 1.3,
    mass_per_length = 1100 * pi * (o ^ 2 - b ^ 2), wall_bending = E * wall ^ 3 / 12 / (1 - 0.3 ^ 2),
    from = { -L / 2, 0, 0 }, to = { L / 2, 0, 0 } }
  return scene, wire, scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = L })
end

-- The ends of an arc of the curvature k: x to the middle [m], angle.
local function arc(k)
  local angle = k * L / 2
  return math.sin(angle) / k, { math.cos(angle / 2), 0, math.sin(angle / 2), 0 },
    { math.cos(angle / 2), 0, -math.sin(angle / 2), 0 }
end

-- The curvature at a = kappa R^2/t.
local function at(a) return a * wall / R ^ 2 end

describe("a kink of a hose", function()
  -- 8 particles: told from a = 0.6 and 0.66 on, at a moment 30 % above the largest of a tube; 12: from 0.48.
  it("is told where the wall buckles, whatever the mesh, and not before", function()
    for _, mesh in ipairs{ { 8, 30 }, { 8, 40 }, { 8, 60 }, { 12, 30 }, { 12, 60 }, { 16, 40 } } do
      local scene, wire, first, last = hose(mesh[1], mesh[2])
      local function bend(a)
        local x, up, down = arc(at(a))
        first:pose({ -x, 0, 0 }, down)
        last:pose({ x, 0, 0 }, up)
        return t.fine(scene:settle())
      end
      for _, a in ipairs{ 0.12, 0.24, 0.3, 0.36 } do assert.is_nil(bend(a).kinked) end
      bend(0.42)
      local told = bend(0.45).kinked
      assert.matches("^tube 'hose' kinks at s = [%d.]+ m: its curvature there is", told)
      local there = tonumber(told:match "curvature there is ([%d.]+) 1/m")
      t.above(1.1 * at(0.4714), there, "curvature")
      assert.equal(wire.name, scene:events()[1].object)
    end
  end)

  -- The moment fell from a = 0.40 on. With 8 particles the event came at 0.47, and the row passed before.
  it("fails the check of a motion that ends behind it", function()
    for _, case in ipairs{ { 0.36, "PASS" }, { 0.45, "FAIL" } } do
      local scene, wire, first, last = hose(8, 40)
      scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 0.005 }
      for _, end_of in ipairs{ { first, -1 }, { last, 1 } } do
        end_of[1]:follow{ func = function(time)
          local x, up, down = arc(math.max(1e-8, at(case[1]) * math.min(1, time)))
          return { end_of[2] * x, 0, 0 }, end_of[2] > 0 and up or down
        end }
      end
      local run = t.fine(scene:run{ duration = 1.2, dt = 0.02 })
      assert.equal(case[2], run:check{}:row "kinks".verdict)
    end
  end)
end)
