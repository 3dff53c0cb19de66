-- SPDX-License-Identifier: GPL-3.0-or-later
-- A rod that lies on something becomes a mesh of elements. The mesh's section is a polygon, wider than the
-- radius over its corners, by 2.7 % of the radius for `radial`: it began that deep, came out at once, and
-- steps made 2.7 % of the energy in play. Now it begins where it only touches, as one that is drawn there.
local sw = require "softworld"

local DENSITY, RADIUS, LENGTH = 1200, 0.004, 0.1
local WEIGHT = 9.81 * DENSITY * math.pi * RADIUS ^ 2 * LENGTH -- [N]

-- A rod on a table at rest; normal: of the table, against gravity.
local function lying(E, normal)
  local gravity = {}
  for k = 1, 3 do gravity[k] = -9.81 * normal[k] end
  local scene = sw.scene{ gravity = gravity }
  local turn = normal[3] == 1 and { 1, 0, 0, 0 } or { axis = { 1, 0, 0 }, angle = -math.pi / 2 }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3, rotation = turn }
  local at = { 0, RADIUS * normal[2], RADIUS * normal[3] }
  local wire = scene:wire{ name = "a", E = E, density = DENSITY, radius = RADIUS, from = at,
    to = { LENGTH, at[2], at[3] }, segments = 10 }
  scene:run{ duration = 0.1 }
  return scene, wire
end

describe("a rod on a table that becomes a mesh of elements", function()
  for _, case in ipairs{ { "radial", 5e6, { 0, 0, 1 } }, { "radial", 5e7, { 0, 1, 0 } },
    { "cubic", 5e6, { 0, 0, 1 } } } do
    it(("presses with its weight: %s, E = %g Pa, normal %g %g %g"):format(case[1], case[2],
      table.unpack(case[3])), function()
      local scene, wire = lying(case[2], case[3])
      wire:remodel{ model = case[1], section = "solid" }
      local start = scene.time
      local run = scene:run{ duration = 0.03, dt = 0.002 }
      assert.is_true(run.ok, run.reason)
      for _, event in ipairs(run.events) do assert.not_equal("energy", event.kind, event.text) end
      -- the section springs by 1 % of the weight at most, as the touches take it over
      assert.near(1, scene:find "table":over(start).peak_force / WEIGHT, 0.02)
    end)
  end

  it("begins at the same place from a file", function()
    local scene, wire = lying(5e6, { 0, 0, 1 })
    wire:remodel{ model = "radial", body = "solid" }
    local path = os.tmpname()
    scene:save(path)
    local other = sw.load(path)
    os.remove(path)
    for _, s in ipairs{ scene, other } do s:run{ duration = 0.004, dt = 0.002 } end
    assert.same(wire:positions(), other:find "a":positions())
  end)
end)
