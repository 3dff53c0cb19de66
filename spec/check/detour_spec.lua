-- SPDX-License-Identifier: GPL-3.0-or-later
-- landing_error of wires that leave out a part of the wanted path. Each place of the wire is then on it.
local sw = require "softworld"

local R = 0.1 -- of circles [m]

-- Returns points of a circle in the plane of the table, from one angle to another [rad].
local function circle(from, to)
  local points, count = {}, 60
  for i = 0, count do
    local a = from + (to - from) * i / count
    points[#points + 1] = { R * math.cos(a), R * math.sin(a), 0 }
  end
  return points
end

-- Returns the row of a wire that lies still along points, with a limit of 5 mm.
local function row_of(points, landing)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-4, GJ = 1e-4, mass_per_length = 0.01,
    radius = 0.001, path = points, rest = "path", segments = 60 }
  scene:clamp(wire, { s = 0 })
  return scene:run{ duration = 0.02, dt = 0.01 }:check{ landing = landing,
    limits = { landing_error = 0.005 } }:row "w.landing_error"
end

local STRAIGHT = { { 0, 0, 0 }, { 0.3, 0, 0 } }
local HAIRPIN = { { 0, 0, 0 }, { 0.15, 0, 0 }, { 0.15, 0.05, 0 }, { 0.152, 0.05, 0 }, { 0.152, 0, 0 },
  { 0.3, 0, 0 } }

describe("the landing error of a wire that leaves out a detour of the path", function()
  -- The wire lies straight, the path has a hairpin of 50 mm in its middle. Going along both, the end of the
  -- hairpin is 50 mm from the wire. It is a corner of the path, so a sample of it: exact.
  it("is open between its own distance and that of the detour", function()
    for _, points in ipairs{ STRAIGHT, { STRAIGHT[2], STRAIGHT[1] } } do
      local row = row_of(points, { path = HAIRPIN })
      assert.is_near(0, row.value, 1e-9)
      assert.is_near(0.05, row.high, 1e-9)
      assert.equal("OPEN", row.verdict)
      assert.truthy(row.note:find("leaves out a detour of the path, 50.00 mm aside", 1, true), row.note)
    end
  end)

  it("is open too for a part of the wire, of which nothing told it", function()
    local row = row_of(STRAIGHT, { path = HAIRPIN, from = 0.05, to = 0.25 })
    assert.is_near(0.05, row.high, 1e-9)
    assert.equal("OPEN", row.verdict)
  end)

  it("passes if the detour is within the limit", function()
    local path = { { 0, 0, 0 }, { 0.15, 0, 0 }, { 0.15, 0.004, 0 }, { 0.15, 0, 0 }, { 0.3, 0, 0 } }
    assert.equal("PASS", row_of(STRAIGHT, { path = path }).verdict)
  end)

  -- These paths are followed in order: they begin before the wire, go on beyond it, are closed with their
  -- seam in the wire, or cross themselves where the wire passes. Chords of 60 edges are 0.14 mm off a circle.
  it("has no range if the path is followed", function()
    local before = { { -0.05, 0, 0 }, { 0.4, 0, 0 }, { 0.4, 0.05, 0 } }
    local eight, half = {}, {}
    for i = 0, 120 do
      local a = 2 * math.pi * i / 120
      eight[#eight + 1] = { R * math.sin(a), R / 2 * math.sin(2 * a), 0 }
      a = a / 2 - 0.8
      half[#half + 1] = { R * math.sin(a), R / 2 * math.sin(2 * a), 0 }
    end
    local whole = circle(0, 2 * math.pi)
    for name, case in pairs{ beyond = { STRAIGHT, before }, ["over the seam"] = { circle(4.5, 8), whole },
      ["back over the seam"] = { circle(8, 4.5), whole }, crossing = { half, eight } } do
      local row = row_of(case[1], { path = case[2] })
      assert.same({ "PASS" }, { row.verdict, row.high }, name)
      assert.truthy(row.note:find("which is not counted", 1, true), name)
    end
  end)
end)
