-- SPDX-License-Identifier: GPL-3.0-or-later
-- A run goes on from a file whose next step of the process first takes a damping away: the ledger has
-- the same bits as without a power cut. What a force lost in the step before its removal is no loss after it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local t = require "spec.physics.tools"

after_each(saving.clean)

-- A cable swings at a pin, damped. Its second step of the process takes the damping away.
local function swing(cable, stops)
  local scene = sw.scene{ name = "swing" }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 30 }
  scene:pin(wire, { s = 0 })
  local damping = scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 0.002 }
  scene:process(function(p)
    p:step("damped", function() p:wait(0.1) end)
    if stops then error "power cut" end
    p:step("free", function()
      scene:remove(damping)
      p:wait(0.1)
    end)
  end)
  return scene
end

local function column(run, name)
  for _, c in ipairs(run:series().columns) do
    if c.name == name then return c.values end
  end
end

describe("the ledger of a resumed run after a force is gone", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it("has the bits of the run without a power cut: " .. cable, function()
      local whole = t.fine(swing(cable):run{ dt = 0.005 })
      local path = saving.temporary()
      pcall(function() swing(cable, true):run{ dt = 0.005, save = path } end)
      local resumed = t.fine(swing(cable):run{ dt = 0.005, save = path, resume = path })
      local a, b = column(whole, "energy.lost"), column(resumed, "energy.lost")
      assert.are.equal(#a, #b)
      for k = 1, #a do assert.are.equal(a[k], b[k]) end
      assert.are.equal(whole:ledger().lost.damping, resumed:ledger().lost.damping)
      t.above(1e-6, whole:ledger().lost.damping, "lost by damping [J]")
    end)
  end
end)
