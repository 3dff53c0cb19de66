-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:script gives Lua code that builds a scene again with the same bits; scene:describe says what it is
-- made of.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local samples = require "contract.samples"
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$"
local program = dofile(here .. "/../host/program.lua")

local function build(text) return assert(load(text, "=rebuilt"))() end

local function state(scene)
  assert.is_true(scene:run{ duration = 0.003, dt = 1e-3 }.ok)
  local values = {}
  for _, wire in ipairs(sw.core.data(scene).wires) do
    for _, x in ipairs(wire.object:positions()) do values[#values + 1] = ("%a"):format(x) end
  end
  return table.concat(values, " ")
end

local function same(scene)
  local text = scene:script()
  local again = build(text)
  assert.equal(text, again:script())
  assert.equal(state(scene), state(again))
end

local function hung()
  local scene = sw.scene{ name = "a scene" }
  local wire = scene:wire{ E = 1e8, density = 1500, radius = 0.003, segments = 12, from = { 0, 0, 0.1 },
    to = { 0.6, 0, 0.1 } }
  return scene, wire
end

describe("scene:script", function()
  teardown(program.clean)

  -- 06 and 07 follow Lua functions, which cannot be written.
  for _, name in ipairs{ "01_hanging_cable", "02_cantilever", "03_laying", "04_two_grippers", "05_tuning",
    "08_error_bars", "09_feed", "10_kink", "11_harness", "12_squeezed_tube", "13_fabric", "14_foam",
    "15_two_plates", "16_mixed", "17_clips", "18_least_force", "19_resume" } do
    it("builds example " .. name .. " with the same bits", function()
      local out, err = program.run { "spec/lua/rebuilt.lua", "examples/" .. name .. ".lua", "quick",
        program.folder() }
      assert.is_truthy(out:find "%d+ values, THE SAME", out .. err)
    end)
  end

  for i, force in ipairs(samples.registry.forces) do
    if not force.inner and not force.of_web and not force.on_some and force.name ~= "plane_strain"
      and force.name ~= "snap" and force.name ~= "clip" then
      it("writes force " .. force.name, function()
        local scene, wire = hung()
        local args = samples.force(force, i)
        args.on = wire
        if args.s then args.s = 0.3 end
        scene:clamp(wire, { s = 0 })
        scene:force(args)
        same(scene)
      end)
    end
  end

  for _, shape in ipairs(samples.registry.shapes) do
    it("writes obstacle " .. shape.name, function()
      local scene = hung()
      local args = samples.obstacle(shape)
      args.at, args.rotation = { 5, 0, 1 / 3 }, { axis = { 0, 0, 1 }, angle = 0.1 }
      local obstacle = scene:obstacle(args)
      obstacle:set{ friction = 0.1 + 0.2 }
      assert.equal(0.1 + 0.2, build(scene:script()):describe().obstacles[1].now.friction)
      same(scene)
    end)
  end

  it("writes objects made in Lua, their changes, and motions", function()
    local scene, wire = hung()
    local hand = scene:gripper{ name = "left 'hand'", pads = { width = 0.02 } }
    hand:grasp(wire, { s = 0.55 })
    local way = sw.trajectory{ points = { { 0, 0, 0 }, { 0.1, 0, 0 } }, speed = 0.2, relative = true }
    local clamp = scene:clamp(wire, { s = 0, name = "end \"of\" wire" })
    clamp:follow(way:delayed(0.001))
    scene:tie(wire, { s = 0.3, strength = 8 })
    scene:clip{ at = { 0.2, 0, 0.05 }, width = 0.01, insertion = 3, retention = 5 }
    scene:channel{ points = { { 0, 0.5, 0 }, { 0.2, 0.5, 0 } }, width = 0.01, depth = 0.01 }
    scene:set{ gravity = { 0, 0.1, -9 } }
    same(scene)
  end)

  it("writes more objects than a function may have locals", function()
    local scene = sw.scene{}
    for i = 1, 230 do
      local wire = scene:wire{ E = 1e8, density = 1500, radius = 0.003, segments = 3,
        from = { 0, i * 0.02, 0.1 }, to = { 0.1, i * 0.02, 0.1 } }
      scene:clamp(wire, { s = 0 })
    end
    same(scene)
  end)

  it("keeps the arguments as they were given", function()
    local scene, wire = hung()
    local args = { s = 0, direction = { 1, 0, 0 } }
    scene:clamp(wire, args)
    args.s, args.direction[1] = 0.3, 0
    same(scene)
  end)

  it("leaves out calls that failed, and what a snapshot takes back", function()
    local scene, wire = hung()
    local before = scene:script()
    assert.is_false(pcall(scene.clamp, scene, wire, { s = 7 }))
    local snapshot = scene:snapshot()
    scene:clamp(wire, { s = 0 })
    assert.is_true(scene:run{ duration = 0.002, dt = 1e-3 }.ok)
    scene:restore(snapshot)
    assert.equal(before, scene:script())
  end)

  it("lists later calls as comments only", function()
    local scene, wire = hung()
    local clamp = scene:clamp(wire, { s = 0 })
    scene:run{ duration = 0.002, dt = 1e-3 }
    clamp:release()
    scene:obstacle{ shape = "plane", at = { 0, 0, -1 } }
    local text = scene:script()
    assert.is_truthy(text:find("\n-- clamp1:release()\n-- scene:obstacle {", 1, true), text)
    local again = build(text)
    assert.equal(0, #again:describe().obstacles)
    assert.is_true(again:describe().holds[1].now.held)
  end)

  it("names what cannot be written, and writes nothing", function()
    local scene, wire = hung()
    scene:force{ kind = function() end, on = wire }
    local file = program.folder() .. "/place.lua"
    local fine, message = pcall(scene.script, scene, file)
    assert.is_false(fine)
    assert.is_truthy(message:find "rebuild_spec.lua:%d+: scene:force.kind is a Lua function", message)
    assert.is_nil(io.open(file))
    scene = hung()
    assert.is_false(pcall(scene.script, scene, 7))
    assert.is_false(pcall(scene.script, scene, "/nowhere/place.lua"))
    assert.is_false(pcall(scene.script, {}))
    scene:close()
    assert.is_false(pcall(scene.script, scene))
  end)

  it("refuses a scene from a file, naming it", function()
    local scene = hung()
    local file = program.folder() .. "/scene.sws"
    scene:save(file)
    local fine, message = pcall(scene.script, (sw.load(file)))
    assert.is_false(fine)
    assert.is_truthy(message:find("scene 'a scene' was read from a file", 1, true), message)
  end)

  it("writes a file that dofile reads", function()
    local scene = hung()
    local file = program.folder() .. "/place.lua"
    assert.equal(program.read(file, scene:script(file)), scene:script())
    assert.equal("a scene", dofile(file).name)
  end)
end)

describe("scene:describe", function()
  local function is_plain(value, path)
    local kind = type(value)
    if kind == "table" then
      assert.is_nil(getmetatable(value), path)
      for key, item in pairs(value) do is_plain(item, path .. "." .. tostring(key)) end
    else
      assert.is_truthy(kind == "string" or kind == "number" or kind == "boolean", path .. ": " .. kind)
    end
  end

  it("gives plain tables of what was given and what is now", function()
    local scene, wire = hung()
    local floor = scene:obstacle{ name = "floor", shape = "plane", friction = 0.2 }
    scene:clamp(wire, { s = 0 })
    scene:force{ kind = function() end, on = wire }
    scene:gripper{ name = "hand", at = { 0, 0, 1 }, on_crash = function() end }
    scene:tie(wire, { s = 0.3 })
    floor:set{ friction = 0.5 }
    local d = scene:describe()
    is_plain(d, "scene")
    assert.same({ 0.2, 0.5 }, { d.obstacles[1].given.friction, d.obstacles[1].now.friction })
    assert.same({ "wire1", 12, "rod" }, { d.wires[1].name, d.wires[1].given.segments, d.wires[1].now.model })
    assert.equal("wire1", d.holds[1].wire)
    assert.same({ "callback", "function", "wire1" }, { d.forces[1].kind, d.forces[1].given.kind,
      d.forces[1].given.on })
    assert.same({ "hand", "tie1" }, { d.grippers[1].name, d.fixings[1].name })
  end)

  it("changes no bit of a run, nor does scene:script", function()
    local function laid(look)
      local scene, wire = hung()
      scene:obstacle{ shape = "plane" }
      scene:clamp(wire, { s = 0 })
      for _ = 1, 5 do
        scene:run{ duration = 0.01, dt = 1e-3 }
        if look then scene:describe(); scene:script() end
      end
      return state(scene)
    end
    assert.equal(laid(false), laid(true))
  end)
end)

describe("tables that contain themselves", function()
  local marks = {}
  for i = 1, 8 do marks[i] = marks end

  it("are refused as arguments, and leave nothing in the scene", function()
    local scene, wire = hung()
    local clamp = scene:clamp(wire, { s = 0 })
    local before = scene:script()
    local args = { s = 0.3, table.unpack(marks) }
    assert.error_matches(function() scene:clamp(wire, args) end, "parameters have names; %[1%] is not a name")
    assert.error_matches(function() clamp:follow{ points = marks, duration = 1 } end, "way%-point 1")
    assert.error_matches(function() scene:obstacle{ shape = "sphere", radius = 0.1, at = marks } end,
      "at must have 3 numbers, got 8")
    assert.equal(before, scene:script())
    same(scene)
  end)

  it("may be used by functions; these are refused by scene:script", function()
    local scene = hung()
    scene:gripper{ name = "hand", pads = { width = 0.01 } }:set{ on_slip = function() return marks end }
    assert.error_matches(function() scene:script() end,
      "gripper:set%.on_slip is a Lua function, which cannot be written as Lua")
    assert.equal("hand", scene:describe().grippers[1].name)
  end)
end)

describe("errors of calls that are recorded", function()
  it("have the script's line, whoever raises them", function()
    local scene, wire = hung()
    local pin = scene:pin(wire, { s = 0.1 })
    scene:force{ kind = "damping", mass = 1 }
    local closed = hung()
    closed:close()
    for _, call in ipairs{ function() return pin:speed() end, function() return closed:gravity() end,
      function() return closed:gravity{ 0, 0, 0 } end, function() scene:restore(nil) end,
      function() pin:follow(7) end, function() scene:clamp(wire, { s = 9 }) end,
      function() scene:clamp(wire, 7) end } do
      local fine, message = pcall(call)
      assert.is_false(fine)
      assert.is_truthy(tostring(message):find("rebuild_spec.lua:%d+: "), message)
      assert.is_nil(message:find("softworld/record", 1, true), message)
    end
  end)
end)
