-- SPDX-License-Identifier: GPL-3.0-or-later
-- Words for people: what messages name, and how numbers and values are written.
local number = require "softworld.output.number"
local sw = require "softworld"
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/lua"
local program = dofile(here .. "/../host/program.lua")

local function wired(name)
  local scene = sw.scene{ name = name or "words" }
  return scene, scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 } }
end

local function fails(text, call, ...)
  local fine, why = pcall(call, ...)
  assert.is_false(fine)
  assert.truthy(tostring(why):find(text, 1, true), why)
end

describe("words", function()
  teardown(program.clean)

  it("propose the name that a word begins", function()
    local _, wire = wired()
    for word, name in pairs{ leng = "length", curv = "curvature", minbend = "min_bend_radius",
      tens = "tension", posit = "position", lenght = "length" } do
      fails(("did you mean '%s'?"):format(name), function() return wire[word] end)
    end
  end)

  it("write numbers far below and above all prefixes without one", function()
    assert.equal("1.000e-30 N", number.text(1e-30, "N"))
    assert.equal("1.000e25 N", number.text(1e25, "N"))
    assert.equal("0.001000 pN", number.text(1e-15, "N"))
    assert.equal("30.46 pN", number.text(30.46e-12, "N"))
    assert.equal("2.591e12 m", number.text(2.591e12, "m"))
  end)

  it("refuse ranges wider than the largest number, and take logarithmic ones of any width", function()
    local function of(range)
      return sw.study{ name = "wide", workers = 0, parameters = { x = range },
        evaluate = function(p) return { y = math.abs(math.log(p.x)) } end }
    end
    fails("the range -1e+308 to 1e+308 is wider than the largest number", of, { -1e308, 1e308 })
    local found = of{ 1e-200, 1e200, log = true, start = 1 }:minimise "y"
    assert.near(1, found.best.x, 1e-6)
    assert.same({}, found.at_bound)
  end)

  it("write choices true and false into CSV as themselves", function()
    local study = sw.study{ name = "choice", workers = 0, parameters = { c = { choices = { true, false } } },
      evaluate = function() return { y = 1 } end }
    study:sweep{ grid = 2 }
    local text = program.read(study:csv(program.folder() .. "/c.csv"))
    assert.truthy(text:find(",true,1,1,", 1, true) and text:find(",false,1,1,", 1, true), text)
  end)

  it("say how long a name of a clip is, and where it has a zero byte", function()
    local scene = sw.scene{}
    local function clip(name)
      return scene:clip{ name = name, at = { 0, 0, 0 }, width = 0.01, insertion = 8, retention = 25 }
    end
    fails("name is too long; at most 63 bytes, got 64", clip, ("x"):rep(64))
    fails("name is too long; at most 63 bytes, got 64", clip, ("\u{e9}"):rep(32))
    fails("name has a zero byte, at place 2", clip, "x\0y")
    fails("clip: name must not be empty", clip, "")
    assert.equal(("x"):rep(63), clip(("x"):rep(63)).name)
  end)

  it("name the line of a function that returns no number", function()
    fails("words_spec.lua:71)", sw.tune.minimise, { from = 0, to = 1,
      f = function() end })
  end)

  it("refuse another port for a view that is open", function()
    local scene = wired "viewed"
    local view = scene:view{ open = false }
    local port = tonumber(view.address:match ":(%d+)/")
    assert.equal(view, scene:view{ port = port })
    assert.equal(view, scene:view())
    fails(("the view of this scene is open, at port %d"):format(port), scene.view, scene,
      { port = port == 60000 and 60001 or 60000 })
    fails("port = 80000", scene.view, scene, { port = 80000 })
    view:close()
  end)

  it("say of a gripper that its scene is closed", function()
    local scene, wire = wired "closing"
    local gripper = scene:gripper{ name = "g" }
    assert.equal("gripper 'g' (open)", tostring(gripper))
    gripper:grasp(wire, { s = 0.1 })
    scene:close()
    assert.equal("gripper 'g' (its scene is closed)", tostring(gripper))
  end)

  it("say what describe lacks of a scene from a file", function()
    local scene, wire = wired "kept"
    scene:clamp(wire, { s = 0, name = "c" })
    scene:force{ kind = "line", on = wire, force = { 0, 0, 5 } }
    scene:clip{ name = "seat", at = { 0, 0, 1 }, width = 0.01, insertion = 8, retention = 25 }
    scene:tie(wire, { name = "strap", s = 0.2 })
    local before = scene:describe()
    assert.is_nil(before.lacks)
    local path = program.folder() .. "/kept.sws"
    scene:save(path)
    local told = sw.load(path):describe()
    assert.is_nil(told.wires[1].given)
    assert.truthy(told.lacks:find("^given and wire of all that was read from a file"))
    assert.same({ before.forces[1].now }, { told.forces[1].now })
    assert.same({ 1, "line", 5, true }, { #told.forces, told.forces[1].kind, told.forces[1].now.force[3],
      told.forces[1].now.held })
    assert.same({ "clip", "tie" }, { told.fixings[1].kind, told.fixings[2].kind })
  end)
end)
