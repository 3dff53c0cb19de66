-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tension of strings. Their bending force is a second difference, which pulls along the wire too: against a
-- tension that changes from edge to edge, most of all beside a clamp, and by EI curvature^2 in a bend. The
-- tension that is read out is the whole axial force.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local materials = { soft = { E = 50e6, density = 1500, radius = 0.0025 }, rubber = { E = 5e6, density = 1200,
  radius = 0.004 }, cable = { cable = "GXL 1.5" } }
local G, LENGTH = 9.81, 0.1 -- [m/s2], [m]

local function string_of(scene, material, segments, to, model)
  local args = { from = { 0, 0, 0 }, to = to, model = model or "string", segments = segments }
  for name, value in pairs(materials[material]) do args[name] = value end
  return scene:wire(args)
end

-- Calls visit(middle of an edge [m], its direction) for each edge.
local function each_edge(wire, visit)
  local x, s = wire:positions()
  for i = 1, #s - 1 do
    local d = {}
    for k = 1, 3 do d[k] = x[3 * i + k] - x[3 * i - 3 + k] end
    local l = math.sqrt(d[1] ^ 2 + d[2] ^ 2 + d[3] ^ 2)
    visit(0.5 * (s[i] + s[i + 1]), { d[1] / l, d[2] / l, d[3] / l })
  end
end

describe("tension of a string", function()
  for material in pairs(materials) do
    for _, segments in ipairs{ 4, 20, 57 } do
      for _, up in ipairs{ 1, -1 } do
        it(("that hangs is its weight below, or above: %s, %d edges, %d"):format(material, segments, up),
          function()
            local scene = sw.scene{}
            local wire = string_of(scene, material, segments, { 0, 0, -LENGTH })
            scene:clamp(wire, { s = up > 0 and 0 or LENGTH })
            if up < 0 then scene:set{ gravity = { 0, 0, G } } end
            assert.is_true(scene:settle{}.ok)
            local weight = wire.beam.mass_per_length * G * LENGTH
            -- exact for lumped masses and gravity along the wire; 1e-6: what equilibria leave
            each_edge(wire, function(s)
              local below = up > 0 and LENGTH - s or s
              assert.is_near(weight * below / LENGTH, wire:tension(s), 1e-6 * weight)
            end)
            -- the first edge beside the clamp pulls most
            local most = weight * (1 - 0.5 / segments)
            assert.is_near(most, (wire:max_tension{ now = true }), 1e-6 * weight)
          end)
      end
    end
  end

  -- Without gravity each cross-section bears the force of the hold at its end, so the tension is the part of
  -- this force along the edge: exact for any edges.
  for _, case in ipairs{ { "soft", 20, { 1, 0, 0 } }, { "soft", 53, { 0.6, 0, 0.8 } }, { "rubber", 30,
    { 0, 1, 0 } }, { "cable", 40, { 0.48, 0.64, 0.6 } } } do
    it(("that is bent is the hold's force along it: %s, %d edges"):format(case[1], case[2]), function()
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local t = case[3]
      local wire = string_of(scene, case[1], case[2], { LENGTH * t[1], LENGTH * t[2], LENGTH * t[3] })
      scene:clamp(wire, { s = 0 })
      local across = t[3] == 0 and { 0, 0, 1 } or { -t[3], 0, t[1] }
      local moved = {}
      for k = 1, 3 do moved[k] = LENGTH * (-0.5 * t[k] + 0.4 * across[k]) end
      local hold = scene:clamp(wire, { s = LENGTH })
      hold:follow{ relative = true, points = { { 0, 0, 0 }, moved }, duration = 0.5 }
      scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
      assert.is_true(scene:run{ duration = 0.6, dt = 0.01 }.ok)
      assert.is_true(scene:settle{}.ok)
      local F = hold:force()
      local size = math.sqrt(F[1] ^ 2 + F[2] ^ 2 + F[3] ^ 2)
      local bend = wire.beam.EI / wire:min_bend_radius{ now = true } ^ 2 / size
      assert.is_true(bend > 0.2) -- what would be missing
      each_edge(wire, function(s, d)
        -- 1e-4 of the force: what equilibria leave
        assert.is_near(F[1] * d[1] + F[2] * d[2] + F[3] * d[3], wire:tension(s), 1e-4 * size)
      end)
    end)
  end

  -- The peak of a run is a mean over each step. String and rod differ by the energy of a hinge, 1/12 of its
  -- angle squared: 1e-3 here. 3 %: and by steps.
  for _, dt in ipairs{ 0.01, 0.002 } do
    it(("has the peak of a rod's as it swings in steps of %g ms"):format(1e3 * dt), function()
      local peak, strain = {}, {}
      for _, model in ipairs{ "rod", "string" } do
        local scene = sw.scene{}
        local wire = string_of(scene, "soft", 60, { LENGTH, 0, 0 }, model)
        scene:clamp(wire, { s = 0 })
        wire:set_velocity({ 0, 0, 0 }, { 0, 12, 0 }, { 0, 0, 0 })
        scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
        assert.is_true(scene:run{ duration = 0.3, dt = dt }.ok)
        peak[model], strain[model] = wire:max_tension(), (wire:strain(0.002))
      end
      print(("measured: %.4g N, of the rod %.4g N"):format(peak.string, peak.rod))
      assert.is_near(peak.rod, peak.string, 0.03 * peak.rod)
      assert.is_near(strain.rod, strain.string, 0.03 * math.abs(strain.rod))
    end)
  end
end)
