-- SPDX-License-Identifier: GPL-3.0-or-later
--- study:change: finds what to change so that failing or barely passing rows of a check pass. See help
-- "change".
-- @module softworld.study.change
local build = require "softworld.scene.build"
local campaign = require "softworld.study.campaign"
local changed = require "softworld.study.changed"
local changing = require "softworld.study.changing"
local check_results = require "softworld.check.results"
local checks = require "softworld.checks"
local core = require "softworld.core"
local evaluation = require "softworld.study.evaluation"
local parameters = require "softworld.study.parameters"
local parts = require "softworld.study.parts"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local unread = require "softworld.unread"

local change = {}

local call = rows.call("study:change", "row or {...}", "finds what to change so that rows of a check pass; "
  .. "evaluate must return the check, see help 'change'", {
  gives = "the result: ok, parameters, rows",
  example = 'print(study:change "cable.min_bend_radius")',
  { "rows", "list", "-", "names of the rows that must pass", usual = "those that fail or pass narrowly" },
  { "at", "table", "-", "the parameters as they are now, by name", usual = "the parameters' start" },
  { "reserve", "number", "-", "margin that a row must have, as a share of its limit", min = 0, max = 10,
    default = 0.05 },
  { "values", "integer", "-", "number of values tried over each range", min = 2, max = 10000, default = 9 },
  { "workers", "integer", "-", "processes; 0 computes in this one", min = 0, max = 256,
    usual = "those of the study" },
})

local function fail(text, ...) error("study:change: " .. text:format(...), 0) end

-- --- what it begins with ---------------------------------------------------------------------------

local function choice_of(p, value)
  for k, choice in ipairs(p.choices) do
    if choice == value then return k end
  end
  fail("at: %s = %s is none of its choices", p.name, checks.got(value))
end

local function value_of(p, given)
  if given == nil then
    if p.kind == "choice" then return 1 end
    return p.start or fail("parameter '%s' has no start, the value that it has now; give start = in "
      .. "parameters, or at = { %s = }", p.name, p.name)
  end
  if p.kind == "choice" then return choice_of(p, given) end
  checks.number("study:change: at: " .. p.name, given, p.low, p.unit and " " .. p.unit or "", 0, p.high)
  if p.kind == "number" then return given + 0.0 end
  return math.tointeger(given) or fail("at: %s = %.9g is not an integer", p.name, given)
end

-- Returns the present values by the parameters' numbers. at may be a row of the table, with results.
local function present(own, at)
  local values = {}
  for name in pairs(at or {}) do
    if not own.by_name[name] and at.number == nil then
      checks.word("study:change: at", name, own.by_name, 0)
    end
  end
  for i, p in ipairs(own.parameters) do
    local given
    if at then given = at[p.name] end
    values[i] = value_of(p, given)
    if p.kind == "integer" then values[i] = math.tointeger(values[i]) end
  end
  return values
end

-- Returns the check of the present values; it is made here for names, units and limits.
local function present_check(own, values)
  campaign.build(own)
  own.busy = true
  own.stream = parts.stream "change"
  local fine, status, text, given = pcall(unread.excused, evaluation.again, own, 1, values)
  own.busy = false
  if not fine then error(status, 0) end
  if status == "mistake" then error(text, 0) end
  if status ~= "ok" then fail("evaluate fails with the parameters as they are: %s", text) end
  if checks.kind(given) ~= "check" then
    fail("evaluate must return a check, run:check {...}, got %s", checks.got(given))
  end
  return given
end

-- --- which rows --------------------------------------------------------------------------------------

local function floor_of(row, reserve) return row.limit and reserve * math.abs(row.limit) or 0 end

local function is_wanting(row, reserve)
  return row.verdict ~= "PASS" or row.margin ~= nil and row.margin < floor_of(row, reserve)
end

-- True for a row without judgement: it has no limit, or nothing to measure.
local function is_hopeless(row) return row.verdict == "OPEN" and row.margin == nil end

