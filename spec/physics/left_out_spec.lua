-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that grasp a list of wires: each of them must be pressed, and one that is lost is told.
local sw = require "softworld"
local mm = sw.units.mm

local RADIUS = { ["GXL 0.5"] = 1.2e-3, ["GXL 1.5"] = 1.5e-3, ["FLRY-B 2.5"] = 1.5e-3,
  ["H07V-K 4"] = 2.175e-3 }

--- Returns a scene, two cables that lie on each other (apart = nil) or beside each other, and a gripper.
local function scene_of(cables, apart, shape)
  local scene, wires = sw.scene{}, {}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i, cable in ipairs(cables) do
    local r = RADIUS[cable]
    local y = apart and (i - 1) * apart or 0
    local z = (apart or i == 1) and r or 2 * RADIUS[cables[1]] + r + 1e-5
    wires[i] = scene:wire{ name = "w" .. i, cable = cable, segments = 40, from = { -0.1, y, z },
      to = { 0.1, y, z } }
  end
  scene:wire_contact{ friction = 0.1 }
  scene:force{ kind = "damping", mass = 8, stiffness = 0.002 }
  local hand = scene:gripper{ name = "hand", rating = false,
    pads = { shape = shape, width = mm(20), friction = 0.5, opening = mm(12) } }
  return scene, wires, hand
end

--- Grasps both and lifts; returns the run, what the grasp raised (or nil), the wires, the gripper.
local function lift(cables, args)
  local scene, wires, hand = scene_of(cables, args.apart, args.shape)
  local why
  scene:process(function(p)
    local how = { s = 0.1, approach = "plates", force = args.force or 15 }
    local fine, text = pcall(hand.grasp, hand, wires, how)
    if not fine then
      why = text
      return
    end
    hand:move{ by = { 0, 0, 0.06 }, duration = 0.6 }
    p:wait(0.3)
    for _, wire in ipairs(wires) do hand:force{ wire = wire } end -- also of one that was lost
  end)
  local run = scene:run{ dt = 0.01, quasistatic = args.quasistatic }
  assert.is_true(run.ok, run.reason)
  return run, why, wires, hand
end

describe("a list of wires between pads", function()
  it("is refused if a thin wire on or below a thick one is not pressed", function()
    for cables, name in pairs{ [{ "GXL 0.5", "H07V-K 4" }] = "w1", [{ "H07V-K 4", "GXL 1.5" }] = "w2" } do
      local run, why, _, hand = lift(cables, {})
      assert.truthy(why and why:find("gripper 'hand' leaves out wire '" .. name .. "'", 1, true), why)
      assert.truthy(why:find("side by side", 1, true), why)
      assert.equal(0, #hand.wires)
      assert.equal("grasp", run.events[1].kind)
    end
  end)

  it("is refused if a wire is beside the pads, whichever comes first, in poses too", function()
    for _, args in ipairs{ {}, { quasistatic = true }, { shape = "round" }, { shape = "v" } } do
      args.apart, args.force = 0.05, 8
      local _, why = lift({ "GXL 1.5", "GXL 1.5" }, args)
      assert.truthy(why and why:find("leaves out wire 'w[12]' %('w[12]' is 5[0-9.]+ mm from"), why)
    end
  end)

  it("is held if each is pressed: on each other with equal diameters, or side by side", function()
    for _, args in ipairs{ {}, { apart = 3e-3 } } do
      local _, why, wires, hand = lift({ "FLRY-B 2.5", "GXL 1.5" }, args)
      assert.is_nil(why)
      assert.equal(2, #hand.wires)
      for _, wire in ipairs(wires) do assert.is_true(wire:position(0.1)[3] > 0.05) end
    end
  end)

  it("tells which wire is lost, and goes on with the other", function()
    local _, why, wires, hand = lift({ "FLRY-B 2.5", "GXL 1.5" }, { force = 0.08 })
    assert.is_nil(why)
    local lost
    for _, event in ipairs(hand.events) do
      if event.kind == "lost" then lost = lost or event end
    end
    assert.equal("w1", lost and lost.wire)
    assert.same({ "w2" }, { hand.wires[1].name })
    assert.is_true(wires[1]:position(0.1)[3] < 0.01 and wires[2]:position(0.1)[3] > 0.05)
    assert.same({ 0, 0, 0 }, hand:force{ wire = wires[1] })
  end)
end)
