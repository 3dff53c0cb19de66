-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two mixed grips on one wire. Only one of them can have a mesh between its pads at a time: a second one that
-- thaws presses on a rod.
local sw = require "softworld"
local t = require "physics.tools"

local L, mm = 0.4, sw.units.mm

-- A cable in the air between grippers A and B, both frozen. act(p, A, B): what happens then. o: cable,
-- dt [s], swap: the wire's ends. Returns the run, the grippers and the wire's weight [N].
local function carried(o, act)
  local scene = sw.scene{}
  local ends = { { -L / 2, 0, 0 }, { L / 2, 0, 0 } }
  local wire = scene:wire{ cable = o.cable, from = ends[o.swap and 2 or 1], to = ends[o.swap and 1 or 2],
    segments = 40 }
  scene:force{ kind = "damping", mass = 8 }
  local function hand(name, x)
    return scene:gripper{ name = name, at = { x, 0, 0 },
      pads = { width = mm(12), friction = 0.5, opening = 4 * wire.radius } }
  end
  local A, B = hand("A", -0.1), hand("B", 0.1)
  local table_top = scene:obstacle{ shape = "plane", at = { 0, 0, -wire.radius }, friction = 0.3 }
  scene:process(function(p)
    A:grasp(wire, { s = o.swap and 0.3 or 0.1, approach = "mixed", force = 10 })
    B:grasp(wire, { s = o.swap and 0.1 or 0.3, approach = "mixed", force = 10 })
    table_top:follow{ relative = true, points = { { 0, 0, 0 }, { 0, 0, -0.5 } }, duration = 0.5 }
    p:wait(1.5)
    act(p, A, B)
  end)
  return t.fine(scene:run{ dt = o.dt }), wire, A, B, wire.beam.mass_per_length * L * 9.81
end

local function kinds(hand)
  local list = {}
  for _, e in ipairs(hand.events) do list[#list + 1] = e.kind .. (e.on and " on " .. e.on or "") end
  return table.concat(list, " ")
end

describe("two mixed grips on one wire", function()
  for _, o in ipairs{ { cable = "GXL 1.5", dt = 0.01 }, { cable = "GXL 1.5", dt = 0.005, swap = true },
    { cable = "FLRY-B 2.5", dt = 0.005, swap = true }, { cable = "H07V-K 4", dt = 0.005 } } do
    local case = ("%s, %g s"):format(o.cable, o.dt)
    it("both thaw, and go on to bear the wire: " .. case, function()
      local frozen, thawed
      local _, wire, A, B, weight = carried(o, function(p, A, B)
        frozen = A:force()[3] + B:force()[3]
        A:thaw()
        p:wait(0.3)
        B:thaw()
        p:wait(1.2) -- its pads catch the wire, which swings for a while
        thawed = A:force()[3] + B:force()[3]
        t.near(0.5, A:force()[3] / thawed, 0.1, "share of A")
        for _, hand in ipairs{ A, B } do t.above(9.5, hand:state().squeeze, "squeeze [N]") end
        t.below(0.1, math.abs(A:squeeze().share), "share of the height that is pressed in")
        assert.error_matches(function() B:squeeze() end, "it is a line of particles")
      end)
      assert.equal("frozen thawed", kinds(A))
      assert.equal("frozen thawed on rod", kinds(B))
      t.share(weight, frozen, 0.01)
      t.share(weight, thawed, 0.01)
      -- While B's jaws close again the wire falls by up to 0.25 mm there, as g t^2/2 in 7 ms.
      for _, s in ipairs{ 0.1, 0.3 } do t.near(0, wire:position(s)[3], 5e-4, "height in the pads") end
    end)
  end

  it("the second one grasps once the first one is frozen, and the message before says so", function()
    local scene = sw.scene{}
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { L, 0, 0 } }
    scene:obstacle{ shape = "plane", at = { 0, 0, -wire.radius } }
    local A, B = scene:gripper{ pads = { width = mm(12) } }, scene:gripper{ pads = { width = mm(12) } }
    local ok, message
    scene:process(function()
      A:grasp(wire, { s = 0.1, approach = "mixed", force = 5, freeze = false })
      ok, message = pcall(B.grasp, B, wire, { s = 0.3, approach = "mixed", force = 5 })
      A:freeze()
      B:grasp(wire, { s = 0.3, approach = "mixed", force = 5 })
    end)
    t.fine(scene:run{ dt = 0.01 })
    assert.is_false(ok)
    assert.matches("it is a line of particles, .*freeze that one first", message)
    assert.equal("frozen", kinds(B))
  end)

  it("the second one opens, and the first one keeps its mesh and the wire", function()
    local o, model, force = { cable = "FLRY-B 2.5", dt = 0.005 }, nil, nil
    local _, wire, A, B, weight = carried(o, function(p, A, B)
      A:thaw()
      p:wait(0.1)
      B:release()
      p:wait(1)
      model, force = A.wires[1].model, A:force()[3]
      A:release()
    end)
    assert.equal("frozen thawed on rod", kinds(B))
    assert.equal("radial", model)
    t.share(weight, force, 0.03) -- it still swings a little
    assert.equal("rod", wire.model)
    assert.equal("frozen thawed", kinds(A))
  end)

  it("the first one freezes again, and the second one has its mesh back", function()
    local o = { cable = "GXL 1.5", dt = 0.005 }
    local _, _, A, B = carried(o, function(p, A, B)
      A:thaw()
      p:wait(0.1)
      A:freeze()
      p:wait(0.1)
      B:thaw()
      p:wait(0.1)
    end)
    assert.equal("frozen thawed frozen", kinds(A))
    assert.equal("frozen thawed", kinds(B))
  end)
end)
