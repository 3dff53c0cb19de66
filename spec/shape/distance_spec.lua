-- SPDX-License-Identifier: GPL-3.0-or-later
-- Points against every kind of shape.
local core = require "softworld.core"
local tools = require "shape.tools"

local near = tools.near

describe("point distance", function()
  it("gives the known values of simple places", function()
    local cases = {
      { { shape = "plane" }, { 3, 4, 0.25 }, 0.25, { 0, 0, 1 } },
      { { shape = "plane", normal = { 2, 0, 0 } }, { -3, 4, 5 }, -3, { 1, 0, 0 } },
      { { shape = "sphere", radius = 0.5 }, { 0, 2, 0 }, 1.5, { 0, 1, 0 } },
      { { shape = "sphere", radius = 0.5 }, { 0, 0.1, 0 }, -0.4, { 0, 1, 0 } },
      { { shape = "capsule", radius = 0.1, length = 2 }, { 0.3, 0, 0.9 }, 0.2, { 1, 0, 0 } },
      { { shape = "capsule", radius = 0.1, length = 2 }, { 0, 0, 1.5 }, 0.4, { 0, 0, 1 } },
      { { shape = "box", size = { 2, 2, 2 } }, { 4, 5, 1 }, 5, { 0.6, 0.8, 0 } },
      { { shape = "box", size = { 2, 2, 2 } }, { 0.2, -0.9, 0.3 }, -0.1, { 0, -1, 0 } },
      { { shape = "cylinder", radius = 1, length = 2 }, { 4, 0, 5 }, 5, { 0.6, 0, 0.8 } },
      { { shape = "cylinder", radius = 1, length = 2 }, { 0.2, 0, -0.9 }, -0.1, { 0, 0, -1 } },
      { { shape = "cylinder", radius = 1, length = 4 }, { 0, 0.9, 0.5 }, -0.1, { 0, 1, 0 } },
    }
    for i, case in ipairs(cases) do
      local gap, normal = core.shape(case[1]):distance(case[2])
      near(case[3], gap, 1e-14, "gap " .. i)
      for k = 1, 3 do near(case[4][k], normal[k], 1e-14, "normal " .. i) end
    end
  end)

  it("has unit outward normals that are the distance's gradient, and points on the surface", function()
    local random, step = tools.random(11), 1e-6
    for _, shape in ipairs(tools.every_kind()) do
      local rough = 0
      for _ = 1, 1500 do
        local p = random.vector(0.9)
        local gap, normal, point = shape:distance(p)
        near(1, tools.norm(normal), 1e-12, shape:kind() .. " unit normal")
        near(0, shape:distance(point), 1e-12, shape:kind() .. " point on the surface")
        near(math.abs(gap), tools.norm(tools.sub(p, point)), 1e-12, shape:kind() .. " gap to point")
        for k = 1, 3 do
          local e = { 0, 0, 0 }
          e[k] = step
          local slope = (shape:distance(tools.add(p, e)) - shape:distance(tools.sub(p, e))) / 2 / step
          if math.abs(slope - normal[k]) > 1e-4 then rough = rough + 1 end
        end
      end
      -- only where the step straddles a place with two nearest faces
      assert.is_true(rough <= 6, shape:kind() .. ": " .. rough .. " gradients differ")
    end
  end)

  it("never changes faster than the point moves, nor jumps", function()
    local random = tools.random(12)
    for _, shape in ipairs(tools.every_kind()) do
      for _ = 1, 2000 do
        local p, step = random.vector(0.9), random.vector(0.02)
        local change = shape:distance(tools.add(p, step)) - shape:distance(p)
        assert.is_true(math.abs(change) <= tools.norm(step) + 1e-12, shape:kind())
      end
    end
  end)

  it("returns nothing when the gap is not below reach", function()
    for _, shape in ipairs(tools.every_kind()) do
      local random = tools.random(13)
      for _ = 1, 500 do
        local p = random.vector(1)
        local gap = shape:distance(p)
        local within = shape:distance(p, 0.1)
        assert.equal(gap < 0.1, within ~= nil)
        if within then assert.equal(gap, within) end
        assert.equal(gap < -0.05, shape:distance(p, -0.05) ~= nil)
      end
    end
  end)

  it("stays finite at centres, corners, edges, denormal and huge coordinates", function()
    local values = { 0, -0.0, 0.5, -0.5, 0.4, 0.3, 1e-300, 1e-160, 5e-324, 1e20, -1e40 }
    local shapes = tools.every_kind()
    shapes[#shapes + 1] = tools.mesh(tools.box_triangles(1, 1, 1))
    shapes[#shapes + 1] = core.shape { shape = "hull", points = tools.box_points(1, 1, 1) }
    for _, shape in ipairs(shapes) do
      for _, x in ipairs(values) do
        for _, y in ipairs(values) do
          for _, z in ipairs(values) do
            local gap, n, q = shape:distance { x, y, z }
            assert.is_true(tools.finite(gap), shape:kind())
            near(1, tools.norm(n), 1e-12, shape:kind() .. " unit normal")
            assert.is_true(tools.finite(q[1] + q[2] + q[3]), shape:kind())
          end
        end
      end
      assert.is_nil(shape:distance { 1e200, 0, 0 })
    end
  end)
end)

describe("box, hull and mesh of the same box", function()
  local box = core.shape { shape = "box", size = { 1, 0.7, 0.3 } }
  local hull = core.shape { shape = "hull", points = tools.box_points(1, 0.7, 0.3) }
  local mesh = tools.mesh(tools.box_triangles(1, 0.7, 0.3))

  it("agree on gap and normal inside and outside", function()
    local random = tools.random(21)
    for _ = 1, 5000 do
      local p = random.vector(0.8)
      local gap, normal = box:distance(p)
      for _, other in ipairs { hull, mesh } do
        local same, n = other:distance(p)
        near(gap, same, 1e-7, other:kind()) -- the file's coordinates are floats
        if gap > 1e-3 then assert.is_true(tools.dot(normal, n) > 1 - 1e-6) end
      end
    end
  end)

  it("agree on bounds", function()
    local low, high = box:bounds()
    for _, other in ipairs { hull, mesh } do
      local low2, high2 = other:bounds()
      for k = 1, 3 do
        near(low[k], low2[k], 1e-7)
        near(high[k], high2[k], 1e-7)
      end
    end
  end)
end)

describe("mesh", function()
  -- The nearest of many points scattered over the triangles is not nearer than the answer.
  it("gives the nearest place of all its triangles", function()
    local points, triangles = tools.ball(0.5, 6, 8)
    local shape, random = tools.mesh(points, triangles), tools.random(31)
    local samples = {}
    for _, t in ipairs(triangles) do
      for i = 0, 12 do
        for k = 0, 12 - i do
          local s = { 0, 0, 0 }
          for j, w in ipairs { i / 12, k / 12, 1 - (i + k) / 12 } do
            for c = 1, 3 do s[c] = s[c] + w * points[3 * (t[j] - 1) + c] end
          end
          samples[#samples + 1] = s
        end
      end
    end
    for _ = 1, 100 do
      local p, best = random.vector(0.8), math.huge
      for _, s in ipairs(samples) do best = math.min(best, tools.norm(tools.sub(p, s))) end
      local gap = math.abs((shape:distance(p)))
      assert.is_true(gap <= best + 1e-7 and gap > best - 0.03)
    end
  end)

  it("tells inside from outside next to faces, edges and corners of a concave solid", function()
    -- an L: the box [0,2]x[0,2]x[0,1] without [1,2]x[1,2]x[0,1]
    local outline = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }
    local points, triangles = {}, {}
    for z = 0, 1 do
      for _, p in ipairs(outline) do
        points[#points + 1], points[#points + 2], points[#points + 3] = p[1], p[2], z
      end
    end
    for i = 1, 6 do
      local j = i % 6 + 1
      triangles[#triangles + 1] = { i, j, j + 6 }
      triangles[#triangles + 1] = { i, j + 6, i + 6 }
    end
    for _, t in ipairs { { 1, 2, 3 }, { 1, 3, 4 }, { 1, 4, 5 }, { 1, 5, 6 } } do
      triangles[#triangles + 1] = { t[3], t[2], t[1] }
      triangles[#triangles + 1] = { t[1] + 6, t[2] + 6, t[3] + 6 }
    end
    local shape, random = tools.mesh(points, triangles), tools.random(32)
    for _ = 1, 5000 do
      local p = tools.add(random.vector(1.3), { 1, 1, 0.5 })
      local inside = p[1] > 0 and p[2] > 0 and p[3] > 0 and p[3] < 1 and p[1] < 2 and p[2] < 2
        and not (p[1] > 1 and p[2] > 1)
      assert.equal(inside, shape:distance(p) < 0)
    end
    near(-0.1 * math.sqrt(2), (shape:distance { 0.9, 0.9, 0.5 }), 1e-7)
  end)

  it("has no inside beyond the border of an open sheet", function()
    local sheet = tools.mesh({ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, { { 1, 2, 3 }, { 1, 3, 4 } })
    near(0.1, (sheet:distance { 0.5, 0.5, 0.1 }), 1e-12)
    near(-0.1, (sheet:distance { 0.5, 0.5, -0.1 }), 1e-12)
    near(0.1 * math.sqrt(2), (sheet:distance { 1.1, 0.5, -0.1 }), 1e-7)
    near(0.2, (sheet:distance { 1.2, 0.5, 0 }), 1e-7)
  end)
end)
