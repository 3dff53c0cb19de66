-- SPDX-License-Identifier: GPL-3.0-or-later
-- Vectors and rotations that read-outs return can be printed, read by name, and added. They are still the
-- lists that they were: of three numbers, for scripts, files and checks.
local json = require "softworld.output.json"
local keep = require "softworld.scene.keep"
local pretty = require "softworld.prompt.pretty"
local repl = require "softworld.prompt.repl"
local sw = require "softworld"

local function straight()
  local scene = sw.scene{}
  return scene:wire{ name = "w", E = 1e8, density = 1400, radius = 0.002, from = { 1, 2, 3 },
    to = { 1, 2, 3.5 }, segments = 4 }, scene
end

describe("a vector", function()
  it("prints as its list, and has its items under names", function()
    local wire, scene = straight()
    local p = wire:position(0.5)
    assert.equal("{ 1.0, 2.0, 3.5 }", tostring(p))
    assert.same({ 1, 2, 3.5 }, { p.x, p.y, p.z })
    assert.equal(3, #p)
    assert.is_nil(p[4])
    assert.is_nil(p.name)
    p.z = 4
    assert.equal(4, p[3])
    local place, turn = scene:clamp(wire, { s = 0 }):pose()
    assert.equal("{ 1.0, 2.0, 3.0 }", tostring(place))
    assert.same({ 1, 0 }, { turn.w, turn.x })
    assert.equal("{ 1.0, 0.0, 0.0, 0.0 }", tostring(turn))
  end)

  it("adds, and is scaled, with any list of three numbers", function()
    local a = straight():position(0)
    assert.same({ 2, 3, 4 }, a + { 1, 1, 1 })
    assert.same({ 0, -1, -2 }, { 1, 1, 1 } - a)
    assert.same({ 2, 4, 6 }, 2 * a)
    assert.same({ 2, 4, 6 }, a * 2)
    assert.same({ 1 / 3, 2 / 3, 1 }, a / 3)
    assert.same({ -1, -2, -3 }, -a)
    assert.equal(math.sqrt(14), a:norm())
    assert.equal(-1, a:dot{ 2, 0, -1 })
    assert.same({ 2, -1, 0 }, a:cross{ 0, 0, 1 })
    assert.equal("{ 2.0, 4.0, 6.0 }", tostring(a + a))
    assert.equal("{ 1000.0, 2000.0, 3000.0 }", tostring(sw.units.to.mm(a)))
  end)

  it("refuses what it cannot compute, at the line of the script", function()
    local wire = straight()
    local a, long = wire:position(0), {}
    for k = 1, 300 do long[k] = { k, k } end
    for text, f in pairs{
      ["vector - takes vectors, lists of three numbers; got wire"] = function() return a - wire end,
      ["vector + takes vectors, lists of three numbers; got a list of 300 items"] = function()
        return a + long
      end,
      ["vector + takes vectors, lists of three numbers; got number 1"] = function() return a + 1 end,
      ["vector - takes vectors, lists of three numbers; got { 1, 2 }"] = function() return a - { 1, 2 } end,
      ["a:dot(b) and a:cross(b)"] = function() return a * a end,
      ["only a number can divide it"] = function() return 1 / a end,
      ["vector:dot takes vectors, lists of three numbers; got nil"] = function() return (a:dot()) end } do
      local fine, message = pcall(f)
      assert.is_false(fine)
      assert.truthy(message:find(text, 1, true), message)
      assert.truthy(message:find("vector_spec.lua:", 1, true), message)
    end
  end)

  it("comes from every read-out of a place, a direction, a force or a moment", function()
    local wire, scene = straight()
    local ground = scene:obstacle{ shape = "plane", at = { 0, 0, 2 } }
    local hand = scene:gripper{ name = "hand", at = { 1, 2, 3 } }
    local clamp = scene:clamp(wire, { s = 0.5 })
    local clip = scene:clip{ name = "clip", at = { 5, 5, 5 }, radius = 0.002, width = 0.004, insertion = 5,
      retention = 20 }
    local channel = scene:channel{ points = { { 9, 0, 0 }, { 9, 1, 0 } }, width = 0.01, depth = 0.01 }
    local tie = scene:tie(wire, { s = 0 })
    scene:run{ duration = 0.01, dt = 0.005 }
    for k, v in ipairs{ wire:position(0), wire:tangent(0), wire:velocity(0), ground:force(), ground:moment(),
      hand:position(), hand:force(), hand:moment(), clamp:force(), clamp:moment(), clip:force(),
      channel:force(), channel:moment(), tie:force(), scene:gravity(),
      sw.trajectory{ points = { { 0, 0, 0 }, { 1, 0, 0 } }, duration = 1 }:position(0.5) } do
      assert.matches("^{ .+, .+, .+ }$", tostring(v), nil, nil, k)
      assert.equal(v[3], v.z)
    end
  end)

  it("is a list for arguments, scripts, files and the prompt", function()
    local wire, scene = straight()
    local p = wire:position(0.5)
    scene:obstacle{ name = "o", shape = "sphere", radius = 0.1, at = p + { 1, 0, 0 } }
    assert.equal("[1,2,3.5]", json.encode(p))
    assert.equal("{ 1.0, 2.0, 3.5 }", pretty(p))
    assert.truthy(scene:script():find("at = { 2.0, 2.0, 3.5 }", 1, true))
    assert.same({ 2, 2, 3.5 }, scene:describe().obstacles[1].given.at)
  end)

  it("is completed at the prompt", function()
    local wire, scene = straight()
    local _, turn = scene:clamp(wire, { s = 0 }):pose()
    local names = { p = wire:position(0), turn = turn }
    assert.equal("cross dot norm x y z", table.concat(repl.complete("p.", "", names), " "))
    assert.equal("norm", table.concat(repl.complete("p:", "n", names), " "))
    assert.equal("w x y z", table.concat(repl.complete("turn.", "", names), " "))
  end)

  -- Grippers, ties, channels and cameras left the fourth number out.
  it("of more than three numbers is refused, such as a rotation in a vector's place", function()
    local wire, scene = straight()
    local hand = scene:gripper{ name = "hand", at = { 0, 0, 0 } }
    local _, turn = scene:clamp(wire, { s = 0 }):pose()
    for text, f in pairs{
      ["gripper:move: by must have 3 numbers, got 4"] = function() hand:move{ by = turn, speed = 1 } end,
      ["scene:gripper: at must have 3 numbers, got 4"] = function() scene:gripper{ at = turn } end,
      ["scene:gripper: rotation must have 4 numbers, got 5"] = function()
        scene:gripper{ at = { 0, 0, 0 }, rotation = { 1, 0, 0, 0, 0 } }
      end,
      ["to must have 3 numbers, got 4"] = function() scene:tie(wire, { s = 0, to = turn }) end,
    } do
      local _, message = pcall(f)
      assert.matches("vector_spec.lua:%d+: .*" .. text, message)
    end
  end)

  it("keeps its items in a snapshot", function()
    local data = { at = straight():position(0.5) }
    local imaged = { lists = {}, things = {}, whole = {}, passing = {} }
    local image = keep.image(data, imaged)
    data.at.z = 7
    keep.back(data, image, imaged)
    assert.equal("{ 1.0, 2.0, 3.5 }", tostring(data.at))
  end)

  it("stays one in what a process keeps, through a saved file", function()
    local path = os.tmpname()
    local function made()
      local wire, scene = straight()
      local clamp = scene:clamp(wire, { s = 0 })
      local seen = {}
      scene:process(function(p)
        seen.looked = p:step("look", function()
          p:wait(0.01)
          local place, turn = clamp:pose()
          return { at = wire:position(0.5), place = place, turn = turn }
        end)
        p:step("wait", function() p:wait(0.05) end)
        seen.z = seen.looked.at.z
      end)
      return scene, seen
    end
    made():run{ duration = 0.03, dt = 0.005, save = path }
    local again, seen = made()
    again:resume(path)
    os.remove(path)
    again:run{ duration = 0.1, dt = 0.005 }
    assert.equal(seen.looked.at[3], seen.z)
    assert.near(3.5, seen.looked.at.z, 1e-4) -- it has fallen a little
    assert.equal("{ 1.0, 2.0, 3.0 }", tostring(seen.looked.place))
    assert.equal(1, seen.looked.turn.w)
  end)
end)
