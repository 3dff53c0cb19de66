-- SPDX-License-Identifier: GPL-3.0-or-later
-- Undoing what was taken away in a run while a process goes on, without a browser. Where the process has not
-- gone on since, the state before comes back; else a scene of forms is run again up to there. Both give the
-- bits of a run in which nothing was taken away, and so does the script that is saved.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = sw.core
local json = require "softworld.output.json"
local jsonread = require "softworld.output.jsonread"
local observe = require "softworld.run.observe"
local saving = require "spec.scene.saving"
local socket = require "socket"
local viewing = require "softworld.view.view"
local websocket = require "spec.page.websocket"

local talk -- called between two steps of every run, after the view's own look

observe.followers[#observe.followers + 1] = {
  begin = function(scene)
    if talk then scene:observe{ call = function() if talk then talk(scene) end end } end
  end,
  finish = function() end,
}

local function open(view)
  local port, path = view.address:match "^http://127%.0%.0%.1:(%d+)(/%x+/)$"
  local page = assert(websocket.open(math.tointeger(port), path .. "s"))
  local got = { answers = {} }
  local function hear()
    while true do
      local t, opcode = page:receive(0.02)
      if not t then break end
      local m = opcode == 1 and jsonread.decode(t)
      if not m then page:send "a" end
      if m then got[m.kind] = m end
      for _, a in ipairs(m and m.kind == "answers" and m.answers or {}) do got.answers[a.ask] = a end
    end
  end
  local function ask(order, mark)
    order.ask = mark
    page:send(json.encode(order))
  end
  return got, ask, hear, function()
    talk = nil
    page:close()
    view:close()
  end
end

local function is_there(scene, what)
  if what ~= "drag" then
    local fine, object = pcall(scene.find, scene, what)
    local kind = fine and core.type(object)
    return fine and (kind ~= "obstacle" or object.present) and (kind ~= "clamp" or object.held)
      and not (type(object) == "table" and object.left)
  end
  for _, force in ipairs(scene:forces()) do
    if force.kind == what then return force.held end
  end
end

local ITEMS = {
  { "wire", "rod", { name = "cord", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 },
    segments = 12 } },
  { "wire", "rod", { name = "other", cable = "GXL 1.5", from = { 0, 0.1, 0.1 }, to = { 0.3, 0.1, 0.1 },
    segments = 12 } },
  { "obstacle", "plane", { name = "floor", friction = 0.3 } },
  { "hold", "clamp", { name = "fixed", _on = "other", s = 0 } },
  { "force", "drag", { on = "other", linear = 0.1 } },
  { "gripper", "gripper", { name = "hand", at = { 0, 0, 0.1 } } },
  { "step", "grasp", { _by = "hand", _on = "cord", s = 0 } },
  { "step", "wait", { seconds = 0.01 } },
  { "step", "move", { _by = "hand", by = { 0, 0, 0.05 }, duration = 0.2 } },
}
local WAITS = 12 -- of a second process, between which it goes on

-- The form's scene; busy: a process that goes on all the time.
local function put_together(ask, hear, view, busy)
  local function add(class, kind, values, process)
    local order = { ["do"] = "draft", what = "add", class = class, kind = kind, values = values }
    order.process = process
    ask(order, "add")
  end
  for _, item in ipairs(ITEMS) do add(item[1], item[2], item[3], item[1] == "step" and 1 or nil) end
  for _ = 1, busy and WAITS or 1 do add("step", "wait", { seconds = busy and 0.02 or 0.24 }, 2) end
  for _ = 1, 3 do
    view:wait(0.1)
    hear()
  end
end

