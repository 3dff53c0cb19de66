-- SPDX-License-Identifier: GPL-3.0-or-later
--- Finds the parameters with which a model reproduces measurements: weighted least squares by Levenberg and
-- Marquardt (GSL) within the ranges, from one or several starts side by side.
--
--     local fit = study:fit { data = { droop = { 0.12, sigma = 0.002, unit = "m" } } }
--     print(fit)
-- @module softworld.study.fit
local campaign = require "softworld.study.campaign"
local counted = require "softworld.output.number".count
local design = require "softworld.study.design"
local fitdata = require "softworld.study.fitdata"
local fitsearch = require "softworld.study.fitsearch"
local fitted = require "softworld.study.fitted"
local judge = require "softworld.study.judge"
local parameters = require "softworld.study.parameters"
local rows = require "softworld.rows"

local fit = {}

local STEP, STEP_LOG = 1e-3, 2e-3 -- of differences: over a range, of a logarithm

local call = rows.call("study:fit", "{...}", "finds the parameters with which the model gives what was "
  .. "measured", {
  gives = "a fit: parameters with 95 % intervals, correlations, remarks",
  example = "study:fit { data = { droop = { 0.12, sigma = 0.002, unit = 'm' } } }",
  { "data", "table", "-", "of results by name: a number, or { numbers, sigma =, weight =, unit = }",
    required = true },
  { "starts", "integer", "-", "places from which it begins, the first at the parameters' start", min = 1,
    max = 1000, default = 1 },
  { "evaluations", "integer", "-", "at most, of all starts", min = 1, max = 1000000,
    usual = "100 for each start and parameter" },
  { "tolerance", "number", "-", "size of the last step, as a share of the ranges", min = 1e-12, max = 0.1,
    default = 1e-6 },
  { "step", "number", "-", "step of the numerical differences, as a share of the ranges; give more if "
    .. "results are noisy",
    min = 1e-9, max = 0.25, usual = "0.001, of log ranges 0.2 % of the value at most" },
  { "loss", "choice", "-", "soft: data far from the model have little weight", choices = { "squares",
    "soft" },
    default = "squares" },
  { "workers", "integer", "-", "processes; 0 computes in this one", min = 0, max = 256,
    usual = "those of the study" },
})

-- Soft loss 2 (sqrt(1 + z^2) - 1): quadratic near 0, like |z| for large z.
local SOFT = {}
function SOFT.psi(z) return z / math.sqrt(1 + z * z) end
function SOFT.psi_slope(z) return (1 + z * z) ^ -1.5 end
function SOFT.root(z)
  if math.abs(z) < 1e-4 then return z end
  if math.abs(z) > 1e90 then return z end
  local root = math.sqrt(2 * (math.sqrt(1 + z * z) - 1))
  return z < 0 and -root or root
end
function SOFT.slope(z) return math.abs(z) < 1e-4 and 1 or SOFT.psi(z) / SOFT.root(z) end

local function check(own, data, o)
  for _, p in ipairs(own.parameters) do
    if p.kind ~= "number" then
      local shape = "study:fit: '%s' is %s; least squares need numbers, over which the model changes smoothly"
      error(shape:format(p.name, p.kind == "choice" and "a choice" or "an integer"), 0)
    end
  end
  if data.count < #own.parameters then
    error(("study:fit: %s cannot determine %s; measure more, or fix some parameters"):format(
      data.count == 1 and "1 datum" or data.count .. " data", counted(#own.parameters, "parameter")), 0)
  end
  if o.loss == "soft" and not data.known then
    error("study:fit: loss = 'soft' needs the sigma of the data, which says what is far from the model", 0)
  end
end

local function steps_of(own, o)
  local steps = {}
  for i, p in ipairs(own.parameters) do
    steps[i] = o.step or p.log and math.min(STEP, STEP_LOG / math.log(p.high / p.low)) or STEP
  end
  return steps
end

local function searches_of(own, o)
  local list = {}
  for k, places in ipairs(design.starts(own.parameters, o.starts)) do
    list[k] = fitsearch.new(places, { steps = steps_of(own, o), tolerance = o.tolerance, most = o.each,
      known = o.known, loss = o.loss == "soft" and SOFT or nil, number = k,
      residuals = function(record) return record.r and table.move(record.r, 1, #record.r, 1, {}) end })
  end
  return list
end

-- Returns the next evaluation of a search: its number within the search, and its places; nil if none at the
-- moment.
local function next_of(search)
  if not search.queue and not search.ended then
    search.queue, search.given, search.open = search:ask(), 0, 0
    search.first = #search.records
    search.ended = not search.queue
  end
  if search.ended or search.given == #search.queue then return nil end
  search.given, search.open = search.given + 1, search.open + 1
  return search.first + search.given, search.queue[search.given]
end

-- Returns the source of evaluations. Starts take turns: evaluation k of start j has number (k - 1) * starts +
-- j.
local function source_of(own, data, searches)
  local function next_one()
    local order = table.move(searches, 1, #searches, 1, {})
    table.sort(order, function(a, b)
      if #a.records == #b.records then return a.o.number < b.o.number end
      return #a.records < #b.records
    end)
    for _, search in ipairs(order) do
      local k, u = next_of(search)
      if k then return (k - 1) * #searches + search.o.number, parameters.all_at(own.parameters, u) end
    end
  end
  local function done(record)
    if record.results then
      local r, why = fitdata.residuals(data, record.results)
      if not r and record.number == 1 then error("study:fit: " .. why, 0) end
      if not r then record.results, record.failed = nil, why end
      record.r = r
    end
    local search = searches[(record.number - 1) % #searches + 1]
    search.records[(record.number - 1) // #searches + 1] = record
    search.open = search.open - 1
    if search.open == 0 and search.given == #search.queue then search.queue = nil end
  end
  return { next = next_one, done = done }
end

-- Returns the start with the smallest sum; those with derivatives come first.
local function best_of(searches)
  local best
  for _, search in ipairs(searches) do
    local size = search.best and search.best.sum / search.scale ^ 2
    if size and (not best or size < best.best.sum / best.scale ^ 2) then best = search end
  end
  return best
end

local function starts_of(searches)
  local list = {}
  for k, search in ipairs(searches) do
    local best = search.best
    list[k] = { chi2 = best and best.sum / search.scale ^ 2, reason = search.reason,
      evaluations = #search.records }
  end
  return list
end

--- Runs the fit; args as in study:fit.
function fit.run(own, args)
  local o = call:read(args == nil and {} or args)
  local data = fitdata.read(own, o.data)
  check(own, data, o)
  o.evaluations = o.evaluations or 100 * o.starts * #own.parameters
  o.starts = math.min(o.starts, o.evaluations)
  o.each, o.known = o.evaluations // o.starts, data.known
  local searches = searches_of(own, o)
  local records = campaign.run(own, "fit", o, source_of(own, data, searches))
  judge.some(own, records)
  local best = best_of(searches)
  if not best then
    error(("study '%s': the first evaluation of a fit must succeed; %s"):format(own.name,
      judge.sorted(records)[1].failed), 0)
  end
  local found = fitted.new(own, best, data)
  local failed = 0
  for _, record in pairs(records) do failed = failed + (record.results and 0 or 1) end
  found.evaluations, found.failed, found.starts = #judge.sorted(records), failed, starts_of(searches)
  own.asked[own.part].says = tostring(found)
  return found
end

return fit
