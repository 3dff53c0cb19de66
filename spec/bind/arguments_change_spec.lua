-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tables of arguments may have metamethods, and these may change or close what the call is about. The
-- call then raises an error, or works on what is there now; it never uses what is gone.
local sw = require "softworld"
local core = sw.core

-- Returns a list with the items of another that calls act() when item `when` is first asked for.
local function acting(list, when, act)
  local done
  local function value(key)
    if key == when and not done then
      done = true
      act()
    end
    return list[key]
  end
  return setmetatable({}, { __index = function(_, key) return value(key) end })
end

local function made()
  local scene = sw.scene {}
  local wire = scene:wire { E = 3e7, density = 1400, radius = 3e-3, segments = 10, from = { 0, 0, 0.1 },
    to = { 0.3, 0, 0.1 } }
  return scene, wire
end

describe("arguments that act when they are read", function()
  it("cannot close the scene of the call", function()
    for name, call in pairs {
      gravity = function(scene, place) scene:gravity(place) end,
      obstacle = function(scene, place) scene:obstacle { shape = "sphere", radius = 0.01, at = place } end,
      clamp = function(scene, place, wire) scene:clamp(wire, { s = 0, direction = place }) end,
      pose = function(_, place, _, sphere) sphere:pose(place) end,
      set_velocity = function(_, place, wire) wire:set_velocity(place) end,
      width = function(_, place, wire) wire:width(0.1, place) end,
      follow = function(_, place, _, sphere)
        sphere:follow { points = { { 0, 0, 0 }, place }, speed = 0.1 }
      end,
      force = function(scene, place, wire)
        scene:force { kind = "point", on = wire, s = 0.1, force = place }
      end,
    } do
      local scene, wire = made()
      local sphere = scene:obstacle { shape = "sphere", radius = 0.01, at = { 0, 0, 1 } }
      local place = acting({ 0, 0, 1 }, 2, function() scene:close() end)
      local ok, why = pcall(call, scene, place, wire, sphere)
      assert.is_false(ok, name)
      assert.matches("closed", why, name)
    end
  end)

  it("cannot close the shape or trajectory of the call", function()
    local shape = core.shape { shape = "sphere", radius = 0.1 }
    local ok, why = pcall(shape.distance, shape, acting({ 0, 0, 1 }, 2, function() shape:close() end))
    assert.is_false(ok)
    assert.matches("shape has been closed", why)
    local way = sw.trajectory.new { points = { { 0, 0, 0 }, { 1, 0, 0 } }, speed = 1 }
    ok, why = pcall(way.placed, way, acting({ 0, 0, 1 }, 2, function() way:close() end))
    assert.is_false(ok)
    assert.matches("trajectory has been closed", why)
  end)

  it("cannot close a trajectory while it is sampled", function()
    for _, closes in ipairs { 0.2, 0.5, 0.9 } do
      local way, sampled
      way = sw.trajectory.new { duration = 1, func = function(t)
        if sampled and t > closes then way:close() end
        return { t, 0, 0 }
      end }
      sampled = true
      local ok, why = pcall(way.sample, way, 4) -- at 0, 1/3, 2/3 and 1 s
      if closes == 0.9 then assert.is_true(ok, why) -- closed when the last sample was taken
      else
        assert.is_false(ok)
        assert.matches("trajectory has been closed", why)
      end
    end
  end)

  it("cannot change the number of nodes that scene:evaluate works with", function()
    for _, segments in ipairs { 3, 10, 40 } do
      local scene, wire = made()
      local values = {}
      for i = 1, 3 * 11 do values[i] = 0 end
      local asked
      local arguments = setmetatable({}, { __index = function(_, key)
        if key == "direction" and not asked then
          asked = true
          core.remesh(scene, { segments })
        end
        if key == "positions" or key == "velocities" then return nil end
        return key == "direction" and values or nil
      end })
      local ok, why = pcall(scene.evaluate, scene, wire, arguments)
      if segments == 10 then assert.is_true(ok, why)
      else
        assert.is_false(ok)
        assert.matches("scene:evaluate: the wire was changed meanwhile", why)
      end
      assert.is_true(scene:run { duration = 0.01 }.ok)
    end
  end)

  it("change nothing when they raise: obstacle:set", function()
    local scene = sw.scene {}
    local sphere = scene:obstacle { shape = "sphere", radius = 0.01, at = { 0, 0, 1 }, friction = 0.2 }
    local arguments = setmetatable({ at = { 1, 2, 3 }, friction = 0.4 }, { __index = function(_, key)
      if key == "restitution" then error("raised by the caller", 0) end
    end })
    local ok, why = pcall(core.class.obstacle.set, sphere, arguments)
    assert.is_false(ok)
    assert.equal("raised by the caller", why)
    assert.same({ 0, 0, 1 }, (sphere:pose()))
  end)
end)
