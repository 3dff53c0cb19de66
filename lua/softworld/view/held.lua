-- SPDX-License-Identifier: GPL-3.0-or-later
--- Holds a run for a view: it is paused, slowed down, changed and stopped from the page, between two steps.
-- @module softworld.view.held
local core = require "softworld.core"
local returning = require "softworld.view.returning"
local sealed = require "softworld.sealed"
local show = require "softworld.view.show"
local work = require "softworld.view.work"

--- gap: time between two looks, idle: longest wait for a message, on the clock [s].
local held = { gap = 1 / 30, idle = 0.1 }

-- Returns how long to hold the run at this moment [s].
local function holding(own)
  if own.stopped then return 0 end
  if own.paused then
    if own.steps > 0 then return 0 end
    return held.idle
  end
  if not own.speed then return 0 end
  local clock = core.clock()
  own.base = own.base or { time = own.scene.time, clock = clock }
  local ahead = (own.scene.time - own.base.time) / own.speed - (clock - own.base.clock)
  if ahead < -0.5 then own.base = nil end -- it cannot keep up: do not catch up later
  return math.max(0, ahead)
end

--- Shows the scene and listens as long as the run is held. Returns true if a change is waiting.
function held.hold(own)
  while true do
    work.hear(own)
    if #own.queue > 0 then return true end
    local left = holding(own)
    own.holds = left > 0 and own.paused
    show.all(own)
    if left <= 0 then
      own.steps = math.max(0, own.steps - 1)
      return false
    end
    own.server:wait(math.min(left, held.idle))
  end
end

local function end_run(own)
  own.lines[#own.lines + 1] = { time = own.scene.time }
  own.lines_due, own.stopped = true, nil
  return "stopped from the page"
end

-- Between two steps: makes changes as long as there are some, and holds the run.
local function change(own, observer)
  repeat work.inside(own) until own.wants_again or not held.hold(own)
  if own.wants_again then
    sealed.fields(observer).reason = "gone back from the page"
  elseif own.stopped then
    sealed.fields(observer).reason = end_run(own)
  end
end

--- Called when going back to a state has ended; why: the reason if it failed, or nil.
function held.told_again(own, why)
  local ask, words = returning.finish(own, why)
  show.answer(own, ask, not why, words)
end

-- Looks at a run that is repeated up to a time, without waiting for anything.
local function look_again(own, observer)
  sealed.fields(observer).each = true
  if core.clock() >= own.again.looked then
    own.again.looked = core.clock() + held.gap
    work.hear(own)
    show.all(own)
  end
  local due = returning.due(own)
  if own.stopped then
    held.told_again(own, "going back was stopped")
    observer:stop(end_run(own))
  elseif due == "stop" then
    returning.stopped(own)
    observer:stop "stopped from the page"
  elseif due then
    observer:change(function()
      if not returning.lines(own) then return end
      held.told_again(own)
      change(own, observer)
    end)
  end
end

--- Called between two steps: does what pages ask for, and stops the run if they ask for it.
function held.look(own, observer)
  if own.again then return look_again(own, observer) end
  if own.wants_again then return observer:stop "gone back from the page" end
  local changes = held.hold(own)
  local o = sealed.fields(observer)
  if own.stopped and not changes then observer:stop(end_run(own)) end
  if changes then observer:change(function() change(own, observer) end) end
  -- look after each step while it is held or slow
  o.every = own.speed and own.speed * held.gap or nil
  o.each = own.paused or nil
end

return held
