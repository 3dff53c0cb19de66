-- SPDX-License-Identifier: GPL-3.0-or-later
-- Life cycle of objects: closing, garbage collection, stale handles, objects of other scenes, names.
local sw = require "softworld"
local core = sw.core

local function make(options)
  local scene = sw.scene(options or {})
  local wire = scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 6,
    from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  return scene, wire
end

local function collect()
  collectgarbage()
  collectgarbage()
end

local function fails(text, f, ...)
  local ok, message = pcall(f, ...)
  assert.is_false(ok, "no error: " .. text)
  assert.is_truthy(tostring(message):find(text, 1, true), tostring(message))
  return message
end

describe("a closed scene", function()
  it("is reported by every method of everything that was in it", function()
    local scene, wire = make()
    local objects = { scene, wire, scene:clamp(wire, { s = 0 }), scene:obstacle{ shape = "plane" },
      scene:force{ kind = "drag", on = wire } }
    local left, snapshot = scene:gripper{}, scene:snapshot()
    scene:close()
    scene:close()
    for _, object in ipairs(objects) do
      local methods = core.class[core.type(object)]
      for name, method in pairs(methods) do
        if name ~= "close" and name ~= "gripper" and name ~= "process" then
          fails("closed", method, object, wire, {})
        end
      end
      assert.is_truthy(tostring(object):find "closed")
      assert.is_false(core.exists(object))
    end
    fails("closed", function() return scene.time end)
    fails("closed", function() return wire.length end)
    fails("closed", function() return wire.name end)
    fails("closed", scene.gripper, scene)
    fails("closed", scene.process, scene, print)
    fails("closed", left.grasp, left, wire, { s = 0.5 })
    snapshot:close()
    snapshot:close()
    assert.is_truthy(tostring(snapshot):find "closed")
  end)

  it("frees everything at once", function()
    collect()
    local before = core.allocated()
    local scene, wire = make()
    scene:clamp(wire, { s = 0 }):follow{ points = { { 0, 0, 0 }, { 0, 0, 1 } }, speed = 1 }
    scene:obstacle{ shape = "hull", points = { 0, 0, -9, 1, 0, -9, 0, 1, -9, 0, 0, -8 } }
    scene:run{ duration = 0.1 }
    local snapshot = scene:snapshot()
    assert.is_true(core.allocated() > before)
    scene:close()
    snapshot:close()
    collect() -- the shape handle that made the obstacle's drawing
    assert.are.equal(before, (core.allocated()))
  end)

  it("closes at the end of its block, also when an error leaves it", function()
    local kept
    do
      local scene <close> = sw.scene{}
      kept = scene
    end
    fails("closed", function() return kept.time end)
    pcall(function()
      local scene <close> = sw.scene{}
      kept = scene
      error "out"
    end)
    fails("closed", function() return kept.time end)
  end)
end)

