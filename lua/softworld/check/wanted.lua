-- SPDX-License-Identifier: GPL-3.0-or-later
--- Reads the arguments of run:check except limits: tables of parameters, and errors in them.
-- @module softworld.check.wanted
local cable = require "softworld.cable"
local checks = require "softworld.checks"
local lifecurve = require "softworld.wire.lifecurve"
local rows = require "softworld.rows"
local vec = require "softworld.vec"

local wanted = {}

wanted.landing = rows.list{
  { "path", "list", "m", "points {x, y, z} of the wanted path", required = true },
  { "wire", "text", "-", "name of the wire that must lie there", usual = "every wire" },
  { "from", "number", "m", "arc length from which it must lie there", min = 0, usual = 0 },
  { "to", "number", "m", "arc length up to which it must lie there", min = 0, usual = "its end" },
}

wanted.fatigue = rows.list{
  { "curve", "list", "N", "points { range of tension, cycles endured }, ranges rising",
    usual = "of the cable, else of its copper strands; not where the other curve is given" },
  { "bending", "list", "1/m", "points { range of curvature, cycles endured }, ranges rising",
    usual = "the same default as for the curve of tension" },
  { "repeats", "number", "-", "how often the run is gone through", min = 0, above = true, default = 1 },
  { "mean", "choice", "-", "goodman: a range of tension counts as range / (1 - mean / strength)",
    choices = { "none", "goodman" }, default = "none" },
  { "strength", "number", "N", "of Goodman's rule", min = 0, above = true,
    usual = "the least breaking load" },
  { "spread", "number", "-", "factor by which lives may be shorter or longer than the curves", min = 1,
    usual = "1" },
  { "source", "text", "-", "where the curves are from" },
  { "flag", "choice", "-", "how well they are known", choices = cable.flags },
}

wanted.abrasion = rows.list{
  { "coefficient", "number", "1/Pa", "Archard's: volume worn off over force and way", min = 0, above = true,
    required = true },
  { "width", "number", "m", "across the wire, on which it rubs", min = 0, above = true,
    usual = "its radius" },
  { "repeats", "number", "-", "how often the run is gone through", min = 0, above = true, default = 1 },
  { "source", "text", "-", "where the coefficient is from" },
  { "flag", "choice", "-", "how well it is known", choices = cable.flags },
}

wanted.vibration = rows.list{
  { "bands", "list", "Hz", "bands of excitation { from, to }" },
  { "spectrum", "list", "(m/s2)2/Hz", "of the holds' acceleration, points { f [Hz], W }, f rising" },
  { "damping", "number", "-", "ratio of each mode, for the spectrum", min = 0, above = true, max = 1 },
  { "direction", "vector", "-", "of the acceleration", usual = "the worst of each mode" },
  { "modes", "integer", "-", "number of the lowest modes that are judged", min = 1, max = 200,
    usual = "all up to the highest frequency" },
  { "alone", "boolean", "-", "true: joined wires count each by itself, while the others stay fixed",
    usual = "joined wires have no value" },
  { "tolerance", "number", "-", "how far from rest the wire may be, as a share of its length", min = 0,
    above = true, usual = 1e-4 },
}

local read = {}

function read.fatigue(given)
  for name, unit in pairs{ curve = "N", bending = "1/m" } do
    given[name] = given[name] and lifecurve.read("run:check: fatigue." .. name, given[name], unit)
  end
  if given.curve or given.bending then return end
  for _, name in ipairs{ "source", "flag", "spread" } do
    if given[name] then
      error(("run:check: fatigue.%s is of a curve, and a curve is missing: curve = { { range [N], cycles } } "
        .. "or bending = { { range [1/m], cycles } }"):format(name), 0)
    end
  end
end

-- Returns a pair of numbers.
local function pair(what, point, units)
  if type(point) ~= "table" then
    error(("%s must be a pair of numbers, got %s"):format(what, checks.got(point)), 0)
  end
  checks.only(what, point, nil, 0)
  return { checks.number(what .. "[1]", point[1], 0, units[1], 0), checks.number(what .. "[2]", point[2], 0,
    units[2], 0, nil, true) }
end

local function read_bands(given)
  local copy = {}
  for i, band in ipairs(given) do
    local what = ("run:check: vibration.bands[%d]"):format(i)
    copy[i] = pair(what, band, { " Hz", " Hz" })
    if copy[i][1] >= copy[i][2] then
      error(("%s: from = %g Hz is not below to = %g Hz"):format(what, copy[i][1], copy[i][2]), 0)
    end
  end
  if #copy == 0 then error("run:check: vibration.bands has no band { from, to } [Hz]", 0) end
  return copy
end

local function read_spectrum(given)
  local copy = {}
  for i, point in ipairs(given) do
    local what = ("run:check: vibration.spectrum[%d]"):format(i)
    copy[i] = pair(what, point, { " Hz", " (m/s2)2/Hz" })
    if copy[i][1] <= (i > 1 and copy[i - 1][1] or 0) then
      error(what .. ": each frequency must be above 0 Hz and higher than the one before", 0)
    end
  end
  if #copy < 2 then error("run:check: vibration.spectrum has fewer than 2 points { f [Hz], W }", 0) end
  return copy
end

function read.vibration(given)
  if not (given.bands or given.spectrum) then
    error("run:check: vibration: bands = { { from, to } } [Hz] or spectrum = { { f, W } } is missing", 0)
  end
  given.bands = given.bands and read_bands(given.bands)
  given.spectrum = given.spectrum and read_spectrum(given.spectrum)
  if given.spectrum and not given.damping then
    error("run:check: vibration: damping, the ratio of each mode, is required with a spectrum", 0)
  end
  if given.direction and not vec.unit(given.direction) then
    error("run:check: vibration.direction must not be the zero vector", 0)
  end
end

function read.landing(given)
  local path = {}
  for i, point in ipairs(given.path) do
    path[i] = checks.vector(("run:check: landing.path[%d]"):format(i), point, "m", 0)
  end
  given.path = path
  if #path == 0 then error("run:check: landing.path has no points", 0) end
  if given.from and given.to and given.from > given.to then
    error(("run:check: landing: from = %g m is beyond to = %g m"):format(given.from, given.to), 0)
  end
end

--- Raises an error for a wrong table in run:check's arguments; replaces the contents by copies.
function wanted.read(args)
  for name, one in pairs(read) do
    if args[name] then one(args[name]) end
  end
end

return wanted
