-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes one frame of a run as a POV-Ray 3.7 scene.
-- The camera's axes are given explicitly, because POV-Ray is left-handed by default;
-- colours are srgb. Wires are unions of spheres and cylinders; wires that are meshes of
-- particles are meshes of triangles with smooth normals.
-- @module softworld.output.povscene

local solid = require "softworld.output.solid"
local vec = require "softworld.vec"
local view = require "softworld.output.view"

local povscene = {}

--- How far a gripper is drawn along z of its pose, in widths.
povscene.grip_reach = 4.2

local format = string.format

local function numbers(v)
  return format("%.9g,%.9g,%.9g", v[1], v[2], v[3])
end

local function vector(v)
  return "<" .. numbers(v) .. ">"
end

-- Orange, blue-green, ...: distinct with the common colour blindnesses.
local wire_colours = {
  { 0.90, 0.33, 0.05 }, { 0.00, 0.62, 0.45 }, { 0.80, 0.47, 0.65 },
  { 0.94, 0.89, 0.26 }, { 0.00, 0.45, 0.70 },
}
local obstacle_colour = { 0.52, 0.69, 0.87 }
local table_colour = { 0.82, 0.80, 0.765 }
local jaw_colour, palm_colour = { 0.33, 0.37, 0.43 }, { 0.70, 0.73, 0.77 }

--- Colours, sRGB: of wires in turn, obstacles, planes, jaws, palms and stems of grippers, zones to keep out
-- of, and zones that have a temperature.
povscene.colours = { wires = wire_colours, obstacle = obstacle_colour, plane = table_colour,
  jaw = jaw_colour, palm = palm_colour, zone = { 0.84, 0.24, 0.24 }, heat = { 0.90, 0.58, 0.10 } }

-- Finishes: response to ambient light and to the lamps, and gloss.
local matt = "finish { ambient 0.13 diffuse 0.72 }"
local satin = "finish { ambient 0.16 diffuse 0.75 specular 0.15 roughness 0.05 }"
local glossy = "finish { ambient 0.16 diffuse 0.75 specular 0.45 roughness 0.02 }"

local function colour(c)
  return format("srgb %s", vector(c))
end

