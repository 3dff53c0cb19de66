-- SPDX-License-Identifier: GPL-3.0-or-later
-- A misspelt key, field or method is an error that names the nearest one, everywhere.
local sw = require "softworld"

local scene, wire, hand, clamp, pin, feed, run

setup(function()
  scene = sw.scene{ name = "names" }
  wire = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 8, from = { 0, 0, 0.1 },
    to = { 0.5, 0, 0.1 } }
  hand = scene:gripper{ name = "hand", at = { 0.1, 0, 0.2 } }
  clamp = scene:clamp(wire, { s = 0 })
  pin = scene:pin(wire, { s = 0.3 })
  local other = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 8, from = { 0, 0.1, 0.1 },
    to = { 0.5, 0.1, 0.1 } }
  feed = scene:feed(other, { s = 0 })
  run = scene:run{ duration = 0.02 }
end)

local function check(cases)
  for name, case in pairs(cases) do
    it(name, function()
      local fine, why = pcall(case[1])
      assert.is_false(fine)
      assert.truthy(why:find(case[2], 1, true), why)
      assert.truthy(why:find("names_spec.lua:", 1, true), "no line: " .. why)
    end)
  end
end

local path = "/nowhere/x.png"

describe("a misspelt key of", function()
  check{
    ["run:chart"] = { function() run:chart{ colums = {} } end, "did you mean 'columns'?" },
    ["run:pictures"] = { function() run:pictures{ path = path, cout = 3 } end, "did you mean 'count'?" },
    camera = { function() run:pictures{ path = path, camera = { elevaton = 3 } } end,
      "did you mean 'elevation'?" },
    ["gripper:move"] = { function() hand:move{ by = { 0, 0, 1 }, sped = 1 } end, "did you mean 'speed'?" },
    turn = { function() hand:move{ turn = { axs = { 0, 0, 1 }, angle = 1 }, duration = 1 } end,
      "did you mean 'axis'?" },
    ["gripper:rotate"] = { function() hand:rotate{ axes = { 0, 0, 1 }, angle = 1, duration = 1 } end,
      "did you mean 'axis'?" },
    ["gripper:grasp"] = { function() hand:grasp(wire, { approch = "plates" }) end, "'approach'" },
    ["gripper:retreat"] = { function() hand:retreat{ distnce = 1 } end, "did you mean 'distance'?" },
    ["gripper:press"] = { function() hand:press{ froce = 1 } end, "did you mean 'force'?" },
    pads = { function() scene:gripper{ pads = { widht = 1 } } end, "did you mean 'width'?" },
    clip = { function() scene:clip{ retenton = 1 } end, "did you mean 'retention'?" },
    tie = { function() scene:tie(wire, { slak = 1 }) end, "did you mean 'slack'?" },
    channel = { function() scene:channel{ pionts = {} } end, "did you mean 'points'?" },
  }
end)

describe("an invalid option:", function()
  check{
    ["a word for a camera"] = { function() run:pictures{ path = path, camera = "front" } end, "'auto'" },
    ["an angle of a camera that is none"] = { function()
      run:pictures{ path = path, camera = { angle = "wide" } }
    end, "camera.angle = 'wide'" },
    ["a text for a table"] = { function() run:chart "x.svg" end, "one table of parameters, got string" },
    ["a table for a path"] = { function() run:save{ path = "x.csv" } end, "the name of a .csv" },
    ["a table for a .pvd"] = { function() run:vtk{} end, "the name of a .pvd" },
    ["a table for a time"] = { function() hand:over{} end, "t1 must be a time [s]" },
  }
end)

describe("an unknown", function()
  check{
    ["field of a run"] = { function() return run.steeps end, "did you mean 'steps'?" },
    ["field of a run, far from all"] = { function() return run.took_hours end, "run has no 'took_hours'" },
    ["method of a run"] = { function() run:seris() end, "did you mean 'series'?" },
    ["field of a wire that is set"] = { function() wire.frictoin = 0.5 end, "wire has no 'frictoin'" },
    ["field that can only be read"] = { function() wire.radius = 1 end, "'radius' can only be read" },
    ["field of a settled scene"] = { function() return scene:settle().okk end, "did you mean 'ok'?" },
    ["key of wire:bend_limit"] = { function()
      scene:wire{ cable = "GXL 1.5", from = { 0, 1, 1 }, to = { 1, 1, 1 } }:bend_limit{ us = "fixed" }
    end, "did you mean 'use'?" },
    ["method that is set"] = { function() scene.gravity = {} end, "'gravity' is a method" },
    ["field of a clamp that is set"] = { function() clamp.frce = 1 end, "did you mean 'force'?" },
    ["method of a feed"] = { function() feed:move() end, "feed has no 'move'" },
    ["method of a pin"] = { function() pin:frce() end, "pin has no 'frce'; did you mean 'force'?" },
    ["field of a feed that is set"] = { function() feed.speed = 1 end, "feed: 'speed' is a method" },
    ["result of a run that is set"] = { function() run.ok = true end, "run has no 'ok' to set" },
    ["result of a run that it may lack"] = { function() run.quantities = {} end,
      "run has no 'quantities' to set" },
    ["field of a gripper that is set"] = { function() hand.slip_tolerence = 1 end,
      "did you mean 'slip_tolerance'?" },
  }
end)

