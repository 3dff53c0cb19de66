-- SPDX-License-Identifier: GPL-3.0-or-later
--- run:check: decides whether a process passes. Rows with value, limit, margin and verdict. See help "check".
-- @module softworld.check.check
local askew = require "softworld.check.askew"
local build = require "softworld.scene.build"
local bendrule = require "softworld.wire.bendrule"
local checks = require "softworld.checks"
local core = require "softworld.core"
local doubted = require "softworld.check.doubted"
local edges = require "softworld.check.edges"
local fixing = require "softworld.link.fixing"
local judge = require "softworld.check.judge"
local limits = require "softworld.check.limits"
local own = require "softworld.check.own"
local registry = require "softworld.check.registry"
local released = require "softworld.check.released"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local stages = require "softworld.run.stages"
local unjudged = require "softworld.check.unjudged"
local unread = require "softworld.unread"
local wanted = require "softworld.check.wanted"
local writing = require "softworld.check.writing"

local check = {}


local call = rows.call("run:check", "{...}", "judges whether the process passes, see help 'check'", {
  gives = "a check: verdict, rows, csv, json, junit",
  example = 'print(run:check { use = "movement", limits = { max_tension = 80 } })',
  { "use", "choice", "-", "use of the cable, which sets the allowed bend radius", choices = bendrule.uses,
    usual = "that of the wire" },
  { "limits", "limits", "-", "by name: a number, false or { max =, min =, source =, sure = }",
    usual = "of the catalogue, standards and definitions" },
  { "checks", "tables", "-", "checks of your own: { name =, unit =, of = function(run), max =, min = }" },
  { "landing", "table", "-", "path on which the wire must lie at the end", rows = wanted.landing },
  { "fatigue", "table", "-", "curves of how many cycles of tension and bending the wire endures",
    rows = wanted.fatigue },
  { "abrasion", "table", "-", "wear of the wire's surface by sliding", rows = wanted.abrasion },
  { "vibration", "table", "-", "vibration of the holds, with the wires as they lie at the end",
    rows = wanted.vibration },
  { "trial", "boolean", "-", "true: softworld --check does not count it", usual = "false" },
})

rows.calls{
  { "check.verdict", nil, "FAIL if a row fails, else OPEN if a row is open, else PASS",
    "a text" },
  { "check.ok", nil, "is it PASS?", "true or false" },
  { "check.reason", nil, "in one sentence", "a text" },
  { "check.rows", nil, "name, object, what, value, unit, error, low, high, side, limit, limit_low, "
    .. "limit_high, from, source, margin, s, time, step, verdict, note", "a list" },
  { "check.skipped", nil, "names of checks that the script left out", "a list" },
  { "check.name", nil, "of the scene", "a text" },
  { "check.start", nil, "of the run", "s" },
  { "check.time", nil, "at the end of the run", "s" },
  { "check:row", "name", "the first row of that name, such as 'max_tension' or 'left.peak_force'", "a row",
    example = 'print(run:check {}:row "max_tension".margin)' },
  { "check:csv", "path", "writes the rows as CSV", "the path" },
  { "check:json", "path", "writes the rows as JSON", "the path" },
  { "check:junit", "path", "writes the rows as JUnit XML, for CI: FAIL is a failure, OPEN an error",
    "the path" },
}

-- --- what is judged ------------------------------------------------------------------------------

-- Returns how a wire was changed after the run, so that its values are not those of the run; nil: it was not.
local function changed(run, wire)
  local was = sealed.fields(run).present
  if not was then return nil end -- before the run
  if not was[wire] then return "it was made after the run" end
  if was[wire] ~= build.remodels(wire) then
    return "it was remodelled after the run, and its values are those of the new model"
  end
end

