-- SPDX-License-Identifier: GPL-3.0-or-later
-- A weight pulls one node of a cable down, and the cable lands just below. The blow rings through the cable,
-- and damping dies out faster than steps resolve: the power at a step's ends overstates what it took. The
-- work of a weight is known exactly, so the excess is damping's. It was taken for energy from nowhere: 7 to
-- 9 % of the energy in play of a GXL 1.5, at any step.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH, GAP, FALL = 0.18, 1e-4, 0.02

local function landed(cable, load, dt, turn)
  local s = sw.scene{ gravity = { 0, -9.81 * math.sin(turn), -9.81 * math.cos(turn) } }
  local up = { 0, math.sin(turn), math.cos(turn) }
  local radius = sw.cable(cable).outer_diameter.value / 2
  local h = radius + GAP
  s:obstacle{ shape = "plane", normal = up, friction = 0.3 }
  local w = s:wire{ cable = cable, from = { 0, h * up[2], h * up[3] }, to = { LENGTH, h * up[2], h * up[3] },
    segments = 37 }
  s:force{ kind = "damping", on = w, mass = 5, stiffness = 1e-3 }
  s:force{ kind = "point", on = w, s = 0.42 * LENGTH, force = { 0, -load * up[2], -load * up[3] } }
  local run = t.fine(s:run{ dt = dt, duration = FALL })
  return run, run:ledger(), w:get().mass_per_length * LENGTH * 9.81 + load
end

describe("the ledger of a loaded cable that lands", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it("books what damping took, not more: " .. cable, function()
      for _, dt in ipairs{ 1e-2, 2.5e-3, 6.25e-4, 1e-4 } do
        for _, turn in ipairs{ 0, 0.7 } do
          local run, l, force = landed(cable, 2, dt, turn)
          local what = (" at steps of %g s, turned by %g rad"):format(dt, turn)
          t.below(1e-3, l.gap / l.play, "from nowhere [-]" .. what)
          t.near(0, #t.events(run, "energy"), 0, "events [-]" .. what)
          -- all of the fall's energy is lost: damping, blows and the method
          local lost = 0
          for _, part in pairs(l.lost) do lost = lost + part end
          t.share(force * GAP, lost, 0.06, "lost [J]" .. what)
        end
      end
    end)
  end
end)
