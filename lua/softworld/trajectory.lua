-- SPDX-License-Identifier: GPL-3.0-or-later
--- Trajectories: one motion law for everything that moves.
--
--     sw.trajectory{ points = {{0,0,0}, {0.3,0,0}}, speed = 0.2 }
--     sw.trajectory{ path = "lay.csv", speed = 0.2, law = "trapezoidal" }
--     sw.trajectory{ func = function(t) return {0.1 * t, 0, 0} end }
--
-- A CSV file of way-points has the columns `x y z`, and optionally `t` (a time for
-- every way-point), and `qw qx qy qz` (orientation as a quaternion) or `rx ry rz`
-- (orientation as axis times angle in radians; an orientation, so 3 pi is pi). A
-- column may name its unit: `x_mm`, `t_ms`, `rx_deg` or `x [mm]`. Without a unit it is
-- in SI units, or for positions in units of `scale` metres if given. Columns whose
-- name starts with `_` are ignored. A file without names has x y z, or t x y z, or
-- x y z qw qx qy qz, or t x y z qw qx qy qz.
-- @module softworld.trajectory
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local units = require "softworld.units"

local trajectory = {}

local dimension = { t = "s", x = "m", y = "m", z = "m", rx = "rad", ry = "rad", rz = "rad",
  qw = "-", qx = "-", qy = "-", qz = "-" }
local position, quaternion, vector = { "x", "y", "z" }, { "qw", "qx", "qy", "qz" }, { "rx", "ry", "rz" }

local unnamed = {
  [3] = { "x", "y", "z" },
  [4] = { "t", "x", "y", "z" },
  [7] = { "x", "y", "z", "qw", "qx", "qy", "qz" },
  [8] = { "t", "x", "y", "z", "qw", "qx", "qy", "qz" },
}

local function fail(data, line, column, format, ...)
  error(("%s:%d:%d: "):format(data.name, line, column) .. format:format(...), 0)
end

-- Splits a title: "x_mm" and "X [mm]" are x in mm; "x" is x.
local function column_of(title)
  local name, unit = title:match "^(%a+)%s*%[%s*([%w_/]+)%s*%]$"
  if not name then name, unit = title:match "^(%a+)_(%w+)$" end
  name = (name or title):lower()
  return dimension[name] and name, unit
end

local function known_column(data, title, place)
  local name, unit = column_of(title)
  if not name then
    fail(data, data.header, place, "column '%s' is not known; expected t x y z and qw qx qy qz or "
      .. "rx ry rz (a name that starts with _ is left alone)", title)
  end
  if not unit then return name, 1, 1 end
  local si, times, by = units.find(unit)
  if si ~= dimension[name] then
    fail(data, data.header, place, "column '%s': '%s' is not a unit for %s, which is in [%s]", title,
      unit, name, dimension[name])
  end
  return name, times, by, true
end

-- Returns columns by name in SI units, and the position of each title.
local function columns_of(data, scale)
  local found, titles = {}, {}
  for i, title in ipairs(data.names) do
    if title:sub(1, 1) ~= "_" then
      local name, times, by, with_unit = known_column(data, title, data.header_places[i])
      if found[name] then
        fail(data, data.header, data.header_places[i], "'%s' and '%s' are the same column",
          titles[name], title)
      end
      if scale and not with_unit and dimension[name] == "m" then times = scale end
      local column = {}
      for row, value in ipairs(data.columns[title]) do column[row] = value * times / by end
      found[name], titles[name] = column, title
    end
  end
  return found, titles
end

local function all_or_none(data, found, group, needed)
  local some, missing
  for _, name in ipairs(group) do
    if found[name] then some = name else missing = missing or name end
  end
  if missing and (some or needed) then
    fail(data, data.header, 1, "there is no column '%s'; the columns are: %s", missing,
      table.concat(data.names, " "))
  end
  return some ~= nil
end

local function quaternion_at(data, found, titles, row)
  local q, norm = {}, 0
  for i, name in ipairs(quaternion) do
    q[i] = found[name][row]
    norm = norm + q[i] ^ 2
  end
  norm = math.sqrt(norm)
  if math.abs(norm - 1) > 0.01 then
    fail(data, data.lines[row], data.places[titles.qw][row],
      "the quaternion (%g, %g, %g, %g) has length %.4g; expected 1", q[1], q[2], q[3], q[4], norm)
  end
  return q
end

local function vector_at(found, row)
  local axis, angle = {}, 0
  for i, name in ipairs(vector) do
    axis[i] = found[name][row]
    angle = angle + axis[i] ^ 2
  end
  if angle == 0 then return { 1, 0, 0, 0 } end
  return { axis = axis, angle = math.sqrt(angle) }
end

