-- SPDX-License-Identifier: GPL-3.0-or-later
-- A bent rod at rest gets another number of segments and stays at rest: its bend radius must not change. All
-- free nodes lie k h^2/12 further from a clamp's tangent than the axis, with their own edges h: beside clamps
-- nodes must lie elsewhere with other edges (csrc/body/bends.c).
local sw = require "softworld"
local t = require "physics.tools"

-- Makes an arch at rest between two clamps, in the direction `turn`, held in its middle as well if asked.
local function arch(o)
  local scene, c, s = sw.scene{}, math.cos(o.turn), math.sin(o.turn)
  local wire = scene:wire{ cable = o.cable, from = { 0, 0, 0 }, to = { 0.4 * c, 0.4 * s, 0 },
    segments = o.segments }
  scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
  local ends = { 0, wire.length }
  scene:clamp(wire, { s = ends[o.swapped and 2 or 1] })
  local way = o.swapped and 0.3 or -0.3
  scene:clamp(wire, { s = ends[o.swapped and 1 or 2] }):follow{ duration = 1, relative = true,
    points = { { 0, 0, 0 }, { way * c, way * s, 1e-3 } } }
  t.fine(scene:run{ duration = 3 })
  t.fine(scene:settle())
  if o.middle then scene:clamp(wire, { s = 0.2 }) end
  t.fine(scene:run{ duration = 0.5 })
  t.fine(scene:run{ duration = 0.02 })
  return scene, wire, (wire:min_bend_radius())
end

describe("a bent rod that gets another number of segments", function()
  for k, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    for _, middle in ipairs{ false, true } do
      it(("keeps its bend radius: %s%s"):format(cable, middle and ", held in its middle" or ""), function()
        for n, from in ipairs{ 40, 55 } do
          for j, to in ipairs{ 27, 30, 41, 60, 80, 110 } do
            local scene, wire, before = arch{ cable = cable, segments = from, turn = k + 0.4 * n,
              middle = middle, swapped = j % 2 == 0 }
            wire:remodel{ model = "rod", segments = to }
            local what = ("%d to %d segments: "):format(from, to)
            -- Edges of up to 15 mm on a bend of 30 mm: h^2/R^2 is 0.25 at most; bends at rest differ by a
            -- fiftieth of this between both meshes, and nodes go over to the old curve by as much. Before,
            -- 14 to 28 mm at once and 23 to 28 mm in the first step.
            t.near(before, wire:min_bend_radius{ now = true }, 0.03 * before, what .. "at once [m]")
            t.fine(scene:run{ duration = 0.1 })
            t.near(before, wire:min_bend_radius(), 0.03 * before, what .. "smallest radius [m]")
          end
        end
      end)
    end
  end

  it("keeps its places, and pulls no harder", function()
    local scene, wire = arch{ cable = "GXL 1.5", segments = 43, turn = 2, middle = true }
    local places, tension = {}, wire:max_tension()
    for k = 0, 4 do places[k] = wire:position(0.1 * k) end
    wire:remodel{ model = "rod", segments = 71 }
    -- Free nodes move by what they lay too far from the axis, k h^2/12 = 0.24 mm; clamped ones do not.
    for k = 0, 4 do
      t.below(k % 2 == 0 and 1e-9 or 2.4e-4, t.distance(places[k], wire:position(0.1 * k)),
        ("way of the place at %g m [m]"):format(0.1 * k))
    end
    t.fine(scene:run{ duration = 0.1 })
    -- Between two holds a stretch by 1e-6 is 0.1 N, more than the weight of 0.08 N.
    t.near(tension, wire:max_tension(), 0.08, "largest tension [N]")
  end)
end)
