-- SPDX-License-Identifier: GPL-3.0-or-later
--- Going back in a live view: to a state that was kept, or to just before something was taken away. A
-- snapshot brings back the scene, but no Lua function that has gone on since. Where a process has, a scene
-- that forms put together is built anew and run again up to there, which gives the same bits; the scene of a
-- script cannot be.
--
-- A state: { time =, snapshot = or nil, inside = a run is under way, processes = how far they were,
-- what = what was taken away just after, lines =, runs =, shown = those that held then }. The lists are its
-- own: when it is gone back to, others may have come in their place.
-- @module softworld.view.returning
local build = require "softworld.scene.build"
local process = require "softworld.run.process"
local record = require "softworld.scene.record"

local returning = {}

local MOST_SNAPSHOTS = 20
local MOST_WAYS_BACK = 20 -- states from before something was taken away

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

--- Keep the scene as it is, to be gone back to.
function returning.keep(own)
  own.count = own.count + 1
  local state = state_of(own)
  if not state.snapshot then error("the scene cannot be kept as it is now", 0) end
  state.id = own.count
  own.snapshots[#own.snapshots + 1] = state
  if #own.snapshots > MOST_SNAPSHOTS then table.remove(own.snapshots, 2) end -- the first one stays
end

--- The state before something is taken away, to which undoing goes back; snapshots of the oldest ones are
-- forgotten.
function returning.before(own, what)
  local state, ways = state_of(own, what), own.ways
  ways[#ways + 1] = state
  if #ways > MOST_WAYS_BACK then table.remove(ways, 1).snapshot = nil end
  return state
end

-- --- ways ----------------------------------------------------------------------------------------------

--- How it can be gone back to a state: "same": processes are where they were; "again": by running again;
-- "ended": all processes have ended, and stay so; or nil, and why not.
function returning.how(own, state)
  if state.snapshot and process.is_at(own.scene, state.processes) then return "same" end
  if own.draft and not own.unsaved then return "again" end
  if state.snapshot and next(process.mark(own.scene)) == nil then return "ended" end
  return nil, state.snapshot and "a process has gone on since, and a Lua function has no way back"
    or "too much was removed since; this state is no longer kept"
end

-- The runs that a script has to do after it: one that was left early ends there.
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

-- What was done since has not been done any more, and what was undone since has; where going back was given
-- up early, as far as it came.
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

-- Without their snapshots, which are of a scene that is no more.
local function without_snapshots(list)
  for _, state in ipairs(list) do state.snapshot = nil end
  return list
end

-- It is done when no run is under way, see returning.begin. ask: who is told when it is.
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

--- Go back; returns words of what was done, or nil where that is still to be done: it is then answered.
function returning.go(own, state, ask)
  local how, why = returning.how(own, state)
  if not how then error(why, 0) end
  if how == "again" then return want(own, state, ask) end
  return restore(own, state, how)
end

-- --- running again ---------------------------------------------------------------------------------------

--- The scene has been built anew: from now on it is run up to the state that was asked for, by its own lines.
function returning.begin(own)
  local r = own.wants_again
  own.wants_again, own.again = nil, r
  own.shown, own.snapshots, own.serial, own.count, own.paused = r.shown, r.snapshots, r.serial, r.count, false
  return r
end

--- Run a line by hand.
function returning.line(own, text)
  local chunk = assert(load(text, "=by hand", "t", own.names))
  record.quietly(chunk) -- it is in the lines
  local made = text:match "^made%[(%d+)%] = "
  if made then own.made_text[math.tointeger(made)] = text end
end

--- Is something to be done now, or the end reached? "stop": the run was ended here.
function returning.due(own)
  local r = own.again
  local line = r.lines[r.next]
  if not line then
    return r.state.inside and #own.runs == #r.state.runs and own.scene.time >= r.state.time
  end
  if own.scene.time < line.time then return false end
  return line.text and true or "stop"
end

--- The lines of this time. Returns true at the end, where the view goes on as before.
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

--- The run was ended by hand here.
function returning.stopped(own)
  local r = own.again
  own.lines[#own.lines + 1], r.next = r.lines[r.next], r.next + 1
end

--- It is there; or was given up, why. Returns who is to be told, and words.
function returning.finish(own, why)
  local r = own.again
  own.again, own.paused = nil, own.paused or r.paused
  local words = why or words_of(r.state) .. ", by running again up to there"
  tell(own, r.state, words)
  return r.ask, words
end

return returning
