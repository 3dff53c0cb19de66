-- SPDX-License-Identifier: GPL-3.0-or-later
-- A step asks only obstacles with a motion whether they start, stop or turn. The list of these must survive a
-- snapshot, a file and a second motion: a table that stops at once would otherwise be missed.
local sw = require "softworld"
local t = require "physics.tools"

local R = sw.cable("GXL 1.5").outer_diameter.value / 2

-- A cable lies on a table among others that stand. The table goes and stops at once, twice.
local function scene_of()
  local scene = sw.scene{}
  for i = 1, 20 do scene:obstacle{ shape = "box", size = { 0.01, 0.01, 0.01 }, at = { 0.05 * i, 0.5, 0 } } end
  local table_ = scene:obstacle{ shape = "box", size = { 2, 0.4, 0.1 }, at = { 0, 0, -0.05 }, friction = 0.3 }
  for i = 1, 20 do scene:obstacle{ shape = "sphere", radius = 0.005, at = { 0.05 * i, -0.5, 0 } } end
  scene:wire{ name = "cable", cable = "GXL 1.5", from = { -0.1, 0, R }, to = { 0.1, 0, R }, segments = 20 }
  scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
  return scene, table_
end

local function go(table_, x)
  table_:follow{ relative = true, duration = 0.123, law = "linear", points = { { 0, 0, 0 }, { x, 0, 0 } } }
end

-- Ends of the cable and smallest step of a run of 0.2 s from now.
local function ends(scene)
  local row = t.fine(scene:run{ dt = 0.01, duration = 0.2 })
  local p = scene:find("cable"):positions()
  return { p[1], p[#p - 2] }, row.smallest_dt
end

describe("an obstacle with a motion among others", function()
  it("stops within a step also after a snapshot, in a file, and told a second time", function()
    local scene, table_ = scene_of()
    go(table_, 0.02)
    local before = scene:snapshot()
    local file = os.tmpname()
    scene:save(file)
    local first, least = ends(scene)
    t.below(0.0031, least) -- the stop lies 3 ms into a step
    scene:restore(before)
    assert.same(first, (ends(scene)))
    local loaded = sw.load(file)
    os.remove(file)
    assert.same(first, (ends(loaded)))
    go(table_, -0.02)
    go(loaded:find(table_.name), -0.02)
    local second, again = ends(scene)
    t.below(0.0071, again)
    assert.same(second, (ends(loaded)))
  end)

  it("may be told again before it moved, and removed", function()
    local scene, table_ = scene_of()
    go(table_, 0.05)
    go(table_, 0.02)
    local other, plain = scene_of()
    go(plain, 0.02)
    assert.same((ends(other)), (ends(scene)))
    table_:remove()
    plain:remove()
    assert.same((ends(other)), (ends(scene)))
  end)
end)
