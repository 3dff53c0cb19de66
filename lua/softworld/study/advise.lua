-- SPDX-License-Identifier: GPL-3.0-or-later
--- Advises which method a search should use, and how many evaluations: from the parameters and constraints,
-- and from the evaluations so far.
--
-- The evaluations show the share that failed; whether constraints have steps (a result with few values);
-- whether values are noisy; and whether they are smooth: the part of the variance that a quadratic polynomial
-- leaves over. BOBYQA and COBYLA suit smooth values; CMA-ES suits others, many failures, and limits with
-- steps; the simplex suits one parameter.
-- @module softworld.study.advise
local checks = require "softworld.checks"
local judge = require "softworld.study.judge"
local minimum = require "softworld.study.minimum"
local counted = require "softworld.output.number".count
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"
local quadratic = require "softworld.study.quadratic"
local search = require "softworld.study.search"

local advise = {}

local MANY_FAIL = 0.05   -- share of evaluations that counts as many
local SMOOTH = 0.05      -- largest part of the variance that a quadratic polynomial leaves over
local FEW_VALUES = 4     -- a result with at most this many values has steps
local MOST_TERMS = 300   -- most terms of a polynomial

local function say(lines, text, ...) lines[#lines + 1] = text:format(...) end

-- --- what there is --------------------------------------------------------------------------------

-- True if two evaluations of the same place differ.
local function is_noisy(own, result, list)
  local seen = {}
  for _, record in ipairs(list) do
    if record.results then
      local word, value = parameters.word(record.values), judge.value(own, result, record)
      if seen[word] and seen[word] ~= value then return true end
      seen[word] = value
    end
  end
  return false
end

local function has_steps(list, name)
  local seen, count, all = {}, 0, 0
  for _, record in ipairs(list) do
    local value = record.results and record.results[name]
    if value then
      all = all + 1
      if not seen[value] then seen[value], count = true, count + 1 end
    end
  end
  return all > 5 * FEW_VALUES and count <= FEW_VALUES
end

-- Returns the share of the variance that a quadratic polynomial leaves over; nil with too few evaluations.
local function left_over(own, result, good)
  local n = quadratic.count(#own.parameters)
  if #good < 2 * n or n > MOST_TERMS then return nil end
  local places, all, sum = {}, {}, 0
  for r, record in ipairs(good) do
    places[r], all[r] = {}, judge.value(own, result, record)
    for i, p in ipairs(own.parameters) do
      places[r][i] = p.kind == "choice" and record.values[i] or 2 * parameters.place(p, record.values[i]) - 1
    end
    sum = sum + all[r]
  end
  local fit, left, whole = quadratic.fit(places, all), 0, 0
  for r, value in ipairs(all) do
    left, whole = left + (value - quadratic.at(fit, places[r])) ^ 2, whole + (value - sum / #good) ^ 2
  end
  return whole > 0 and left / (#good - n) * #good / whole or 0
end

-- --- advice ------------------------------------------------------------------------------------------

local function look(own, result)
  local list, seen = output.records(own), { failed = 0 }
  output.check_name(own, "study:advise", result, list)
  local good = {}
  for _, record in ipairs(list) do
    if record.results then good[#good + 1] = record else seen.failed = seen.failed + 1 end
  end
  seen.count = #list
  seen.share = seen.failed / #list
  seen.noise = is_noisy(own, result, list)
  seen.left = left_over(own, result, good)
  for _, c in ipairs(own.constraints) do
    if has_steps(list, c.name) then seen.step = c.name end
  end
  return seen
end

local function only_numbers(own)
  for _, p in ipairs(own.parameters) do
    if p.kind ~= "number" then return false end
  end
  return true
end

-- Returns the method, and why.
local function choose(own, seen)
  local method, why = search.auto(own.parameters, #own.constraints, seen.noise)
  if seen.noise or #own.parameters == 1 or not only_numbers(own) then return method, why end
  if seen.share > MANY_FAIL then
    return "cma-es", ("%.0f %% of the evaluations failed, which it bears"):format(100 * seen.share)
  end
  if seen.step then return "cma-es", ("'%s' has steps, which it bears"):format(seen.step) end
  if seen.left and seen.left > SMOOTH then
    return "cma-es", ("a quadratic polynomial leaves %.0f %% of the variance unexplained"):format(
      100 * seen.left)
  end
  if not seen.left then return method, why end
  why = ("it is smooth: a quadratic polynomial leaves %.2g %% of the variance unexplained"):format(
    100 * seen.left)
  return judge.count_sides(own) > 0 and "cobyla" or "bobyqa", why
end

-- Evaluations of a start. To come within 1e-4 of the ranges, bowls of 1 to 8 parameters took: simplex 24 to
-- 420, BOBYQA 9 to 29, COBYLA 20 to 166, CMA-ES 144 to 940; a crooked valley took 3020. This is about twice
-- as many.
local NEEDED = { simplex = function(n) return 50 * n ^ 1.4 end, bobyqa = function(n) return 20 * n end,
  cobyla = function(n) return 40 * n end, ["cma-es"] = function(n) return 400 * n end }

local Advice = { __name = "advice" }
Advice.__index = checks.fields("advice", "method evaluations why lines")
function Advice.__tostring(a) return table.concat(a.lines, "\n") end

local function remarks(own, result, seen, lines)
  if seen.failed > 0 then
    say(lines, "  %d of %s failed so far", seen.failed, counted(seen.count, "evaluation"))
  end
  if seen.noise then
    say(lines, "  the same place gave different values: give noise = true, and use the mean")
  end
  if seen.step and #own.parameters > 1 then
    say(lines, "  '%s' has steps: a result that tells how near it is, such as a margin, is found faster",
      seen.step)
  end
  for _, p in ipairs(own.parameters) do
    if p.kind ~= "choice" and not p.log and p.low > 0 and p.high / p.low >= 100 then
      say(lines, "  '%s' goes up to %.0f times its lowest value: log = true searches evenly over it", p.name,
        p.high / p.low)
    end
  end
  local best = minimum.best(own, result, output.records(own))
  if not best then say(lines, "  no evaluation meets the constraints so far") end
end

--- Returns advice on a search for the smallest value of a result.
function advise.run(own, result)
  if type(result) ~= "string" then
    error(("study:advise: the name of a result is wanted, such as study:advise 'time', got %s"):format(
      checks.got(result)), 0)
  end
  if #output.records(own) == 0 then
    local n = #own.parameters
    error(("study:advise: there are no evaluations; study:sweep { count = %d } gives enough"):format(
      2 * (n + 1) * (n + 2)), 0)
  end
  local seen = look(own, result)
  local method, why = choose(own, seen)
  local starts = search.of(method).starts or 1
  local factor = starts * (seen.noise and 4 or 1)
  local evaluations = math.ceil(NEEDED[method](#own.parameters) * factor / 10) * 10
  local lines = { ("study:minimise(%q, { method = %q, evaluations = %d%s })"):format(result, method,
    evaluations, seen.noise and ", noise = true" or ""), "  " .. why }
  if not seen.left then
    local n = #own.parameters
    say(lines, "  there are too few evaluations to see whether the result is smooth; run study:sweep { count "
      .. "= %d }",
      2 * (n + 1) * (n + 2))
  end
  remarks(own, result, seen, lines)
  return setmetatable({ method = method, evaluations = evaluations, why = why, lines = lines }, Advice)
end

return advise
