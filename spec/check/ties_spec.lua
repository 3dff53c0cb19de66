-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of ties: their largest pull as a share of their strength, and error bars of their pull.
local sw = require "softworld"

-- A cable that falls into a tie at its end.
local function fallen(strength, o)
  local scene = sw.scene{ name = "tied" }
  local wire = scene:wire{ name = "cable", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 },
    segments = 12 }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 3e-3 }
  scene:clamp(wire, { s = 0 })
  local tie = scene:tie(wire, { name = "loop", s = 0.3, to = { 0.3, 0, 0.05 }, slack = 0.08,
    strength = strength })
  local options = o or {}
  options.duration = 0.3
  return scene:run(options), tie, scene
end

describe("run:check of a tie", function()
  it("gives the largest pull in the run over the strength", function()
    local run, tie, scene = fallen(80)
    local row = run:check{}:row "loop.strength_used"
    assert.equal("PASS", row.verdict)
    assert.is_true(tie.raw_peak_force > tie.peak_force and tie.peak_force > 0)
    assert.is_near(tie.raw_peak_force / 80, row.value, 1e-12)
    assert.equal(0.3, row.s)
    local strict = run:check{ limits = { strength_used = 0.5 * row.value } }
    assert.equal("FAIL", strict:row "strength_used".verdict)
    assert.same({ "loop.strength_used" },
      run:check{ limits = { ["loop.strength_used"] = false } }.skipped)
    -- the next run counts only its own pulls
    local calm = scene:run{ duration = 0.02 }:check{}:row "strength_used"
    assert.is_true(calm.value < 0.5 * row.value)
  end)

  it("fails where the tie broke, in that run only", function()
    local run, tie, scene = fallen(1)
    assert.equal(1, tie.strength)
    local row = run:check{}:row "loop.strength_used"
    assert.same({ "FAIL", tie.broken.time }, { row.verdict, row.time })
    assert.is_near(tie.broken.force, row.value, 1e-12)
    assert.is_true(row.value >= 1)
    assert.truthy(row.note:find("broke", 1, true))
    assert.is_false(pcall(function()
      return scene:run{ duration = 0.02 }:check{}:row "strength_used"
    end))
  end)

  it("has no row without a strength", function()
    local run = fallen()
    assert.is_false(pcall(function() return run:check{}:row "strength_used" end))
  end)
end)

describe("error bars of a tie", function()
  it("cover its peak force, which exists at every level", function()
    local run, tie = fallen(80, { tolerance = { ["loop.peak_force"] = { relative = 0.2 } }, levels = 3 })
    assert.equal(tie.peak_force, run.quantities["loop.peak_force"].value)
    assert.equal("N", run.quantities["loop.peak_force"].unit)
  end)
end)
