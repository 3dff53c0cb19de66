-- SPDX-License-Identifier: GPL-3.0-or-later
--- The result of a fit: parameters with intervals, correlations, and remarks.
-- @module softworld.study.fitted
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local fitdata = require "softworld.study.fitdata"
local fitlinear = require "softworld.study.fitlinear"
local fitnoise = require "softworld.study.fitnoise"
local fitwords = require "softworld.study.fitwords"
local methods = require "softworld.methods"
local counted = require "softworld.output.number".count
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"
local rows = require "softworld.rows"

local fitted = {}

local WITHIN = 0.95     -- share of cases in which an interval holds the truth
local ALIKE = 0.99      -- correlation from which a remark is made
local NEGLIGIBLE = 0.01 -- largest remaining step over a standard error
local EXACT = 1e-6      -- residuals below this share of the data are not tested for noise

rows.calls{
  { "fit.parameters", nil, "by name { value =, error =, low =, high =, unit = }: standard error, 95 % "
    .. "interval", "a table", example = "print(fit.parameters.EI.low, fit.parameters.EI.high)" },
  { "fit.correlation", nil, "of two parameters: fit.correlation.EI.GJ", "a table" },
  { "fit.unresolved", nil, "combinations that the data do not determine: { parameters =, text =, name =, "
    .. "value =, low =, high = }", "a list" },
  { "fit.remarks", nil, "read these before you use the numbers", "a list of texts" },
  { "fit.at_bound", nil, "parameters at an end of their range", "a list of names" },
  { "fit.ok", nil, "true if the smallest sum of squares was found", "true or false" },
  { "fit.reason", nil, "why it ended", "a text" },
  { "fit.chi2", nil, "sum of squares of residuals over their sigma", "a number" },
  { "fit.freedom", nil, "degrees of freedom: data less parameters", "a number" },
  { "fit.chance", nil, "probability that chi2 is this large by chance; only if sigma is given",
    "a number, or nil" },
  { "fit.scatter", nil, "standard deviation of the residuals, over their sigma or weight", "a number" },
  { "fit.sigma", nil, "'given', 'estimated' from the residuals, or 'unknown'", "a text" },
  { "fit.data", nil, "measured values by name", "a table of lists" },
  { "fit.computed", nil, "computed values by name", "a table of lists" },
  { "fit.residuals", nil, "measured minus computed values by name", "a table of lists" },
  { "fit.best", nil, "the evaluation", "a row" },
  { "fit.evaluations", nil, "how many there were", "a number" },
  { "fit.failed", nil, "how many of them failed", "a number" },
  { "fit.starts", nil, "of each start { chi2 =, reason =, evaluations = }", "a list" },
}
rows.call("fit:chart", "{...}", "draws measured and computed values; needs gnuplot", {
  gives = "the path, or without one the drawing in characters", example = 'fit:chart { path = "fit.svg" }',
  { "path", "text", "-", "a .svg, .png or .pdf file", usual = "drawn in characters" },
})

-- --- errors ------------------------------------------------------------------------------------

-- Returns the variance of residuals (over scale), by which the covariance is multiplied, and the degrees of
-- freedom. With a loss: P. J. Huber, Robust Statistics, 1981, 7.6.
local function variance(f, data, loss, rank)
  local n = data.count
  local freedom = n - rank
  if loss then
    local squares, slopes = 0, 0
    for _, z in ipairs(f.r) do
      squares, slopes = squares + loss.psi(z) ^ 2, slopes + loss.psi_slope(z) / n
    end
    return freedom > 0 and squares / freedom / slopes ^ 2 or nil, freedom
  end
  if data.known then return 1, freedom end
  return freedom > 0 and f.sum / freedom or nil, freedom
end

