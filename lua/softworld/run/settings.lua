-- SPDX-License-Identifier: GPL-3.0-or-later
--- Settings of a run that decide its peaks, and what becomes of them when a run goes on from a file: its
-- peaks are of both parts. Another window cannot be mixed, and wear is recorded from the start or not at all;
-- another dt or method is told by an event.
-- @module softworld.run.settings
local core = require "softworld.core"

local settings = {}

local names = { "dt", "tolerance", "integrator", "parts", "quasistatic", "window", "wear" }
local found -- name -> its row

local function row_of(name)
  if not found then
    found = {}
    for _, row in ipairs(core.registry().params.run) do found[row.name] = row end
  end
  return found[name]
end

-- Returns the value that counts if the argument is not given; nil: none.
local function usual(row)
  if row.type == "choice" then return row.choices[row.default + 1] end
  if row.type == "boolean" then return row.default == 1 end
  return row.default
end

--- Returns the settings of checked arguments: { dt =, tolerance =, ... }.
function settings.of(args)
  local values = {}
  for _, name in ipairs(names) do
    values[name] = args[name]
    if values[name] == nil then values[name] = usual(row_of(name)) end
  end
  return values
end

--- True if a table read from a file holds settings.
function settings.fit(values)
  if type(values) ~= "table" then return false end
  for name, value in next, values do
    local row = row_of(name)
    local kind = row and (row.type == "choice" and "string" or row.type)
    if type(value) ~= kind then return false end
  end
  return type(values.dt) == "number" and type(values.window) == "number"
end

local function shown(name, value)
  local unit = row_of(name).unit
  if type(value) == "number" then return ("%.6g%s"):format(value, unit == "-" and "" or " " .. unit) end
  return value == nil and "none" or type(value) == "string" and ("'%s'"):format(value) or tostring(value)
end

local function refuse(name, before, args, file, words)
  error(("scene:run: %s = %s%s, but the run in the file '%s' has %s; give %s = %s, or remove the file to "
    .. "start from the beginning"):format(name, shown(name, settings.of(args)[name]),
    args[name] == nil and " (the usual one)" or "", file, words:format(shown(name, before[name])), name,
    type(before[name]) == "number" and ("%.9g"):format(before[name]) or tostring(before[name])), 0)
end

--- Raises an error if a run cannot go on with these arguments. before: the settings of the run in the file;
-- files of earlier versions do not tell about wear.
function settings.check(before, args, file)
  local now = settings.of(args)
  if not before then return end
  if now.window ~= before.window then
    refuse("window", before, args, file, "peaks of window = %s, and means over two times cannot be mixed")
  end
  if before.wear ~= nil and now.wear ~= before.wear then
    refuse("wear", before, args, file, "wear = %s, and a record of wear is of all steps of a run, or of none")
  end
end

--- Tells by an event which settings differ from those of the run in the file.
function settings.tell(scene, before, now, file)
  local changes = {}
  for _, name in ipairs(names) do
    if before[name] ~= now[name] and not (name == "wear" and before.wear == nil) then
      changes[#changes + 1] = ("%s = %s instead of %s"):format(name, shown(name, now[name]),
        shown(name, before[name]))
    end
  end
  if #changes == 0 then return end
  scene:tell { kind = "resumed", value = scene.time, text = ("from t = %.6g s on the run has %s: its peaks "
    .. "are the largest of both parts; the first one is from the file '%s'"):format(scene.time,
    table.concat(changes, ", "), file) }
end

return settings
