-- SPDX-License-Identifier: GPL-3.0-or-later
--- The turns of processes: each goes on when its time has come, one after the other. Their errors get the
-- place of the script's line.
-- @module softworld.run.turns
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local place = require "softworld.place"
local process = require "softworld.run.process"

local turns = {}

-- Returns the line of the user's script at which a process failed inside the library,
-- "file:line: "; "" if the script's own code failed, whose errors stay as they are.
local function place_in(thread)
  local inside = false
  for level = 0, 50 do
    local info = debug.getinfo(thread, level, "Sl")
    if not info then break end
    if info.currentline > 0 then
      if not place.is_ours(info.source) then
        return inside and ("%s:%d: "):format(info.short_src, info.currentline) or ""
      end
      inside = true
    end
  end
  return ""
end

-- Returns the line of the user's script at which a process has yielded by itself.
local function place_of_yield(thread)
  local info = debug.getinfo(thread, 1, "Sl")
  return info and info.currentline > 0 and ("%s:%d: "):format(info.short_src, info.currentline) or ""
end

-- Raises an error if a process has ended before it had all the steps in the file.
local function check_end(self)
  local done, data = process.done(self), build.data(self.scene)
  if self.steps < #done then
    error(("%s has ended without step '%s' of the file '%s'; a script that goes on from a file must have the "
      .. "same steps"):format(tostring(self), tostring(done[self.steps + 1].name),
      tostring(data.from_file)), 0)
  end
  data.ended = data.ended or {}
  data.ended[self.number] = true
end

-- True if the process failed because something it uses was removed from outside of processes, for example by
-- hand. The process ends, and an event says so.
local function is_bereft(self, message)
  local why = build.data(self.scene).bereft and type(message) == "string"
    and message:match "[^\n]* was taken away[^\n]*"
  if not why then return false end
  self.scene:tell{ kind = "removed", text = ("process %d ends: %s"):format(self.number, why) }
  return true
end

local function resume(self)
  self.wake, self.watching, self.asks, self.begun, self.between = nil, nil, nil, true, nil
  self.moves = self.moves + 1
  local ok, message = process.resume(self)
  if not ok and is_bereft(self, message) then return end
  if not ok then
    self.failed, self.traceback = true, debug.traceback(self.thread)
    if type(message) == "string" and not message:find "^[^\n:]+:%d+: " then
      message = place_in(self.thread) .. message
    end
    error(message, 0)
  end
  if coroutine.status(self.thread) == "dead" then check_end(self)
  elseif message ~= nil then -- the library yields nothing
    error(("%scoroutine.yield does not wait for %s: the process goes on after the next step; wait by "
      .. "p:wait(seconds)"):format(place_of_yield(self.thread), checks.got(message)), 0)
  end
  if not self.wake then self.watching, self.wake = true, math.huge end -- a plain yield
end

local DUE, STEPS, AGAIN = 1, 2, 3 -- which processes have a turn
local MOST = 100 -- turns at one time that processes may give each other by conditions

-- made: how often a process has gone on at this time, see go_on.
local function is_due(p, which, made)
  if coroutine.status(p.thread) ~= "suspended" then return false end
  if which == STEPS then return p.between or not p.begun end
  if which == AGAIN then return p.asks and p.asked < made end
  return not p.wake or p.watching or process.reached(p.scene, p.wake)
end

-- Continues the processes whose time has come. which: DUE; STEPS: those that have just ended a step; AGAIN:
-- those that wait for a condition and were asked before another process went on. They would else go on a step
-- late, or not, by the order in which the processes were made. turn.made: how often a process has gone on,
-- other than to find its condition still false.
local function go_on(data, which, turn)
  local alive, between, inside = {}, false, false
  for _, p in ipairs(data.processes) do
    if is_due(p, which, turn.made) then
      resume(p)
      if p.asks ~= "again" then turn.made = turn.made + 1 end
      p.asked = turn.made
    end
    if coroutine.status(p.thread) == "suspended" then
      alive[#alive + 1] = p
      between = between or p.between or false
      inside = inside or not p.between
    end
  end
  data.processes = alive
  return between, inside
end

local function is_any_due(data, which, made)
  for _, p in ipairs(data.processes) do
    if is_due(p, which, made) then return true end
  end
  return false
end

-- Forgets processes that another one has finished meanwhile. Returns the next wake-up
-- time [s] and whether one of the others watches a condition.
local function forget_dead(scene, data)
  local alive, wake, watching = {}, math.huge, false
  for _, p in ipairs(data.processes) do
    if coroutine.status(p.thread) == "suspended" then
      alive[#alive + 1] = p
      wake, watching = math.min(wake, p.wake or scene.time), watching or p.watching or false
    end
  end
  data.processes = alive
  return wake, watching
end

--- Continues every process whose time has come. Returns the number of living
-- processes, the next wake-up time [s] and whether one watches a condition.
function turns.step(scene)
  local data, turn = build.data(scene), { made = 0 }
  for _, p in ipairs(data.processes) do p.asked = 0 end
  local between, inside = go_on(data, DUE, turn)
  for _ = 1, MOST do
    while between do
      if data.saving and not inside then data.saving() end
      between, inside = go_on(data, STEPS, turn)
    end
    if not is_any_due(data, AGAIN, turn.made) then break end
    between, inside = go_on(data, AGAIN, turn)
  end
  local wake, watching = forget_dead(scene, data)
  return #data.processes, wake, watching
end

--- Called after a file was read: processes that had ended without steps do not start again.
function turns.take_up(scene)
  local data = build.data(scene)
  for _, p in ipairs(data.processes) do
    if data.ended and data.ended[p.number] and #process.done(p) == 0 then p:finish() end
  end
end

--- Called before a run: raises an error if a process with steps in the file is missing.
function turns.check_steps(scene)
  local data = build.data(scene)
  turns.take_up(scene)
  for number, done in pairs(data.done or {}) do
    if #done > 0 and number > (data.process_count or 0) then
      error(("scene:run: the file '%s' has process %d with step '%s', and this script has no such process; "
        .. "make all processes before the run that goes on from the file"):format(tostring(data.from_file),
        number,
        tostring(done[1].name)), 0)
    end
  end
end

return turns
