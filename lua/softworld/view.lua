-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:view and `softworld --view`: the player's page, fed while a scene runs. An observer looks 30 times a
-- second, sends the state to pages that wait for it, and takes what they ask for: between two steps.
-- @module softworld.view
local core = require "softworld.core"
local build = require "softworld.build"
local checks = require "softworld.checks"
local json = require "softworld.output.json"
local jsonread = require "softworld.output.jsonread"
local literal = require "softworld.literal"
local methods = require "softworld.methods"
local observe = require "softworld.observe"
local orders = require "softworld.vieworders"
local report = require "softworld.output.report"
local rows = require "softworld.rows"
local runfiles = require "softworld.runfiles"
local sealed = require "softworld.sealed"

local view = {}
local View = { __name = "view" }

local GAP = 1 / 30        -- between two looks, on the clock [s]
local IDLE = 0.1          -- longest wait for a message [s]
local MOST_LINES = 5000   -- changes that are kept
local SHOWN = 200         -- of them in a page
local MOST_SNAPSHOTS = 20
local FRAME, SCENE, STATE, LINES, FORMS, EVENTS = 0, 1, 2, 3, 4, 5 -- slots of the server

local new = rows.call("scene:view", "{...}", "shows the scene in a browser of this machine while it runs", {
  gives = "a view",
  example = "scene:view()",
  { "port", "integer", "-", "of this machine, where the page is", min = 0, max = 65535, usual = "any that is free" },
  { "open", "boolean", "-", "opens a browser; else the address is told only", usual = "true" },
  { "paused", "boolean", "-", "runs begin when the page says so", usual = "false" },
})

rows.calls{
  { "view:wait", "seconds", "shows the scene as it is, and does what pages ask for, until Ctrl-C or so long [s]" },
  { "view:close", "", "pages are told nothing more; the scene stays" },
  { "view.address", nil, "of the page, with its secret; for this machine only", "a text" },
  { "view.pages", nil, "that are open", "a number" },
  { "view.scene", nil, "that it shows", "a scene" },
}

local function fields(self) return sealed.fields(self) end

-- --- what pages see -----------------------------------------------------------------------------------

local function put(own, slot, value) own.server:put(slot, json.encode(value)) end

