-- SPDX-License-Identifier: GPL-3.0-or-later
-- A bend that is sharp for the wire's edges is known as a range: the row of the bend radius says so, and is
-- open where the limit lies in the range.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"

local LENGTH, FINER = 0.3, 8

after_each(saving.clean)

-- A wire falls on a table.
local function landing(case, segments)
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  local r = sw.cable(case.cable).outer_diameter.value / 2
  local along = LENGTH * math.cos(case.tilt)
  local wire = scene:wire{ name = "a", cable = case.cable, segments = segments,
    from = { 0, 0, r + case.height },
    to = { along, 0, r + case.height + LENGTH * math.sin(case.tilt) } }
  scene:force{ kind = "damping", on = wire, mass = case.damping, stiffness = 0.001 }
  return scene:run{ duration = 0.2, dt = case.dt }, wire, scene
end

-- A wire hangs between two pins: smooth, against its length.
local function hanging(_, segments)
  local scene = sw.scene{}
  local wire = scene:wire{ name = "a", cable = "GXL 1.5", segments = segments, from = { 0, 0, 0 },
    to = { LENGTH, 0, 0 } }
  scene:pin(wire, { s = 0 })
  scene:pin(wire, { s = LENGTH })
  scene:force{ kind = "damping", mass = 20 }
  return scene:run{ duration = 1, dt = 0.01 }, wire, scene
end

-- A cable over a peg.
local function drape(case, segments)
  local scene = sw.scene{}
  scene:obstacle{ shape = "cylinder", radius = case.peg, length = 0.2, at = { 0.52 * LENGTH, 0, 0 },
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 }, friction = 0.5 }
  local z = case.peg + sw.cable(case.cable).outer_diameter.value / 2 + 0.001
  local wire = scene:wire{ name = "a", cable = case.cable, segments = segments,
    from = { 0, 0, z }, to = { LENGTH, 0, z } }
  scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 0.003 }
  return scene:run{ duration = 0.3, dt = 0.005 }, wire, scene
end

local function row_of(run, limit)
  assert.is_true(run.ok, run.reason)
  return run:check{ trial = true, limits = { min_bend_radius = { min = limit, sure = true } } }
    :row "a.min_bend_radius"
end

local cases = {
  { make = landing, cable = "GXL 1.5", segments = 24, height = 0.02, tilt = 0.1, damping = 3, dt = 0.005 },
  { make = landing, cable = "FLRY-B 0.5", segments = 19, height = 5e-3, tilt = 0.03, damping = 2, dt = 0.01 },
  { make = landing, cable = "H07V-K 4", segments = 33, height = 0.03, tilt = 0.15, damping = 4, dt = 0.002 },
  { make = drape, cable = "GXL 1.5", segments = 21, peg = 0.006 },
  { make = drape, cable = "H07V-K 4", segments = 30, peg = 0.02 },
}

describe("the row of a bend radius", function()
  for i, case in ipairs(cases) do
    it("has a range that holds the radius with finer edges, case " .. i, function()
      local run = case.make(case, case.segments)
      local row = row_of(run, 1e-4)
      local fine = row_of(case.make(case, FINER * case.segments), 1e-4)
      assert.is_true(row.low < fine.value and fine.value < row.high)
      assert.truthy(row.note:find("coarse for this bend", 1, true))
      assert.are.equal("PASS", row.verdict)
      assert.are.equal("OPEN", row_of(run, 0.5 * (row.low + row.value)).verdict)
      assert.are.equal("FAIL", row_of(run, 1.01 * row.high).verdict)
    end)
  end

  it("is not given for a straight wire, whose curvature is rounding", function()
    local edges = require "softworld.check.edges"
    for _, length in ipairs { 0.1, 3 } do
      local wire = sw.scene {}:wire { name = "a", cable = "GXL 1.5", segments = 20, from = { 0, 0, 0 },
        to = { length, 0, 0 } }
      local function widened(lengths, uneven)
        return edges.widen({ value = lengths * length, inside = 1e-3,
          sharp = { uneven = uneven, swings = uneven, more = 0, less = 0, round = 0 } }, "low",
          { name = "a", object = wire }, { events = {} })
      end
      for _, uneven in ipairs { 0.1, 1, 50 } do -- from even to zigzag
        assert.is_nil(widened(1e4, uneven).note)
        assert.is_true((widened(1e4, uneven).low or math.huge) >= 1e4 * length)
        assert.matches("are coarse for this bend", widened(100, uneven).note)
        assert.is_true(widened(100, uneven).low < 100 * length)
      end
    end
  end)

  it("is exact for a smooth bend", function()
    local run, wire = hanging(nil, 50)
    local row = row_of(run, 0.1)
    assert.is_nil(row.low)
    assert.is_true(wire:bend_sharpness() < 0.02)
    assert.are.equal("PASS", row_of(run, 0.9999 * row.value).verdict)
  end)

  it("is the same from a file", function()
    local path = saving.temporary()
    local _, wire, scene = landing(cases[1], 24)
    scene:save(path)
    local again = sw.load(path):find "a"
    assert.are.same({ wire:min_bend_radius() }, { again:min_bend_radius() })
    assert.are.same({ wire:bend_sharpness() }, { again:bend_sharpness() })
    assert.is_true(again:bend_sharpness() > 0.02)
  end)
end)
