-- SPDX-License-Identifier: GPL-3.0-or-later
--- Time series of a run: what the scene has recorded since the run began, on one time axis.
-- @module softworld.series
local build = require "softworld.build"

local series = {}

local function column(name, unit) return { name = name, unit = unit, values = {} } end

-- Force and moment columns of one hold, or gripper with pads, on the common time axis of all.
local function add_hold(series, index, name, rows, count, width)
  local axes = { "x", "y", "z" }
  local names = {}
  for k, axis in ipairs(axes) do names[k] = column(name .. ".force_" .. axis, "N") end
  for k, axis in ipairs(axes) do names[3 + k] = column(name .. ".moment_" .. axis, "N m") end
  local force, moment = column(name .. ".force", "N"), column(name .. ".moment", "N m")
  for i = 0, count - 1 do
    local b, at = width * i, index[rows[width * i + 1]]
    for k = 1, 6 do names[k].values[at] = rows[b + 1 + k] end
    force.values[at] = (rows[b + 2] ^ 2 + rows[b + 3] ^ 2 + rows[b + 4] ^ 2) ^ 0.5
    moment.values[at] = (rows[b + 5] ^ 2 + rows[b + 6] ^ 2 + rows[b + 7] ^ 2) ^ 0.5
  end
  for _, c in ipairs{ force, moment } do series.columns[#series.columns + 1] = c end
  for _, c in ipairs(names) do series.columns[#series.columns + 1] = c end
end

local function add_jaws(series, index, log)
  for k, what in ipairs{ { "opening", "m" }, { "squeeze", "N" }, { "margin", "-" }, { "slip", "m" } } do
    local c = column(("%s.%s"):format(log.name, what[1]), what[2])
    for i = 0, log.count - 1 do
      c.values[index[log.rows[log.width * i + 1]]] = log.rows[log.width * i + 10 + k]
    end
    series.columns[#series.columns + 1] = c
  end
end

local function collect_times(self, logs)
  local seen, times = {}, {}
  for _, log in ipairs(logs) do
    for i = 0, log.count - 1 do
      local t = log.rows[log.width * i + 1]
      if t >= self.start and not seen[t] then
        seen[t] = true
        times[#times + 1] = t
      end
    end
  end
  table.sort(times)
  local index = {}
  for i, t in ipairs(times) do index[t] = i end
  return times, index
end

-- Rows of a log from the run's start on.
local function cut(log, start)
  local rows, first = {}, 0
  while first < log.count and log.rows[log.width * first + 1] < start do first = first + 1 end
  table.move(log.rows, log.width * first + 1, log.width * log.count, 1, rows)
  return { name = log.name, width = log.width, rows = rows, count = log.count - first,
    obstacle = log.obstacle, tool = log.tool }
end

local function all_logs(self)
  local data, logs = build.data(self.scene), {}
  for _, h in ipairs(data.holds) do
    local rows, count = h.object:log()
    if count > 0 then logs[#logs + 1] = { name = h.name, rows = rows, count = count, width = 10 } end
  end
  for _, o in ipairs(data.obstacles) do
    local rows, count = o.object:log()
    logs[#logs + 1] = { name = o.name, rows = rows, count = count, width = 4, obstacle = true }
  end
  for _, g in ipairs(data.grippers) do
    if g.tool then
      local rows, count = g.tool:log()
      if count > 0 then
        logs[#logs + 1] = { name = g.name, rows = rows, count = count, width = 14, tool = true }
      end
    end
  end
  for i, log in ipairs(logs) do logs[i] = cut(log, self.start) end
  return logs
end

local function fill_gaps(series)
  for _, c in ipairs(series.columns) do
    for i = 1, #series.time do
      if c.values[i] == nil then c.values[i] = 0 / 0 end
    end
  end
end

local function add_obstacle(series, index, log)
  local c = column(log.name .. ".contact_force", "N")
  for i = 0, log.count - 1 do
    local b = 4 * i
    c.values[index[log.rows[b + 1]]] =
      (log.rows[b + 2] ^ 2 + log.rows[b + 3] ^ 2 + log.rows[b + 4] ^ 2) ^ 0.5
  end
  series.columns[#series.columns + 1] = c
end

--- { time = {...} [s], columns = {{ name, unit, values }} } of a run.
function series.of(self)
  local logs = all_logs(self)
  local times, index = collect_times(self, logs)
  local result = { time = times, columns = {} }
  for _, log in ipairs(logs) do
    if log.obstacle then add_obstacle(result, index, log)
    else
      add_hold(result, index, log.name, log.rows, log.count, log.width)
      if log.tool then add_jaws(result, index, log) end
    end
  end
  fill_gaps(result)
  return result
end

return series
