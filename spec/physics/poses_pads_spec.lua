-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that hold a cable while it is laid on a table in slow handling. From the place of the last pose, pads
-- that move across the cable press from one side only; the iteration lost their friction, and the cable fell
-- out of pads that could hold a hundred times its weight: 31 of 45 runs like these ended so, or with "not at
-- rest", after 20,000 to 1,300,000 iterations.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Lifts the end of a cable by 0.1 m, then lowers it and moves it aside by `aside` for each half of the
-- height. approach, force: of the grasp, nil for a rigid grip; share: distance of the pads over the
-- diameter, instead of a force. Returns the forces of the hand [N] after each part, the place of the other
-- end [m], and the run.
local function laid(case, approach, force, share)
  local scene = sw.scene{}
  local c, s = math.cos(case.yaw), math.sin(case.yaw)
  local function at(x, y, z) return { c * x - s * y, s * x + c * y, z } end
  local r = sw.scene{}:wire{ cable = case.cable, from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }.radius
  scene:obstacle{ shape = "plane", friction = case.friction }
  local from, to = at(0, 0, r), at(0.4, 0, r)
  if case.turned then from, to = to, from end
  local wire = scene:wire{ cable = case.cable, from = from, to = to, segments = case.segments }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, height = 0.01, friction = 0.5 } }
  local forces = {}
  scene:process(function()
    hand:grasp(wire, { s = case.turned and 0.03 or 0.37, approach = approach, force = force,
      distance = share and share * 2 * r })
    hand:move{ by = at(-0.05, 0, 0.1), duration = 2 }
    forces[1] = hand:force()
    hand:move{ by = at(0, case.aside, -0.05), duration = 2, law = "linear" }
    forces[2] = hand:force()
    hand:move{ by = at(0.02, case.aside, -0.05), duration = 2, law = "linear" }
  end)
  local run = t.fine(scene:run{ dt = case.dt, quasistatic = true })
  assert.are.same({}, hand.events)
  return forces, wire:position(case.turned and 0.4 or 0), run
end

-- { friction, segments, aside [m], yaw [rad], ends swapped }
local ways = { { 0.3, 37, 0.05, 0, false }, { 0.3, 37, 0.05, 0.8, true }, { 1, 30, 0.02, 2, false },
  { 0, 41, 0.1, 0, true } }

describe("pads in poses", function()
  for _, row in ipairs{ { "GXL 1.5", 0.05 }, { "FLRY-B 0.5", 0.1 }, { "H07V-K 4", 0.02 } } do
    it(("lay %s on a table as a rigid grip does"):format(row[1]), function()
      for k, way in ipairs(ways) do
        local case = { cable = row[1], dt = row[2], friction = way[1], segments = way[2], aside = way[3],
          yaw = way[4], turned = way[5] }
        local what = ("%s, way %d"):format(case.cable, k)
        local rigid, there = laid(case)
        local function check(how, ...) -- with a force, or at a distance between the pads
          local forces, place, run = laid(case, "plates", ...)
          for i = 1, 2 do -- pads hold 20 mm, a rigid grip one place: the bend beside them differs
            t.below(0.05 * rigid[i]:norm(), (forces[i] - rigid[i]):norm(), what .. how .. ": force " .. i)
          end
          t.below(2e-3, (place - there):norm(), what .. how .. ": place of the other end")
          t.below(20000, run.iterations, what .. how .. ": iterations")
        end
        check(", force", 10)
        if k < 3 then check(", distance", nil, 0.95) end
      end
    end)
  end

  -- The search for a pose in which touches begin to slide takes several steps. Pads counted the slip of the
  -- last one: 17.8 of 20 mm at 20 ms.
  it("tell the whole way that a cable drawn harder than friction slips", function()
    for _, row in ipairs{ { "GXL 1.5", 0.02, 41 }, { "FLRY-B 2.5", 0.1, 53 }, { "H07V-K 4", 0.05, 41 } } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = row[1], from = { 0, 0, 0 }, to = { 0.4, 0, 0 }, segments = row[3] }
      scene:clamp(wire, { s = 0 })
      local hand = scene:gripper{ pads = { width = 0.02, height = 0.01, friction = 0.5 } }
      local before
      scene:process(function()
        hand:grasp(wire, { s = 0.3, approach = "plates", force = 10 })
        before = hand:position()
        hand:move{ by = { 0.02, 0, 0 }, duration = 4, law = "linear" }
      end)
      t.fine(scene:run{ dt = row[2], quasistatic = true })
      local way, stretch = (hand:position() - before)[1], wire:position(0.4)[1] - 0.4
      assert.are.equal("slip", hand.events[1].kind)
      t.near(way - stretch, hand:state().slip, 5e-5, row[1] .. ": slip")
      t.near(10, hand:force()[1], 0.05, row[1] .. ": force")
    end
  end)

  -- At the most that the pads bear, the cable turns in one hand by half a radian at once. Newton's iteration
  -- ended with the cable beside the pads, without a force: 5 of 7 such runs.
  it("keep a stiff cable that two hands push together until it turns in them", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ cable = "H07V-K 4", from = { 0.4, 0, 0 }, to = { 0, 0, 0 }, segments = 37 }
    local hands = {}
    for k, side in ipairs{ 1, -1 } do
      local hand = scene:gripper{ pads = { width = 0.02, height = 0.01, friction = 0.5 } }
      hands[k] = hand
      scene:process(function()
        hand:grasp(wire, { s = k == 1 and 0.35 or 0.05, approach = "plates", force = 10 })
        hand:move{ by = { 0.035 * side, 0, 0 }, duration = 2,
          turn = { axis = { 0, 1, 0 }, angle = -0.3 * side } }
        hand:move{ by = { 0.02 * side, -0.015 * side, 0 }, duration = 1 }
      end)
    end
    local run = t.fine(scene:run{ dt = 0.05, quasistatic = true, duration = 2.7 })
    for _, e in ipairs(run.events) do assert.are_not.equal("lost", e.kind) end
    local a, b = hands[1]:force(), hands[2]:force()
    t.near(0, (a + b):norm(), 1e-5, "sum of forces")
    t.near(1.05, a:norm(), 0.3, "push") -- 1.2 N before it turns in a hand, 0.9 N when it turned in both
  end)

  -- A trial with another force found no rest, and the best one was repeated by a rule that lets the wire
  -- leave the pads: lost at 4 s. Motion and poses of 0.1 s kept it.
  it("keep a stiff cable where a trial of the jaws finds no rest", function()
    local c, s = math.cos(0.7), math.sin(0.7)
    local function at(x, y, z) return { c * x - s * y, s * x + c * y, z } end
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ cable = "H07V-K 10", from = at(0.4, 0, 0.2), to = at(0, 0, 0.2), segments = 57 }
    for k, side in ipairs{ 1, -1 } do
      local hand = scene:gripper{ pads = { width = 0.02, height = 0.01, friction = 0.5 } }
      scene:process(function()
        hand:grasp(wire, { s = k == 1 and 0.35 or 0.05, approach = "plates", force = 10 })
        hand:move{ by = k == 1 and at(0.03, 0, 0.01) or at(-0.04, 0, 0.02), duration = 3,
          turn = { axis = at(0, 1, 0), angle = -0.3 * side } }
        if k == 2 then hand:move{ by = at(-0.04, 0.03, 0), duration = 2 } end
      end)
    end
    local run = t.fine(scene:run{ dt = 0.02, quasistatic = true })
    for _, e in ipairs(run.events) do assert.are_not.equal("lost", e.kind) end
  end)
end)
