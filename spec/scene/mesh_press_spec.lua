-- SPDX-License-Identifier: GPL-3.0-or-later
-- Clamps and grips that press a wire that is a mesh a little into a table. Held sections keep their shape, so
-- a tenth of a millimetre presses with 3 to 300 weights. A mesh of solid elements is so deep at the height of
-- its radius, because its section is a polygon that is wider over its corners.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L = 0.12 -- [m]
local rubber = { E = 5e6, density = 1200, radius = 0.004 }
local soft = { E = 50e6, density = 1500, radius = 0.0025 }
local springs = { tube = { model = "tube" }, radial = { model = "radial" } }
local elements = { radial = { model = "radial", section = "solid" }, cubic = { model = "cubic",
  section = "solid" } }

-- Returns the events `pressed`, the hold's largest force, the wire's weight [N] and its width upwards [m].
-- o.above: height of the wire over that at which its radius touches [m].
local function held(material, model, o)
  local scene, c, s = sw.scene{}, math.cos(o.turn or 0), math.sin(o.turn or 0)
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local z = material.radius + (o.above or 0)
  local args = { name = "w", from = { 0, 0, z }, to = { L * c, L * s, z } }
  for key, value in pairs(material) do args[key] = value end
  for key, value in pairs(model) do args[key] = value end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", mass = 5 }
  local hold = o.grip and scene:grip(wire, { name = "h", s = 0.05, width = 0.01 })
    or scene:clamp(wire, { name = "h", s = o.s or 0 })
  local width = wire:width(L / 2, { 0, 0, 1 })
  local run = t.fine(scene:run{ dt = o.dt or 0.01, duration = 0.04 })
  local told = {}
  for _, e in ipairs(run.events) do if e.kind == "pressed" then told[#told + 1] = e end end
  return told, hold:over().peak_force, wire.beam.mass_per_length * 9.81 * L, width
end

local function check_told(told, peak, weight, depth, tolerance)
  assert.equal(1, #told)
  assert.equal("h", told[1].object)
  assert.matches("see wire:width$", told[1].text)
  t.near(1e3 * depth, tonumber(told[1].text:match "presses wire 'w' ([%d.e-]+) mm into 'table'"),
    1e3 * tolerance, "depth told [mm]")
  -- The peak is a mean over 10 ms, the event has the largest force at a step's end, without the friction.
  t.above(2 * weight, told[1].value, "force told [N]")
  t.above(0.4 * peak, told[1].value, "force told [N]")
  t.below(1.2 * peak, told[1].value, "force told [N]")
end

describe("a hold that begins a little in a table", function()
  for name, model in pairs(springs) do
    for k, material in ipairs{ rubber, soft } do
      it(("presses a mesh of springs: %s, material %d"):format(name, k), function()
        for _, o in ipairs{ { above = -1.2e-4 }, { above = -8e-5, s = 0.06, turn = 0.7, dt = 0.005 } } do
          local told, peak, weight = held(material, model, o)
          -- depth: of the outline without load, to rounding of the text
          check_told(told, peak, weight, -o.above, 1e-6)
        end
        local told, peak, weight = held(material, model, { above = -1.2e-4, grip = true, turn = 2 })
        check_told(told, peak, weight, 1.2e-4, 1e-6)
        if k == 2 then -- not told below 10 um before; rubber presses with less than two weights there
          told, peak, weight = held(material, model, { above = -5e-6 })
          check_told(told, peak, weight, 5e-6, 1e-7)
        end
        for _, above in ipairs{ 0, 1.2e-4 } do -- it touches, or is above
          told, peak = held(material, model, { above = above, turn = 0.3 })
          assert.equal(0, #told)
          t.below(weight, peak, "force of the hold [N]")
        end
      end)
    end
  end

  for name, model in pairs(elements) do
    for k, material in ipairs{ rubber, soft } do
      it(("presses a mesh of elements at its radius' height: %s, material %d"):format(name, k), function()
        local o = k == 1 and {} or { s = 0.06, turn = 0.7, dt = 0.005 }
        local told, peak, weight, width = held(material, model, o)
        -- The width is that of the outline round its corners: the table's facing corner may be lower or
        -- higher by the part of a corner's rise that a turned section has, a fifth of the depth.
        local depth = 0.5 * width - material.radius
        check_told(told, peak, weight, depth, 0.2 * depth)
        -- At half its width it only touches.
        told, peak = held(material, model, { above = 0.5 * width - material.radius + 1e-5 })
        assert.equal(0, #told)
        t.below(weight, peak, "force of the hold [N]")
      end)
    end
  end
end)
