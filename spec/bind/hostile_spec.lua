-- SPDX-License-Identifier: GPL-3.0-or-later
-- Calls that could go on for ever: each ends, with a result or with a reason.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = require "softworld.core"

local function make(args)
  local scene = sw.scene{}
  local given = { EA = 6000, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 20,
    from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  for key, value in pairs(args or {}) do given[key] = value end
  local wire = scene:wire(given)
  scene:clamp(wire, { s = 0 })
  return scene, wire
end

local function refused(words, f, ...)
  local ok, message = pcall(f, ...)
  assert.is_false(ok)
  for _, word in ipairs(words) do assert.is_truthy(message:find(word, 1, true), message) end
end

describe("the time of a run", function()
  it("has at most one frame a step, however close the frames are to be", function()
    for _, frame in ipairs{ 1e-12, 1e-300, 1e-3 } do
      local scene = make()
      local run = scene:run{ duration = 0.1, dt = 0.01, frame = frame }
      assert.is_true(run.ok)
      assert.equal(11, #run:frames())
    end
    local scene = make()
    assert.equal(6, #scene:run{ duration = 0.1, dt = 0.01, frame = 0.02 }:frames())
    assert.equal(11, #scene:run{ duration = 0.1, dt = 0.01, frame = 0.02 }:frames())
  end)

  it("is refused where its steps are below the clock's resolution", function()
    for _, more in ipairs{ {}, { quasistatic = true }, { tolerance = 1e-6 }, { integrator = "rk4" } } do
      for _, dt in ipairs{ 1e-300, 1e-30, 1e-17 } do
        local scene = make()
        local args = { duration = 0.1, dt = dt }
        for key, value in pairs(more) do args[key] = value end
        refused({ ("dt = %g s"):format(dt), "at least" }, scene.run, scene, args)
        assert.equal(0, scene.time)
        assert.is_true(scene:run{ duration = 0.01 }.ok) -- it goes on
      end
    end
    local scene = make()
    scene:process(function(p) p:wait_until(function() return false end) end)
    refused({ "dt = 1e-300 s" }, scene.run, scene, { dt = 1e-300 })
  end)

  it("may be zero or almost zero", function()
    local scene = make()
    for _, duration in ipairs{ 5e-324, 1e-300, 1e-17, 0 } do
      assert.is_true(scene:run{ duration = duration }.ok)
    end
    scene:process(function(p)
      for _ = 1, 10 do p:wait(1e-300) p:wait(5e-324) end
      p:wait(0.05)
      p:wait(1e-17)
    end)
    assert.is_true(scene:run{}.ok)
    assert.is_true(math.abs(scene.time - 0.05) < 1e-12)
  end)

  it("stops at a tolerance that no step can meet", function()
    local scene = make()
    local run = scene:run{ duration = 0.1, dt = 1e-3, tolerance = 1e-300 }
    assert.is_false(run.ok)
    assert.matches("tolerance", run.reason)
  end)
end)

describe("p:wait_until", function()
  -- Returns a function that runs the scene; a process waits there for the condition that `of` gives.
  local function wait(of)
    local scene, wire = make()
    local condition, act = of(scene, wire)
    scene:process(function(p) p:wait_until(condition) end)
    if act then scene:process(act) end
    return function() return scene:run{ max_steps = 40 } end
  end

  it("is reported at the run's end if its condition has not come, with line and time", function()
    local line = debug.getinfo(1, "l").currentline + 2
    local function never(p)
      p:wait_until(function() return false end)
    end
    local scene = make()
    scene:process(function(p)
      p:wait(0.02)
      never(p)
    end)
    local run = scene:run{ duration = 0.1 }
    assert.is_true(run.ok)
    assert.equal(1, #run.events)
    local event = run.events[1]
    assert.equal("waiting", event.kind)
    assert.equal("process 1", event.object)
    assert.is_truthy(event.text:find(("hostile_spec.lua:%d since t = 0.02 s"):format(line), 1, true),
      event.text)
    assert.is_true(math.abs(event.value - 0.08) < 1e-9)
  end)

  it("is reported while it goes on, first after 10 s and then after 100 s", function()
    local scene = make()
    scene:process(function(p) p:wait_until(function() return scene.time > 120 end) end)
    local run = scene:run{ dt = 0.5, quasistatic = true }
    assert.is_true(run.ok)
    assert.equal(2, #run.events)
    assert.is_true(math.abs(run.events[1].time - 10) < 1)
    assert.is_true(math.abs(run.events[2].time - 100) < 1)
  end)

  it("is not reported if there is a timeout or the condition comes", function()
    local scene = make()
    scene:process(function(p)
      p:wait_until(function() return scene.time > 0.03 end)
      p:wait_until(function() return false end, { timeout = 0.02 })
    end)
    assert.equal(0, #scene:run{}.events)
  end)

  it("raises an error for conditions that can never come true", function()
    local cases = {
      ["holds nothing"] = function(scene) return { force = 1, on = scene:gripper{} } end,
      ["no pads"] = function(scene) return { slip = 1, on = scene:gripper{} } end,
      ["two points"] = function() return { distance = 1, between = { { 0, 0, 0 }, { 0, 0, 2 } } } end,
      ["of another scene"] = function()
        return { contact = sw.scene{}:obstacle{ shape = "plane", at = { 0, 0, -1 } } }
      end,
      ["released"] = function(scene, wire)
        local clamp = scene:clamp(wire, { s = 0.5 })
        clamp:release()
        return { force = 1, on = clamp }
      end,
      ["no longer in scene"] = function(scene)
        local wall = scene:obstacle{ shape = "plane", at = { 0, 0, -1 } }
        wall:remove()
        return { contact = wall }
      end,
    }
    for text, of in pairs(cases) do
      refused({ text }, wait(of))
    end
  end)

  it("waits for a gripper that another process lets grasp", function()
    local go = wait(function(scene, wire)
      local g = scene:gripper{}
      return { force = 1e-3, on = g }, function(p)
        p:wait(0.05)
        g:grasp(wire, { s = 0.5 })
      end
    end)
    assert.equal("all processes have ended", go().reason)
  end)
end)

-- Absurd values: a parameter takes them or refuses them with a text, and whatever is made of them ends.
describe("absurd numbers", function()
  local values = { 1e300, 1e-300, 1e-160, 1e15, -1e300, -1e-300, 2 ^ 53, 2 ^ 63 }

  local function try(f)
    local ok, result = pcall(f)
    if not ok then
      assert.is_true(type(result) == "string" and #result > 10)
      assert.is_nil(result:find("memory", 1, true), result)
    end
  end

  local function numbers_of(...)
    local list = {}
    for _, name in ipairs{ ... } do
      for _, row in ipairs(core.registry().params[name]) do
        if row.type == "number" or row.type == "integer" then list[#list + 1] = row.name end
      end
    end
    return list
  end

  it("of a wire", function()
    local count = 0
    for _, key in ipairs(numbers_of("wire", "section")) do
      for _, value in ipairs(values) do
        try(function()
          local base = key == "E" or key == "nu" or key == "density"
          local args = { from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 10, radius = 0.005 }
          if base then args.E, args.density = 1e9, 1000
          else args.EA, args.EI, args.mass_per_length = 6000, 0.02, 0.1 end
          args[key] = value
          local scene = sw.scene{}
          scene:clamp(scene:wire(args), { s = 0 })
          scene:run{ duration = 0.02, dt = 0.01, max_steps = 2 }
          scene:settle{ max_iterations = 20 }
        end)
        count = count + 1
      end
    end
    assert.is_true(count > 80)
  end)

  it("of a run, of settling and of frequencies", function()
    for name, method in pairs{ run = "run", settle = "settle", frequencies = "frequencies" } do
      for _, key in ipairs(numbers_of(name)) do
        for _, value in ipairs(values) do
          try(function()
            local scene, wire = make{ segments = 6 }
            local args = name == "run" and { duration = 0.02, dt = 0.01, max_steps = 3 }
              or name == "settle" and { max_iterations = 30 } or { modes = 2 }
            args[key] = value
            if key == "max_steps" or key == "max_iterations" then args.duration = 0.02 end
            if name == "settle" then args.duration = nil end
            if name == "frequencies" then
              scene:settle()
              return wire[method](wire, args)
            end
            return scene[method](scene, args)
          end)
        end
      end
    end
  end)

  it("of places: holds, joins, obstacles", function()
    for _, value in ipairs(values) do
      try(function()
        local scene, wire = make()
        scene:clamp(wire, { s = value })
      end)
      try(function()
        local scene, wire = make()
        scene:grip(wire, { s = 0.5, width = value })
        scene:run{ duration = 0.02, max_steps = 2 }
      end)
      try(function()
        local scene = make()
        scene:obstacle{ shape = "box", size = { value, 1, 1 }, at = { 0, 0, -1 } }
        scene:run{ duration = 0.02, max_steps = 2 }
      end)
      try(function()
        local scene = make()
        scene:obstacle{ shape = "plane", at = { 0, 0, value } }
        scene:run{ duration = 0.02, max_steps = 2 }
      end)
      try(function()
        local scene, wire = make{ from = { value, 0, 0 }, to = { value, 1, 0 } }
        scene:run{ duration = 0.02, max_steps = 2 }
        wire:position(0.5)
      end)
      try(function()
        local scene = sw.scene{ gravity = { 0, 0, value } }
        scene:wire{ EA = 6000, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 6,
          from = { 0, 0, 0 }, to = { 1, 0, 0 } }
        scene:run{ duration = 0.02, max_steps = 2 }
      end)
    end
  end)
end)

describe("absurd counts", function()
  it("are refused before anything is made", function()
    local scene, wire = make()
    refused({ "segments = 1e+09" }, scene.wire, scene, { EA = 6000, EI = 0.02, mass_per_length = 0.1,
      radius = 0.005, segments = 1e9, from = { 0, 0, 0 }, to = { 1, 0, 0 } })
    refused({ "too many", "10000000 slices" }, wire.remodel, wire, { model = "tube", segments = 1e7 })
    refused({ "too many" }, wire.remodel, wire, { model = "tube", spacing = 1e-300 })
    refused({ "cores" }, wire.remodel, wire, { model = "composite", cores = 1e9 })
    refused({ "modes" }, wire.frequencies, wire, { modes = 1e9 })
    refused({ "levels" }, scene.settle, scene, { levels = 1e9,
      tolerance = { { name = "x", value = 1, of = function() return 0 end } } })
    refused({ "name", "too long" }, scene.clamp, scene, wire, { s = 0.5, name = ("x"):rep(1e7) })
    assert.is_true(scene:run{ duration = 0.02 }.ok)
  end)
end)

-- Squares of 1e300 m/s overflow. Regression: a run reported ok with an infinite kinetic energy.
describe("set_velocity of a speed above that of light", function()
  it("is an error, and changes nothing", function()
    local s = core.scene{}
    local wire = s:wire{ E = 1e7, density = 1000, radius = 0.002, from = { 0, 0, 0 }, to = { 1, 0, 0 },
      segments = 4 }
    local cloud = s:particles{ positions = { 0, 0, 1, 0.1, 0, 1 }, masses = 0.01, radius = 0.01 }
    for _, call in ipairs{ function(v) wire:set_velocity({ 0, v, 0 }) end,
      function(v) wire:set_velocity({ 0, 0, 0 }, { 0, 0, v }) end, -- of the far end, 1 m away
      function(v) cloud:set_velocity{ v, 0, 0 } end,
      function(v) cloud:set_velocity{ 0, 1, 0, 0, -v, 0 } end } do
      for _, v in ipairs{ 3e8, 1e300, -1e160 } do
        local fine, why = pcall(call, v)
        assert.is_false(fine)
        assert.truthy(why:find("at most 299792458 m/s", 1, true), why)
      end
      call(2.9e8)
      wire:set_velocity{ 0, 0, 0 }
      cloud:set_velocity{ 0, 0, 0 }
    end
    assert.equal(0, s:energy().kinetic)
  end)
end)
