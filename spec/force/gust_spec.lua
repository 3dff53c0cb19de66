-- SPDX-License-Identifier: GPL-3.0-or-later
-- Gusts of wind that are faster than steps.
local sw = require "softworld"

--- A hanging cable in gusts of 8 m/s. Returns the place of its tip [m], the events `coarse` of the wind, and
-- the verdict of a check of its bend radius.
local function blow(frequency, args)
  local scene = sw.scene{}
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.4 }, to = { 0, 0, 0 },
    segments = 40 }
  scene:clamp(wire, { s = 0 })
  scene:force{ kind = "wind", on = wire, velocity = { 0, 3, 0 }, gust = { 0, 8, 0 },
    frequency = frequency }
  scene:force{ kind = "damping", mass = 2, stiffness = 0.001 }
  local run = scene:run{ duration = 1, dt = args.dt, tolerance = args.tolerance }
  assert.is_true(run.ok)
  local told = {}
  for _, e in ipairs(run.events) do
    if e.kind == "coarse" and e.text:find("the force wind", 1, true) then told[#told + 1] = e end
  end
  local check = run:check{ use = "movement", trial = true,
    limits = { ["w.min_bend_radius"] = { min = 0.5 }, ["w.max_sidewall"] = false } }
  return wire:position(0.4)[2], told, check:row"w.min_bend_radius".verdict
end

describe("gusts of wind", function()
  it("faster than the steps are told, and no check passes on them", function()
    for _, dt in ipairs{ 0.01, 0.02 } do
      local _, told, verdict = blow(100, { dt = dt })
      assert.equal(1, #told)
      assert.equal("w", told[1].object)
      assert.truthy(told[1].text:find("wind on 'w', which changes with a period of 10 ms", 1, true),
        told[1].text)
      assert.truthy(told[1].text:find("dt = 0.001 s", 1, true), told[1].text)
      assert.is_true(verdict ~= "PASS")
    end
  end)

  it("that steps follow are not told", function()
    for frequency, dt in pairs{ [100] = 0.001, [5] = 0.02 } do
      local _, told = blow(frequency, { dt = dt })
      assert.equal(0, #told)
    end
  end)

  it("are followed by steps with a tolerance", function()
    local right = blow(100, { dt = 0.0005 })
    local place, told = blow(100, { tolerance = 1e-5 })
    assert.equal(0, #told)
    assert.near(right, place, 0.02 * right)
  end)
end)
