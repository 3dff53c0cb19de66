-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes a moment of a run as triangles: Wavefront OBJ with objects by name, or binary STL. Lengths in m, z
-- up as in the scene.
-- @module softworld.output.triangles
local core = require "softworld.core"
local props = require "softworld.output.props"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"
local vec = require "softworld.vec"

local triangles = {}

local sides, rounds = 16, 48 -- around a tube, around a round obstacle

local function floats(bytes, count)
  local list = {}
  for i = 1, count, 100 do
    local n = math.min(100, count - i + 1)
    table.move({ ("<" .. ("f"):rep(n)):unpack(bytes, 4 * i - 3) }, 1, n, i, list)
  end
  return list
end

local function integers(bytes)
  local list = {}
  for i = 1, #bytes // 4 do list[i] = ("<I4"):unpack(bytes, 4 * i - 3) end
  return list
end

-- Calls visit(name, flat vertices, flat corners from 0) for each object.
local function each(run, frame, thickness, visit)
  local function skin(shown, corners)
    local made = core.skin(run.scene, shown.slot, { frame.number }, sides, thickness, false)
    local list = made and (made.count > 0 and integers(made.triangles) or corners or {}) or {}
    if #list > 0 then visit(shown.name, floats(made.data, 3 * made.corners), list) end
  end
  for _, w in ipairs(run.wires) do skin(w) end
  for _, p in ipairs(run.particles) do skin(p, p.corners) end
  for i, o in ipairs(run.obstacles) do
    local pose = (frame.obstacles or {})[i]
    if pose ~= false and not solid.flat(o) then
      local mesh = solid.triangles(o, rounds)
      visit(o.name, solid.place(mesh.vertices, pose), mesh.indices)
    end
  end
  for _, prop in ipairs(props.of(run, frame, { thickness = thickness, smallest_grip = 0 })) do
    for k, part in ipairs(prop.parts) do
      local mesh = solid.triangles(part.shape, rounds)
      local own = solid.place(mesh.vertices, { position = part.at, rotation = part.rotation })
      visit(("%s %d"):format(prop.name, k), solid.place(own, prop.pose), mesh.indices)
    end
  end
end

local function obj(run, frame, thickness, write)
  local before = 0
  write(("# %s at t = %.9g s, written by SoftWorld %s; lengths in m, z up\n"):format(
    run.name:gsub("%c", " "), frame.t, core.version))
  each(run, frame, thickness, function(name, v, corners)
    write("o ", (name:gsub("[%c ]", "_")), "\n")
    for i = 1, #v, 3 do
      write(("v %.9g %.9g %.9g\n"):format(v[i], v[i + 1], v[i + 2]):gsub(",", ".") .. "")
    end
    for i = 1, #corners, 3 do
      write(("f %d %d %d\n"):format(corners[i] + before + 1, corners[i + 1] + before + 1,
        corners[i + 2] + before + 1))
    end
    before = before + #v // 3
  end)
end

local function stl(run, frame, thickness, write)
  local parts, count = {}, 0
  each(run, frame, thickness, function(_, v, corners)
    for i = 1, #corners, 3 do
      local p = {}
      for k = 0, 2 do p[k + 1] = table.move(v, 3 * corners[i + k] + 1, 3 * corners[i + k] + 3, 1, {}) end
      local n = vec.unit(vec.cross(vec.sub(p[2], p[1]), vec.sub(p[3], p[1]))) or { 0, 0, 0 }
      parts[#parts + 1] = ("<ffffffffffffI2"):pack(n[1], n[2], n[3], p[1][1], p[1][2], p[1][3], p[2][1],
        p[2][2],
        p[2][3], p[3][1], p[3][2], p[3][3], 0)
      count = count + 1
    end
  end)
  write((("SoftWorld, lengths in m"):gsub("$", (" "):rep(80)):sub(1, 80)), ("<I4"):pack(count))
  for _, part in ipairs(parts) do write(part) end
end

local kinds = { obj = obj, stl = stl }

--- Writes the frame of a run that is nearest to a time.
-- @tparam table run as softworld.run.files makes it for exchange, of the wanted frame
-- @tparam string path ending in .obj or .stl
-- @tparam string kind "obj" or "stl"
-- @tparam table options thickness, t
-- @treturn string the path
function triangles.write(run, path, kind, options)
  if sink.extension(path) ~= kind then sink.fail("run:%s: %s does not end in .%s", kind, path, kind) end
  local frame = run.frames[1]
  for _, f in ipairs(run.frames) do
    if math.abs(f.t - options.t) < math.abs(frame.t - options.t) then frame = f end
  end
  return sink.write_file(path, function(write) kinds[kind](run, frame, options.thickness or 1, write) end)
end

return triangles
