-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tension of meshes of stiff cables in motion. When a step turns springs by a few hundredths of a radian,
-- the errors of their lengths are larger than their stretch.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

-- A cable hangs from a clamp that shakes it for 0.4 s. Returns the largest tension of the run, and the
-- tension in its middle at the end [N].
local function shaken(args, dt)
  local scene = sw.scene{}
  args.name, args.from, args.to = "w", { 0, 0, 0 }, { 0, 0, -0.1 }
  local wire = scene:wire(args)
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
  scene:clamp(wire, { s = 0 }):follow{ duration = 0.4, func = function(t)
    return { 0.06 * math.sin(2.5 * math.pi * t) ^ 2 * math.sin(10 * math.pi * t), 0, 0 }
  end }
  local run = scene:run{ duration = 0.6, dt = dt }
  return run:check{}:row "max_tension".value, wire:tension(0.05)
end

describe("tension of a mesh that is shaken", function()
  for _, cable in ipairs{ "GXL 1.5", "H07V-K 2.5" } do
    for _, model in ipairs{ "tube", "radial" } do
      it("is that of the rod: " .. cable .. " as " .. model, function()
        local wanted, still = shaken({ cable = cable, segments = 40 }, 1e-3)
        for dt, share in pairs{ [4e-3] = 0.3, [2e-3] = 0.03 } do
          local most, rest = shaken({ cable = cable, model = model }, dt)
          print(("measured: %.4g N, at rest %.4g N; of the rod %.4g N, %.4g N"):format(most, rest, wanted,
            still))
          assert.is_near(wanted, most, share * wanted)
          assert.is_near(still, rest, 0.01 * still)
        end
      end)
    end
  end
end)
