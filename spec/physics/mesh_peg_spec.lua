-- SPDX-License-Identifier: GPL-3.0-or-later
-- Solid meshes pulled over pegs: no step makes energy, and the peg bears the same force as from a rod.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local G, r, L = 9.81, 0.004, 0.12

-- A wire hangs over a peg along y; its right end is drawn to the side from the start. turn: of the section
-- about its axis [rad]; shift: of the whole wire along itself [m].
local function over(o)
  local scene = sw.scene{ gravity = { 0, 0, -G } }
  scene:force{ kind = "damping", mass = o.damping or 5, stiffness = 1e-3 }
  local z, turn, shift = o.peg + 1.02 * r, o.turn or 0, o.shift or 0
  local wire = scene:wire{ model = o.model or "rod", body = o.body, E = o.E or 2e6, nu = 0.4, density = 1200,
    radius = r, from = { shift - L / 2, 0, z }, to = { shift + L / 2, 0, z },
    normal = o.model and { 0, math.cos(turn), math.sin(turn) } or nil }
  local peg = scene:obstacle{ shape = "cylinder", radius = o.peg, length = 0.1, friction = o.friction,
    rotation = { math.cos(math.pi / 4), math.sin(math.pi / 4), 0, 0 } }
  local hand = scene:clamp(wire, { s = L })
  hand:follow{ points = { { 0, 0, 0 }, { o.way or 0.02, 0, 0 } }, duration = 1, relative = true,
    law = "linear" }
  return scene, wire, peg
end

describe("a solid mesh pulled over a peg", function()
  for _, dt in ipairs{ 0.01, 5e-3, 2e-3, 1e-3 } do
    it(("gains no energy in steps of %g s"):format(dt), function()
      local scene = over{ model = "radial", body = "solid", peg = 0.03, friction = 0, way = 0.005 }
      local run = t.fine(scene:run{ duration = 0.4, dt = dt })
      local energy = run:ledger()
      assert.equal(0, energy.accepted.count)
      -- the errors allowed to single steps add up to half of this at most
      t.below(1e-3, energy.gained / energy.play, "energy made")
    end)
  end

  it("presses on it as a rod does, however it is turned and wherever its slices are", function()
    local shift, forces, weight = 7e-4, {}, nil
    for k, o in ipairs{ { shift = 0 }, { solid = true, shift = 0 }, { shift = shift },
      { solid = true, turn = 0.3, shift = shift } } do
      local scene, wire, peg = over{ model = o.solid and "radial", body = o.solid and "solid", turn = o.turn,
        shift = o.shift, peg = 0.01, friction = 0.3, damping = 30 }
      weight = wire.beam.mass_per_length * L * G
      local sum, n = { 0, 0, 0 }, 20
      t.fine(scene:run{ duration = 0.4, dt = 5e-3 })
      for _ = 1, n do -- corners of the section pass over the peg one by one
        t.fine(scene:run{ duration = 0.01, dt = 5e-3 })
        local f = peg:force()
        for i = 1, 3 do sum[i] = sum[i] + f[i] / n end
      end
      forces[k] = sum
    end
    for _, k in ipairs{ 2, 4 } do
      for i = 1, 3 do
        -- shares of the weight; sections of eight sides lie up to 0.03 r lower and pass corner by corner:
        -- measured 0.9 % along, 1.4 % up, and 3.3 % up if turned and shifted
        t.near(forces[k - 1][i], forces[k][i], 0.04 * weight, "force on the peg " .. i)
      end
    end
  end)
end)
