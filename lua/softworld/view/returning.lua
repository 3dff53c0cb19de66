-- SPDX-License-Identifier: GPL-3.0-or-later
--- Going back in a live view: to a stored state, or to just before something was removed. A snapshot restores
-- the scene, but no Lua function that has run since. If a process has gone on, a scene made by forms is built
-- again and run up to the state, which gives the same bits; the scene of a script cannot go back then.
--
-- A state: { time =, snapshot = or nil, inside = a run is under way, processes = how far they were, what =
-- what was removed just after, lines =, runs =, shown = those valid at that time }. The lists are copies,
-- because the view's own lists may change before the state is restored.
-- @module softworld.view.returning
local build = require "softworld.scene.build"
local process = require "softworld.run.process"
local record = require "softworld.scene.record"

local returning = {}

local MOST_SNAPSHOTS = 20
local MOST_WAYS_BACK = 20 -- most states from before something was removed

-- --- states ------------------------------------------------------------------------------------------

local function copy_of(list) return table.move(list, 1, #list, 1, {}) end

local function state_of(own, what)
  local fine, snapshot = pcall(own.scene.snapshot, own.scene)
  local shown = {}
  for _, line in ipairs(own.shown) do shown[#shown + 1] = not line.undone and line or nil end
  return { time = own.scene.time, snapshot = fine and snapshot or nil, inside = own.running,
    processes = process.mark(own.scene), what = what, lines = copy_of(own.lines), runs = copy_of(own.runs),
    shown = shown }
end

--- Stores the present state of the scene.
function returning.keep(own)
  own.count = own.count + 1
  local state = state_of(own)
  if not state.snapshot then error("the scene cannot be kept as it is now", 0) end
  state.id = own.count
  own.snapshots[#own.snapshots + 1] = state
  if #own.snapshots > MOST_SNAPSHOTS then table.remove(own.snapshots, 2) end -- the first one stays
end

--- Returns the state before something is removed, to which undoing goes back. The snapshots of the oldest
-- such states are dropped.
function returning.before(own, what)
  local state, ways = state_of(own, what), own.ways
  ways[#ways + 1] = state
  if #ways > MOST_WAYS_BACK then table.remove(ways, 1).snapshot = nil end
  return state
end

-- --- ways ----------------------------------------------------------------------------------------------

--- Returns how the scene can go back to a state: "same": processes are where they were; "again": by running
-- again; "ended": all processes have ended, and stay so; or nil, and why not.
function returning.how(own, state)
  if state.snapshot and process.is_at(own.scene, state.processes) then return "same" end
  if own.draft and not own.unsaved then return "again" end
  if state.snapshot and next(process.mark(own.scene)) == nil then return "ended" end
  return nil, state.snapshot and "a process has gone on since, and a Lua function has no way back"
    or "too much was removed since; this state is no longer kept"
end

-- Restores the runs that a script must repeat; a run that was left early ends there.
local function back_in_runs(own, state)
  local count = #own.runs
  if own.running and (count ~= #state.runs or own.runs[count] ~= state.runs[count]) then
    own.unsaved = "the page went back to another run during a run"
  elseif not own.running then
    own.ended, own.runs = nil, copy_of(state.runs)
    if state.inside then own.lines[#own.lines + 1] = { time = state.time } end
  end
end

local function words_of(state)
  return ("back to t = %.4g s%s"):format(state.time,
    state.what and (", before %s was removed"):format(state.what) or "")
end

-- Marks which changes hold: those made since the state are undone, those undone since are valid again. If
-- going back was given up early, only up to the time reached.
local function tell(own, state, words)
  for _, line in ipairs(own.shown) do line.undone = true end
  local time = own.scene.time
  for _, line in ipairs(state.shown) do line.undone = time < state.time and line.time > time or nil end
  own.names.hand, own.hand, own.pulled = nil, nil, nil
  own.shown[#own.shown + 1] = { time = state.time, text = "-- " .. words, ok = true, count = 1 }
  own.changes, own.lines_due, own.forms_due, own.base = own.changes + 1, true, true, nil
end

local function restore(own, state, how)
  build.back(own.scene, state.snapshot, how == "same")
  own.lines = copy_of(state.lines)
  back_in_runs(own, state)
  local words = words_of(state)
  if how == "ended" and next(state.processes) then words = words .. "; processes have ended and do not start "
    .. "again" end
  tell(own, state, words)
  return words
end

-- Drops the snapshots of states, because their scene does not exist any more.
local function without_snapshots(list)
  for _, state in ipairs(list) do state.snapshot = nil end
  return list
end

-- Asks for running again; it starts when no run is under way, see returning.begin. ask: who gets the answer.
local function want(own, state, ask)
  local r = { state = state, ask = ask, next = 1, lines = state.lines, runs = {}, shown = own.shown,
    paused = own.paused, snapshots = without_snapshots(own.snapshots), serial = own.serial,
    count = own.count, looked = 0 }
  without_snapshots(own.ways)
  for k, given in ipairs(state.runs) do
    local args = {}
    for key, value in pairs(given) do args[key] = value end
    r.runs[k] = args
  end
  own.wants_again = r
end

--- Goes back. Returns words about it, or nil if it must be done later; the answer comes then.
function returning.go(own, state, ask)
  local how, why = returning.how(own, state)
  if not how then error(why, 0) end
  if how == "again" then return want(own, state, ask) end
  return restore(own, state, how)
end

-- --- running again ---------------------------------------------------------------------------------------

--- Called when the scene was built again: from here on it is run up to the wanted state, with its own lines.
function returning.begin(own)
  local r = own.wants_again
  own.wants_again, own.again = nil, r
  own.shown, own.snapshots, own.serial, own.count, own.paused = r.shown, r.snapshots, r.serial, r.count, false
  return r
end

--- Runs a line by hand.
function returning.line(own, text)
  local chunk = assert(load(text, "=by hand", "t", own.names))
  record.quietly(chunk) -- the lines record it
  local made = text:match "^made%[(%d+)%] = "
  if made then own.made_text[math.tointeger(made)] = text end
end

--- True if a line is due, or the end is reached. "stop": the run was ended here.
function returning.due(own)
  local r = own.again
  local line = r.lines[r.next]
  if not line then
    return r.state.inside and #own.runs == #r.state.runs and own.scene.time >= r.state.time
  end
  if own.scene.time < line.time then return false end
  return line.text and true or "stop"
end

--- Runs the lines of this time. Returns true at the end, from where the view goes on as before.
function returning.lines(own)
  local r = own.again
  while returning.due(own) == true do
    local line = r.lines[r.next]
    if not line then return true end
    if line.text ~= "" then returning.line(own, line.text) end
    own.lines[#own.lines + 1], r.next, own.changes = line, r.next + 1, own.changes + 1
  end
  return false
end

--- Called when the repeated run reaches the place where it was ended by hand.
function returning.stopped(own)
  local r = own.again
  own.lines[#own.lines + 1], r.next = r.lines[r.next], r.next + 1
end

--- Ends going back; why: the reason if it was given up, or nil. Returns who gets the answer, and words.
function returning.finish(own, why)
  local r = own.again
  own.again, own.paused = nil, own.paused or r.paused
  local words = why or words_of(r.state) .. ", by running again up to there"
  tell(own, r.state, words)
  return r.ask, words
end

return returning
