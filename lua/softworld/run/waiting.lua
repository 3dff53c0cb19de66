-- SPDX-License-Identifier: GPL-3.0-or-later
--- Processes that wait for a condition without a timeout: since when, and at which line. If only they
-- could end the run, long waits are reported.
-- @module softworld.run.waiting
local core = require "softworld.core"
local build = require "softworld.scene.build"
local place = require "softworld.place"

local waiting = {}

local waits = setmetatable({}, { __mode = "k" }) -- process -> { since =, where =, ... }
local FIRST = 10 -- simulated time before the first event, then ten times as much [s]
local PATIENCE = 10 -- real time before a line on the terminal, then twice as much [s]

local function alive(scene)
  local list = {}
  for _, p in ipairs(build.data(scene).processes) do
    if coroutine.status(p.thread) ~= "dead" then list[#list + 1] = p end
  end
  return list
end

--- Called while the process keeps waiting. impossible: function that says why the condition cannot come true
-- without another process, or nil.
function waiting.goes_on(p, impossible)
  if not waits[p] then
    local at = place.of_caller()
    waits[p] = { since = p.scene.time, where = at and " at " .. at or "", told = FIRST, patience = PATIENCE }
  end
  local why = impossible and #alive(p.scene) == 1 and impossible()
  if why then
    waits[p] = nil
    error(("p:wait_until: this never comes true: %s; give a timeout [s], or let another process make it "
      .. "true"):format(why), 3)
  end
end

--- Called when the time for a condition given as a table has run out: a script may not look at the result.
function waiting.ran_out(p, timeout)
  local at = place.of_caller()
  p.scene:tell{ kind = "timeout", object = ("process %d"):format(p.number), value = timeout,
    text = ("process %d went on%s after %g s: its condition had not come true"):format(p.number,
      at and " at " .. at or "", timeout) }
end

function waiting.ended(p) waits[p] = nil end

local function text_of(p, w, verb)
  return ("process %d %s%s since t = %g s for a condition without a timeout"):format(p.number, verb,
    w.where, w.since)
end

local function tell(p, w)
  p.scene:tell{ kind = "waiting", object = ("process %d"):format(p.number),
    value = p.scene.time - w.since, text = text_of(p, w, "waits") }
end

--- Reports long waits now and then, in a run that only processes can end and in which all wait. bar: the
-- run's.
function waiting.look(scene, bar, quiet)
  for _, p in ipairs(alive(scene)) do
    local w = waits[p]
    if w and scene.time - w.since >= w.told then
      w.told = 10 * w.told
      tell(p, w)
    end
    if w and not quiet then
      local now = core.clock()
      w.began = w.began or now
      if now - w.began >= w.patience then
        w.patience = 2 * w.patience
        bar:clear()
        io.stderr:write(("run of '%s': t = %g s, %s; Ctrl-C ends the run\n"):format(scene.name,
          scene.time, text_of(p, w, "has waited")))
      end
    end
  end
end

--- Called at the end of a run: reports processes that still wait.
function waiting.at_end(scene)
  for _, p in ipairs(alive(scene)) do
    if waits[p] then tell(p, waits[p]) end
  end
end

return waiting