local function by_names(keys, names)
  local wanted, known = {}, {}
  for _, one in ipairs(keys) do known[#known + 1] = one.row.name end
  for i, name in ipairs(names) do
    local found
    for _, one in ipairs(keys) do
      local full = one.row.object and one.row.object .. "." .. checks.shown(name)
      if one.row.name == name or one.row.name == full then found, wanted[one] = true, true end
    end
    if not found then
      local near = type(name) == "string" and core.nearest(name, known)
      fail("rows[%d]: there is no row %s; %s", i, checks.got(name), near
        and ("did you mean '%s'?"):format(near) or "there are: " .. table.concat(known, " "))
    end
  end
  return wanted
end

-- Returns the targets, and what must be known of all rows.
local function targets_of(keys, o)
  local targets, hopeless, names = {}, {}, {}
  local wanted = o.rows and by_names(keys, o.rows)
  local count, seen = 0, {}
  for _, one in ipairs(keys) do seen[one.row.name] = (seen[one.row.name] or 0) + 1 end
  for _, one in ipairs(keys) do
    names[one.key] = one.row.name .. (seen[one.row.name] > 1 and one.row.side and " " .. one.row.side or "")
    if is_hopeless(one.row) then
      hopeless[one.key] = true
      if wanted and wanted[one] then fail("row '%s' has no limit: %s", one.row.name, one.row.note or "") end
    elseif wanted and wanted[one] or not wanted and is_wanting(one.row, o.reserve) then
      targets[#targets + 1] = { key = one.key, row = one.row, floor = floor_of(one.row, o.reserve),
        passes = not is_wanting(one.row, o.reserve) }
      if not targets[#targets].passes then count = count + 1 end
    end
  end
  if count > 1 then targets[#targets + 1] = { all = true } end
  return targets, hopeless, names
end

-- --- doing it ------------------------------------------------------------------------------------------

-- Returns the source of the evaluations that the coroutine asks for, one list after the other.
local function source_of(self, thread)
  local list, at, told, numbers, highest = {}, 0, 0, {}, 0
  local function resume(...)
    local fine, given = coroutine.resume(thread, ...)
    if not fine then error(given, 0) end
    if coroutine.status(thread) == "dead" then
      self.answer, list = given, {}
    else list = given end
    at, told, numbers = 0, 0, {}
  end
  local source = {}
  function source.next()
    if self.answer then return nil end
    if at == #list and told == #list then
      if highest == 0 then resume(self) else resume(self.records) end
      self.records = {}
    end
    if at == #list then return nil end
    at, highest = at + 1, highest + 1
    numbers[highest] = at
    return highest, list[at]
  end
  function source.done(record)
    self.records[numbers[record.number]] = record
    told, self.count_failed = told + 1, self.count_failed + (record.results and 0 or 1)
    self.total = self.total + 1
  end
  return source
end

local function do_change(self, args)
  local own = sealed.fields(self)
  if type(args) == "string" then args = { rows = { args } } end
  local o = call:read(args == nil and {} or args)
  if own.busy then error(("study '%s': evaluate cannot start other evaluations"):format(own.name), 0) end
  local values = present(own, o.at)
  local check = present_check(own, values)
  local targets, hopeless, names = targets_of(check_results.keys(check, own.by_name), o)
  local work = { own = own, values = values, targets = targets, hopeless = hopeless, names = names,
    count = o.values, total = 0, count_failed = 0 }
  if #targets > 0 then
    local most = 2 + #own.parameters * (o.values + 4 + 8 * #targets)
    campaign.run(own, "change", { workers = o.workers, reserve = o.reserve, values = o.values, rows = o.rows,
      at = parameters.word(values), evaluations = most }, source_of(work, coroutine.create(changing.run)))
  end
  return changed.new(work, check, o)
end

--- study:change(row or { rows =, at =, reserve =, values =, workers = }).
function change.change(self, args) return build.call(3, do_change, self, args) end

return change
