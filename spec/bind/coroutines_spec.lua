-- SPDX-License-Identifier: GPL-3.0-or-later
-- Callbacks within runs, processes and coroutines.
local sw = require "softworld"
local cantilever = require "spec.bind.cantilever"

local make = cantilever.make

describe("runs, processes and coroutines", function()
  it("may be started in a coroutine", function()
    local scene, wire = make()
    local calls = 0
    scene:force{ kind = function() calls = calls + 1 end, on = wire }
    local run = coroutine.wrap(function() return scene:run{ duration = 0.02 } end)()
    assert.is_true(run.ok)
    assert.is_true(calls > 0)
    local settled = coroutine.wrap(function() return scene:settle() end)()
    assert.is_true(settled.ok)
  end)

  it("cannot be nested in one scene", function()
    local scene = make()
    scene:process(function() scene:run{ duration = 1 } end)
    local ok, message = pcall(scene.run, scene, { duration = 1 })
    assert.is_false(ok)
    assert.is_truthy(message:find("under way", 1, true), message)
    local snapshot = scene:snapshot()
    scene:process(function() scene:restore(snapshot) end)
    ok, message = pcall(scene.run, scene, { duration = 1 })
    assert.is_false(ok)
    assert.is_truthy(message:find("under way", 1, true), message)
    assert.is_true(scene:run{ duration = 0.01 }.ok)
  end)

  it("may settle, hold and release between steps", function()
    local scene, wire, clamp = make()
    scene:process(function(p)
      p:wait(0.05)
      scene:settle()
      local other = scene:clamp(wire, { s = 1 })
      clamp:release()
      p:wait(0.05)
      other:release()
    end)
    local run = scene:run()
    assert.is_true(run.ok)
    assert.is_true(math.abs(scene.time - 0.1) < 1e-12)
  end)

  it("pass errors of processes and conditions on unchanged", function()
    for _, value in ipairs{ { 1 }, "text", 42, print } do
      for _, body in ipairs{
        function() error(value, 0) end,
        function(p)
          p:wait(0.02)
          error(value, 0)
        end,
        function(p) p:wait_until(function() error(value, 0) end) end,
        function(p)
          p:wait_until(function()
            if p.scene.time > 0.02 then error(value, 0) end
          end)
        end,
      } do
        local scene = make()
        local process = scene:process(body)
        local ok, got = pcall(scene.run, scene)
        assert.is_false(ok)
        assert.is_true(rawequal(value, got))
        assert.is_truthy(tostring(process):find "failed")
        assert.is_truthy(process.traceback:find "coroutines_spec.lua")
        local run = scene:run{ duration = 0.01 }
        assert.is_true(run.ok)
      end
    end
  end)

  it("check the arguments of their waits", function()
    for _, body in ipairs{
      function(p) p:wait(-1) end, function(p) p:wait(0 / 0) end, function(p) p:wait() end,
      function(p) p:wait(math.huge) end, function(p) p:wait_until(3) end,
      function(p) p:wait_until(print, 3) end, function(p) p:wait_until(print, { timeuot = 3 }) end,
      function(p) p:wait_until(print, { timeout = -3 }) end,
      function(p) coroutine.wrap(function() p:wait(1) end)() end,
    } do
      local scene = make()
      scene:process(body)
      local ok, message = pcall(scene.run, scene)
      assert.is_false(ok)
      assert.is_truthy(message:find("p:wait", 1, true), message)
    end
    local scene = make()
    local p = scene:process(function() end)
    assert.has_error(function() p:wait(1) end)
  end)

  it("go on step by step when a process yields by itself", function()
    local scene = make()
    local times = {}
    scene:process(function()
      for _ = 1, 3 do
        times[#times + 1] = scene.time
        coroutine.yield()
      end
    end)
    scene:run{ dt = 0.01 }
    assert.are.equal(3, #times)
    assert.is_true(math.abs(times[3] - 0.02) < 1e-12)
  end)

  it("end although their times differ from the run's by rounding", function()
    local scene = make()
    scene:process(function(p) p:wait(1 - 5e-13) end)
    assert.is_true(scene:run{ duration = 1, dt = 0.5 }.ok)
    scene:process(function(p) for _ = 1, 30 do p:wait(0.1) end end)
    assert.is_true(scene:run{ duration = 3, dt = 0.5 }.ok)
  end)

  it("start new processes from processes", function()
    local scene = make()
    local seen = {}
    scene:process(function(p)
      p:wait(0.02)
      scene:process(function(q)
        q:wait(0.02)
        seen[#seen + 1] = scene.time
      end)
    end)
    scene:run()
    assert.is_true(math.abs(seen[1] - 0.04) < 1e-12)
  end)

  it("wait for conditions with and without a timeout", function()
    local scene = make()
    local answers = {}
    scene:process(function(p)
      answers[1] = p:wait_until(function() return scene.time > 0.035 end)
      answers[2] = p:wait_until(function() return false end, { timeout = 0.05 })
      answers[3] = p:wait_until(function() return true end, { timeout = 0 })
    end)
    scene:run{ dt = 0.01 }
    assert.are.same({ true, false, true }, answers)
    assert.is_true(math.abs(scene.time - 0.09) < 1e-9)
  end)

  it("name the line of a process that called the library wrongly", function()
    local scene = sw.scene{}
    local wire = scene:wire{ E = 1e8, density = 1400, radius = 0.002, from = { 0, 0, 0 },
      to = { 1, 0, 0 } }
    local gripper = scene:gripper{ name = "g" }
    local line
    scene:process(function()
      gripper:grasp(wire, { s = 0.1 })
      line = debug.getinfo(1, "l").currentline + 1
      gripper:move{ path = "there is no such file.csv", speed = 0.1 }
    end)
    local _, message = pcall(scene.run, scene)
    assert.matches("coroutines_spec%.lua:" .. line .. ": ", message)
    assert.matches("there is no such file%.csv", message)
  end)
end)
