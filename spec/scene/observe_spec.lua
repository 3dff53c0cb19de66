-- SPDX-License-Identifier: GPL-3.0-or-later
-- Observers look at a scene between two steps of a run: they are called when due, change no bit, and can
-- hold the run, end it and hand in changes.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local states = require "spec.scene.states"
local t = require "spec.physics.tools"

-- A wire that falls onto a floor, in steps of 0.01 s.
local function falling(height)
  local scene = sw.scene { name = "falling" }
  local floor = scene:obstacle { name = "floor", shape = "plane", friction = 0.3 }
  local wire = scene:wire { E = 5e7, density = 1500, radius = 0.003, segments = 12,
    from = { 0, 0, height or 0.1 }, to = { 0.3, 0, height or 0.1 } }
  return scene, wire, floor
end

-- Reads everything that a scene offers.
local function read_all(scene)
  saving.all(scene)
  scene:describe()
  scene:events()
  scene:snapshot()
  for _, name in ipairs(scene:names()) do
    local object = scene:find(name)
    for _, readout in ipairs(sw.core.type(object) == "wire" and sw.core.registry().readouts or {}) do
      pcall(object[readout.name], object, readout.at_place and 0.3 * object.length or nil) -- not all have it
    end
  end
end

describe("an observer", function()
  -- Step ends meet the times k * 0.04 s. For times between step ends it is the first step end after them.
  it("is called at the first accepted step at or after each of its times", function()
    local scene = falling()
    local times, between = {}, {}
    scene:observe { every = 0.04, call = function(o) times[#times + 1] = o.scene.time end }
    scene:observe { every = 0.025, call = function(o) between[#between + 1] = o.scene.time end }
    t.fine(scene:run { duration = 0.12, dt = 0.01 })
    assert.equal(3, #times)
    for k, time in ipairs(times) do t.near(0.04 * k, time, 1e-12) end
    assert.equal(4, #between)
    for k, time in ipairs { 0.03, 0.05, 0.08, 0.1 } do t.near(time, between[k], 1e-12) end
  end)

  it("counts its times from the start of each run; without times it sees every step", function()
    local scene = falling(5)
    local times, steps = {}, 0
    scene:observe { every = 0.02, call = function(o) times[#times + 1] = o.scene.time end }
    local each = scene:observe { call = function() steps = steps + 1 end }
    t.fine(scene:run { duration = 0.03, dt = 0.01 })
    t.fine(scene:run { duration = 0.03, dt = 0.01 })
    assert.equal(2, #times)
    t.near(0.02, times[1], 1e-12)
    t.near(0.05, times[2], 1e-12)
    assert.equal(6, steps)
    assert.equal(6, each.calls)
  end)

  -- Each look holds the run for 4 ms, so 10 steps last longer than two intervals of 20 ms.
  it("is called at intervals of clock time", function()
    local scene = falling(5)
    local begun, calls = sw.core.clock(), 0
    scene:observe { wall = 0.02, call = function() calls = calls + 1 end }
    scene:observe { call = function(o) o:pause { wall = 0.004 } end }
    t.fine(scene:run { duration = 0.1, dt = 0.01 })
    local lasted = sw.core.clock() - begun
    assert.is_true(lasted >= 0.04)
    assert.is_true(calls >= 1 and calls <= lasted / 0.02)
  end)

  local looked = 0
  for _, list in ipairs { saving.cases, states.cases } do
    for _, case in ipairs(list) do
      it("changes no bit by reading everything: " .. case.name, function()
        local function after(watched)
          local scene, calls = case.build(), 0
          case.before(scene)
          if watched then
            scene:observe { call = function()
              calls = calls + 1
              if calls <= 4 or calls % 9 == 0 then read_all(scene) end
            end }
            scene:observe { every = 1e-3, call = function() end }
            scene:observe { wall = 1e-4, call = function() end }
          end
          case.after(scene)
          looked = looked + calls
          return saving.all(scene)
        end
        assert.is_nil(saving.difference(after(false), after(true)))
      end)
    end
  end

  it("was called at more than 1000 steps in these cases", function() assert.is_true(looked > 1000) end)

  it("ends a run, with ok = true and the reason given", function()
    local scene = falling()
    scene:observe { every = 0.03, call = function(o) o:stop "low enough" end }
    local run = scene:run { duration = 1, dt = 0.01 }
    assert.is_true(run.ok)
    assert.equal("low enough", run.reason)
    t.near(0.03, run.time, 1e-12)
    assert.equal("stopped by an observer", (function()
      local other = falling()
      other:observe { call = function(o) o:stop() end }
      return other:run({ duration = 1, dt = 0.01 }).reason
    end)())
  end)

  it("hands in changes, which are made between this step and the next", function()
    local scene, wire = falling(2)
    local at
    scene:observe { every = 0.05, call = function(o)
      if o.calls > 1 then return end
      o:change(function() scene:set { gravity = { 0, 0, 0 } }; at = scene.time end)
    end }
    t.fine(scene:run { duration = 0.2, dt = 0.01 })
    t.near(0.05, at, 1e-12)
    t.near(-9.81 * 0.05, wire:velocity(0.1)[3], 1e-9) -- no gravity since
  end)

  it("is no longer called once it is removed, also by itself", function()
    local scene = falling()
    local calls = 0
    local o = scene:observe { call = function(self)
      calls = calls + 1
      self:remove()
    end }
    t.fine(scene:run { duration = 0.05, dt = 0.01 })
    assert.equal(1, calls)
    o:remove()
    local other = scene:observe { call = function() calls = calls + 1 end }
    other:remove()
    t.fine(scene:run { duration = 0.05, dt = 0.01 })
    assert.equal(1, calls)
  end)

  it("may make other observers, and remove them, while they are called", function()
    local scene = falling()
    local made, seen = nil, 0
    scene:observe { call = function(o)
      if not made then made = o.scene:observe { call = function() seen = seen + 1 end } end
      if o.calls == 4 then made:remove() end
    end }
    t.fine(scene:run { duration = 0.08, dt = 0.01 })
    assert.equal(2, seen)
  end)

  it("belongs to the process, not to the scene: restoring a snapshot keeps it", function()
    local scene = falling()
    local start, calls = scene:snapshot(), 0
    scene:observe { call = function() calls = calls + 1 end }
    t.fine(scene:run { duration = 0.02, dt = 0.01 })
    scene:restore(start)
    t.fine(scene:run { duration = 0.02, dt = 0.01 })
    assert.equal(4, calls)
  end)

  it("works with processes, and in quasi-static and adaptive steps", function()
    for _, args in ipairs { { dt = 0.01 }, { tolerance = 1e-5 }, { quasistatic = true, dt = 0.05 } } do
      local scene = sw.scene {}
      local wire = scene:wire { E = 5e7, density = 1500, radius = 0.003, segments = 12, from = { 0, 0, 0 },
        to = { 0.3, 0, 0 } }
      local hand = scene:gripper { name = "hand" }
      scene:process(function()
        hand:grasp(wire, { s = 0 })
        hand:move { by = { 0, 0, 0.05 }, speed = 0.2 }
      end)
      local heights = {}
      scene:observe { every = 0.1, call = function() heights[#heights + 1] = hand:position()[3] end }
      t.fine(scene:run(args))
      assert.is_true(#heights >= 2)
      for k = 2, #heights do assert.is_true(heights[k] > heights[k - 1]) end
    end
  end)
end)

describe("an error in an observer", function()
  local here = "observe_spec.lua:"

  -- Returns the message. The scene can go on without that observer.
  local function message_of(call)
    local scene, wire, floor = falling()
    local failing = scene:observe { call = function(o) call(o, scene, wire, floor) end }
    local fine, message = pcall(scene.run, scene, { duration = 0.1, dt = 0.01 })
    assert.is_false(fine)
    t.near(0.01, scene.time, 1e-12)
    failing:remove()
    local other = scene:observe { call = function() end }
    t.fine(scene:run { duration = 0.02, dt = 0.01 })
    t.near(0.03, scene.time, 1e-12)
    assert.equal(2, other.calls)
    return message
  end

  it("names the line of the script", function()
    local line = debug.getinfo(1, "l").currentline + 1
    local message = message_of(function(_, _, wire) wire:position "x" end)
    assert.truthy(message:find(here .. line, 1, true), message)
    assert.truthy(message_of(function() error("mine", 0) end) == "mine")
    local own = { "a table" }
    assert.equal(own, message_of(function() error(own) end))
  end)

  it("is raised when the observer changes, runs or restores the scene", function()
    for _, call in ipairs {
      function(_, _, _, floor) floor:set { friction = 0.1 } end,
      function(_, scene) scene:set { gravity = { 0, 0, 0 } } end,
      function(_, scene) scene:obstacle { shape = "plane" } end,
      function(_, scene) scene:run { duration = 0.1 } end,
      function(_, scene) scene:settle() end,
      function(_, scene) scene:restore(scene:snapshot()) end,
      function(_, _, wire) wire:set_velocity { 0, 0, 1 } end,
    } do
      assert.truthy(message_of(call):find("inside an observer's function", 1, true)
        or message_of(call):find("cannot be changed", 1, true), message_of(call))
    end
  end)

  it("discards the changes that it handed in", function()
    local scene, _, floor = falling()
    local o = scene:observe { call = function(o)
      o:change(function() floor:set { friction = 0.9 } end)
      error "no"
    end }
    assert.is_false((pcall(scene.run, scene, { duration = 0.1, dt = 0.01 })))
    o:remove()
    t.fine(scene:run { duration = 0.02, dt = 0.01 })
    t.near(0.3, floor:get().friction, 0)
  end)

  it("is raised by the call itself for wrong arguments", function()
    local scene = falling()
    local function wrong(args, text)
      local fine, message = pcall(scene.observe, scene, args)
      assert.is_false(fine)
      assert.truthy(message:find(text, 1, true), message)
      assert.truthy(message:find(here, 1, true), message)
    end
    wrong({}, "scene:observe: call is required")
    wrong({ call = 3 }, "call must be a function, got 3")
    wrong({ call = print, every = 0 }, "every = 0 s is not allowed; it must be above 0 s")
    wrong({ call = print, wall = -1 }, "wall = -1 s is not allowed")
    wrong({ call = print, evry = 1 }, "did you mean 'every'?")
    wrong(print, "scene:observe takes one table of parameters")
    local o = scene:observe { call = print }
    assert.error_matches(function() o:stop() end, "only inside the function of the observer")
    assert.error_matches(function() o:change(print) end, "only inside the function of the observer")
    assert.error_matches(function() o:stop(3) end, "expects a text")
    assert.error_matches(function() return o.callz end, "did you mean 'calls'")
    assert.error_matches(function() o.every = 2 end, "to set")
    assert.error_matches(function() o.remove() end, "call it with a colon")
  end)

  it("says why scene:save is refused, and what to do", function()
    local scene = sw.scene { name = "seen" }
    scene:clamp(scene:wire { E = 5e7, density = 1500, radius = 0.0025, from = { 0, 0, 1 }, to = { 1, 0, 1 } },
      { s = 0 })
    local path, kept, seen, changed = os.tmpname(), nil, nil, nil
    os.remove(path)
    scene:observe { every = 0.1, call = function(observer)
      kept = kept or scene:snapshot()
      seen = select(2, pcall(scene.save, scene, path))
      observer:change(function() changed = select(2, pcall(scene.save, scene, path)) end)
    end }
    assert.is_true(scene:run { duration = 0.2, dt = 0.01 }.ok)
    local why = "scene:save: a run of scene 'seen' is under way, and a scene can be saved only between runs"
    for _, text in ipairs { seen, changed } do
      assert.truthy(text:find(why, 1, true), text)
      assert.is_nil(text:find("observer:change", 1, true))
    end
    assert.truthy(seen:find("take a scene:snapshot() here, and scene:restore it after", 1, true), seen)
    assert.is_nil(io.open(path))
    scene:restore(kept)
    scene:save(path)
    assert.near(0.1, sw.load(path).time, 1e-9)
    os.remove(path)
  end)
end)
