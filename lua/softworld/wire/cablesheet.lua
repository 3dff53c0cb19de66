-- SPDX-License-Identifier: GPL-3.0-or-later
--- The sheet of a cable, as a script or the catalogue writes it: read, checked, and completed from the
-- construction. See softworld.cable.
-- @module softworld.wire.cablesheet
local core = require "softworld.core"
local checks = require "softworld.checks"
local inherited = require "softworld.inherited"
local bendrule = require "softworld.wire.bendrule"
local lifecurve = require "softworld.wire.lifecurve"
local material = require "softworld.wire.material"
local breaking = require "softworld.run.breaking"
local stranding = require "softworld.wire.stranding"

--- flags: how well a value is known; twist_ratio: GJ over EI if GJ is not known [-].
local sheet = { flags = { "measured", "computed", "guessed" }, twist_ratio = 1.25 }

-- Values of an entry in the order of its sheet, with limits [unit] that no cable
-- exceeds. They detect wrong units such as mm for m.
local quantities = {
  { key = "outer_diameter", unit = "m", least = 1e-4, most = 0.2 },
  { key = "mass_per_length", unit = "kg/m", least = 1e-6, most = 200 },
  { key = "EA", unit = "N", least = 0, most = 1e10 },
  { key = "EI", unit = "N m2", least = 0, most = 1e6 },
  { key = "GJ", unit = "N m2", least = 0, most = 1e6 },
  { key = "friction", unit = "-", least = 0, most = 3 },
}
--- The values that every cable has.
sheet.required = quantities
local breaking_load = { key = "breaking_load", unit = "N", least = 0, most = 1e8 } -- may be unknown
--- The same with the one that may be unknown: { { key =, unit =, ... } }.
sheet.quantities = table.move(quantities, 1, #quantities, 1, {})
sheet.quantities[#quantities + 1] = breaking_load
local densities = { 300, 12000 } -- mean over the section: foam, lead [kg/m3]

local function set(list)
  local s = {}
  for _, key in ipairs(list) do s[key] = true end
  return s
end

--- Raises an error with the cable's name and without a place.
function sheet.fail(name, format, ...)
  error(("cable '%s': %s"):format(name, format:format(...)), 0)
end

local fail = sheet.fail

--- Returns a hint what an unknown word may have meant.
function sheet.did_you_mean(word, list)
  local near = type(word) == "string" and core.nearest(word, list)
  return near and ("did you mean '%s'?"):format(near) or "known are " .. table.concat(list, " ")
end

local did_you_mean = sheet.did_you_mean

local function check_keys(name, what, t, known)
  if checks.kind(t) ~= "table" then fail(name, "%s must be a table, got %s", what, checks.kind(t)) end
  local known_set = set(known)
  for key in pairs(inherited.flat(t, known_set)) do
    if not known_set[key] then
      fail(name, "%s has no field '%s'; %s", what, checks.shown(key), did_you_mean(key, known))
    end
  end
end

local function is_number(x) return type(x) == "number" and x - x == 0 end

local function flag_of(name, key, flag)
  if flag == nil then fail(name, "%s has no flag (%s)", key, table.concat(sheet.flags, ", ")) end
  if not set(sheet.flags)[flag] then
    fail(name, "%s: there is no flag '%s'; %s", key, checks.shown(flag), did_you_mean(flag, sheet.flags))
  end
  return flag
end

local function source_of(name, key, source)
  if type(source) ~= "string" or source == "" then
    fail(name, "%s has no source; give a text that says where the value is from", key)
  end
  return source
end

-- Returns a value (a number or a table) completed by the entry's flag, source and spread.
local function read_quantity(name, spec, given, entry)
  local key, unit = spec.key, spec.unit
  if type(given) == "number" then given = { value = given } end
  if type(given) ~= "table" then
    fail(name, "%s [%s] must be a number or { value =, low =, high =, flag =, source = }, got %s", key,
      unit, type(given))
  end
  check_keys(name, key, given, { "value", "low", "high", "spread", "unit", "flag", "source" })
  if given.unit ~= nil and given.unit ~= unit then
    fail(name, "%s is in %s, not in %s", key, unit, checks.shown(given.unit))
  end
  local value, spread = given.value, given.spread or entry.spread
  if not is_number(value) then fail(name, "%s: its value [%s] is missing", key, unit) end
  if spread ~= nil and not (is_number(spread) and spread >= 0 and spread < 1) then
    fail(name, "%s: spread is a share of the value, from 0 to below 1, got %s", key, checks.shown(spread))
  end
  local low = given.low or spread and value * (1 - spread)
  local high = given.high or spread and value * (1 + spread)
  if not (is_number(low) and is_number(high)) then
    fail(name, "%s has no spread: give low and high [%s], or spread, a share of the value", key, unit)
  end
  return { value = value, low = low, high = high, unit = unit,
    flag = flag_of(name, key, given.flag or entry.flag),
    source = source_of(name, key, given.source or entry.source) }
end

local function check_range(name, spec, q)
  local limit = "%s = %g %s is not allowed; it must be %s %g %s"
  if q.value <= spec.least and not (spec.key == "friction" and q.value == 0) then
    fail(name, limit, spec.key, q.value, spec.unit, "above", spec.least, spec.unit)
  end
  if q.value > spec.most then
    fail(name, limit, spec.key, q.value, spec.unit, "at most", spec.most, spec.unit)
  end
  if not (q.low <= q.value and q.value <= q.high) then
    fail(name, "%s = %g %s lies outside its spread, %g to %g", spec.key, q.value, spec.unit, q.low,
      q.high)
  end
  if q.low < 0 then fail(name, "%s: its spread goes below 0 (%g %s)", spec.key, q.low, spec.unit) end
end

local function read_construction(name, given, entry, diameter)
  if type(given) ~= "table" then fail(name, "construction must be a table, got %s", type(given)) end
  check_keys(name, "construction", given,
    { "strands", "strand_diameter", "conductor", "insulation", "source" })
  local c = {}
  for key, value in pairs(given) do c[key] = value end
  c.source = source_of(name, "construction", c.source or entry.source)
  if math.type(c.strands) ~= "integer" or c.strands < 1 then
    fail(name, "construction: strands must be a whole number from 1, got %s", checks.shown(c.strands))
  end
  if not (is_number(c.strand_diameter) and c.strand_diameter > 0) then
    fail(name, "construction: strand_diameter [m] must be above 0, got %s", checks.shown(c.strand_diameter))
  end
  for _, part in ipairs { "conductor", "insulation" } do
    local found, why = material.find(c[part])
    if not found then fail(name, "construction: %s: %s", part, why) end
    local kind = part == "conductor" and "metal" or "polymer"
    if found.kind ~= kind then fail(name, "construction: %s must be a %s, not %s", part, kind, c[part]) end
  end
  local inner = stranding.conductor_diameter(c)
  if inner > diameter.value then
    fail(name, "construction: %d strands of %g m make a conductor of %.3g m, thicker than "
      .. "outer_diameter = %g m", c.strands, c.strand_diameter, inner, diameter.value)
  end
  return c
end

-- Returns EI or GJ of the construction. The spread goes from slipping strands of the
-- softest materials to sticking strands of the stiffest.
local function computed(entry, key, by_parts)
  local c = entry.construction
  local value, source = by_parts.value, ("%d strands of %.3g mm %s, %s"):format(c.strands,
    1000 * c.strand_diameter, c.conductor, c.insulation)
  if key == "EI" then
    value, source = by_parts.slip, "strands that slip: " .. source
  elseif key == "GJ" then
    value = math.min(math.max(sheet.twist_ratio * entry.EI.value, by_parts.slip), by_parts.stick)
    source = ("EI times %g as of three measured wires, within the bounds of its strands")
      :format(sheet.twist_ratio)
  end
  return { value = value, low = math.min(by_parts.low, value), high = math.max(by_parts.high, value),
    flag = "computed", source = source }
end

local function add_bounds(name, entry, by_parts)
  for _, key in ipairs { "EI", "GJ" } do
    local q, parts = entry[key], by_parts[key]
    q.slip, q.stick = parts.slip, parts.stick
    if q.flag ~= "measured" and not (q.value >= parts.low and q.value <= parts.high) then
      fail(name, "%s = %g N m2 is outside the bounds of its construction, %.3g N m2 (strands slip) to "
        .. "%.3g N m2 (strands stick)", key, q.value, parts.low, parts.high)
    end
  end
  local mass, parts = entry.mass_per_length, by_parts.mass_per_length
  if mass.high < 0.8 * parts.low or mass.low > 1.25 * parts.high then
    fail(name, "mass_per_length = %g kg/m does not fit its construction, %.3g to %.3g kg/m", mass.value,
      parts.low, parts.high)
  end
end

-- Raises an error for values that no cable of any material can have.
local function check_consistency(name, e)
  local R = e.outer_diameter.value / 2
  local density = e.mass_per_length.value / (math.pi * R ^ 2)
  if density < densities[1] or density > densities[2] then
    fail(name, "mass_per_length = %g kg/m in outer_diameter = %g m is %.3g kg/m3; cables have %g to %g "
      .. "kg/m3; are the units right?", e.mass_per_length.value, 2 * R, density,
      table.unpack(densities))
  end
  -- EI is largest for a given EA when all material is at the rim of the section
  if e.EI.value > e.EA.value * R ^ 2 then
    fail(name, "EI = %g N m2 is more than EA R^2 = %.3g N m2, which no section has; are the units right?",
      e.EI.value, e.EA.value * R ^ 2)
  end
  if e.GJ.value > 10 * e.EI.value or e.GJ.value < 0.05 * e.EI.value then
    fail(name, "GJ = %g N m2 is %.3g times EI; cables have 0.05 to 10 (three measured ones 0.82 to 1.64)",
      e.GJ.value, e.GJ.value / e.EI.value)
  end
end

local function read_temperature(name, given, entry)
  if type(given) ~= "table" then fail(name, "temperature is missing: { low =, high = } [degC]") end
  check_keys(name, "temperature", given, { "low", "high", "unit", "flag", "source" })
  local low, high = given.low, given.high
  if not (is_number(low) and is_number(high) and low < high and low > -273.15) then
    fail(name, "temperature: low and high [degC] must be numbers with low below high, got %s and %s",
      checks.shown(low), checks.shown(high))
  end
  return { low = low, high = high, unit = "degC",
    flag = flag_of(name, "temperature", given.flag or entry.flag),
    source = source_of(name, "temperature", given.source or entry.source) }
end

local function read_bend(name, given, entry)
  if type(given) ~= "table" then
    fail(name, "bend is missing: { rule = 'IEC 62440', use = 'fixed' }, or multiples of the outer "
      .. "diameter, { fixed = 4, movement = 5, use = 'fixed' }")
  end
  local keys = { "rule", "use", "flag", "source" }
  for _, use in ipairs(bendrule.uses) do keys[#keys + 1] = use end
  check_keys(name, "bend", given, keys)
  local bend = { rule = given.rule, use = given.use or "fixed",
    flag = flag_of(name, "bend", given.flag or entry.flag),
    source = source_of(name, "bend", given.source or entry.source) }
  local count = 0
  for _, use in ipairs(bendrule.uses) do
    local factor = given[use]
    if factor ~= nil and not (is_number(factor) and factor > 0) then
      fail(name, "bend: %s must be a multiple of the outer diameter above 0, got %s", use,
        checks.shown(factor))
    end
    bend[use], count = factor, count + (factor and 1 or 0)
  end
  if bend.rule ~= nil and bend.rule ~= "IEC 62440" then
    fail(name, "bend: there is no rule '%s'; known is IEC 62440", checks.shown(bend.rule))
  end
  if not bend.rule and count == 0 then fail(name, "bend has neither a rule nor a multiple") end
  local wrong = bendrule.unknown(bend.use)
  if wrong then fail(name, "bend: %s", wrong) end
  if not bend.rule and not bend[bend.use] then
    fail(name, "bend has no multiple for its use '%s'", bend.use)
  end
  return bend
end

-- Returns the S-N curves given by the user, else those of the strands; nil if these are not known.
local function read_fatigue(name, given, entry, construction)
  if given == nil then return construction and lifecurve.of(construction) end
  check_keys(name, "fatigue", given, { "curve", "bending", "spread", "flag", "source" })
  if not (given.curve or given.bending) then
    fail(name, "fatigue has no curve: curve = { { range [N], cycles } } or bending = { { range [1/m], "
      .. "cycles } }")
  end
  local spread = given.spread or 1
  if not (is_number(spread) and spread >= 1) then
    fail(name, "fatigue: spread is a factor of the life, from 1, got %s", checks.shown(spread))
  end
  local read = { spread = spread, flag = flag_of(name, "fatigue", given.flag or entry.flag),
    source = source_of(name, "fatigue", given.source or entry.source) }
  for key, unit in pairs{ curve = "N", bending = "1/m" } do
    local what = ("cable '%s': fatigue.%s"):format(name, key)
    read[key] = given[key] and lifecurve.read(what, given[key], unit)
  end
  return read
end

local fields = { "name", "description", "outer_diameter", "mass_per_length", "EA", "EI", "GJ", "friction",
  "breaking_load", "fatigue", "temperature", "bend", "construction", "source", "flag", "spread" }

-- Reads the values that every cable has: given, or computed from the construction.
local function read_quantities(name, entry, given, by_parts)
  for i = 2, #quantities do
    local spec = quantities[i]
    local key, value = spec.key, given[spec.key]
    if value == nil and by_parts then
      value = by_parts[key] and computed(entry, key, by_parts[key])
        or material(entry.construction.insulation).friction
    end
    if value == nil then
      fail(name, "%s [%s] is missing; %s", key, spec.unit, key == "GJ"
        and "for a cable it does not follow from E and nu: measure it, or give the construction"
        or "give it, or the construction")
    end
    entry[key] = read_quantity(name, spec, value, given)
    check_range(name, spec, entry[key])
  end
end

-- Reads the values that may be unknown.
local function read_breaking_load(name, entry, given)
  local load = given.breaking_load or entry.construction and breaking.load(entry.construction)
  if not load then return end
  entry.breaking_load = read_quantity(name, breaking_load, load, given)
  check_range(name, breaking_load, entry.breaking_load)
end

--- Returns the checked fields of an entry; errors have no place.
function sheet.read(given)
  if type(given) ~= "table" then
    error(("cable.define takes one table of fields, got %s"):format(type(given)), 0)
  end
  local name = checks.field(given, "name")
  if type(name) ~= "string" or not name:find "%S" then error("cable.define: name is missing (a text)", 0) end
  checks.name("cable.define: name", name, 0, math.huge)
  check_keys(name, "a cable", given, fields)
  local entry = { name = name, description = given.description or "" }
  local diameter = quantities[1]
  if given.outer_diameter == nil then fail(name, "outer_diameter [m] is missing") end
  entry.outer_diameter = read_quantity(name, diameter, given.outer_diameter, given)
  check_range(name, diameter, entry.outer_diameter)
  local by_parts
  if given.construction ~= nil then
    entry.construction = read_construction(name, given.construction, given, entry.outer_diameter)
    by_parts = stranding.compute(entry.construction, entry.outer_diameter)
  end
  read_quantities(name, entry, given, by_parts)
  check_consistency(name, entry)
  if by_parts then add_bounds(name, entry, by_parts) end
  read_breaking_load(name, entry, given)
  entry.fatigue = read_fatigue(name, given.fatigue, given, entry.construction)
  entry.temperature = read_temperature(name, given.temperature, given)
  entry.bend = read_bend(name, given.bend, given)
  return entry
end

--- Returns the entry, or raises an error if a script has written a wrong value into it; entries are plain
-- tables.
function sheet.whole(entry)
  for _, spec in ipairs(quantities) do
    local q = entry[spec.key]
    local value = q
    if type(q) == "table" then value = q.value end
    if type(q) ~= "table" or not is_number(value) then
      fail(tostring(rawget(entry, "name")), "the script has written %s into its %s; to make an entry of your "
        .. "own use sw.cable.define", checks.shown(value), spec.key)
    end
  end
  return entry
end

return sheet
