-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:wires, scene:obstacles, scene:grippers: lists of what is in a scene, in the order made, also of a
-- scene that was loaded or built by its own script.
local sw = require "softworld"

local function names_of(list)
  local names = {}
  for i, object in ipairs(list) do names[i] = object.name end
  return names
end

local function scene_of()
  local scene = sw.scene { name = "lists" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local b = scene:wire { name = "b", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 } }
  scene:gripper { name = "right", pads = { friction = 0.6, width = 0.02 } }
  scene:wire { name = "a", cable = "GXL 1.5", from = { 0, 0.1, 0.1 }, to = { 0.3, 0.1, 0.1 } }
  local wall = scene:obstacle { name = "wall", shape = "box", size = { 0.01, 1, 0.1 }, at = { 1, 0, 0.05 } }
  scene:gripper { name = "left" }
  return scene, b, wall
end

local function lists_of(scene)
  return { names_of(scene:wires()), names_of(scene:obstacles()), names_of(scene:grippers()) }
end

local all = { { "b", "a" }, { "table", "wall" }, { "right", "left" } }

describe("lists of what is in a scene", function()
  it("have the objects themselves, in the order made, without pads", function()
    local scene, b, wall = scene_of()
    assert.same(all, lists_of(scene))
    assert.equal(b, scene:wires()[1])
    assert.equal(wall, scene:obstacles()[2])
  end)

  it("are the same in a loaded scene and in one that scene:script built", function()
    local scene, file, script = scene_of(), os.tmpname(), os.tmpname()
    scene:save(file)
    scene:script(script)
    assert.same(all, lists_of(sw.load(file)))
    assert.same(all, lists_of(dofile(script)))
    os.remove(file)
    os.remove(script)
  end)

  it("leave out what was removed; a new list does not change an old one", function()
    local scene, b, wall = scene_of()
    local before = scene:wires()
    scene:remove(b)
    scene:remove(wall)
    scene:remove "right"
    assert.same({ { "a" }, { "table" }, { "left" } }, lists_of(scene))
    assert.equal(2, #before)
  end)

  it("refuse a call with a dot, and a closed scene", function()
    local scene = scene_of()
    for _, name in ipairs { "wires", "obstacles", "grippers", "names" } do
      assert.error_matches(function() scene[name]() end,
        "scene:" .. name .. " is a method: call it with a colon")
    end
    scene:close()
    assert.error_matches(function() scene:wires() end, "closed")
  end)
end)
