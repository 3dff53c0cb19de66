-- SPDX-License-Identifier: GPL-3.0-or-later
-- In poses a mesh of springs that pads squeeze on a table sinks in by as much as it widens: its touches there
-- are as soft as its weight asks for. The push is then up to 22 times too small, or
-- as much too large (GXL 0.5). An event says so.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH = 0.06 -- [m]

-- Returns the push on the table [N] and the events `pressed` of a wire in pads.
local function gripped(o, dt, poses)
  local scene, c, s = sw.scene{}, math.cos(o.turn or 0), math.sin(o.turn or 0)
  local r = sw.cable(o.cable).outer_diameter.value / 2
  local z = r + (o.above or 0)
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 8, stiffness = 1e-3 }
  local wire = scene:wire{ name = "w", cable = o.cable, model = o.model, section = o.section,
    from = { 0, 0, z }, to = { LENGTH * c, LENGTH * s, z } }
  if o.above then
    for _, at in ipairs{ 0, LENGTH } do scene:clamp(wire, { s = at }) end
  end
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.5, opening = 2 * r + 2e-4 } }
  scene:process(function(p)
    hand:grasp(wire, { s = o.s or LENGTH / 2, approach = "plates", force = o.force })
    p:wait(0.1)
  end)
  local run, told = t.fine(scene:run{ dt = dt, quasistatic = poses }), {}
  for _, e in ipairs(run.events) do if e.kind == "pressed" then told[#told + 1] = e end end
  local force = -scene:find("table"):force()[3]
  scene:close()
  return force, told
end

describe("pads that squeeze a mesh on a table, in poses", function()
  for _, o in ipairs{ { cable = "GXL 1.5", model = "tube", force = 2 },
    { cable = "GXL 0.5", model = "radial", force = 1, turn = 0.7, s = 0.02 } } do
    it("tell that it sinks in: " .. o.cable, function()
      local right, none = gripped(o, 0.005, false)
      assert.equal(0, #none)
      for _, dt in ipairs{ 0.05, 0.005 } do
        local force, told = gripped(o, dt, true)
        t.above(2, math.max(right / force, force / right), "factor by which the push is wrong [-]")
        assert.equal(1, #told)
        assert.equal("hand", told[1].object)
        t.above(0, told[1].value, "push told [N]")
        assert.matches("squeeze wire 'w', a mesh of springs, on 'table' .* or a run of motion$", told[1].text)
      end
    end)
  end

  it("tell nothing in the air, or of elements", function()
    for _, o in ipairs{ { cable = "GXL 1.5", model = "tube", force = 2, above = 0.005 },
      { cable = "FLRY-B 2.5", model = "radial", section = "solid", force = 3 } } do
      local _, told = gripped(o, 0.05, true)
      assert.equal(0, #told)
    end
  end)
end)