describe("collecting garbage", function()
  it("keeps the scene while anything of it is in use", function()
    collect()
    local before = core.allocated()
    local kinds = {
      function(_, wire) return wire, function(w) return w.length end end,
      function(scene, wire) local c = scene:clamp(wire, { s = 0 }) return c, c.force end,
      function(scene) local o = scene:obstacle{ shape = "plane" } return o, o.force end,
      function(scene) local f = scene:force{ kind = "drag" } return f, f.release end,
      function(scene) return scene:snapshot(), tostring end,
      function(scene, wire)
        local g = scene:gripper{}
        g:grasp(wire, { s = 0.5 })
        return g, g.force
      end,
    }
    for _, kind in ipairs(kinds) do
      local function in_use()
        local object, use = kind(make())
        collect()
        use(object)
        assert.is_true(core.allocated() > before)
      end
      in_use()
      collect()
      assert.are.equal(before, (core.allocated()))
    end
  end)

  it("works in every order and in the middle of everything", function()
    collect()
    local before = core.allocated()
    for order = 1, 24 do
      local function everything()
        local scene, wire = make()
        return { scene, wire, scene:clamp(wire, { s = 0 }), scene:snapshot(),
          scene:obstacle{ shape = "plane", at = { 0, 0, -1 } },
          scene:force{ kind = function() collectgarbage "step" end } }
      end
      local all = everything()
      all[1]:run{ duration = 0.02 }
      local seed = order
      while next(all) do
        seed = seed * 48271 % 2147483647
        local keys = {}
        for k in pairs(all) do keys[#keys + 1] = k end
        table.sort(keys)
        all[keys[seed % #keys + 1]] = nil
        collectgarbage()
      end
      collect()
      assert.are.equal(before, (core.allocated()))
    end
  end)

  it("frees functions that no force needs", function()
    local scene, wire = make()
    local weak = setmetatable({}, { __mode = "v" })
    local function add()
      local big = { scene }
      weak[#weak + 1] = big
      return scene:force{ kind = function() return big end, on = wire }
    end
    local first = add()
    local snapshot = scene:snapshot()
    add()
    first:release()
    collect()
    assert.is_truthy(weak[1], "the snapshot may bring it back")
    scene:restore(snapshot)
    collect()
    assert.is_truthy(weak[1])
    assert.is_nil(weak[2], "made after the snapshot")
    snapshot:close()
    first:release()
    first:release()
    collect()
    assert.is_nil(weak[1])
  end)
end)

describe("handles", function()
  it("of released and removed objects say what became of them", function()
    local scene, wire = make()
    local clamp, box = scene:clamp(wire, { s = 0 }), scene:obstacle{ shape = "box", size = { 1, 1, 1 },
      at = { 0, 0, -5 } }
    scene:run{ duration = 0.02 }
    clamp:release()
    fails("has been released", clamp.force, clamp)
    fails("has been released", clamp.moment, clamp)
    fails("has been released", clamp.follow, clamp, nil)
    fails("has been released", clamp.pose, clamp, { 0, 0, 0 })
    assert.are.equal(2, select(2, clamp:log()))
    -- a log that starts after its end has one row, the last; a log without rows gives none
    local fresh = scene:clamp(wire, { s = 0.1 })
    for first, count in pairs{ [-5] = 2, [0.015] = 2, [0.03] = 1, [math.maxinteger] = 1, [math.huge] = 1,
      [math.mininteger] = 2 } do
      assert.are.equal(count, select(2, clamp:log(first)))
      assert.are.equal(0, select(2, fresh:log(first)))
    end
    box:remove()
    fails("no longer in scene", box.force, box)
    fails("no longer in scene", box.remove, box)
    fails("no longer in scene", box.follow, box, nil)
    fails("no longer in scene", function() return box.shape end)
    assert.are.equal(2, select(2, box:log()))
  end)

  it("of objects that a restored snapshot took back are stale, even if their index is used again", function()
    local scene, wire = make()
    local snapshot = scene:snapshot()
    local clamp, plane = scene:clamp(wire, { s = 0 }), scene:obstacle{ shape = "plane", at = { 0, 0, -9 } }
    local drag = scene:force{ kind = "drag", linear = 1 }
    scene:restore(snapshot)
    local other = scene:pin(wire, { s = 1, name = "other" })
    scene:obstacle{ shape = "plane", at = { 0, 0, -8 } }
    scene:force{ kind = "drag", linear = 2 }
    for _, object in ipairs{ clamp, plane, drag } do
      assert.is_false(core.exists(object))
      assert.is_truthy(tostring(object):find "taken back")
    end
    fails("no longer in scene", clamp.force, clamp)
    fails("no longer in scene", clamp.release, clamp)
    fails("no longer in scene", clamp.log, clamp)
    fails("no longer in scene", plane.pose, plane)
    fails("no longer in scene", plane.log, plane)
    fails("no longer in scene", drag.release, drag)
    assert.are.equal("other", other.name)
    assert.is_true(scene:run{ duration = 0.02 }.ok)
  end)

  it("stay valid while another snapshot has their object", function()
    local scene, wire = make()
    local first = scene:snapshot()
    local clamp = scene:clamp(wire, { s = 0 })
    scene:run{ duration = 0.05 }
    local second = scene:snapshot()
    local force = clamp:force()
    scene:restore(first)
    scene:clamp(wire, { s = 1 })
    scene:run{ duration = 0.02 }
    scene:restore(second)
    assert.are.same(force, clamp:force())
    assert.is_true(clamp.held)
    scene:restore(first)
    second:close()
    scene:restore(first)
    assert.is_false(core.exists(clamp))
  end)

  it("are equal to themselves only", function()
    local scene, wire = make()
    local wire2 = scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005,
      from = { 0, 1, 0 }, to = { 1, 1, 0 } }
    local a, b = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = 1 })
    assert.is_true(a == a and wire == wire)
    assert.is_false(a == b or wire == wire2 or a == wire or scene == make())
    local box = scene:obstacle{ shape = "sphere", radius = 1, at = { 0, 0, -5 } }
    assert.is_true(box.shape == box.shape)
  end)

  it("are refused by other scenes", function()
    local scene, wire = make()
    local other, other_wire = make()
    local clamp = other:clamp(other_wire, { s = 0 })
    fails("belongs to another scene", scene.clamp, scene, other_wire, { s = 0 })
    fails("belongs to another scene", scene.force, scene, { kind = "drag", on = other_wire })
    fails("belongs to another scene", scene.evaluate, scene, other_wire)
    fails("snapshot is of another scene", scene.restore, scene, other:snapshot())
    local left = scene:gripper{}
    fails("belongs to another scene", left.grasp, left, other_wire, { s = 0.5 })
    fails("wire", scene.clamp, scene, clamp, { s = 0 })
    other:close()
    fails("closed", scene.clamp, scene, other_wire, { s = 0 })
    assert.is_true(scene:run{ duration = 0.01 }.ok)
    assert.is_truthy(wire)
  end)

  it("survive misuse of their metatables", function()
    local scene, wire = make()
    local line = sw.trajectory{ points = { { 0, 0, 0 }, { 1, 0, 0 } }, speed = 1 }
    for _, object in ipairs{ scene, wire, scene:snapshot(), line, sw.shape{ shape = "plane" } } do
      local meta = getmetatable(object)
      for _, wrong in ipairs{ {}, 12, "x", io.stdout, wire } do
        for name, method in pairs(meta) do
          if type(method) == "function" and not (wrong == wire and name == "__gc") then
            pcall(method, wrong, "length")
          end
        end
      end
      local fake = setmetatable({}, meta)
      tostring(fake)
      assert.is_false(pcall(function() return fake:snapshot() end))
      assert.is_false(fake == object)
    end
    collect()
    assert.are.equal(1, wire.length)
    assert.is_false(pcall(core.data, {}))
    assert.is_false(pcall(core.data, io.stdout))
    assert.is_nil(core.type(io.stdout))
    assert.is_nil(core.type(nil))
  end)

  it("are completed at the prompt and describe themselves", function()
    local repl = require "softworld.prompt.repl"
    local scene, wire = make{ name = "bench" }
    local globals = { scene = scene, wire = wire, clamp = scene:clamp(wire, { s = 0 }),
      left = scene:gripper{ name = "left" } }
    assert.are.same({ "snapshot" }, repl.complete("scene:", "sna", globals))
    assert.are.same({ "length" }, repl.complete("wire.", "len", globals))
    assert.are.same({ "name" }, repl.complete("clamp.", "na", globals))
    assert.are.same({ "peak_force", "peak_margin", "peak_moment" }, repl.complete("left.", "peak", globals))
    assert.are.equal("scene 'bench' at t = 0 s", tostring(scene))
    assert.are.equal("wire 'wire1': 1 m, 6 segments, t = 0 s", tostring(wire))
    assert.is_truthy(tostring(globals.clamp):find "^clamp 'clamp1': force")
    assert.are.equal("wire1", wire.name)
    assert.are.equal("snapshot at t = 0 s", tostring(scene:snapshot()))
    assert.is_truthy(tostring(scene:force{ kind = "drag" }):find "^force drag")
    assert.is_truthy(tostring(scene:obstacle{ shape = "box", size = { 1, 1, 1 }, at = { 9, 9, 9 } })
      :find "^box 'box1': force on it")
  end)
end)

describe("names", function()
  it("must be unique within a scene", function()
    local scene, wire = make()
    fails("already has something named 'wire1'", scene.obstacle, scene, { shape = "plane", name = "wire1" })
    scene:clamp(wire, { s = 0, name = "pin1" })
    assert.are.equal("pin2", scene:pin(wire, { s = 1 }).name)
    fails("already", scene.clamp, scene, wire, { s = 0.5, name = "pin1" })
    fails("already", scene.gripper, scene, { name = "pin1" })
    local snapshot = scene:snapshot()
    scene:clamp(wire, { s = 0.5, name = "again" })
    scene:restore(snapshot)
    scene:clamp(wire, { s = 0.5, name = "again" })
  end)
end)

-- A process, an observer's change and a condition are called between two steps, where the core allows it.
describe("closing a scene during its run", function()
  local lib = require "softworld"
  local ways = {
    ["in a process"] = function(scene, close)
      scene:process(function(p)
        p:wait(0.01)
        close()
        p:wait(0.01)
      end)
    end,
    ["in a change of an observer"] = function(scene, close)
      scene:observe{ every = 0.01, call = function(observer)
        if observer.calls == 1 then observer:change(close) end
      end }
      scene:process(function(p) p:wait(0.05) end)
    end,
    ["in a condition"] = function(scene, close)
      scene:process(function(p)
        p:wait_until(function()
          close()
          return true
        end)
      end)
    end,
  }
  for name, way in pairs(ways) do
    it("is refused " .. name .. ", and the run goes on", function()
      local scene = lib.scene{ name = "kept" }
      local wire = scene:wire{ E = 1e7, density = 1000, radius = 0.003, segments = 6, from = { 0, 0, 0 },
        to = { 0.3, 0, 0 } }
      local why, calls = nil, 0
      way(scene, function()
        calls = calls + 1
        why = select(2, pcall(function() scene:close() end))
      end)
      assert.is_true(scene:run{ dt = 0.005 }.ok)
      assert.are.equal(1, calls)
      assert.matches("life_spec.lua:%d+: scene:close: a run of scene 'kept' is under way", why)
      assert.are.equal(6, wire.segments)
      scene:close()
      scene:close() -- and twice, as any scene
      assert.has_error(function() return wire.segments end)
    end)
  end
end)

describe("an observer that changes its scene", function()
  it("is told what to use instead, by every method", function()
    local scene = require "softworld".scene{}
    local wire = scene:wire{ E = 1e7, density = 1000, radius = 0.003, segments = 6, from = { 0, 0, 0 },
      to = { 0.3, 0, 0 } }
    local said = {}
    scene:observe{ every = 0.01, call = function()
      for name, change in pairs{
        settle = function() scene:settle() end,
        remove = function() scene:remove(wire) end,
        set = function() scene:set{ gravity = { 0, 0, 0 } } end,
        contact = function() scene:wire_contact{} end,
        remodel = function() wire:remodel{ model = "string" } end,
        gripper = function() scene:gripper{} end,
      } do
        said[name] = select(2, pcall(change))
      end
    end }
    assert.is_true(scene:run{ duration = 0.02 }.ok)
    for _, name in ipairs{ "settle", "remove", "set", "contact", "remodel", "gripper" } do
      assert.matches("use observer:change(function() ... end)", said[name], 1, true)
    end
  end)
end)
