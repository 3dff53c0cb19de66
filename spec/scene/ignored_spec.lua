-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a script could do without any effect and without a word: orders that replace others, calls that report
-- a failure by their result, far grasps, events and processes between runs, coroutines within processes.
local sw = require "softworld"
local mm = sw.units.mm

local function made()
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", segments = 30, from = { 0, 0, 0 },
    to = mm{ 300, 0, 0 } }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 2e-3 }
  return scene, wire, scene:gripper{ name = "hand", pads = { width = mm(10) } }
end

-- Returns the texts of the run's events of a kind.
local function told(run, kind)
  local list = {}
  for _, e in ipairs(run.events) do
    if e.kind == kind then list[#list + 1] = e.text end
  end
  return list
end

local function has(text, part) assert.truthy(text and text:find(part, 1, true), tostring(text)) end

describe("an order that replaces another", function()
  it("is told: a move while another process waits for one", function()
    local scene, wire, hand = made()
    hand:grasp(wire, { s = 0 })
    scene:process(function() hand:move{ by = { 0.1, 0, 0 }, duration = 1 } end)
    scene:process(function(p)
      p:wait(0.2)
      hand:move{ by = { 0, 0.01, 0 }, duration = 0.1 }
    end)
    local run = scene:run{ dt = 0.01 }
    local texts = told(run, "replaced")
    assert.equal(1, #texts)
    has(texts[1], "gripper 'hand': the move at ")
    has(texts[1], "replaces the one under way, which was to end at t = 1 s")
    assert.near(0.8, run.events[1].value, 1e-9)
  end)

  it("is told: two moves outside of processes, also before the run", function()
    local scene, wire, hand = made()
    hand:grasp(wire, { s = 0 })
    hand:move{ by = { 0.1, 0, 0 }, duration = 1 }
    hand:move{ by = { 0, 0, 0.1 }, duration = 1 }
    local texts = told(scene:run{ duration = 1.1, dt = 0.01 }, "replaced")
    assert.equal(1, #texts)
    has(texts[1], "outside a process no call waits")
    hand:move{ by = { 0.1, 0, 0 }, duration = 0.1 } -- the last one has ended
    assert.equal(0, #told(scene:run{ duration = 0.2, dt = 0.01 }, "replaced"))
  end)

  it("is told: motions of holds and obstacles, feeds, jaws", function()
    local scene, wire = made()
    local function twice(f) f() f() end
    local hold, ball = scene:clamp(wire, { name = "end", s = 0.3 }),
      scene:obstacle{ name = "ball", shape = "sphere", radius = 0.01, at = { 0, 0, 1 } }
    local pads = scene:gripper{ name = "pads", at = { 0, 0, 2 }, pads = { friction = 0.5, opening = 0.01 } }
    local motion = { points = { { 0, 0, 0 }, { 0, 0, 0.01 } }, relative = true, duration = 0.1 }
    twice(function() hold:follow(motion) end)
    twice(function() ball:follow(motion) end)
    twice(function() pads:close_jaws{ distance = 0.001 } end)
    local feed = scene:feed(wire, { name = "feed", s = 0 })
    twice(function() feed:feed{ length = 0.01, speed = 0.1 } end)
    local texts = told(scene:run{ duration = 0.2, dt = 0.01 }, "replaced")
    table.sort(texts)
    assert.equal(4, #texts)
    has(texts[1], "gripper 'pads': the order to its jaws at ")
    has(texts[2], "hold 'end': the motion at ")
    has(texts[3], "hold 'feed': the feed at ")
    has(texts[4], "obstacle 'ball': the motion at ")
  end)

  it("is told: a motion that replaces that of a Lua function, whose end is not known", function()
    local scene, wire = made()
    local motion = { points = { { 0, 0, 0 }, { 0, 0, 0.01 } }, relative = true, duration = 0.1 }
    local hold, ball = scene:clamp(wire, { name = "end", s = 0.3 }),
      scene:obstacle{ name = "ball", shape = "sphere", radius = 0.01, at = { 0, 0, 1 } }
    for _, object in ipairs{ hold, ball } do
      local at = object:pose()
      object:follow(function() return at end)
      object:follow(motion)
    end
    local texts = told(scene:run{ duration = 0.2, dt = 0.01 }, "replaced")
    table.sort(texts)
    assert.equal(2, #texts)
    has(texts[1], "hold 'end': the motion at ")
    has(texts[1], "replaces the one under way; outside a process no call waits")
    has(texts[2], "obstacle 'ball': the motion at ")
  end)

  it("is not told in one process, nor after restoring an earlier time", function()
    local scene, wire, hand = made()
    hand:grasp(wire, { s = 0 })
    local before = scene:snapshot()
    for _ = 1, 2 do
      scene:restore(before)
      scene:process(function(p)
        hand:move{ by = { 0.01, 0, 0 }, duration = 0.1 }
        hand:move{ by = { 0.01, 0, 0 }, duration = 0.1 }
        hand:press{ force = 1, direction = { 1, 0, 0 }, distance = 0.01 }
        hand:move{ by = { 0.01, 0, 0 }, duration = 0.1 }
        p:wait(0.1)
      end)
      assert.equal(0, #told(scene:run{ dt = 0.01 }, "replaced"))
    end
  end)
end)

describe("a call that reports a failure by its result only", function()
  it("is told by an event: gripper:press", function()
    local scene, wire, hand = made()
    local force, way, there
    scene:process(function()
      hand:grasp(wire, { s = 0 })
      force, way, there = hand:press{ force = 50, direction = { 1, 0, 0 }, distance = 0.01 }
    end)
    local texts = told(scene:run{ dt = 0.01 }, "unreached")
    assert.is_false(there)
    assert.near(0.01, way, 1e-9)
    assert.equal(1, #texts)
    has(texts[1], "gripper 'hand': the press was to end at 50.00 N, and went all of its 10.00 mm")
    assert.is_true(force < 50)
  end)

  it("is told by an event: gripper:clip { fail = false }", function()
    local scene, wire, hand = made()
    local clip = scene:clip{ name = "c", at = mm{ 100, 0, -20 }, width = mm(10), insertion = 80,
      retention = 200 }
    local done, why
    scene:process(function()
      hand:grasp(wire, { s = mm(110) })
      done, why = hand:clip{ into = clip, speed = 0.1, max_force = 1, fail = false }
    end)
    local run = scene:run{ dt = 0.01 }
    local texts = told(run, "unreached")
    assert.is_nil(done)
    assert.same({ "gripper 'hand': clip: wire not in 'c': " .. why }, texts)
  end)

  it("is told by an event: a wait for a condition that runs out", function()
    local scene, wire, hand = made()
    local there
    scene:process(function(p)
      hand:grasp(wire, { s = 0 })
      there = p:wait_until({ force = 100, on = hand }, { timeout = 0.1 })
      p:wait_until({ force = 0, on = hand }, { timeout = 0.1 })
    end)
    local texts = told(scene:run{ dt = 0.01 }, "timeout")
    assert.is_false(there)
    assert.equal(1, #texts)
    has(texts[1], "after 0.1 s: its condition had not come true")
  end)
end)

describe("a gripper at rest that grasps a wire out of its reach", function()
  local function texts_of(at, s, pads)
    local scene, wire = made()
    local hand = scene:gripper{ name = "far", at = at, pads = pads }
    scene:process(function(p)
      hand:grasp(wire, { s = s, approach = pads and "plates" or nil, force = pads and 5 or nil })
      p:wait(0.02)
    end)
    return told(scene:run{ dt = 0.01 }, "grasp")
  end

  it("is told with the distance", function()
    local texts = texts_of({ 0.1, 0, 0.3 }, 0.1)
    assert.equal(1, #texts)
    has(texts[1], "gripper 'far' grasps wire 'w' at s = 0.1 m, which is 300.0 mm from its centre: it jumps")
    assert.equal(0, #texts_of({ 0.1, 0, 0.01 }, 0.1))
    assert.equal(1, #texts_of({ 0.1, 0, 0.3 }, 0.1, { friction = 0.5, opening = 0.01 }))
    assert.equal(0, #texts_of({ 0.1, 0, 0 }, 0.1, { friction = 0.5, opening = 0.01 }))
  end)

  it("is told after a release, and for a second wire", function()
    local scene, wire, hand = made()
    local other = scene:wire{ name = "other", cable = "GXL 1.5", from = { 0, 0.1, 0 }, to = { 0.3, 0.1, 0 } }
    local again = scene:gripper{ name = "again" }
    scene:process(function(p)
      hand:grasp(wire, { s = 0 })
      hand:grasp(other, { s = 0 })
      again:grasp(wire, { s = 0.3 })
      p:wait(0.05)
      again:release()
      again:grasp(wire, { s = 0.1 })
      p:wait(0.05)
    end)
    local texts = told(scene:run{ dt = 0.01 }, "grasp")
    assert.equal(2, #texts)
    has(texts[1], "100.0 mm from its centre: it holds the wire there")
    has(texts[2], "it jumps there at once")
  end)
end)

describe("between two runs", function()
  it("a far grasp is an event of the next run only", function()
    local scene, wire = made()
    scene:run{ duration = 0.05 }
    scene:gripper{ name = "far", at = { 0, 0, 0.3 } }:grasp(wire, { s = 0 })
    assert.equal(1, #told(scene:run{ duration = 0.05 }, "grasp"))
    assert.equal(0, #scene:run{ duration = 0.05 }.events)
  end)

  it("restoring a snapshot tells that it ends a process which has not begun", function()
    local scene = made()
    local before = scene:snapshot()
    scene:process(function(p) p:wait(0.1) end)
    scene:restore(before)
    has(told(scene:run{ duration = 0.05 }, "ended")[1], "scene:restore ended process 1, which had not begun")
  end)
end)

describe("a process", function()
  local function fails(body, part)
    local scene, wire, hand = made()
    scene:process(function(p) body(p, hand, wire) end)
    local fine, why = pcall(scene.run, scene, { dt = 0.01 })
    assert.is_false(fine)
    has(why, part)
  end

  it("does not let a coroutine within it move without waiting", function()
    for what, call in pairs{ ["gripper:move"] = function(hand) hand:move{ by = { 0, 0, 1 }, speed = 1 } end,
      ["gripper:press"] = function(hand) hand:press{ force = 1 } end,
      ["gripper:wait"] = function(hand) hand:wait(1) end } do
      fails(function(_, hand, wire)
        hand:grasp(wire, { s = 0 })
        coroutine.wrap(function() call(hand) end)()
      end, what .. " takes time, and works only in the process itself")
    end
  end)

  it("refuses a value that it yields by itself, and to finish itself", function()
    fails(function() coroutine.yield(0.5) end, "coroutine.yield does not wait for 0.5")
    fails(function(p) p:finish() end, "within itself it ends by return")
  end)

  it("that another one finishes does not prolong the run", function()
    local scene = made()
    local long = scene:process(function(p) p:wait(1) end)
    scene:process(function(p)
      p:wait(0.1)
      long:finish()
    end)
    assert.near(0.1, scene:run{ dt = 0.001 }.time, 1e-9)
  end)

  it("may make another one after a condition that was asked again", function()
    local scene, done, inner = made(), false, nil
    scene:process(function(p)
      p:wait_until(function() return done end)
      scene:process(function(q)
        q:wait(0.1)
        inner = q.time
      end)
    end)
    scene:process(function(p)
      p:wait(0.1)
      done = true
    end)
    assert.is_true(scene:run{ dt = 0.01 }.ok)
    assert.near(0.2, inner, 1e-9)
  end)

  it("of one scene moves a gripper of another one as from outside", function()
    local scene = made()
    local other, wire, hand = made()
    scene:process(function(p)
      hand:grasp(wire, { s = 0 })
      hand:move{ by = { 0, 0, 0.1 }, duration = 0.2 }
      assert.equal(0, p.time)
      assert.is_true(other:run{ duration = 0.3 }.ok)
    end)
    scene:run{ dt = 0.01 }
    assert.near(0.1, hand:position()[3], 1e-9)
  end)
end)

describe("words of calls", function()
  it("name the call that was made: ties, pictures", function()
    local scene, wire = made()
    local fine, why = pcall(scene.tie, scene, wire, { s = 0.1, to = { wire, s = 0.1 } })
    assert.is_false(fine)
    has(why, "tie 'tie1': wire 'w' is joined to itself at s = 0.1 and 0.1 m")
    local run = scene:run{ duration = 0.05 }
    fine, why = pcall(run.pictures, run, { path = "x.png", times = { 0 }, count = 3 })
    assert.is_false(fine)
    has(why, "run:pictures: times and count do not go together")
    fine, why = pcall(run.pictures, run, { path = "x.png", times = {} })
    assert.is_false(fine)
    has(why, "run:pictures: times is empty")
  end)
end)

describe("an argument that a method does not take", function()
  it("is refused with the call's name", function()
    local scene, wire, hand = made()
    local ball = scene:obstacle{ name = "ball", shape = "sphere", radius = 0.01, at = { 0, 0, 1 } }
    local run = scene:run{ duration = 0.05 }
    for text, call in pairs{
      ["obstacle:force takes no arguments, got a wire"] = function() ball:force(wire) end,
      ["wire:positions takes no arguments, got 0.1"] = function() wire:positions(0.1) end,
      ["scene:contacts takes no arguments, got a wire"] = function() scene:contacts(wire) end,
      ["gripper:series takes no arguments, got 5"] = function() hand:series(5) end,
      ["run:series takes no arguments, got 'hand.force'"] = function() run:series "hand.force" end,
      ["run:save takes (path), got 'hand.force' too"] = function() run:save("x.csv", "hand.force") end,
      ["scene:remove takes (object or name), got 'w' too"] = function() scene:remove("ball", "w") end } do
      local fine, why = pcall(call)
      assert.is_false(fine)
      has(why, "ignored_spec.lua:")
      has(why, text)
    end
    assert.is_true(ball.present)
    assert.same(ball:force(), ball:force(nil))
  end)

  it("is refused by methods of studies, checks and runs, and by readings at a place", function()
    local scene, wire = made()
    local study = sw.study{ name = "refusing", parameters = { x = { 0, 1 }, y = { 0, 1 } }, workers = 0,
      evaluate = function(p) return { a = p.x, b = 1 - p.x } end }
    local run = scene:run{ duration = 0.05 }
    local check = run:check{}
    for text, call in pairs{
      ["study:pareto takes ({ results, ... }), got a table too"] = function()
        study:pareto({ "a", "b" }, { evaluations = 100 })
      end,
      ["study:sweep takes ({...}), got a table too"] = function()
        study:sweep({ count = 4 }, { seed = 2 })
      end,
      ["study:minimise takes (result, {...}), got a table too"] = function()
        study:minimise("a", { evaluations = 8 }, { method = "simplex" })
      end,
      ["study:table takes no arguments, got 1"] = function() study:table(1) end,
      ["study:run takes ({...}), got 1 too"] = function() study:run({ workers = 0 }, 1) end,
      ["scene:run takes ({ duration =, dt =, ... }), got a table too"] = function()
        scene:run({ duration = 0.1 }, { dt = 1 })
      end,
      ["scene:settle takes ({ tolerance = }), got a table too"] = function() scene:settle({}, {}) end,
      ["run:check takes ({...}), got a table too"] = function() run:check({}, {}) end,
      ["run:obj takes (path, {...}), got 1 too"] = function() run:obj("x.obj", {}, 1) end,
      ["check:row takes (name), got 'x' too"] = function() check:row("events", "x") end,
      ["wire:position takes (s), got 'x' too, as argument 2"] = function() wire:position(0.1, "x") end,
      ["wire:tension takes (s), got 0.2 too, as argument 2"] = function() wire:tension(0.1, 0.2) end,
      ["wire:stress takes (s), got a table too, as argument 2"] = function() wire:stress(0.1, {}) end } do
      local fine, why = pcall(call)
      assert.is_false(fine, text)
      has(why, "ignored_spec.lua:")
      has(why, text)
    end
    assert.equal(0, study.computed)
    assert.same(wire:position(0.1), wire:position(0.1, nil))
  end)

  it("is refused in a process, with the line of the call", function()
    for text, call in pairs{
      ["p:wait takes (seconds), got 2 too"] = function(p) p:wait(0.1, 2) end,
      ["p:wait_until takes (condition, {...}), got 3 too"] = function(p)
        p:wait_until(function() return true end, {}, 3)
      end,
      ["p:step takes (name, function), got 0.1 too"] = function(p) p:step("a", function() end, 0.1) end,
      ["p:finish takes no arguments, got 1"] = function(p) p:finish(1) end } do
      local scene = made()
      scene:process(call)
      local fine, why = pcall(scene.run, scene, { duration = 0.05 })
      assert.is_false(fine)
      has(why, "ignored_spec.lua:")
      has(why, text)
    end
  end)

  it("is refused: captions without pictures, means longer than the run", function()
    local scene = made()
    local run = scene:run{ duration = 0.05 }
    for text, call in pairs{
      ["captions has 3 texts for 2 pictures"] = function()
        run:pictures{ path = "x.png", count = 2, captions = { "a", "b", "c" } }
      end,
      ["caption is for one picture, and there are 2"] = function()
        run:pictures{ path = "x.png", times = { 0, 0.05 }, caption = "a" }
      end,
      ["captions has 2 texts for 1 picture"] = function()
        run:picture{ path = "x.png", captions = { "a", "b" } }
      end,
      ["mean = 5 s is longer than the run, 0.05 s"] = function()
        run:chart{ path = "x.svg", mean = 5 }
      end } do
      local fine, why = pcall(call)
      assert.is_false(fine)
      has(why, text)
    end
  end)
end)
