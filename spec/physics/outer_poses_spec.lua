-- SPDX-License-Identifier: GPL-3.0-or-later
-- The ledger of quasi-static runs: work of forces that have no energy of their own.
local sw = require "softworld"

--- A hanging cable that a force blows aside in poses. Returns the ledger and the gain of energy [J].
local function blow(make)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "FLRY-B 0.5", from = { 0, 0, 0.3 }, to = { 0, 0, 0 }, segments = 40 }
  scene:clamp(wire, { s = 0 })
  local begin = scene:energy().total
  make(scene, wire)
  local run = scene:run{ dt = 0.1, duration = 2.4, quasistatic = true }
  assert.is_true(run.ok)
  for _, e in ipairs(run.events) do assert.is_true(e.kind ~= "energy", e.text) end
  return run:ledger(), scene:energy().total - begin
end

describe("the ledger of poses", function()
  it("counts the work of wind that grows", function()
    local ledger, stored = blow(function(scene, wire)
      local wind = scene:force{ kind = "wind", on = wire, velocity = { 0, 0, 0 } }
      scene:process(function(p)
        for i = 1, 24 do
          wind:set{ velocity = { 0, 0.5 * i, 0 } }
          p:wait(0.1)
        end
      end)
    end)
    assert.near(stored, ledger.work.forces, 0.1 * stored)
    assert.is_true(ledger.gap < 1e-3 * stored)
  end)

  it("counts the work of a function that grows", function()
    local ledger, stored = blow(function(scene, wire)
      scene:force{ on = wire, kind = function(t, _, _, f) f[#f - 1] = f[#f - 1] + 0.01 * t end }
    end)
    assert.near(stored, ledger.work.forces, 0.02 * stored)
    assert.is_true(ledger.gap < 1e-3 * stored)
  end)
end)
