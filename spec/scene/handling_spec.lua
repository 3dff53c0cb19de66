-- SPDX-License-Identifier: GPL-3.0-or-later
-- Grippers over several grasps: one series, several wires, moves while empty; what a run draws and writes.
local sw = require "softworld"
local core = require "softworld.core"
local vec = require "softworld.vec"
local side_by_side = require "spec.scene.side_by_side"

local scene_with, column = side_by_side.scene_with, side_by_side.column

local function names_of(run)
  local list = {}
  for i, c in ipairs(run:series().columns) do list[i] = c.name end
  return table.concat(list, " ")
end

describe("a gripper that grasps three times", function()
  local scene, wires, hand, run
  local times = {}

  setup(function()
    scene, wires = scene_with(1)
    hand = scene:gripper{ name = "hand" }
    scene:clamp(wires[1], { s = 0.4 })
    scene:process(function(p)
      for k = 1, 3 do
        hand:grasp(wires[1], { s = 0.1 * k })
        times[#times + 1] = { from = p.time }
        hand:move{ by = { 0, 0, 0.01 * k }, speed = 0.2 }
        times[k].to = p.time
        hand:release()
        p:wait(0.2)
      end
    end)
    run = scene:run{ dt = 0.01, frame = 0.02 }
    assert.is_true(run.ok)
  end)

  it("has one series for all grasps", function()
    local _, count = names_of(run):gsub("hand%S*%.force ", "")
    assert.are.equal(1, count)
    assert.is_nil(names_of(run):find("hand#", 1, true))
    local force, time = column(run, "hand.force")
    local held = { 0, 0, 0 }
    for i, t in ipairs(time) do
      for k, span in ipairs(times) do
        if t > span.from + 1e-9 and t <= span.to + 1e-9 then
          assert.are.equal(force[i], force[i], ("a gap at t = %g"):format(t))
          if force[i] > 0 then held[k] = held[k] + 1 end
        end
      end
    end
    for k = 1, 3 do assert.is_true(held[k] > 3, ("grasp %d"):format(k)) end
  end)

  it("has a gap in its series where it holds nothing", function()
    local force, time = column(run, "hand.force")
    for i, t in ipairs(time) do
      if t > times[1].to + 0.02 and t < times[2].from - 0.02 then
        assert.are_not.equal(force[i], force[i])
      end
    end
  end)

  it("averages over the time in which it holds a wire", function()
    local sum, duration = 0, 0
    for _, span in ipairs(times) do
      local m = hand:over(span.from, span.to)
      sum, duration = sum + m.mean_force * m.duration, duration + m.duration
    end
    assert.near(sum / duration, hand.mean_force, 1e-9 * hand.peak_force)
  end)

  it("is one gripper in pictures, at its place", function()
    local doc = run:document()
    assert.are.equal(1, #doc.grips)
    assert.are.equal("hand", doc.grips[1].name)
    local seen = { 0, 0, 0 }
    for _, frame in ipairs(doc.frames) do
      assert.are.equal(1, #frame.grips)
      for k, span in ipairs(times) do
        if frame.t > span.from + 1e-6 and frame.t < span.to - 1e-6 then
          seen[k] = seen[k] + 1
          assert.is_true(frame.grips[1].held)
          assert.near(0.1 * k, frame.grips[1].position[1], 0.01)
        end
      end
    end
    for k = 1, 3 do assert.is_true(seen[k] > 2) end
  end)

  it("is drawn along the wire, whatever the wire's direction", function()
    local s = sw.scene{}
    local wire = s:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 10, from = { 0, 0, 0 },
      to = { 0, 0.5, 0 } }
    s:clamp(wire, { s = 0.5 })
    local g = s:gripper{}
    g:grasp(wire, { s = 0.1 })
    local frame = s:run{ duration = 0.05 }:document().frames[2]
    for _, pose in ipairs{ frame.grips[1], frame.clamps[1] } do
      local x = vec.rotate(pose.rotation, { 1, 0, 0 })
      assert.near(1, math.abs(x[2]), 1e-3)
    end
  end)
end)

describe("pictures and series of a run", function()
  it("have clamps, pins and feeds with their kind, a pin only while it holds", function()
    local scene, wires = scene_with(2)
    scene:clamp(wires[1], { s = 0 })
    scene:feed(wires[2], { s = 0 })
    scene:process(function(p)
      p:wait(0.1)
      local pin = scene:pin(wires[1], { s = 0.4 })
      p:wait(0.1)
      pin:release()
      p:wait(0.1)
    end)
    local doc = scene:run{ dt = 0.01, frame = 0.02 }:document()
    local kinds = {}
    for i, c in ipairs(doc.clamps) do kinds[i] = c.kind end
    assert.are.equal("clamp feed pin", table.concat(kinds, " "))
    for _, frame in ipairs(doc.frames) do
      assert.are.equal(3, #frame.clamps)
      assert.truthy(frame.clamps[1])
      if frame.t < 0.09 or frame.t > 0.23 then assert.is_false(frame.clamps[3]) end
      if frame.t > 0.13 and frame.t < 0.19 then assert.truthy(frame.clamps[3]) end
    end
  end)

  it("have pads from when they exist, and from then on no imposed gripper", function()
    local scene, wires = scene_with(1)
    local hand = scene:gripper{ at = { 0.1, 0, 0.05 } }
    scene:process(function(p)
      hand:approach(wires[1], { s = 0.1 })
      hand:grasp(wires[1])
      p:wait(0.1)
      hand:release()
      hand:grasp(wires[1], { approach = "plates", force = 2 })
      p:wait(0.1)
    end)
    local doc = scene:run{ dt = 0.01, frame = 0.02 }:document()
    local first, last = doc.frames[1], doc.frames[#doc.frames]
    assert.are.equal(3, #doc.obstacles)
    assert.truthy(first.obstacles[1])
    assert.is_false(first.obstacles[2])
    assert.truthy(first.grips[1])
    assert.truthy(last.obstacles[3])
    assert.is_false(last.grips[1])
  end)

  it("have no obstacle after its removal", function()
    local scene = scene_with(1)
    local box = scene:obstacle{ shape = "box", size = { 0.1, 0.1, 0.1 }, at = { 0, 1, 0.05 } }
    scene:process(function(p)
      p:wait(0.1)
      box:remove()
      p:wait(0.1)
    end)
    local frames = scene:run{ dt = 0.01, frame = 0.02 }:document().frames
    assert.truthy(frames[2].obstacles[2])
    assert.is_false(frames[#frames].obstacles[2])
  end)

  it("have columns of tension, bend radius, clips and ties", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 50e6, density = 1500, radius = 0.002, segments = 20,
      from = { 0, 0, 0 }, to = { 0.4, 0, 0 } }
    scene:clip{ name = "c1", at = { 0.2, 0, 0 }, width = 0.01, insertion = 10, retention = 30 }
    scene:tie(wire, { name = "t1", s = 0.1, to = { 0.1, 0, 0 }, slack = 0 })
    local hand = scene:gripper{}
    scene:process(function()
      hand:grasp(wire, { s = 0.38 })
      hand:move{ by = { 0, 0, 0.02 }, speed = 0.2 }
    end)
    local run = scene:run{ dt = 0.005 }
    local tension, bend = column(run, "wire1.tension"), column(run, "wire1.bend_radius")
    local last = #tension
    assert.near(wire:max_tension{ now = true }, tension[last], 1e-12)
    assert.near(wire:min_bend_radius{ now = true }, bend[last], 1e-12)
    local least = math.huge
    for _, r in ipairs(bend) do least = math.min(least, r) end
    assert.near((wire:min_bend_radius()), least, 1e-12)
    local c = scene:find "c1"
    local clip, z, tie = column(run, "c1.force"), column(run, "c1.force_z"), column(run, "t1.force")
    assert.near(vec.norm(c:force()), clip[last], 1e-9)
    assert.near(c:force()[3], z[last], 1e-9)
    assert.is_true(clip[last] > 0.05)
    assert.near(scene:find "t1":tension(), tie[last], 1e-9)
  end)

  it("have a column of a tie between two wires, which is zero once the tie broke", function()
    for _, strength in ipairs{ 1e3, 0.2 } do
      local scene = sw.scene{}
      local wires = {}
      for i, z in ipairs{ 0.1, 0.05 } do
        wires[i] = scene:wire{ E = 50e6, density = 1500, radius = 0.002, segments = 20, from = { 0, 0, z },
          to = { 0.4, 0, z } }
        scene:clamp(wires[i], { s = 0 })
      end
      local tie = scene:tie(wires[1], { name = "t1", s = 0.4, to = { wires[2], s = 0.4 }, slack = 0.06,
        strength = strength })
      scene:force{ kind = "point", on = wires[2], s = 0.4, force = { 0, 0, -0.5 } }
      local run = scene:run{ duration = 0.4, dt = 0.005 }
      local pull = column(run, "t1.force")
      local last, most = #pull, math.max(table.unpack(pull))
      assert.near(tie:tension(), pull[last], 1e-9)
      if strength == 0.2 then
        assert.is_not_nil(tie.broken)
        assert.equal(0, pull[last])
      else
        assert.near(tie.raw_peak_force, most, 1e-9)
        assert.near(tie:force()[3], column(run, "t1.force_z")[last], 1e-9)
        assert.is_true(most > 0.1)
      end
    end
  end)

  it("are kept in files and restored by snapshots", function()
    local scene, wires = scene_with(1)
    scene:clamp(wires[1], { s = 0 })
    scene:run{ duration = 0.1, dt = 0.01 }
    local snapshot = scene:snapshot()
    local before = (wires[1]:log())
    scene:run{ duration = 0.1, dt = 0.01 }
    assert.is_true(#(wires[1]:log()) > #before)
    scene:restore(snapshot)
    assert.are.same(before, (wires[1]:log()))
    local name = os.tmpname()
    scene:save(name)
    assert.are.same(before, (sw.load(name):find "wire1":log()))
    os.remove(name)
  end)
end)

describe("an empty gripper", function()
  it("moves, waits, approaches and retreats, each in its time", function()
    local scene, wires = scene_with(1)
    local hand = scene:gripper{ name = "hand", at = { 0.1, 0, 0.3 } }
    local begun = {}
    local function note(p, what) begun[what] = p.time end
    scene:process(function(p)
      hand:move{ to = { 0.1, 0, 0.2 }, duration = 0.5 }
      note(p, "moved")
      hand:wait(0.25)
      note(p, "waited")
      assert.near(0.2, hand:position()[3], 1e-12)
      hand:approach(wires[1], { s = 0.1, distance = 0.05 })
      note(p, "there")
      assert.near(0, vec.norm(vec.sub(hand:position(), wires[1]:position(0.1))), 1e-6)
      hand:grasp(wires[1])
      hand:retreat{ distance = 0.1 }
      assert.near(0.1025, wires[1]:position(0.1)[3], 1e-4)
      hand:release()
      hand:retreat{ distance = 0.02, direction = { 0, 1, 0 } }
      assert.near(0.02, hand:position()[2], 1e-9)
    end)
    local run = scene:run{ dt = 0.01 }
    assert.is_true(run.ok)
    assert.near(0.5, begun.moved, 1e-9)
    assert.near(0.75, begun.waited, 1e-9)
    assert.is_true(begun.there > 1.5)
    assert.are.equal(1, #run:document().obstacles) -- the table: an imposed grip has no pads
    local grips = run:document().frames
    assert.near(0.3, grips[1].grips[1].position[3], 0.3 * 2 ^ -24) -- frames hold 32-bit floats
    assert.is_false(grips[1].grips[1].held)
  end)

  -- An imposed grip may hold one point; a finger is a body and needs a width.
  it("makes no fingers without a width, and leaves nothing half made", function()
    for _, shape in ipairs{ "flat", "v" } do
      local scene = scene_with(1)
      local hand = scene:gripper{ name = "hand", at = { 0.1, 0, 0.3 }, on_crash = function() end,
        pads = { width = -0.0, shape = shape } }
      local before = core.items(scene)
      local fine, why = pcall(hand.retreat, hand, { distance = 0.1 })
      assert.is_false(fine)
      assert.truthy(why:find("'hand': pads.width = -0 m", 1, true), why)
      assert.same(before, core.items(scene))
    end
  end)

  it("takes its place from an approach if it has none", function()
    local scene, wires = scene_with(1)
    local hand = scene:gripper{}
    scene:process(function()
      hand:approach(wires[1], { s = 0.2 })
      hand:grasp(wires[1])
    end)
    assert.is_true(scene:run{ dt = 0.01 }.ok)
    assert.near(0.2, hand:position()[1], 1e-6)
    assert.is_true(scene.time > 0.5)
  end)

  it("names what is missing: at, s", function()
    local scene, wires = scene_with(1)
    local hand = scene:gripper{ name = "hand" }
    assert.has_error(function() hand:wait(1) end, nil)
    local _, why = pcall(hand.move, hand, { by = { 0, 0, 1 }, speed = 1 })
    assert.truthy(why:find("at = {x, y, z}", 1, true), why)
    scene:process(function() hand:approach(wires[1]) end)
    _, why = pcall(scene.run, scene)
    assert.truthy(why:find("give s [m]", 1, true), why)
  end)

  it("is back at its place after a restore, and repeats the same bits", function()
    local scene, wires = scene_with(2)
    local hand = scene:gripper{ name = "hand", at = { 0.1, 0, 0.1 } }
    local before = scene:snapshot()
    local function pass()
      scene:process(function()
        hand:approach(wires[1], { s = 0.1 })
        hand:grasp(wires)
        hand:retreat()
      end)
      scene:run{ dt = 0.01 }
      return hand:position(), hand:force(), hand:series()
    end
    local at, force, series = pass()
    scene:restore(before)
    assert.are.equal(0, #hand.wires)
    assert.are.same({ 0.1, 0, 0.1 }, hand:position())
    local again, f, same = pass()
    assert.are.same(at, again)
    assert.are.same(force, f)
    assert.are.same(series, same)
  end)
end)
