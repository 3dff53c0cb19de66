-- SPDX-License-Identifier: GPL-3.0-or-later
--- Studies: evaluate one script's model many times, on all processors, with a journal that loses
-- nothing.
--
--     local study = sw.study { name = "grip", file = "grip.study",
--       parameters = { force = { 0.5, 20, unit = "N", log = true } },
--       setup = function() return build_scene() end,
--       evaluate = function(p, scene) ... return { time = t, margin = m } end,
--       constraints = { margin = { max = 0.9 } } }
--     study:minimise "time"
--     print(study)
-- @module softworld.study.study
local advise = require "softworld.study.advise"
local build = require "softworld.scene.build"
local campaign = require "softworld.study.campaign"
local chart = require "softworld.study.chart"
local checks = require "softworld.checks"
local core = require "softworld.core"
local design = require "softworld.study.design"
local fingerprint = require "softworld.study.fingerprint"
local fit = require "softworld.study.fit"
local journal = require "softworld.study.journal"
local judge = require "softworld.study.judge"
local methods = require "softworld.methods"
local minimise = require "softworld.study.minimise"
local node = require "softworld.study.node"
local output = require "softworld.study.output"
local parameters = require "softworld.study.parameters"
local pareto = require "softworld.study.pareto"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local search_methods = require "softworld.study.search"
local spread = require "softworld.study.spread"
local unread = require "softworld.unread"
local where = require "softworld.study.where"

local study = {}
local Study = { __name = "study" }
sealed.class(Study)

local WORKERS = { "workers", "integer", "-", "processes; 0 computes in this one", min = 0, max = 256,
  usual = "those of the study" }

local new = rows.call("sw.study", "{...}", "a study: a model to be evaluated many times, see help 'study'", {
  gives = "a study",
  { "name", "name", "-", "of the study", required = true },
  { "parameters", "table", "-", "by name { lowest, highest, unit =, log =, integer =, start =, sigma =, "
    .. "of = }, { choices = {...} }, or a value of the catalogue with its bounds", required = true },
  { "evaluate", "function", "-", "function of the parameters and of what setup returned; returns a table of "
    .. "numbers or a check", required = true },
  { "setup", "function", "-", "builds once what all evaluations use; its scenes are restored before each "
    .. "evaluation" },
  { "constraints", "table", "-", "of results by name { min =, max =, unit = }" },
  { "file", "text", "-", "name of the journal; the same script goes on from it", usual = "nothing is kept" },
  { "seed", "integer", "-", "of the random numbers", min = 0, max = 1 << 53, default = 1 },
  { "workers", "integer", "-", "processes; 0 computes in this one", min = 0, max = 256,
    usual = "one per processor" },
  { "cpu", "number", "s", "largest computing time of an evaluation", min = 0, above = true, usual = "any" },
  { "steps", "integer", "-", "largest number of steps of an evaluation, rejected steps included",
    min = 1, max = 1 << 53, usual = "any" },
  { "on", "choice", "-", "where evaluations are computed, see study:run", choices = { "here", "slurm" },
    usual = "SOFTWORLD_ON of the environment, else here" },
  { "memory", "number", "-", "largest memory that a worker may take in addition [B]", min = 1e6,
    usual = "any" },
})

local sweep = rows.call("study:sweep", "{...}", "evaluates on a grid, or at points spread over the ranges", {
  gives = "the rows of the table",
  example = "study:sweep { grid = { force = 9, speed = 5 } }",
  { "kind", "choice", "-", "how", choices = { "grid", "latin", "halton", "sobol" },
    usual = "grid with grid, else sobol" },
  { "method", "choice", "-", "the same as kind", choices = { "grid", "latin", "halton", "sobol" } },
  { "grid", "numbers of values", "-", "number of values on each range, or a table by the parameter's name" },
  { "count", "integer", "-", "evaluations, of a grid at most", min = 1, max = 1000000 },
  WORKERS,
})

local search = rows.call("study:minimise", "result, {...}", "looks for the smallest value of a result that "
  .. "meets the constraints", {
  gives = "the result: best, value, ok, reason",
  example = 'study:minimise "time"',
  { "method", "choice", "-", "how to search, see help 'search'", choices = { "auto",
    table.unpack(search_methods.names) }, default = "auto", about = search_methods.about },
  { "starts", "integer", "-", "number of places from which it starts, the first at the parameters' start; "
    .. "cma-es starts one after the other, each with twice the population", min = 1, max = 1000,
    usual = "4, of cma-es 1" },
  { "evaluations", "integer", "-", "largest number of evaluations, all starts together", min = 1,
    max = 1000000,
    usual = "100 to 500 for each start and parameter" },
  { "tolerance", "number", "-", "wanted accuracy, as a share of the ranges", min = 0, above = true, max = 0.5,
    default = 1e-4 },
  { "step", "number", "-", "the first, as a share of the ranges", min = 0, above = true, max = 0.5,
    usual = "0.2, of cma-es 0.3" },
  { "noise", "boolean", "-", "values are noisy: cma-es then repeats evaluations often enough",
    default = false, usual = "false" },
  { "around", "boolean", "-", "also evaluates near the result, to find noise and flat directions",
    default = true, usual = "true" },
  WORKERS,
})

