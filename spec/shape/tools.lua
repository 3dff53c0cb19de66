-- SPDX-License-Identifier: GPL-3.0-or-later
-- Vectors, random numbers with a fixed seed, mesh files and brute force for the shape specs.
local assert = require "luassert"
local core = require "softworld.core"
local vec = require "softworld.vec"
local tools = {}

-- Vectors --------------------------------------------------------------------

function tools.add(a, b) return { a[1] + b[1], a[2] + b[2], a[3] + b[3] } end
function tools.sub(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end
function tools.scale(a, s) return { a[1] * s, a[2] * s, a[3] * s } end
function tools.dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
function tools.norm(a) return math.sqrt(tools.dot(a, a)) end
function tools.lerp(a, b, t)
  return { a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), a[3] + t * (b[3] - a[3]) }
end

--- Returns a source of numbers in [-1, 1] that is the same on every machine.
function tools.random(seed)
  local state = seed
  local r = {}
  function r.number()
    state = (state * 6364136223846793005 + 1442695040888963407)
    return ((state >> 11) & 0x1fffffffffffff) / 0x10000000000000 - 1
  end
  function r.vector(size)
    return { size * r.number(), size * r.number(), size * r.number() }
  end
  return r
end

-- Shapes ---------------------------------------------------------------------

