-- SPDX-License-Identifier: GPL-3.0-or-later
-- Keys and values whose __tostring fails, objects instead of parameter tables, and writes to fields of
-- objects: each gives a clear error at the script's line.
local sw = require "softworld"

local function raises() error("__tostring was called", 0) end
local dumb = setmetatable({}, { __tostring = raises, __concat = raises })
local wrong = setmetatable({}, { __tostring = function() return {} end })

local function built()
  local scene = sw.scene{}
  local wire = scene:wire{ E = 1e8, density = 1400, radius = 0.002, from = { 0, 0, 0.1 },
    to = { 0.3, 0, 0.1 }, segments = 6 }
  local o = { scene = scene, wire = wire }
  o.gripper = scene:gripper{ at = { 0, 0, 1 } }
  o.clip = scene:clip{ at = { 0.1, 0, 0.1 }, width = 0.01, insertion = 3, retention = 9 }
  o.channel = scene:channel{ points = { { 0, 1, 0 }, { 1, 1, 0 } }, width = 0.02, depth = 0.02 }
  o.tie = scene:tie(wire, { s = 0.1 })
  o.process = scene:process(function() end)
  o.run = scene:run{ duration = 0.01, dt = 5e-3 }
  o.ledger, o.rest = o.run:ledger(), scene:settle()
  o.cable, o.sw, o.units, o.to = sw.cable "GXL 1.5", sw, sw.units, sw.units.to
  o.clamp = scene:clamp(wire, { s = 0 })
  o.obstacle = scene:obstacle{ shape = "plane", at = { 0, 0, -1 } }
  return o
end

-- Checks that f raises a text without raw Lua errors and places in the library; returns the text.
local function told(label, f, ...)
  local fine, message = pcall(f, ...)
  assert.is_false(fine, label)
  assert.equal("string", type(message), label)
  assert.falsy(message:find("__tostring", 1, true), label .. ": " .. message)
  assert.falsy(message:find("attempt to", 1, true), label .. ": " .. message)
  assert.falsy(message:find "softworld/[%w_/]+%.lua", label .. ": " .. message)
  return message
end

describe("a key whose __tostring fails", function()
  for _, key in ipairs{ dumb, wrong } do
    it("is refused when read from any object", function()
      local o = built()
      for name, object in pairs(o) do
        if name ~= "ledger" and name ~= "cable" then -- plain tables: nil
          told(name, function() return object[key] end)
        end
      end
    end)

    it("is refused when set on any object", function()
      local o = built()
      for _, name in ipairs{ "gripper", "clip", "channel", "tie", "process", "scene", "wire", "clamp" } do
        told(name, function() o[name][key] = 1 end)
      end
    end)

    it("is refused as the name of a parameter and as its value", function()
      local o = built()
      local s, w = o.scene, o.wire
      local calls = {
        run = function() s:run{ duration = 1, [key] = 1 } end,
        settle = function() s:settle{ [key] = 1 } end,
        tolerance = function() s:run{ duration = 0.1, tolerance = { [key] = 1 } } end,
        quantity = function()
          s:run{ duration = 0.1, tolerance = { { name = "a", value = 1, of = print, [key] = 1 } } }
        end,
        value = function() s:run{ duration = 0.1, tolerance = { tip = key } } end,
        levels = function() s:run{ duration = 0.1, tolerance = { tip = 1 }, levels = key } end,
        wire = function() s:wire{ [key] = 1 } end,
        model = function() s:wire{ model = key } end,
        force = function() s:force{ kind = "drag", [key] = 1 } end,
        gripper = function() s:gripper{ [key] = 1 } end,
        fingers = function() s:gripper{ pads = { fingers = key } } end,
        tie = function() s:tie(w, { s = 0.1, to = { w, s = 0.1, [key] = 1 } }) end,
        clip = function() s:clip{ at = { 0, 0, 0 }, width = key } end,
        cable = function() sw.cable.define{ name = "x", [key] = 1 } end,
        flag = function() sw.cable.define{ name = "x", outer_diameter = 1, flag = key } end,
        stiffness = function() s:wire{ cable = "GXL 1.5", stiffness = key, from = { 0, 0, 0 } } end,
        cell = function() sw.calibrate.cell{ [key] = 1 } end,
        read = function() sw.trajectory.read("a,b\n", key) end,
        wait = function() s:process(function(p) p:wait(key) end) s:run() end,
        grasp = function() o.gripper:grasp(w, { s = key }) end,
        slip = function() o.gripper:grasp(w, { on_slip = key }) end,
      }
      for name, call in pairs(calls) do told(name, call) end
    end)
  end
end)

