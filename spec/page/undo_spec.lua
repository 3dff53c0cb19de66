-- SPDX-License-Identifier: GPL-3.0-or-later
-- Undo of a removal during a run with processes, without a browser. If the process has not advanced since,
-- the state before the removal comes back; otherwise a scene of forms is run again up to that time. Both
-- give the bits of a run without the removal, and so does the saved script.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = sw.core
local observe = require "softworld.run.observe"
local saving = require "spec.scene.saving"
local socket = require "socket"
local viewing = require "softworld.view.view"
local visitor = require "spec.page.visitor"

local talk -- called between two steps of every run, after the view's own look
local now -- the open page; at_begin(): called before each run begins

table.insert(observe.followers, 1, {
  begin = function() if now and now.at_begin then now.at_begin() end end,
  finish = function() end,
})
observe.followers[#observe.followers + 1] = {
  begin = function(scene)
    if talk then scene:observe{ call = function() if talk then talk(scene) end end } end
  end,
  finish = function() end,
}

local function open(view)
  now = visitor.open(view)
  return now
end

-- Runs for a duration [s of the scene], nil: to the end of its steps. The view waits for seconds [s].
local function start(p, seconds, duration)
  p:ask({ ["do"] = "start", values = { dt = 0.004, duration = duration } }, "start")
  p:hear(seconds)
end

local function close(p)
  talk, now = nil, nil
  p:close()
end

local function after(time) return function(scene) return scene.time >= time end end

