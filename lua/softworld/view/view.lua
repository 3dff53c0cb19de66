-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:view and `softworld --view`: the player's page, fed while a scene runs. An observer looks 30 times a
-- second, sends the state to pages that wait for it, and takes their orders between two steps.
-- @module softworld.view.view
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local held = require "softworld.view.held"
local literal = require "softworld.scene.literal"
local methods = require "softworld.methods"
local observe = require "softworld.run.observe"
local report = require "softworld.output.report"
local returning = require "softworld.view.returning"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local show = require "softworld.view.show"
local draft = require "softworld.view.draft"
local functions = require "softworld.view.functions"
local kinds = require "softworld.view.kinds"
local unread = require "softworld.unread"
local work = require "softworld.view.work"

local view = {}
local View = { __name = "view" }

local new = rows.call("scene:view", "{...}", "shows the scene in a browser of this machine while it runs", {
  gives = "a view",
  example = "scene:view()",
  { "port", "integer", "-", "port of the page on this machine", min = 0, max = 65535,
    usual = "any that is free" },
  { "open", "boolean", "-", "true: opens a browser; false: only prints the address", usual = "true" },
  { "paused", "boolean", "-", "runs wait until they are started on the page", usual = "false" },
  { "functions", "boolean", "-", "pages may type Lua functions, which can do whatever you can",
    usual = "false" },
})

rows.calls{
  { "view:wait", "seconds", "shows the scene and executes orders of pages until Ctrl-C, or for this time "
    .. "[s]" },
  { "view:close", "", "ends the view; the scene remains" },
  { "view.address", nil, "address of the page, with its secret; for this machine only", "a text" },
  { "view.pages", nil, "that are open", "a number" },
  { "view.scene", nil, "that it shows", "a scene" },
}

local function fields(self) return sealed.fields(self) end

-- --- views ---------------------------------------------------------------------------------------

local views = setmetatable({}, { __mode = "k" }) -- scene's data -> its view

local function of_scene(scene) return views[build.data(scene)] end

local POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
  .. "img-src data: blob:; media-src blob:; connect-src ws://127.0.0.1:%d ws://localhost:%d; "
  .. "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"

-- Sets the page. Its own policy is for files; here the server's replaces it and is as strict.
local function page_of(own)
  local html = report.live(own.scene.name, { session = own.session, draft = own.draft ~= nil,
    forms = kinds.all(own.functions), functions = own.functions })
  local from, to = html:find('<meta http%-equiv="Content%-Security%-Policy"[^>]*>')
  if from then html = html:sub(1, from - 1) .. html:sub(to + 1) end
  own.server:page(html, POLICY:format(own.port, own.port))
end

-- Shows this scene, which has no changes yet.
local function attach(own, scene)
  own.outline = own.outline + 1
  if own.scene and of_scene(own.scene) then views[build.data(own.scene)] = nil end
  if own.self then views[build.data(scene)] = own.self end
  own.scene, own.signature, own.state, own.frame, own.events = scene, nil, nil, nil, nil
  own.queue, own.lines, own.shown, own.snapshots, own.hand = {}, {}, {}, {}, nil
  own.changes, own.count, own.steps, own.ways, own.led, own.again, own.check = 0, 0, 0, {}, nil, nil, nil
  own.names = setmetatable({ scene = scene, made = {} }, { __index = functions.names() })
  own.lines_due, own.forms_due, own.failed, own.running, own.done = true, true, nil, false, nil
  own.runs, own.serial, own.made_text, own.unsaved, own.draft_due = {}, 0, {}, nil, true
  own.base, own.stopped, own.ok, own.reason, own.args, own.ended = nil, nil, nil, nil, nil, nil
end

-- Shows another scene: pages start again.
local function attach_another(own, scene)
  own.session = own.session + 1
  attach(own, scene)
  page_of(own)
end

local function address_of(own) return ("http://127.0.0.1:%d/%s/"):format(own.port, own.token) end

local function open_browser(address)
  os.execute(("command -v xdg-open >/dev/null 2>&1 && xdg-open '%s' >/dev/null 2>&1 &"):format(address))
end

