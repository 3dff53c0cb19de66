-- SPDX-License-Identifier: GPL-3.0-or-later
--- Identifies a real cable from bench tests: EI from a photographed sag, GJ from the twist that buckles it
-- or from a pendulum, EA from a pull, the section's stiffness from a squeeze; all fitted together.
--
--     local found = sw.calibration { name = "my cable", outer_diameter = 2.4e-3, mass_per_length = 0.0105,
--       sag = { file = "sag.csv", length = 1, to = { 0.8, 0 } },
--       twist = { length = 0.4, angle = 11.2, sigma = 0.2 } }
--     print(found, found.cable)
-- @module softworld.calibration.calibration
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local entry = require "softworld.calibration.entry"
local calibrated = require "softworld.calibration.calibrated"
local rows = require "softworld.rows"
local sag = require "softworld.calibration.sag"
local slope = require "softworld.calibration.slope"
local study = require "softworld.study.study"
local twist = require "softworld.calibration.twist"

local calibration = {}

local WHAT = "sw.calibration"
local WIDE = 8           -- half width of the range of an independently measured value, in its sigma
local GJ_LEAST, GJ_MOST = 0.02, 20 -- range of GJ over EI

local call = rows.call(WHAT, "{...}", "EA, EI, GJ and section stiffness of a real cable from measurements", {
  gives = "a calibration: values with intervals, a catalogue entry, charts",
  example = "sw.calibration { sag = { file = 'sag.csv', length = 1, to = { 0.8, 0 } }, "
    .. "mass_per_length = 0.01, outer_diameter = 0.0024 }",
  { "name", "text", "-", "of the cable", usual = "calibrated" },
  { "source", "text", "-", "where and when it was measured, for the catalogue entry", usual = "measured" },
  { "outer_diameter", "number or {value, sigma =}", "m", "of the cable; or { value, sigma = }",
    required = true },
  { "mass_per_length", "number or {value, sigma =}", "kg/m", "weighed; or { value, sigma = }",
    required = true },
  { "sag", "table", "-", "points of the hanging wire", rows = sag.rows },
  { "twist", "table", "-", "the twist that buckles it, or a torsional pendulum", rows = twist.rows },
  { "pull", "table", "-", "elongation over force", rows = slope.kinds.pull.rows },
  { "squeeze", "table", "-", "approach of two plates over force", rows = slope.kinds.squeeze.rows },
  { "EI", "number or {value, sigma =}", "N m2", "known already, instead of a sag; or { value, sigma = }" },
  { "like", "text or cable", "-", "entry of the catalogue from which values not measured are taken, as a "
    .. "guess" },
})

local function fail(text, ...) error((WHAT .. ": " .. text):format(...), 0) end

-- Reads a number, or { value, sigma = }.
local function read_uncertain(what, given, unit)
  local value, sigma = given, nil
  if type(given) == "table" then
    for key in pairs(given) do
      if key ~= 1 and key ~= "sigma" then
        fail("%s: there is no '%s'; it is a number, or { value, sigma = }", what, checks.shown(key))
      end
    end
    value, sigma = given[1], given.sigma
  end
  checks.number(("%s: %s"):format(WHAT, what), value, 0, " " .. unit, 0, nil, true)
  if sigma ~= nil then
    checks.number(("%s: %s: sigma"):format(WHAT, what), sigma, 0, " " .. unit, 0, value / 3, true)
  end
  return { value = value, sigma = sigma, unit = unit }
end

-- --- the model ---------------------------------------------------------------------------------

-- Adds a parameter that was measured independently: as a datum of its own, or without sigma as a constant.
local function add_known(model, name, known)
  if not known.sigma then
    model.constants[name] = known.value
    return
  end
  model.parameters[name] = { math.max(known.value - WIDE * known.sigma, 1e-3 * known.value),
    known.value + WIDE * known.sigma, start = known.value, unit = known.unit }
  local datum = "measured_" .. name
  table.insert(model.groups, { name = datum, sigma = known.sigma, unit = known.unit, values = { known.value },
    predict = function(p) return { p[name] } end })
end

local function add_EI(model, o)
  if model.sag then
    if o.EI ~= nil then fail("give EI or sag, not both: the sag determines EI") end
    model.parameters.EI = { model.sag.EI[1], model.sag.EI[2], log = true, unit = "N m2" }
    model.EI = model.sag.EI
  elseif o.EI ~= nil then
    local known = read_uncertain("EI", o.EI, "N m2")
    model.EI = { known.value / 2, known.value * 2 }
    add_known(model, "EI", known)
  elseif model.twist and model.twist.needs_EI then
    fail("the twist at which a wire buckles determines EI / GJ only; give a sag too, or EI = { value, sigma "
      .. "= }")
  end
