-- SPDX-License-Identifier: GPL-3.0-or-later
-- One gripper that holds several wires.
local sw = require "softworld"
local vec = require "softworld.vec"
local side_by_side = require "spec.scene.side_by_side"

local scene_with, column = side_by_side.scene_with, side_by_side.column
local G = 9.81
local function weight_of(wire) return wire.beam.mass_per_length * wire.length * G end

describe("a gripper with several wires", function()
  it("carries them in one move, sums their forces, and releases one or all", function()
    local scene, wires = scene_with(2)
    local hand = scene:gripper{ name = "hand" }
    local one, both, rest, places
    scene:process(function(p)
      hand:grasp(wires[1], { s = 0.2 })
      hand:grasp(wires[2], { s = 0.2 })
      hand:move{ by = { 0, 0, 0.2 }, duration = 1 }
      hand:rotate{ axis = { 0, 0, 1 }, angle = math.pi / 2, duration = 1 }
      p:wait(2)
      both = hand:force()
      one = { hand:force{ wire = wires[1] }, hand:force{ wire = wires[2] } }
      places = { wires[1]:position(0.2), wires[2]:position(0.2) }
      local sum, about = { 0, 0, 0 }, hand:position()
      for i = 1, 2 do sum = vec.add(sum, hand:moment{ wire = wires[i], at = about }) end
      assert.near(0, vec.norm(vec.sub(sum, hand:moment())), 1e-9)
      hand:release{ wire = wires[1] }
      assert.are.equal(1, #hand.wires)
      p:wait(2)
      rest = hand:force()
      hand:release()
      p:wait(0.1)
    end)
    local run = scene:run{ dt = 0.01, integrator = "implicit-euler" }
    assert.is_true(run.ok)
    local w = weight_of(wires[1])
    assert.near(2 * w, both[3], 0.02 * w)
    for i = 1, 2 do assert.near(w, one[i][3], 0.02 * w) end
    for k = 1, 3 do assert.near(both[k], one[1][k] + one[2][k], 1e-9) end
    assert.near(w, rest[3], 0.05 * w)
    assert.near(0, vec.norm(vec.sub({ 0.2, 0, 0.2025 }, places[1])), 1e-6)
    assert.near(0, vec.norm(vec.sub({ 0.17, 0, 0.2025 }, places[2])), 1e-6)
    assert.are.same({ 0, 0, 0 }, hand:force())
    assert.near(2 * w, column(run, "hand.force")[390], 0.1 * w)
  end)

  it("takes a list between pads and gives the force on each", function()
    local scene, wires = sw.scene{}, {}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    for i = 1, 2 do
      local y = i == 1 and -0.003 or 0.003
      wires[i] = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 20,
        from = { 0, y, 0.0025 }, to = { 0.1, y, 0.0025 } }
    end
    scene:wire_contact{ between = wires, friction = 0.5 }
    local hand = scene:gripper{ name = "hand", at = { 0.05, 0, 0.0025 },
      pads = { friction = 0.8, opening = 0.02 } }
    scene:process(function(p)
      hand:grasp(wires, { approach = "plates", force = 4 })
      hand:move{ by = { 0, 0, 0.05 }, duration = 0.5 }
      p:wait(0.5)
      local sum = vec.add(hand:force{ wire = wires[1] }, hand:force{ wire = wires[2] })
      assert.near(0, vec.norm(vec.sub(sum, hand:force())), 1e-9)
      for i = 1, 2 do
        assert.near(weight_of(wires[i]), hand:force{ wire = wires[i] }[3], 0.3 * weight_of(wires[i]))
      end
      local m = vec.add(hand:moment{ wire = wires[1] }, hand:moment{ wire = wires[2] })
      assert.near(0, vec.norm(vec.sub(m, hand:moment())), 1e-6)
      local fine, why = pcall(hand.release, hand, { wire = wires[1] })
      assert.is_false(fine)
      assert.truthy(why:find("let go of all", 1, true), why)
      hand:release()
      assert.are.equal(0, #hand.wires)
    end)
    assert.is_true(scene:run{ dt = 0.002 }.ok)
  end)

  it("refuses invalid grasps and releases, and changes nothing", function()
    local scene, wires = scene_with(3)
    local hand = scene:gripper{ name = "hand" }
    hand:grasp(wires[1], { s = 0.1 })
    for _, case in ipairs{
      { function() hand:grasp(wires[1], { s = 0.3 }) end, "already holds wire 'wire1'" },
      { function() hand:grasp({ wires[2], wires[2] }, { s = 0.1 }) end, "in the list twice" },
      { function() hand:grasp({ wires[2], wires[3] }, { s = { 0.1, 9 } }) end, "wire3" },
      { function() hand:grasp({ wires[2], wires[3] }, { s = { 0.1 } }) end, "1 place for 2 wires" },
      { function() hand:grasp({}) end, "a list of wires, got an empty table" },
      { function() hand:grasp(hand) end, "a list of wires, got a gripper" },
      { function() hand:grasp(scene:obstacle{ shape = "plane" }) end, "a list of wires, got an obstacle" },
      { function() scene:run{ duration = 0 / 0 } end, "duration = nan s is not allowed" },
      { function() hand:grasp(nil, { s = 0.1 }) end, "a list of wires, got nil" },
      { function() hand:grasp(wires[2], { approach = "plates", force = 1 }) end, "already holds a wire" },
      { function() hand:release{ wire = wires[2] } end, "does not hold wire 'wire2'" },
      { function() hand:force{ wire = wires[2] } end, "does not hold wire 'wire2'" },
    } do
      local fine, why = pcall(case[1])
      assert.is_false(fine)
      assert.truthy(why:find(case[2], 1, true), why)
      assert.are.equal(1, #hand.wires)
    end
    assert.is_true(scene:run{ duration = 0.05 }.ok)
    hand:move{ by = { 0, 0, 0.1 }, duration = 1 }
    local fine, why = pcall(hand.grasp, hand, wires[2], { s = 0.1 })
    assert.is_false(fine)
    assert.truthy(why:find("is moving until", 1, true), why)
  end)

  it("goes on from a file", function()
    local scene, wires = scene_with(2)
    local hand = scene:gripper{ name = "hand" }
    hand:grasp(wires, { s = 0.1 })
    hand:move{ by = { 0, 0, 0.05 }, duration = 0.2 }
    scene:run{ duration = 0.3, dt = 0.01 }
    local name = os.tmpname()
    scene:save(name)
    local other = sw.load(name)
    local same = other:find "hand"
    assert.are.same(hand:series(), same:series())
    assert.are.equal(2, #same.wires)
    assert.are.same(hand:force{ wire = wires[2] }, same:force{ wire = other:find "wire2" })
    same:release()
    assert.is_true(other:run{ duration = 0.05 }.ok)
    os.remove(name)
  end)
end)
