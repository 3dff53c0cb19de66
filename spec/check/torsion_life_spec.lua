-- SPDX-License-Identifier: GPL-3.0-or-later
-- Miner's sum counts tension and bending. Where torsion is not small beside them the row is a lower bound.
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A cable hangs from a clamp. Its lower end turns to and fro about its axis, or swings. Returns the row.
local function row_of(o)
  local scene = sw.scene{ name = "axis" }
  local wire = scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0, 0, -0.6 },
    segments = 40 }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.001 }
  scene:clamp(wire, { s = 0 })
  local hand = scene:gripper{ name = "hand" }
  scene:process(function()
    hand:grasp(wire, { s = wire.length })
    if o.slack then hand:move{ by = { o.slack, 0, o.slack }, duration = 0.5 } end
    for _, sign in ipairs{ 1, -2, 1 } do
      hand:rotate{ axis = o.axis, angle = sign * o.angle, duration = 0.5 }
    end
  end)
  local run = t.fine(scene:run{ dt = 0.01, wear = o.wear })
  local curve = { { 1, 1e6 }, { 100, 1e3 } }
  return run:check{ fatigue = { curve = curve, bending = o.wear and { { 1, 1e9 }, { 100, 1e3 } } or nil,
    source = "a test" } }:row "wire.fatigue"
end

describe("fatigue of a wire that is twisted", function()
  it("is a lower bound that names the torsion", function()
    for _, wear in ipairs{ true, false } do
      local row = row_of{ axis = { 0, 0, 1 }, angle = math.pi, wear = wear }
      assert.equal("OPEN", row.verdict)
      assert.matches("torsion of up to 5%.3%d rad/m is not counted", row.note)
    end
  end)

  -- The second one is pushed while it hangs straight: event `buckling`.
  it("is as before where torsion is small", function()
    for _, o in ipairs{ { axis = { 0, 0, 1 }, angle = 0.2, wear = true, verdict = "PASS" },
      { axis = { 0, 1, 0 }, angle = 0.5, wear = true, slack = 0.1, verdict = "OPEN" } } do
      local row = row_of(o)
      assert.equal(o.verdict, row.verdict)
      assert.is_nil(row.note:find("torsion", 1, true))
    end
  end)
end)
