-- SPDX-License-Identifier: GPL-3.0-or-later
--- The result of a calibration: values with intervals, an entry for the catalogue, pictures.
-- @module softworld.calibration.calibrated
local build = require "softworld.scene.build"
local cable = require "softworld.cable"
local checks = require "softworld.checks"
local doubts = require "softworld.calibration.doubts"
local entry = require "softworld.calibration.entry"
local fitwords = require "softworld.study.fitwords"
local literal = require "softworld.scene.literal"
local methods = require "softworld.methods"
local rows = require "softworld.rows"
local sagged = require "softworld.calibration.sagged"
local sealed = require "softworld.sealed"
local sink = require "softworld.output.sink"

local calibrated = {}
local Calibration = { __name = "calibration" }
sealed.class(Calibration)

local function fields(self) return sealed.fields(self) end

rows.calls{
  { "calibration.EI", nil, "{ value =, error =, low =, high =, unit = }: 95 % interval; so GJ, EA, squeeze",
    "a table, or nil", example = "print(found.EI.value, found.EI.low, found.EI.high)" },
  { "calibration.GJ", nil, "the same of GJ", "a table, or nil" },
  { "calibration.EA", nil, "the same of EA", "a table, or nil" },
  { "calibration.squeeze", nil, "the same for the section: force per length over the plates' approach",
    "a table, or nil" },
  { "calibration.fit", nil, "with correlations, residuals, remarks: see help 'fit'", "a fit" },
  { "calibration.remarks", nil, "read these before you use the numbers", "a list of texts" },
  { "calibration.cable", nil, "an entry for the catalogue, flagged measured", "a cable",
    example = "scene:wire { cable = found.cable, from = { 0, 0, 0 }, to = { 1, 0, 0 } }" },
  { "calibration.name", nil, "of the cable", "a text" },
  { "calibration:define", "", "puts the entry into the catalogue, under its name", "the cable" },
  { "calibration:save", "path", "writes a Lua file that defines the entry: dofile(path)", "the path",
    example = 'found:save "my_cable.lua"' },
}

local chart = rows.call("calibration:chart", "{...}", "draws measured and computed values; needs gnuplot", {
  gives = "the path, or without one the drawing in characters",
  example = 'found:chart { of = "sag", path = "sag.svg" }',
  { "of", "choice", "-", "the measurement to draw", choices = { "sag", "twist", "pull", "squeeze" },
    usual = "the first that was measured" },
  { "path", "text", "-", "a .svg, .png or .pdf file", usual = "drawn in characters" },
})

local STIFFNESSES = { "EA", "EI", "GJ", "squeeze" }

--- Raises an error unless `like` is nil or names an entry of the catalogue.
function calibrated.check_like(like)
  if like == nil then return end
  local fine, why = pcall(cable.get, like)
  if not fine then error("sw.calibration: like: " .. tostring(why), 0) end
end

-- --- remarks -----------------------------------------------------------------------------------

local SOFT = "the wire hangs like a chain, so EI is too small to be measured; use a shorter wire, or a "
  .. "cantilever"
local STIFF = "the wire hardly sags, or hangs between its clamps as any stiff wire does, so EI is too large "
  .. "to be measured; use a longer wire, or a cantilever"

-- Returns the bound that the data give in words; nil if they give both or none.
local function bound(q)
  if not q.profiled or (q.low > 0) == (q.high < math.huge) then return nil end
  return q.low > 0 and ("above %.4g %s"):format(q.low, q.unit) or ("below %.4g %s"):format(q.high, q.unit)
end

-- Adds a remark about the weight of the twisted wire.
local function add_weight(own)
  local t, EI = own.model.twist, own.fit.parameters.EI
  if not t or not t.needs_EI then return end
  local weight = 9.81 * own.mass_per_length.value * t.options.length
  local gamma = weight * t.options.length ^ 2 / (EI and EI.value or own.model.constants.EI)
  for _, point in ipairs(t.points) do
    if gamma > 1 and point[1] < 5 * weight then
      own.said[#own.said + 1] = ("the weight of the twisted wire, %.3g N, is not small against its tension, "
        .. "%.3g N, and the formula neglects it"):format(weight, point[1])
      return
    end
  end
end