describe("an object instead of a parameter table", function()
  it("is named by its kind", function()
    local o = built()
    local s = o.scene
    local message = told("arm", function() s:gripper{ arm = o.process } end)
    assert.truthy(message:find("got process", 1, true), message)
    message = told("friction", function()
      sw.cable.define{ name = "own", outer_diameter = 0.003, source = "a test", flag = "guessed",
        spread = 0.1, mass_per_length = o.gripper }
    end)
    assert.truthy(message:find("got gripper", 1, true), message)
    message = told("run", function() s:run(o.clip) end)
    assert.truthy(message:find("got clip", 1, true), message)
    message = told("clip", function() s:clip(o.clip) end)
    assert.truthy(message:find("got clip", 1, true), message)
  end)

  it("cannot invent parameters by metamethods", function()
    local s = built().scene
    local made_up = setmetatable({}, { __index = function(_, key) return key end })
    local message = told("run", function() s:run(made_up) end)
    assert.truthy(message:find("duration", 1, true), message)
  end)
end)

describe("fields of objects", function()
  local kinds = { gripper = { "name", "scene", "pads", "at", "grips", "events", "width" },
    clip = { "name", "scene", "object", "width" }, channel = { "name", "parts", "legs" },
    tie = { "name", "wire", "s" }, process = { "scene", "number", "thread", "steps" } }
  for kind, names in pairs(kinds) do
    it("of a " .. kind .. " cannot be overwritten", function()
      local o = built()
      local object = o[kind]
      for _, name in ipairs(names) do
        local before = object[name]
        told(kind .. "." .. name, function() object[name] = 5 end)
        assert.is_true(object[name] == before)
      end
      assert.equal("string", type(tostring(object)))
    end)
  end

  it("of a gripper are checked where scripts may set them", function()
    local g = built().gripper
    g.slip_tolerance, g.on_slip, g.on_crash = 0.01, "stop", print
    assert.equal(0.01, g.slip_tolerance)
    for name, values in pairs{ slip_tolerance = { 0, -1, "a", 0 / 0, dumb }, on_slip = { "stopp", 5, dumb },
      on_crash = { {}, true } } do
      for _, value in ipairs(values) do told(name, function() g[name] = value end) end
    end
    assert.equal("stop", g.on_slip)
  end)

  it("come back with a snapshot", function()
    local o = built()
    local before = o.scene:snapshot()
    o.gripper:move{ by = { 0, 0, 0.01 }, speed = 1 }
    o.scene:run{ duration = 0.02 }
    o.scene:restore(before)
    assert.equal(1, o.gripper:position() and o.gripper:position()[3] or o.gripper.at[3])
  end)
end)

describe("a gripper that two processes use", function()
  local function shared(approach, between)
    local o = built()
    local s = o.scene
    s:clamp(o.wire, { s = 0.25 })
    local g = s:gripper{ pads = { width = 0.01, opening = 0.008 } }
    local results = {}
    s:process(function(p)
      local how = { s = 0.1, approach = approach, force = 3, speed = 0.1 }
      if approach == "mixed" then how.freeze, how.spacing, how.region = false, 0.002, 0.02 end
      g:grasp(o.wire, how)
      results.grasped = true
      results[1] = table.pack(pcall(g.release, g, { speed = 0.05 }))
      p:wait(0.01)
    end)
    s:process(function(p)
      p:wait_until(function() return results.grasped end, { timeout = 2 })
      results[2] = table.pack(pcall(between, g, p))
    end)
    local run = s:run{ dt = 2e-3 }
    assert.is_true(run.ok, run.reason)
    return g, results
  end

  for _, approach in ipairs{ "plates", "mixed" } do
    it("may be released by either: " .. approach, function()
      local g, results = shared(approach, function(g) g:release{ speed = 0.1 } end)
      for _, result in ipairs(results) do
        assert.is_true(result[1] or type(result[2]) == "string"
          and not result[2]:find("attempt to", 1, true), tostring(result[2]))
      end
      assert.is_nil(g.wire)
    end)
  end
end)

describe("a stream for the summary", function()
  it("must be able to write", function()
    local run = built().run
    told("a text", function() run:summary(setmetatable({}, { __index = function() return "a" end })) end)
    told("raises", function() run:summary(setmetatable({}, { __index = raises })) end)
  end)
end)

describe("numbers of the core's own functions", function()
  it("are refused where they must be whole", function()
    local probe = require "softworld.probe"
    assert.truthy(told("sparse", probe.sparse, 0.5):find("must be an integer", 1, true))
    assert.truthy(told("blocks_time", probe.blocks_time, 1.5, 1, 1):find("must be an integer", 1, true))
  end)
end)
