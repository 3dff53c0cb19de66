-- SPDX-License-Identifier: GPL-3.0-or-later
-- Users' functions inside the core: forces, motions, conditions, processes. Forbidden calls are refused,
-- errors come out unchanged, and the scene still works.
local sw = require "softworld"
local cantilever = require "spec.bind.cantilever"

local make = cantilever.make
local core = sw.core

-- Gives a hold or an obstacle a motion that rests at a place. After a call of the returned function the
-- motion also calls f.
local function ask_later(moved, place, f)
  local asking = false
  moved:follow(function(t)
    if asking then f(t) end
    return place
  end)
  return function() asking = true end
end

-- Ways to have a function called from inside the core: each takes the scene, its objects and a function,
-- and returns what sets off the call.
local ways = {
  ["a force in a run"] = function(scene, wire, _, f)
    scene:force{ kind = f, on = wire }
    return function() return scene:run{ duration = 0.02 } end
  end,
  ["a force in an explicit run"] = function(scene, wire, _, f)
    scene:force{ kind = f, on = wire }
    return function() return scene:run{ duration = 0.002, dt = 0.001, integrator = "rk4" } end
  end,
  ["a force in a run of GSL"] = function(scene, wire, _, f)
    scene:force{ kind = f, on = wire }
    return function() return scene:run{ duration = 0.002, dt = 0.001, integrator = "gsl-rkf45" } end
  end,
  ["a force while settling"] = function(scene, wire, _, f)
    scene:force{ kind = f, on = wire }
    return function() return scene:settle() end
  end,
  ["a force that is evaluated"] = function(scene, wire, _, f)
    scene:force{ kind = f, on = wire }
    return function() return scene:evaluate(wire) end
  end,
  ["the motion of a clamp"] = function(scene, _, clamp, f)
    local ask = ask_later(clamp, { 0, 0, 0 }, f)
    ask()
    return function() return scene:run{ duration = 0.02 } end
  end,
  ["the motion of an obstacle"] = function(scene, _, _, f)
    local box = scene:obstacle{ shape = "box", size = { 1, 1, 1 }, at = { 0, 0, -5 } }
    local ask = ask_later(box, { 0, 0, -5 }, f)
    ask()
    return function() return scene:run{ duration = 0.02 } end
  end,
  ["a motion that is asked where it is"] = function(_, _, clamp, f)
    local ask = ask_later(clamp, { 0, 0, 0 }, f)
    ask()
    return function() return clamp:pose() end
  end,
  ["a motion while its clamp is released"] = function(_, _, clamp, f)
    local ask = ask_later(clamp, { 0, 0, 0 }, f)
    ask()
    return function() return clamp:release() end
  end,
  ["a motion while a snapshot is restored"] = function(scene, _, clamp, f)
    local ask = ask_later(clamp, { 0, 0, 0 }, f)
    local snapshot = scene:snapshot()
    ask()
    return function() return scene:restore(snapshot) end
  end,
  ["a motion that begins"] = function(_, _, clamp, f)
    return function()
      return clamp:follow(function(t)
        f(t)
        return { 0, 0, 0 }
      end)
    end
  end,
}

-- These call the function only once.
local once = { ["a motion that is asked where it is"] = true, ["a force that is evaluated"] = true }

