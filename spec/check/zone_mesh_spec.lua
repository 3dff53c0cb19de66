-- SPDX-License-Identifier: GPL-3.0-or-later
-- Zones near meshes of particles. A small sphere is placed beside a straight round wire, anywhere along and
-- around it; its distance from the surface is z - R - r for a distance z from the axis. Particles are 1 to
-- 8 mm apart, so most places lie between them.
local sw = require "softworld"

local SMALL, L = 0.0005, 0.06 -- radius of the sphere, length of the wire [m]

-- Returns the row of the clearance of a wire along x. model.change: arguments of remodel.
local function row_of(model, R, at)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local given = { name = "w", density = 1300, radius = R, from = { 0, 0, 0 }, to = { L, 0, 0 } }
  for key, value in pairs(model.wire) do given[key] = value end
  local wire = scene:wire(given)
  if model.change then wire:remodel(model.change) end
  scene:zone{ name = "pin", shape = "sphere", radius = SMALL, at = at }
  return scene:run{ duration = 0.002, dt = 0.001 }:check{}:row "clearance"
end

local models = {
  { name = "tube with rings 7.5 mm apart", R = 0.004, wire = { E = 5e6, model = "tube", segments = 8 } },
  { name = "radial", R = 0.002, wire = { E = 5e7, segments = 20 }, change = { model = "radial" } },
  { name = "radial in a region", R = 0.002, wire = { E = 5e7, segments = 20 },
    change = { model = "radial", region = { 0.02, 0.03 } } },
}

describe("run:check of the clearance of a mesh", function()
  for _, model in ipairs(models) do
    -- A point of the surface is at most R pi / 48 from a line along it. Tolerance: what that adds to the
    -- distance g of the sphere's centre, (g^2 + (R pi / 48)^2)^0.5 - g.
    it("is measured from its surface: " .. model.name, function()
      local R, between = model.R, model.R * math.pi / 48
      for k = 0, 11 do
        local x, angle = 0.004 + 0.0047 * k, 0.3 + 0.7 * k
        for _, gap in ipairs{ 0, 0.001, 0.003 } do -- of the sphere's centre
          local z = R + gap
          local row = row_of(model, R, { x, z * math.cos(angle), z * math.sin(angle) })
          local slack = (gap ^ 2 + between ^ 2) ^ 0.5 - gap + 1e-5
          assert.is_near(gap - SMALL, row.value, slack)
          assert.equal(gap == 0 and "FAIL" or "PASS", row.verdict)
          assert.is_near(x, row.s, 0.002 + gap)
        end
      end
    end)
  end
end)
