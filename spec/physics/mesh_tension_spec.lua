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

-- A clamp that carries a cable along itself starts and stops at once: the cable gets the impulse m v.
-- Within the window, waves run to and fro some hundred times. The first part of a step gives 1.01 to 1.2
-- times the momentum, and the next one takes it back (manual: limits). A window may begin between them.
describe("largest tension of a mesh whose clamp stops at once", function()
  local v, window = 0.1, 0.01
  local meshes = { { model = "tube" }, { model = "radial" }, { model = "radial", section = "solid" } }
  for _, mesh in ipairs(meshes) do
    it("is the impulse over the window: " .. mesh.model .. " " .. (mesh.section or ""), function()
      for _, dt in ipairs{ 0.01, 0.002 } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local wire = scene:wire{ model = mesh.model, section = mesh.section, cable = "GXL 1.5",
          from = { 0, 0, 0 }, to = { 0.03, 0, 0 } }
        scene:force{ kind = "damping", on = wire, mass = 4 }
        scene:clamp(wire, { s = 0 }):follow{ points = { { 0, 0, 0 }, { 0.3 * v, 0, 0 } }, duration = 0.3,
          law = "linear", relative = true }
        assert(scene:run{ duration = 0.32, dt = dt, frames = false }.ok)
        local impulse = wire.beam.mass_per_length * wire.length * v
        local share = wire:max_tension() / (impulse / window)
        print(("measured: %.3f of m v / window at %g s"):format(share, dt))
        assert.is_true(share > 0.93 and share < 1.25)
      end
    end)
  end
end)

describe("largest tension of a tube that is dropped aslant", function()
  it("does not depend on where steps end", function()
    local found = {}
    for _, dt in ipairs{ 0.01, 0.005, 0.0025 } do
      local L, tilt = 0.1, 0.2
      local scene = sw.scene{}
      scene:obstacle{ shape = "plane", friction = 0.3 }
      local wire = scene:wire{ model = "tube", E = 5e6, nu = 0.45, density = 1150, radius = 0.004,
        from = { 0, 0, 0.03 }, to = { L * math.cos(tilt), 0, 0.03 + L * math.sin(tilt) } }
      scene:force{ kind = "damping", on = wire, mass = 4 }
      assert(scene:run{ duration = 0.25, dt = dt, frames = false }.ok)
      found[#found + 1] = (wire:max_tension())
    end
    print(("measured: %.4g, %.4g, %.4g N"):format(found[1], found[2], found[3]))
    for k = 1, 2 do assert.is_near(found[3], found[k], 0.06 * found[3]) end -- steps' ends: 30 %
  end)
end)
