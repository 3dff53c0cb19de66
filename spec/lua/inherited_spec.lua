-- SPDX-License-Identifier: GPL-3.0-or-later
-- Parameters that a table inherits by the __index of its metatable count as if they were written into it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"

-- Ways to give the parameters of a table.
local ways = {
  ["all inherited"] = function(t) return setmetatable({}, { __index = t }) end,
  ["from two tables, of which the nearer counts"] = function(t)
    local near, far = {}, {}
    for key, value in pairs(t) do
      if type(key) == "string" and #key % 2 == 0 then near[key] = value else far[key] = value end
      if near[key] ~= nil then far[key] = "hidden" end
    end
    return setmetatable({}, { __index = setmetatable(near, { __index = far }) })
  end,
  ["some inherited"] = function(t)
    local own, base = {}, {}
    for key, value in pairs(t) do
      if type(key) == "number" or #key % 2 == 0 then own[key] = value else base[key] = value end
    end
    return setmetatable(own, { __index = base })
  end,
  ["from a class with methods"] = function(t)
    local class = {}
    for key, value in pairs(t) do class[key] = value end
    class.__index, class.new, class.describe = class, function() end, function() end
    return setmetatable({}, class)
  end,
}

-- Returns what a scene is after a run, with the tables of parameters given in a way.
local function world(w)
  local seen = {}
  local scene = sw.scene(w{ name = "variants", gravity = { 0, 0, -5 } })
  scene:obstacle(w{ name = "table", shape = "plane", friction = 0.35 })
  scene:obstacle(w{ name = "ball", shape = "sphere", radius = 0.03, at = { 0.3, 0.1, 0.03 } })
  local wire = scene:wire(w{ name = "a", E = 2e7, density = 1300, radius = 0.003, from = { 0, 0, 0.01 },
    to = { 0.4, 0, 0.01 }, segments = 16 })
  local b = scene:wire(w{ name = "b", cable = "GXL 1.5", from = { 0, 0.2, 0.05 }, to = { 0.3, 0.2, 0.05 },
    segments = 12 })
  scene:clamp(b, w{ name = "end", s = 0.01 }):follow(w{ points = { { 0, 0, 0 }, { 0, 0, 0.02 } },
    relative = true, duration = 0.08 })
  scene:wire_contact(w{ friction = 0.25 })
  scene:force(w{ kind = "point", on = b, s = 0.2, force = { 0, 0.01, 0 } })
  scene:force(w{ kind = "drag", on = wire, quadratic = 0.1 })
  local hand = scene:gripper(w{ name = "hand", at = { 0.05, 0, 0.01 }, slip_tolerance = 0.01 })
  scene:observe(w{ every = 0.02, call = function() seen[#seen + 1] = scene.time end })
  scene:process(function(p)
    hand:grasp(wire, w{ s = 0.05 })
    hand:move(w{ by = { 0, 0.02, 0.03 }, speed = 0.4 })
    hand:rotate(w{ axis = { 0, 0, 1 }, angle = 0.2, duration = 0.05 })
    p:wait(0.01)
  end)
  local run = scene:run(w{ dt = 0.004, frame = 0.02, window = 0.02, integrator = "sdirk2" })
  local all = saving.all(scene)
  table.move(seen, 1, #seen, #all + 1, all)
  local over = hand:over(0, scene.time, w{ window = 0.005 })
  local settled = scene:settle(w{ max_iterations = 500 })
  for _, value in ipairs{ run.steps, over.peak_force, wire:max_tension(w{ raw = true }), settled.iterations,
    scene:obstacle(w{ shape = "sphere", radius = 0.01, at = { 9, 0, 0 } }).name } do all[#all + 1] = value end
  scene:find "ball":set(w{ friction = 0.1 })
  local path = saving.temporary()
  scene:script(path)
  return all, saving.read(path)
end

after_each(saving.clean)

describe("inherited parameters", function()
  local wanted, script = world(function(t) return t end)

  for name, way in pairs(ways) do
    it("give the same scene and run as in one plain table: " .. name, function()
      local all, text = world(way)
      saving.same(wanted, all)
      assert.equal(script, text)
    end)
  end

  local function refused(words, call, ...)
    local message = saving.fails(words, call, ...)
    assert.is_nil(message:find("softworld/", 1, true), message)
  end

  it("are refused if they are unknown, with the nearest name", function()
    local scene = sw.scene{}
    local wire = scene:wire{ E = 2e7, density = 1300, radius = 0.003, from = { 0, 0, 0 }, to = { 0.4, 0, 0 } }
    local hand = scene:gripper{ at = { 0, 0, 1 } }
    local function typo(t)
      return setmetatable(t, { __index = setmetatable({}, { __index = { fricton = 0.3 } }) })
    end
    local function count() return #scene:names() end
    local before = count()
    refused({ "'fricton'", "'friction'" }, function()
      scene:obstacle(typo{ shape = "plane" })
    end)
    refused({ "'fricton'" }, function()
      scene:wire(typo{ E = 2e7, density = 1300, radius = 0.003, from = { 0, 0, 1 }, to = { 0.4, 0, 1 } })
    end)
    refused({ "'fricton'" }, function() scene:force(typo{ kind = "drag", on = wire }) end)
    refused({ "'fricton'", "'friction'" }, function() scene:wire_contact(typo{}) end)
    refused({ "'fricton'" }, function() scene:clamp(wire, typo{ s = 0 }) end)
    refused({ "'fricton'" }, function() scene:gripper(typo{}) end)
    refused({ "'fricton'" }, function() scene:run(typo{ duration = 0.01 }) end)
    refused({ "'fricton'" }, function() scene:settle(typo{}) end)
    refused({ "'fricton'" }, function() scene:observe(typo{ call = print }) end)
    refused({ "'fricton'" }, function() hand:grasp(wire, typo{ s = 0 }) end)
    refused({ "'fricton'" }, function() sw.scene(typo{}) end)
    refused({ "'fricton'" }, function()
      sw.cable.define(typo{ name = "own", outer_diameter = 0.003, source = "a test", flag = "guessed" })
    end)
    assert.equal(before, count())
    assert.equal(0, scene.time)
  end)

  it("are checked like others", function()
    local scene = sw.scene{}
    local function with(t) return setmetatable({}, { __index = t }) end
    refused({ "friction", "-1" }, function() scene:obstacle(with{ shape = "plane", friction = -1 }) end)
    refused({ "dt must be a number [s], got string 'x'" }, function()
      scene:wire{ E = 2e7, density = 1300, radius = 0.003, from = { 0, 0, 0 }, to = { 0.4, 0, 0 } }
      scene:run(with{ duration = 0.1, dt = "x" })
    end)
    local ball = scene:obstacle{ shape = "sphere", radius = 0.01, at = { 0, 0, 1 } }
    refused({ "name is given when the object is made" }, function() ball:set(with{ name = "b" }) end)
  end)

  it("do not end in a circle of tables", function()
    local scene, first, second = sw.scene{}, { shape = "plane" }, { friction = 0.3 }
    setmetatable(first, { __index = second })
    setmetatable(second, { __index = first })
    assert.equal(0.3, scene:obstacle(first):get().friction)
  end)

  it("are refused if a function gives them: others that it gives cannot be checked", function()
    local scene = sw.scene{}
    local wire = scene:wire{ E = 2e7, density = 1300, radius = 0.003, from = { 0, 0, 0 }, to = { 0.4, 0, 0 } }
    local hand = scene:gripper{ at = { 0, 0, 1 } }
    local function from(own, t)
      return setmetatable(own, { __index = function(_, key) return t[key] end })
    end
    refused({ "scene:obstacle: friction comes from a function", "write it into the table" }, function()
      scene:obstacle(from({ shape = "plane" }, { friction = 0.3 }))
    end)
    refused({ "scene:run: dt, duration come from a function" }, function()
      scene:run(from({}, { dt = 0.01, duration = 0.1, other = 1 }))
    end)
    refused({ "friction comes from a function" }, function()
      scene:wire_contact(from({}, { friction = 0.3 }))
    end)
    refused({ "slip_tolerance comes from a function" }, function()
      scene:gripper(from({}, { slip_tolerance = 0.3 }))
    end)
    refused({ "s comes from a function" }, function() hand:grasp(wire, from({}, { s = 0 })) end)
    refused({ "force comes from a function" }, function()
      scene:force(from({ kind = "point", on = wire, s = 0.1 }, { force = { 0, 0, 1 } }))
    end)
  end)

  it("may be behind a function that raises an error for other names", function()
    local scene = sw.scene{}
    local function strict(t)
      return setmetatable(t, { __index = function(_, key) error("no field " .. tostring(key), 0) end })
    end
    local wire = scene:wire(strict{ E = 2e7, density = 1300, radius = 0.003, from = { 0, 0, 0 },
      to = { 0.4, 0, 0 } })
    scene:obstacle(strict{ shape = "plane", at = { 0, 0, -1 } })
    scene:clamp(wire, strict{ s = 0 })
    assert.is_true(scene:run(strict{ duration = 0.01 }).ok)
  end)
end)
