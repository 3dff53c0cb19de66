-- SPDX-License-Identifier: GPL-3.0-or-later
--- Processes that wait for a condition without a timeout: since when, and at which line. A run
-- that only they could end tells of them where that takes long.
-- @module softworld.run.waiting
local core = require "softworld.core"
local build = require "softworld.scene.build"

local waiting = {}

local waits = setmetatable({}, { __mode = "k" }) -- process -> { since =, where =, ... }
local FIRST = 10 -- first told of after so much simulated time, then after ten times as much [s]
local PATIENCE = 10 -- and on the terminal after so much real time, then after twice as much [s]

local library = debug.getinfo(1, "S").source:match "^(.*)run/waiting%.lua$" or "@softworld/"

-- The line of the user's script that called the library.
local function place()
  for level = 3, 50 do
    local info = debug.getinfo(level, "Sl")
    if not info then break end
    if info.currentline > 0 and info.source:sub(1, #library) ~= library then
      return (" at %s:%d"):format(info.short_src, info.currentline)
    end
  end
  return ""
end

local function alive(scene)
  local list = {}
  for _, p in ipairs(build.data(scene).processes) do
    if coroutine.status(p.thread) ~= "dead" then list[#list + 1] = p end
  end
  return list
end

--- The process goes on waiting. impossible: function that says why the condition cannot come true
-- without another process, or nil.
function waiting.goes_on(p, impossible)
  if not waits[p] then
    waits[p] = { since = p.scene.time, where = place(), told = FIRST, patience = PATIENCE }
  end
  local why = impossible and #alive(p.scene) == 1 and impossible()
  if why then
    waits[p] = nil
    error(("p:wait_until: this never comes true: %s; give a timeout [s], or let another process make it "
      .. "true"):format(why), 3)
  end
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

--- In a run that only processes end, all of which wait: a word now and then. bar: the run's.
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

--- A run ends while processes wait: say so.
function waiting.at_end(scene)
  for _, p in ipairs(alive(scene)) do
    if waits[p] then tell(p, waits[p]) end
  end
end

return waiting
