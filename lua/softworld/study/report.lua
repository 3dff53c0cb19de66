-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes the page of a study: one HTML file with a table and cross plots. A click on an evaluation opens its
-- player's page if that was made, or shows the lines that make it. The sources are in
-- lua/softworld/study/page.
-- @module softworld.study.report
local again = require "softworld.study.again"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local json = require "softworld.output.json"
local judge = require "softworld.study.judge"
local letters = require "softworld.output.letters"
local output = require "softworld.study.output"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local sink = require "softworld.output.sink"

local _, here = ...
local folder = here:match "^(.*)report%.lua$" .. "page/"

local report = {}

local MOST = 20000 -- most evaluations in a page
local NULL = 0 / 0  -- written as null in JSON

local MOST_PLAYED = 200

local call = rows.call("study:report", "path, {...}", "writes a page with table and plots, for any browser", {
  gives = "the path",
  example = 'study:report("grip.html", { play = { study:best "time" } })',
  { "play", "table or 'all'", "-", "evaluations whose runs can be played by a click, in files beside the "
    .. "page: rows of the table or numbers; each is computed again", usual = "none" },
})

local function columns_of(own, list)
  local parameters, results, limits = {}, {}, {}
  for i, p in ipairs(own.parameters) do
    parameters[i] = json.object { name = p.name, unit = p.unit, log = p.log, kind = p.kind,
      choices = p.choices }
  end
  for _, c in ipairs(own.constraints) do limits[c.name] = c end
  for i, name in ipairs(output.result_names(list)) do
    local c = limits[name] or {}
    results[i] = json.object { name = name, unit = c.unit, min = c.min, max = c.max }
  end
  return parameters, results
end

-- Returns the records to show: all, or evenly chosen ones.
local function few(list)
  if #list <= MOST then return list end
  local some = {}
  for k = 1, MOST do some[k] = list[1 + (k - 1) * #list // MOST] end
  return some, ("Shown are %d of %d evaluations."):format(MOST, #list)
end

-- Returns the evaluations to play, each once.
local function wanted(own, play)
  if play == nil then return {} end
  local list = play
  if play == "all" then list = output.records(own) end
  if type(list) ~= "table" or getmetatable(list) then
    error(("study:report: play must be a list of rows or numbers, or 'all', got %s"):format(
      checks.got(play)), 0)
  end
  if #list > MOST_PLAYED then
    error(("study:report: play has %d evaluations; %d at most"):format(#list, MOST_PLAYED), 0)
  end
  return list
end

-- Writes the players' pages beside the study's; returns file names by "part.number".
local function players(self, own, path, play)
  local files = {}
  for _, one in ipairs(wanted(own, play)) do
    local record = again.find(own, one)
    local label = ("%d.%d"):format(record.part, record.number)
    if not files[label] then
      local _, run = again.compute(self, record)
      if not run then
        error(("study:report: evaluation %s has no run of a scene to be played"):format(label), 0)
      end
      local file = path:gsub("%.html?$", "") .. "-" .. label .. ".html"
      run:report(file)
      files[label] = file:match "[^/]*$"
    end
  end
  return files
end

local function row_of(own, record, results)
  local values, pass = {}, judge.pass(own, record)
  for i, value in ipairs(record.values) do values[i] = value end
  for _, r in ipairs(results) do
    values[#values + 1] = record.results and record.results[r.name] or NULL
  end
  return { record.part, record.number, values, pass == nil and NULL or pass and 1 or 0,
    record.failed or record.events or "" }
end

local function parts_of(own, list)
  local parts, seen = {}, {}
  for _, record in ipairs(list) do
    local part = record.part
    if not seen[part] then
      parts[#parts + 1] = { part, ("%d. %s"):format(part, own.asked[part] and own.asked[part].method
        or own.journal:name(part) or "in the journal") }
    end
    seen[part] = true
  end
  return parts
end

local function data_of(own, files)
  local list = output.records(own)
  if #list == 0 then error("study:report: there is no evaluation to show", 0) end
  local parameters, results = columns_of(own, list)
  local some, note = few(list)
  local shown, passed, failed = {}, 0, 0
  for i, record in ipairs(some) do shown[i] = row_of(own, record, results) end
  for _, record in ipairs(list) do
    local pass = judge.pass(own, record)
    if pass then passed = passed + 1 elseif pass == nil then failed = failed + 1 end
  end
  return json.object { title = own.name, version = core.version, count = #list, passed = passed,
    failed = failed, note = note, constraints = #own.constraints > 0, parameters = parameters,
    results = results, parts = parts_of(own, list), rows = shown, players = json.object(files) }
end

local function do_report(self, path, args)
  local own, o = sealed.fields(self), call:read(args == nil and {} or args)
  if type(path) ~= "string" or not path:find "%.html?$" then
    error(("study:report: the name of a file that ends in .html is wanted, got %s"):format(
      checks.got(path)), 0)
  end
  if own.task then return path end
  local files = players(self, own, path, o.play)
  local data = json.encode(data_of(own, files)):gsub("[<>&]", { ["<"] = "\\u003c", [">"] = "\\u003e",
    ["&"] = "\\u0026" }) -- no text can end the script element, or open a comment in it
  local parts = { title = letters.xml(own.name), STYLES = sink.read_file(folder .. "style.css"),
    SCRIPTS = sink.read_file(folder .. "study.js"),
    data = '<script type="application/json" id="data">' .. data .. "</script>" }
  local page = sink.read_file(folder .. "index.html")
  page = page:gsub("@(%a+)@", function(name) return parts[name] end)
  return sink.write_file(path, page)
end

--- study:report(path, { play = }).
function report.report(self, path, args) return build.call(3, do_report, self, path, args) end

return report
