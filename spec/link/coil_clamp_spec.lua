-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that is curved when unloaded, held and without load, has its own bend radius everywhere. The hinge
-- of a clamp is shorter than half an edge, so that its moment is right. The unloaded bend over it would be
-- too sharp.
local sw = require "softworld"
local t = require "physics.tools"

local R, PARTS = 0.12, 400 -- a smooth arc: far more points than edges [m], [-]

-- Returns the smallest bend radius of a held arc, and that at its clamp [m].
local function held(cable, segments, turn, hold)
  local scene, path, c, s = sw.scene{}, {}, math.cos(turn), math.sin(turn)
  for i = 0, PARTS do
    local b = 2.6 * i / PARTS
    local x, y = R * math.sin(b), R * (1 - math.cos(b))
    path[i + 1] = { c * x - s * y, s * x + c * y, 0 }
  end
  local wire = scene:wire{ cable = cable, path = path, segments = segments, rest = "path" }
  scene:gravity{ 0, 0, 0 }
  hold(scene, wire)
  t.fine(scene:run{ dt = 0.01, duration = 0.02 })
  return wire:min_bend_radius(), 1 / wire:curvature(0)
end

describe("a coil that is held without load", function()
  for k, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    it("has its own radius at a clamp at its end: " .. cable, function()
      for segments = 45, 55, 5 do
        local least, there = held(cable, segments, 0.6 * k, function(scene, wire)
          scene:clamp(wire, { s = 0 })
        end)
        -- The tangent at an end is found from two chords: off by h^2/R^2, 0.3 %, over half an edge; points
        -- every 0.8 mm beside edges of 6 to 7 mm add as much.
        t.near(R, least, 0.01 * R, "smallest radius [m]")
        t.near(R, there, 0.01 * R, "radius at the clamp [m]")
      end
    end)

    it("has it nearly where a hold moved a node: " .. cable, function()
      for segments = 45, 55 do
        for _, hold in ipairs{ function(scene, wire) scene:clamp(wire, { s = 0.15 }) end,
          function(scene, wire) scene:grip(wire, { s = 0.15, width = 0.01 }) end,
          function(scene, wire) scene:grip(wire, { s = 0.01, width = 0.01 }) end } do
          -- The node moves by up to half an edge. It and three nodes on each side stay near the arc: they are
          -- up to 3 % sharper beside a clamp. Between a grip's two faces and beside them fewer nodes can
          -- move: 12 %. Before, the node alone moved, and the arc was up to 45 % sharper.
          t.above(R / 1.15, held(cable, segments, 0.6 * k, hold), "smallest radius [m]")
        end
      end
    end)
  end
end)