-- Changes when something was made or taken away, or a gripper took hold.
local function signature(scene)
  local data, parts = build.data(scene), {}
  for i, name in ipairs(build.lists) do parts[i] = #data[name] end
  for _, g in ipairs(data.grippers) do
    local last = g.spans[#g.spans]
    parts[#parts + 1] = ("%d %s %s"):format(#g.spans, last and last.to or "", g.tool and 1 or 0)
  end
  for _, w in ipairs(data.wires) do parts[#parts + 1] = w.object.model end
  return table.concat(parts, " ")
end

-- How hard a hand pulls that takes hold: a few times the weight of all wires, over a tenth of their length.
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
  put(own, SCENE, json.object{ kind = "scene", outline = own.outline, session = own.session, run = run, blobs = blobs,
    hand = hand_of(own.scene) })
  own.forms_due = true
end

local function show_forms(own)
  if not own.forms_due then return end
  own.forms_due = nil
  local fine, forms = pcall(orders.forms, own.scene)
  put(own, FORMS, { kind = "forms", forms = fine and forms or {} })
end

local function alive(scene)
  local count = 0
  for _, p in ipairs(build.data(scene).processes) do
    if coroutine.status(p.thread) ~= "dead" then count = count + 1 end
  end
  return count
end

local function show_state(own)
  local snapshots = {}
  for i, s in ipairs(own.snapshots) do snapshots[i] = { id = s.id, time = s.time } end
  local text = json.encode(json.object{ kind = "state", running = own.running, paused = own.paused, speed = own.speed,
    ok = own.ok, reason = own.reason, snapshots = snapshots, waits = own.waits,
    back = alive(own.scene) == 0, done = own.done, holds = own.holds })
  if text == own.state then return end
  own.state = text
  own.server:put(STATE, text)
end

local function show_lines(own)
  if not own.lines_due then return end
  own.lines_due = nil
  local shown, undo = {}, false
  for i = math.max(1, #own.shown - SHOWN + 1), #own.shown do shown[#shown + 1] = own.shown[i] end
  for _, line in ipairs(own.shown) do undo = undo or line.undo and not line.undone or false end
  local some = #own.lines > 0
  put(own, LINES, { kind = "lines", lines = shown, undo = undo, total = #own.lines,
    script = some and orders.script(own.scene, own.lines, own.args) or nil })
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

-- Send what has changed, and the state of the scene to those who wait for it.
local function show(own)
  local pages, waiting = own.server:pages()
  if pages == 0 then return end
  show_scene(own)
  show_state(own)
  show_lines(own)
  show_forms(own)
  show_events(own)
  if waiting == 0 or own.failed then return end
  local mark = ("%d %a %d"):format(own.outline, own.scene.time, own.changes)
  if mark == own.frame then return end
  own.frame = mark
  local film, frames = core.film_now(own.scene, true)
  if frames > 0 then own.server:put(FRAME, ("<I4I4"):pack(own.outline, own.session) .. film) end
end

-- --- what they ask for ----------------------------------------------------------------------------------

local function note(own, line)
  own.lines_due, own.forms_due = true, true
  local last = own.shown[#own.shown]
  local again = last and line.ok and last.ok and line.text:find "^hand:set" and last.text:find "^hand:set"
  if again then
    last.text, last.time, last.count = line.text, line.time, last.count + 1
  else
    line.count = 1
    own.shown[#own.shown + 1] = line
    if #own.shown > MOST_LINES then table.remove(own.shown, 1) end
  end
end

-- Run the line itself: what is shown is what was done.
local function run_line(own, text)
  local chunk = assert(load(text, "=by hand", "t", own.names))
  chunk()
end

local function do_line(own, text, inverse)
  local time = own.scene.time
  local fine, message = pcall(run_line, own, text)
  if not fine then message = build.plain(message):gsub("^by hand:%d+: ", "") end
  if fine then
    own.changes = own.changes + 1
    if #own.lines < MOST_LINES then own.lines[#own.lines + 1] = { time = time, text = text } end
  end
  note(own, { time = time, text = text, ok = fine, error = not fine and message or nil,
    undo = fine and inverse and inverse() or nil })
  return fine
end

local function refused(own, message)
  own.lines_due = true
  own.shown[#own.shown + 1] = { time = own.scene.time, text = "", ok = false, error = build.plain(message), count = 1 }
end

local function touched(own, m, words)
  pcall(own.scene.tell, own.scene, { kind = "hand", object = m.wire or own.pulled, text = words })
end

local function undo(own)
  for i = #own.shown, 1, -1 do
    local line = own.shown[i]
    if line.undo and not line.undone then
      line.undone = true
      return do_line(own, line.undo)
    end
  end
end

local function back(own, m)
  for _, s in ipairs(own.snapshots) do
    if s.id == m.id then
      if alive(own.scene) > 0 then
        return refused(own, "a process is under way, and a Lua function has no way back; begin the script again")
      end
      build.back(own.scene, s.snapshot)
      own.names.hand = nil
      for k = #own.lines, 1, -1 do
        if own.lines[k].time > s.time or k > s.lines then own.lines[k] = nil end
      end
      own.changes, own.lines_due, own.forms_due, own.pulled = own.changes + 1, true, true, nil
      own.base = nil
      own.shown[#own.shown + 1] = { time = s.time, text = ("-- back to %g s"):format(s.time), ok = true, count = 1 }
      return
    end
  end
end

-- Orders that change the scene, one after the other; it may be changed now.
local function work(own)
  local queue = own.queue
  own.queue = {}
  for _, m in ipairs(queue) do
    if m["do"] == "undo" then undo(own)
    elseif m["do"] == "back" then back(own, m)
    elseif m["do"] ~= "reach" and m["do"] ~= "let" or own.names.hand then
      if m["do"] == "pull" and own.names.hand then do_line(own, "hand:release()") end
      local fine, text, inverse = pcall(orders.line, own.scene, m)
      if not fine then
        refused(own, text)
      elseif do_line(own, text, inverse) then
        if m["do"] == "pull" then
          own.pulled = m.wire
          touched(own, m, ("wire '%s' is pulled by hand at s = %.4g m"):format(m.wire, m.s))
        elseif m["do"] == "let" then
          touched(own, m, ("wire '%s' is let go by hand"):format(tostring(own.pulled)))
          own.names.hand, own.pulled = nil, nil
        end
      end
    end
  end
end

local function keep(own)
  own.count = own.count + 1
  own.snapshots[#own.snapshots + 1] =
    { id = own.count, time = own.scene.time, snapshot = own.scene:snapshot(), lines = #own.lines }
  if #own.snapshots > MOST_SNAPSHOTS then table.remove(own.snapshots, 2) end -- the first one stays
end

local now = {} -- orders that are done at once: nothing of the scene changes by them

function now.pause(own) own.paused = true end
function now.go(own) own.paused, own.base = false, nil end
function now.step(own) own.paused, own.steps = true, 1 end
function now.keep(own) keep(own) end
function now.stop(own) own.stopped = true end
function now.run(own, m)
  if type(m.duration) == "number" and m.duration > 0 and m.duration <= 1e6 then own.wants_run = m.duration end
end
function now.speed(own, m)
  local speed = m.value
  own.speed = type(speed) == "number" and speed > 1e-6 and speed < 1e6 and speed or nil
  own.base = nil
end

local MOST_AT_ONCE = 500

local function hear(own)
  for _ = 1, MOST_AT_ONCE do
    local text = own.server:take()
    if not text then return end
    local fine, m = pcall(jsonread.decode, text)
    local word = fine and type(m) == "table" and m["do"]
    if now[word] then
      local done, message = pcall(now[word], own, m)
      if not done then refused(own, message) end
    elseif type(word) == "string" and (orders.changes(m) or word == "undo" or word == "back") then
      own.queue[#own.queue + 1] = m
    end -- all else is nobody's business
  end
end

-- --- while a run goes on ------------------------------------------------------------------------------------

-- For how long it is to be held now [s].
local function holding(own)
  if own.stopped then return 0 end
  if own.paused then
    if own.steps > 0 then return 0 end
    return IDLE
  end
  if not own.speed then return 0 end
  local clock = core.clock()
  own.base = own.base or { time = own.scene.time, clock = clock }
  local ahead = (own.scene.time - own.base.time) / own.speed - (clock - own.base.clock)
  if ahead < -0.5 then own.base = nil end -- it cannot go so fast: nothing is to be made up for
  return math.max(0, ahead)
end

-- Show and listen as long as the run is held. Returns whether something is to be changed.
local function hold(own)
  while true do
    hear(own)
    if #own.queue > 0 then return true end
    local left = holding(own)
    own.holds = left > 0 and own.paused
    show(own)
    if left <= 0 then
      own.steps = math.max(0, own.steps - 1)
      return false
    end
    own.server:wait(math.min(left, IDLE))
  end
end

local function look(own, observer)
  local changes = hold(own)
  local o = fields(observer)
  if own.stopped then observer:stop "stopped from the page" end
  own.stopped = nil
  if changes then
    observer:change(function()
      repeat work(own) until not hold(own)
      if own.stopped then fields(observer).reason = "stopped from the page" end
      own.stopped = nil
    end)
  end
  -- each step counts while it is held or goes slowly
  o.every = own.speed and own.speed * GAP or nil
  o.each = own.paused or nil
end

-- --- views -----------------------------------------------------------------------------------------------------

local views = setmetatable({}, { __mode = "k" }) -- scene's data -> its view

local function of_scene(scene) return views[build.data(scene)] end

local POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
  .. "media-src blob:; connect-src ws://127.0.0.1:%d ws://localhost:%d; base-uri 'none'; form-action 'none'; "
  .. "frame-ancestors 'none'"

-- The page has a policy of its own, for files; here the server's is the one, which is as narrow.
local function page_of(own)
  local html = report.live(own.scene.name, { session = own.session })
  local from, to = html:find('<meta http%-equiv="Content%-Security%-Policy"[^>]*>')
  if from then html = html:sub(1, from - 1) .. html:sub(to + 1) end
  own.server:page(html, POLICY:format(own.port, own.port))
end

local function attach(own, scene)
  own.session = own.session + 1
  own.scene, own.signature, own.state, own.frame, own.events = scene, nil, nil, nil, nil
  own.queue, own.lines, own.shown, own.snapshots = {}, {}, {}, {}
  own.changes, own.count, own.steps = 0, 0, 0
  own.names = setmetatable({ scene = scene }, { __index = { math = math } })
  own.lines_due, own.forms_due, own.failed, own.running, own.done = true, true, nil, false, nil
  page_of(own)
end

local function address_of(own) return ("http://127.0.0.1:%d/%s/"):format(own.port, own.token) end

local function open_browser(address)
  os.execute(("command -v xdg-open >/dev/null 2>&1 && xdg-open '%s' >/dev/null 2>&1 &"):format(address))
end

local function serve(scene, args)
  local given = new:read(args == nil and {} or args)
  local fine, server, port, token = pcall(core.serve, given.port or 0)
  if not fine then error("scene:view: " .. build.plain(server), 0) end
  local own = { server = server, port = port, token = token, session = math.random(1, 1 << 30), outline = 0,
    paused = given.paused or false, open = given.open ~= false }
  attach(own, scene)
  local self = sealed.new(View, own)
  views[build.data(scene)] = self
  io.stderr:write(("view of '%s': %s\n"):format(scene.name, address_of(own)))
  if own.open then open_browser(address_of(own)) end
  return self
end

local function name_of(scene) return scene.name end

--- scene:view{ port =, open = }: see help "scene:view".
function core.class.scene.view(scene, args)
  if core.type(scene) ~= "scene" then error("scene:view is a method: call it with a colon", 2) end
  build.call(3, name_of, scene) -- raises when it has been closed
  if of_scene(scene) then return of_scene(scene) end
  return build.call(3, serve, scene, args)
end

local follower = {}
observe.followers[#observe.followers + 1] = follower

local shared -- of `softworld --view`: { view, args }

function follower.begin(scene, args)
  if shared and not of_scene(scene) then
    if shared.view then
      attach(fields(shared.view), scene)
      views[build.data(scene)] = shared.view
    else
      shared.view = core.class.scene.view(scene, shared.args)
    end
  end
  local self = of_scene(scene)
  local own = self and fields(self)
  if not own or not own.server or own.scene ~= scene then return end
  own.running, own.done, own.ok, own.reason, own.base = true, nil, nil, nil, nil
  if not own.args then own.args = args end
  if #own.snapshots == 0 and not own.failed then keep(own) end
  own.observer = scene:observe { wall = GAP, call = function(observer) look(own, observer) end }
  fields(own.observer).each = own.paused or nil
  if own.paused then hold(own) end
end

function follower.finish(scene, ok, reason)
  local self = of_scene(scene)
  local own = self and fields(self)
  if not own or own.scene ~= scene or not own.observer then return end
  own.observer:remove()
  own.observer, own.running, own.done, own.ok, own.reason = nil, false, true, ok or false, tostring(reason)
  own.failed = not ok or nil
  own.frame = nil
  if own.server then pcall(show, own) end
end

-- Between runs: what pages ask for is done at once.
local function idle(own, due)
  repeat
    hear(own)
    if #own.queue > 0 and not own.failed then work(own) end
    own.queue = {}
    show(own)
    if own.wants_run then
      local duration = own.wants_run
      own.wants_run = nil
      local args = { duration = duration, dt = own.args and own.args.dt, tolerance = own.args and own.args.tolerance,
        progress = false }
      if type(args.tolerance) == "table" then args.tolerance = nil end
      own.shown[#own.shown + 1] = { time = own.scene.time, ok = true, count = 1,
        text = ("scene:run { duration = %s }"):format(literal.number(duration)) }
      local fine, run = pcall(own.scene.run, own.scene, args)
      if not fine and core.interrupted() then error(run, 0) end
      if fine then fine = run.ok end -- a run that failed was looked at
      if not fine then own.failed = true end
      own.lines_due = true
    end
    own.server:wait(IDLE)
  until core.clock() >= due
end

--- Show the scene as it is until Ctrl-C, or for so long [s].
function View:wait(seconds)
  if seconds ~= nil then checks.number("view:wait: seconds", seconds, 0, " s", 2) end
  local own = fields(self)
  if not own.server then error("view:wait: the view has been closed", 2) end
  if own.running then error("view:wait: a run is under way", 2) end
  build.call(3, idle, own, seconds and core.clock() + seconds or math.huge)
end

--- Pages are told nothing more.
function View:close()
  local own = fields(self)
  if own.observer then own.observer:remove() end
  if own.server then own.server:stop() end
  own.server, own.observer = nil, nil
  if of_scene(own.scene) == self then views[build.data(own.scene)] = nil end
end

local names = { "address", "pages", "scene", "wait", "close" }

--- Names of methods and fields, for completion at the prompt.
function View.__names() return table.move(names, 1, #names, 1, {}) end

function View:__index(key)
  local own = fields(self)
  if key == "address" then return address_of(own) end
  if key == "pages" then return own.server and (own.server:pages()) or 0 end
  if key == "scene" then return own.scene end
  if key == "wait" or key == "close" then return View[key] end
  local near = core.nearest(checks.shown(key), names)
  error(("a view has no '%s'; %s"):format(checks.shown(key), near and "did you mean '" .. near .. "'?"
    or "it has: " .. table.concat(names, " ")), 2)
end

function View.__newindex(_, key) error(("a view has no '%s' to set"):format(checks.shown(key)), 2) end

function View:__tostring()
  local own = fields(self)
  return own.server and ("view of '%s' at %s"):format(own.scene.name, address_of(own)) or "view, closed"
end

methods.guard_table("view", View)

--- `softworld --view script.lua`: every scene that runs is shown, one after the other, from now on.
function view.all(args) shared = { args = args } end

--- Then, when the script has come to its end: show the last scene until Ctrl-C.
function view.stay()
  local own = shared and shared.view and fields(shared.view)
  if not own or not own.server then
    io.stderr:write "softworld: the script has run no scene: there is nothing to view\n"
    return
  end
  io.stderr:write "the script has ended; Ctrl-C ends the view\n"
  local fine, message = pcall(idle, own, math.huge)
  shared.view:close()
  if not fine and not tostring(message):find "interrupted" then error(message, 0) end
end

return view
