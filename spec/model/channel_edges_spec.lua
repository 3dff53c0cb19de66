-- SPDX-License-Identifier: GPL-3.0-or-later
-- Edges that pass the corners of channels: scene:advise, the coarsest level of error bars, levels that jam.
local sw = require "softworld"
local coarsest = require "softworld.run.coarsest"
local narrow = require "softworld.link.narrow"

local R, LEG = 0.0015, 0.3 -- radius of the drawn path's height, length of a channel's leg [m]

-- A wire of n segments in a channel with one corner; its tip is drawn out by a little.
local function drawn(n, width, degrees)
  local scene, a = sw.scene {}, math.rad(degrees)
  local d = { math.cos(a), math.sin(a) }
  scene:channel { name = "duct", points = { { -LEG, 0, 0 }, { 0, 0, 0 }, { 0.28 * d[1], 0.28 * d[2], 0 } },
    width = width, depth = 0.012, friction = 0.3 }
  local path, bend = { { -0.4, 0, R } }, 0.02
  for k = 0, 12 do
    local b = a * k / 12
    path[#path + 1] = { bend * (math.sin(b) - math.tan(a / 2)), bend * (1 - math.cos(b)), R }
  end
  path[#path + 1] = { 0.35 * d[1], 0.35 * d[2], R }
  local wire = scene:wire { name = "w", cable = "GXL 1.5", segments = n, path = path }
  scene:force { kind = "damping", on = wire, mass = 2, stiffness = 0.001 }
  local tip = scene:clamp(wire, { s = wire.length, name = "tip" })
  tip:follow { points = { path[#path], { 0.39 * d[1], 0.39 * d[2], R } }, duration = 0.3 }
  return scene, wire, tip
end

local function force_of(tip)
  return { name = "f", value = 1, unit = "N", of = function() return tip:over(0, 0.3).mean_force end }
end

local function longest(radius, width, degrees)
  return 0.7 * 2 * (width - 2 * radius) / math.sin(math.rad(degrees) / 2)
end

describe("edges of a wire in a channel", function()
  it("have a longest length by the narrowest corner", function()
    local scene, wire = drawn(30, 0.01, 45)
    local edge, name = narrow.edge(scene, wire.radius)
    assert.is_near(longest(wire.radius, 0.01, 45), edge, 1e-12)
    assert.equal("duct", name)
    scene:channel { name = "wide", width = 0.1, depth = 0.1,
      points = { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 } } }
    assert.equal("duct", select(2, narrow.edge(scene, wire.radius)))
    local straight = sw.scene {}
    straight:channel { points = { { 0, 0, 0 }, { 1, 0, 0 } }, width = 0.01, depth = 0.01 }
    assert.equal(math.huge, (narrow.edge(straight, 0.001)))
  end)

  -- Edges of 1.0 to 1.6 of 2 w / sin(a/2) jammed: 20 to 9000 N.
  it("pass the corner without jamming if they are that long", function()
    for _, case in ipairs { { 0.01, 45 }, { 0.006, 45 }, { 0.02, 90 } } do
      local scene, wire = drawn(30, table.unpack(case))
      local n = math.ceil(wire.length / narrow.edge(scene, wire.radius))
      local again, _, tip = drawn(n, table.unpack(case))
      assert.is_true(again:run { duration = 0.3, dt = 0.01 }.ok)
      local pull = tip:over(0, 0.3).peak_force
      assert.is_true(pull < 5, ("%g mm, %d degrees: %g N"):format(1e3 * case[1], case[2], pull))
    end
  end)

  it("are advised by scene:advise", function()
    local scene, wire = drawn(30, 0.006, 45)
    local a = scene:advise {}
    assert.equal(math.ceil(wire.length / longest(wire.radius, 0.006, 45)), a.segments.w)
    assert.equal("edges that pass the corners of 'duct' without jamming", a.segments_why.w)
  end)

  -- The coarsest level had 15 segments, edges of 50 mm: it jammed, with 1000 times the force.
  it("are those of the coarsest level of error bars", function()
    local scene, _, tip = drawn(60, 0.01, 45)
    local run = scene:run { duration = 0.3, tolerance = { force_of(tip) } }
    assert.equal(30, run.levels[1].segments[1])
    assert.is_true(run.quantities.f.error < 0.3, run.quantities.f.error)
  end)

  it("are no part of the bar if they jam and finer ones do not", function()
    local scene, _, tip = drawn(60, 0.01, 45)
    local is_jammed, computed = coarsest.is_jammed, 0
    assert.is_true(is_jammed { events = { { kind = "edges" }, { kind = "breaking" } } })
    assert.is_false(is_jammed { events = { { kind = "edges" } } })
    function coarsest.is_jammed() -- the first level jams
      computed = computed + 1
      return computed == 1
    end
    local fine, run = pcall(scene.run, scene, { duration = 0.3, levels = 4, tolerance = { force_of(tip) } })
    coarsest.is_jammed = is_jammed
    assert(fine, run)
    assert.equal(3, #run.levels)
    assert.equal(2, #run.quantities.f.levels)
  end)
end)