-- f(reach, answered, set, keep) runs between the steps of the runs. reach(condition, slowly) waits until the
-- condition holds, slowly if it depends on the page, and returns the scene; answered(mark) waits for the
-- answer to an order; set(g) waits until gravity is g; keep(count) returns the kept state. The result is a
-- function: has f ended?
local function between_steps(p, f)
  local ended, scene = false, nil
  local function reach(condition, slowly)
    while not condition(scene) do
      if slowly then
        socket.sleep(0.04)
        p:hear()
      end
      scene = coroutine.yield()
    end
    return scene
  end
  local function answered(mark) reach(function() return p.answers[mark] end, true) end
  local function set(g)
    p:ask({ ["do"] = "set", object = "", values = { gravity = { 0, 0, g } } }, "set")
    reach(function(now_there) return now_there:gravity()[3] == g end, true)
  end
  local function keep(count)
    p:ask({ ["do"] = "keep" }, "keep")
    reach(function() return p.got.state and #p.got.state.snapshots == count end, true)
    return p.got.state.snapshots[count]
  end
  local thread = coroutine.create(function(first)
    scene = first
    f(reach, answered, set, keep)
    ended = true
  end)
  function talk(of)
    if coroutine.status(thread) == "suspended" then assert(coroutine.resume(thread, of)) end
  end
  return function() return ended end
end

-- The saved script gives the same bits.
local function same_by_script(p)
  assert.is_nil(saving.difference(saving.all(p.view.scene), saving.all(p:by_script())))
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
local WAITS = 12 -- number of waits of a second process, which advances at each of them

-- The scene of the forms; busy: with a process that advances all the time; idle: without steps.
local function put_together(p, busy, idle)
  local function add(class, kind, values, process)
    if class ~= "step" or not idle then p:add(class, kind, values, process) end
  end
  for _, item in ipairs(ITEMS) do add(item[1], item[2], item[3], item[1] == "step" and 1 or nil) end
  for _ = 1, busy and WAITS or 1 do add("step", "wait", { seconds = busy and 0.02 or 0.24 }, 2) end
  for _ = 1, 3 do p:hear(0.1) end
end

-- The values of gravity set by the lines that are not undone.
local function shown(p)
  local held = {}
  for _, line in ipairs(p.got.lines.lines) do
    held[#held + 1] = not line.undone and line.text:match "^scene:set .*, ([-%d]+) } }" or nil
  end
  return held
end

describe("an object removed while a process runs", function()
  for _, busy in ipairs{ false, true } do
    local how = busy and "by running again" or "by the state before"
    for _, what in ipairs{ "cord", "floor", "fixed", "drag", "hand" } do
      it(("comes back by undo, %s: '%s'"):format(how, what), function()
        local p = open(viewing.nothing{ open = false })
        put_together(p, busy)
        assert.equal(#ITEMS + (busy and WAITS or 1), #p.got.draft.items)
        local later
        local ended = between_steps(p, function(reach, answered)
          reach(after(0.05))
          p:ask({ ["do"] = "remove", object = what ~= "drag" and what or nil,
            force = what == "drag" and 1 or nil }, "remove")
          local at = reach(function(scene) return not is_there(scene, what) end, true).time
          later = reach(after(at + (busy and 0.05 or 0.012))).time
          p:ask({ ["do"] = "undo" }, "undo")
          answered "undo"
        end)
        start(p, 1)
        assert.is_true(ended())
        local answer = p.answers.undo
        assert.is_true(answer.ok, answer.text)
        local before = tonumber(answer.text:match "^back to t = ([%d.]+) s, before .-'?%l+'? was removed")
        assert(before and before < later, answer.text)
        assert.equal(busy, answer.text:find "by running again" ~= nil, answer.text)
        assert.is_true(p.got.state.done and p.got.state.ok, p.got.state.reason)
        local scene = p.view.scene
        assert.is_true(is_there(scene, what))
        assert.near(0.25, scene.time, 0.02) -- both processes came to their ends
        assert.near(0.15, scene:find("hand"):position()[3], 1e-9)
        assert.is_nil(p.got.lines.script:find("remove", 1, true), p.got.lines.script)
        same_by_script(p)
        close(p)
      end)
    end
  end

  it("comes back by running again together with a kept state, also with changes by hand", function()
    local p = open(viewing.nothing{ open = false })
    put_together(p, true)
    local kept
    local ended = between_steps(p, function(reach, answered, set, keep)
      set(-2)
      kept = keep(2)
      reach(after(kept.time + 0.06))
      p:ask({ ["do"] = "back", id = kept.id }, "back")
      answered "back"
    end)
    start(p, 1)
    assert.is_true(ended())
    assert.is_true(kept.back)
    local text = p.answers.back.text
    assert(text:find "^back to t = [%d.]+ s, by running again", text)
    assert.is_true(p.got.state.done and p.got.state.ok)
    assert.equal(2, #p.got.state.snapshots) -- it can be restored again
    assert.is_true(p.got.state.snapshots[1].back and p.got.state.snapshots[2].back)
    assert.truthy(p.got.lines.script:find("gravity = { 0, 0, -2 }", 1, true), p.got.lines.script)
    same_by_script(p)
    close(p)
  end)

  it("stays removed when going back is stopped, and the run stays where it was stopped", function()
    local p = open(viewing.nothing{ open = false })
    put_together(p, true)
    local stopped
    between_steps(p, function(reach, _, set)
      reach(after(0.15))
      set(-2)
      p:ask({ ["do"] = "remove", object = "floor" }, "remove")
      reach(function(scene) return not is_there(scene, "floor") end, true)
      reach(after(0.2))
      p:ask({ ["do"] = "undo" }, "undo")
      p:ask({ ["do"] = "undo" }, "second")
      reach(function(scene) return scene.time < 0.1 end, true)
      p:ask({ ["do"] = "stop" }, "stop")
      stopped = true
      reach(function() return false end, true)
    end)
    start(p, 1)
    assert.is_true(stopped)
    assert.is_false(p.answers.undo.ok)
    assert.equal("going back was stopped", p.answers.undo.text)
    assert.is_true(p.got.state.done and not p.got.state.running)
    assert.is_true(p.view.scene.time < 0.15)
    assert.is_true(is_there(p.view.scene, "floor"))
    assert.same({}, shown(p))
    same_by_script(p)
    close(p)
  end)
end)

-- Two states are kept, the later one after one more change of gravity. The run goes back to the first state,
-- gravity is changed to another value, and the run goes to the second state.
describe("a kept state of an abandoned branch of the run", function()
  for _, busy in ipairs{ false, true } do
    it("restores its own changes and can be saved" .. (busy and ", by running again" or ""), function()
      local p = open(viewing.nothing{ open = false })
      put_together(p, busy, not busy)
      local ended = between_steps(p, function(reach, answered, set, keep)
        set(-2)
        local first = keep(2)
        set(-3)
        local second = keep(3)
        p:ask({ ["do"] = "back", id = first.id }, "first")
        answered "first"
        reach(function(scene) return scene:gravity()[3] == -2 end)
        set(-4)
        reach(after(second.time - 0.01))
        set(-5)
        p:ask({ ["do"] = "back", id = second.id }, "second")
        answered "second"
        reach(function(scene) return scene:gravity()[3] == -3 end)
      end)
      start(p, 4, not busy and 0.3 or nil) -- long enough for answers on a busy machine
      assert.is_true(ended())
      assert.is_true(p.got.state.done and p.got.state.ok, p.got.state.reason)
      assert.equal(-3, p.view.scene:gravity()[3])
      assert.same({ "-2", "-3" }, shown(p))
      same_by_script(p)
      close(p)
    end)
  end

  it("restores its own runs", function()
    local p = open(viewing.nothing{ open = false })
    put_together(p, false, true)
    start(p, 0.6, 0.1)
    p:ask({ ["do"] = "keep" }, "keep")
    p:hear(0.2)
    p:ask({ ["do"] = "run", duration = 0.06 }, "run")
    p:hear(0.4)
    p:ask({ ["do"] = "keep" }, "keep")
    p:hear(0.2)
    local kept = p.got.state.snapshots
    assert.near(0.06, kept[3].time - kept[2].time, 1e-9)
    for k = 2, 3 do
      p:ask({ ["do"] = "back", id = kept[k].id }, "back")
      p:hear(0.2)
      local scene, again = p.view.scene, p:by_script()
      assert.near(kept[k].time, scene.time, 1e-12)
      assert.equal(scene.time, again.time)
      assert.same((scene:find("other"):positions()), (again:find("other"):positions()))
    end
    close(p)
  end)
end)

-- A scene of forms that has run once and pauses at the beginning of the next run.
local function paused_after_a_run()
  local p = open(viewing.nothing{ open = false })
  put_together(p, true)
  start(p, 0.6, 0.1)
  p:ask{ ["do"] = "pause" }
  p:hear(0.1)
  return p
end

describe("an object removed at the start of a second run", function()
  it("comes back by undo in that run, not at the end of the first one", function()
    local p = paused_after_a_run()
    local first, begun = p.view.scene.time, 0
    function p.at_begin() -- of the second run, the first again, the second again (paused)
      begun = begun + 1
      if begun == 1 then p:ask({ ["do"] = "remove", object = "floor" }, "remove") end
      if begun == 3 then p:ask({ ["do"] = "keep" }) end
      if begun ~= 2 then p:ask({ ["do"] = "go" }) end
    end
    local ended = between_steps(p, function(reach, answered)
      assert.is_false(is_there(reach(after(first + 0.05)), "floor"))
      p:ask({ ["do"] = "pause" })
      p:ask({ ["do"] = "undo" }, "undo")
      answered "undo"
    end)
    p:ask({ ["do"] = "run", duration = 0.1 }, "run")
    p:hear(1)
    assert.is_true(ended())
    assert.is_true(p.answers.undo.ok, p.answers.undo.text)
    assert.truthy(p.answers.undo.text:find("by running again", 1, true), p.answers.undo.text)
    assert.is_true(is_there(p.view.scene, "floor"))
    local kept = p.got.state.snapshots
    assert.equal(first, kept[#kept].time)
    assert.near(first + 0.1, p.view.scene.time, 1e-9)
    same_by_script(p)
    close(p)
  end)
end)

describe("a run paused at its beginning", function()
  it("can be left for a state of an earlier run, without an order to continue", function()
    local p = paused_after_a_run()
    local first = p.got.state.snapshots[1]
    assert.equal(0, first.time)
    function p.at_begin() p:ask({ ["do"] = "back", id = first.id }, "back") end
    p:ask{ ["do"] = "run", duration = 0.1 }
    p:hear(0.5)
    assert.is_true(p.answers.back.ok, p.answers.back.text)
    assert.truthy(p.answers.back.text:find("back to t = 0 s, by running again", 1, true))
    assert.equal(0, p.view.scene.time)
    close(p)
  end)
end)

describe("undo of a removal in the scene of a script", function()
  -- A process that waits: 0.1 s once, or 4 ms repeatedly.
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
    local p = open(scene:view{ open = false })
    local done = between_steps(p, function(reach, answered)
      reach(after(0.02))
      p:ask({ ["do"] = "remove", object = what }, "remove")
      local at = reach(function() return not is_there(scene, what) end, true).time
      reach(after(at + 0.012))
      reach(function() return p.got.state end, true)
      p:ask({ ["do"] = "undo" }, "undo")
      answered "undo"
    end)
    local run = scene:run{ dt = 0.001 }
    p:hear(0.1)
    assert.is_true(run.ok, run.reason)
    assert.is_true(done())
    work(scene, p, ended)
    close(p)
  end

  it("goes back where the process has only waited, and the process continues", function()
    for _, what in ipairs{ "cord", "floor", "fixed" } do
      scripted(false, what, function(scene, p, ended)
        assert.is_true(p.answers.undo.ok, p.answers.undo.text)
        assert(p.answers.undo.text:find("^back to t = .* s, before '" .. what .. "' was removed$"))
        assert.is_true(is_there(scene, what))
        assert.near(0.1, ended, 1e-9)
        assert.is_nil(p.got.lines.script:find("remove", 1, true))
      end)
    end
  end)

  it("makes an object with a line anew where the process has advanced, and reports that a wire stays "
    .. "removed", function()
    scripted(true, "floor", function(scene, p, ended)
      assert.is_true(p.answers.undo.ok, p.answers.undo.text)
      assert(p.answers.undo.text:find("'floor' is made again as it was, and the run goes on", 1, true))
      assert.is_true(is_there(scene, "floor (2)"))
      assert.near(0.1, ended, 1e-9)
    end)
    scripted(true, "cord", function(scene, p, ended)
      assert.is_false(p.answers.undo.ok)
      assert.equal("'cord' was removed: a process has gone on since, and a Lua function has no way back",
        p.answers.undo.text)
      assert.is_false(is_there(scene, "cord"))
      assert.near(0.1, ended, 1e-9)
    end)
  end)
end)