local function serve(scene, args, from)
  local given = new:read(args == nil and {} or args)
  local fine, server, port, token = pcall(core.serve, given.port or 0)
  if not fine then error("scene:view: " .. build.plain(server), 0) end
  local own = { server = server, port = port, token = token, session = math.random(1, 1 << 30), outline = 0,
    paused = given.paused or false, open = given.open ~= false, answers = {}, draft = from, attach = attach,
    has_undo = work.has_undo, functions = given.functions or false }
  attach_another(own, scene)
  local self = sealed.new(View, own)
  own.self = self
  views[build.data(scene)] = self
  if own.open then
    io.stderr:write(("view of '%s': %s\n"):format(scene.name, address_of(own)))
    open_browser(address_of(own))
  end
  return self
end

local function name_of(scene) return scene.name end

-- Checks the arguments of a call for a scene that has a view, which keeps its port.
local function check_again(own, args)
  local given = new:read(args == nil and {} or args)
  if given.port and given.port ~= 0 and given.port ~= own.port then
    error(("scene:view: port = %d: the view of this scene is open, at port %d"):format(given.port, own.port),
      0)
  end
end

--- scene:view{ port =, open = }: see help "scene:view".
function view.view(scene, args)
  if core.type(scene) ~= "scene" then error("scene:view is a method: call it with a colon", 2) end
  build.call(3, name_of, scene) -- raises if the scene is closed
  unread.used()
  if of_scene(scene) then
    build.call(3, check_again, fields(of_scene(scene)), args)
    return of_scene(scene)
  end
  return build.call(3, serve, scene, args)
end

