-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mesh files: what is read, cleaned and refused; hulls of awkward points.
local core = require "softworld.core"
local meshfile = require "softworld.meshfile"
local tools = require "shape.tools"

local function refused(pattern, parameters)
  local fine, message = pcall(core.shape, parameters)
  assert.is_false(fine)
  assert.is_truthy(message:find(pattern), message)
end

local function mesh(data, format, scale)
  return core.shape { shape = "mesh", data = data, format = format, scale = scale }
end

describe("mesh file", function()
  local points, triangles = tools.box_triangles(1, 2, 3)

  it("is the same solid as ascii STL, binary STL, OBJ, OFF and PLY", function()
    local off = { "OFF", "8 12 0" }
    local ply = { "ply", "format ascii 1.0", "element vertex 8", "property float x",
      "property float y", "property float z", "element face 12",
      "property list uchar int vertex_indices", "end_header" }
    for _, list in ipairs { off, ply } do
      for i = 1, #points, 3 do list[#list + 1] = table.concat(points, " ", i, i + 2) end
      for _, t in ipairs(triangles) do
        list[#list + 1] = ("3 %d %d %d"):format(t[1] - 1, t[2] - 1, t[3] - 1)
      end
      list[#list + 1] = ""
    end
    local files = { { tools.stl_ascii(points, triangles), "stl" },
      { tools.stl_binary(points, triangles), "stl" }, { tools.obj(points, triangles), "obj" },
      { table.concat(off, "\n"), "off" }, { table.concat(ply, "\n"), "ply" } }
    local box, random = core.shape { shape = "box", size = { 1, 2, 3 } }, tools.random(61)
    for _, file in ipairs(files) do
      local shape = mesh(file[1], file[2])
      local vertices, indices = shape:triangles()
      assert.equal(24, #vertices, "welded")
      assert.equal(36, #indices)
      for _ = 1, 300 do
        local p = random.vector(2)
        assert.is_true(math.abs(box:distance(p) - shape:distance(p)) < 1e-6, file[2])
      end
    end
  end)

  it("is scaled to metres", function()
    local low, high = mesh(tools.obj(points, triangles), "obj", 0.001):bounds()
    assert.is_true(math.abs(high[3] - low[3] - 0.003) < 1e-12)
  end)

  it("is cleaned of doubled points and triangles without area", function()
    local p, t = { table.unpack(points) }, { table.unpack(triangles) }
    for i = 1, 3 do p[#p + 1] = points[i] * (1 + 1e-9) end
    t[#t + 1] = { 1, 1, 2 }
    t[#t + 1] = { 1, 9, 4 }
    t[1] = { 9, t[1][2], t[1][3] }
    local vertices, indices = mesh(tools.stl_ascii(p, t), "stl"):triangles()
    assert.equal(24, #vertices)
    assert.equal(36, #indices)
  end)

  it("is refused with the reason when it is malformed", function()
    local good = tools.stl_binary(points, triangles)
    refused("obstacle mesh: data is not readable as stl", { shape = "mesh", data = "rubbish",
      format = "stl" })
    refused("obstacle mesh: data is not readable as stl", { shape = "mesh",
      data = good:sub(1, #good - 60), format = "stl" })
    refused("obstacle mesh: ", { shape = "mesh", data = "v 0 0 0\nv 1 0 0\n", format = "obj" })
    refused("obstacle mesh: ", { shape = "mesh", data = "v 0 0 0\nf 1 2 3\n", format = "obj" })
    refused("obstacle mesh: ", { shape = "mesh", data = ("\0"):rep(500), format = "glb" })
    refused("data is empty", { shape = "mesh", data = "", format = "stl" })
    refused("data must be a string, got table", { shape = "mesh", data = {}, format = "stl" })
    refused("data is required", { shape = "mesh", format = "stl" })
    refused("format = 'step' is not one of: stl, obj", { shape = "mesh", data = good,
      format = "step" })
    refused("scale = 0 is not allowed", { shape = "mesh", data = good, format = "stl", scale = 0 })
    local function one(x)
      return tools.stl_binary({ 0, 0, 0, 1, 0, 0, 0, x, 0 }, { { 1, 2, 3 } })
    end
    refused("not a number", { shape = "mesh", data = one(0 / 0), format = "stl" })
    refused("not a number", { shape = "mesh", data = one(math.huge), format = "stl" })
    refused("further out than", { shape = "mesh", data = one(1e9), format = "stl" })
    refused("none of the 1 triangles has an area", { shape = "mesh", data = one(0),
      format = "stl" })
    local twisted = { table.unpack(triangles) }
    twisted[1] = { twisted[1][1], twisted[1][3], twisted[1][2] }
    refused("face opposite ways", { shape = "mesh", data = tools.obj(points, twisted),
      format = "obj" })
  end)

  it("survives truncation and random damage", function()
    local random = tools.random(62)
    local binary, ascii = tools.stl_binary(points, triangles), tools.obj(points, triangles)
    for _, file in ipairs { { binary, "stl" }, { ascii, "obj" } } do
      for i = 1, 150 do
        local n = math.floor(#file[1] * i / 150)
        pcall(mesh, file[1]:sub(1, n), file[2])
        local at = 1 + math.floor((random.number() + 1) / 2 * (#file[1] - 1))
        local byte = string.char(math.floor((random.number() + 1) * 127))
        pcall(mesh, file[1]:sub(1, at - 1) .. byte .. file[1]:sub(at + 1), file[2])
      end
    end
  end)

  it("opens no other file that it names", function()
    local data = "mtllib /etc/passwd\nusemtl x\n" .. tools.obj(points, triangles)
    assert.equal("mesh", mesh(data, "obj"):kind())
    local gltf = [[{"asset":{"version":"2.0"},"buffers":[{"uri":"/etc/passwd","byteLength":36}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,
      "count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}]]
    refused("obstacle mesh: data is not readable as gltf", { shape = "mesh", data = gltf,
      format = "gltf" })
  end)

  it("tells the radius that its facets approximate", function()
    for _, n in ipairs { 12, 24, 60 } do
      local radius = tools.mesh(tools.ball(0.03, n, 2 * n)):roundness()
      assert.is_true(math.abs(radius / 0.03 - 1) < 0.03, radius)
    end
    assert.equal(0, tools.mesh(points, triangles):roundness())
    assert.equal(0, core.shape{ shape = "sphere", radius = 1 }:roundness())
  end)

  it("may be large", function()
    local p, t = tools.ball(0.5, 100, 200)
    local shape, random = tools.mesh(p, t), tools.random(63)
    for _ = 1, 2000 do
      local q = random.vector(0.8)
      assert.is_true(math.abs(shape:distance(q) - (tools.norm(q) - 0.5)) < 3e-4)
    end
  end)
end)

describe("hull", function()
  it("contains its points, and its corners are among them", function()
    local random, points = tools.random(64), {}
    for _ = 1, 300 do
      local p = random.vector(1)
      for k = 1, 3 do points[#points + 1] = p[k] end
    end
    local shape = core.shape { shape = "hull", points = points }
    local vertices, indices = shape:triangles()
    for i = 1, #points, 3 do
      assert.is_true(shape:distance { points[i], points[i + 1], points[i + 2] } < 1e-12)
    end
    assert.is_true(#indices >= 12 and #vertices >= 12)
    assert.is_true(shape:distance { 0, 0, 0 } < -0.7)
  end)

  it("takes tables of points as well as flat numbers", function()
    local nested = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { x = 0, y = 0, z = 1 } }
    local shape = core.shape { shape = "hull", points = nested }
    assert.is_true(math.abs(shape:distance { -1, 0.1, 0.1 } - 1) < 1e-12)
    assert.equal(12, #select(2, shape:triangles()))
  end)

  it("works with doubled points, many coplanar points and every size", function()
    for _, size in ipairs { 1e-5, 1, 1e5 } do
      local points = {}
      for i = 0, 6 do
        for j = 0, 6 do
          for k = 0, 6 do
            points[#points + 1] = { size * i / 6, size * j / 6, size * k / 6 }
            points[#points + 1] = points[#points]
          end
        end
      end
      local shape, random = core.shape { shape = "hull", points = points }, tools.random(65)
      local box = core.shape { shape = "box", size = { size, size, size } }
      for _ = 1, 500 do
        local p = random.vector(size)
        local centred = tools.sub(p, { size / 2, size / 2, size / 2 })
        assert.is_true(math.abs(shape:distance(p) - box:distance(centred)) < 1e-9 * size)
      end
    end
  end)

  it("refuses too few, flat, and wrong points", function()
    refused("needs at least 4", { shape = "hull", points = { 0, 0, 0, 1, 0, 0, 0, 1, 0 } })
    refused("needs at least 4", { shape = "hull", points = {} })
    refused("in one plane", { shape = "hull", points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 } })
    refused("in one plane", { shape = "hull", points = { 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 } })
    refused("points has 13 numbers", { shape = "hull",
      points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 7 } })
    refused("item 2, must be a number %[m%], got string", { shape = "hull",
      points = { 0, "1", 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 } })
    refused("item 4", { shape = "hull", points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4 } })
    refused("points must be a table", { shape = "hull", points = 3 })
    refused("is required", { shape = "hull" })
    refused("not within", { shape = "hull", points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0 / 0 } })
    refused("not within", { shape = "hull", points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1e9 } })
  end)
end)

describe("meshfile.read", function()
  local name
  before_each(function() name = os.tmpname() end)
  after_each(function() os.remove(name) end)

  local function fails(path, reason)
    local fine, message = pcall(meshfile.read, path)
    assert.is_false(fine)
    assert.is_truthy(message:find(reason, 1, true), message)
    assert.is_truthy(message:find(tostring(path), 1, true), message)
  end

  it("gives the content and the format", function()
    local path = name .. ".STL"
    local points, triangles = tools.box_triangles(1, 1, 1)
    local file = assert(io.open(path, "wb"))
    file:write(tools.stl_binary(points, triangles))
    file:close()
    local read = meshfile.read(path)
    os.remove(path)
    assert.equal("stl", read.format)
    local shape = core.shape { shape = "mesh", data = read.data, format = read.format }
    assert.is_true(math.abs(shape:distance { 0, 0, 1 } - 0.5) < 1e-12)
  end)

  it("names the path and the reason when it cannot", function()
    fails("/no/such/clip.stl", "No such file")
    fails("clip.foo", "extension 'foo' is not known; known are stl, obj")
    fails("clip", "has no extension")
    local path = name .. ".obj"
    assert(io.open(path, "w")):close()
    fails(path, "is empty")
    os.remove(path)
    assert.has_error(function() meshfile.read(nil) end,
      "meshfile.read: path must be a non-empty string, got nil")
  end)

  it("names the line of the script that asked for the obstacle", function()
    local sw = require "softworld"
    local scene = sw.scene{}
    local line = debug.getinfo(1, "l").currentline + 1
    local fine, message = pcall(function() scene:obstacle{ shape = "mesh", file = "/no/clip.stl" } end)
    assert.is_false(fine)
    assert.is_truthy(message:find("mesh_files_spec.lua:" .. line
      .. ": obstacle mesh: mesh file '/no/clip.stl'", 1, true), message)
  end)

  it("knows the formats that the core knows", function()
    for _, row in ipairs(core.shape_params "mesh") do
      if row.name == "format" then assert.same(row.choices, meshfile.formats) end
    end
  end)
end)
