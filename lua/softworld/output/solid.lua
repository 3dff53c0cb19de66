-- SPDX-License-Identifier: GPL-3.0-or-later
--- Turns obstacles into triangles, and handles poses, for the writers of scenes.
-- Lengths in m; triangles wind so that their normals point outwards.
-- A solid is `{ vertices = flat {x,y,z,...}, indices = flat 0-based {i,j,k,...} }`.
-- @module softworld.output.solid

local checks = require "softworld.checks"
local core = require "softworld.core"
local sink = require "softworld.output.sink"
local vec = require "softworld.vec"

local solid = {}

--- Rotates a vector by a unit quaternion.
-- @tparam {w,x,y,z} q
-- @tparam number x
-- @tparam number y
-- @tparam number z
-- @treturn number,number,number
function solid.rotate(q, x, y, z)
  local w, a, b, c = q[1], q[2], q[3], q[4]
  local tx, ty, tz = 2 * (b * z - c * y), 2 * (c * x - a * z), 2 * (a * y - b * x)
  return x + w * tx + b * tz - c * ty, y + w * ty + c * tx - a * tz, z + w * tz + a * ty - b * tx
end

local identity = { 1, 0, 0, 0 }
local origin = { 0, 0, 0 }

--- Returns the position and rotation of a pose; missing ones are the identity.
-- @tparam ?table pose `{ position = {x,y,z} [m], rotation = {w,x,y,z} }`
-- @treturn table position
-- @treturn table rotation, of unit length
function solid.pose(pose)
  if not pose then return origin, identity end
  local q = pose.rotation or identity
  local norm = math.sqrt(q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2 + q[4] ^ 2)
  if norm == 0 or norm ~= norm then q, norm = identity, 1 end
  return pose.position or origin, { q[1] / norm, q[2] / norm, q[3] / norm, q[4] / norm }
end

--- Moves points from the body's axes to the world's.
-- @tparam table vertices flat
-- @tparam ?table pose
-- @treturn table flat, new
function solid.place(vertices, pose)
  local p, q = solid.pose(pose)
  local out = {}
  for i = 1, #vertices, 3 do
    local x, y, z = solid.rotate(q, vertices[i], vertices[i + 1], vertices[i + 2])
    out[i], out[i + 1], out[i + 2] = x + p[1], y + p[2], z + p[3]
  end
  return out
end

--- Returns the pose of a zone in a frame: its own, or relative to its obstacle, zone.on = { slot, position,
-- rotation }.
-- @treturn ?table pose; nil: its obstacle is not there
function solid.carried(zone, frame)
  if not zone.on then return zone end
  local carrier = (frame.obstacles or {})[zone.on.slot + 1]
  if not carrier then return nil end
  local p, q = solid.pose(carrier)
  local x, y, z = solid.rotate(q, table.unpack(zone.on.position))
  return { position = { p[1] + x, p[2] + y, p[3] + z }, rotation = vec.multiply(q, zone.on.rotation) }
end

local FLAT = 0.999 -- least cosine between the normals of two triangles of one flat face [-]

local function normal_of(v, i, j, k)
  local function point(c) return { v[3 * c + 1], v[3 * c + 2], v[3 * c + 3] } end
  local a = point(i)
  return vec.unit(vec.cross(vec.sub(point(j), a), vec.sub(point(k), a)))
end