describe("what was taken away while a process goes on", function()
  for _, busy in ipairs{ false, true } do
    local how = busy and "by running again" or "by the state before"
    for _, what in ipairs{ "cord", "floor", "fixed", "drag", "hand" } do
      it(("comes back by undo, %s: '%s'"):format(how, what), function()
        local view = viewing.nothing{ open = false }
        local got, ask, hear, close = open(view)
        put_together(ask, hear, view, busy)
        assert.equal(#ITEMS + (busy and WAITS or 1), #got.draft.items)
        local stage, at, later = "before", nil, nil
        function talk(scene)
          if stage == "before" and scene.time >= 0.05 then
            local force = what == "drag" and 1 or nil
            ask({ ["do"] = "remove", object = not force and what or nil, force = force }, "remove")
            stage = "going"
          elseif stage == "going" then
            socket.sleep(0.04)
            if not is_there(scene, what) then stage, at = "gone", scene.time end
          elseif stage == "gone" and scene.time >= at + (busy and 0.05 or 0.012) then
            later = scene.time
            ask({ ["do"] = "undo" }, "undo")
            stage = "coming"
          elseif stage == "coming" then
            socket.sleep(0.02)
            hear()
            if got.answers.undo then stage = "there" end
          end
        end
        ask({ ["do"] = "start", values = { dt = 0.004 } }, "start")
        view:wait(1)
        hear()
        assert.equal("there", stage)
        local answer = got.answers.undo
        assert.is_true(answer.ok, answer.text)
        local before = tonumber(answer.text:match "^back to t = ([%d.]+) s, before .-'?%l+'? was removed")
        assert(before and before < later, answer.text)
        assert.equal(busy, answer.text:find "by running again" ~= nil, answer.text)
        assert.is_true(got.state.done and got.state.ok, got.state.reason)
        local scene = view.scene
        assert.is_true(is_there(scene, what))
        assert.near(0.25, scene.time, 0.02) -- both processes came to their ends
        assert.near(0.15, scene:find("hand"):position()[3], 1e-9)
        local script = got.lines.script
        assert.is_nil(script:find("remove", 1, true), script)
        local again = assert(load(script:gsub("run:summary%(%)\n$", "return scene")))()
        assert.is_nil(saving.difference(saving.all(scene), saving.all(again)))
        close()
      end)
    end
  end

  it("and a state that was kept comes back too, by running again, changes by hand included", function()
    local view = viewing.nothing{ open = false }
    local got, ask, hear, close = open(view)
    put_together(ask, hear, view, true)
    local stage, kept = "set", nil
    function talk(scene)
      if stage == "set" then
        ask({ ["do"] = "set", object = "", values = { gravity = { 0, 0, -2 } } }, "set")
        stage = "setting"
      elseif stage == "setting" then
        socket.sleep(0.04)
        if scene:gravity()[3] == -2 then
          stage = "keeping"
          ask({ ["do"] = "keep" }, "keep")
        end
      elseif stage == "keeping" then
        socket.sleep(0.04)
        hear()
        if got.state and #got.state.snapshots == 2 then stage, kept = "kept", got.state.snapshots[2] end
      elseif stage == "kept" and scene.time > kept.time + 0.06 then
        ask({ ["do"] = "back", id = kept.id }, "back")
        stage = "back"
      elseif stage == "back" then
        socket.sleep(0.02)
        hear()
        if got.answers.back then stage = "there" end
      end
    end
    ask({ ["do"] = "start", values = { dt = 0.004 } }, "start")
    view:wait(1)
    hear()
    assert.equal("there", stage)
    assert.is_true(kept.back)
    assert(got.answers.back.text:find "^back to t = [%d.]+ s, by running again", got.answers.back.text)
    assert.is_true(got.state.done and got.state.ok)
    assert.equal(2, #got.state.snapshots) -- it can be gone back to again
    assert.is_true(got.state.snapshots[1].back and got.state.snapshots[2].back)
    local script = got.lines.script
    assert.truthy(script:find("gravity = { 0, 0, -2 }", 1, true), script)
    local again = assert(load(script:gsub("run:summary%(%)\n$", "return scene")))()
    assert.is_nil(saving.difference(saving.all(view.scene), saving.all(again)))
    close()
  end)

  it("stays away where going back is stopped, and the run is as far as it came", function()
    local view = viewing.nothing{ open = false }
    local got, ask, hear, close = open(view)
    put_together(ask, hear, view, true)
    local stage = "before"
    function talk(scene)
      if stage == "before" and scene.time >= 0.15 then
        ask({ ["do"] = "remove", object = "floor" }, "remove")
        stage = "going"
      elseif stage == "going" then
        socket.sleep(0.04)
        if not is_there(scene, "floor") then stage = "gone" end
      elseif stage == "gone" and scene.time >= 0.2 then
        ask({ ["do"] = "undo" }, "undo")
        ask({ ["do"] = "undo" }, "second")
        stage = "coming"
      elseif stage == "coming" then
        socket.sleep(0.04)
        if scene.time < 0.1 then
          ask({ ["do"] = "stop" }, "stop")
          stage = "stopping"
        end
      elseif stage == "stopping" then
        socket.sleep(0.04)
      end
    end
    ask({ ["do"] = "start", values = { dt = 0.004 } }, "start")
    view:wait(1)
    hear()
    assert.equal("stopping", stage)
    assert.is_false(got.answers.undo.ok)
    assert.equal("going back was stopped", got.answers.undo.text)
    assert.is_true(got.state.done and not got.state.running)
    assert.is_true(view.scene.time < 0.15)
    assert.is_true(is_there(view.scene, "floor"))
    local again = assert(load(got.lines.script:gsub("run:summary%(%)\n$", "return scene")))()
    assert.is_nil(saving.difference(saving.all(view.scene), saving.all(again)))
    close()
  end)
end)

describe("in the scene of a script", function()
  -- A process that waits: 0.1 s once, or 4 ms again and again.
  local function scripted(busy, what, work)
    local scene = sw.scene{ name = "scripted" }
    scene:obstacle{ name = "floor", shape = "plane", friction = 0.3 }
    local wire = scene:wire{ name = "cord", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 },
      segments = 12 }
    scene:clamp(wire, { s = 0, name = "fixed" })
    local ended
    scene:process(function(p)
      for _ = 1, busy and 25 or 1 do p:wait(busy and 0.004 or 0.1) end
      ended = p.time
    end)
    local view = scene:view{ open = false }
    local got, ask, hear, close = open(view)
    local stage, at = "before", nil
    function talk()
      if stage == "before" and scene.time >= 0.02 then
        ask({ ["do"] = "remove", object = what }, "remove")
        stage = "going"
      elseif stage == "going" then
        socket.sleep(0.04)
        if not is_there(scene, what) then stage, at = "gone", scene.time end
      elseif stage == "gone" and scene.time >= at + 0.012 then
        socket.sleep(0.04)
        hear()
        if got.state then
          ask({ ["do"] = "undo" }, "undo")
          stage = "coming"
        end
      elseif stage == "coming" then
        socket.sleep(0.02)
        hear()
        if got.answers.undo then stage = "there" end
      end
    end
    local run = scene:run{ dt = 0.001 }
    talk = nil
    view:wait(0.1)
    hear()
    assert.is_true(run.ok, run.reason)
    assert.equal("there", stage)
    work(scene, got, ended)
    close()
  end

  it("undo goes back where the process has only waited, and it goes on", function()
    for _, what in ipairs{ "cord", "floor", "fixed" } do
      scripted(false, what, function(scene, got, ended)
        assert.is_true(got.answers.undo.ok, got.answers.undo.text)
        assert(got.answers.undo.text:find("^back to t = .* s, before '" .. what .. "' was removed$"))
        assert.is_true(is_there(scene, what))
        assert.near(0.1, ended, 1e-9)
        assert.is_nil(got.lines.script:find("remove", 1, true))
      end)
    end
  end)

  it("what has a line is made anew where it has gone on, and a wire is not, which is told", function()
    scripted(true, "floor", function(scene, got, ended)
      assert.is_true(got.answers.undo.ok, got.answers.undo.text)
      assert(got.answers.undo.text:find("'floor' is made anew, as it was, and the run goes on", 1, true))
      assert.is_true(is_there(scene, "floor (2)"))
      assert.near(0.1, ended, 1e-9)
    end)
    scripted(true, "cord", function(scene, got, ended)
      assert.is_false(got.answers.undo.ok)
      assert.equal("'cord' was removed: a process has gone on since, and a Lua function has no way back",
        got.answers.undo.text)
      assert.is_false(is_there(scene, "cord"))
      assert.near(0.1, ended, 1e-9)
    end)
  end)
end)