local names = {}
for name in pairs(ways) do names[#names + 1] = name end
table.sort(names)

-- Calls that change the scene or use its work space.
local function changes(scene, wire, clamp)
  local box = scene:obstacle{ shape = "sphere", radius = 0.1, at = { 0, 0, -9 } }
  local drag, snapshot = scene:force{ kind = "drag" }, scene:snapshot()
  local left = scene:gripper{ name = "left" }
  return {
    close = function() scene:close() end,
    gc = function() getmetatable(scene).__gc(scene) end,
    wire = function()
      scene:wire{ E = 1e8, density = 1e3, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    end,
    clamp = function() scene:clamp(wire, { s = 0.7 }) end,
    pin = function() scene:pin(wire, { s = 0.7 }) end,
    grip = function() scene:grip(wire, { s = 0.7, width = 0.02 }) end,
    release = function() clamp:release() end,
    pose = function() clamp:pose{ 0, 0, 1 } end,
    follow = function() clamp:follow(nil) end,
    obstacle = function() scene:obstacle{ shape = "plane", at = { 0, 0, -9 } } end,
    obstacle_pose = function() box:pose{ 0, 0, -8 } end,
    obstacle_follow = function() box:follow(nil) end,
    remove = function() box:remove() end,
    force = function() scene:force{ kind = "drag" } end,
    force_function = function() scene:force{ kind = print } end,
    force_release = function() drag:release() end,
    gravity = function() scene:gravity{ 0, 0, 0 } end,
    run = function() scene:run{ duration = 0.1 } end,
    advance = function() scene:advance({}, 10) end,
    settle = function() scene:settle() end,
    take_snapshot = function() scene:snapshot() end,
    restore = function() scene:restore(snapshot) end,
    clear_frames = function() scene:clear_frames() end,
    set_velocity = function() wire:set_velocity{ 1, 0, 0 } end,
    process = function() scene:process(print) end,
    gripper = function() scene:gripper{} end,
    grasp = function() left:grasp(wire, { s = 0.7 }) end,
    evaluate = function() scene:evaluate(wire) end,
    energy = function() scene:energy() end,
    position = function() wire:position(0.5) end,
    positions = function() wire:positions() end,
    max_tension = function() wire:max_tension() end,
    stable_dt = function() scene:stable_dt() end,
  }
end

-- Calls that are allowed at any time.
local function questions(scene, wire, clamp)
  return { function() return scene.time end, function() return scene.name end,
    function() return tostring(scene) end, function() return wire.length end,
    function() return wire.segments end, function() return tostring(wire) end,
    function() return clamp:force() end, function() return tostring(clamp) end,
    function() return clamp:log() end, function() return scene:gravity() end,
    function() return scene:contacts() end, function() return scene:penetration() end,
    function() return scene:frame_count() end, function() return scene:frame(1) end,
    function() return clamp.held end, function() return wire.name end }
end

for _, name in ipairs(names) do
  describe(name, function()
    it("refuses every change, and the scene still works", function()
      local things = changes(make())
      for change in pairs(things) do
        local scene, wire, clamp = make()
        local act = changes(scene, wire, clamp)[change]
        local ok, message, calls = true, nil, 0
        local go = ways[name](scene, wire, clamp, function()
          calls = calls + 1
          if calls == 2 or once[name] then ok, message = pcall(act) end
        end)
        go()
        assert.is_false(ok, change .. " was allowed, or never tried")
        assert.is_truthy(message:find("from inside a step", 1, true), change .. ": " .. message)
        assert.is_true(scene:run{ duration = 0.01 }.ok)
        scene:close()
      end
    end)

    it("may read what is known", function()
      local scene, wire, clamp = make()
      local ok, message, calls = nil, nil, 0
      local go = ways[name](scene, wire, clamp, function()
        calls = calls + 1
        for _, ask in ipairs(questions(scene, wire, clamp)) do
          ok, message = pcall(ask)
          assert.is_true(ok, message)
        end
      end)
      go()
      assert.is_true(calls > 0)
    end)

    it("passes errors on unchanged, and the scene still works", function()
      local values = { { code = 7 }, "text", 42, print, true, setmetatable({}, { __tostring = error }) }
      for _, value in ipairs(values) do
        for call = 1, 3 do
          local scene, wire, clamp = make()
          local count, failing = 0, true
          local go = ways[name](scene, wire, clamp, function()
            count = count + 1
            if failing and count == call then error(value, 0) end
          end)
          local ok, got = pcall(go)
          if not ok then assert.is_true(rawequal(value, got)) end
          assert.is_true(count < call or not ok)
          failing = false
          clamp:follow(nil)
          assert.is_true(scene:run{ duration = 0.01 }.ok)
          scene:close()
        end
      end
    end)

    it("gives the line of the function that failed", function()
      local scene, wire, clamp = make()
      local line
      local go = ways[name](scene, wire, clamp, function()
        line = debug.getinfo(1, "l").currentline + 1
        return nil + 1
      end)
      local ok, message = pcall(go)
      assert.is_false(ok)
      assert.is_truthy(message:find("callbacks_spec.lua:" .. line .. ":", 1, true), message)
    end)

    it("cannot yield", function()
      local scene, wire, clamp = make()
      local yield = true
      local go = ways[name](scene, wire, clamp, function()
        if yield then coroutine.yield() end
      end)
      local thread = coroutine.create(go)
      local ok, message = coroutine.resume(thread)
      assert.is_false(ok)
      assert.matches("must not yield or wait: it is called within a step", tostring(message))
      yield = false
      assert.is_true(scene:run{ duration = 0.01 }.ok)
    end)

    it("may run another scene", function()
      local scene, wire, clamp = make()
      local inner, inner_wire = make()
      inner:force{ kind = function(_, _, _, f) f[3] = f[3] + 0.01 end, on = inner_wire }
      local busy = false
      local go = ways[name](scene, wire, clamp, function()
        if busy then return end
        busy = true
        assert.is_true(inner:run{ duration = 0.02 }.ok)
        busy = false
      end)
      go()
      assert.is_true(inner.time > 0)
      assert.is_true(scene:run{ duration = 0.01 }.ok)
    end)
  end)
end

describe("a snapshot", function()
  it("may be forgotten in a step, but not closed while it is restored", function()
    local scene, _, clamp = make()
    local before = scene:snapshot()
    local message
    clamp:follow(function()
      if before then message = select(2, pcall(before.close, before)) end
      collectgarbage()
      return { 0, 0, 0 }
    end)
    local after = scene:snapshot()
    before:close()
    before = after
    scene:restore(after)
    assert.is_truthy(tostring(message):find "cannot be closed")
    before = nil
    for _ = 1, 3 do scene:snapshot() end
    assert.is_true(scene:run{ duration = 0.02 }.ok)
  end)
end)

describe("a function as a force", function()
  local function fails(force, text)
    for _, run in ipairs{ function(s) return s:run{ duration = 0.02 } end, function(s) return s:settle() end,
      function(s) return s:run{ duration = 0.001, dt = 0.001, integrator = "velocity-verlet" } end } do
      local scene, wire = make()
      local handle = scene:force{ kind = force, on = wire }
      local ok, message = pcall(run, scene)
      assert.is_false(ok)
      assert.is_truthy(message:find(text, 1, true), message)
      handle:release()
      assert.is_true(scene:run{ duration = 0.01 }.ok)
    end
  end

  it("must set finite numbers", function()
    fails(function(_, _, _, f) f[4] = 0 / 0 end, "component 1 of the force on node 2")
    fails(function(_, _, _, f) f[6] = math.huge end, "component 3 of the force on node 2")
    fails(function(_, _, _, f) f[5] = "12" end, "component 2 of the force on node 2")
    fails(function(_, _, _, f) f[5] = nil end, "component 2 of the force on node 2")
    fails(function(_, _, _, f) f[22] = 1 end, "f must keep its 21 items, three for each node; it has 22")
    fails(function(_, x) x[1].y = 1 end, "index a number value")
  end)

  it("may push so hard that the run diverges", function()
    local scene, wire = make()
    scene:force{ kind = function(_, _, _, f) for i = 1, #f do f[i] = 1e300 end end, on = wire }
    local before = scene:snapshot()
    local run = scene:run{ duration = 1 }
    assert.is_false(run.ok)
    assert.has_error(function() wire:position(0) end)
    scene:restore(before)
    assert.are.same({ 0, 0, 0 }, wire:position(0))
  end)

  it("sees each wire with its own nodes", function()
    local scene = make()
    scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 2,
      from = { 0, 1, 0 }, to = { 1, 1, 0 } }
    local sizes = {}
    scene:force{ kind = function(_, x, v, f)
      sizes[#x] = true
      assert(#x == #v and #x == #f)
    end }
    local before = scene:snapshot()
    scene:clamp(core.data(scene).wires[1].object, { s = 0.9123 })
    scene:run{ duration = 0.02 }
    scene:restore(before)
    scene:run{ duration = 0.02 }
    assert.is_true(sizes[9])
    assert.is_true(sizes[21])
  end)
end)

-- A force is added to the array f. A function that returns it, as functions of motion do, would do nothing.
describe("a force function", function()
  local function scene_with(f)
    local scene, wire = make()
    scene:force{ kind = f, on = wire }
    return scene
  end

  it("must not return a force, but may return its array", function()
    local scene = scene_with(function() return { 0, 0, 1 } end)
    local fine, why = pcall(scene.run, scene, { duration = 0.02 })
    assert.is_false(fine)
    assert.truthy(why:find("^[^\n]*callbacks_spec.lua:%d+: force function: it returned table, which is not "
      .. "used; add the force %[N%] to its fourth argument"), why)
    assert.is_true(scene_with(function(_, _, _, f) return f end):run{ duration = 0.02 }.ok)
    assert.is_true(scene_with(function() return nil end):run{ duration = 0.02 }.ok)
  end)

  it("is named by its line where its forces are wrong", function()
    local line = debug.getinfo(1, "l").currentline + 1
    local scene = scene_with(function(_, _, _, f) f[2] = 0 / 0 end)
    local _, why = pcall(scene.run, scene, { duration = 0.02 })
    assert.truthy(why:find(("callbacks_spec.lua:%d: force function: component 2 of the force on node 1 is ")
      :format(line), 1, true), why)
  end)
end)

describe("a process that waits without an end", function()
  it("is told so, at once or after time has passed; waits of 0 s between are allowed", function()
    for _, first in ipairs{ 0, 0.01 } do
      local scene = make()
      scene:process(function(p)
        p:wait(first)
        while true do p:wait(0) end
      end)
      local fine, why = pcall(scene.run, scene, { duration = 0.02 })
      assert.is_false(fine)
      assert.truthy(why:find("p:wait: seconds = 0 s was waited for 100000 times at t = " .. first .. " s, "
        .. "and no time passes", 1, true), why)
    end
    local scene, count = make(), 0
    scene:process(function(p)
      for _ = 1, 3 do
        for _ = 1, 5e4 do p:wait(0) end
        count = count + 1
        p:wait(1e-3)
      end
    end)
    assert.is_true(scene:run{}.ok)
    assert.equal(3, count)
  end)
end)