local shake = rows.call("study:spread", "{...}", "how often the constraints are met while the parameters "
  .. "vary", {
  gives = "the result: probability, low, high, worst",
  example = "study:spread { count = 1000 }",
  { "count", "integer", "-", "evaluations", min = 1, max = 1000000, default = 1000 },
  { "kind", "choice", "-", "random numbers, or Sobol's sequence, which fills the ranges more evenly",
    choices = { "random", "sobol" }, default = "random" },
  WORKERS,
})

local trade = rows.call("study:pareto", "{ results, ... }", "finds the Pareto front of two or three results: "
  .. "evaluations that meet the constraints and that no other evaluation beats in all results", {
  gives = "the front: rows, knee, evaluations, failed",
  example = 'study:pareto { "time", "peak" }',
  { "evaluations", "integer", "-", "at most", min = 1, max = 1000000, usual = "40 generations" },
  { "population", "integer", "-", "evaluations of a generation", min = 4, max = 10000,
    usual = "20 for each result" },
  WORKERS,
})

rows.calls{
  { "study:front", "{ results }", "the rows of the whole table that no other row beats in all these results",
    "the front: rows, knee, evaluations, failed", example = 'study:front { "time", "peak" }' },
  { "study:advise", "result", "the best method for a search, the number of evaluations, and why",
    "advice: method, evaluations, why, lines", example = 'print(study:advise "time")' },
  { "study:table", "", "all evaluations: number, parameters, results, pass, failed, events",
    "a list of tables" },
  { "study:best", "result", "the evaluation with the smallest value that meets the constraints",
    "a row, or nil" },
  { "study:csv", "path", "writes the table", "the path", example = 'study:csv "grip.csv"' },
  { "study:json", "path", "writes the table and the description of the study", "the path" },
  { "study.name", nil, "of the study", "a text" },
  { "study.file", nil, "its journal", "a path, or nil" },
  { "study.computed", nil, "evaluations that this process has computed, without those read from the journal",
    "a number" },
}

local draw = rows.call("study:chart", "{...}", "draws the evaluations; needs gnuplot", {
  gives = "the path, or without one the drawing in characters",
  example = 'study:chart { x = "force", y = "time", path = "grip.svg" }',
  { "kind", "choice", "-", "kind of chart, see help 'study'", choices = chart.names, default = "points",
    about = function(name) return chart.of(name).doc end },
  { "x", "text", "-", "a parameter or a result", usual = "required by points, histogram, front" },
  { "y", "text", "-", "a parameter or a result", usual = "required by all but histogram" },
  { "part", "integer", "-", "only this sweep, search or spread, by its number", min = 1, max = 1 << 31,
    usual = "all" },
  { "path", "text", "-", "a .svg, .png or .pdf file", usual = "drawn in characters" },
  { "log", "choice", "-", "axes that are logarithmic", choices = { "x", "y", "xy" },
    usual = "by the parameters" },
})

local function fields(self) return sealed.fields(self) end

-- --- making ------------------------------------------------------------------------------------