local function same_point(a, b)
  if a.x ~= b.x or a.y ~= b.y or a.z ~= b.z then return false end
  local q, r = a.rotation, b.rotation
  if not q then return true end
  if q.angle ~= r.angle then return false end
  q, r = q.axis or q, r.axis or r
  for i = 1, #q do
    if q[i] ~= r[i] then return false end
  end
  return true
end

local function check_order(data, points, titles)
  for row = 2, #points do
    local before, point = points[row - 1], points[row]
    if point.t and point.t <= before.t then
      fail(data, data.lines[row], data.places[titles.t][row],
        "t = %.9g s does not come after %.9g s in line %d; times must increase", point.t, before.t,
        data.lines[row - 1])
    elseif not point.t and same_point(before, point) then
      fail(data, data.lines[row], data.places[titles.x][row],
        "way-point (%g, %g, %g) m repeats line %d; remove it, or give times (a column t) to stay there",
        point.x, point.y, point.z, data.lines[row - 1])
    end
  end
end

local function points_of(data, scale)
  local found, titles = columns_of(data, scale)
  all_or_none(data, found, position, true)
  local by_quaternion = all_or_none(data, found, quaternion)
  local by_vector = all_or_none(data, found, vector)
  if by_quaternion and by_vector then
    fail(data, data.header, 1, "orientations are given twice, as qw qx qy qz and as rx ry rz")
  end
  local points = {}
  for row = 1, data.count do
    local point = { x = found.x[row], y = found.y[row], z = found.z[row], t = found.t and found.t[row] }
    if by_quaternion then point.rotation = quaternion_at(data, found, titles, row) end
    if by_vector then point.rotation = vector_at(found, row) end
    points[row] = point
  end
  check_order(data, points, titles)
  return points
end

-- Errors have no place: it may be read for a follow, which adds it.
local function read(source, scale)
  if type(source) ~= "string" then
    error("trajectory: path must be a file name or an array of way-points, got " .. type(source), 0)
  end
  if scale ~= nil and not (type(scale) == "number" and scale > 0 and scale < math.huge) then
    error(("trajectory: scale = %s is not allowed; it must be a number above 0 [m]")
      :format(checks.shown(scale)), 0)
  end
  local data = require("softworld.csv").read(source, { names = function(n) return unnamed[n] end })
  if #data.names == 0 then
    error(("%s: no way-points; expected rows of x, y, z [m]"):format(data.name), 0)
  end
  local points = points_of(data, scale)
  if #points < 2 then
    error(("%s: a path needs at least 2 way-points, got %d"):format(data.name, #points), 0)
  end
  return points
end

core.trajectory_reader(read)

--- Returns way-points from a CSV file, or from CSV text. scale is the length unit of
-- columns without one [m].
trajectory.read = build.placed(read)

-- Errors have no place, see build.call.
local function save(self, path, count)
  if core.type(self) ~= "trajectory" then error("trajectory:save is a method: call it with a colon", 0) end
  if type(path) ~= "string" or path == "" then
    error("trajectory:save: the name of a file is wanted, got " .. (path == "" and "''" or type(path)), 0)
  end
  if count ~= nil and (math.type(count) ~= "integer" or count < 2) then
    error(("trajectory:save: the number of samples = %s must be an integer of 2 or more")
      :format(checks.shown(count)), 0)
  end
  local s = self:sample(count or 201)
  local columns = { t = s.t }
  for k, name in ipairs(position) do
    columns[name] = {}
    for i = 1, #s.t do columns[name][i] = s.position[3 * (i - 1) + k] end
  end
  for k, name in ipairs(quaternion) do
    columns[name] = {}
    for i = 1, #s.t do columns[name][i] = s.rotation[4 * (i - 1) + k] end
  end
  require("softworld.csv").write(path, { "t", "x", "y", "z", "qw", "qx", "qy", "qz" }, columns)
end

--- Writes count samples (default 201) of a trajectory as a CSV file. It can be read
-- back as way-points with times.
trajectory.save = build.placed(save)
core.class.trajectory.save = trajectory.save

--- Makes a trajectory; see the reference of its parameters.
trajectory.new = core.trajectory

-- Makes a trajectory from a file; errors about way-points name the file.
local function of_file(path, args)
  local ok, result = pcall(core.trajectory, args)
  if ok then return result end
  local text = tostring(result):gsub("^[^\n:]*%.lua:%d+: ", "")
  if not text:find(path, 1, true) then
    text = text:gsub("^trajectory: ", function() return ("trajectory: '%s': "):format(path) end)
  end
  error(text, 0)
end

local function make(_, args, ...)
  local path = type(args) == "table" and rawget(args, "path")
  if type(path) ~= "string" or path:find "\n" then return core.trajectory(args, ...) end
  return (build.call(3, of_file, path, args))
end

return setmetatable(trajectory, { __call = make })
