-- SPDX-License-Identifier: GPL-3.0-or-later
--- The catalogue of cables, and cables that users define.
--
--     print(sw.cables())                    -- what there is
--     print(sw.cable "GXL 1.5")             -- its sheet: values, spread, source
--     print(sw.cable "GXL 1.5".EI.value)    -- [N m2]
--     scene:wire{ cable = "GXL 1.5", from = {0, 0, 0}, to = {1, 0, 0} }
--
-- Every value is a table { value =, low =, high =, unit =, flag =, source = }. flag
-- says how far to trust it: "measured" (or given by the named standard or maker),
-- "computed" (by the formulas of softworld.wire.stranding) or "guessed". Where the
-- construction is known, EI and GJ carry two bounds besides: `slip`, when the
-- strands slide on one another, and `stick`, when they do not. The stick bound is
-- seldom reached: a power cable's EI falls about tenfold while its strands begin to
-- slide. With many thin strands the bounds lie up to a hundredfold apart.
--
-- Where nothing is measured, EI is the slip bound. Handling bends wires far beyond
-- the curvature at which strands begin to slide, and the three wires in the catalogue
-- whose EI was measured lie below the slip bound of a GXL of their mass. GJ is then
-- EI times 1.25, kept between its own bounds; 1.25 is the geometric mean of GJ/EI of
-- those three. GJ never follows from E and nu, which a bundle of strands does not have.
-- @module softworld.cable
local core = require "softworld.core"
local checks = require "softworld.checks"
local methods = require "softworld.methods"
local keep = require "softworld.scene.keep"
local bendrule = require "softworld.wire.bendrule"
local sheet = require "softworld.wire.cablesheet"

--- The module. `quantities` lists an entry's values in the order of its sheet, { { key =, unit =, ... } }.
local cable = { flags = sheet.flags, twist_ratio = sheet.twist_ratio, quantities = sheet.quantities }
local fail, whole = sheet.fail, sheet.whole
local Entry = { __name = "cable" }
Entry.__index = Entry
keep.class("cable", Entry)

local files = { "gxl", "flry", "h07v", "identified" }
local by_name, names

local DEEPEST = 9 -- deepest nesting of fields
local sources = setmetatable({}, { __mode = "k" }) -- an entry made by a script -> the fields it was made of

local function copy(value, depth)
  if type(value) ~= "table" or depth > DEEPEST then return value end
  local to = {}
  for key, item in next, value do to[key] = copy(item, depth + 1) end
  return to
end

-- True if two values have the same items.
local function same(a, b)
  if type(a) ~= "table" or type(b) ~= "table" then return a == b end
  for key, item in next, a do
    if not same(item, b[key]) then return false end
  end
  for key in next, b do
    if a[key] == nil then return false end
  end
  return true
end

--- Returns a checked entry that is not in the catalogue, of the fields of cable.define. Errors have no place.
function cable.read(given)
  local entry = setmetatable(sheet.read(given), Entry)
  sources[entry] = copy(given, 1)
  return entry
end

local read = cable.read

