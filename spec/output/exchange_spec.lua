-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:gltf, run:obj, run:stl: files are read back and compared with the run. A .glb file must follow the
-- rules of glTF 2.0 (lengths, alignment, bounds of accessors, indices in range).
local dkjson = require "dkjson"
local files = require "spec.output.files"
local sink = require "softworld.output.sink"
local sw = require "softworld"

local width = { SCALAR = 1, VEC3 = 3, VEC4 = 4 }
local bytes = { [5126] = 4, [5125] = 4 }

-- Reads a .glb file and checks its header and chunks; returns its document and its data.
local function read(path)
  local text = sink.read_file(path)
  local magic, version, total, length, kind = ("<c4I4I4I4c4"):unpack(text)
  assert.same({ "glTF", 2, #text, "JSON" }, { magic, version, total, kind })
  assert.equal(0, length % 4)
  local doc = assert(dkjson.decode(text:sub(21, 20 + length)))
  local size, data_kind = ("<I4c4"):unpack(text, 21 + length)
  assert.same({ "BIN\0", 0 }, { data_kind, size % 4 })
  assert.equal(#text, 28 + length + size)
  assert.is_true(doc.buffers[1].byteLength <= size and doc.buffers[1].byteLength > size - 4)
  return doc, text:sub(29 + length)
end

local function values(doc, data, number)
  local a = doc.accessors[number + 1]
  local v = doc.bufferViews[a.bufferView + 1]
  local n, list = a.count * width[a.type], {}
  local format = a.componentType == 5126 and "<f" or "<I4"
  for i = 1, n do list[i] = format:unpack(data, v.byteOffset + 4 * i - 3) end
  return list, a
end

local function check_accessors(doc, data)
  for _, view in ipairs(doc.bufferViews) do
    assert.equal(0, view.byteOffset % 4)
    assert.is_true(view.byteLength > 0 and view.byteOffset + view.byteLength <= doc.buffers[1].byteLength)
  end
  for k, a in ipairs(doc.accessors) do
    local view = doc.bufferViews[a.bufferView + 1]
    assert.equal(a.count * width[a.type] * bytes[a.componentType], view.byteLength)
    local list = values(doc, data, k - 1)
    for c = 1, a.min and width[a.type] or 0 do
      local low, high = math.huge, -math.huge
      for i = c, #list, width[a.type] do low, high = math.min(low, list[i]), math.max(high, list[i]) end
      assert.same({ low, high }, { a.min[c], a.max[c] })
    end
    for _, x in ipairs(list) do assert.is_true(x == x and math.abs(x) < 1e9) end
  end
end

local function check_meshes(doc, data)
  for _, mesh in ipairs(doc.meshes) do
    for _, p in ipairs(mesh.primitives) do
      local place = doc.accessors[p.attributes.POSITION + 1]
      assert.is_true(place.min ~= nil and place.max ~= nil)
      for _, i in ipairs(p.indices and values(doc, data,
        p.indices) or {}) do assert.is_true(i < place.count) end
      assert.is_true(p.material < #doc.materials)
      assert.equal(#(p.targets or {}), #(mesh.weights or {}))
      for _, target in ipairs(p.targets or {}) do
        assert.equal(place.count, doc.accessors[target.POSITION + 1].count)
        assert.is_true(doc.accessors[target.POSITION + 1].min ~= nil)
      end
      if p.attributes.NORMAL then
        local n = values(doc, data, p.attributes.NORMAL)
        for i = 1, #n, 3 do assert.near(1, n[i] ^ 2 + n[i + 1] ^ 2 + n[i + 2] ^ 2, 1e-4) end
      end
    end
  end
end

local function check_animation(doc, data)
  for _, animation in ipairs(doc.animations or {}) do
    for _, channel in ipairs(animation.channels) do
      local sampler = animation.samplers[channel.sampler + 1]
      local times, output = values(doc, data, sampler.input), doc.accessors[sampler.output + 1]
      for i = 2, #times do assert.is_true(times[i] > times[i - 1]) end
      assert.equal(0, times[1])
      local node = doc.nodes[channel.target.node + 1]
      local each = 1
      if channel.target.path == "weights" then each = #doc.meshes[node.mesh + 1].weights end
      assert.equal(#times * each, output.count)
      if channel.target.path == "rotation" then
        local q = values(doc, data, sampler.output)
        for i = 1, #q, 4 do
          assert.near(1, q[i] ^ 2 + q[i + 1] ^ 2 + q[i + 2] ^ 2 + q[i + 3] ^ 2, 1e-5)
        end
      end
    end
  end
end

-- Each node has at most one parent, and refers only to existing objects.
local function check_nodes(doc)
  local parents = {}
  for _, node in ipairs(doc.nodes) do
    for _, child in ipairs(node.children or {}) do
      assert.is_true(child < #doc.nodes and not parents[child])
      parents[child] = true
    end
    assert.is_true(not node.mesh or node.mesh < #doc.meshes)
    if node.rotation then
      local q = node.rotation
      assert.near(1, q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2 + q[4] ^ 2, 1e-6)
    end
  end
  for _, root in ipairs(doc.scenes[1].nodes) do assert.is_nil(parents[root]) end
end

local function check(path)
  local doc, data = read(path)
  assert.equal("2.0", doc.asset.version)
  check_accessors(doc, data)
  check_meshes(doc, data)
  check_animation(doc, data)
  check_nodes(doc)
  return doc, data
end

local function node_of(doc, name)
  for i, node in ipairs(doc.nodes) do
    if node.name == name then return node, i - 1 end
  end
end

describe("exchange", function()
  local folder, run, wire
  setup(function()
    folder = files.folder()
    local scene = sw.scene { name = "it's \"a\" <b>" }
    scene:obstacle { name = "table", shape = "plane" }
    scene:obstacle { name = "block", shape = "box", size = { 0.05, 0.2, 0.04 }, at = { 0.3, 0, 0.02 } }
    local arm = scene:obstacle { name = "arm", shape = "sphere", radius = 0.02, at = { 0, 1, 0.5 } }
    arm:follow { points = { { 0, 1, 0.5 }, { 0, 1, 1 } }, duration = 0.3 }
    wire = scene:wire { name = "w 1", E = 5e7, density = 1500, radius = 0.0025, from = { 0, 0, 0.0025 },
      to = { 0.25, 0, 0.0025 }, segments = 25 }
    scene:wire { name = "hose", model = "tube", E = 5e6, density = 1500, radius = 0.01, from = { 0, 2, 0.2 },
      to = { 0.1, 2, 0.2 }, spacing = 0.008 }
    scene:particles { name = "cloth", positions = { 0, 3, 1, 0.1, 3, 1, 0, 3.1, 1 }, masses = 0.001,
      links = { { pairs = { 1, 2, 2, 3, 3, 1 }, k = 10 } }, radius = 0.002 }
    local hand = scene:gripper { name = "hand" }
    scene:process(function(p)
      p:wait(0.05)
      hand:grasp(wire, { s = 0.03 })
      hand:move { by = { 0, 0, 0.05 }, speed = 0.4 }
      hand:release()
      p:wait(0.05)
    end)
    run = scene:run { dt = 0.005 }
    assert(run.ok, run.reason)
  end)
  teardown(function() files.remove(folder) end)

  it("follows the rules of glTF, and has every object under its name", function()
    local path = run:gltf(folder .. "/it's.glb")
    local doc = check(path)
    for _, name in ipairs { "table", "block", "arm", "w 1", "hose", "cloth", "hand", "it's \"a\" <b>" } do
      assert.truthy(node_of(doc, name), name)
    end
    assert.same({ "it's.glb" }, files.list(folder))
  end)

  it("has the wire's surface around its nodes, at each time", function()
    local doc, data = check(run:gltf(folder .. "/a.glb", { thickness = 2 }))
    local node, number = node_of(doc, "w 1")
    local mesh = doc.meshes[node.mesh + 1]
    local p = mesh.primitives[1]
    local base = values(doc, data, p.attributes.POSITION)
    local around = 12
    for f, target in ipairs(p.targets) do
      local moved, nodes = values(doc, data, target.POSITION), run.scene:frame(f + 1).wires[1]
      for i = 1, #nodes, 3 do
        for k = 0, around - 1 do -- the ring of this node
          local at, d = 3 * (around * ((i - 1) // 3) + k), 0
          for c = 1, 3 do d = d + (base[at + c] + moved[at + c] - nodes[i + c - 1]) ^ 2 end
          assert.near(0.005, d ^ 0.5, 2e-7)
        end
      end
    end
    for _, channel in ipairs(doc.animations[1].channels) do
      if channel.target.node == number then
        local times = values(doc, data, doc.animations[1].samplers[channel.sampler + 1].input)
        assert.equal(run.scene:frame_count(), #times)
        assert.near(run.scene:frame(#times).t, times[#times], 1e-6)
      end
    end
  end)

  it("moves objects as the frames do, and hides absent ones", function()
    local doc, data = check(run:gltf(folder .. "/a.glb"))
    local paths = {}
    for _, channel in ipairs(doc.animations[1].channels) do
      local name = doc.nodes[channel.target.node + 1].name
      local sampler = doc.animations[1].samplers[channel.sampler + 1]
      paths[name .. " " .. channel.target.path] = values(doc, data, sampler.output)
    end
    local places = paths["arm translation"]
    for f = 1, run.scene:frame_count() do
      assert.near(run.scene:frame(f).obstacles[3].position[3], places[3 * f], 1e-6)
    end
    assert.is_nil(paths["block translation"])
    assert.equal(0, paths["hand scale"][1]) -- the hand appears when it grasps
    assert.equal(1, paths["hand scale"][#paths["hand scale"]])
  end)

  it("hides a wire in frames before it was made and after it was removed", function()
    local scene, done = sw.scene(), false
    local function rod(name, y)
      return scene:wire { name = name, E = 5e6, density = 1500, radius = 0.003, from = { 0, y, 0 },
        to = { 0.3, y, 0 }, segments = 4 }
    end
    local first = rod("first", 0)
    rod("stays", 0.1)
    scene:observe { call = function(o)
      if scene.time > 0.015 and not done then
        done = true
        o:change(function()
          scene:remove(first)
          rod("later", 0.2)
        end)
      end
    end }
    local changed = scene:run { duration = 0.04, dt = 0.01, frame = 0.01 }
    local doc, data = check(changed:gltf(folder .. "/gone.glb"))
    local sizes = {}
    for _, channel in ipairs(doc.animations[1].channels) do
      if channel.target.path == "scale" then
        local list = values(doc, data, doc.animations[1].samplers[channel.sampler + 1].output)
        sizes[doc.nodes[channel.target.node + 1].name] = { list[1], list[#list] }
      end
    end
    assert.same({ first = { 1, 0 }, later = { 0, 1 } }, sizes)
  end)

  it("writes fewer frames, or one", function()
    local doc = check(run:gltf(folder .. "/a.glb", { frames = 3 }))
    assert.equal(2, #doc.meshes[node_of(doc, "w 1").mesh + 1].weights)
    doc = check(run:gltf(folder .. "/a.glb", { frames = 1 }))
    assert.is_nil(doc.animations)
  end)

  it("writes triangles that enclose the volume of the shapes", function()
    run:stl(folder .. "/a.stl", { t = 0 })
    local text = sink.read_file(folder .. "/a.stl")
    local count = ("<I4"):unpack(text, 81)
    assert.equal(84 + 50 * count, #text)
    local volume = 0 -- by the divergence theorem
    for k = 0, count - 1 do
      local v = { ("<ffffffffffff"):unpack(text, 85 + 50 * k) }
      local a, b, c = { v[4], v[5], v[6] }, { v[7], v[8], v[9] }, { v[10], v[11], v[12] }
      local n = { b[2] * c[3] - b[3] * c[2], b[3] * c[1] - b[1] * c[3], b[1] * c[2] - b[2] * c[1] }
      local open = a[2] >= 3 -- the cloth is not closed
      volume = volume + (open and 0 or 1) * (a[1] * n[1] + a[2] * n[2] + a[3] * n[3]) / 6
    end
    local r, hose = 0.0025, 0.01
    local wanted = 0.05 * 0.2 * 0.04 + 4 / 3 * math.pi * 0.02 ^ 3 + math.pi * r ^ 2 * 0.25
      + math.pi * hose ^ 2 * 0.1
    assert.near(wanted, volume, 0.03 * wanted) -- round shapes become polygons
  end)

  it("writes OBJ files that can be read back as obstacles", function()
    local path = run:obj(folder .. "/a.obj", { t = 0.2 })
    local text = sink.read_file(path)
    for _, name in ipairs { "block", "w_1", "hose", "cloth" } do
      assert.truthy(text:find("\no " .. name .. "\n", 1, true), name)
    end
    local other = sw.scene {}
    local back = other:obstacle { shape = "mesh", file = path }
    assert.near(0, (back.shape:distance { 0.3, 0, 0.04 }), 1e-6) -- on top of the block
  end)

  it("refuses wrong arguments by name, and leaves no files", function()
    local list = files.list(folder)
    local function refuses(method, path, args, text)
      local fine, why = pcall(run[method], run, path, args)
      assert.is_false(fine)
      assert.truthy(tostring(why):find(text, 1, true), why)
    end
    refuses("gltf", folder .. "/x.gltf", nil, "does not end in .glb")
    refuses("obj", folder .. "/x.stl", nil, "does not end in .obj")
    refuses("gltf", nil, nil, "expects the name of a .glb file")
    refuses("gltf", folder .. "/x.glb", { frame = 3 }, "did you mean 'frames'?")
    refuses("gltf", folder .. "/no/x.glb", nil, "No such file")
    os.execute("ln -s /dev/full " .. sink.quote(folder .. "/full.glb"))
    refuses("gltf", folder .. "/full.glb", nil, "No space left on device")
    os.remove(folder .. "/full.glb")
    local bare = sw.scene {}
    bare:wire { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    local none = bare:run { duration = 0.01, dt = 0.01, frames = false }
    for _, method in ipairs { "gltf", "obj", "stl" } do
      local kind = method == "gltf" and "glb" or method
      assert.error_matches(function() none[method](none, folder .. "/x." .. kind) end, "has no frames")
    end
    assert.same(list, files.list(folder))
  end)

  it("says that a run of 0 s has no frames, and why", function()
    local scene, list = sw.scene {}, files.list(folder)
    scene:wire { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    scene:process(function() end)
    local empty = scene:run { dt = 0.01 }
    assert.equal(0, empty.steps)
    for method, kind in pairs { gltf = "glb", obj = "obj", stl = "stl", vtk = "pvd", film = "gif",
      picture = "png" } do
      local path = folder .. "/x." .. kind
      local fine, why = pcall(empty[method], empty, method == "picture" and { path = path } or path)
      assert.is_false(fine)
      assert.truthy(why:find("the run of 'scene' has no frames, because it has no step: 0 s have passed", 1,
        true), why)
    end
    assert.same(list, files.list(folder))
  end)
end)