local function matrix(pose)
  local p, q = solid.pose(pose)
  local m = {}
  for _, axis in ipairs { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } do
    for _, x in ipairs { solid.rotate(q, axis[1], axis[2], axis[3]) } do m[#m + 1] = format("%.9g", x) end
  end
  return format("matrix <%s,%.9g,%.9g,%.9g>", table.concat(m, ","), p[1], p[2], p[3])
end

local function head(add, camera)
  add "#version 3.7;\nglobal_settings { assumed_gamma 1.0 max_trace_level 8 }\n"
  add "background { srgb <0.965,0.97,0.98> }\n"
  add(format("camera { perspective location %s direction %s right %s up %s }\n", vector(camera.at),
    vector(camera.forward), vector { camera.right[1] * 2 * camera.tx, camera.right[2] * 2 * camera.tx,
      camera.right[3] * 2 * camera.tx },
    vector { camera.up[1] * 2 * camera.ty, camera.up[2] * 2 * camera.ty, camera.up[3] * 2 * camera.ty }))
end

-- Adds a broad key light from behind the viewer's left shoulder and a weak one
-- from the right that casts no shadow.
local function lights(add, camera, up, size)
  local function place(right, rise, back)
    local p = {}
    for i = 1, 3 do
      p[i] = camera.middle[i] + size * (right * camera.right[i] + rise * up[i] - back * camera.forward[i])
    end
    return vector(p)
  end
  local spread = format("%.9g", 0.35 * size)
  add(format("light_source { %s srgb 1.04 area_light <%s,0,0>, <0,%s,0>, 5, 5",
    place(-1.4, 2.0, 0.9), spread, spread))
  add " adaptive 1 jitter circular orient }\n"
  add(format("light_source { %s srgb 0.5 shadowless }\n", place(1.6, 1.2, 1.4)))
end

--- Returns the side of the table's squares: 1, 2 or 5 times a power of ten.
-- @tparam number size of the scene [m]
-- @treturn number [m]
function povscene.square(size)
  local wanted = size / 16
  local power = 10.0 ^ math.floor(math.log(wanted, 10))
  local lead = wanted / power
  return power * (lead < 1.5 and 1 or lead < 3.5 and 2 or lead < 7.5 and 5 or 10)
end

local function plane(add, obstacle, pose, camera, size)
  local n, p = solid.normal(obstacle, pose), solid.pose(pose)
  local height = 0
  for i = 1, 3 do height = height + n[i] * (camera.at[i] - p[i]) end
  if height <= 0 then return end -- seen from below it would hide everything
  local v = solid.plane_piece(obstacle, pose, p, 0.5).vertices
  local u = { v[4] - v[1], v[5] - v[2], v[6] - v[3] }
  local w = { v[10] - v[1], v[11] - v[2], v[12] - v[3] }
  local square = povscene.square(size)
  local c = obstacle.color or table_colour
  local light = { c[1] + 0.22 * (1 - c[1]), c[2] + 0.22 * (1 - c[2]), c[3] + 0.22 * (1 - c[3]) }
  add(format("plane { z, 0 texture { pigment { checker color %s color %s scale %.9g translate z*%.9g }\n",
    colour(c), colour(light), square, square / 2))
  add(format("%s }\nmatrix <%s,%s,%s,%s> }\n", matt, numbers(u), numbers(w), numbers(n), numbers(p)))
end

local function mesh(add, shape)
  local v = {}
  for i = 1, #shape.vertices, 3 do
    v[#v + 1] = vector { shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2] }
  end
  add(format("mesh2 { vertex_vectors { %d,\n%s }\n", #v, table.concat(v, ",\n")))
  local f = {}
  for i = 1, #shape.indices, 3 do
    f[#f + 1] = format("<%d,%d,%d>", shape.indices[i], shape.indices[i + 1], shape.indices[i + 2])
  end
  add(format("face_indices { %d,\n%s }\n", #f, table.concat(f, ",\n")))
end

local function write_list(add, name, items)
  add(format("%s { %d,\n%s }\n", name, #items, table.concat(items, ",\n")))
end

-- Returns the unit normal of a triangle; its corners are places in the flat list of vertices.
local function normal_of(v, a, b, c)
  local p, q = {}, {}
  for k = 1, 3 do p[k], q[k] = v[b + k] - v[a + k], v[c + k] - v[a + k] end
  return vec.unit(vec.cross(p, q)) or { 0, 0, 1 }
end

local FLAT = math.cos(math.rad(30)) -- cosine of the largest angle between faces that are shaded as one [-]

-- Gives each corner of each triangle the mean normal of those faces around it that meet the triangle
-- smoothly.
local function smooth(add, shape)
  local v, f, faces, around = shape.vertices, shape.indices, {}, {}
  for i = 1, #f, 3 do
    faces[i] = normal_of(v, 3 * f[i], 3 * f[i + 1], 3 * f[i + 2])
    for k = i, i + 2 do
      around[f[k]] = around[f[k]] or {}
      table.insert(around[f[k]], faces[i])
    end
  end
  local places, normals, list = {}, {}, {}
  for k, corner in ipairs(f) do
    local own, sum = faces[k - (k - 1) % 3], { 0, 0, 0 }
    for _, n in ipairs(around[corner]) do
      if vec.dot(n, own) > FLAT then sum = vec.add(sum, n) end
    end
    places[k] = vector { v[3 * corner + 1], v[3 * corner + 2], v[3 * corner + 3] }
    normals[k] = vector(sum)
    if k % 3 == 0 then list[#list + 1] = format("<%d,%d,%d>", k - 3, k - 2, k - 1) end
  end
  add "mesh2 {\n"
  write_list(add, "vertex_vectors", places)
  write_list(add, "normal_vectors", normals)
  write_list(add, "face_indices", list)
end

local openers = {
  box = function(add, o)
    local s = o.size
    local half = { s[1] / 2, s[2] / 2, s[3] / 2 }
    add(format("box { -%s, %s\n", vector(half), vector(half)))
  end,
  sphere = function(add, o) add(format("sphere { 0, %.9g\n", o.radius)) end,
  cylinder = function(add, o)
    add(format("cylinder { z*%.9g, z*%.9g, %.9g\n", -o.length / 2, o.length / 2, o.radius))
  end,
  capsule = function(add, o)
    local h, r = o.length / 2, o.radius
    add(format("merge { cylinder { z*%.9g, z*%.9g, %.9g } sphere { z*%.9g, %.9g } sphere { z*%.9g, %.9g }\n",
      -h, h, r, -h, r, h, r))
  end,
}

-- Draws any other shape as triangles; round shapes are shaded smoothly.
local function triangles(add, o)
  local shape = solid.triangles(o, 64)
  if o.vertices then mesh(add, shape) else smooth(add, shape) end
end

local function obstacle(add, o, pose, camera, size)
  solid.check(o)
  if solid.flat(o) then return plane(add, o, pose, camera, size) end
  local c = o.color or obstacle_colour
  local opener = openers[o.shape] or triangles
  opener(add, o)
  add(format("texture { pigment { %s transmit %.3g } %s }\n%s }\n", colour(c), o.transparency or 0.1, satin,
    matrix(pose)))
end

-- Draws a zone transparent, so that wires in it are visible.
local function zone(add, z, pose)
  triangles(add, z)
  add(format("no_shadow texture { pigment { %s transmit 0.75 } }\n%s }\n",
    colour(povscene.colours[z.temperature and "heat" or "zone"]), matrix(pose)))
end

-- Draws a wire; points nearer to the last one than a tenth of the radius are left out of the union.
local function wire(add, points, radius, c)
  add "union {\n"
  local last
  for i = 1, #points, 3 do
    local p = { points[i], points[i + 1], points[i + 2] }
    local away = last and math.sqrt((p[1] - last[1]) ^ 2 + (p[2] - last[2]) ^ 2 + (p[3] - last[3]) ^ 2)
    if not last or away > 0.1 * radius then
      add(format("sphere { %s, %.9g }", vector(p), radius))
      if last then add(format(" cylinder { %s, %s, %.9g }", vector(last), vector(p), radius)) end
      add "\n"
      last = p
    end
  end
  add(format("texture { pigment { %s } %s } }\n", colour(c), glossy))
end

local function jaw(add, w, from, to)
  add(format("box { <%.9g,%.9g,%.9g>, <%.9g,%.9g,%.9g> }\n", -w / 2, from, -0.6 * w, w / 2, to, 2 * w))
end

-- Returns at each point the sum of the normals of its faces.
local function normals(points, quads)
  local out = {}
  for i = 1, #points do out[i] = 0 end
  for i = 1, #quads, 4 do
    local a, b, c, d = 3 * quads[i], 3 * quads[i + 1], 3 * quads[i + 2], 3 * quads[i + 3]
    local p, q = {}, {} -- the diagonals
    for k = 1, 3 do p[k], q[k] = points[c + k] - points[a + k], points[d + k] - points[b + k] end
    local nx, ny, nz = p[2] * q[3] - p[3] * q[2], p[3] * q[1] - p[1] * q[3], p[1] * q[2] - p[2] * q[1]
    for _, corner in ipairs { a, b, c, d } do
      out[corner + 1] = out[corner + 1] + nx
      out[corner + 2] = out[corner + 2] + ny
      out[corner + 3] = out[corner + 3] + nz
    end
  end
  return out
end

-- Draws a tube. The ends have points of their own, so that their edges stay sharp.
local function tube(add, surface, line, factor, c)
  local points = solid.thickened(surface, line, factor)
  local quads, ends = solid.tube_faces(surface)
  local n, vertices, across, faces = normals(points, quads), {}, {}, {}
  local function face(a, b, d) faces[#faces + 1] = format("<%d,%d,%d>", a, b, d) end
  local function vertex(flat, i, normal)
    vertices[#vertices + 1] = vector { flat[i + 1], flat[i + 2], flat[i + 3] }
    across[#across + 1] = normal
  end
  for i = 0, #points - 1, 3 do vertex(points, i, vector { n[i + 1], n[i + 2], n[i + 3] }) end
  for i = 1, #quads, 4 do
    face(quads[i], quads[i + 1], quads[i + 2])
    face(quads[i], quads[i + 2], quads[i + 3])
  end
  for e, corners in ipairs(ends) do
    local at = e == 1 and 0 or #line - 3
    local inner = e == 1 and 3 or #line - 6
    local out = vector { line[at + 1] - line[inner + 1], line[at + 2] - line[inner + 2],
      line[at + 3] - line[inner + 3] }
    local first = #vertices
    vertex(line, at, out)
    for k, corner in ipairs(corners) do
      vertex(points, 3 * corner, out)
      face(first, first + k, first + k % #corners + 1)
    end
  end
  add "mesh2 {\n"
  write_list(add, "vertex_vectors", vertices)
  write_list(add, "normal_vectors", across)
  write_list(add, "face_indices", faces)
  add(format("texture { pigment { %s } %s } }\n", colour(c), glossy))
end

local function painted(c)
  return format("texture { pigment { %s } %s }", colour(c), satin)
end

-- Draws a gripper: two jaws at +-y of the grip's pose, wire along x, palm and stem at +z.
local function grip(add, pose, w, gap)
  local reach = gap + 0.45 * w
  add "union { union {\n"
  jaw(add, w, gap, reach)
  jaw(add, w, -reach, -gap)
  add(painted(jaw_colour) .. " }\nunion {\n")
  local half = { 0.65 * w, 1.4 * w, 0.3 * w }
  add(format("box { -%s, %s translate z*%.9g }\n", vector(half), vector(half), 2.2 * w))
  add(format("cylinder { z*%.9g, z*%.9g, %.9g }\n", 2.5 * w, povscene.grip_reach * w, 0.4 * w))
  add(format("%s }\n%s }\n", painted(palm_colour), matrix(pose)))
end

local function grips(add, run, frame, look)
  local radius = run.wires[1] and run.wires[1].radius or 0
  for i, pose in ipairs(frame.grips or {}) do
    local w = math.max((run.grips and run.grips[i] or {}).width or 0, look.smallest_grip)
    local closed = math.min(radius * look.thickness, 0.4 * w)
    if pose then grip(add, pose, w, pose.held and closed or closed + 0.5 * w) end
  end
end

-- Drawers of holds that stand still or are moved by hand: w is half the size, the wire lies along x.
local clamp_makers = {}

--- Two plates on a block, one above the wire and one below.
function clamp_makers.clamp(add, w)
  add(format("box { <%.9g,%.9g,%.9g>, <%.9g,%.9g,%.9g> }\n", -w, -w, 0.3 * w, w, w, w))
  add(format("box { <%.9g,%.9g,%.9g>, <%.9g,%.9g,%.9g> }\n", -w, -w, -w, w, w, -0.3 * w))
  add(format("box { <%.9g,%.9g,%.9g>, <%.9g,%.9g,%.9g> }\n", -w, 0.6 * w, -w, w, w, w))
end

--- A ball on an axle across the wire.
function clamp_makers.pin(add, w)
  add(format("sphere { 0, %.9g }\ncylinder { -y*%.9g, y*%.9g, %.9g }\n", 0.8 * w, 1.6 * w, 1.6 * w,
    0.3 * w))
end

--- A tube around the wire.
function clamp_makers.feed(add, w)
  add(format("difference { cylinder { -x*%.9g, x*%.9g, %.9g } cylinder { -x*%.9g, x*%.9g, %.9g } }\n",
    1.6 * w, 1.6 * w, w, 2 * w, 2 * w, 0.6 * w))
end

local function clamps(add, run, frame, look)
  local radius = run.wires[1] and run.wires[1].radius or 0
  for i, pose in ipairs(frame.clamps or {}) do
    if pose then
      local w = math.max(2.2 * radius * look.thickness, 0.5 * look.smallest_grip)
      add "union {\n"
      clamp_makers[run.clamps[i].kind or "clamp"](add, w)
      add(format("%s\n%s }\n", painted(jaw_colour), matrix(pose)))
    end
  end
end

--- Returns the scene of one frame.
-- @tparam table run
-- @tparam table frame one of run.frames
-- @tparam table look `camera` (see view.camera), `size` of the scene [m],
-- `thickness` factor on the wires' radius, `smallest_grip` width [m]
-- @treturn string POV-Ray text
function povscene.text(run, frame, look)
  local parts = {}
  local function add(text) parts[#parts + 1] = text end
  head(add, look.camera)
  lights(add, look.camera, view.up(run), look.size)
  for i, o in ipairs(run.obstacles or {}) do
    local pose = (frame.obstacles or {})[i]
    if pose ~= false then obstacle(add, o, pose, look.camera, look.size) end
  end
  for _, z in ipairs(run.zones or {}) do
    local pose = solid.carried(z, frame)
    if pose then zone(add, z, pose) end
  end
  for i, points in ipairs(frame.wires) do
    local w = run.wires[i]
    local c, surface = w.color or wire_colours[(i - 1) % #wire_colours + 1], (frame.surfaces or {})[i]
    if surface then
      tube(add, surface, points, look.thickness, c)
    elseif #points > 0 then
      wire(add, points, w.radius * look.thickness, c)
    end
  end
  grips(add, run, frame, look)
  clamps(add, run, frame, look)
  return table.concat(parts)
end

return povscene
