-- SPDX-License-Identifier: GPL-3.0-or-later
-- Limits of 0: a value that differs from 0 by rounding passes; one that is beyond by more than 1e-12 of its
-- own size fails.
local sw = require "softworld"

-- A straight wire that lies `above` over the top of a zone, without load. Its gap is -1.3e-17 m by rounding.
local function checked(above)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local z = 0.13 + 0.05 + 0.0015 + above
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", segments = 4, from = { 0, 0, z },
    to = { 0.2, 0, z } }
  for _, s in ipairs{ 0, 0.05, 0.1, 0.15, 0.2 } do scene:clamp(wire, { s = s }) end
  scene:zone{ name = "post", shape = "box", size = { 1, 1, 0.1 }, at = { 0.1, 0, 0.13 } }
  return scene:run{ duration = 0.01, dt = 0.005 }:check{}
end

describe("run:check of a wire that touches a zone", function()
  it("passes, although its gap is below 0 by rounding", function()
    local row = checked(0):row "clearance"
    assert.is_true(row.value < 0 and row.value > -1e-16, row.value)
    assert.same({ 0, "PASS", 0 }, { row.limit, row.verdict, row.margin })
  end)

  it("fails if it is in the zone by 1e-12 of the wire's place", function()
    local row = checked(-1e-12 * 0.2):row "clearance"
    assert.is_near(-2e-13, row.value, 1e-16)
    assert.equal("FAIL", row.verdict)
    assert.is_near(-2e-13, row.margin, 1e-16)
  end)
end)

describe("run:check of a wire without load, with limits of 0,", function()
  local names = { "max_strain", "max_stress", "max_tension", "penetration", "landing_error" }

  it("passes, although some values are above 0 by rounding", function()
    local limits, above = {}, 0
    for _, name in ipairs(names) do limits[name] = { max = 0, sure = true } end
    local scene, from, to = sw.scene{ gravity = { 0, 0, 0 } }, { 0.1, 0.2, 0.3 }, { 0.22, 0.36, 0.3 }
    local wire = scene:wire{ cable = "GXL 1.5", segments = 8, from = from, to = to }
    for _, s in ipairs{ 0, 0.05, 0.2 } do scene:clamp(wire, { s = s }) end
    scene:obstacle{ shape = "plane", at = { 0, 0, -1 } }
    local check = scene:run{ duration = 0.01, dt = 0.005 }:check{ limits = limits,
      landing = { path = { from, to } } }
    for _, name in ipairs(names) do
      local row = check:row(name)
      if row.value > 0 then above = above + 1 end
      assert.same({ name, 0, "PASS", 0 }, { name, row.limit, row.verdict, row.margin })
    end
    assert.is_true(above >= 3, above)
  end)

  it("fails at a strain of 1e-12", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ cable = "GXL 1.5", segments = 2, from = { 0, 0, 0 }, to = { 0.25, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    local way = { { 0, 0, 0 }, { 1e-12 * 0.25, 0, 0 } }
    scene:clamp(wire, { s = 0.25 }):follow{ points = way, times = { 0, 0.01 },
      relative = true }
    local run = scene:run{ duration = 0.02, dt = 0.005, quasistatic = true }
    local check = run:check{ limits = { max_strain = { max = 0, sure = true },
      max_tension = { max = 0, sure = true } } }
    assert.is_near(1e-12, check:row "max_strain".value, 1e-14)
    assert.equal("FAIL", check:row "max_strain".verdict)
    assert.is_near(1e-12 * wire.beam.EA, check:row "max_tension".value, 1e-14 * wire.beam.EA)
    assert.equal("FAIL", check:row "max_tension".verdict)
  end)
end)