-- Adds remarks about values that the data do not determine, in words of the bench.
local function add_hints(own)
  local said, p = own.said, own.fit.parameters
  for _, name in ipairs { "EI", "GJ" } do
    if p[name] and bound(p[name]) then
      said[#said + 1] = ("the data do not determine %s: it is %s (95 %%)"):format(name, bound(p[name]))
    end
  end
  local EI = p.EI
  if own.model.sag and EI and EI.profiled then
    if EI.low == 0 then said[#said + 1] = SOFT end
    if EI.high == math.huge then said[#said + 1] = STIFF end
  end
  add_weight(own)
end

local TURNED = math.rad(0.5) -- least angle that is told [rad]

-- Adds what a cantilever without `directions` has for level.
local function add_level(own)
  local group, p, said = own.model.sag, own.fit.parameters, own.said
  if not group or not group.level then return end
  if not group.turns then
    said[#said + 1] = "sag: directions was not given, and points are few: the picture and the clamp count as "
      .. "exactly level"
    return
  end
  local angle = p.turn.value + p.tilt.value
  said[#said + 1] = ("sag: directions was not given: the picture and the clamp count as level within %.2g "
    .. "degrees each%s; if both are level, directions = { { 1, 0 } } gives a narrower interval of EI"):format(
    math.deg(group.turns), math.abs(angle) > TURNED
      and (", and their angles, fitted, add up to %.2g degrees"):format(math.deg(angle)) or "")
end

-- True for the remark that the angles of picture and clamp, or EI and one of them, are hard to distinguish:
-- the interval of EI has that in it.
local function is_of_angles(own, text)
  local group = own.model.sag
  return group and group.turns and text:find("distinguish", 1, true)
    and (text:find("tilt", 1, true) or text:find("turn", 1, true))
end

-- Adds the remarks of the fit, without those on intervals that were replaced.
local function add_fit(own)
  local stale = {}
  for name, q in pairs(own.fit.parameters) do
    if q.profiled then
      stale[fitwords.cut(name)], stale[fitwords.at_end(name)], stale[fitwords.NONE_FREE] = true, true, true
    end
  end
  for _, text in ipairs(own.fit.remarks) do
    if not stale[text] and not is_of_angles(own, text) then own.said[#own.said + 1] = text end
  end
end

--- Returns a result. own: name, source, fit, model, outer_diameter, mass_per_length, like, said (a list of
-- remarks).
function calibrated.new(own)
  own.parameters = own.fit.parameters
  add_hints(own)
  add_level(own)
  doubts.add(own)
  add_fit(own)
  return sealed.new(Calibration, own)
end

-- --- the entry ---------------------------------------------------------------------------------

local function entry_of(own)
  own.entry = own.entry or cable.read(entry.fields(own))
  return own.entry
end

local function define(self)
  local own = fields(self)
  own.entry = cable.define(entry.fields(own)) -- .cable is this entry from now on
  return own.entry
end

local function save(self, path)
  if type(path) ~= "string" or path == "" then
    error(("calibration:save: the name of a file is wanted, got %s"):format(checks.got(path)), 0)
  end
  local own = fields(self)
  entry_of(own) -- an entry that cannot be read is not written
  local text = literal.of(entry.fields(own), nil, "cable", "")
  local shape = "-- %s, calibrated by SoftWorld.\nreturn require(\"softworld\").cable.define %s\n"
  return sink.write_file(path, shape:format(own.name:gsub("%c", " "), text))
end

-- --- shown -------------------------------------------------------------------------------------

local function sag_curves(own)
  local group, p = own.model.sag, {}
  for name, value in pairs(own.model.constants) do p[name] = value end
  for name, q in pairs(own.parameters) do p[name] = q.value end
  local line, points = {}, { x = {}, y = {} }
  line.x, line.y = sagged.line(group.curve(p))
  for k = 1, group.turns and #line.x or 0 do
    local at = group.about({ line.x[k], line.y[k] }, p.turn)
    line.x[k], line.y[k] = at[1], at[2]
  end
  for k, at in ipairs(group.points) do points.x[k], points.y[k] = at[1], at[2] end
  return line, points, "x [m]", "z [m]"
end

local function other_curves(own, group)
  local computed, order = own.fit.computed[group.name], {}
  local line, points = { x = {}, y = {} }, { x = {}, y = {} }
  for k, p in ipairs(group.points or { { 0, group.values[1] } }) do order[k] = { p[1], p[2], computed[k] } end
  table.sort(order, function(a, b) return a[1] < b[1] end)
  for k, p in ipairs(order) do
    line.x[k], line.y[k], points.x[k], points.y[k] = p[1], p[3], p[1], p[2]
  end
  local force = group.kind and "force [N]" or "tension [N]"
  local way = group.kind and group.kind.way or group.options.period and "period" or "angle"
  return line, points, force, ("%s [%s]"):format(way, group.unit)
end

local function draw(self, args)
  local own, o = fields(self), chart:read(args == nil and {} or args)
  local m = own.model
  local known = { sag = m.sag, twist = m.twist, pull = m.pull, squeeze = m.plates }
  local group = o.of and known[o.of] or not o.of and (m.sag or m.pull or m.plates or m.twist)
  if not group then error(("calibration:chart: %s was not measured"):format(o.of), 0) end
  local curves = group == m.sag and sag_curves or other_curves
  local line, points, x, y = curves(own, group)
  line.name, points.name, points.style = "computed", "measured", "points"
  if #line.x == 1 then line.style = "points" end
  return require("softworld.run.plot").plot { line, points, path = o.path, xlabel = x, ylabel = y,
    title = own.name }
end

local function line_of(own, name)
  local q = own.parameters[name]
  if not q then return nil end
  if bound(q) then return ("  %-7s not determined: %s (95 %%)"):format(name, bound(q)) end
  if not q.low or q.told == false then return ("  %-7s not determined by the measurements"):format(name) end
  return ("  %-7s %.5g %s, 95 %% interval %.5g to %.5g (-%.2g %%, +%.2g %%)"):format(name, q.value, q.unit,
    q.low, q.high, 100 * (1 - q.low / q.value), 100 * (q.high / q.value - 1))
end

function Calibration.__tostring(self)
  local own, sources = fields(self), {}
  for _, group in ipairs(own.model.groups) do sources[#sources + 1] = group.source end
  local lines = { ("calibration of '%s' from %s"):format(own.name, table.concat(sources, ", ")) }
  if not own.fit.ok then lines[2] = "  not found: " .. own.fit.reason end
  for _, name in ipairs(STIFFNESSES) do lines[#lines + 1] = line_of(own, name) end
  for _, found in ipairs(own.fit.unresolved) do
    if found.low then
      lines[#lines + 1] = ("  %s = %.5g, 95 %% interval %.5g to %.5g"):format(found.name, found.value,
        found.low, found.high)
    end
  end
  local c = own.fit.correlation
  if c.EI and c.EI.GJ then lines[#lines + 1] = ("  correlation of EI and GJ: %.3f"):format(c.EI.GJ) end
  for _, text in ipairs(own.said) do lines[#lines + 1] = "  ! " .. text end
  return table.concat(lines, "\n")
end

--- Puts the entry into the catalogue.
function Calibration:define() return build.call(3, define, self) end

--- Writes a Lua file that defines the entry.
function Calibration:save(path) return build.call(3, save, self, path) end

--- Draws the measured points over the computed curve.
function Calibration:chart(args) return build.call(3, draw, self, args) end

methods.guard_table("calibration", Calibration)

local SHOWN = "EI GJ EA squeeze fit remarks cable name define save chart"
local unknown
unknown, Calibration.__names = checks.fields("calibration", SHOWN, "EI GJ EA squeeze")

function Calibration:__index(key)
  local own = fields(self)
  if key == "fit" or key == "name" then return own[key] end
  if key == "remarks" then return table.move(own.said, 1, #own.said, 1, {}) end
  for _, name in ipairs(STIFFNESSES) do
    if key == name then return own.parameters[name] end
  end
  if key == "cable" then return build.call(3, entry_of, own) end
  local method = rawget(Calibration, key)
  if method ~= nil then return method end
  return unknown(self, key)
end

function Calibration:__newindex(key)
  error(("the calibration of '%s' cannot be written to (%s)"):format(fields(self).name, checks.shown(key)), 2)
end

return calibrated
