-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tension of meshes with dashpots (damping by stiffness): it is the force that a section carries, with the
-- dashpots' part, as in rods. Strain is that of the springs alone.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L, SPEED, BETA, TIME = 0.06, 0.01, 0.05, 0.06

-- A mesh between two clamps is drawn longer evenly. Returns the tension in its middle, the force of the
-- clamp that stands still [N], and the strain.
local function drawn(args, turn, dt)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local c, s = math.cos(turn), math.sin(turn)
  args.name, args.E, args.density, args.radius = "w", 5e6, 1200, 0.003
  args.from, args.to = { 0, 0, 0 }, { L * c, L * s, 0 }
  local wire = scene:wire(args)
  scene:force{ kind = "damping", on = wire, mass = 20, stiffness = BETA }
  local still = scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = L }):follow{ points = { { 0, 0, 0 }, { L * c, L * s, 0 } }, relative = true,
    speed = SPEED, law = "linear" }
  t.fine(scene:run{ duration = TIME, dt = dt })
  local f = still:force()
  local result = { wire:tension(L / 2), math.sqrt(f[1] ^ 2 + f[2] ^ 2 + f[3] ^ 2), wire:strain(L / 2) }
  scene:close()
  return table.unpack(result)
end

describe("tension of a mesh with dashpots", function()
  for name, args in pairs{ tube = { model = "tube" }, layers = { model = "radial" },
    cubes = { model = "cubic" }, elements = { model = "radial", section = "solid" } } do
    for _, turn in ipairs{ 0, 0.7 } do
      it(("is the force of its clamp: %s, turned by %g"):format(name, turn), function()
        for _, dt in ipairs{ 0.02, 0.005, 0.00125 } do
          local tension, force, strain = drawn(args, turn, dt)
          local what = (" at steps of %g s"):format(dt)
          -- inertia: the force changes along the wire by m a; 20/s times m v/2 is below 1e-4 of it
          t.share(force, tension, 0.01, "tension, of the clamp's force" .. what)
          -- the springs alone: v t / L; clamps that keep sections round make 1 %
          t.share(SPEED * TIME / L, strain, 0.03, "strain, of speed x time / length" .. what)
          if name ~= "elements" then -- Kelvin and Voigt: EA (e + beta de/dt)
            local EA = 5e6 * math.pi * 0.003 ^ 2
            t.share(EA * (SPEED * TIME + BETA * SPEED) / L, tension, 0.03, "tension, of the formula" .. what)
          end
        end
      end)
    end
  end
end)
