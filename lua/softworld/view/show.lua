-- SPDX-License-Identifier: GPL-3.0-or-later
--- Sends pages of a live view what they show: the scene, frames, the state of the run, changes made by hand,
-- forms and events, each in a slot of the server that holds only the latest.
-- @module softworld.view.show
local core = require "softworld.core"
local build = require "softworld.scene.build"
local json = require "softworld.output.json"
local leaving = require "softworld.view.leaving"
local orders = require "softworld.view.orders"
local report = require "softworld.output.report"
local returning = require "softworld.view.returning"
local runfiles = require "softworld.run.files"

local show = {}

local SHOWN = 200 -- most changes in a page
local ANSWERS_KEPT = 30
-- Slots of the server.
local FRAME, SCENE, STATE, LINES, FORMS, EVENTS, DRAFT, ANSWERS = 0, 1, 2, 3, 4, 5, 6, 7

local function put(own, slot, value) own.server:put(slot, json.encode(value)) end

-- Returns a text that changes when something was made or removed, or a gripper took hold.
local function signature(scene)
  local data, parts = build.data(scene), {}
  for i, name in ipairs(build.lists) do parts[i] = #data[name] end
  for _, g in ipairs(data.grippers) do
    local last = g.spans[#g.spans]
    parts[#parts + 1] = ("%d %s %s %s"):format(#g.spans, last and last.to or "", g.tool and 1 or 0,
      g.left or "")
  end
  for _, w in ipairs(data.wires) do parts[#parts + 1] = w.object.model end
  for _, gone in ipairs(data.gone or {}) do parts[#parts + 1] = gone.label end
  return table.concat(parts, " ")
end

-- Returns the pull of a hand: three times the weight of all wires, reached over a twentieth of the longest.
local function hand_of(scene)
  local weight, length = 0, 0
  for _, w in ipairs(build.data(scene).wires) do
    local fine, mass = pcall(function() return w.object:section().mass_per_length end)
    if not fine then mass = math.pi * w.object.radius ^ 2 * 1500 end
    weight = weight + 9.81 * mass * w.object.length
    length = math.max(length, w.object.length)
  end
  local force = tonumber(("%.1g"):format(math.max(3 * weight, 1e-3)))
  return { force = force, stiffness = tonumber(("%.2g"):format(force / math.max(0.05 * length, 1e-4))) }
end

local function show_scene(own)
  local now = signature(own.scene)
  if now == own.signature then return end
  own.signature, own.outline = now, own.outline + 1
  local run, blobs = report.outline(runfiles.scene_described(own.scene))
  put(own, SCENE, json.object{ kind = "scene", outline = own.outline, session = own.session, run = run,
    blobs = blobs, hand = hand_of(own.scene) })
  own.forms_due = true
end

local function show_forms(own)
  if not own.forms_due then return end
  own.forms_due = nil
  local fine, forms = pcall(orders.forms, own.scene)
  local there, objects = pcall(leaving.objects, own.scene, own.names.made, own.names.hand)
  put(own, FORMS, { kind = "forms", forms = fine and forms or {}, objects = there and objects or {},
    made = show.made(own) })
end

--- Returns the forces that were added by hand and still exist: { { made = number, text = line } }.
function show.made(own)
  local list = {}
  for number, force in pairs(own.names.made) do
    if core.exists(force) and force.held then
      list[#list + 1] = { made = number, kind = force.kind, text = own.made_text[number] }
    end
  end
  table.sort(list, function(a, b) return a.made < b.made end)
  return list
end

-- Sends what the forms have put together.
local function show_draft(own)
  if not own.draft_due or not own.draft then return end
  own.draft_due = nil
  local shown = own.draft:shown()
  shown.kind = "draft"
  put(own, DRAFT, json.object(shown))
end

local function show_answers(own)
  if not own.answers_due then return end
  own.answers_due = nil
  put(own, ANSWERS, { kind = "answers", answers = own.answers })
end

--- Sends an answer to the page that asked with this mark.
function show.answer(own, mark, ok, text)
  if type(mark) ~= "number" and type(mark) ~= "string" then return end
  own.answers[#own.answers + 1] = { ask = mark, ok = ok, text = text }
  if #own.answers > ANSWERS_KEPT then table.remove(own.answers, 1) end
  own.answers_due = true
end

--- Returns how many processes of the scene have not ended.
function show.alive(scene)
  local count = 0
  for _, p in ipairs(build.data(scene).processes) do
    if coroutine.status(p.thread) ~= "dead" then count = count + 1 end
  end
  return count
end

local function show_state(own)
  local snapshots = {}
  for i, s in ipairs(own.snapshots) do
    snapshots[i] = { id = s.id, time = s.time, back = returning.how(own, s) ~= nil }
  end
  local undo, no_undo = own.has_undo(own)
  local text = json.encode(json.object{ kind = "state", running = own.running, paused = own.paused,
    speed = own.speed, ok = own.ok, reason = own.reason, snapshots = snapshots,
    undo = undo, no_undo = no_undo, check = own.check, again = own.again and own.again.state.time,
    back = show.alive(own.scene) == 0, done = own.done, holds = own.holds, draft = own.draft ~= nil,
    at_start = own.draft ~= nil and not own.running and #own.runs == 0 })
  if text == own.state then return end
  own.state = text
  own.server:put(STATE, text)
end

-- Returns the arguments of the runs that a script must do: of those done, or of the one set in the form.
local function runs_of(own)
  if not own.draft or #own.runs > 0 then return own.runs end
  local meant = own.draft:run()
  return meant and { meant } or {}
end

local function show_lines(own)
  if not own.lines_due then return end
  own.lines_due = nil
  local shown = {}
  for i = math.max(1, #own.shown - SHOWN + 1), #own.shown do
    local line = own.shown[i]
    shown[#shown + 1] = { time = line.time, text = line.text, ok = line.ok, error = line.error,
      count = line.count, undone = line.undone }
  end
  local head = own.draft and own.draft:script() or nil
  put(own, LINES, { kind = "lines", lines = shown, total = #own.lines,
    unsaved = own.unsaved,
    script = not own.unsaved and orders.script(own.scene, own.lines, runs_of(own), head,
      own.draft and own.draft:checks()) or nil })
end

local function show_events(own)
  local events = own.scene:events()
  local last = events[#events]
  local mark = ("%d %s"):format(#events, last and last.count or "")
  if mark == own.events then return end
  own.events = mark
  local list = {}
  for i = math.max(1, #events - 199), #events do
    local e = events[i]
    list[#list + 1] = { kind = e.kind, time = e.time, text = e.text, count = e.count, last = e.last }
  end
  put(own, EVENTS, { kind = "events", events = list })
end

--- Sends what has changed, and the state of the scene to pages that wait for it.
function show.all(own)
  local pages, waiting = own.server:pages()
  if pages == 0 then return end
  show_scene(own)
  show_state(own)
  show_lines(own)
  show_forms(own)
  show_draft(own)
  show_answers(own)
  show_events(own)
  if waiting == 0 then return end
  local mark = ("%d %a %d"):format(own.outline, own.scene.time, own.changes)
  if mark == own.frame then return end
  own.frame = mark
  local fine, film, frames = pcall(core.film_now, own.scene, true)
  if not fine and not own.failed then error(film, 0) end -- a failed run may have no state to show
  if fine and frames > 0 then own.server:put(FRAME, ("<I4I4"):pack(own.outline, own.session) .. film) end
end

return show
