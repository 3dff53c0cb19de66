-- SPDX-License-Identifier: GPL-3.0-or-later
-- A touch that becomes stiffer in a step lets its wire out and thereby does work. For joined wires this
-- work was not counted once: such steps were refused as energy from nowhere, the short steps taken instead
-- let the wire sink in, and joints that lie on a table cost 20 times the iterations (33,942 in 2,062 steps)
-- at a depth of 110 um.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local RADIUS = 0.0015
local stiff = { EA = 1e5, EI = 1.3e-3, GJ = 1.6e-3, mass_per_length = 0.02, radius = RADIUS }
local soft = { E = 5e6, density = 1500, radius = RADIUS }

-- A trunk along x and branches from its end lie on a table, joined there. The branches' far ends are lifted
-- and brought nearer.
local function lifted(material, branches, friction)
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = friction }
  local function wire(from, to, segments)
    local o = { from = from, to = to, segments = segments }
    for key, value in pairs(material) do o[key] = value end
    return scene:wire(o)
  end
  local trunk = wire({ 0, 0, RADIUS }, { 0.3, 0, RADIUS }, 16)
  scene:clamp(trunk, { s = 0 })
  local ends, angle = { { trunk, s = 0.3 } }, branches == 1 and 0 or 0.6
  for k = 1, branches do
    local x, y = 0.3 + 0.2 * math.cos(angle), (3 - 2 * k) * 0.2 * math.sin(angle)
    local branch = wire({ 0.3, 0, RADIUS }, { x, y, RADIUS }, 12)
    ends[k + 1] = { branch, s = 0 }
    scene:clamp(branch, { s = 0.2 }):follow{ relative = true, duration = 16,
      points = { { 0, 0, 0 }, { -0.04, 0, 0.05 } } }
  end
  scene:join{ name = "joint", ends = ends }
  scene:force{ kind = "damping", mass = 5 }
  t.fine(scene:settle())
  local run = scene:run{ duration = 16, dt = 0.02, parts = false }
  t.fine(run)
  return run, (scene:penetration())
end

describe("wires that are joined on a table", function()
  for name, case in pairs{ ["stiff, two branches, rough"] = { stiff, 2, 0.3 },
    ["stiff, one branch, smooth"] = { stiff, 1, 0 }, ["soft, one branch, smooth"] = { soft, 1, 0 } } do
    it("are lifted with few refused steps: " .. name, function()
      local run, depth = lifted(table.unpack(case))
      t.below(0.02, run.rejected / run.steps, "steps refused [-]")
      t.below(8, run.iterations / run.steps, "iterations of a step")
      t.below(55e-6, depth, "depth [m]")
      t.below(0.001, run:ledger().gained / run:ledger().play, "gained of what was in play [-]")
    end)
  end
end)
