-- SPDX-License-Identifier: GPL-3.0-or-later
--- Does what pages of a live view ask for: orders are heard, checked, and done by their lines, which are
-- stored. `own` holds the fields of a view, see softworld.view.view.
-- @module softworld.view.work
local core = require "softworld.core"
local build = require "softworld.scene.build"
local draft = require "softworld.view.draft"
local leaving = require "softworld.view.leaving"
local jsonread = require "softworld.output.jsonread"
local orders = require "softworld.view.orders"
local returning = require "softworld.view.returning"
local show = require "softworld.view.show"

local work = {}

local MOST_LINES = 5000   -- most stored changes
local TOO_MANY = ("more than %d changes were made by hand"):format(MOST_LINES)

-- --- what they ask for ---------------------------------------------------------------------------

-- Returns what a hand moves by the line, or nil. Successive moves of the same object are shown as one line.
local function led(text)
  return text:find "^hand:set" and "hand" or text:match '^(scene:find%b()):move { .* law = "linear" }$'
end

local function note(own, line)
  own.lines_due, own.forms_due = true, true
  local last = own.shown[#own.shown]
  local again = last and line.ok and last.ok and led(line.text) ~= nil and led(line.text) == led(last.text)
  if again then
    last.text, last.time, last.count = line.text, line.time, last.count + 1
  else
    line.count = 1
    own.shown[#own.shown + 1] = line
    if #own.shown > MOST_LINES then table.remove(own.shown, 1) end
  end
end

local function do_line(own, text, inverse, before)
  local time = own.scene.time
  local fine, message = pcall(returning.line, own, text) -- the shown line is what is run
  if not fine and draft.is_interrupt(message) then error(message, 0) end
  if not fine then message = build.plain(message):gsub("^by hand:%d+: ", "") end
  if fine then
    own.changes = own.changes + 1
    if #own.lines < MOST_LINES then
      own.lines[#own.lines + 1] = { time = time, text = text }
    else
      own.unsaved = TOO_MANY
    end
  end
  note(own, { time = time, text = text, ok = fine, error = not fine and message or nil,
    undo = fine and inverse and inverse() or nil, before = fine and before or nil })
  return fine, message
end

--- Shows that an order was refused, and why.
function work.refused(own, message)
  own.lines_due = true
  own.shown[#own.shown + 1] = { time = own.scene.time, text = "", ok = false, error = build.plain(message),
    count = 1 }
  if #own.shown > MOST_LINES then table.remove(own.shown, 1) end
end

local function touched(own, object, words)
  -- not by pcall itself: the call would be taken for one of a script, which gets a remark between runs
  pcall(function() own.scene:tell{ kind = "hand", object = object, text = words } end)
end

local function back(own, m)
  for _, s in ipairs(own.snapshots) do
    if s.id == m.id then
      local words = returning.go(own, s, m.ask)
      if words then show.answer(own, m.ask, true, words) end
      return
    end
  end
end

-- Returns how a line can be undone: "back" to the state before, or by a "line"; or nil, and why not.
local function how_undone(own, line)
  local way, why
  if line.before then way, why = returning.how(own, line.before) end
  if way then return "back" end
  if line.undo then return "line" end
  return nil, why and ("%s was removed: %s"):format(line.before.what, why)
end

-- Returns the last line that can be undone, and how; or nil, and why the last change cannot be undone.
local function last_done(own)
  local why
  for i = #own.shown, 1, -1 do
    local line = own.shown[i]
    if line.ok and not line.undone and (line.before or line.undo) then
      local how, reason = how_undone(own, line)
      if how then return line, how end
      why = why or reason
    end
  end
  return nil, nil, why
end

local function undo(own, m)
  local line, how = last_done(own)
  if not line then return end
  line.undone = true
  if how == "back" then
    local words = returning.go(own, line.before, m.ask)
    if words then show.answer(own, m.ask, true, words) end
    return
  end
  local fine, message = do_line(own, line.undo)
  local words = line.before and ("%s is made again as it was, and the run goes on: a process has gone on "
    .. "since and cannot go back"):format(line.before.what) or "undone: " .. line.text
  show.answer(own, m.ask, fine, fine and words or build.plain(message))
end

-- Forgets the hand if the wire it pulled is gone.
local function let_gone(own)
  if own.names.hand and not own.names.hand.held then
    own.names.hand, own.hand, own.pulled = nil, nil, nil
  end
end

local function told(own, m)
  if m["do"] == "pull" then
    own.pulled = m.wire
    touched(own, m.wire, ("wire '%s' is pulled by hand at s = %.4g m"):format(m.wire, m.s))
  elseif m["do"] == "let" then
    touched(own, own.pulled, ("wire '%s' is let go by hand"):format(tostring(own.pulled)))
    own.names.hand, own.pulled = nil, nil
  elseif m["do"] == "lead" and own.led ~= m.gripper then
    own.led = m.gripper
    touched(own, m.gripper, ("gripper '%s' is led by hand"):format(m.gripper))
  elseif m["do"] == "leave" then
    own.led = nil
    touched(own, m.gripper, ("gripper '%s' is let go by hand"):format(m.gripper))
  elseif m["do"] == "remove" then
    let_gone(own)
  end
end

-- Does an order that does not go back: makes its line, runs it, and reports it.
local function obey(own, m)
  if m["do"] == "pull" and own.names.hand then do_line(own, "hand:release()") end
  local fine, text, inverse = pcall(orders.line, own.scene, m, own.functions)
  local done, message, before = fine, text, nil
  if fine and m["do"] == "remove" then
    own.serial = own.serial + 1
    local again = m.made and own.made_text[m.made] or leaving.again(own.scene, m, own.serial)
    again = again and again:gsub("^made%[%d+%]", ("made[%d]"):format(own.serial))
    inverse, before = again and function() return again end, returning.before(own, leaving.name(own.scene, m))
  end
  if fine then done, message = do_line(own, text, inverse, before) end
  show.answer(own, m.ask, done, not done and build.plain(message) or nil)
  if not fine then
    work.refused(own, text)
  elseif done then
    told(own, m)
  end
end

--- Does the queued orders that change the scene, one after the other. Call it only while changes are allowed.
function work.all(own)
  local queue = own.queue
  own.queue = {}
  for _, m in ipairs(queue) do
    if m["do"] == "undo" then undo(own, m)
    elseif m["do"] == "back" then back(own, m)
    elseif m["do"] ~= "reach" and m["do"] ~= "let" or own.names.hand then obey(own, m) end
  end
end

--- Same during a run. The place where the run was left is stored too, because it affects rounding.
function work.inside(own)
  work.all(own)
  local last = own.lines[#own.lines]
  if last and last.time == own.scene.time then return end
  if #own.lines >= MOST_LINES then
    own.unsaved = TOO_MANY
    return
  end
  own.lines[#own.lines + 1] = { time = own.scene.time, text = "" }
  own.lines_due = true
end

-- --- a scene that forms put together ------------------------------------------------------------

-- Shows another scene in place of the old one.
local function replace(own, scene)
  local old = own.scene
  own.attach(own, scene)
  if old ~= scene and core.exists(old) then pcall(old.close, old) end
end

local function of_draft(own, m, f)
  local fine, message = false, "this scene was made by a script; on the page it can only be changed by hand "
    .. "during a run"
  if own.draft and own.running then message = "a run is under way: end it, or wait for its end" end
  if own.draft and not own.running then fine, message = pcall(f, own, m) end
  if not fine and draft.is_interrupt(message) then error(message, 0) end
  show.answer(own, m.ask, fine, message and build.plain(message):gsub("^[^\n:]+%.lua:%d+: ", "") or nil)
end

local function change_draft(own, m)
  local scene, words = own.draft:change(m)
  replace(own, scene)
  return words
end

--- Goes back to the start of what forms have put together.
function work.again(own) replace(own, own.draft:build()) end

-- Asks for a run; the answer comes when it has ended, or could not begin.
local function start(own, m)
  own.wants_start = { args = own.draft:set_run(m.values), ask = m.ask }
  m.ask = nil
end

local now = {} -- orders done at once: they change nothing in the scene

function now.pause(own) own.paused, own.steps = true, 0 end
function now.go(own) own.paused, own.base = false, nil end
-- Several steps may be asked for before the first is made.
function now.step(own) own.paused, own.steps = true, own.paused and own.steps + 1 or 1 end
function now.keep(own) returning.keep(own) end
function now.stop(own) own.stopped = true end
function now.run(own, m)
  if type(m.duration) == "number" and m.duration > 0 and m.duration <= 1e6 then own.wants_run = m.duration end
end
function now.draft(own, m) of_draft(own, m, change_draft) end
function now.again(own, m) of_draft(own, m, work.again) end
function now.start(own, m) of_draft(own, m, start) end
function now.speed(own, m)
  local speed = m.value
  own.speed = type(speed) == "number" and speed > 1e-6 and speed < 1e6 and speed or nil
  own.base = nil
end

-- --- hearing ---------------------------------------------------------------------------------------

--- True if something can be undone at this moment. If not, also returns why, if worth telling.
function work.has_undo(own)
  local line, _, why = last_done(own)
  return line ~= nil, why
end

local function refuse(own, m, words)
  work.refused(own, words)
  show.answer(own, m.ask, false, build.plain(words))
  return false
end

local function has_way_back(own, m)
  for _, s in ipairs(own.snapshots) do
    if s.id == m.id then
      local how, why = returning.how(own, s)
      return how ~= nil or refuse(own, m, why)
    end
  end
  return false
end

-- True if an order will have an effect. Leaving a run for nothing would change the last bits of its steps.
local function is_good(own, m)
  local word = m["do"]
  if word == "undo" then
    local can, why = work.has_undo(own)
    return can or refuse(own, m, why or "there is nothing to undo")
  end
  if word == "back" then return has_way_back(own, m) end
  if (word == "reach" or word == "let") and not own.hand then return false end
  if word == "add" then
    own.serial = own.serial + 1
    m.serial = own.serial
  end
  if own.draft and not own.running and #own.runs == 0 then
    return refuse(own, m, "nothing runs yet; change the item where it was made")
  end
  if word == "remove" and m.made ~= nil and not own.made_text[m.made] then
    return refuse(own, m, "there is no such force")
  end
  local fine, message = pcall(orders.line, own.scene, m, own.functions)
  if not fine then
    refuse(own, m, message)
  elseif word == "pull" or word == "let" then
    own.hand = word == "pull"
  end
  return fine
end

local MOST_AT_ONCE = 500

--- Takes the orders of pages; those that change the scene wait in the queue.
function work.hear(own)
  for _ = 1, MOST_AT_ONCE do
    local text = own.server:take()
    if not text then return end
    local fine, m = pcall(jsonread.decode, text)
    local word = fine and type(m) == "table" and m["do"]
    if now[word] then
      local done, message = pcall(now[word], own, m)
      if not done and draft.is_interrupt(message) then error(message, 0) end
      if not done then work.refused(own, message) end
    elseif type(word) == "string" and (orders.changes(m) or word == "undo" or word == "back") then
      if is_good(own, m) then own.queue[#own.queue + 1] = m end
    end -- other messages are ignored
  end
end

return work
