-- SPDX-License-Identifier: GPL-3.0-or-later
-- core.frames_press: how lines are pressed, from stored frames, by which a run chooses meshes. Compared
-- with weight, pads and T/R, for any nodes and orientation.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = require "softworld.core"
local capstan = require "spec.check.capstan"

local PLACE = 0.1 -- nodes count as pressed from this share of a frame's largest load on

-- Rows { load [N/m], load from both sides [N/m], first node, last node, nodes } of frames from start on,
-- without the places { middle, half length, ... } [m].
local function rows_of(scene, start, but)
  local flat, rows = core.frames_press(scene, 1, start or 0, PLACE, but or {}), {}
  for i = 1, #flat, 5 do rows[#rows + 1] = { table.unpack(flat, i, i + 4) } end
  return rows
end

local function last_of(scene, but)
  local rows = rows_of(scene, 0, but)
  return rows[#rows]
end

local function near(wanted, value, share, what)
  print(("measured: %s %.5g of %.5g"):format(what, value, wanted))
  assert.is_near(wanted, value, share * wanted, what)
end

describe("frames of a wire on a table", function()
  local weight = 0.05 * 9.81 -- [N/m]

  local function lying(segments, angle)
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    scene:wire{ EA = 1e4, EI = 1e-3, mass_per_length = 0.05, radius = 0.003, from = { 0, 0, 0.003 },
      to = { 0.4 * math.cos(angle), 0.4 * math.sin(angle), 0.003 }, segments = segments }
    assert(scene:settle().ok)
    scene:run{ duration = 0.1, dt = 0.01, frame = 0.02 }
    return scene
  end

  for _, case in ipairs{ { 20, 0 }, { 33, 0.7 }, { 80, -2 } } do
    it(("tell its weight for each metre, %d edges, turned by %g"):format(case[1], case[2]), function()
      local scene, n = lying(case[1], case[2]), case[1]
      local row = last_of(scene)
      near(weight, row[1], 0.03, "load") -- a stiff end bears a little less, its neighbour more
      assert.same({ 0, 0, n, n + 1 }, { row[2], row[3], row[4], row[5] })
      assert.equal(#core.frame_times(scene), #rows_of(scene))
      assert.equal(3, #rows_of(scene, 0.05)) -- at 0.06, 0.08 and 0.1 s
      assert.equal(0, #rows_of(scene, 0.2))
    end)
  end

  it("leave out given places, with an edge and a half beside them", function()
    local scene = lying(40, 0) -- edges of 10 mm
    local row = last_of(scene, { 0, 0.102, 0.4, 0.05 })
    assert.same({ 12, 33, 41 }, { row[3], row[4], row[5] })
    near(weight, row[1], 0.01, "load")
    assert.is_nil(last_of(scene, { 0.2, 0.2 })) -- the whole wire
  end)

  it("give no rows where nothing touches the wire", function()
    local scene = sw.scene{}
    local wire = scene:wire{ EA = 1e4, EI = 1e-3, mass_per_length = 0.05, radius = 0.003, from = { 0, 0, 1 },
      to = { 0.4, 0, 1 }, segments = 20 }
    scene:clamp(wire, { s = 0 })
    scene:run{ duration = 0.1, dt = 0.01 }
    assert.same({}, rows_of(scene))
  end)
end)

describe("frames of a wire between pads", function()
  -- Each of two pads of width b presses with F: 2 F / b from both sides, on the nodes from s - b/2 to s +
  -- b/2.
  local F, b, s = 2, 0.02, 0.05

  local function gripped(segments, axis, table_below)
    local scene = sw.scene{ gravity = table_below and { 0, 0, -9.81 } or { 0, 0, 0 } }
    local from = { 0, 0, 0.003 }
    local wire = scene:wire{ E = 1e7, density = 1200, radius = 0.003, from = from, segments = segments,
      to = { 0.12 * axis[1], 0.12 * axis[2], 0.003 + 0.12 * axis[3] } }
    if table_below then scene:obstacle{ shape = "plane", friction = 0.3 } end
    scene:force{ kind = "damping", on = wire, mass = 30 }
    if not table_below then scene:clamp(wire, { s = 0 }) end
    local hand = scene:gripper{ name = "hand", pads = { width = b, friction = 0.3, opening = 0.009 } }
    scene:process(function(p)
      hand:grasp(wire, { s = s, approach = "plates", force = F })
      p:wait(0.2)
    end)
    scene:run{ dt = 0.005, frame = 0.05 }
    return scene
  end

  for name, axis in pairs{ ["along x"] = { 1, 0, 0 }, ["turned"] = { 0.6, 0.8, 0 } } do
    it("give 2 F / b from both sides, at the pads, " .. name, function()
      for _, n in ipairs{ 60, 120 } do -- pads end at nodes
        local row, edge = last_of(gripped(n, axis)), 0.12 / n
        near(2 * F / b, row[1], 0.01, "load") -- nodes at the pads' ends bear half an edge
        near(2 * F / b, row[2], 0.01, "from both sides")
        assert.same({ (s - b / 2) / edge, (s + b / 2) / edge, n + 1 },
          { row[3] + 0.0, row[4] + 0.0, row[5] + 0.0 })
      end
      local row, edge = last_of(gripped(47, axis)), 0.12 / 47 -- pads end between nodes
      near(2 * F / b, row[2], 0.05, "from both sides")
      assert.is_near(s - b / 2, row[3] * edge, 1.01 * edge)
      assert.is_near(s + b / 2, row[4] * edge, 1.01 * edge)
    end)
  end

  it("give the other loads where the pads are left out", function()
    local scene = gripped(60, { 1, 0, 0 }, true)
    near(2 * F / b, last_of(scene)[2], 0.01, "from both sides")
    local row = last_of(scene, { s, b / 2 })
    near(1200 * math.pi * 0.003 ^ 2 * 9.81, row[1], 0.03, "load beside")
    assert.equal(0, row[2])
  end)
end)

describe("frames of a wire round a cylinder", function()
  it("give T/R, from one side, over its arc", function()
    local angle, n = 2 * math.pi / 3, 200
    local scene, wire = capstan.scene{ friction = 0, angle = angle, segments = n }
    scene:run{ duration = 0.5, dt = 0.005, frame = 0.1 }
    local row, Rw = last_of(scene), capstan.R + capstan.RADIUS
    near(1 / Rw, row[1], 0.06, "load") -- chords turn by too much and by too little in turn
    assert.equal(0, row[2])
    assert.is_near(angle * Rw, (row[4] - row[3]) * wire.length / n, 2 * wire.length / n)
  end)
end)

describe("frames_press", function()
  it("refuses wrong arguments, naming them", function()
    local scene = sw.scene{}
    scene:wire{ EA = 1e4, EI = 1e-3, mass_per_length = 0.05, radius = 0.003, from = { 0, 0, 1 },
      to = { 0.4, 0, 1 } }
    assert.error_matches(function() core.frames_press(scene, 1, "soon", PLACE, {}) end, "frames_press: start")
    assert.error_matches(function() core.frames_press(scene, 1, 0, {}, {}) end, "frames_press: place")
    assert.has_error(function() core.frames_press(scene, 2, 0, PLACE, {}) end)
    assert.has_error(function() core.frames_press(scene, 1, 0, PLACE, { "here", 1 }) end)
    assert.has_error(function() core.frames_press(scene, 1, 0, PLACE) end)
  end)
end)
