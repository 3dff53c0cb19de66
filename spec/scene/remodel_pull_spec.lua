-- SPDX-License-Identifier: GPL-3.0-or-later
-- wire:remodel of a bent wire at rest from rod to string or back, or to a string with other edges. The
-- bending force of a string pulls along its edges by EI curvature^2, that of a rod does not: the edges'
-- springs must take over the difference, and the lengths that go with it (csrc/remodel/borne.c).
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH, RADIUS = 0.05, 0.02 -- [m]
local materials = { soft = { E = 50e6, density = 1500, radius = 0.0025 }, rubber = { E = 5e6, density = 1200,
  radius = 0.004 }, cable = { cable = "GXL 1.5" } }

-- A wire along an arc between two clamps, the second of which then moves, so that the wire is bent to 14 mm
-- and pulled; turn: of the plane of the arc [rad]; middle: 1 if a clamp holds its middle, too.
local function bent(material, model, segments, turn, middle)
  local scene, path = sw.scene{ gravity = { 0, 0, 0 } }, {}
  local c, s = math.cos(turn), math.sin(turn)
  for k = 0, 400 do
    local a = LENGTH / RADIUS * k / 400
    path[k + 1] = { c * RADIUS * math.sin(a), s * RADIUS * math.sin(a), RADIUS * (1 - math.cos(a)) }
  end
  local args = { path = path, model = model, segments = segments }
  for name, value in pairs(materials[material]) do args[name] = value end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
  scene:clamp(wire, { s = 0 })
  local hold = scene:clamp(wire, { s = wire.length })
  t.fine(scene:settle())
  hold:follow{ relative = true, points = { { 0, 0, 0 }, { c * 0.002, s * 0.002, 0.001 } }, duration = 0.3 }
  t.fine(scene:run{ duration = 0.5, dt = 0.01 })
  t.fine(scene:settle())
  if middle then
    scene:clamp(wire, { s = 0.4 * LENGTH })
    t.fine(scene:settle())
  end
  return scene, wire
end

local PLACES = { 0.005, 0.012, 0.022, 0.03, 0.044 } -- [m]

local function tensions(wire)
  local list = {}
  for k, s in ipairs(PLACES) do list[k] = wire:tension(s) end
  return list
end

describe("wire:remodel of a bent wire", function()
  for _, case in ipairs{ { "soft", "rod", "string", 40, 40, 0 }, { "soft", "string", "rod", 40, 40, 1 },
    { "rubber", "rod", "string", 40, 57, 2 }, { "rubber", "string", "rod", 57, 40, 3 },
    { "cable", "string", "string", 30, 45, 0.5 }, { "cable", "rod", "string", 45, 60, 0.6 },
    { "soft", "rod", "string", 30, 50, 4, true }, { "soft", "string", "rod", 50, 35, 5, true } } do
    local material, from, to, edges, others, turn, middle = table.unpack(case)
    it(("keeps its tension: %s, %s with %d edges to %s with %d%s"):format(material, from, edges, to, others,
      middle and ", clamped in its middle" or ""), function()
      local scene, wire = bent(material, from, edges, turn, middle)
      local before, radius = tensions(wire), wire:min_bend_radius{ now = true }
      local bend = wire.beam.EI / radius ^ 2 -- [N]; half of it and more was missing
      wire:remodel{ model = to, segments = others }
      -- Between edges of up to h = 1.7 mm tensions are interpolated: h^2/(8 R^2) = 0.2 % at R = 14 mm.
      for k, T in ipairs(tensions(wire)) do
        t.near(before[k], T, 2e-3 * bend, ("tension at %g mm [N]"):format(1e3 * PLACES[k]))
      end
      local most, least = { table.unpack(before) }, { table.unpack(before) }
      local at_once = wire:min_bend_radius{ now = true }
      for _ = 1, 20 do
        t.fine(scene:run{ duration = 1e-3, dt = 1e-3 })
        for k, T in ipairs(tensions(wire)) do
          most[k], least[k] = math.max(most[k], T), math.min(least[k], T)
        end
      end
      t.fine(scene:run{ duration = 0.2, dt = 0.01 })
      t.fine(scene:settle())
      -- Strings are a little stiffer in stretch (manual, limits), so the other model rests with another
      -- tension. On the way there it may swing by a part of the difference: 5 % of the bend's force.
      for k, T in ipairs(tensions(wire)) do
        local what = (" tension at %g mm [N]"):format(1e3 * PLACES[k])
        t.below(math.max(before[k], T) + 0.05 * bend, most[k], "largest" .. what)
        t.above(math.min(before[k], T) - 0.05 * bend, least[k], "smallest" .. what)
      end
      -- Nodes went to new places to get other lengths: the bends that this leaves are those at rest, within
      -- what the tension differs by.
      local rest = wire:min_bend_radius{ now = true }
      t.near(rest, at_once, 0.04 * rest, "smallest bend radius at once [m]")
    end)
  end
end)