local function definition(own)
  local lines = { "version " .. core.version, ("seed %d"):format(own.seed), "parts by method and options" }
  for _, p in ipairs(own.parameters) do lines[#lines + 1] = "parameter " .. parameters.describe(p) end
  if own.steps then lines[#lines + 1] = ("steps %d"):format(own.steps) end
  lines[#lines + 1] = "functions of the script " .. fingerprint(own.setup, own.evaluate)
  local text = table.concat(lines, "\n")
  return { name = own.name, text = text, key = ("%016x"):format(core.checksum(text)) }
end

local function tell(own)
  for _, line in ipairs(own.journal:remarks()) do
    if not own.told[line] then io.stderr:write(("study '%s': %s\n"):format(own.name, line)) end
    own.told[line] = true
  end
end

local function make(args)
  local own = new:read(args)
  own.parameters = parameters.read(own.parameters)
  own.by_name = {}
  for _, p in ipairs(own.parameters) do own.by_name[p.name] = p end
  own.constraints = judge.read(own.constraints, own.by_name)
  own.seed = math.tointeger(own.seed)
  own.part, own.asked, own.told, own.computed, own.counts = 0, {}, {}, 0, {}
  own.journal = journal.new(own.file, definition(own))
  unread.used()
  node.study(own)
  where.of_study(own)
  own.journal:read()
  local object = sealed.new(Study, own)
  function own.tell() tell(own) end
  function own.interrupted()
    io.stderr:write(("study '%s' was interrupted; so far:\n%s\n"):format(own.name, output.text(own)))
  end
  return object
end

--- sw.study { name =, parameters =, evaluate =, ... }: see help "study".
study.study = build.placed(make)

-- --- methods -----------------------------------------------------------------------------------

-- Evaluates count points given by a function of their number.
local function points(own, method, options, count, values_of)
  local at = 0
  return campaign.run(own, method, options, { whole = true, count = count, next = function()
    if at >= count then return nil end
    at = at + 1
    return at, values_of(at)
  end })
end

local function do_sweep(self, args)
  local own, o = fields(self), sweep:read(args == nil and {} or args)
  if o.kind and o.method and o.kind ~= o.method then
    error(("study:sweep: give kind = '%s' or method = '%s', not both"):format(o.kind, o.method), 0)
  end
  local kind = o.kind or o.method or o.grid ~= nil and "grid" or "sobol"
  o.method = nil
  local what = "study:sweep"
  if kind ~= "grid" and o.grid ~= nil then
    error(("study:sweep: grid does not go with kind = '%s'"):format(kind), 0)
  end
  if o.grid ~= nil and type(o.grid) ~= "number" and type(o.grid) ~= "table" then
    error(("study:sweep: grid must be a number, or a table { name = number, ... }, got %s"):format(
      checks.got(o.grid)), 0)
  end
  if not o.count and (kind ~= "grid" or o.grid == nil) then
    error("study:sweep: count is required, the number of evaluations"
      .. (kind == "grid" and ", or grid" or ""), 0)
  end
  local count, values_of = o.count
  o.kind = kind
  if kind == "grid" then count, values_of = design.grid(own.parameters, what, o.grid, o.count)
  else values_of = design.fill(own.parameters, kind, count, own.seed) end
  local records = points(own, "sweep", o, count, values_of)
  judge.some(own, records, count)
  return output.rows(own, own.part)
end

local function do_minimise(self, result, args)
  local own = fields(self)
  if type(result) ~= "string" then
    error(("study:minimise: the name of a result is wanted, such as study:minimise 'time', got %s"):format(
      checks.got(result)), 0)
  end
  return minimise.run(own, result, search:read(args == nil and {} or args))
end

local function do_spread(self, args)
  local own, o = fields(self), shake:read(args == nil and {} or args)
  judge.needed(own, "study:spread")
  local drawing = o.kind == "sobol" and spread.filling(own, o.count) or spread.drawing(own)
  local kind = o.kind == "sobol" and o.kind or nil
  local records = points(own, "spread", { workers = o.workers, kind = kind }, o.count, drawing)
  judge.some(own, records, o.count)
  return spread.result(own, records, o.kind)
end

local function do_pareto(self, args)
  local own, names, rest = fields(self), pareto.names("study:pareto", args)
  return pareto.run(own, names, trade:read(rest))
end

local function do_front(self, args)
  local own, names, rest = fields(self), pareto.names("study:front", args)
  checks.keys("study:front", rest, {}, 0)
  return pareto.front(own, names)
end

local function do_advise(self, result) return advise.run(fields(self), result) end

local function do_fit(self, args) return fit.run(fields(self), args) end

local function list_rows(self) return output.rows(fields(self)) end

local function do_best(self, result) return output.best(fields(self), result) end

local function do_csv(self, path) return output.csv(fields(self), path) end

local function do_json(self, path) return output.json(fields(self), path) end

local function do_chart(self, args) return chart.draw(fields(self), draw:read(args)) end

-- Tail calls keep error levels the same as without these functions.
function Study:sweep(args) return build.call(3, do_sweep, self, args) end
function Study:minimise(result, args) return build.call(3, do_minimise, self, result, args) end
function Study:fit(args) return build.call(3, do_fit, self, args) end
function Study:spread(args) return build.call(3, do_spread, self, args) end
function Study:pareto(args) return build.call(3, do_pareto, self, args) end
function Study:front(args) return build.call(3, do_front, self, args) end
function Study:advise(result) return build.call(3, do_advise, self, result) end
function Study:table() return build.call(3, list_rows, self) end
function Study:best(result) return build.call(3, do_best, self, result) end
function Study:csv(path) return build.call(3, do_csv, self, path) end
function Study:json(path) return build.call(3, do_json, self, path) end
function Study:chart(args) return build.call(3, do_chart, self, args) end

rows.later(Study, "softworld.study.where", "run cancel")
rows.later(Study, "softworld.study.again", "again")
rows.later(Study, "softworld.study.change", "change")
rows.later(Study, "softworld.study.report", "report")
methods.guard_table("study", Study)

local SHOWN = "run cancel sweep minimise fit pareto front spread change advise table best again report csv "
  .. "json chart name file computed"
local unknown
unknown, Study.__names = checks.fields("study", SHOWN, "file")

function Study:__index(key)
  local own = sealed.fields(self)
  if key == "name" or key == "file" or key == "computed" then return own[key] end
  local method = rawget(Study, key)
  if method ~= nil then return method end
  return unknown(self, key)
end

function Study:__newindex(key)
  error(("study '%s' cannot be written to (%s)"):format(fields(self).name, checks.shown(key)), 2)
end

function Study.__tostring(self) return output.text(fields(self)) end

return study