end

local function add_GJ(model)
  local t = model.twist
  if not t then return end
  local low, high
  if t.needs_EI then
    low, high = GJ_LEAST * model.EI[1], GJ_MOST * model.EI[2]
  else
    local o = t.options
    local GJ = 4 * math.pi ^ 2 * o.inertia * o.length / o.period ^ 2
    low, high = GJ / 100, GJ * 100
  end
  model.parameters.GJ = { low, high, log = true, unit = "N m2" }
end

local function add_slope(model, group)
  if not group then return end
  model.parameters[group.stiffness] = { group.range[1], group.range[2], log = true,
    unit = group.stiffness == "EA" and "N" or "Pa" }
  model.parameters[group.offset] = { group.offset_range[1], group.offset_range[2], unit = "m" }
end

local function new_model(o, diameter, mass)
  local model = { parameters = {}, constants = {}, groups = {} }
  local function add(group)
    model.groups[#model.groups + 1] = group
    return group
  end
  model.sag = o.sag and add(sag.read(o.sag, diameter.value / 2, mass.value))
  model.twist = o.twist and add(twist.read(o.twist))
  model.pull = o.pull and add(slope.read("pull", o.pull))
  model.plates = o.squeeze and add(slope.read("squeeze", o.squeeze))
  if #model.groups == 0 then fail("no measurement is given; give sag, twist, pull or squeeze") end
  add_EI(model, o)
  add_GJ(model)
  add_slope(model, model.pull)
  add_slope(model, model.plates)
  if model.sag then
    add_known(model, "mass_per_length", mass)
    add_known(model, "length", model.sag.length)
    if not model.pull then model.constants.EA = entry.EA(o.like, mass.value) end
  end
  return model
end

-- --- the fit -----------------------------------------------------------------------------------

-- Returns the parameters that a group depends on.
local function of_group(model, group)
  local names = {}
  if group == model.sag then names.EI = true end
  if group == model.pull or group == model.plates then
    names[group.stiffness], names[group.offset] = true, true
  end
  return names
end

-- Fits these groups; held: values of parameters that are not fitted.
local function fit(model, name, groups, parameters, held)
  local constants, data = {}, {}
  for key, value in pairs(model.constants) do constants[key] = value end
  for key, value in pairs(held) do constants[key] = value end
  for _, group in ipairs(groups) do
    local item = table.move(group.values, 1, #group.values, 1, {})
    item.sigma, item.unit = group.sigma, group.unit
    data[group.name] = item
  end
  local s = study.study { name = name, workers = 0, parameters = parameters, evaluate = function(p)
    local all, results = setmetatable({}, { __index = function(_, key)
      local constant = constants[key]
      return constant ~= nil and constant or p[key]
    end }), {}
    for _, group in ipairs(groups) do
      local values = group.predict(all)
      results[group.name] = #values == 1 and values[1] or values
    end
    return results
  end }
  return s:fit { data = data, tolerance = 1e-7 }
end

-- Returns the middle of a range, or its start value.
local function middle(p)
  return p.start or p.log and math.sqrt(p[1] * p[2]) or 0.5 * (p[1] + p[2])
end

-- If several things were measured and one has no sigma, estimates it from its own residuals.
local function estimate_sigma(model, said)
  if #model.groups == 1 then return end
  for _, group in ipairs(model.groups) do
    if not group.sigma then
      local own, held = {}, {}
      local names = of_group(model, group)
      for key, p in pairs(model.parameters) do
        if names[key] then own[key] = p else held[key] = middle(p) end
      end
      local alone = fit(model, "calibration, " .. group.name, { group }, own, held)
      group.sigma = math.max(alone.scatter, 1e-12)
      said[#said + 1] = ("sigma of %s was not given; %.3g %s is taken, from the scatter of its "
        .. "points"):format(group.name,
        group.sigma, group.unit)
    end
  end
end

local function make(args)
  local o = call:read(args)
  local diameter = read_uncertain("outer_diameter", o.outer_diameter, "m")
  local mass = read_uncertain("mass_per_length", o.mass_per_length, "kg/m")
  if o.sag then o.sag.length = read_uncertain("sag: length", o.sag.length, "m") end
  calibrated.check_like(o.like)
  local model, said = new_model(o, diameter, mass), {}
  estimate_sigma(model, said)
  local found = fit(model, "calibration", model.groups, model.parameters, {})
  return calibrated.new { name = o.name or "calibrated", source = o.source or "measured", fit = found,
    model = model, outer_diameter = diameter, mass_per_length = mass, like = o.like, said = said }
end

--- sw.calibration { ... }: see help "calibration".
calibration.calibration = build.placed(make)

return calibration
