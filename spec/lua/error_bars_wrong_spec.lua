-- SPDX-License-Identifier: GPL-3.0-or-later
-- Error bars: errors during the computation, wrong requests, memory.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local cantilever = require "spec.lua.cantilever"

local make = cantilever.make
local core = sw.core

local function state(scene, wire)
  local x, s = wire:positions()
  return { x = x, s = s, v = wire:velocities(), e = scene:energy().total, t = scene.time }
end

describe("an error in a computation with error bars", function()
  -- After the error the scene is as before: it runs to the same bits as a scene that was never asked.
  local function check(disturb, message)
    local function build_scene()
      local scene, wire, clamp = make(16)
      t.fine(scene:run{ duration = 0.02 })
      local left = scene:gripper{ name = "left" }
      local calls = { count = 0 }
      scene:process(function(p)
        calls.count = calls.count + 1
        if calls.fail == calls.count then error(calls.message, 0) end
        left:grasp(wire, { s = 0.7 })
        left:move{ by = { 0, 0, 0.02 }, duration = 0.05 }
        p:wait(0.01)
      end)
      return scene, wire, left, calls, clamp
    end
    local scene, wire, left, calls = build_scene()
    local before, live = state(scene, wire), core.allocated()
    local ok, value = pcall(disturb, scene, wire, calls)
    assert.is_false(ok)
    if type(message) == "string" then assert.matches(message, tostring(value))
    else assert.are.equal(message, value) end
    assert.are.same(before, state(scene, wire))
    assert.is_nil(left.hold)
    assert.are.equal(0, left.peak_force)
    calls.fail = nil
    local plain, plain_wire, plain_left = build_scene()
    t.fine(plain:run())
    t.fine(scene:run())
    assert.are.same(state(plain, plain_wire), state(scene, wire))
    assert.are.equal(plain_left.peak_force, left.peak_force)
    assert.is_true(live > 0)
  end

  it("in a quantity's function leaves everything as it was", function()
    local mine = {}
    for level = 1, 3 do
      check(function(scene)
        local n = 0
        scene:run{ tolerance = { { name = "q", value = 1, of = function()
          n = n + 1
          if n == level then error(mine) end
          return n
        end } } }
      end, mine)
    end
  end)

  it("about a quantity that is no number leaves everything as it was", function()
    for value, text in pairs{ [0 / 1] = false, [print] = "function", [true] = "boolean", x = "string" } do
      if text then
        check(function(scene)
          scene:run{ tolerance = { { name = "q", value = 1, of = function() return value end } } }
        end, "quantity 'q': its function must return a number or a list of numbers, got " .. text)
      end
    end
    check(function(scene)
      scene:run{ tolerance = { { name = "q", value = 1, of = function() return 0 / 0 end } } }
    end, "got %-?nan")
  end)

  it("about a list that is no list of numbers leaves everything as it was", function()
    local endless = {}
    endless[1] = endless
    for says, value in pairs{ ["got nil as item 2"] = { 1, nil, 3 }, ["got nan as item 2"] = { 1, 0 / 0 },
      ["got an empty list"] = {}, ["got an empty list as item 1"] = { {} }, ["key 'x'"] = { 1, x = 2 },
      ["too many lists, one inside the other"] = endless, ["got string as item 1"] = { "1" } } do
      check(function(scene)
        scene:run{ tolerance = { { name = "q", value = 1, of = function() return value end } } }
      end, "quantity 'q': its function must return a number or a list of numbers, .*" .. says)
    end
  end)

  it("about a list whose length changes with the mesh leaves everything as it was", function()
    check(function(scene, wire)
      scene:run{ tolerance = { { name = "all", value = 1, of = function() return wire:positions() end } } }
    end, "quantity 'all': its list must have the same length on every mesh")
  end)

  it("in a process leaves everything as it was", function()
    check(function(scene, _, calls)
      calls.fail, calls.message = 2, "broken"
      scene:run{ tolerance = { tip = 1e-3 } }
    end, "broken")
  end)

  it("in settling leaves everything as it was", function()
    check(function(scene)
      scene:settle{ tolerance = { { name = "q", value = 1, of = function() error "no" end } } }
    end, "no")
  end)
end)

