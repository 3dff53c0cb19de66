-- SPDX-License-Identifier: GPL-3.0-or-later
-- Moving segments: none gets through a shape, and none is reported without a hit.
local core = require "softworld.core"
local tools = require "shape.tools"

local function walls(thickness)
  return {
    core.shape { shape = "box", size = { 0.4, 0.4, thickness } },
    core.shape { shape = "hull", points = tools.box_points(0.4, 0.4, thickness) },
    tools.mesh(tools.box_triangles(0.4, 0.4, thickness)),
  }
end

local function sheet()
  return tools.mesh({ -0.2, -0.2, 0, 0.2, -0.2, 0, 0, 0.2, 0 }, { { 1, 2, 3 } })
end

describe("sweep", function()
  it("stops segments at thin walls at every speed and angle", function()
    local random = tools.random(51)
    local shapes = { sheet() }
    for _, thickness in ipairs { 0.01, 1e-4 } do
      for _, shape in ipairs(walls(thickness)) do shapes[#shapes + 1] = shape end
    end
    for _, shape in ipairs(shapes) do
      for i = 1, 300 do
        -- some point of the segment passes through some point of the wall
        local through = { 0.05 * random.number(), 0.05 * random.number(), 0 }
        local speed = 10 ^ (3 * random.number()) -- way in one step [m]
        local length = i % 2 == 0 and 0.05 or 3
        local along = random.vector(1)
        along = tools.scale(along, length / tools.norm(along))
        local way = random.vector(1)
        if math.abs(way[3]) < 0.01 then way[3] = 0.01 end
        way = tools.scale(way, speed / tools.norm(way))
        local share = 0.5 + 0.49 * random.number()
        local start = tools.sub(through, tools.scale(way, 0.5))
        local a0 = tools.sub(start, tools.scale(along, share))
        local b0 = tools.add(a0, along)
        if tools.smallest_gap(shape, a0, b0, 200) > 2e-3 + length / 400 then
          local when, c = shape:sweep(a0, b0, tools.add(a0, way), tools.add(b0, way), 1e-3)
          assert.is_not_nil(when, ("%s went through (case %d)"):format(shape:kind(), i))
          assert.is_true(when >= 0 and when <= 0.5 + 1e-9)
          assert.is_true(math.abs(c.gap - 1e-3) < 1e-6 * (1 + speed), "gap " .. c.gap)
        end
      end
    end
  end)

  it("stops turning segments and those whose ends are both far away", function()
    for _, shape in ipairs { sheet(), table.unpack(walls(0.01)) } do
      -- ends swap sides by turning: only the middle is ever near
      assert.is_not_nil(shape:sweep({ -2, 0, 0.3 }, { 2, 0, 0.3 }, { -2, 0.1, -0.3 },
        { 2, -0.1, -0.3 }, 0))
      -- a scissor: one end stays, the other sweeps through
      assert.is_not_nil(shape:sweep({ 0.5, 0, 0.2 }, { -0.5, 0, 0.4 }, { 0.5, 0, 0.2 },
        { -0.5, 0, -3 }, 0))
    end
  end)

  it("reports the moment of first nearness for every kind, as fine steps show", function()
    local random = tools.random(52)
    for _, shape in ipairs(tools.every_kind()) do
      local hits = 0
      for _ = 1, 120 do
        local a0 = random.vector(1.3)
        local b0 = tools.add(a0, random.vector(0.5))
        local a1 = random.vector(1.3)
        local b1 = tools.add(a1, random.vector(0.5))
        local margin = 0.02
        if tools.smallest_gap(shape, a0, b0, 20) > margin + 0.05 then
          local when, c = shape:sweep(a0, b0, a1, b1, margin)
          local last = when and when * 0.999 or 1
          for i = 0, 40 do
            local t = last * i / 40
            local gap = tools.smallest_gap(shape, tools.lerp(a0, a1, t), tools.lerp(b0, b1, t), 15)
            assert.is_true(gap > margin - 1e-8,
              ("%s: gap %.9g at %g before %s"):format(shape:kind(), gap, t, when))
          end
          if when then
            hits = hits + 1
            local p = tools.lerp(tools.lerp(a0, a1, when), tools.lerp(b0, b1, when), c.at)
            assert.is_true(math.abs(shape:distance(p) - margin) < 1e-7, shape:kind())
            assert.is_true(math.abs(tools.norm(c.normal) - 1) < 1e-9)
          end
        end
      end
      assert.is_true(hits > 8, shape:kind() .. " " .. hits)
    end
  end)

  it("reports nothing for segments that pass by or slide along", function()
    for _, shape in ipairs(walls(0.01)) do
      local top = 0.005
      -- sliding 1 um above the margin, far and fast
      assert.is_nil(shape:sweep({ -5, 0, top + 1.001e-3 }, { -4.9, 0, top + 1.001e-3 },
        { 5, 0, top + 1.001e-3 }, { 5.1, 0, top + 1.001e-3 }, 1e-3))
      -- away
      assert.is_nil(shape:sweep({ 0, 0, 0.1 }, { 0.1, 0, 0.1 }, { 0, 0, 7 }, { 0.1, 0, 7 }, 1e-3))
      -- at rest
      assert.is_nil(shape:sweep({ 0, 0, 0.1 }, { 0.1, 0, 0.1 }, { 0, 0, 0.1 }, { 0.1, 0, 0.1 }, 1))
    end
  end)

  it("reports segments that start within the margin only if they get deeper", function()
    local shapes = walls(0.01)
    shapes[#shapes + 1] = core.shape { shape = "plane" }
    shapes[#shapes + 1] = core.shape { shape = "cylinder", radius = 1, length = 0.01 }
    for _, shape in ipairs(shapes) do
      local top = shape:kind() == "plane" and 0 or 0.005
      for _, height in ipairs { 5e-4, 1e-5, 0 } do
        local z = top + height
        local a, b = { -0.05, 0, z }, { 0.05, 0, z }
        local function go(dx, dz)
          return (shape:sweep(a, b, tools.add(a, { dx, 0, dz }), tools.add(b, { dx, 0, dz }), 1e-3))
        end
        assert.is_nil(go(0.02, 0), shape:kind() .. " sliding at " .. height)
        assert.is_nil(go(0, 0.1), shape:kind() .. " leaving at " .. height)
        assert.is_not_nil(go(0, -1e-6), shape:kind() .. " deeper at " .. height)
        assert.is_not_nil(go(0, -5), shape:kind() .. " crossing at " .. height)
      end
    end
  end)

  it("takes a segment without length as a point", function()
    for _, shape in ipairs { sheet(), table.unpack(walls(1e-4)) } do
      local p, q = { 0.01, 0.02, 30 }, { 0.01, 0.02, -50 }
      local when = shape:sweep(p, p, q, q, 0)
      assert.is_true(math.abs(when - 30 / 80) < 1e-4)
    end
  end)

  it("lets nothing through the seams of a mesh with many triangles", function()
    local shape, random = tools.mesh(tools.ball(0.5, 8, 12)), tools.random(53)
    for _ = 1, 500 do
      local way = random.vector(1)
      way = tools.scale(way, 50 / tools.norm(way))
      local p = tools.sub(random.vector(0.1), tools.scale(way, 0.5))
      assert.is_not_nil(shape:sweep(p, p, tools.add(p, way), tools.add(p, way), 0))
    end
    -- exactly through vertices and along edges
    for _, v in ipairs { { 0, 0, 1 }, { 0, 0, -1 }, { 1, 0, 0 } } do
      local a, b = tools.scale(v, 3), tools.scale(v, -4)
      assert.is_not_nil(shape:sweep(a, a, b, b, 0))
    end
  end)
end)
