-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes a run as a ParaView series: `laying.pvd` and a folder `laying.vtk` of `.vtp` files.
-- Part 0 holds the wires as polylines with point data radius [m], s (arc length [m]), tension [N],
-- bend_radius [m] and contact_force, the transverse force of obstacles and other wires at each node
-- [N]; its field data are all columns of the series at the frame's time. Part 1 holds
-- obstacles as triangles. Part 2 holds the surfaces of wires that are meshes of particles, with point
-- data s [m] and contact_force, the force of obstacles across the surface [N]. Cell data object counts
-- wires or obstacles from 0. Obstacles at rest share one file.
-- @module softworld.output.vtk

local core = require "softworld.core"
local json = require "softworld.output.json"
local letters = require "softworld.output.letters"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"

local vtk = {}

local per_line = 12

local function write_numbers(write, values)
  local number = sink.number
  for i = 1, #values, per_line do
    local line = {}
    for k = i, math.min(i + per_line - 1, #values) do line[#line + 1] = number(values[k]) end
    write(table.concat(line, " ") .. "\n")
  end
end

local function write_array(write, kind, name, values, components)
  write(string.format('<DataArray type="%s" Name="%s" format="ascii"%s>\n', kind, name,
    components and ' NumberOfComponents="' .. components .. '"' or ""))
  write_numbers(write, values)
  write "</DataArray>\n"
end

local function write_cells(write, tag, cells)
  write("<" .. tag .. ">\n")
  write_array(write, "Int64", "connectivity", cells.connectivity)
  write_array(write, "Int64", "offsets", cells.offsets)
  write("</" .. tag .. ">\n")
end

local function write_poly(write, data)
  local empty = { connectivity = {}, offsets = {} }
  local lines, polys = data.lines or empty, data.polys or empty
  write '<?xml version="1.0"?>\n'
  write '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<PolyData>\n'
  if data.fields and #data.fields > 0 then
    write "<FieldData>\n"
    for _, array in ipairs(data.fields) do
      write(string.format('<DataArray type="Float64" Name="%s" NumberOfTuples="1" format="ascii">\n',
        letters.xml(array.name)))
      write_numbers(write, { array.value })
      write "</DataArray>\n"
    end
    write "</FieldData>\n"
  end
  write(string.format('<Piece NumberOfPoints="%d" NumberOfVerts="0" NumberOfLines="%d" '
    .. 'NumberOfStrips="0" NumberOfPolys="%d">\n', #data.points // 3, #lines.offsets, #polys.offsets))
  write "<PointData>\n"
  for _, array in ipairs(data.point_data or {}) do write_array(write, "Float64", array.name, array.values) end
  write "</PointData>\n<CellData>\n"
  write_array(write, "Int32", "object", data.object)
  write "</CellData>\n<Points>\n"
  write_array(write, "Float64", "Points", data.points, 3)
  write "</Points>\n"
  write_cells(write, "Lines", lines)
  write_cells(write, "Polys", polys)
  write "</Piece>\n</PolyData>\n</VTKFile>\n"
end

-- Returns the arc length of the nodes: wire.s if given, else the chords of the first
-- frame, scaled to the wire's length.
local function arc_lengths(wire, points)
  if wire.s and #wire.s == #points // 3 then return wire.s end
  local s, sum = { 0.0 }, 0.0
  for i = 4, #points, 3 do
    local dx, dy, dz = points[i] - points[i - 3], points[i + 1] - points[i - 2], points[i + 2] - points[i - 1]
    sum = sum + math.sqrt(dx * dx + dy * dy + dz * dz)
    s[#s + 1] = sum
  end
  local scale = wire.length and sum > 0 and wire.length / sum or 1
  for i = 1, #s do s[i] = s[i] * scale end
  return s
end

-- Bend radius of straight wire; VTK's readers accept no infinity [m].
local STRAIGHT = 1e9

local function add_values(data, first, values, count)
  for k = 1, count do
    local bent = values.curvature[k] or 0 / 0
    data.point_data[3].values[first + k] = values.tension[k] or 0 / 0
    data.point_data[4].values[first + k] = bent == bent and math.min(STRAIGHT, 1 / bent) or bent
    data.point_data[5].values[first + k] = values.contact[k] or 0 / 0
  end
end

local function add_wire(data, index, points, s, radius)
  local first = #data.points // 3
  for i = 1, #points do data.points[#data.points + 1] = points[i] end
  local lines = data.lines
  for k = 0, #points // 3 - 1 do
    lines.connectivity[#lines.connectivity + 1] = first + k
    data.point_data[1].values[first + k + 1] = radius
    data.point_data[2].values[first + k + 1] = s[k + 1] or 0 / 0
  end
  lines.offsets[#lines.offsets + 1] = #lines.connectivity
  data.object[#data.object + 1] = index - 1
end

-- Returns the series' values of the sample nearest to a time.
local function fields_at(run, t)
  local series, fields = run.series, {}
  local times = series and series.time or {}
  if #times == 0 then return fields end
  local low, high = 1, #times
  while high - low > 1 do
    local middle = (low + high) // 2
    if times[middle] <= t then low = middle else high = middle end
  end
  local i = math.abs(times[low] - t) <= math.abs(times[high] - t) and low or high
  for c, column in ipairs(series.columns) do
    local value = column.values[i]
    -- For example nothing was held; VTK reads no nan. A radius of 0 would be the smallest of the run.
    if value ~= value then value = column.name:find "%.bend_radius$" and STRAIGHT or 0.0 end
    fields[c] = { name = column.name, value = value == math.huge and STRAIGHT or value }
  end
  return fields
end

local function add_points(data, wire, i, points, frame, lengths)
  if #points % 3 ~= 0 then sink.fail("vtk: wire %d has %d coordinates, which is not a multiple of 3", i,
    #points) end
  lengths[i] = lengths[i] or arc_lengths(wire, points)
  local first, values = #data.points // 3, (frame.values or {})[i]
  add_wire(data, i, points, lengths[i], wire.radius or 0.0)
  if not values then return end
  if not data.point_data[3] then
    for _, name in ipairs{ "tension", "bend_radius", "contact_force" } do
      data.point_data[#data.point_data + 1] = { name = name, values = {} }
    end
  end
  add_values(data, first, values, #points // 3)
end

local function wires_data(run, frame, lengths)
  local data = {
    points = {}, lines = { connectivity = {}, offsets = {} }, object = {},
    point_data = { { name = "radius", values = {} }, { name = "s", values = {} } },
  }
  for i, points in ipairs(frame.wires) do
    if #points > 0 then add_points(data, run.wires[i], i, points, frame, lengths) end -- else not there
  end
  data.fields = fields_at(run, frame.t)
  return data
end

local function add_face(polys, first, corners, from, to)
  for i = from, to do polys.connectivity[#polys.connectivity + 1] = first + corners[i] end
  polys.offsets[#polys.offsets + 1] = #polys.connectivity
end

local function add_surface(data, index, surface, s)
  local first, polys = #data.points // 3, data.polys
  table.move(surface.points, 1, #surface.points, #data.points + 1, data.points)
  for i = 1, #surface.points // 3 do
    data.point_data[1].values[first + i] = s[(i - 1) // surface.around + 1] or 0 / 0
    data.point_data[2].values[first + i] = surface.force[i]
  end
  local before = #polys.offsets
  local quads, ends = solid.tube_faces(surface)
  for i = 1, #quads, 4 do add_face(polys, first, quads, i, i + 3) end
  for _, corners in ipairs(ends) do add_face(polys, first, corners, 1, #corners) end
  for i = before + 1, #polys.offsets do data.object[i] = index - 1 end
end

-- Returns nil if no wire is a mesh.
local function surfaces_data(frame, lengths)
  local data
  for i, surface in ipairs(frame.surfaces or {}) do
    if surface then
      data = data or { points = {}, polys = { connectivity = {}, offsets = {} }, object = {},
        point_data = { { name = "s", values = {} }, { name = "contact_force", values = {} } } }
      add_surface(data, i, surface, lengths[i])
    end
  end
  return data
end

local function add_solid(data, index, vertices, indices)
  local first = #data.points // 3
  for i = 1, #vertices do data.points[#data.points + 1] = vertices[i] end
  local polys = data.polys
  for i = 1, #indices do
    local corner = indices[i]
    if corner < 0 or corner >= #vertices // 3 then
      sink.fail("vtk: obstacle %d: vertex index %d out of range", index, corner)
    end
    polys.connectivity[#polys.connectivity + 1] = first + corner
    if i % 3 == 0 then
      polys.offsets[#polys.offsets + 1] = #polys.connectivity
      data.object[#data.object + 1] = index - 1
    end
  end
end

local function obstacles_data(run, frame, bounds)
  local data = { points = {}, polys = { connectivity = {}, offsets = {} }, object = {} }
  for i, obstacle in ipairs(run.obstacles) do
    local pose = (frame.obstacles or {})[i] -- false: not in this frame
    if pose ~= false and solid.flat(obstacle) then
      local piece = solid.plane_piece(obstacle, pose, bounds.centre, bounds.size)
      add_solid(data, i, piece.vertices, piece.indices)
    elseif pose ~= false then
      local shape = solid.triangles(obstacle)
      add_solid(data, i, solid.place(shape.vertices, pose), shape.indices)
    end
  end
  return data
end

local function same_poses(count, a, b)
  for i = 1, count do
    if not solid.same_pose((a.obstacles or {})[i], (b.obstacles or {})[i]) then return false end
  end
  return true
end

local function write_collection(path, entries)
  return sink.write_file(path, function(write)
    write '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
    write "<Collection>\n"
    for _, entry in ipairs(entries) do
      write(string.format('<DataSet timestep="%s" group="" part="%d" file="%s"/>\n',
        sink.number(entry.t), entry.part, letters.xml(entry.file)))
    end
    write "</Collection>\n</VTKFile>\n"
  end)
end

local function write_frames(run, folder, folder_name, bounds)
  local entries, lengths, rest, rest_file = {}, {}, nil, nil
  for f, frame in ipairs(run.frames) do
    local function save(kind, part, data)
      local name = data and string.format("%s_%05d.vtp", kind, f - 1) or rest_file
      if data then
        sink.write_file(folder .. "/" .. name, function(write) write_poly(write, data) end,
          { swept = #entries > 0 })
      end
      entries[#entries + 1] = { t = frame.t, part = part, file = folder_name .. "/" .. name }
      return name
    end
    save("wires", 0, wires_data(run, frame, lengths))
    if #run.obstacles > 0 then
      local moved = not rest or not same_poses(#run.obstacles, rest, frame)
      rest_file = save("obstacles", 1, moved and obstacles_data(run, frame, bounds) or nil)
      rest = frame
    end
    local surfaces = surfaces_data(frame, lengths)
    if surfaces then save("surfaces", 2, surfaces) end
  end
  return entries
end

--- Writes a run as a ParaView series. Frames with coordinates that are not
-- finite, which VTK cannot read, are left out.
-- @tparam table run with wires, obstacles and frames
-- @tparam string path of the collection, ending in .pvd; the .vtp files go
-- into a folder of the same name ending in .vtk, made if it is missing; folders above it are not made
-- @treturn string the path
function vtk.write(run, path)
  if type(run) ~= "table" or not run.frames or not run.wires then
    sink.fail("vtk: a run with frames is expected")
  end
  if sink.extension(path) ~= "pvd" then sink.fail("vtk: %s does not end in .pvd", path) end
  if #run.frames == 0 and run.none then
    sink.fail("vtk: the run of '%s' has no frames, %s", run.name, run.none)
  end
  local place = core.kind(sink.folder(path))
  if place ~= "folder" then
    sink.fail("cannot write %s: %s", path, place and "Not a directory" or "No such file or directory")
  end
  run = setmetatable({ obstacles = run.obstacles or {} }, { __index = solid.finite_run(run) })
  local folder_name = sink.base(path):sub(1, -5) .. ".vtk"
  local folder = sink.folder(path) .. "/" .. folder_name
  sink.make_folder(folder)
  local entries = write_frames(run, folder, folder_name, solid.bounds(run))
  sink.write_file(folder .. "/objects.json", vtk.objects(run) .. "\n")
  return write_collection(path, entries)
end

--- Returns the names behind the numbers of the cell data object, as JSON.
-- @tparam table run
-- @treturn string `{"obstacles":[names],"wires":[names]}`
function vtk.objects(run)
  local names = { wires = {}, obstacles = {} }
  for kind, list in pairs(names) do
    for i, item in ipairs(run[kind]) do list[i] = item.name or kind:sub(1, -2) .. " " .. i end
  end
  return json.encode(names)
end

return vtk