describe("a wrong request for error bars", function()
  local function refused(method, args, ...)
    local scene, wire = make()
    local before = state(scene, wire)
    local ok, message = pcall(scene[method], scene, args)
    assert.is_false(ok)
    for _, word in ipairs{ ... } do
      assert.is_truthy(message:find(word, 1, true), ("'%s' is not in: %s"):format(word, message))
    end
    assert.are.same(before, state(scene, wire))
  end

  local function value() return 1 end

  it("is refused with names, values, units and the nearest word", function()
    for _, method in ipairs{ "settle", "run" } do
      local what = "scene:" .. method .. ": tolerance"
      local function bad(tolerance, ...) refused(method, { tolerance = tolerance, duration =
        method == "run" and 0.1 or nil }, what, ...) end
      bad({}, "names no quantity")
      bad({ tipp = 1 }, "'tipp'", "did you mean 'tip'?")
      bad({ ["wire1.max_tensoin"] = 1 }, "did you mean 'wire1.max_tension'?")
      bad({ elephant = 1 }, "known are:", "min_bend_radius")
      bad({ tip = -1 }, "tip = -1 m", "above 0 m")
      bad({ tip = 0 }, "tip = 0")
      bad({ tip = 0 / 0 }, "tip = ", "nan")
      bad({ tip = 1 / 0 }, "tip = inf")
      bad({ tip = "small" }, "tip = small", "number")
      bad({ max_tension = {} }, "above 0 N")
      bad({ [1.5] = 1 }, "1.5")
      bad({ [true] = 1 }, "true")
      bad({ 7 }, "quantity 1", "got number")
      bad({ { name = "q", value = 1 } }, "quantity 1", "of is missing")
      bad({ { value = 1, of = value } }, "name is missing")
      bad({ { name = "q", of = value } }, "value is missing")
      bad({ { name = "q", value = 1, of = value, units = "m" } }, "'units'", "did you mean 'unit'?")
      bad({ { name = "q", value = 1, of = 3 } }, "of must be a function, got number")
      bad({ { name = 1, value = 1, of = value } }, "name must be a string")
      bad({ { name = "q", value = 1, of = value, at = -1 } }, "at = -1 s")
      bad({ { name = "tip", value = 1, of = value }, tip = 1 }, "'tip' is asked for twice")
    end
    refused("settle", { tolerance = { tip = 1 }, levels = 2 }, "levels = 2", "from 3 to 12")
    refused("settle", { tolerance = { tip = 1 }, levels = 3.5 }, "levels = 3.5")
    refused("settle", { tolerance = { { name = "q", value = 1, of = value, at = 1 } } },
      "'q'", "a time of a run, and settling has none")
    refused("settle", { tolerance = { tip = 1 }, iterations = 3 }, "'iterations'")
    refused("run", { tolerance = { tip = 1 }, duration = 0.1, levels = 100 }, "levels = 100")
    refused("run", { tolerance = { tip = 1 } }, "there is no process to run to its end")
    refused("run", { tolerance = { tip = 1 }, duration = -1 }, "duration = -1")
    refused("run", { tolerance = { tip = 1 }, duration = 1, max_steps = 3 }, "max_steps")
    refused("run", { tolerance = { { name = "q", value = 1, of = value, at = 2 } }, duration = 1 },
      "at = 2 s", "after the end of the run, 1 s")
    refused("run", { tolerance = { peak_force = 1 }, duration = 0.1 }, "no quantity 'peak_force'")
  end)

  it("is refused with the line of the script", function()
    local scene = make()
    local ok, message = pcall(function() return scene:settle{ tolerance = { tipp = 1 } } end)
    assert.is_false(ok)
    assert.matches("error_bars_wrong_spec.lua:%d+: scene:settle: tolerance: there is no", message)
  end)

  it("is refused with the candidates where a name is ambiguous", function()
    local scene, wire = make()
    scene:pin(wire, { s = 1 })
    local ok, message = pcall(scene.settle, scene, { tolerance = { force = 1 } })
    assert.is_false(ok)
    assert.matches("'force' may be any of: clamp1.force pin2.force", message)
    assert.is_true(scene:settle{ tolerance = { ["clamp1.force"] = 1 } }.ok)
  end)

  it("is refused while processes are under way, and inside them", function()
    local scene = make()
    local inner
    scene:process(function(p)
      inner = { pcall(scene.settle, scene, { tolerance = { tip = 1e-3 } }) }
      p:wait(0.1)
    end)
    t.fine(scene:run{ duration = 0.05 })
    assert.is_false(inner[1])
    assert.matches("is under way", inner[2])
    local ok, message = pcall(scene.run, scene, { tolerance = { tip = 1e-3 } })
    assert.is_false(ok)
    assert.matches("process 1 .* is under way and cannot begin again", message)
    t.fine(scene:run())
    assert.is_true(scene:run{ duration = 0.05, tolerance = { tip = 1e-2 } }.ok)
  end)

  it("is refused where a process makes wires", function()
    local scene, wire = make()
    scene:process(function(p)
      scene:wire{ EA = 1, EI = 1, mass_per_length = 1, radius = 0.1, from = { 0, 0, 1 }, to = { 1, 0, 1 },
        segments = 4 }
      p:wait(0.01)
    end)
    local ok, message = pcall(scene.run, scene, { tolerance = { ["wire1.tip"] = 1 } })
    assert.is_false(ok)
    assert.matches("wire 'wire2' was made during the run", message)
    assert.are.equal(1, wire.length)
  end)

  it("is refused without a wire", function()
    assert.has_error(function() sw.scene{}:settle{ tolerance = { energy = 1 } } end)
  end)

  it("is not meant by a plain number, which is the error of one step", function()
    local scene = make()
    local r = t.fine(scene:run{ duration = 0.05, tolerance = 1e-5 })
    assert.is_nil(r.quantities)
    assert.is_true(scene:settle{ tolerance = 1e-8 }.ok)
  end)
end)

describe("memory", function()
  it("does not grow with error bars", function()
    local scene, wire = make(8)
    local snapshot = scene:snapshot()
    local function loop(count)
      for _ = 1, count do
        scene:restore(snapshot)
        assert.is_true(scene:settle{ tolerance = { tip = 1 } }.ok)
        scene:process(function(p) p:wait(0.02) end)
        assert.is_true(scene:run{ tolerance = { tip = 1 }, frame = 1 }.ok)
      end
      scene:restore(snapshot)
      collectgarbage()
      collectgarbage()
      return (core.allocated())
    end
    loop(3)
    local bytes = loop(3)
    assert.are.equal(bytes, loop(100))
    assert.are.equal(8, wire.segments)
  end)
end)
