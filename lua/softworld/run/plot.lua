-- SPDX-License-Identifier: GPL-3.0-or-later
--- sw.plot: draws curves of several runs, or of any numbers.
--
--     sw.plot { run1, run2, columns = { "hand.force" }, path = "both.svg" }
--     sw.plot { { name = "a", x = { 1, 2 }, y = { 3, 4 }, error = 0.1 }, log = "xy" }
--
-- @module softworld.run.plot
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local counted = require "softworld.output.number".count
local rows = require "softworld.rows"

local plot = {}

local call = rows.call("sw.plot", "{ curve or run, ..., ... }", "draws curves; needs gnuplot", {
  gives = "the path, or without one the drawing in characters",
  example = 'sw.plot { run1, run2, columns = { "hand.force" }, path = "both.svg" }',
  { "path", "text", "-", "a .svg, .png or .pdf file", usual = "drawn in characters" },
  { "columns", "names", "-", "of the runs' series, see help 'results'", usual = "all" },
  { "title", "text", "-", "above the chart", empty = true, usual = "none" },
  { "xlabel", "text", "-", "of the axis, with unit", empty = true, usual = "'t [s]' of runs" },
  { "ylabel", "text", "-", "of the axis, with unit", empty = true, usual = "by the series" },
  { "log", "choice", "-", "axes that are logarithmic", choices = { "x", "y", "xy" }, usual = "none" },
  { "size", "size", "px", "{ width, height }; of .pdf in inches, without path in characters",
    usual = "as the curves need" },
})

local one = rows.list{
  { "name", "text", "-", "in the key", empty = true },
  { "x", "list", "-", "values" },
  { "y", "list", "-", "values, or tables with value and error", required = true },
  { "error", "table", "-", "of y: a number, or one for each value" },
  { "unit", "text", "-", "of y", empty = true },
  { "style", "choice", "-", "how", choices = { "line", "points", "both" } },
}

local function fail(text, ...) error(("sw.plot: " .. text):format(...), 0) end

local function check_numbers(what, list, count)
  if #list == 0 then fail("%s has no values", what) end
  if #list ~= count then fail("%s has %s, and y %d", what, counted(#list, "value"), count) end
  for i, x in ipairs(list) do
    if type(x) ~= "number" then fail("%s[%d] must be a number, got %s", what, i, checks.got(x)) end
  end
end

-- Raises an error for a misspelt error. Other fields may be there: quantities of a run have more.
local function check_pair(what, y)
  for key in next, y do
    local near = type(key) == "string" and core.nearest(key, { "value", "error" })
    if near and near ~= key then fail("%s has no field '%s'; did you mean '%s'?", what, key, near) end
  end
end

-- Separates values and errors in a list of numbers and tables with both.
local function split(what, list)
  local values, errors = {}, nil
  for i, y in ipairs(list) do
    local value, err = y, nil
    if type(y) == "table" then
      if not getmetatable(y) then check_pair(("%s: y[%d]"):format(what, i), y) end
      value, err = checks.field(y, "value"), checks.field(y, "error")
    end
    if type(value) ~= "number" then
      fail("%s: y[%d] must be a number, or a table with value and error, got %s", what, i, checks.got(y))
    end
    values[i] = value
    if type(err) == "number" then
      errors = errors or {}
      errors[i] = err
    end
  end
  for i = 1, errors and #values or 0 do errors[i] = errors[i] or 0 end
  return values, errors
end

local function errors_of(what, given, count)
  if type(given) == "number" then
    local list = {}
    for i = 1, count do list[i] = given end
    given = list
  end
  if type(given) ~= "table" then
    fail("%s: error must be a number or a list, got %s", what, checks.got(given))
  end
  checks.only(("sw.plot: %s: error"):format(what), given, nil, 0)
  check_numbers(what .. ": error", given, count)
  for i, e in ipairs(given) do
    if not (e >= 0 and e < math.huge) then
      fail("%s: error[%d] = %s is not allowed", what, i, checks.got(e))
    end
  end
  return given
end

-- Returns a table { x =, y =, ... } as a curve.
local function curve_of(what, given)
  local o = {}
  for key, value in next, given do if key ~= "error" then o[key] = value end end
  o = one:read(o, "sw.plot: " .. what)
  local y, errors = split(what, o.y)
  local x = o.x
  if #y == 0 then fail("%s: y has no values", what) end
  if not x then
    x = {}
    for i = 1, #y do x[i] = i end
  end
  check_numbers(what .. ": x", x, #y)
  local err = rawget(given, "error")
  if err ~= nil then errors = errors_of(what, err, #y) end
  return { name = o.name or "", unit = o.unit, x = x, y = y, error = errors,
    style = o.style or errors and "points" or "line" }
end

local function is_run(value) return rawget(getmetatable(value) or {}, "__name") == "run" end

-- Returns the series of a run as curves.
local function curves_of(run, columns, several, list)
  local series, known, names = run:series(), {}, {}
  for i, c in ipairs(series.columns) do known[c.name], names[i] = c, c.name end
  for _, name in ipairs(columns or names) do
    local c = known[name]
    if not c then
      local near = core.nearest(checks.shown(name), names)
      fail("run '%s' has no series '%s'; %s", run.name, checks.shown(name),
        near and "did you mean '" .. near .. "'?" or "see run:series()")
    end
    list[#list + 1] = { name = several and ("%s, %s"):format(run.name, name) or name, unit = c.unit,
      x = series.time, y = c.values, style = "line", of_run = true, what = name }
  end
end

local function read(args)
  if type(args) ~= "table" or getmetatable(args) then
    fail("takes a table, such as { run1, run2, path = 'both.svg' }, got %s", checks.got(args))
  end
  local named, list = {}, {}
  for key, value in next, args do
    if math.type(key) ~= "integer" then named[key] = value end
  end
  local o = call:read(named)
  if o.columns ~= nil and type(o.columns) ~= "table" then
    fail("columns must be a list of names of series, got %s", checks.got(o.columns))
  end
  if o.columns then checks.only("sw.plot: columns", o.columns, nil, 0) end
  if o.size ~= nil then
    if type(o.size) ~= "table" then fail("size must be { width, height }, got %s", checks.got(o.size)) end
    checks.only("sw.plot: size", o.size, nil, 0)
    for k = 1, 2 do checks.number(("sw.plot: size[%d]"):format(k), o.size[k], 0, "", 0, nil, true) end
  end
  local several = #args > 1
  for i = 1, #args do
    local given = args[i]
    if type(given) ~= "table" then
      fail("[%d] must be a run, or a curve such as { x = {...}, y = {...} }, got %s", i, checks.got(given))
    end
    if is_run(given) then curves_of(given, o.columns, several, list)
    else list[#list + 1] = curve_of(("[%d]"):format(i), given) end
  end
  if #list == 0 then fail("give a run or a curve, such as { y = { 1, 4, 9 } }") end
  o.curves = list
  return o
end

--- sw.plot { run or { x =, y =, error =, name = }, ..., path =, columns =, log = }.
plot.plot = build.placed(function(args)
  return require("softworld.output.plot").draw(read(args))
end)

return plot