function tools.box_points(x, y, z)
  local points = {}
  for i = 0, 7 do
    points[#points + 1] = (i & 1 == 0 and -x or x) / 2
    points[#points + 1] = (i & 2 == 0 and -y or y) / 2
    points[#points + 1] = (i & 4 == 0 and -z or z) / 2
  end
  return points
end

local box_faces = { { 1, 3, 4, 2 }, { 5, 6, 8, 7 }, { 1, 2, 6, 5 }, { 3, 7, 8, 4 },
  { 1, 5, 7, 3 }, { 2, 4, 8, 6 } }

--- Returns corners and triangles (numbers from 1) of a box.
function tools.box_triangles(x, y, z)
  local triangles = {}
  for _, f in ipairs(box_faces) do
    triangles[#triangles + 1] = { f[1], f[2], f[3] }
    triangles[#triangles + 1] = { f[1], f[3], f[4] }
  end
  return tools.box_points(x, y, z), triangles
end

--- Returns corners and triangles of a sheet of n x m cells, two triangles each. place(i, j): corner i of n, j
-- of m. closed: true if it closes to a ring both ways, as a torus; else corners go from 0 to n and m.
function tools.sheet(n, m, closed, place)
  local points, triangles, more = {}, {}, closed and 0 or 1
  for i = 0, n - 1 + more do
    for j = 0, m - 1 + more do table.move(place(i, j), 1, 3, #points + 1, points) end
  end
  local function at(i, j) return i % (n + more) * (m + more) + j % (m + more) + 1 end
  for i = 0, n - 1 do
    for j = 0, m - 1 do
      triangles[#triangles + 1] = { at(i, j), at(i + 1, j), at(i + 1, j + 1) }
      triangles[#triangles + 1] = { at(i, j), at(i + 1, j + 1), at(i, j + 1) }
    end
  end
  return points, triangles
end

function tools.obj(points, triangles)
  local lines = {}
  for i = 1, #points, 3 do
    lines[#lines + 1] = ("v %.9g %.9g %.9g"):format(points[i], points[i + 1], points[i + 2])
  end
  for _, t in ipairs(triangles) do
    lines[#lines + 1] = "f " .. table.concat(t, " ")
  end
  return table.concat(lines, "\n") .. "\n"
end

local function corner(points, i) return points[3 * i - 2], points[3 * i - 1], points[3 * i] end

function tools.stl_ascii(points, triangles)
  local lines = { "solid made" }
  for _, t in ipairs(triangles) do
    lines[#lines + 1] = "facet normal 0 0 0\nouter loop"
    for k = 1, 3 do
      lines[#lines + 1] = ("vertex %.9g %.9g %.9g"):format(corner(points, t[k]))
    end
    lines[#lines + 1] = "endloop\nendfacet"
  end
  lines[#lines + 1] = "endsolid made\n"
  return table.concat(lines, "\n")
end

function tools.stl_binary(points, triangles)
  local parts = { (" "):rep(80), ("<I4"):pack(#triangles) }
  for _, t in ipairs(triangles) do
    parts[#parts + 1] = ("<fff"):pack(0, 0, 0)
    for k = 1, 3 do parts[#parts + 1] = ("<fff"):pack(corner(points, t[k])) end
    parts[#parts + 1] = ("<I2"):pack(0)
  end
  return table.concat(parts)
end

--- A ball of triangles around the origin.
function tools.ball(radius, rings, columns)
  local points, triangles = {}, {}
  local function put(x, y, z)
    points[#points + 1], points[#points + 2], points[#points + 3] = x, y, z
    return #points // 3
  end
  local top = put(0, 0, radius)
  local before
  for i = 1, rings - 1 do
    local a, row = math.pi * i / rings, {}
    for k = 0, columns - 1 do
      local b = 2 * math.pi * k / columns
      row[k] = put(radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b),
        radius * math.cos(a))
    end
    for k = 0, columns - 1 do
      local next = (k + 1) % columns
      if before then
        triangles[#triangles + 1] = { before[k], row[k], row[next] }
        triangles[#triangles + 1] = { before[k], row[next], before[next] }
      else
        triangles[#triangles + 1] = { top, row[k], row[next] }
      end
    end
    before = row
  end
  local bottom = put(0, 0, -radius)
  for k = 0, columns - 1 do
    triangles[#triangles + 1] = { bottom, before[(k + 1) % columns], before[k] }
  end
  return points, triangles
end

function tools.mesh(points, triangles, scale)
  return core.shape { shape = "mesh", data = tools.obj(points, triangles), format = "obj",
    scale = scale }
end

local function cloud()
  local random, points = tools.random(5), {}
  for _ = 1, 60 do
    local p = random.vector(0.5)
    for k = 1, 3 do points[#points + 1] = p[k] end
  end
  return points
end

--- Returns one shape of every kind, all about 1 m large, for specs that hold for all of them: its sample, or
-- for kinds made from lists or files one with many places.
function tools.every_kind()
  local rich = { hull = core.shape { shape = "hull", points = cloud() },
    mesh = tools.mesh(tools.ball(0.5, 6, 8)) }
  local list = {}
  for i, kind in ipairs(core.registry().shapes) do
    local args = assert(load(("return { %s }"):format(kind.sample)))()
    args.shape = kind.name
    list[i] = rich[kind.name] or core.shape(args)
  end
  return list
end

-- Brute force ----------------------------------------------------------------

--- Returns the smallest gap of the segment at n + 1 places, and the place.
function tools.smallest_gap(shape, a, b, n)
  local least, where = math.huge, 0
  for i = 0, n do
    local gap = shape:distance(tools.lerp(a, b, i / n))
    if gap < least then least, where = gap, i / n end
  end
  return least, where
end

function tools.finite(x) return x == x and x > -math.huge and x < math.huge end

-- Assertions -----------------------------------------------------------------

--- Like assert.near of Busted, but the bound is part of the range; text names the value.
function tools.near(expected, value, tolerance, text)
  assert.is_true(math.abs(expected - value) <= tolerance,
    ("%s: expected %.12g, got %.12g"):format(text or "value", expected, value))
end

--- Checks that every edge of the triangles { vertices =, indices = from 0 } is passed once each way: the
-- surface is closed, and wound alike everywhere. Returns the volume inside, positive when wound outwards.
function tools.closed_volume(drawn)
  local function at(i)
    local v = drawn.vertices
    return { v[3 * i + 1], v[3 * i + 2], v[3 * i + 3] }
  end
  local edges, volume = {}, 0
  for k = 1, #drawn.indices, 3 do
    local a, b, c = table.unpack(drawn.indices, k, k + 2)
    volume = volume + vec.dot(at(a), vec.cross(at(b), at(c))) / 6 -- the divergence theorem
    for _, edge in ipairs { a .. " " .. b, b .. " " .. c, c .. " " .. a } do
      edges[edge] = (edges[edge] or 0) + 1
    end
  end
  for edge, n in pairs(edges) do
    assert.equal(1, n)
    assert.equal(1, edges[edge:gsub("(%d+) (%d+)", "%2 %1")])
  end
  return volume
end

return tools