local follower = {}
observe.followers[#observe.followers + 1] = follower

local shared -- of `softworld --view`: { view, args }

function follower.begin(scene, args)
  if shared and not of_scene(scene) then
    if shared.view then
      attach_another(fields(shared.view), scene)
    else
      shared.view = view.view(scene, shared.args)
    end
  end
  local self = of_scene(scene)
  local own = self and fields(self)
  if not own or not own.server or own.scene ~= scene then return end
  own.running, own.done, own.ok, own.reason, own.base = true, nil, nil, nil, nil
  own.args = own.args or args
  if own.ended and scene.time < own.ended then own.unsaved = "the script repeats its run" end
  own.running, own.ended = false, nil
  if #own.snapshots == 0 and not own.failed and not own.again then returning.keep(own) end
  own.running, own.runs[#own.runs + 1], own.lines_due = true, args, true
  own.observer = scene:observe { wall = held.gap, call = function(observer) held.look(own, observer) end }
  fields(own.observer).each = own.paused or nil
  fields(own.observer).soon = true
  if own.again and returning.lines(own) then held.told_again(own) end
  if own.paused then
    while not own.wants_again and held.hold(own) do work.all(own) end
  end
end

function follower.finish(scene, ok, reason)
  local self = of_scene(scene)
  local own = self and fields(self)
  if not own or own.scene ~= scene or not own.observer then return end
  own.observer:remove()
  own.ended = scene.time
  if own.draft then reason = own.draft:plain(reason) end
  own.observer, own.running, own.done, own.ok, own.reason = nil, false, true, ok or false, tostring(reason)
  own.failed = not ok or nil
  own.frame = nil
  if own.server then pcall(show.all, own) end
end

-- Starts a run that a page asks for, and shows its line. Returns whether it began, and why not.
local function run_now(own, args)
  if not own.again then
    own.shown[#own.shown + 1] = { time = own.scene.time, ok = true, count = 1,
      text = ("scene:run %s"):format(literal.of(args, tostring, "args")) }
  end
  local before = #own.runs
  args.progress = false
  local fine, run = pcall(own.scene.run, own.scene, args)
  if not fine and draft.is_interrupt(run) then error(run, 0) end
  local begun = #own.runs > before
  if fine then fine = run.ok end -- reading ok counts as the look at a failure
  local judged = fine and own.draft and own.draft:checks()
  own.check = judged and functions.judge(run, judged) or nil
  own.failed, own.lines_due = begun and not fine or own.failed, true
  return begun or fine, run
end

-- Returns the message without the place of the caller that waits for the view.
local function plain(message) return (build.plain(message):gsub("^[^\n:]+:%d+: ", "")) end

local function run_on(own)
  local args = { duration = own.wants_run }
  own.wants_run = nil
  for key, value in pairs(own.args or {}) do
    if type(value) ~= "table" and type(value) ~= "function" and key ~= "save" and key ~= "resume" then
      args[key] = args[key] or value
    end
  end
  args.progress = nil
  local begun, message = run_now(own, args)
  if not begun then work.refused(own, plain(message)) end
end

local function run_draft(own)
  local args, ask = {}, own.wants_start.ask
  for key, value in pairs(own.wants_start.args) do args[key] = value end
  own.wants_start = nil
  local fine, message = pcall(work.again, own)
  if fine then fine, message = run_now(own, args) end
  if not fine and draft.is_interrupt(message) then error(message, 0) end
  own.draft_due = true
  show.answer(own, ask, fine, not fine and plain(message) or nil)
end

-- Goes back by running again from the start up to the wanted state; the last of the runs continues.
local function run_again(own)
  work.again(own)
  local r = returning.begin(own)
  for _, args in ipairs(r.runs) do
    local _, result = run_now(own, args)
    if not own.again then return end -- it has arrived, or was given up
    if type(result) == "string" then return held.told_again(own, plain(result)) end
  end
  returning.lines(own)
  held.told_again(own, r.state.inside and "the run ended before it reached that state" or nil)
end

-- Between runs: does what pages ask for at once.
local function idle(own, due)
  repeat
    work.hear(own)
    if #own.queue > 0 and not own.failed then work.all(own) end
    for _, m in ipairs(own.queue) do show.answer(own, m.ask, false, "the run has failed") end
    own.queue = {}
    show.all(own)
    if own.wants_run then run_on(own) end
    if own.wants_start then run_draft(own) end
    if own.wants_again then run_again(own) end
    own.server:wait(held.idle)
  until core.clock() >= due
end

--- Shows the scene as it is until Ctrl-C, or for a time [s].
function View:wait(seconds)
  if seconds ~= nil then checks.number("view:wait: seconds", seconds, 0, " s", 2) end
  local own = fields(self)
  if not own.server then error("view:wait: the view has been closed", 2) end
  if own.running then error("view:wait: a run is under way", 2) end
  build.call(3, idle, own, seconds and core.clock() + seconds or math.huge)
end

--- Closes the view; pages get nothing more.
function View:close()
  local own = fields(self)
  if own.observer then own.observer:remove() end
  if own.server then own.server:stop() end
  own.server, own.observer = nil, nil
  if of_scene(own.scene) == self then views[build.data(own.scene)] = nil end
end

local names = { "address", "pages", "scene", "wait", "close" }

--- Returns the names of methods and fields, for completion at the prompt.
function View.__names() return table.move(names, 1, #names, 1, {}) end

function View:__index(key)
  local own = fields(self)
  if key == "address" then return address_of(own) end
  if key == "pages" then return own.server and (own.server:pages()) or 0 end
  if key == "scene" then return own.scene end
  if key == "wait" or key == "close" then return View[key] end
  error(checks.lacks("a view", key, names), 2)
end

function View.__newindex(_, key) error(("a view has no '%s' to set"):format(checks.shown(key)), 2) end

function View:__tostring()
  local own = fields(self)
  return own.server and ("view of '%s' at %s"):format(own.scene.name, address_of(own)) or "view, closed"
end

methods.guard_table("view", View)

--- `softworld --view script.lua`: shows every scene that runs from here on, one after the other.
function view.all(args) shared = { args = args } end

-- Shows the scene until Ctrl-C.
local function stay(self)
  local fine, message = pcall(idle, fields(self), math.huge)
  self:close()
  if not fine and not tostring(message):find "interrupted" then error(message, 0) end
end

--- Called at the end of the script: shows the last scene until Ctrl-C.
function view.stay()
  local own = shared and shared.view and fields(shared.view)
  if not own or not own.server then
    io.stderr:write "softworld: the script has run no scene: there is nothing to view\n"
    return
  end
  io.stderr:write "the script has ended; Ctrl-C ends the view\n"
  stay(shared.view)
end

--- Returns a view of an empty scene, for forms to put one together.
function view.nothing(args)
  local from = draft.new(args and args.functions)
  return serve(from:build(), args, from)
end

--- `softworld --view` without a script: shows an empty scene until Ctrl-C.
function view.begin(args)
  local self = view.nothing(args)
  io.stderr:write "Ctrl-C ends the view\n"
  stay(self)
end

return view
