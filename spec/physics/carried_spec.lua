-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that nothing holds has no place of rest under gravity: no force balances its weight. Poses and
-- settle name it. Continuation used to go on until its iterations were spent.
local sw = require "softworld"
local t = require "spec.physics.tools"

local POSES = { duration = 0.1, dt = 0.05, quasistatic = true }
local HELD = { cable = "GXL 1.5", segments = 20, from = { 0, 1, 0.3 }, to = { 0.3, 1, 0.3 } }

local function scene_with(cable)
  local scene = sw.scene {}
  local wire = scene:wire { name = "loose", cable = cable, segments = 20, from = { 0, 0, 0.3 },
    to = { 0.3, 0, 0.3 } }
  return scene, wire
end

-- Without the words a run failed by its limit of 4000 iterations.
local function is_told(result)
  assert.is_false(result.ok)
  assert.truthy(result.reason:find("wire 'loose', which nothing holds, is carried away", 1, true),
    result.reason)
end

describe("a wire that nothing holds", function()
  for _, cable in ipairs { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it("is named by poses after its clamp is released, " .. cable, function()
      local scene, wire = scene_with(cable)
      local clamp = scene:clamp(wire, { s = 0 })
      t.fine(scene:run(POSES))
      t.near(wire.beam.mass_per_length * wire.length * 9.81, clamp:force()[3], 1e-6, "weight")
      clamp:release()
      local run = scene:run(POSES)
      is_told(run)
      assert.truthy(run.reason:find("try a clamp", 1, true), run.reason)
    end)
  end

  it("is named by settle, and beside a wire that is held", function()
    local scene = scene_with "GXL 1.5"
    scene:clamp(scene:wire(HELD), { s = 0 })
    is_told(scene:settle())
    is_told(scene:run(POSES))
  end)

  it("is carried by a table below it, as before", function()
    local scene, wire = scene_with "GXL 1.5"
    local clamp = scene:clamp(wire, { s = 0 })
    local floor = scene:obstacle { shape = "plane", friction = 0.3 }
    t.fine(scene:run(POSES))
    clamp:release()
    t.fine(scene:run(POSES))
    t.near(wire.beam.mass_per_length * wire.length * 9.81, -floor:force()[3], 1e-5, "weight")
  end)
end)
