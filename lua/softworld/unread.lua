-- SPDX-License-Identifier: GPL-3.0-or-later
--- Keeps track of failed runs, and of events of other runs, that the script has not looked at, and of a
-- script that runs nothing. The host program reports them when the script is over.
-- @module softworld.unread
local counted = require "softworld.output.number".count

local unread = {}

local MOST = 20 -- texts kept and reported at most
local texts, kept, last = {}, 0, 0
local more = 0 -- failures beyond those kept
local MOST_NOTES = 5 -- runs with events reported at most
local function new_notes() return { noted = 0, others = 0 } end
local notes = new_notes() -- a list; .noted: runs with events so far; .others: those beyond the list
local bad = 0  -- runs that failed or were stopped, looked at or not
local function no_verdicts() return { PASS = 0, FAIL = 0, OPEN = 0 } end
local verdicts = no_verdicts() -- of checks
local counting = false

local idle = {} -- { at = place }: scenes with processes that nothing has used yet
local waits = setmetatable({}, { __mode = "k" }) -- by key: its entry

--- A process of a scene was made; key: the scene's data.
function unread.process(key)
  if not idle or waits[key] or #idle >= MOST then return end
  local entry = { at = require "softworld.place".of_caller() }
  idle[#idle + 1], waits[key] = entry, entry
end

--- A scene was computed or saved, so its processes have a use; without key something was shown or studied,
-- and all processes of the script have.
function unread.used(key)
  if not key then idle = nil end
  if not (idle and waits[key]) then return end
  for k, entry in ipairs(idle) do
    if entry == waits[key] then table.remove(idle, k) end
  end
  waits[key] = nil
end

-- Remarks on a script that describes a process and computes nothing: scene:run is forgotten.
local function tell_idle()
  local remarks, host = package.loaded["softworld.remarks"], package.loaded["softworld.host"]
  local typed = type(host) == "table" and host.interactive
  if idle and idle[1] and remarks and remarks.wanted() and not typed then
    remarks.write(idle[1].at or "?", "this process never ran: scene:run{...} computes what it describes")
  end
  idle = nil
end

--- Stores a failure and returns its mark. rest: it is no run but an equilibrium that was not found, which
-- `softworld --check` does not count.
function unread.add(text, rest)
  last, bad = last + 1, bad + (rest and 0 or 1)
  local mark = { number = last }
  if kept < MOST then
    texts[last], kept = text, kept + 1
  else
    more = more + 1
  end
  return mark
end

local quiet = false

--- From now on events need no look. For benches, which compute with coarse edges and steps on purpose.
function unread.quiet() quiet = true end

--- Stores the events of a run that is ok and returns its mark. text: one line; event: the first event.
function unread.note(text, event)
  if quiet then return { seen = true } end
  notes.noted = notes.noted + 1
  local mark = { note = notes.noted, notes = notes }
  if #notes < MOST_NOTES then
    notes[#notes + 1] = { number = notes.noted, text = text, event = event }
  else
    notes.others = notes.others + 1
  end
  return mark
end

local function forget_note(mark)
  local list = mark.notes
  for k, note in ipairs(list) do
    if note.number == mark.note then return table.remove(list, k) end
  end
  list.others = math.max(0, list.others - 1)
end

--- Marks a failure, or the events of a run, as looked at.
function unread.seen(mark)
  if mark.seen then return end
  mark.seen = true
  if mark.note then return forget_note(mark) end
  if texts[mark.number] then
    texts[mark.number], kept = nil, kept - 1
  elseif more > 0 then
    more = more - 1
  end
end

local apart = setmetatable({}, { __mode = "k" }) -- by object: fields that are kept apart, with their marks

--- Keeps fields of an object apart, so that reading them through unread.look counts as a look at the mark.
function unread.hide(object, mark, ...)
  local own = apart[object] or {}
  apart[object] = own
  for _, key in ipairs { ... } do
    if not own[key] then own[key] = { value = rawget(object, key), mark = mark } end
    rawset(object, key, nil)
  end
end

--- For __index: returns true and the value of a field that is kept apart, else false.
function unread.look(object, key)
  local one = apart[object] and apart[object][key]
  if not one then return false end
  unread.seen(one.mark)
  return true, one.value
end

--- Returns a field that may be kept apart, without a look.
function unread.peek(object, key)
  local one = apart[object] and apart[object][key]
  if one then return one.value end
  return rawget(object, key)
end

--- Counts a run that was stopped before its end, or ended with an error.
function unread.cut() bad = bad + 1 end

local given = setmetatable({}, { __mode = "k" }) -- by run: { verdict of its own check, of = the sums }

--- Counts a check of a run with this verdict. run: the check was given to this run; it counts once, however
-- often it is made.
function unread.judged(verdict, run)
  local before = run and given[run]
  if before and before.of == verdicts then verdicts[before.verdict] = verdicts[before.verdict] - 1 end
  if run then given[run] = { of = verdicts, verdict = verdict } end
  verdicts[verdict] = verdicts[verdict] + 1
end

--- Is the script run by `softworld --check`? Checks that are given to runs are then made without being asked
-- for.
function unread.counting() return counting end

--- Returns the exit code of `softworld --check` at the end of a script, and a line that explains it.
function unread.exit()
  local made = verdicts.PASS + verdicts.FAIL + verdicts.OPEN
  local text = ("softworld: %s: %d pass, %d fail, %d open"):format(counted(made, "check"), verdicts.PASS,
    verdicts.FAIL, verdicts.OPEN)
  if bad > 0 then text = ("%s; %s failed or %s cut short"):format(text, counted(bad, "run"),
    bad == 1 and "was" or "were") end
  if verdicts.FAIL > 0 or bad > 0 then return 3, text end
  if verdicts.OPEN > 0 then return 4, text end
  if made == 0 then return 2, "softworld: no check was made; run:check{} makes one" end
  return 0, text
end

--- For `softworld --check`: makes os.exit leave with the exit code of the checks, unless the script itself
-- leaves with a failure.
function unread.guard_exit()
  counting = true
  local leave = os.exit
  function os.exit(code, close) -- luacheck: ignore 122
    local status, text = unread.exit()
    io.stderr:write(text, "\n")
    local fails = code == false or math.type(code) == "integer" and code ~= 0
    leave(fails and code or status, close)
  end
end

--- Calls f and returns its results. Runs and checks within it do not count for `softworld --check`.
function unread.uncounted(f, ...)
  local bad_before, verdicts_before = bad, verdicts
  verdicts = no_verdicts()
  local _ <close> = setmetatable({}, { __close = function() bad, verdicts = bad_before, verdicts_before end })
  return f(...)
end

-- Calls f and returns its results, behind the first event of its runs if wanted.
local function within(wanted, f, ...)
  local before, more_before, notes_before = last, more, notes
  local own = new_notes()
  notes = own
  local _ <close> = setmetatable({}, { __close = function() notes = notes_before end })
  local function done(...)
    for number in pairs(texts) do
      if number > before then texts[number], kept = nil, kept - 1 end
    end
    more = math.min(more, more_before)
    if wanted then return own[1] and own[1].event, ... end
    return ...
  end
  return done(unread.uncounted(f, ...))
end

--- Calls f and returns its results. Failures and events within it need no look, because f judges its runs by
-- other means; checks within it do not count either. A tail call, so that levels of errors count no frame.
function unread.excused(f, ...) return within(false, f, ...) end

--- The same; returns the first event that nobody looked at, or nil, and then the results.
function unread.gathered(f, ...) return within(true, f, ...) end

local function notes_text()
  local lines = {}
  for k, note in ipairs(notes) do lines[k] = note.text end
  if notes.others > 0 then
    lines[#lines + 1] = ("softworld: note: %s with events that the script did not look at"):format(
      counted(notes.others, "more run"))
  end
  notes = new_notes()
  return #lines > 0 and table.concat(lines, "\n") or nil
end

--- Returns the reports at the end of a script, of failures and of events, each or nil, and forgets them.
function unread.finish()
  tell_idle()
  local numbers, lines = {}, {}
  for number in pairs(texts) do numbers[#numbers + 1] = number end
  table.sort(numbers)
  for i, number in ipairs(numbers) do lines[i] = texts[number] end
  if more > 0 then lines[#lines + 1] = ("softworld: and %d more"):format(more) end
  texts, kept, more = {}, 0, 0
  return #lines > 0 and table.concat(lines, "\n") or nil, notes_text()
end

return unread