local function free_columns(search)
  local list, columns = {}, {}
  for i, column in ipairs(search.best.columns or {}) do
    if not search.held[i] then list[#list + 1], columns[#columns + 1] = i, column end
  end
  return list, columns
end

-- Returns covariance and lost directions over all parameters' places; held parameters have 0.
local function spread_over(n, list, C, lost)
  local full, directions = {}, {}
  for i = 1, n do
    full[i] = {}
    for j = 1, n do full[i][j] = 0 end
  end
  for a, i in ipairs(list) do
    for b, j in ipairs(list) do full[i][j] = C[a][b] end
  end
  for k, direction in ipairs(lost) do
    directions[k] = {}
    for i = 1, n do directions[k][i] = 0 end
    for a, i in ipairs(list) do directions[k][i] = direction[a] end
  end
  return full, directions
end

-- Returns everything that follows from the derivatives at the best place.
local function errors(own, search, data)
  local f = { r = search.best.r, sum = search.best.sum }
  local list, columns = free_columns(search)
  if #list == 0 then return f end
  local C, lost = fitlinear.covariance(columns)
  local loss = search.o.loss
  local left = {}
  for k, z in ipairs(f.r) do left[k] = loss and loss.psi(z) or z end
  f.step = fitlinear.step(columns, left, C)
  f.list, f.rank = list, #list - #lost
  f.variance, f.freedom = variance(f, data, loss, f.rank)
  f.C, f.lost = spread_over(#own.parameters, list, C, lost)
  if not f.variance then return f end
  f.times = core.student((1 + WITHIN) / 2, data.known and not loss and math.huge or f.freedom)
  for i = 1, #own.parameters do
    for j = 1, #own.parameters do f.C[i][j] = f.C[i][j] * f.variance end
  end
  return f
end

-- --- parameters --------------------------------------------------------------------------------

local function at(p, u)
  if p.log then return p.low * (p.high / p.low) ^ u end
  return p.low + u * (p.high - p.low)
end

-- True if the data do not determine the parameter.
local function is_lost(f, i)
  for _, direction in ipairs(f.lost) do
    if direction[i] ~= 0 then return true end
  end
  return false
end

local function parameter(own, f, i, u, said)
  local p = own.parameters[i]
  local value = parameters.at(p, u)
  local q = { value = value, unit = p.unit }
  if is_lost(f, i) then
    q.error, q.low, q.high, q.told = math.huge, p.low, p.high, false
    return q
  end
  if not f.times or f.C[i][i] == 0 then return q end
  local error_u = math.sqrt(f.C[i][i])
  local rate = p.log and value * math.log(p.high / p.low) or p.high - p.low
  q.error, q.low, q.high = error_u * rate, at(p, u - f.times * error_u), at(p, u + f.times * error_u)
  if q.low < p.low or q.high > p.high then
    q.low, q.high = math.max(q.low, p.low), math.min(q.high, p.high)
    said[#said + 1] = fitwords.cut(p.name)
  end
  return q
end

-- Returns a combination that is determined although its parts are not, with its interval.
local function combination(own, f, values, direction)
  local found = fitwords.direction(own, values, direction)
  if not found.powers or not f.times then return found end
  local sum = 0
  for i, a in pairs(found.powers) do
    for j, b in pairs(found.powers) do
      sum = sum + a * b * f.C[i][j] * fitwords.rate(own.parameters[i], values[i])
        * fitwords.rate(own.parameters[j], values[j])
    end
  end
  local half = f.times * math.sqrt(math.max(0, sum))
  if found.share then
    found.low, found.high = found.value * math.exp(-half), found.value * math.exp(half)
  else
    found.low, found.high = found.value - half, found.value + half
  end
  return found
end

local function correlations(own, f, said)
  local all = {}
  for i, p in ipairs(own.parameters) do
    all[p.name] = {}
    for j, q in ipairs(own.parameters) do
      local size = f.times and math.sqrt(f.C[i][i] * f.C[j][j]) or 0
      local told = not is_lost(f, i) and not is_lost(f, j)
      local c = told and (i == j and 1 or size > 0 and f.C[i][j] / size) or nil
      all[p.name][q.name] = c
      if i < j and c and math.abs(c) > ALIKE then
        said[#said + 1] = ("the data hardly distinguish %s and %s: correlation %.4f"):format(p.name, q.name,
          c)
      end
    end
  end
  return all
end

-- --- residuals ---------------------------------------------------------------------------------

local DIGITS = 1e13 -- a datum so many times as large as what is computed leaves 3 digits of that [-]

-- Says that a datum dwarfs what evaluate gives: the difference hardly depends on the parameters any more.
local function dwarfed(item, computed)
  for k, value in ipairs(computed) do
    local datum = item.values[k]
    if value ~= 0 and math.abs(datum) > DIGITS * math.abs(value) then
      return ("data.%s has %.4g where evaluate gives %.4g, which is lost in rounding; is its unit right?")
        :format(item.name, datum, value)
    end
  end
end

local function residuals(fit, data, record, said)
  fit.computed, fit.residuals, fit.data = {}, {}, {}
  for _, item in ipairs(data.list) do
    local computed, list, size, off = fitdata.computed(item, record.results), {}, 0, 0
    for k, value in ipairs(computed) do
      list[k] = item.values[k] - value
      size, off = math.max(size, math.abs(item.values[k])), math.max(off, math.abs(list[k]))
    end
    fit.computed[item.name], fit.residuals[item.name], fit.data[item.name] = computed, list, item.values
    said[#said + 1] = dwarfed(item, computed)
    if off > EXACT * size then said[#said + 1] = fitnoise.signs(item.name, list) end
  end
end

local function sums(fit, f, data, scale, loss, said)
  local chi2 = 0
  for _, z in ipairs(f.r) do chi2 = chi2 + (z / scale) ^ 2 end
  fit.chi2, fit.freedom = chi2, f.freedom or data.count
  fit.scatter = math.sqrt(chi2 / math.max(1, fit.freedom))
  fit.sigma = data.known and "given" or f.variance and "estimated" or "unknown"
  if data.known and not loss then
    local chance, text = fitnoise.sum(chi2, fit.freedom)
    fit.chance, said[#said + 1] = chance, text
  end
  if fit.sigma == "unknown" and f.C then
    said[#said + 1] = ("%s and %s leave no residuals to estimate sigma from, so there are no "
      .. "intervals; give sigma or more data"):format(data.count == 1 and "1 datum" or data.count .. " data",
      counted(#f.list, "parameter"))
  end
  local far = 0
  for _, z in ipairs(f.r) do far = far + (math.abs(z) > 3 and 1 or 0) end
  if loss and far > 0 then
    said[#said + 1] = ("%d of %d data are more than 3 sigma from the model and have little weight"):format(
      far, #f.r)
  end
end

-- --- the whole ---------------------------------------------------------------------------------

local Fit = { __name = "fit" }
local KNOWN = "parameters correlation unresolved remarks at_bound ok reason chi2 freedom chance scatter "
  .. "sigma computed residuals data best evaluations failed starts chart"
local unknown
unknown, Fit.__names = checks.fields("fit", KNOWN, "chance")

-- Decides whether the search converged: the remaining step must be small against the error or the tolerance.
local function judge_end(fit, f, search, said)
  fit.reason, fit.ok = search.reason, search.how == "near" or search.how == "stuck"
  for k, i in ipairs(f.list or {}) do
    local error_u = f.times and math.sqrt(f.C[i][i]) or 0
    local left = math.abs(f.step[k])
    if fit.ok and left > math.max(10 * search.o.tolerance, NEGLIGIBLE * error_u) then
      fit.ok = false
      fit.reason = ("%s, though the slopes there ask for a further step of %.2g of the range"):format(
        search.reason, left)
    end
  end
  if not f.C and fit.ok then said[#said + 1] = fitwords.NONE_FREE end
end

--- Returns the fit of the best search.
function fitted.new(own, search, data)
  local said = {}
  local best = search.best
  local f = best.columns and errors(own, search, data) or { r = best.r, sum = best.sum }
  f.lost = f.lost or {}
  local fit = { parameters = {}, at_bound = {}, unresolved = {}, remarks = said,
    best = output.row(own, search.best.record) }
  judge_end(fit, f, search, said)
  for k, direction in ipairs(f.lost) do
    fit.unresolved[k] = combination(own, f, search.best.record.values, direction)
    said[#said + 1] = fit.unresolved[k].text
  end
  for i, p in ipairs(own.parameters) do
    local u = search.best.u[i]
    fit.parameters[p.name] = parameter(own, f, i, u, said)
    if u <= 0 or u >= 1 then
      fit.at_bound[#fit.at_bound + 1] = p.name
      said[#said + 1] = fitwords.at_end(p.name)
    end
  end
  fit.correlation = correlations(own, f, said)
  residuals(fit, data, search.best.record, said)
  sums(fit, f, data, search.scale, search.o.loss, said)
  return setmetatable(fit, Fit)
end

-- --- shown -------------------------------------------------------------------------------------

local function line_of(name, q)
  local unit = q.unit and q.unit ~= "-" and " " .. q.unit or ""
  if q.told == false then
    return ("  %s: not determined by the data (%.5g%s is one of many values)"):format(name, q.value, unit)
  end
  if not q.low then return ("  %s = %.6g%s"):format(name, q.value, unit) end
  return ("  %s = %.6g%s, 95 %% interval %.6g to %.6g"):format(name, q.value, unit, q.low, q.high)
end

function Fit.__tostring(fit)
  local names, count = {}, 0
  for name in pairs(fit.parameters) do names[#names + 1] = name end
  for _, list in pairs(fit.data) do count = count + #list end
  table.sort(names)
  local lines = { ("fit of %d data by %s (%s, %s, %d failed)"):format(count,
    counted(#names, "parameter"), fit.reason, counted(fit.evaluations, "evaluation"), fit.failed) }
  if not fit.ok then lines[#lines + 1] = "  the search did not converge: these are the best values so far" end
  for _, name in ipairs(names) do lines[#lines + 1] = line_of(name, fit.parameters[name]) end
  for _, found in ipairs(fit.unresolved) do
    if found.low then
      lines[#lines + 1] = ("  %s = %.6g, 95 %% interval %.6g to %.6g"):format(found.name, found.value,
        found.low, found.high)
    end
  end
  for i, a in ipairs(names) do
    for j = i + 1, #names do
      local c = fit.correlation[a][names[j]]
      if c then lines[#lines + 1] = ("  correlation of %s and %s: %.3f"):format(a, names[j], c) end
    end
  end
  lines[#lines + 1] = ("  sigma %s; residuals scatter by %.4g%s"):format(fit.sigma, fit.scatter,
    fit.chance and (" sigma (chance %.2g)"):format(fit.chance) or "")
  for _, text in ipairs(fit.remarks) do lines[#lines + 1] = "  ! " .. text end
  return table.concat(lines, "\n")
end

local function chart(fit, args)
  local o = rows.all["fit:chart"]:read(args == nil and {} or args)
  local list, low, high = { path = o.path, title = "fit", xlabel = "computed", ylabel = "measured" },
    math.huge, -math.huge
  for _, name in ipairs(checks.sorted(fit.data)) do
    list[#list + 1] = { x = fit.computed[name], y = fit.data[name], name = name, style = "points" }
    for k, x in ipairs(fit.computed[name]) do
      low, high = math.min(low, x, fit.data[name][k]), math.max(high, x, fit.data[name][k])
    end
  end
  if high > low then list[#list + 1] = { x = { low, high }, y = { low, high }, name = "alike" } end
  return require("softworld.run.plot").plot(list)
end

--- Draws measured over computed values.
function Fit:chart(args) return build.call(3, chart, self, args) end

methods.guard_table("fit", Fit)

function Fit.__index(_, key)
  local method = rawget(Fit, key)
  if method ~= nil and key == "chart" then return method end
  return unknown(nil, key)
end

return fitted
