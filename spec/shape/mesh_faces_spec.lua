-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mesh files with triangles that are there twice, and closed surfaces that face inwards.
local assert = require "luassert"
local core = require "softworld.core"
local sw = require "softworld"
local tools = require "spec.shape.tools"

-- Returns a box's points and triangles, with each side of n x n quads whose corners are its own.
local function box(size, n)
  local points, triangles, h = {}, {}, size / 2
  local function at(o, u, v, i, j)
    for k = 1, 3 do points[#points + 1] = o[k] + (u[k] * i + v[k] * j) * size / n end
    return #points // 3
  end
  local function side(o, u, v)
    for i = 0, n - 1 do
      for j = 0, n - 1 do
        local a, b = at(o, u, v, i, j), at(o, u, v, i + 1, j)
        local c, d = at(o, u, v, i + 1, j + 1), at(o, u, v, i, j + 1)
        triangles[#triangles + 1], triangles[#triangles + 2] = { a, b, c }, { a, c, d }
      end
    end
  end
  local x, y, z = { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }
  side({ -h, -h, h }, x, y) side({ -h, -h, -h }, y, x) side({ -h, -h, -h }, x, z)
  side({ -h, h, -h }, z, x) side({ -h, -h, -h }, z, y) side({ h, -h, -h }, y, z)
  return points, triangles
end

local function turned(t) return { t[1], t[3], t[2] } end

local function all_turned(triangles)
  local out = {}
  for i, t in ipairs(triangles) do out[i] = turned(t) end
  return out
end

-- Puts boxes { size, at, turned } into one file.
local function boxes(list)
  local points, triangles = {}, {}
  for _, b in ipairs(list) do
    local p, t = tools.box_triangles(b[1], b[1], b[1])
    local first = #points // 3
    for i, x in ipairs(p) do points[#points + 1] = x + b[2][(i - 1) % 3 + 1] end
    for _, f in ipairs(b[3] and all_turned(t) or t) do
      triangles[#triangles + 1] = { f[1] + first, f[2] + first, f[3] + first }
    end
  end
  return points, triangles
end

local function refused(text, points, triangles)
  local fine, message = pcall(tools.mesh, points, triangles)
  assert.is_false(fine)
  assert.is_truthy(message:find(text, 1, true), message)
end

-- Draws a cable along the top of a box over its far edge; returns the pull and the contact's depth [N], [m].
local function drawn(data)
  local scene, r = sw.scene{}, 0.0014
  scene:obstacle{ shape = "mesh", data = data, format = "obj", at = { 0, 0, -0.1 }, friction = 0.3 }
  local wire = scene:wire{ EI = 1e-3, EA = 1e4, mass_per_length = 0.02, radius = r, segments = 40,
    from = { 0.05, 0.013, r }, to = { -0.25, 0.013, r } }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.001 }
  local hand = scene:clamp(wire, { s = 0 })
  hand:follow{ points = { { 0.05, 0.013, r }, { 0.08, 0.013, r } }, duration = 0.3 }
  assert(scene:run{ duration = 0.3, dt = 0.005 }.ok)
  return hand:over(0.1, 0.3).mean_force
end

describe("a mesh file with triangles that are there twice", function()
  it("has the triangles and the forces of the file without the copies", function()
    local points, triangles = box(0.2, 5)
    local once, twice = tools.obj(points, triangles), {}
    for i, t in ipairs(triangles) do
      twice[i], twice[#triangles + i] = t, { t[2], t[3], t[1] } -- the same winding
    end
    local shape = core.shape{ shape = "mesh", data = tools.obj(points, twice), format = "obj" }
    local _, indices = shape:triangles()
    assert.equal(3 * #triangles, #indices)
    assert.equal(drawn(once), drawn(tools.obj(points, twice)))
  end)

  it("is refused if a triangle is there in both windings, with both numbers", function()
    local points, triangles = box(0.2, 2)
    triangles[#triangles + 1] = turned(triangles[7])
    refused("triangles 7 and 49 have the same corners in opposite windings", points, triangles)
    refused("triangles 1 and 2 have", { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { { 1, 2, 3 }, { 2, 1, 3 } })
  end)
end)

describe("a closed surface that faces inwards", function()
  local o, far = { 0, 0, 0 }, { 3, 0.1, 0.2 }

  it("is refused with its place", function()
    local points, triangles = box(0.2, 2)
    refused("the closed surface of 48 triangles with a corner at (", points, all_turned(triangles))
    refused("faces inwards", boxes{ { 1, o }, { 1, far, true } })
    refused("faces inwards", boxes{ { 1, o, true }, { 1, far } })
    refused("faces inwards", boxes{ { 1, o, true }, { 0.5, o } }) -- a hollow box, all turned
    refused("faces inwards", boxes{ { 1, o }, { 0.8, o, true }, { 0.3, o, true } }) -- a solid in a cavity
  end)

  it("is accepted as a cavity within another surface, closed or with a hole", function()
    local shape = tools.mesh(boxes{ { 1, o }, { 0.5, o, true }, { 1, far } })
    assert.is_true(math.abs(shape:distance{ 0, 0, 0.2 } - 0.05) < 1e-12)
    assert.is_true(math.abs(shape:distance{ 0, 0, 0.3 } + 0.05) < 1e-12)
    tools.mesh(boxes{ { 1, o }, { 0.8, o, true }, { 0.3, o } })
    for missing = 1, 12 do
      local points, triangles = boxes{ { 1, o }, { 0.5, { 0.01, 0.02, 0.03 }, true } }
      table.remove(triangles, missing)
      tools.mesh(points, triangles)
    end
  end)

  it("is not looked for in open sheets", function()
    local points, triangles = box(0.2, 2)
    table.remove(triangles)
    tools.mesh(points, all_turned(triangles))
  end)
end)
