-- SPDX-License-Identifier: GPL-3.0-or-later
-- The places inside a segment that are nearer to a shape than its ends.
local core = require "softworld.core"
local tools = require "shape.tools"

local near = tools.near

local FAR = 10 -- reach that finds everything [m]

local function check_contact(shape, a, b, c, text)
  near(1, tools.norm(c.normal), 1e-9, text .. " unit normal")
  assert.is_true(c.at > 0 and c.at < 1, text)
  local p = tools.lerp(a, b, c.at)
  local off = tools.dot(c.normal, tools.sub(p, c.point)) - c.gap
  near(0, off, 1e-7, text .. " gap along the normal")
  if c.gap > 0 then
    local gap = shape:distance(p)
    assert.is_true(c.gap >= gap - 1e-8 and c.gap <= gap * 1.002 + 1e-8,
      ("%s: contact gap %.9g, distance %.9g"):format(text, c.gap, gap))
  end
end

describe("segment", function()
  it("finds the nearest place that dense sampling finds, for every kind", function()
    local random = tools.random(41)
    for _, shape in ipairs(tools.every_kind()) do
      local found = 0
      for _ = 1, 400 do
        local a, b = random.vector(1), random.vector(1)
        local least, where = tools.smallest_gap(shape, a, b, 100)
        local contacts = shape:segment(a, b, FAR)
        for _, c in ipairs(contacts) do check_contact(shape, a, b, c, shape:kind()) end
        local ends = math.min(shape:distance(a), (shape:distance(b)))
        if where > 0 and where < 1 and least < ends - 1e-3 and least > 0 then
          found = found + 1
          assert.is_true(#contacts > 0, shape:kind() .. ": contact missed")
          assert.is_true(contacts[1].gap <= least + 1e-9, shape:kind())
          assert.is_true(contacts[1].gap > least - 0.02, shape:kind())
        end
      end
      assert.is_true(found > 40 or shape:kind() == "plane", shape:kind() .. " " .. found)
    end
  end)

  it("has no contact when the nearest place is an end, for convex kinds", function()
    local random = tools.random(42)
    local kinds = core.registry().shapes
    for i, shape in ipairs(tools.every_kind()) do
      for _ = 1, 300 do
        local a, b = random.vector(1), random.vector(1)
        local _, where = tools.smallest_gap(shape, a, b, 200)
        if kinds[i].convex and not kinds[i].listed and (where == 0 or where == 1) then
          local contacts = shape:segment(a, b, FAR)
          -- a minimum within half a sample of the end is allowed
          for _, c in ipairs(contacts) do
            assert.is_true(c.at < 0.005 or c.at > 0.995, shape:kind() .. " " .. c.at)
          end
        end
      end
    end
  end)

  it("has no contact for a segment lying flat, along an axis, or without length", function()
    local flat = {
      { { shape = "plane" }, { 0, 0, 0.01 }, { 1, 0, 0.01 } },
      { { shape = "box", size = { 1, 1, 1 } }, { -0.2, 0.1, 0.51 }, { 0.3, 0.1, 0.51 } },
      { { shape = "cylinder", radius = 0.5, length = 1 }, { 0.51, 0, -0.2 }, { 0.51, 0, 0.3 } },
      { { shape = "capsule", radius = 0.5, length = 1 }, { 0.51, 0, -0.2 }, { 0.51, 0, 0.3 } },
      { { shape = "sphere", radius = 1 }, { 0, 0, 1.1 }, { 0, 0, 1.1 } },
      { { shape = "hull", points = tools.box_points(1, 1, 1) }, { -0.2, 0.1, 0.51 },
        { 0.3, 0.1, 0.51 } },
    }
    for _, case in ipairs(flat) do
      assert.same({}, core.shape(case[1]):segment(case[2], case[3], FAR))
    end
    local sheet = tools.mesh({ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, { { 1, 2, 3 }, { 1, 3, 4 } })
    assert.same({}, sheet:segment({ 0.1, 0.5, 0.01 }, { 0.9, 0.4, 0.01 }, FAR))
  end)

  it("touches both edges of a face that it bridges", function()
    local wall = core.shape { shape = "box", size = { 0.01, 1, 0.1 } }
    local hull = core.shape { shape = "hull", points = tools.box_points(0.01, 1, 0.1) }
    for _, tilt in ipairs { 0, 1e-9, 1e-4, -1e-3 } do
      for _, shape in ipairs { wall, hull } do
        local contacts = shape:segment({ -0.02, 0, 0.051 - tilt }, { 0.03, 0, 0.051 + tilt }, 0.005)
        assert.equal(2, #contacts, shape:kind() .. " tilt " .. tilt)
        table.sort(contacts, function(one, two) return one.at < two.at end)
        near(0.3, contacts[1].at, 2e-3)
        near(0.5, contacts[2].at, 2e-3)
        near(0.001, contacts[1].gap, 2 * math.abs(tilt) + 1e-12)
        near(1, contacts[1].normal[3], 0.01)
      end
    end
  end)

  it("touches both ends of a roller or peg that it lies along, and both rims of a disc", function()
    local cases = {
      { { shape = "cylinder", radius = 0.02, length = 0.01 }, { 0.021, 0, 0 }, { 0, 0, 1 } },
      { { shape = "capsule", radius = 0.02, length = 0.01 }, { 0.021, 0, 0 }, { 0, 0, 1 } },
      { { shape = "cylinder", radius = 0.005, length = 0.02 }, { 0, 0, 0.011 }, { 0.6, 0.8, 0 } },
    }
    for _, case in ipairs(cases) do
      local shape = core.shape(case[1])
      local a = tools.sub(case[2], tools.scale(case[3], 0.02))
      local b = tools.add(case[2], tools.scale(case[3], 0.03))
      local contacts = shape:segment(a, b, 0.005)
      assert.equal(2, #contacts)
      table.sort(contacts, function(one, two) return one.at < two.at end)
      near(0.3, contacts[1].at, 1e-6)
      near(0.5, contacts[2].at, 1e-6)
      near(0.001, contacts[1].gap, 1e-12)
      near(0.001, contacts[2].gap, 1e-12)
    end
    -- across the roller there is only one place
    local roller = core.shape { shape = "cylinder", radius = 0.02, length = 0.01 }
    assert.equal(1, #roller:segment({ 0.021, -0.02, 0.001 }, { 0.021, 0.03, 0.001 }, 0.005))
  end)

  it("points outward with a negative gap when an edge cuts through the wire", function()
    local kinds = {
      core.shape { shape = "box", size = { 1, 1, 1 } },
      core.shape { shape = "hull", points = tools.box_points(1, 1, 1) },
      tools.mesh(tools.box_triangles(1, 1, 1)),
    }
    for _, shape in ipairs(kinds) do
      for _, depth in ipairs { 1e-6, 1e-4, 0.01, 0.05 } do
        -- across the edge x = z = 0.5, perpendicular to its bisector, `depth` below it
        local c = 0.5 - depth / math.sqrt(2)
        local a, b = { c - 0.3, 0.05, c + 0.3 }, { c + 0.3, 0.07, c - 0.3 }
        local contacts = shape:segment(a, b, 0.1)
        assert.is_true(#contacts >= 1, shape:kind() .. " " .. depth)
        near(-depth, contacts[1].gap, 0.01 * depth + 1e-9, shape:kind())
        near(math.sqrt(0.5), contacts[1].normal[1], 0.03)
        near(math.sqrt(0.5), contacts[1].normal[3], 0.03)
        near(0.5, contacts[1].at, 0.01)
      end
    end
  end)

  it("passes smoothly from outside to cut", function()
    for _, shape in ipairs { core.shape { shape = "box", size = { 1, 1, 1 } },
      core.shape { shape = "hull", points = tools.box_points(1, 1, 1) } } do
      local before
      for i = 0, 200 do
        local z = 0.52 - 2e-4 * i
        local c = shape:segment({ 0.3, 0, z + 0.21 }, { 0.71, 0.1, z - 0.2 }, 1)[1]
        if before then
          assert.is_true(math.abs(c.gap - before.gap) < 2.1e-4, shape:kind() .. " " .. i)
          assert.is_true(tools.dot(c.normal, before.normal) > 0.999, shape:kind() .. " " .. i)
        end
        before = c
      end
      assert.is_true(before.gap < -0.005)
    end
  end)

  it("does not see edges of a thin plate through the plate", function()
    local plate = tools.mesh(tools.box_triangles(1, 1, 1e-4))
    for _, c in ipairs(plate:segment({ 0.4, 0, -0.00006 }, { 0.6, 0.1, -0.00016 }, 0.01)) do
      assert.is_true(c.gap > 0)
      assert.is_true(c.normal[3] <= 1e-3)
    end
  end)

  it("gives finite numbers through centres and along edges", function()
    local places = { 0, 0.5, -0.5, 0.25, 0.7 }
    local shapes = tools.every_kind()
    shapes[#shapes + 1] = core.shape { shape = "hull", points = tools.box_points(1, 1, 1) }
    shapes[#shapes + 1] = tools.mesh(tools.box_triangles(1, 1, 1))
    local random = tools.random(43)
    local function pick() return places[1 + math.floor((random.number() + 1) / 2 * #places) % #places] end
    for _, shape in ipairs(shapes) do
      for _ = 1, 500 do
        local a, b = { pick(), pick(), pick() }, { pick(), pick(), pick() }
        for _, c in ipairs(shape:segment(a, b, FAR)) do
          assert.is_true(tools.finite(c.gap) and tools.finite(c.at), shape:kind())
          near(1, tools.norm(c.normal), 1e-9, shape:kind())
        end
      end
    end
  end)

  it("reports only contacts within reach", function()
    local box = core.shape { shape = "box", size = { 1, 1, 1 } }
    assert.equal(1, #box:segment({ 0.4, 0, 0.8 }, { 0.8, 0, 0.4 }, 0.15))
    assert.equal(0, #box:segment({ 0.4, 0, 0.8 }, { 0.8, 0, 0.4 }, 0.14))
  end)
end)

describe("hull and its early-out", function()
  it("find what the box finds, at every reach and size", function()
    local random = tools.random(44)
    for _, size in ipairs { 1e-3, 1, 100 } do
      local box = core.shape { shape = "box", size = { size, 0.7 * size, 0.2 * size } }
      local hull = core.shape { shape = "hull",
        points = tools.box_points(size, 0.7 * size, 0.2 * size) }
      for i = 1, 1500 do
        local a = random.vector(size)
        local b = tools.add(a, random.vector(size * (i % 3 == 0 and 0.05 or 1)))
        local reach = size * 10 ^ (3 * random.number() - 3)
        local one = box:segment(a, b, reach)[1]
        local two = hull:segment(a, b, reach)[1]
        if one and one.gap > 0 and one.gap < reach * 0.999 then
          assert.is_not_nil(two, ("size %g reach %g gap %.9g"):format(size, reach, one.gap))
          near(one.gap, two.gap, 1e-9 * size)
        elseif not one and two then
          -- the hull also reports the far edge of a nearly flat face
          -- or an edge that cuts in beside an end that is inside
          local least = tools.smallest_gap(box, a, b, 200)
          assert.is_true(two.gap < 0 and least < 0 or two.gap >= least - 1e-9 * size)
        end
      end
    end
  end)
end)