local function load_all()
  if by_name then return end
  by_name, names = {}, {}
  for _, file in ipairs(files) do
    for _, given in ipairs(require("softworld.cables." .. file)) do
      local entry = setmetatable(sheet.read(given), Entry)
      by_name[entry.name], names[#names + 1] = entry, entry.name
    end
  end
end

--- Returns the entry with this name; an entry is returned as it is. Errors have no place.
function cable.get(name)
  load_all()
  if getmetatable(name) == Entry then return whole(name) end
  if type(name) ~= "string" then
    error(("a cable is named by a text or given as an entry, got %s"):format(type(name)), 0)
  end
  if by_name[name] then return whole(by_name[name]) end
  local near = core.nearest(name, names)
  error(("there is no cable '%s'; %s"):format(name, near and ("did you mean '%s'?"):format(near)
    or "sw.cables() lists them"), 0)
end

--- Returns the fields that an entry was made of, for scene:script; nil for the catalogue's own entries.
-- Raises an error if the entry cannot be made again.
function cable.source(entry)
  load_all()
  local given = sources[entry]
  if given and same(entry, sheet.read(given)) then return given end
  if not given and rawequal(by_name[entry.name], entry) then return nil end
  error(given and "it was changed after it was made, which is not written"
    or "it was read from a file, without the fields it was made of", 0)
end

-- Returns the results of a pcall, or raises its error with the place of the script's line. An error of
-- Ctrl-C has a place already.
local function placed(level, ok, ...)
  if ok then return ... end
  local text = ...
  local has = type(text) == "string" and text:find(": interrupted$")
  error(text, has and 0 or level)
end

--- Adds an entry to the catalogue, which then knows it by its name. Fields: `name`;
-- `outer_diameter` [m], `mass_per_length` [kg/m], `EA` [N], `EI`, `GJ` [N m2],
-- `friction` [-], each { value =, low =, high =, flag =, source = } (or spread, a share,
-- instead of low and high); `breaking_load` [N], where known; `fatigue` { curve =
-- { { range [N], cycles } }, bending = { { range [1/m], cycles } }, spread = factor of
-- the life }; `temperature` { low =, high = } [degC]; `bend` { rule = "IEC 62440",
-- use = "fixed" } or multiples of the outer diameter by use; `construction`
-- { strands =, strand_diameter = [m], conductor = "copper", insulation = "PVC" },
-- from which missing values are computed. `flag`, `source` and `spread` of the entry
-- hold for every value without its own, also for values given as plain numbers.
-- Errors name the cable and the field that is missing or does not fit.
function cable.define(given)
  load_all()
  local entry = placed(3, pcall(read, given))
  if by_name[entry.name] then
    error(("cable '%s': the catalogue already has a cable of this name; give another name"):format(
      entry.name), 2)
  end
  by_name[entry.name], names[#names + 1] = entry, entry.name
  return entry
end

local List = { __name = "cables" }

--- Returns all names in the catalogue's order; print shows them as a table.
function cable.list()
  load_all()
  return setmetatable(table.move(names, 1, #names, 1, {}), List)
end

function List.__tostring(list)
  local lines = { ("%-18s %9s %9s %-31s %s"):format("", "OD [mm]", "[g/m]", "EI [N m2] (slip .. stick)", "") }
  for _, name in ipairs(list) do
    local e = by_name[name]
    local EI = e.EI.slip and ("%.3g (%.3g .. %.3g)"):format(e.EI.value, e.EI.slip, e.EI.stick)
      or ("%.3g (%s)"):format(e.EI.value, e.EI.flag)
    lines[#lines + 1] = ("%-18s %9.3g %9.3g %-31s %s"):format(name, 1000 * e.outer_diameter.value,
      1000 * e.mass_per_length.value, EI, e.description)
  end
  return table.concat(lines, "\n")
end

-- --- entries --------------------------------------------------------------------

local stiffnesses = { "default", "slip", "stick" }
--- The allowed values of `stiffness`.
cable.stiffnesses = stiffnesses
local known = checks.set(table.concat(stiffnesses, " "))

local function section(self, stiffness)
  whole(self)
  stiffness = stiffness or "default"
  if not known[stiffness] then
    fail(self.name, "there is no stiffness '%s'; %s", checks.shown(stiffness),
      sheet.did_you_mean(stiffness, stiffnesses))
  end
  local which = stiffness == "default" and "value" or stiffness
  if not self.EI[which] then
    fail(self.name, "its construction is not known, so there is no bound '%s'; EI is %s", stiffness,
      self.EI.flag)
  end
  return { EA = self.EA.value, EI = self.EI[which], GJ = self.GJ[which],
    mass_per_length = self.mass_per_length.value, radius = self.outer_diameter.value / 2 }
end

local function bend_limit(self, use, diameter)
  use, diameter = use or self.bend.use, diameter or self.outer_diameter.value
  local wrong = bendrule.unknown(use)
  if wrong then fail(self.name, "%s", wrong) end
  if type(diameter) ~= "number" or not (diameter > 0 and diameter < math.huge) then
    fail(self.name, "bend_limit: diameter = %s is not allowed; it must be a number above 0 m",
      checks.shown(diameter))
  end
  local factor = self.bend[use] or self.bend.rule and bendrule.factor(use, diameter)
  if not factor then fail(self.name, "it has no bend limit for the use '%s'", use) end
  return factor * diameter, (factor + 0.5) * diameter, use
end

local function of_entry(name, f)
  return function(self, ...)
    if getmetatable(self) ~= Entry then
      error(("cable.%s: must get a cable from sw.cable, got %s"):format(name, type(self)), 2)
    end
    return f(self, ...)
  end
end

-- For other modules: errors without a place.
cable.section, cable.bend_limit = of_entry("section", section), of_entry("bend_limit", bend_limit)

--- Returns the parameters of scene:wire: EA [N], EI, GJ [N m2], mass_per_length [kg/m],
-- radius [m]. stiffness: "default", or "slip" or "stick" for a bound of EI and GJ.
function Entry:section(stiffness) return (placed(3, pcall(section, self, stiffness))) end

--- Returns the smallest radius that a use allows, at the inside of the bend [m] and at
-- the centre line [m], and the use. use: "fixed", "termination", "movement", "load",
-- "reeling" or "pulleys"; default that of the entry. diameter [m]: default that of the entry.
function Entry:bend_limit(use, diameter)
  local inside, centre
  inside, centre, use = placed(3, pcall(bend_limit, self, use, diameter))
  return inside, centre, use
end

local function row(lines, title, value, unit, spread, flag, source)
  lines[#lines + 1] = ("  %-16s %-11s %-6s %-22s %-9s %s"):format(title, value, unit, spread, flag, source)
end

function Entry:__tostring()
  local fine, why = pcall(whole, self)
  if not fine then return why end
  local lines = { ("%s: %s"):format(self.name, self.description) }
  for _, spec in ipairs(sheet.required) do
    local q = self[spec.key]
    row(lines, spec.key, ("%.4g"):format(q.value), spec.unit == "-" and "" or spec.unit,
      ("%.3g .. %.3g"):format(q.low, q.high), q.flag, q.source)
    if q.slip then
      row(lines, "  bounds", "", spec.unit, ("%.3g .. %.3g"):format(q.slip, q.stick), "computed",
        "strands slip .. strands stick")
    end
  end
  local load = self.breaking_load
  if load then
    row(lines, "breaking_load", ("%.4g"):format(load.value), load.unit,
      ("%.3g .. %.3g"):format(load.low, load.high), load.flag, load.source)
  end
  local life = self.fatigue
  if type(life) == "table" then
    row(lines, "S-N curves", "", "", "", tostring(life.flag), tostring(life.source))
  end
  local t, b = self.temperature, self.bend
  row(lines, "temperature", "", "degC", ("%g .. %g"):format(t.low, t.high), t.flag, t.source)
  row(lines, "bend radius", "", "m", "inside, by use:", b.flag, b.source)
  local limits = {}
  for _, use in ipairs(bendrule.uses) do
    if b[use] or b.rule then limits[#limits + 1] = ("%s %.3g"):format(use, (self:bend_limit(use))) end
  end
  lines[#lines + 1] = "    " .. table.concat(limits, ", ")
  return table.concat(lines, "\n")
end

methods.guard_table("cable", Entry)

return setmetatable(cable, { __call = function(_, name) return (placed(3, pcall(cable.get, name))) end })
