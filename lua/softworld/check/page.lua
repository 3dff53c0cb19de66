-- SPDX-License-Identifier: GPL-3.0-or-later
--- check:report: the player's page of the run with the check beside it: rows with links to their time and
-- place, pictures, limits in the charts. See help "check".
-- @module softworld.check.page
local build = require "softworld.scene.build"
local cells = require "softworld.check.cells"
local checks = require "softworld.checks"
local core = require "softworld.core"
local json = require "softworld.output.json"
local rows = require "softworld.rows"
local runfiles = require "softworld.run.files"
local sealed = require "softworld.sealed"
local writing = require "softworld.check.writing"

local page = {}

local call = rows.call("check:report", "path, {...}", "a page with rows, pictures, charts, the run moving: "
  .. "one .html file", {
  gives = "the path",
  example = 'run:check():report "check.html"',
  { "title", "text", "-", "of the page", usual = "the scene's name" },
  { "change", "what study:change gave", "-", "is shown below the rows", usual = "none" },
})

-- Name of a check -> ending of the series column that shows its limit.
local curves = { max_tension = "tension", min_bend_radius = "bend_radius", peak_force = "force",
  peak_moment = "moment" }

-- Returns the curve of a row, and its limit there. Bend radii of series are those of the centre line.
local function curve_of(row, run)
  local what = row.object and row.limit and curves[row.name:sub(#row.object + 2)]
  if not what or row.limit - row.limit ~= 0 then return nil end
  local limit = row.limit
  if what == "bend_radius" then
    for _, wire in ipairs(build.data(run.scene).wires) do
      if wire.name == row.object then
        return { name = row.object .. ".bend_radius", limit = limit + wire.object.radius, of = "centre line" }
      end
    end
    return nil
  end
  return { name = row.object .. "." .. what, limit = limit }
end

-- Writes a micro sign in numbers with units, but not in words that begin with u.
local function micro(text)
  return (text:gsub("(%d) u([mNsJWP]a?)%f[%A]", "%1 µ%2"))
end

local function shown(row)
  local texts = json.object {}
  for _, key in ipairs { "value", "error", "limit", "margin" } do
    if row[key] then texts[key] = micro(cells.number(row[key], row.unit)) end
  end
  if row.s then texts.s = micro(cells.number(row.s, "m")) end
  if row.time then texts.time = micro(cells.number(row.time, "s")) end
  if row.note then texts.note = micro(row.note) end
  return texts
end

-- Returns the steps of the processes within the run.
local function steps_of(run)
  local list = {}
  for _, stage in ipairs(build.data(run.scene).stages or {}) do
    if stage.from < run.time and (stage.to or math.huge) > run.start then
      list[#list + 1] = json.object { name = stage.name, from = stage.from, to = stage.to }
    end
  end
  return list
end

-- Returns the lines of a result of study:change except the first.
local function change_of(change)
  if change == nil then return nil end
  if checks.kind(change) ~= "change" then
    error("check:report: change must be what study:change gave, got " .. checks.got(change), 0)
  end
  local lines = {}
  for line in tostring(change):gmatch "\n([^\n]*)" do
    local space, text = line:match "^(%s*)(.-)$"
    lines[#lines + 1] = { text = micro(text), level = #space > 4 }
  end
  return { reason = micro(change.reason), lines = lines }
end

local function data_of(own, run, o)
  local list = cells.known_rows(writing.columns, own.no_numbers and {} or own.rows)
  for i, row in ipairs(list) do
    row.shown, row.curve = shown(own.rows[i]), curve_of(own.rows[i], run)
  end
  return json.object { name = own.name, verdict = own.verdict, reason = own.reason, start = own.start,
    time = own.time, use = own.use, skipped = own.skipped, no_numbers = own.no_numbers, rows = list,
    steps = steps_of(run), change = change_of(o.change) }
end

-- Returns the series without what a later run has recorded.
local function until_end(series, time)
  local count = #series.time
  while count > 0 and series.time[count] > time do count = count - 1 end
  if count == #series.time then return series end
  local cut = { time = table.move(series.time, 1, count, 1, {}), columns = {} }
  for i, column in ipairs(series.columns) do
    cut.columns[i] = { name = column.name, unit = column.unit,
      values = table.move(column.values, 1, count, 1, {}) }
  end
  return cut
end

-- Returns the run's results without the bend limits of bends that the check judges: its use may be another.
local function without_limits(results, own)
  local judged, list = {}, {}
  for _, row in ipairs(own.rows) do
    if row.name:find "%.min_bend_radius$" then judged[row.object] = true end
  end
  for i, row in ipairs(results) do
    local wire, rest = row.label:match "^(.*): smallest bend radius of the centre line( %(limit .*)$"
    local copy = setmetatable({}, { __index = row })
    if judged[wire] then copy.label = row.label:sub(1, -#rest - 1) end
    list[i] = copy
  end
  return list
end

local function write(self, path, args)
  local own, o = sealed.fields(self), call:read(args == nil and {} or args)
  if type(path) ~= "string" or path == "" then
    error("check:report expects the name of an .html file, got " .. checks.got(path), 0)
  end
  local run = own.source
  if not core.exists(run.scene) then
    error(("check:report: scene '%s' has been closed; write the page before that"):format(own.name), 0)
  end
  local described = runfiles.described(run)
  if own.no_numbers then described.ok, described.reason = false, own.reason end
  if described.summary and not own.no_numbers then
    described.summary = without_limits(described.summary, own)
  end
  if described.series then described.series = until_end(described.series, run.time) end
  return require("softworld.output.report").write({ described }, path,
    { title = o.title or own.name, check = data_of(own, run, o) })
end

--- check:report(path, { title =, change = }).
function page.report(self, path, args) return build.call(3, write, self, path, args) end

return page