--- Returns the edges of a solid of triangles, without those within a flat face.
-- @tparam table shape `vertices` flat [m], `indices` of corners from 0
-- @treturn table flat list of their ends [m]
function solid.edges(shape)
  local v, normals, ends, order, out = shape.vertices, {}, {}, {}, {}
  local function key_of(c) return ("%.9g %.9g %.9g"):format(v[3 * c + 1], v[3 * c + 2], v[3 * c + 3]) end
  for t = 1, #shape.indices, 3 do
    local corners = { shape.indices[t], shape.indices[t + 1], shape.indices[t + 2] }
    local n = normal_of(v, corners[1], corners[2], corners[3])
    for e = 1, n and 3 or 0 do
      local a, b = corners[e], corners[e % 3 + 1]
      local ka, kb = key_of(a), key_of(b)
      local key = ka < kb and ka .. "|" .. kb or kb .. "|" .. ka
      if not normals[key] then normals[key], ends[key], order[#order + 1] = {}, { a, b }, key end
      table.insert(normals[key], n)
    end
  end
  for _, key in ipairs(order) do
    local n = normals[key]
    if #n ~= 2 or vec.dot(n[1], n[2]) < FLAT then
      for _, c in ipairs(ends[key]) do table.move(v, 3 * c + 1, 3 * c + 3, #out + 1, out) end
    end
  end
  return out
end

--- Returns the direction of a plane's normal in the world, of unit length.
-- @tparam table obstacle with `normal` (default z)
-- @tparam ?table pose
-- @treturn table {x,y,z}
function solid.normal(obstacle, pose)
  local n = obstacle.normal or { 0, 0, 1 }
  local _, q = solid.pose(pose)
  local length = math.sqrt(n[1] ^ 2 + n[2] ^ 2 + n[3] ^ 2)
  return { solid.rotate(q, n[1] / length, n[2] / length, n[3] / length) }
end

-- The kinds of shape by name; filled when first read.
local kinds = setmetatable({}, { __index = function(all, name)
  for _, kind in ipairs(core.registry().shapes) do rawset(all, kind.name, kind) end
  setmetatable(all, nil)
  return all[name]
end })

--- True if an obstacle is a half space; only a piece of it is drawn.
function solid.flat(obstacle)
  local kind = kinds[obstacle.shape]
  return kind ~= nil and kind.flat
end

-- Returns the obstacle's shape, made from the parameters that its kind's rows name.
local function shape_of(obstacle, kind)
  local args = { shape = kind.name }
  for _, row in ipairs(kind.params) do args[row.name] = obstacle[row.name] end
  local fine, shape = pcall(core.shape, args)
  if not fine then sink.fail("%s: %s", obstacle.name or "obstacle", shape) end
  return shape
end

--- Raises an error if an obstacle's shape or measures are missing.
-- @tparam table obstacle
function solid.check(obstacle)
  local kind = kinds[obstacle.shape]
  if not kind then
    sink.fail("%s: unknown shape %s", obstacle.name or "obstacle", checks.shown(obstacle.shape))
  end
  if not obstacle.vertices then shape_of(obstacle, kind):close() end
end

--- Returns a shape of the core as triangles.
-- @tparam userdata shape
-- @tparam ?integer around points around a round shape, a multiple of 4
-- @treturn table solid
function solid.of_shape(shape, around)
  local vertices, indices = shape:triangles(around)
  for i, corner in ipairs(indices) do indices[i] = corner - 1 end
  return { vertices = vertices, indices = indices }
end

--- Stores the triangles of a shape made from a list or a file in the obstacle's entry, because making
-- them again takes long.
function solid.keep(entry, shape)
  if not kinds[entry.shape].listed then return end
  local own = solid.of_shape(shape)
  entry.vertices, entry.indices = own.vertices, own.indices
end

--- Returns an obstacle as triangles in its own axes.
-- @tparam table obstacle any but a half space
-- @tparam[opt=32] integer around points around a round shape, a multiple of 4
-- @treturn table solid
function solid.triangles(obstacle, around)
  solid.check(obstacle)
  if obstacle.vertices then return obstacle end
  local shape = shape_of(obstacle, kinds[obstacle.shape])
  local own = solid.of_shape(shape, around or 32)
  shape:close()
  return own
end

--- Returns a square piece of a plane, in the world's axes.
-- @tparam table obstacle a half space
-- @tparam ?table pose
-- @tparam {x,y,z} centre a point near which the piece is wanted [m]
-- @tparam number half half its side [m]
-- @treturn table solid
function solid.plane_piece(obstacle, pose, centre, half)
  local n, p = solid.normal(obstacle, pose), solid.pose(pose)
  local away = 0
  for i = 1, 3 do away = away + n[i] * (centre[i] - p[i]) end
  local u = math.abs(n[1]) < 0.9 and { 1 - n[1] * n[1], -n[1] * n[2], -n[1] * n[3] }
    or { -n[2] * n[1], 1 - n[2] * n[2], -n[2] * n[3] }
  local length = math.sqrt(u[1] ^ 2 + u[2] ^ 2 + u[3] ^ 2)
  for i = 1, 3 do u[i] = u[i] / length end
  local w = { n[2] * u[3] - n[3] * u[2], n[3] * u[1] - n[1] * u[3], n[1] * u[2] - n[2] * u[1] }
  local vertices = {}
  for _, corner in ipairs { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } } do
    for i = 1, 3 do
      vertices[#vertices + 1] = centre[i] - away * n[i] + half * (corner[1] * u[i] + corner[2] * w[i])
    end
  end
  return { vertices = vertices, indices = { 0, 1, 2, 0, 2, 3 } }
end

--- True if two poses are equal number by number.
-- @tparam ?table a
-- @tparam ?table b
-- @treturn boolean
function solid.same_pose(a, b)
  if a == false or b == false then return a == b end -- not there
  local pa, qa = solid.pose(a)
  local pb, qb = solid.pose(b)
  for i = 1, 3 do if pa[i] ~= pb[i] then return false end end
  for i = 1, 4 do if qa[i] ~= qb[i] then return false end end
  return true
end

local function widen(bounds, points)
  for i = 1, #points, 3 do
    for c = 1, 3 do
      local x = points[i + c - 1]
      if x == x and math.abs(x) < math.huge then
        bounds.low[c], bounds.high[c] = math.min(bounds.low[c], x), math.max(bounds.high[c], x)
      end
    end
  end
end

-- Shows both end sections first, because the corners of the view are often there, then all points.
local function see_surface(surface, see)
  local points, n = surface.points, 3 * surface.around
  see(table.move(points, 1, n, 1, {}))
  see(points)
  see(table.move(points, #points - n + 1, #points, 1, {}))
end

--- Returns the smallest box along the axes around all wires, obstacles other than
-- planes, and grips of a run.
-- @tparam table run
-- @tparam[opt] function visit called with each flat list of points as well;
-- an obstacle at rest is visited once
-- (run.seen: a table in which the box is kept, if the run does not change any more)
-- @treturn table `{ low = {x,y,z}, high = {x,y,z}, centre = {x,y,z}, size = diagonal }` [m]
function solid.bounds(run, visit)
  if run.seen and run.seen.bounds and not visit then return run.seen.bounds end
  local bounds = { low = { math.huge, math.huge, math.huge }, high = { -math.huge, -math.huge, -math.huge } }
  local function see(points)
    widen(bounds, points)
    if visit then visit(points) end
  end
  local shapes, before = {}, {}
  for i, o in ipairs(run.obstacles or {}) do shapes[i] = not solid.flat(o) and solid.triangles(o, 8) end
  for f, frame in ipairs(run.frames) do
    for _, points in ipairs(frame.wires or {}) do see(points) end
    for _, points in ipairs(frame.particles or {}) do see(points) end
    for _, surface in ipairs(frame.surfaces or {}) do
      if surface then see_surface(surface, see) end
    end
    for i, shape in ipairs(shapes) do
      local pose = (frame.obstacles or {})[i]
      if shape and pose ~= false and (f == 1 or not solid.same_pose(pose, before[i])) then
        see(solid.place(shape.vertices, pose))
      end
      before[i] = pose
    end
    for _, kind in ipairs{ "grips", "clamps" } do
      for _, grip in ipairs(frame[kind] or {}) do
        if grip then see((solid.pose(grip))) end
      end
    end
  end
  if bounds.low[1] > bounds.high[1] then bounds.low, bounds.high = { -1, -1, -1 }, { 1, 1, 1 } end
  local low, high, square = bounds.low, bounds.high, 0
  bounds.centre = {}
  for c = 1, 3 do
    bounds.centre[c] = (low[c] + high[c]) / 2
    square = square + (high[c] - low[c]) ^ 2
  end
  bounds.size = math.max(math.sqrt(square), 1e-6)
  if run.seen and not visit then run.seen.bounds = bounds end
  return bounds
end

--- Returns the surface of a wire that is a mesh of particles, as quadrilaterals and two ends.
-- @tparam table surface `around` points for each section, `points` flat, of all sections [m]
-- @treturn table flat list of corners from 0, four for each quadrilateral, outwards
-- @treturn table corners of the first and of the last section, in outward order
function solid.tube_faces(surface)
  local n, quads, ends = surface.around, {}, { {}, {} }
  local last = #surface.points // 3 - n
  for first = 0, last - n, n do
    for k = 0, n - 1 do
      local a, b = first + k, first + (k + 1) % n
      table.move({ a, b, b + n, a + n }, 1, 4, #quads + 1, quads)
    end
  end
  for k = 0, n - 1 do ends[1][k + 1], ends[2][k + 1] = n - 1 - k, last + k end
  return quads, ends
end

--- Returns the triangles that the edges of a surface enclose.
-- @tparam string edges pairs of numbers from 0, 32 bits each
-- @treturn table flat list of corners from 0
function solid.enclosed(edges)
  local beside, corners = {}, {}
  for i = 1, #edges, 8 do
    local a, b = ("<I4I4"):unpack(edges, i)
    a, b = math.min(a, b), math.max(a, b)
    beside[a] = beside[a] or {}
    beside[a][b] = true
  end
  for i = 1, #edges, 8 do
    local a, b = ("<I4I4"):unpack(edges, i)
    a, b = math.min(a, b), math.max(a, b)
    for c in pairs(beside[b] or {}) do
      if beside[a][c] then table.move({ a, b, c }, 1, 3, #corners + 1, corners) end
    end
  end
  return corners
end

local function all_finite(points)
  for i = 1, #points do
    local x = points[i]
    if x ~= x or x == math.huge or x == -math.huge then return false end
  end
  return true
end

--- Returns a surface's points with their distance from the centre line scaled by a factor.
function solid.thickened(surface, line, factor)
  local points, n = surface.points, 3 * surface.around
  if factor == 1 then return points end
  local out = {}
  for i = 1, #points do
    local middle = line[3 * ((i - 1) // n) + (i - 1) % 3 + 1]
    out[i] = middle + factor * (points[i] - middle)
  end
  return out
end

--- Returns a run without the frames that cannot be drawn, as diverged runs have.
-- @tparam table run
-- @treturn table the run itself, or a copy with fewer frames; raises if none is left
function solid.finite_run(run)
  local frames = {}
  for _, frame in ipairs(run.frames) do
    local fine = true
    for _, points in ipairs(frame.wires or {}) do fine = fine and all_finite(points) end
    for _, points in ipairs(frame.particles or {}) do fine = fine and all_finite(points) end
    for _, surface in ipairs(frame.surfaces or {}) do
      fine = fine and (not surface or all_finite(surface.points))
    end
    for _, pose in ipairs(frame.obstacles or {}) do
      fine = fine and (not pose or all_finite((solid.pose(pose))))
    end
    for _, pose in ipairs(frame.grips or {}) do
      fine = fine and (not pose or all_finite((solid.pose(pose))))
    end
    if fine then frames[#frames + 1] = frame end
  end
  if #frames == #run.frames and #frames > 0 then return run end
  if #frames == 0 then sink.fail("%s: no frame with finite coordinates", run.name or "run") end
  return setmetatable({ frames = frames }, { __index = run })
end

return solid
