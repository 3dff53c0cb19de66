-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:remove with grippers.
local sw = require "softworld"
local leaving = require "spec.scene.leaving"

local rod, three, at, refused = leaving.rod, leaving.three, leaving.at, leaving.refused
local R = 0.0025

describe("scene:remove with grippers", function()
  local function table_with(approach, work, alone)
    local scene = sw.scene{ name = approach }
    scene:obstacle{ shape = "plane", friction = 0.3 }
    local a = rod(scene, "a", 0, { E = 5e6, from = { 0, 0, R }, to = { -0.3, 0, R } })
    if not alone then rod(scene, "b", 0.1, { E = 5e6, from = { 0, 0.1, R }, to = { -0.3, 0.1, R } }) end
    local pads = approach ~= "imposed"
    local hand = scene:gripper{ name = "hand", pads = pads and { friction = 0.6 } or nil }
    scene:process(function(p)
      hand:grasp(a, { s = 0.02, approach = approach, force = pads and 2 or nil })
      hand:move{ by = { 0, 0, 0.05 }, speed = 0.2 }
      work(scene, hand, a, p)
    end)
    return scene:run{ dt = 0.005 }, scene, hand, a
  end

  for _, approach in ipairs{ "imposed", "plates", "mixed" } do
    it("a gripper lets its wire fall, and its handle refuses further calls, " .. approach, function()
      local run, scene, hand, a = table_with(approach, function(scene, hand, _, p)
        scene:remove(hand)
        p:wait(0.05)
      end)
      assert.is_true(run.ok, run.reason)
      -- free fall in 0.05 s: g t^2 / 2 = 12 mm from 52.5 mm; the part that still lies holds the wire back
      local z = a:position(0.02)[3]
      assert.is_true(z < 0.05 and z > 0.040, tostring(z))
      assert.are.equal("rod", a.model)
      assert.is_true(hand.peak_force > 0)
      refused("gripper 'hand' was taken away at t =", function() hand:move{ by = { 0, 0, 1 } } end)
      refused("gripper 'hand' was taken away at t =", function() scene:remove(hand) end)
      assert.are.equal("gripper 'hand' (taken away)", tostring(hand))
      assert.are.equal(0, #scene:describe().grippers)
      local frames = run:document().frames
      assert.is_false(frames[#frames].grips[1] or false)
    end)

    for _, alone in ipairs{ false, true } do
      local title = ("a gripper whose %swire is taken away goes on with nothing, %s"):format(
        alone and "only " or "", approach)
      it(title, function()
        local run, _, hand = table_with(approach, function(scene, hand, a, p)
          scene:remove(a)
          p:wait(0.02)
          assert.is_nil(hand.wire)
          hand:release()
          hand:move{ by = { 0, 0, 0.02 }, speed = 0.2 }
        end, alone)
        assert.is_true(run.ok, run.reason)
        assert.are.same({}, hand.wires)
        assert.are.same({ 0, 0, 0 }, hand:force())
        refused("holds nothing", function() hand:release() end)
      end)
    end
  end

  it("ends a process whose gripper is taken away, and the run goes on", function()
    local scene = sw.scene()
    local a = rod(scene, "a", 0)
    local hand = scene:gripper{ name = "hand", at = { 0, 0, 0.1 } }
    scene:process(function(p)
      hand:grasp(a, { s = 0.02 })
      p:wait(0.05)
      hand:move{ by = { 0, 0, 0.1 }, speed = 1 }
    end)
    local later
    scene:process(function(p)
      p:wait(0.1)
      later = p.time
    end)
    at(scene, 0.02, function() scene:remove(hand) end)
    local run = scene:run{ dt = 0.005 }
    assert.is_true(run.ok, run.reason)
    assert.are.near(0.1, later, 1e-9)
    assert.are.near(0.05, run.events[2].time, 1e-9)
    assert(run.events[2].text:find("process 1 ends: .*gripper 'hand' was taken away at t = 0.02 s"))
    -- a process that uses what it removed itself: an error of the script
    local other = sw.scene()
    local b = rod(other, "b", 0)
    rod(other, "c", 0.1)
    other:process(function(p)
      p:wait(0.01)
      other:remove(b)
      b:position(0)
    end)
    refused("'b' was taken away from scene", function() other:run{ dt = 0.005 } end)
  end)

  it("ends a process whose wire is taken away during or before a grasp", function()
    -- the jaws close from 14 mm to 4.5 mm at 20 mm/s, in 0.475 s; a mixed grasp waits for at least 40 ms
    for _, case in ipairs{ { "plates", 0.2, distance = 0.0045 }, { "mixed", 0.46, force = 2 },
      { "tie", 0.005 }, { "imposed", 0.005 } } do
      local how, when = case[1], case[2]
      local scene = sw.scene()
      local a = rod(scene, "a", 0, { E = 5e6, from = { 0, 0, R }, to = { -0.3, 0, R } })
      rod(scene, "b", 0.1, { from = { 0, 0.1, R }, to = { -0.3, 0.1, R } })
      scene:obstacle{ shape = "plane", friction = 0.3 }
      local pads = how == "plates" or how == "mixed"
      local hand = scene:gripper{ name = "hand", pads = pads and { friction = 0.6, opening = 0.014 } or nil }
      scene:process(function(p)
        if not pads then p:wait(0.01) end
        if how == "tie" then scene:tie(a, { s = 0.1 }) end
        hand:grasp(a, { s = 0.02, approach = how, distance = case.distance, force = case.force })
        assert(false, "it has grasped what was not there")
      end)
      at(scene, when, function() scene:remove(a) end)
      local run = scene:run{ dt = 0.005 }
      assert.is_true(run.ok, run.reason)
      local last = run.events[#run.events]
      assert(last.text:find("process 1 ends: .*'a' was taken away from scene", 1), last.text)
      assert.is_nil(hand.wire)
    end
  end)

  it("leaves everything as it was when the motion of a hold on the wire fails", function()
    local scene, a = three()
    local hand = scene:gripper{ name = "hand", pads = { friction = 0.6, opening = 0.014 } }
    hand:grasp(a, { s = 0.02, approach = "plates", force = 2 })
    local clamp, fails = scene:clamp(a, { s = 0.4 }), false
    clamp:follow(function()
      if fails then error "no place" end
      return { -0.4, 0, 0.1 }
    end)
    scene:run{ duration = 0.01, dt = 0.005 }
    fails = true
    refused("no place", function() scene:remove(a) end)
    assert.is_true(a.present and clamp.held)
    assert.are.equal(a, hand.wire)
    fails = false
    scene:remove(a)
    assert.is_nil(hand.wire)
  end)

  it("refuses a gripper's part and its grip, and names the gripper", function()
    table_with("plates", function(scene, hand)
      refused("is a part of gripper 'hand'; remove the gripper", function()
        scene:remove(hand.obstacles[1])
      end)
    end)
    table_with("imposed", function(scene, hand)
      refused("the grip of gripper 'hand'", function() scene:remove(hand.hold) end)
    end)
  end)

  it("is undone by a snapshot: the gripper is back with its wire", function()
    local scene = sw.scene()
    local a = rod(scene, "a", 0)
    local hand = scene:gripper{ name = "hand", at = { 0, 0, 0.1 } }
    hand:grasp(a, { s = 0.02 })
    scene:run{ duration = 0.01, dt = 0.005 }
    local snapshot = scene:snapshot()
    scene:remove(hand)
    assert.is_false(hand.past[1].held)
    scene:restore(snapshot)
    assert.is_nil(hand.left)
    assert.are.equal(a, hand.wire)
    hand:move{ by = { 0, 0, 0.01 }, speed = 1 }
    scene:run{ duration = 0.02, dt = 0.005 }
    assert.are.near(0.11, hand:position()[3], 1e-9)
  end)
end)
