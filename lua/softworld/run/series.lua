-- SPDX-License-Identifier: GPL-3.0-or-later
--- Builds the time series of a run: the scene's records since the run began, on one time axis.
-- @module softworld.run.series
local core = require "softworld.core"
local build = require "softworld.scene.build"
local measures = require "softworld.grip.measures"

local series = {}

local axes = { "x", "y", "z" }

-- Adds the record of one object: times [s] and columns with as many values.
local function source(list, name, times)
  local one = { name = name, times = times, columns = {} }
  list[#list + 1] = one
  return one
end

local function add(one, what, unit, value)
  local column = { name = one.name .. "." .. what, unit = unit, values = {} }
  for i = 1, #one.times do column.values[i] = value(i) end
  one.columns[#one.columns + 1] = column
end

local function norm(x, y, z) return (x * x + y * y + z * z) ^ 0.5 end

-- Returns the rows within the run from flat data: a list of the index before each row, and times.
local function places(rows, count, width, run)
  local list, times, from, to = {}, {}, run.start, run.time
  for i = 0, count - 1 do
    local t = rows[width * i + 1]
    if t >= from and t <= to then list[#list + 1], times[#times + 1] = width * i, t end
  end
  return list, times
end

-- Adds vectors: first the length of each, then the components.
local function add_vectors(one, vectors)
  for _, v in ipairs(vectors) do
    add(one, v.what, v.unit, function(i) return norm(v.at(i, 1), v.at(i, 2), v.at(i, 3)) end)
  end
  for _, v in ipairs(vectors) do
    for k, axis in ipairs(axes) do
      add(one, v.what .. "_" .. axis, v.unit, function(i) return v.at(i, k) end)
    end
  end
end

local function add_hold(list, name, object, run)
  local rows, count = object:log(run.start, run.time)
  if count == 0 then return end
  local at, times = places(rows, count, 10, run)
  add_vectors(source(list, name, times), {
    { what = "force", unit = "N", at = function(i, k) return rows[at[i] + 1 + k] end },
    { what = "moment", unit = "N m", at = function(i, k) return rows[at[i] + 4 + k] end } })
end

-- Adds all grasps of a gripper as one record.
local function add_gripper(list, gripper, run)
  local rows, times, from, to = {}, {}, run.start, run.time
  for _, r in ipairs(measures.records(gripper, run.start, run.time)) do
    if r.t >= from and r.t <= to then rows[#rows + 1], times[#times + 1] = r, r.t end
  end
  if #rows == 0 then return end
  local one = source(list, gripper.name, times)
  add_vectors(one, {
    { what = "force", unit = "N", at = function(i, k) return rows[i][k] end },
    { what = "moment", unit = "N m", at = function(i, k) return rows[i][3 + k] end } })
  if not gripper.tool then return end
  for _, what in ipairs{ { "opening", "m" }, { "squeeze", "N" }, { "margin", "-" }, { "slip", "m" } } do
    add(one, what[1], what[2], function(i) return rows[i][what[1]] or 0 / 0 end)
  end
end

local function add_obstacle(list, entry, run)
  local rows, count = entry.object:log(run.start, run.time)
  local at, times = places(rows, count, 5, run)
  local one = source(list, entry.name, times)
  add(one, "contact_force", "N", function(i)
    return norm(rows[at[i] + 2], rows[at[i] + 3], rows[at[i] + 4])
  end)
end

-- Adds clips and ties.
local function add_fixing(list, it, run)
  local rows, count = it.object:log(run.start, run.time)
  if count == 0 then return end
  local at, times = places(rows, count, 4, run)
  add_vectors(source(list, it.name, times),
    { { what = "force", unit = "N", at = function(i, k) return rows[at[i] + 1 + k] end } })
end

local function add_wire(list, wire, name, run)
  local rows, count = wire:log(run.start, run.time)
  if count == 0 then return end
  local at, times = places(rows, count, 3, run)
  local one = source(list, name, times)
  add(one, "tension", "N", function(i) return rows[at[i] + 2] end)
  add(one, "bend_radius", "m", function(i)
    local bent = rows[at[i] + 3]
    return bent > 0 and 1 / bent or math.huge
  end)
end

local function sources(self)
  local data, list, theirs = build.data(self.scene), {}, {}
  for _, g in ipairs(data.grippers) do
    for _, hold in ipairs(g.past) do theirs[hold] = true end
    add_gripper(list, g, self)
  end
  for _, h in ipairs(data.holds) do
    if not theirs[h.object] then add_hold(list, h.name, h.object, self) end
  end
  for _, o in ipairs(data.obstacles) do add_obstacle(list, o, self) end
  for _, f in ipairs(data.fixings) do
    if core.exists(f.object) then add_fixing(list, f.fixing, self) end
  end
  local taken = {}
  for _, w in ipairs(data.wires) do
    add_wire(list, w.object, w.name, self)
    taken[w.name] = true
  end
  for _, g in ipairs(data.gone or {}) do -- another one may have its name
    local name = taken[g.label] and ("%s until %.6g s"):format(g.label, g.time) or g.label
    if g.kind == "wire" then add_wire(list, g.body, name, self) end
    taken[name] = true
  end
  return list
end

-- Returns the number of each time at which something was recorded, and all times.
local function common_times(list)
  local index, times = {}, {}
  for _, one in ipairs(list) do
    for _, t in ipairs(one.times) do
      if not index[t] then
        index[t] = true
        times[#times + 1] = t
      end
    end
  end
  table.sort(times)
  for i, t in ipairs(times) do index[t] = i end
  return times, index
end

--- Returns { time = {...} [s], columns = {{ name, unit, values }} } of a run; NaN where an object has no
-- record, because it did not exist or held nothing. more(run, series, index) adds columns, with
-- the number of each time in index.
function series.of(self, more)
  local list = sources(self)
  local times, index = common_times(list)
  local result = { time = times, columns = {} }
  for _, one in ipairs(list) do
    for _, column in ipairs(one.columns) do
      local values = {}
      for i = 1, #times do values[i] = 0 / 0 end
      for i, t in ipairs(one.times) do values[index[t]] = column.values[i] end
      column.values = values
      result.columns[#result.columns + 1] = column
    end
  end
  if more then more(self, result, index) end
  for _, column in ipairs(result.columns) do
    for i = 1, #times do
      if column.values[i] == nil then column.values[i] = 0 / 0 end
    end
  end
  return result
end

return series
