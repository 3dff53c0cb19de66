-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes a run as glTF 2.0 in one file (.glb): wires as surfaces that change their shape (morph targets, one
-- for each frame), obstacles and grippers as moving bodies. Positions in m; glTF's y is up.
-- @module softworld.output.gltf
local core = require "softworld.core"
local json = require "softworld.output.json"
local povscene = require "softworld.output.povscene"
local props = require "softworld.output.props"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"
local vec = require "softworld.vec"
local view = require "softworld.output.view"

local gltf = {}

local FLOAT, INTEGER = 5126, 5125
local VERTICES, INDICES = 34962, 34963 -- targets of a buffer view
local sides = 12                       -- points around a tube
local rounds = 48                      -- points around a round obstacle

-- --- data -------------------------------------------------------------------------------

-- Adds bytes, aligned to 4; returns the number of their buffer view.
local function add_bytes(file, bytes, target)
  local pad = -#bytes % 4
  file.parts[#file.parts + 1] = bytes .. ("\0"):rep(pad)
  file.views[#file.views + 1] = { buffer = 0, byteOffset = file.size, byteLength = #bytes, target = target }
  file.size = file.size + #bytes + pad
  return #file.views - 1
end

local function add_accessor(file, accessor)
  file.accessors[#file.accessors + 1] = accessor
  return #file.accessors - 1
end

-- Returns x as a 32-bit float; bounds must be those of the stored values.
local function rounded(x) return (("<f"):unpack(("<f"):pack(x))) end

-- Adds flat values in groups of `width`, with bounds.
local function add_values(file, values, width, kind, target)
  local low, high = {}, {}
  for i, x in ipairs(values) do
    local c = (i - 1) % width + 1
    x = rounded(x)
    low[c], high[c] = math.min(low[c] or x, x), math.max(high[c] or x, x)
  end
  return add_accessor(file, { bufferView = add_bytes(file, sink.packed("f", values), target),
    componentType = FLOAT,
    count = #values // width, type = kind, min = low, max = high })
end

local function add_corners(file, bytes)
  return add_accessor(file, { bufferView = add_bytes(file, bytes, INDICES), componentType = INTEGER,
    count = #bytes // 4, type = "SCALAR" })
end

-- --- materials and meshes ---------------------------------------------------------------------

local function linear(x) return x <= 0.04045 and x / 12.92 or ((x + 0.055) / 1.055) ^ 2.4 end

local function material(file, colour, rough)
  local key = table.concat(colour, " ") .. " " .. rough
  if not file.known[key] then
    file.materials[#file.materials + 1] = { doubleSided = true, pbrMetallicRoughness = {
      baseColorFactor = { linear(colour[1]), linear(colour[2]), linear(colour[3]), 1 },
      metallicFactor = 0, roughnessFactor = rough } }
    file.known[key] = #file.materials - 1
  end
  return file.known[key]
end

local function add_mesh(file, mesh)
  file.meshes[#file.meshes + 1] = mesh
  return #file.meshes - 1
end

local function add_node(file, node)
  file.nodes[#file.nodes + 1] = node
  return #file.nodes - 1
end

-- Adds the triangles of a shape. Faces that are not smooth get corners of their own, which readers shade
-- flat.
local function add_shape(file, shape, colour)
  local key = table.concat(colour, " ")
  file.shapes[shape] = file.shapes[shape] or {}
  if not file.shapes[shape][key] then
    local mesh = solid.triangles(shape, rounds)
    file.shapes[shape][key] = add_mesh(file, { primitives = { {
      attributes = json.object { POSITION = add_values(file, mesh.vertices, 3, "VEC3", VERTICES) },
      indices = add_corners(file, sink.packed("I4", mesh.indices)),
      material = material(file, colour, 0.7) } } })
  end
  return file.shapes[shape][key]
end

-- --- wires -------------------------------------------------------------------------------------

-- Adds the skin's data of frame k: its corners, or their normals.
local function add_skin_part(file, skin, k, normals)
  local size = 12 * skin.corners
  local first = (skin.normals and 2 or 1) * size * (k - 1) + (normals and size or 0)
  local accessor = { bufferView = add_bytes(file, skin.data:sub(first + 1, first + size), VERTICES),
    componentType = FLOAT, count = skin.corners, type = "VEC3" }
  if not normals then
    accessor.min = table.move(skin.bounds, 6 * k - 5, 6 * k - 3, 1, {})
    accessor.max = table.move(skin.bounds, 6 * k - 2, 6 * k, 1, {})
  end
  return add_accessor(file, accessor)
end

local function attributes(file, skin, k)
  return json.object { POSITION = add_skin_part(file, skin, k),
    NORMAL = skin.normals and add_skin_part(file, skin, k, true) or nil }
end

-- Adds weights that give each target the weight 1 at its time and blend linearly between them.
local function add_weights(file, node, count)
  local values = {}
  for k = 1, count do
    for target = 2, count do values[#values + 1] = k == target and 1 or 0 end
  end
  file.channels[#file.channels + 1] = { sampler = #file.samplers, target = { node = node, path = "weights" } }
  file.samplers[#file.samplers + 1] = { input = file.times, output = add_values(file, values, 1, "SCALAR"),
    interpolation = "LINEAR" }
end

local function add_channel(file, node, path, values, width, kind)
  file.channels[#file.channels + 1] = { sampler = #file.samplers, target = { node = node, path = path } }
  file.samplers[#file.samplers + 1] = { input = file.times, output = add_values(file, values, width, kind),
    interpolation = path == "scale" and "STEP" or "LINEAR" }
end

-- Gives a node the size 0 in frames where its object does not exist yet or any more. lists: its points in
-- each frame.
local function hide(file, node, lists)
  local sizes, hides = {}, false
  for k, points in ipairs(lists) do
    local there = #points > 0 and 1 or 0
    for _ = 1, 3 do sizes[#sizes + 1] = there end
    if k == 1 and there == 0 then file.nodes[node + 1].scale = { 0, 0, 0 } end
    hides = hides or there == 0
  end
  if hides then add_channel(file, node, "scale", sizes, 3, "VEC3") end
end

-- corners: triangles of an object of particles; nil: the skin's own.
local function add_wire(file, run, shown, lists, colour, corners)
  local slot = shown.slot
  local skin = core.skin(run.scene, slot, file.numbers, sides, file.thickness, true)
  if not skin then return end
  local primitive = { attributes = attributes(file, skin, 1), material = material(file, colour, 0.45) }
  if skin.count > 0 then primitive.indices = add_corners(file, skin.triangles)
  elseif corners and #corners > 0 then primitive.indices = add_corners(file, sink.packed("I4", corners))
  else primitive.mode = 0 end -- as points
  local mesh, count = { name = shown.name, primitives = { primitive } }, #file.numbers
  if count > 1 then
    primitive.targets, mesh.weights = {}, {}
    for k = 2, count do
      primitive.targets[k - 1], mesh.weights[k - 1] = attributes(file, skin, k), 0
    end
  end
  local node = add_node(file, { name = shown.name, mesh = add_mesh(file, mesh) })
  table.insert(file.children, node)
  if count > 1 then
    add_weights(file, node, count)
    hide(file, node, lists)
  end
end

-- Returns the points of number i of a kind in each frame.
local function points_of(run, kind, i)
  local lists = {}
  for k, frame in ipairs(run.frames) do lists[k] = (frame[kind] or {})[i] or {} end
  return lists
end

-- --- bodies ---------------------------------------------------------------------------------------

-- glTF has quaternions as x, y, z, w.
local function turned(q) return { q[2], q[3], q[4], q[1] } end

-- poses: one per frame, false where the body is not there; its size is 0 then.
local function add_motion(file, node, poses)
  local places, turns, sizes, moves, hides = {}, {}, {}, false, false
  local known
  for _, pose in ipairs(poses) do known = known or pose or nil end
  local before
  for k, pose in ipairs(poses) do
    local p, q = solid.pose(pose or before or known)
    if before and not solid.same_pose(before, pose or before) then moves = true end
    local last = #turns -- q or -q, for the shorter rotation
    if last > 0 and q[2] * turns[last - 3] + q[3] * turns[last - 2] + q[4] * turns[last - 1]
      + q[1] * turns[last] < 0 then
      q = { -q[1], -q[2], -q[3], -q[4] }
    end
    table.move(p, 1, 3, #places + 1, places)
    table.move(turned(q), 1, 4, #turns + 1, turns)
    for _ = 1, 3 do sizes[#sizes + 1] = pose and 1 or 0 end
    hides, before = hides or not pose, pose or before or known
    if k == 1 then
      file.nodes[node + 1].translation, file.nodes[node + 1].rotation = { table.unpack(p, 1, 3) }, turned(q)
    end
  end
  if #poses < 2 then return end
  if moves then
    add_channel(file, node, "translation", places, 3, "VEC3")
    add_channel(file, node, "rotation", turns, 4, "VEC4")
  end
  if hides then add_channel(file, node, "scale", sizes, 3, "VEC3") end
end

local function poses_of(run, get)
  local list, any = {}, false
  for k, frame in ipairs(run.frames) do
    list[k] = get(frame)
    if list[k] == nil then list[k] = { position = { 0, 0, 0 } } end
    any = any or list[k]
  end
  return any and list
end

local function add_obstacle(file, run, i, o)
  local poses = poses_of(run, function(frame) return (frame.obstacles or {})[i] end)
  if not poses then return end
  local mesh
  if solid.flat(o) then -- a piece of the plane, in its own axes
    local piece = solid.plane_piece({ normal = o.normal }, nil, { 0, 0, 0 }, 1.5 * solid.bounds(run).size)
    mesh = add_mesh(file, { primitives = { {
      attributes = json.object { POSITION = add_values(file, piece.vertices, 3, "VEC3", VERTICES) },
      indices = add_corners(file, sink.packed("I4", piece.indices)),
      material = material(file, o.color or povscene.colours.plane, 0.9) } } })
  else
    mesh = add_shape(file, o, o.color or povscene.colours.obstacle)
  end
  local node = add_node(file, { name = o.name, mesh = mesh })
  table.insert(file.children, node)
  add_motion(file, node, poses)
end

local function add_prop(file, shown, poses, parts)
  local children = {}
  for _, part in ipairs(parts) do
    children[#children + 1] = add_node(file, { mesh = add_shape(file, part.shape, part.colour),
      translation = part.at, rotation = part.rotation and turned(part.rotation) or nil })
  end
  local node = add_node(file, { name = shown.name, children = children })
  table.insert(file.children, node)
  add_motion(file, node, poses)
end

local function add_props(file, run)
  local radius = run.wires[1] and run.wires[1].radius or 0
  for i, shown in ipairs(run.grips) do
    local poses = poses_of(run, function(frame) return frame.grips[i] or false end)
    local w = shown.width or 0.02
    if poses then add_prop(file, shown, poses, props.grip(w, math.min(radius, 0.4 * w))) end
  end
  for i, shown in ipairs(run.clamps) do
    local poses = poses_of(run, function(frame) return frame.clamps[i] or false end)
    if poses then add_prop(file, shown, poses, props.clamp(shown.kind, 2.2 * math.max(radius, 1e-4))) end
  end
end

-- --- the file -----------------------------------------------------------------------------------------

-- Returns the rotation that brings up to y.
local function upright(run)
  local up = view.up(run)
  local axis, c = vec.cross(up, { 0, 1, 0 }), up[2]
  if c < -0.999999 then return { 1, 0, 0, 0 } end
  local w = math.sqrt((1 + c) / 2)
  return { axis[1] / (2 * w), axis[2] / (2 * w), axis[3] / (2 * w), w }
end

local function document(file, run)
  local root = add_node(file, { name = run.name, rotation = upright(run),
    children = #file.children > 0 and file.children or nil })
  local doc = { asset = { version = "2.0", generator = "SoftWorld " .. core.version }, scene = 0,
    scenes = { { name = run.name, nodes = { root } } }, nodes = file.nodes }
  for _, name in ipairs { "meshes", "materials", "accessors" } do
    if #file[name] > 0 then doc[name] = file[name] end
  end
  if file.size > 0 then doc.bufferViews, doc.buffers = file.views, { { byteLength = file.size } } end
  if #file.channels > 0 then
    doc.animations = { { name = "run", channels = file.channels, samplers = file.samplers } }
  end
  return json.encode(doc)
end

local function write_chunks(file, text, write)
  text = text .. (" "):rep(-#text % 4)
  local total = 12 + 8 + #text + (file.size > 0 and 8 + file.size or 0)
  if total >= 2 ^ 32 then sink.fail("a .glb file: %.0f bytes are more than 4 GB; take fewer frames",
    total) end
  write("glTF", ("<I4I4"):pack(2, total), ("<I4"):pack(#text), "JSON", text)
  if file.size == 0 then return end
  write(("<I4"):pack(file.size), "BIN\0")
  for _, part in ipairs(file.parts) do write(part) end
end

--- Writes a run.
-- @tparam table run as softworld.run.files makes it for exchange: scene, slots and colours of wires,
-- particles
-- @tparam string path ending in .glb
-- @tparam table options thickness
-- @treturn string the path
function gltf.write(run, path, options)
  if sink.extension(path) ~= "glb" then sink.fail("run:gltf: %s does not end in .glb", path) end
  local file = { parts = {}, views = {}, accessors = {}, materials = {}, meshes = {}, nodes = {},
    children = {},
    channels = {}, samplers = {}, known = {}, shapes = {}, size = 0, numbers = {},
    thickness = options.thickness or 1 }
  local times = {}
  for k, frame in ipairs(run.frames) do
    file.numbers[k], times[k] = frame.number, frame.t - run.frames[1].t
  end
  if #times > 1 then file.times = add_values(file, times, 1, "SCALAR") end
  for i, w in ipairs(run.wires) do
    local colours = povscene.colours.wires
    add_wire(file, run, w, points_of(run, "wires", i), w.color or colours[(i - 1) % #colours + 1])
  end
  for i, p in ipairs(run.particles) do
    add_wire(file, run, p, points_of(run, "particles", i), p.color or povscene.colours.wires[1], p.corners)
  end
  for i, o in ipairs(run.obstacles) do add_obstacle(file, run, i, o) end
  add_props(file, run)
  local text = document(file, run)
  return sink.write_file(path, function(write) write_chunks(file, text, write) end)
end

return gltf
