-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that begins deep inside an obstacle, by a mistake in the script, is thrown out of it. The force of
-- that presses its section flat, so the choice made a mesh of the whole wire: 13,000 particles, no result in
-- 400 s. Now no mesh is made, and the run says that it is not met, and why.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

-- The cable hangs from its left end; the top of the plane is at `height` [m].
local function hung(height)
  local scene = sw.scene{ name = "inside" }
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.4, 0, 0.1 },
    segments = 20, model = "auto" }
  scene:clamp(wire, { s = 0, name = "left" })
  scene:obstacle{ name = "floor", shape = "plane", at = { 0, 0, height } }
  local run = scene:run{ duration = 0.5, progress = false,
    tolerance = { ["left.force"] = { relative = 0.1 }, ["w.tip"] = 0.002 } }
  return scene, run
end

describe("a choice of the model for a wire that begins inside an obstacle", function()
  it("keeps the section round, and says that the run is not met because the wire is inside", function()
    local scene <close>, run = hung(0.2)
    assert.equal("round", run.model.section)
    assert.is_false(run.met)
    local why = tostring(run:why())
    assert.is_true(why:find("NOT enough: 'w' begins inside 'floor'", 1, true) ~= nil, why)
    assert.is_true(scene.time == run.time)
  end)

  it("says nothing of the kind if the wire is outside", function()
    local scene <close>, run = hung(-1)
    assert.is_nil(tostring(run:why()):find("begins inside", 1, true))
    assert.is_true(scene.time == run.time)
  end)
end)
