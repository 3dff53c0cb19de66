-- SPDX-License-Identifier: GPL-3.0-or-later
-- Jaws that keep a force where nothing moves: in quasi-static runs, and when a scene settles.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r, speed = 0.003, 0.02
local section = { model = "radial", body = "solid", E = 5e6 }

local function new_wire(scene, args)
  local p = { E = 5e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r }, to = { 0.2, 0, r } }
  for k, v in pairs(args or {}) do p[k] = v end
  return scene:wire(p)
end

local function new_scene(args)
  local scene = sw.scene{}
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  return scene, new_wire(scene, args)
end

local function new_gripper(scene, pads)
  local p = { width = 0.02, friction = 0.6, opening = 3 * r }
  for k, v in pairs(pads or {}) do p[k] = v end
  return scene:gripper{ name = "hand", pads = p }
end

local function weight_of(wire) return wire.beam.mass_per_length * 9.81 * wire.length end

local function run(scene, body, dt)
  scene:process(body)
  return t.fine(scene:run{ dt = dt or 0.02, quasistatic = true })
end

-- Returns the rows of the gripper's series from a time on: time, opening, squeeze.
local function rows(g, from)
  local series, list = g:series(), {}
  for i, at in ipairs(series.t) do
    if at >= from - 1e-9 then list[#list + 1] = { at, series.opening[i], series.squeeze[i] } end
  end
  return list
end

describe("jaws in a quasi-static run", function()
  it("meet the force at every pose, and never move faster than their speed", function()
    for _, args in ipairs{ {}, section } do
      local scene, wire = new_scene(args)
      local g, held = new_gripper(scene), nil
      run(scene, function(p)
        g:grasp(wire, { s = 0.1, approach = "plates", force = 4, speed = speed })
        assert.equal("holds", g:state().jaws)
        held = scene.time
        g:move{ by = { 0.02, 0, 0.05 }, duration = 1 }
        g:rotate{ axis = { 1, 0, 0 }, angle = 0.6, duration = 0.5 }
        p:wait(0.1)
      end, 0.05)
      local list = rows(g, held)
      t.above(20, #list, "poses")
      for _, row in ipairs(list) do t.share(4, row[3], 1e-3, ("force at %g s"):format(row[1])) end
      local before
      for _, row in ipairs(rows(g, 0)) do
        if before then
          local most = speed * (row[1] - before[1]) * (1 + 1e-9)
          t.below(most, math.abs(row[2] - before[2]), "way of the jaws")
        end
        before = row
      end
      t.share(weight_of(wire), g:force()[3], 1e-4, "weight")
    end
  end)

  it("have the opening of a run in motion that has come to rest", function()
    for _, args in ipairs{ {}, section, { model = "tube", E = 5e6 } } do
      local opening = {}
      for _, still in ipairs{ false, true } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        if not still then scene:force{ kind = "damping", mass = 20 } end
        local wire = new_wire(scene,
          { model = args.model, body = args.body, E = args.E, to = { 0.03, 0, r } })
        local g = new_gripper(scene)
        scene:process(function(p)
          g:grasp(wire, { s = 0.015, approach = "plates", force = 4 })
          p:wait(0.2)
        end)
        t.fine(scene:run{ dt = still and 0.02 or 0.005, quasistatic = still })
        t.share(4, g:state().squeeze, 1e-3, "force")
        opening[#opening + 1] = g:state().opening
      end
      -- each force may be off by 0.1 % of 4 N; the softest wire gives way by 0.1 mm under 4 N
      t.near(opening[1], opening[2], 2e-7, "opening")
    end
  end)

  it("carry the wire's weight with two grippers", function()
    local scene, wire = new_scene()
    local left = scene:gripper{ pads = { opening = 3 * r } }
    local right = scene:gripper{ pads = { opening = 3 * r } }
    local function hand(g, s, force)
      return function(p)
        g:grasp(wire, { s = s, approach = "plates", force = force })
        p:wait(0.5 - scene.time)
        g:move{ by = { 0, 0, 0.05 }, duration = 1 }
        p:wait(0.1)
      end
    end
    scene:process(hand(left, 0.05, 3))
    run(scene, hand(right, 0.16, 5), 0.05)
    t.share(weight_of(wire), left:force()[3] + right:force()[3], 1e-4, "sum of forces")
    t.share(3, left:state().squeeze, 1e-3, "left")
    t.share(5, right:state().squeeze, 1e-3, "right")
    t.above(0.03, wire:position(0)[3], "lifted")
  end)

  it("load the gripper as statics says when a wire is lifted from a table (case 09)", function()
    -- of the part that hangs free: M^2 / (2 EI) = w y - V sin theta, see gripper_spec
    local l, h, radius, density = 0.15, 0.075, 0.0025, 1500
    local w = density * 9.81 * math.pi * radius ^ 2
    local EI, L, width = w * l ^ 3, 5 * l, 0.02
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0 }
    local wire = scene:wire{ E = 4 * EI / (math.pi * radius ^ 4), nu = 0.3, density = density,
      radius = radius, from = { 0, 0, radius }, to = { L, 0, radius }, segments = 200 }
    local g = scene:gripper{ pads = { width = width, friction = 0.8, opening = 3 * radius } }
    run(scene, function()
      g:grasp(wire, { s = L - width / 2, approach = "plates", force = 20 })
      g:move{ by = { 0, 0, h }, duration = 1 }
    end, 0.1)
    local s = L - 1.5 * width -- a little outside the pads
    local M, expected = t.lifted(g, wire, s, w, EI)
    t.share(expected, M, 0.01, "moment")
  end)

  it("do not lift a wire without friction, and lose one that slips", function()
    for _, row in ipairs{ { 0, 4 }, { 0.6, 0.04 } } do -- the second row holds 0.7 of the weight
      local scene, wire = new_scene()
      local g = new_gripper(scene, { friction = row[1] })
      run(scene, function(p)
        g:grasp(wire, { s = 0.1, approach = "plates", force = row[2] })
        g:move{ by = { 0, 0, 0.05 }, duration = 1 }
        p:wait(0.5)
      end, 0.05)
      local last = g.events[#g.events]
      assert.equal("lost", last.kind)
      if row[1] > 0 then assert.equal("slip", g.events[1].kind) end
      assert.equal("empty", g:state().jaws)
      assert.equal(0, g:force()[3])
      for s = 0, 0.2, 0.05 do t.near(r, wire:position(s)[3], 1e-4, "lies on the table") end
    end
  end)

  it("let a mesh without friction go too", function()
    local scene, wire = new_scene{ model = "radial", body = "solid", E = 5e6, to = { 0.05, 0, r } }
    local g = new_gripper(scene, { friction = 0 })
    run(scene, function(p)
      g:grasp(wire, { s = 0.025, approach = "plates", force = 1 })
      g:move{ by = { 0, 0, 0.03 }, duration = 1 }
      p:wait(0.5)
    end, 0.05)
    assert.equal("lost", g.events[#g.events].kind)
    assert.equal("empty", g:state().jaws)
    t.near(r, wire:position(0.025)[3], 0.1 * r, "lies on the table")
  end)

  it("report what they cannot do, as in motion", function()
    local scene, wire = new_scene{ E = 2e6 }
    local g, why = new_gripper(scene), nil
    run(scene, function()
      local _, message = pcall(g.grasp, g, wire, { s = 0.1, approach = "plates", force = 1e5 })
      why = message
    end)
    assert.is_truthy(why:find("crushes the wire", 1, true), why)
    assert.equal("crushed", g.events[1].kind)
    t.fine(scene:run{ duration = 0.02, dt = 0.01, quasistatic = true })
    scene, wire = new_scene()
    g = scene:gripper{ name = "hand", at = { 0.1, 0.05, 0.05 }, rotation = { 1, 0, 0, 0 },
      pads = { opening = 3 * r } }
    run(scene, function()
      local _, message = pcall(g.grasp, g, wire, { approach = "plates", force = 1 })
      why = message
    end)
    assert.is_truthy(why:find("closed on nothing", 1, true), why)
    assert.equal("missed", g.events[1].kind)
    assert.equal("rests", g:state().jaws) -- told to stay
  end)

  it("stop at a given force limit", function()
    local scene, wire = new_scene(section)
    local g = new_gripper(scene)
    run(scene, function()
      g:grasp(wire, { s = 0.1, approach = "plates", distance = 2.2 * r })
      assert.equal("rests", g:state().jaws)
      g:close_jaws{ distance = 0, force = 3 }
      assert.equal("stopped", g:state().jaws)
      t.share(3, g:state().squeeze, 0.05, "force that stops") -- a limit, not a control
    end)
  end)

  it("go on from a snapshot with the same bits", function()
    local scene, wire = new_scene(section)
    local g = new_gripper(scene)
    run(scene, function() g:grasp(wire, { s = 0.1, approach = "plates", force = 3 }) end)
    local snapshot = scene:snapshot()
    local function on()
      run(scene, function() g:move{ by = { 0, 0, 0.01 }, duration = 0.2 } end)
      return wire:positions(), g:series()
    end
    local x, series = on()
    scene:restore(snapshot)
    local y, again = on()
    assert.are.same(x, y)
    assert.are.same(series.squeeze, again.squeeze)
  end)
end)

describe("settling between jaws", function()
  local function gripped(E, force)
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    scene:force{ kind = "damping", mass = 8, stiffness = 2e-3 }
    local wire = new_wire(scene, { model = "radial", body = "solid", E = E })
    local g = new_gripper(scene)
    scene:process(function() g:grasp(wire, { s = 0.1, approach = "plates", force = force }) end)
    t.fine(scene:run{ dt = 0.01 })
    assert.equal("holds", g:state().jaws)
    return scene, g
  end

  it("keeps the force that the jaws hold with", function()
    -- in motion, jaws count as holding once they have met the force, before all is at rest
    local scene, g = gripped(4e6, 7)
    local before = g:state()
    t.above(2e-3, math.abs(before.squeeze / 7 - 1), "not at rest yet: off by")
    t.fine(scene:settle())
    t.share(7, g:state().squeeze, 1e-3, "force per finger")
    assert.equal("holds", g:state().jaws)
    t.above(1e-7, math.abs(g:state().opening - before.opening), "jaws gave way by")
  end)

  it("keeps the force of other jaws and sections, and ends where it began if it is repeated", function()
    -- When touches that motion had made stiff became soft again in every search, one of these forces was
    -- 0.3 % off, and with a table as stiff as ten sections up to 1.1 %.
    for _, case in ipairs{ { 2e7, 4 }, { 2e7, 6 }, { 5e6, 2 }, { 5e6, 3 } } do
      local scene, g = gripped(table.unpack(case))
      t.fine(scene:settle())
      t.share(case[2], g:state().squeeze, 1e-3, ("force per finger of %g N"):format(case[2]))
      t.fine(scene:settle()) -- the first one ends some nanometres off the next
      local settled = g:state().opening
      t.fine(scene:settle())
      if case[1] == 2e7 then t.near(settled, g:state().opening, 1e-9, "opening, settled again") end
    end
  end)

  it("leaves jaws in place that hold nothing yet", function()
    local scene, wire = new_scene()
    local g = new_gripper(scene)
    g:grasp(wire, { s = 0.1, approach = "plates", force = 4 })
    t.fine(scene:settle())
    assert.equal("moves", g:state().jaws)
    t.near(3 * r, g:state().opening, 1e-12, "opening")
  end)
end)
