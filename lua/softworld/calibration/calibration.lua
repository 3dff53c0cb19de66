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
local core = require "softworld.core"
local look = require "softworld.calibration.look"
local profile = require "softworld.calibration.profile"
local rows = require "softworld.rows"
local sag = require "softworld.calibration.sag"
local slope = require "softworld.calibration.slope"
local study = require "softworld.study.study"
local twist = require "softworld.calibration.twist"

local calibration = {}

local WHAT = "sw.calibration"
local SURE = 1e-12       -- least sigma of an independently measured value, over the value [-]
local WIDE = 8           -- half width of the range of an independently measured value, in its sigma
local ROUGH = 1e-4       -- tolerance of fits whose sum of squares is wanted only: an error of its square [-]
local ROUNDS = 3         -- most fits [-]
local GJ_LEAST, GJ_MOST = 0.02, 20 -- range of GJ over EI

local call = rows.call(WHAT, "{...}", "EA, EI, GJ and section stiffness of a real cable from measurements", {
  gives = "a calibration: values with intervals, a catalogue entry, charts",
  example = "sw.calibration { sag = { file = 'sag.csv', length = 1, to = { 0.8, 0 } }, "
    .. "mass_per_length = 0.01, outer_diameter = 0.0024 }",
  { "name", "name", "-", "of the cable", usual = "calibrated" },
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
    checks.number(("%s: %s: sigma"):format(WHAT, what), sigma, SURE * value, " " .. unit, 0, value / 3)
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

-- Adds the angles of a cantilever's picture and clamp against level, each known within sag.LEVEL.
local function add_angles(model)
  for _, name in ipairs { "turn", "tilt" } do
    model.parameters[name] = { -WIDE * sag.LEVEL, WIDE * sag.LEVEL, start = 0, unit = "rad" }
    table.insert(model.groups, { name = "level_" .. name, sigma = sag.LEVEL, unit = "rad", values = { 0 },
      predict = function(p) return { p[name] } end })
  end
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
    model.sag.EA_measured = model.pull ~= nil
    if model.sag.turns then add_angles(model) end
    if not model.pull then model.constants.EA = entry.EA(o.like, mass.value) end
  end
  return model
end

-- --- the fit -----------------------------------------------------------------------------------

-- Returns the parameters that a group depends on.
local function of_group(model, group)
  local names = {}
  if group == model.sag then names.EI, names.turn = true, group.turns or nil end -- they do not tell the tilt
  if group == model.pull or group == model.plates then
    names[group.stiffness], names[group.offset] = true, true
  end
  return names
end

-- Returns the computed values of groups by name; p: values of fitted parameters; the constants and the held
-- ones come first.
local function predicted(model, groups, held, p)
  local all, results = setmetatable({}, { __index = function(_, key)
    if held[key] ~= nil then return held[key] end
    local constant = model.constants[key]
    return constant ~= nil and constant or p[key]
  end }), {}
  for _, group in ipairs(groups) do results[group.name] = group.predict(all) end
  return results
end

-- Fits these groups; held: values of parameters that are not fitted.
local function fit(model, name, groups, parameters, held, tolerance)
  local data = {}
  for _, group in ipairs(groups) do
    local item = table.move(group.values, 1, #group.values, 1, {})
    item.sigma, item.unit = group.sigma, group.unit
    data[group.name] = item
  end
  local s = study.study { name = name, workers = 0, parameters = parameters, evaluate = function(p)
    local results = predicted(model, groups, held, p)
    for key, values in pairs(results) do results[key] = #values == 1 and values[1] or values end
    return results
  end }
  return s:fit { data = data, tolerance = tolerance or 1e-7 }
end

-- Returns the smallest sum of squares with these held values; math.huge if the wire has no such equilibrium.
local function smallest(model, groups, parameters, held)
  local fine, residuals
  if next(parameters) then
    fine, residuals = pcall(function()
      return fit(model, "calibration, interval", groups, parameters, held, ROUGH).residuals
    end)
  else
    fine, residuals = pcall(predicted, model, groups, held, {})
    for _, group in ipairs(fine and groups or {}) do
      local list = residuals[group.name]
      for k, value in ipairs(list) do list[k] = group.values[k] - value end
    end
  end
  return fine and profile.sum(groups, residuals) or math.huge
end

-- Returns two functions of EI: the sum of squares of all but the twist, with the other parameters of the fit,
-- and the smallest one over these.
local function sums_over_EI(model, found, groups, parameters, held)
  local others, values, rest = {}, {}, {}
  for key, p in pairs(parameters) do
    local start = found.parameters[key].value
    values[key] = start
    if key ~= "EI" and key ~= "GJ" then others[key] = setmetatable({ start = start }, { __index = p }) end
  end
  for _, group in ipairs(groups) do
    if group ~= model.twist then rest[#rest + 1] = group end
  end
  local function with(EI, more)
    local now = {}
    for key, v in pairs(more) do now[key] = v end
    for key, v in pairs(held) do now[key] = v end
    now.EI = EI
    return now
  end
  return function(EI) return smallest(model, rest, {}, with(EI, values)) end,
    function(EI) return smallest(model, rest, others, with(EI, {})) end
end

-- Gives EI and GJ intervals that hold where they are wide. Returns an EI with a smaller sum of squares than
-- that of the fit, or nil.
local function widen(model, found, groups, parameters, held)
  if not model.sag or not parameters.EI then return nil end
  local t = parameters.GJ and model.twist.needs_EI and model.twist
  local beside, least = sums_over_EI(model, found, groups, parameters, held)
  local function with_twist(sum_at)
    return function(value) return sum_at(value) + (t and t.sum(value) or 0) end
  end
  if not profile.is_wide(found, groups, "EI", model.sag.EI, with_twist(beside)) then return nil end
  local sum_at, sum_over = profile.known(least, t and t.sum)
  local EI, GJ = found.parameters.EI, found.parameters.GJ
  sum_at(EI.value)
  local better = profile.widen(found, groups, "EI", model.sag.EI, with_twist(sum_at))
  if EI.profiled and not better and not found.ok then -- the model jumps beside the best value
    found.ok, found.reason = true, "no better EI was found over its interval"
  end
  if t and EI.profiled then
    profile.widen(found, groups, "GJ", parameters.GJ, sum_over)
    GJ.low, GJ.high = EI.low > 0 and GJ.low or 0, EI.high < math.huge and GJ.high or math.huge
    GJ.told = GJ.low > 0 and GJ.high < math.huge
  end
  return better
end

-- Returns the middle of a range, or its start value.
local function middle(p)
  return p.start or p.log and math.sqrt(p[1] * p[2]) or 0.5 * (p[1] + p[2])
end

-- Fits one group by itself, the other parameters at their middle values.
local function alone(model, group)
  local own, held, names = {}, {}, of_group(model, group)
  for key, p in pairs(model.parameters) do
    if names[key] then own[key] = p else held[key] = middle(p) end
  end
  local found = fit(model, "calibration, " .. group.name, { group }, own, held)
  if group == model.sag then widen(model, found, { group }, own, held) end
  return found
end

-- If several things were measured and one has no sigma, estimates it from its own residuals: such that the
-- interval of a normal distribution is that of Student's t for its number of points.
local function estimate_sigma(model, said)
  if #model.groups == 1 then return end
  for _, group in ipairs(model.groups) do
    if not group.sigma then
      local own = alone(model, group)
      if own.freedom < 1 then
        fail("%s has %d point%s, too few to estimate its sigma; give sigma, or more points", group.name,
          #group.values, #group.values == 1 and "" or "s")
      end
      local few = core.student(0.975, own.freedom) / core.student(0.975, math.huge)
      group.sigma = math.max(few * own.scatter, 1e-12)
      said[#said + 1] = ("sigma of %s was not given; %.3g %s is taken, from the scatter of its "
        .. "points"):format(group.name, group.sigma, group.unit)
    end
  end
end

-- Begins the fit where a coarse search over EI found the points nearest to the wire.
local function start_EI(model)
  local p = setmetatable({}, { __index = function(_, key)
    return model.constants[key] or model.parameters[key] and middle(model.parameters[key])
  end })
  model.parameters.EI.start = look.at(model.sag, p)
end

-- Keeps EI above the least value with which the wire bears the compression of all readings of the twist.
local function bear_compression(model)
  local t = model.twist
  local k, least = t.compressed()
  if not k then return end
  local p, most, why = model.parameters.EI, model.constants.EI, "given"
  if model.sag then most, why = alone(model, model.sag).parameters.EI.high, "95 % interval of the sag"
  elseif p then most, why = p[2], ("%d sigma above the given one"):format(WIDE) end
  if most and least >= most then t.refuse(k, most, why) end
  if p then
    p[1] = math.max(p[1], least * (1 + 1e-6))
    p.start = math.max(middle(p), p[1] * 1.001)
  end
end

local function start(model)
  if model.sag then start_EI(model) end
  local t = model.twist
  if not t or not t.needs_EI then return end
  bear_compression(model)
  local GJ = model.parameters.GJ
  GJ.start = math.max(GJ[1], math.min(GJ[2], t.GJ(model.constants.EI or middle(model.parameters.EI))))
end

-- Fits all groups. It begins again if the interval of EI shows a better place.
local function fitted(model)
  for round = 1, ROUNDS do
    local found = fit(model, "calibration", model.groups, model.parameters, {})
    local better = widen(model, found, model.groups, model.parameters, {})
    if not better or round == ROUNDS then return found end
    model.parameters.EI.start = better
  end
end

-- Reads the arguments and the measurements: computes no wire.
local function read(args)
  local o = call:read(args)
  local diameter = read_uncertain("outer_diameter", o.outer_diameter, "m")
  local mass = read_uncertain("mass_per_length", o.mass_per_length, "kg/m")
  if o.sag then o.sag.length = read_uncertain("sag: length", o.sag.length, "m") end
  calibrated.check_like(o.like)
  return o, diameter, mass, new_model(o, diameter, mass)
end

local function make(args)
  local o, diameter, mass, model = read(args)
  local said = {}
  start(model)
  estimate_sigma(model, said)
  local found = fitted(model)
  return calibrated.new { name = o.name or "calibrated", source = o.source or "measured", fit = found,
    model = model, outer_diameter = diameter, mass_per_length = mass, like = o.like, said = said }
end

--- sw.calibration { ... }: see help "calibration".
calibration.calibration = build.placed(make)

--- Raises the errors of its arguments, without a calibration; for lint.
calibration.check = build.placed(function(args) read(args) end)

return calibration