local function context_of(run, args)
  local data = build.data(run.scene)
  local c = { run = run, scene = run.scene, use = args.use, landing = args.landing, fatigue = args.fatigue,
    abrasion = args.abrasion, vibration = args.vibration, wires = {}, grippers = {} }
  for i, w in ipairs(data.wires) do
    c.wires[i] = { name = w.name, object = w.object, number = i, use = core.data(w.object).use,
      changed = changed(run, w.object) }
  end
  for i, g in ipairs(data.grippers) do c.grippers[i] = { name = g.name, object = g } end
  local clips, ties = {}, {}
  for _, f in ipairs(fixing.all(run.scene)) do
    local list = ({ clip = clips, tie = ties })[checks.kind(f)]
    if list then list[#list + 1] = { name = f.name, object = f } end
  end
  for kind, list in pairs { clip = clips, tie = ties } do
    table.move(released.all(run.scene, kind), 1, #released.all(run.scene, kind), #list + 1, list)
  end
  c.objects = { wire = c.wires, gripper = c.grippers, clip = clips, tie = ties, run = { { object = run } } }
  return c
end

-- Returns the run's error bar for a quantity of this name [unit], or nil.
local function error_bar(run, object, name)
  local known = run.quantities or {}
  local q = object and known[object .. "." .. name] or known[name]
  return q and type(q.value) == "number" and q.error or nil
end

-- Widens the range of a value by its error bar. value.share: the error scales with low and high.
local function with_error(value, bar)
  if not bar then return value end
  value.error = bar
  local low, high = bar, bar
  if value.share and value.value > 0 and bar > 0 and bar < math.huge then
    low, high = bar * value.low / value.value, bar * value.high / value.value
  end
  value.low, value.high = (value.low or value.value) - low, (value.high or value.value) + high
  return value
end

local function add_note(row, text)
  if text then row.note = row.note and row.note .. "; " .. text or text end
end

-- Adds a row without a verdict.
local function start_row(self, name, object, label, unit, value)
  local row = { name = object and object .. "." .. name or name, object = object, what = label, unit = unit,
    value = value.value, error = value.error, low = value.low, high = value.high, s = value.s,
    time = value.time, note = value.note }
  row.step = value.time and stages.at(self.scene, value.time) or nil
  self.rows[#self.rows + 1], self.made[name] = row, true
  return row
end

local function close_row(row, value, limit, side, suspicious, text)
  row.side, row.limit, row.limit_low, row.limit_high = side, limit.value, limit.low, limit.high
  row.from, row.source = limit.from, limit.source
  row.margin = judge.margin(value, limit, side)
  row.verdict = judge.verdict(value, limit, side)
  if value.value ~= value.value then
    row.margin = nil
    add_note(row, "the value is not a number")
  end
  if (suspicious or value.doubt) and row.verdict == "PASS" then
    row.verdict = "OPEN"
    add_note(row, value.doubt)
  end
  if text then add_note(row, text) end
end

-- Adds a row for each side that the script limits.
local function judge_given(given, known, reference, fresh, value, unit, own_side)
  for _, side in ipairs{ "min", "max" } do
    local limit = given[side]
    if limit then
      local natural = side == own_side
      local text, suspicious = judge.suspicion(value.value, limit, side, unit, natural and known or nil,
        natural and reference or nil)
      if limit.sure then text, suspicious = nil, false end
      close_row(fresh(), value, limit, side, suspicious, text)
    end
  end
end

-- Says which limit is missing and how to give it, or how to say that none is needed.
local function missing_row(self, row, member, entry)
  local nan = row.value ~= row.value
  row.verdict = nan and "FAIL" or "OPEN"
  if nan then add_note(row, "the value is not a number") end
  local key = entry.name and entry.name .. "." .. member.name or member.name
  local lacks = ("the catalogue has no %s here; give"):format(member.missing or "limit")
  if member.rated then
    local has = entry.object.rating and ("'s rating has no " .. member.rated) or " has no rating"
    lacks = ("the gripper%s; give scene:gripper { rating = { %s = } } or"):format(has, member.rated)
  end
  add_note(row, ("limit is missing: %s limits = { ['%s'] = } [%s], or false if none is needed"):format(lacks,
    key, member.unit))
  self.missing[#self.missing + 1] = { name = key, unit = member.unit }
end

-- Returns the limit from the catalogue, a standard or a rating; nil and the reason if there is none; false if
-- none is needed.
local function known_limit(member, entry, context)
  if not member.limit then return nil end
  local fine, known = pcall(member.limit, entry, context)
  if fine then return known end
  if checks.is_interrupt(known) or member.rated then error(known, 0) end -- a rating that the script spoilt
  return nil, checks.shown(known)
end

-- Adds all rows of one check on one object.
local function judge_one(self, member, entry, context, list)
  local given = limits.of(list, member, entry)
  local full = entry.name and entry.name .. "." .. member.name or member.name
  local known, why = known_limit(member, entry, context)
  if given == false or known == false and not given then
    if given == false or not member.asked then self.skipped[#self.skipped + 1] = full end
    return
  end
  if member.asked and not given and not (member.wanted and member.wanted(context, entry)) then return end
  local read = entry.released and function() return released.value(entry, member.name) end or member.value
  local fine, value = pcall(read, entry, context)
  if not fine then
    if checks.is_interrupt(value) then error(value, 0) end
    local row = start_row(self, member.name, entry.name, member.label, member.unit, {})
    row.verdict, row.note = "FAIL", "it cannot be computed: " .. checks.shown(value)
    return
  end
  if not value then
    if not (given and entry.name and list[full]) then return end
    value = { value = 0 / 0, note = "this run has no such value" } -- asked for by its full name
  end
  value.terms = member.terms and member.terms(entry, context)
  with_error(value, error_bar(self.run, entry.name, member.name))
  if not self.several then edges.widen(value, member.edges, entry, self.run) end
  askew.widen(value, member, entry, context)
  doubted.widen(value, member, self.run)
  local function fresh() return start_row(self, member.name, entry.name, member.label, member.unit, value) end
  value.doubt = value.doubt or doubted.why(member, value, entry, self.run)
  if given then
    local reference = member.reference and member.reference(entry, context)
    judge_given(given, known or nil, reference, fresh, value, member.unit, member.side)
    if given[member.side] or member.asked and not known then return end
  end -- a limit on the other side alone does not replace the check's own
  if known == false then return end
  if not known then
    local row = fresh()
    missing_row(self, row, member, entry)
    return add_note(row, why)
  end
  close_row(fresh(), value, known, member.side, false)
end

local function judge_own(self, one)
  local value, why = own.value(one, self.run, self.scene)
  if not value then
    local row = start_row(self, one.name, nil, one.name, one.unit, {})
    row.verdict, row.note = "FAIL", why
    return
  end
  with_error(value, error_bar(self.run, nil, one.name))
  value.doubt = value.doubt or one.doubted ~= false and doubted.why(doubted.OWN, value, {}, self.run) or nil
  local function fresh() return start_row(self, one.name, nil, one.name, one.unit, value) end
  local given = {}
  for _, side in ipairs{ "min", "max" } do
    given[side] = one[side] and { value = one[side], from = "user", source = one.source or "the script",
      sure = one.sure } or nil
  end
  if next(given) then return judge_given(given, nil, nil, fresh, value, one.unit) end
  local row = fresh()
  row.verdict = value.value ~= value.value and "FAIL" or "OPEN"
  add_note(row, "limit is missing: give max or min")
end

-- --- the whole -------------------------------------------------------------------------------------

local function refuse(self, why)
  self.rows = { { name = "run", what = "the run", unit = "-", verdict = "FAIL", note = why } }
  self.verdict, self.reason, self.no_numbers = "FAIL", why, true
end

-- Returns why the run has no usable numbers, or nil.
local function unfit(run)
  if not run.ok then
    return ("the run FAILED %s%s"):format(run.reason, run.advice and (" (%s)"):format(run.advice) or "")
  end
  local cut = sealed.fields(run).cut
  return cut and ("the run was cut short: %s%s"):format(run.reason,
    cut == "unfinished" and ", and a process has not ended" or "") or nil
end

local function conclude(self)
  local count = { PASS = 0, FAIL = 0, OPEN = 0 }
  for _, row in ipairs(self.rows) do count[row.verdict] = count[row.verdict] + 1 end
  self.verdict = count.FAIL > 0 and "FAIL" or (count.OPEN > 0 or #self.rows == 0) and "OPEN" or "PASS"
  self.reason = ("%d of %d %s, %d %s, %d %s"):format(count.PASS, #self.rows,
    (#self.rows == 1 and "row " or "rows ") .. (count.PASS == 1 and "passes" or "pass"),
    count.FAIL, count.FAIL == 1 and "fails" or "fail", count.OPEN,
    count.OPEN == 1 and "is open" or "are open")
end

local function check_there(run)
  local fields = sealed.fields(run)
  local data = build.data(run.scene)
  if data.restores ~= fields.restores then
    error(("run:check: the results of the run of '%s' were lost when a snapshot was restored; check it "
      .. "before you restore"):format(run.name), 0)
  end
  if fields.number ~= data.runs or run.scene.time ~= run.time then
    error(("run:check: scene '%s' has gone on since this run, and peaks are those of the later motion; check "
      .. "a run before the next run, and before scene:settle"):format(run.name), 0)
  end
end

local function read(run, args)
  args = call:read(args == nil and {} or args)
  wanted.read(args)
  local context = context_of(run, args)
  local wire = args.landing and args.landing.wire
  if wire then
    local names = {}
    for _, w in ipairs(context.wires) do names[w.name] = true end
    checks.word("run:check: landing.wire", wire, names, 0)
  end
  return args, context
end

-- several: true for a level of error bars, whose changes from level to level tell more.
local function make(run, args, several)
  if not run.ok then args = call:read(args == nil and {} or args) end
  local self = { run = run, scene = run.scene, name = run.name, start = run.start, time = run.time, rows = {},
    skipped = {}, missing = {}, made = {}, several = several, trial = type(args) == "table" and args.trial }
  local why = unfit(run)
  if why then
    refuse(self, why)
    return self
  end
  check_there(run)
  local context
  args, context = read(run, args)
  local list = limits.read(args.limits, context)
  local own_list = own.read(args.checks, limits.names(context))
  for _, member in ipairs(registry.list) do
    for _, entry in ipairs(context.objects[member.on]) do
      if not entry.changed then judge_one(self, member, entry, context, list) end
    end
  end
  unjudged.add(self, context, list, #own_list == 0, function(...) return start_row(self, ...) end)
  for _, one in ipairs(own_list) do
    judge_own(self, one)
    check_there(run)
  end
  self.use = args.use
  conclude(self)
  return self
end

--- Raises an error for wrong arguments of a check, before the run.
function check.early(scene, args)
  local own_args, context = read({ scene = scene }, args)
  limits.read(own_args.limits, context)
  own.read(own_args.checks, limits.names(context))
end

--- Returns the rows of a run that is one of several.
function check.rows(run, args) return make(run, args, true).rows end

--- run:check{ use =, limits =, checks =, landing =, trial = }: see help "run:check".
function check.check(run, args)
  local given = sealed.fields(run).checked
  if args == nil then args = given end
  local self = build.call(3, make, run, args)
  if not self.trial then unread.judged(self.verdict, limits.alike(given, args) and run or nil) end
  self.run, self.scene, self.made, self.ok = nil, nil, nil, self.verdict == "PASS"
  self.source = run
  return writing.new(self)
end

return check
