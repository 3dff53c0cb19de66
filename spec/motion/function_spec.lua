-- SPDX-License-Identifier: GPL-3.0-or-later
-- Lua functions of time as trajectories.
package.path = "./?.lua;" .. package.path
local core = require "softworld.core"
local d = require "spec.motion.differences"

describe("a function of time", function()
  local function circle(t)
    return { math.cos(3 * t), math.sin(3 * t), 0.1 * t }, { axis = { 0, 0, 1 }, angle = 3 * t }
  end

  it("gets its derivatives by differences over the stated step", function()
    local m = core.trajectory(circle)
    for _, t in ipairs { 0, 5e-5, 0.3, 7.1 } do
      assert.is_true(d.apart(m:velocity(t), { -3 * math.sin(3 * t), 3 * math.cos(3 * t), 0.1 }) < 1e-6)
      assert.is_true(d.apart(m:angular_velocity(t), { 0, 0, 3 }) < 1e-7)
      local inner = t > 1e-4 and 1e-6 or 1e-2
      assert.is_true(d.apart(m:acceleration(t), { -9 * math.cos(3 * t), -9 * math.sin(3 * t), 0 }) < inner)
      assert.is_true(d.norm(m:angular_acceleration(t)) < 1e-6)
    end
    assert.are.equal(math.huge, m:duration())
    assert.are.equal("callback", m:law())
  end)

  -- Differences across a jump of the velocity would be its mean, and an acceleration of the jump over the
  -- step, 1e-4 s.
  it("has the velocity of one side beside a jump, that before it at the jump", function()
    for _, at in ipairs{ 0.3, 0.29997, 0.30005003, 1 / 3 } do
      local m = core.trajectory(function(t) -- 2 m/s, then back with 1 m/s and 3 m/s2; turns the same way
        local u = t - at
        local x = u < 0 and 2 * u or -u + 1.5 * u * u
        return { 0, x, 0 }, { axis = { 1, 0, 0 }, angle = x }
      end)
      for _, off in ipairs{ -2e-4, -9.9e-5, -1e-5, -1e-8, 0, 1e-8, 1e-5, 9.9e-5, 2e-4 } do
        local expected = off <= 0 and 2 or -1 + 3 * off
        local v, w = m:velocity(at + off)[2], m:angular_velocity(at + off)[1]
        -- rounding of 1e-16 m over 1e-4 s
        assert.is_true(math.abs(v - expected) < 1e-8, ("%g m/s at %g"):format(v, off))
        assert.is_true(math.abs(w - expected) < 1e-8, ("%g rad/s at %g"):format(w, off))
        assert.is_true(math.abs(m:acceleration(at + off)[2] - (off <= 0 and 0 or 3)) < 1e-3)
      end
    end
  end)

  it("is called with times from 0 to its duration only", function()
    local least, most = 1, 0
    local m = core.trajectory { duration = 2, start = 5, func = function(t)
      least, most = math.min(least, t), math.max(most, t)
      return { t * t, 0, 0 }
    end }
    for _, t in ipairs { 0, 5, 5.00001, 6, 6.99999, 7, 100 } do m:velocity(t) end
    assert.are.equal(0, least)
    assert.are.equal(2, most)
    assert.is_true(math.abs(m:velocity(6.99999)[1] - 2 * 1.99999) < 1e-7)
    assert.are.same({ 0, 0, 0 }, m:velocity(7))
    assert.are.same({ 4, 0, 0 }, m:position(8))
    assert.are.equal(11, #m:sample(11).t)
  end)

  it("passes on the value of an error unchanged", function()
    for _, value in ipairs { { code = 7 }, "text", 12, true, print } do
      local m = core.trajectory(function() error(value, 0) end)
      local fine, caught = pcall(m.position, m, 1)
      assert.is_false(fine)
      assert.are.equal(value, caught)
      assert.is_false((pcall(m.sample, m, 5, 0, 1)))
    end
    local m = core.trajectory(function() error() end)
    local fine, caught = pcall(m.position, m, 1)
    assert.is_false(fine)
    assert.is_nil(caught)
  end)

  it("gets an error that says what is wrong with its result", function()
    local function message(...)
      local values = table.pack(...)
      local m = core.trajectory(function() return table.unpack(values, 1, values.n) end)
      return select(2, pcall(m.position, m, 0.25))
    end
    assert.matches("func%(0.25%) must return a position {x, y, z} %[m%].*got nil", message())
    assert.matches("got number", message(3))
    assert.matches("position from func%(0.25%), item 2, must be a number %[m%]", message { 1 })
    assert.matches("position from func%(0.25%), item 3, = .*nan.*finite", message { 1, 2, 0 / 0 })
    assert.matches("rotation from func%(0.25%)", message({ 1, 2, 3 }, 7))
  end)

  -- Within a step no line of the script runs that a message could name.
  it("is named by the line where it begins, in errors about its result and about yielding", function()
    local function say(f, words)
      local line = debug.getinfo(f, "S").linedefined
      local sw = require "softworld"
      local scene = sw.scene{}
      local wire = scene:wire{ E = 1e7, density = 1000, radius = 0.003, from = { 0, 0, 0 }, to = { 1, 0, 0 },
        segments = 4 }
      local clamp = scene:clamp(wire, { s = 0 })
      clamp:follow{ func = f, duration = 1 }
      local fine, why = pcall(scene.run, scene, { duration = 0.1, dt = 0.01 })
      assert.is_false(fine)
      assert.matches("^.*function_spec.lua:" .. line .. ": trajectory: " .. words, why)
    end
    say(function(t) return { 0, 0, t < 0.02 and 0 or 0 / 0 } end,
      "position from func%(0.02.*%), item 3, = .*nan m")
    say(function(t) return t < 0.02 and { 0, 0, 0 } or 7 end, "func%(0.02.*%) must return a position")
    say(function(t) return { 0, 0, 0 }, t < 0.02 and { 1, 0, 0, 0 } or {} end, "rotation from func%(0.02")
    say(function(t) return t < 0.02 and { 0, 0, 0 } or coroutine.yield() end,
      "func%(0.02.*%) must not yield or wait")
    assert.matches("^trajectory: func%(1.0%) must not yield", select(2, pcall(function()
      core.trajectory(coroutine.yield):position(1)
    end)))
  end)

  it("must not yield or recurse without end, and may close its own trajectory", function()
    local m = core.trajectory(coroutine.yield)
    assert.has_error(function() coroutine.wrap(function() m:position(1) end)() end)
    m = core.trajectory(function(t) return m:position(t) end)
    assert.has_error(function() m:position(1) end)
    m = core.trajectory(function(t)
      m:close()
      collectgarbage()
      return { t, 0, 0 }
    end)
    assert.are.same({ 1, 0, 0 }, m:position(1))
    assert.has_error(function() m:position(1) end, "the trajectory has been closed")
    assert.are.equal("trajectory (closed)", tostring(m))
  end)

  it("works from inside a coroutine and from inside another function", function()
    local inner = core.trajectory(function(t) return { t, 2 * t, 0 } end)
    local outer = core.trajectory(function(t) return inner:position(t) end)
    local p = coroutine.wrap(function() return outer:position(3) end)()
    assert.are.same({ 3, 6, 0 }, p)
  end)

  it("is freed with its trajectory", function()
    local weak = setmetatable({}, { __mode = "k" })
    do
      local f = function() return { 0, 0, 0 } end
      weak[f] = true
      local m = core.trajectory(f)
      assert.is_truthy(m:placed({ 1, 0, 0 }):delayed(2):position(0))
    end
    collectgarbage()
    collectgarbage()
    assert.is_nil(next(weak))
  end)

  it("leaves nothing behind at any failing allocation", function()
    collectgarbage()
    collectgarbage()
    local before, n = core.allocated(), 0
    local f = function() return { 0, 0, 0 } end
    repeat
      n = n + 1
      core.fail_allocation(n)
      local fine, made = pcall(core.trajectory, f)
      core.fail_allocation(0)
      if fine then made:close() end
      assert.are.equal(before, (core.allocated()))
    until fine
    assert.are.equal(4, n)
  end)
end)