it("results that a run may lack read as nil", function()
  for _, key in ipairs{ "quantities", "met", "advice", "levels", "last_jump" } do
    assert.is_nil(run[key])
  end
end)

describe("within a process", function()
  local function message(body)
    local s = sw.scene{}
    s:process(body)
    local fine, why = pcall(s.run, s, { dt = 0.01 })
    assert.is_false(fine)
    return why
  end

  it("unknown methods, fields and options are named", function()
    assert.truthy(message(function(p) p:wiat(1) end):find("did you mean 'wait'?", 1, true))
    assert.truthy(message(function(p) p.count = 1 end):find("use a local variable", 1, true))
    assert.truthy(message(function(p) p:wait_until(print, { timout = 1 }) end)
      :find("did you mean 'timeout'?", 1, true))
  end)

  it("p.time is the scene's time", function()
    local s, seen = sw.scene{}, nil
    s:process(function(p)
      p:wait(0.25)
      seen = p.time
    end)
    s:wire{ E = 1e6, density = 1000, radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    s:run{ dt = 0.05 }
    assert.near(0.25, seen, 1e-12)
  end)
end)

describe("the nearest of many names", function()
  it("is found behind any number of others", function()
    local names = {}
    for k = 1, 1000 do names[k] = ("other%d"):format(k) end
    names[1001] = "wanted"
    assert.equal("wanted", sw.core.nearest("wantd", names))
    assert.is_nil(sw.core.nearest("wantd", {}))
    names[900] = false -- a list ends where it is no list of texts
    assert.is_nil(sw.core.nearest("wantd", names))
  end)

  it("is proposed by scene:find among hundreds of objects", function()
    local many = sw.scene{}
    for k = 1, 200 do
      many:obstacle{ name = ("peg of row %d"):format(k), shape = "sphere", radius = 0.01, at = { k, 0, 0 } }
    end
    many:obstacle{ name = "last of all", shape = "sphere", radius = 0.01 }
    local _, why = pcall(many.find, many, "lst of all")
    assert.truthy(tostring(why):find("did you mean 'last of all'?", 1, true), why)
  end)
end)

describe("an empty name", function()
  it("is refused wherever an object has a name, and nothing is made", function()
    local s = sw.scene{}
    local w = s:wire{ E = 1e6, density = 1000, radius = 0.001, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    for kind, make in pairs{
      wire = function() s:wire{ name = "", E = 1e6, density = 1, radius = 1e-3, from = { 0, 0, 0 },
        to = { 1, 0, 0 } } end,
      plane = function() s:obstacle{ name = "", shape = "plane" } end,
      clamp = function() s:clamp(w, { name = "", s = 0 }) end } do
      local fine, why = pcall(make)
      assert.is_false(fine)
      assert.truthy(why:find(kind .. ": name must not be empty", 1, true), why)
    end
    assert.same({ 1, 0 }, { #s:wires(), #s:obstacles() })
    assert.equal(w, s:find "wire1")
    s:run{ duration = 0.01 }
  end)
end)

describe("a measure that an object has for intervals only", function()
  it("is told to be one of over()", function()
    local s = sw.scene{}
    local ball = s:obstacle{ name = "ball", shape = "sphere", radius = 0.1 }
    s:wire{ E = 1e6, density = 1000, radius = 0.001, from = { 0, 0, 1 }, to = { 1, 0, 1 } }
    s:run{ duration = 0.01 }
    for _, name in ipairs{ "peak_force", "mean_force", "impulse" } do
      local fine, why = pcall(function() return ball[name] end)
      assert.is_false(fine)
      assert.truthy(why:find(("has no '%s'; :over().%s may give it"):format(name, name), 1, true), why)
      assert.is_true(ball:over()[name] ~= nil)
    end
    local _, other = pcall(function() return ball.weight end)
    assert.is_nil(other:find("over()", 1, true))
  end)
end)

describe("a name that is not one line", function()
  -- Calls with the name; each begins the error with its own words.
  local function calls(name)
    local s = sw.scene{}
    local w = s:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    local f = s:force{ kind = "damping", on = w }
    s:run{ duration = 0.01 }
    local here = { 0, 0, 0 }
    return {
      ["scene: name"] = function() sw.scene{ name = name } end,
      ["wire: name"] = function() s:wire{ name = name, cable = "GXL 1.5", from = here, to = { 1, 0, 0 } } end,
      ["plane: name"] = function() s:obstacle{ name = name, shape = "plane" } end,
      ["clamp: name"] = function() s:clamp(w, { name = name, s = 0 }) end,
      ["gripper: name"] = function() s:gripper{ name = name } end,
      ["scene:clip: name"] = function()
        s:clip{ name = name, at = here, width = 0.01, insertion = 1, retention = 2 }
      end,
      ["scene:tie: name"] = function() s:tie(w, { name = name, s = 0.1 }) end,
      ["particles: name"] = function()
        s:particles{ name = name, positions = { here }, masses = 0.01, radius = 0.01 }
      end,
      ["scene:zone: name"] = function() s:zone{ name = name, shape = "sphere", radius = 1 } end,
      ["force:call_it: the name"] = function() f:call_it(name) end,
      ["scene:tell: object"] = function() s:tell{ kind = "x", text = "y", object = name } end,
      ["sw.study: name"] = function()
        sw.study{ name = name, parameters = { x = { 0, 1 } }, evaluate = function() return { y = 1 } end }
      end,
      ["p:step: the name"] = function()
        local other = sw.scene{}
        other:wire{ cable = "GXL 1.5", from = here, to = { 1, 0, 0 } }
        other:process(function(p) p:step(name, function() p:wait(0.01) end) end)
        other:run{ dt = 0.01 }
      end,
    }, s
  end

  it("is refused with the character and its place, and nothing is made", function()
    for char, word in pairs{ ["\n"] = "a line end", ["\r"] = "a line end", ["\t"] = "a tab",
      ["\27"] = "the control character 27", ["\127"] = "the control character 127" } do
      local all, s = calls("a" .. char .. "b")
      for what, call in pairs(all) do
        local fine, why = pcall(call)
        assert.is_false(fine, what)
        local words = ("%s has %s, at place 2; it must be one line"):format(what, word)
        assert.truthy(why:find(words, 1, true), why)
      end
      assert.same({ 1, 0, 0 }, { #s:wires(), #s:obstacles(), #s:grippers() })
      assert.is_true(s:run{ duration = 0.01 }.ok)
    end
  end)

  it("has at most 63 bytes if an object has it, and its parts have names that fit", function()
    local long = ("m"):rep(61) .. "\u{e9}"
    for what, call in pairs((calls(long .. "x"))) do
      local fine, why = pcall(call)
      local other = what:find "study" or what:find "step"
      assert.equal(other ~= nil, fine, what .. ": " .. tostring(why))
      assert.truthy(other or why:find(what .. " is too long; at most 63 bytes, got 64", 1, true), why)
    end
    for what in pairs((calls(long))) do calls(long)[what]() end
    local s = sw.scene{}
    local w = s:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
    s:gripper{ name = long, at = { 0, 0, 0 }, pads = { friction = 0.5, opening = 0.02 } }
      :grasp(w, { s = 0, approach = "plates", force = 5 })
    local channel = s:channel{ name = ("m"):rep(62) .. "n", points = { { 0, 2, 0 }, { 1, 2, 0 } },
      width = 0.02, depth = 0.02, lid = true }
    local seen = {}
    for _, o in ipairs(s:obstacles()) do
      assert.is_true(#o.name <= 63 and utf8.len(o.name) ~= nil and not seen[o.name], o.name)
      seen[o.name] = true
    end
    assert.truthy(channel.parts[1].name:find "^m+~%x%x%x%x floor 1$", channel.parts[1].name)
    assert.equal(channel, s:find(channel.name))
  end)
end)

describe("a name with a zero byte", function()
  it("is told as that, not as too long", function()
    local fine, why = pcall(sw.scene, { name = "a\0b" })
    assert.is_false(fine)
    assert.truthy(why:find("name has a zero byte, at place 2", 1, true), why)
    assert.error_matches(function() sw.scene{ name = ("a"):rep(1000) } end,
      "name is too long; at most %d+ bytes")
  end)
end)
