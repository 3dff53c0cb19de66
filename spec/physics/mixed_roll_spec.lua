-- SPDX-License-Identifier: GPL-3.0-or-later
-- A round cable does not mind how the gripper is rolled about it. A mixed grasp makes it a mesh, whose
-- section is a polygon: pads that press it between a side and a corner turn it like a nut, and only friction
-- holds it. The margin was then tan(angle to the nearest corner)/mu, up to 330 times too large.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local vec = require "softworld.vec"

local LENGTH, AT, MU = 0.2, 0.08, 0.3

-- Returns the margin of a cable that hangs from pads rolled by so many degrees, and their largest one. The
-- scene may be turned with its gravity.
local function hang(cable, force, degrees, turned)
  local a = math.rad(degrees)
  local turn = turned and { 0.5, 0.1, -0.7, 0.5 } or { 1, 0, 0, 0 } -- a unit quaternion
  local function seen(v) return vec.rotate(turn, v) end
  local scene <close> = sw.scene{ gravity = seen{ 9.81, 0, 0 } }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = seen{ LENGTH, 0, 0 }, segments = 24 }
  local clamp = scene:clamp(wire, { s = 0 })
  scene:force{ kind = "damping", mass = 8 }
  local hand = scene:gripper{ name = "hand", at = seen{ AT, 0, 0 },
    rotation = vec.multiply(turn, { math.cos(a / 2), math.sin(a / 2), 0, 0 }),
    pads = { width = 0.014, friction = MU, opening = 3 * wire.radius } }
  local margin
  scene:process(function(p)
    hand:grasp(wire, { s = AT, approach = "mixed", force = force })
    clamp:release()
    p:wait(0.3)
    margin = hand:state().margin
  end)
  t.fine(scene:run{ dt = 0.01 })
  t.share(wire.beam.mass_per_length * LENGTH * 9.81, t.norm(hand:force()), 1e-3, "weight")
  return margin, hand.peak_margin
end

describe("a cable that hangs from a mixed grasp", function()
  for _, c in ipairs{ { "GXL 1.5", 5 }, { "H07V-K 4", 5 }, { "FLRY-B 0.5", 5 }, { "FLRY-B 2.5", 8 } } do
    it("has the same margin however the gripper is rolled: " .. c[1], function()
      local straight, peak = hang(c[1], c[2], 0)
      for _, degrees in ipairs{ 5, 15, 30, 40 } do
        for _, turned in ipairs{ false, true } do
          local margin, most = hang(c[1], c[2], degrees, turned)
          -- measured 1e-9; 0.2 to 0.65 more where corners resist the turn
          t.near(straight, margin, 1e-3, ("margin at %d degrees"):format(degrees))
          t.near(peak, most, 1e-3, ("largest margin at %d degrees"):format(degrees))
        end
      end
    end)
  end
end)

describe("wire:remodel with a normal", function()
  local function rod()
    local scene = sw.scene{}
    return scene, scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.05, 0.05, 0 }, segments = 10 }
  end

  it("turns a corner of the sections there, which is then widest", function()
    local _, wire = rod()
    wire:remodel{ model = "radial", normal = { 3, -3, 4 } }
    local n = vec.unit{ 3, -3, 4 } -- across the wire
    local function width(turn)
      return wire:width(0.035, vec.rotate(vec.turn({ 1 / 2 ^ 0.5, 1 / 2 ^ 0.5, 0 }, turn), n))
    end
    for _, turn in ipairs{ 0.1, 0.3, math.pi / 8 } do -- symmetric about the corner
      t.share(width(turn), width(-turn), 1e-9, ("width at %g rad"):format(turn))
    end
    -- eight sides are wider over their corners by 1/cos(pi/8) = 1.082, less as corners are round
    local share = width(0) / width(math.pi / 8)
    t.below(1 / math.cos(math.pi / 8), share, "width over corners, over that of sides")
    t.above(1.05, share, "width over corners, over that of sides")
  end)

  it("refuses a normal along the wire, of length zero, or for what is no line or becomes none", function()
    local _, wire = rod()
    for _, n in ipairs{ { 1, 1, 0 }, { 0, 0, 0 } } do
      assert.error_matches(function() wire:remodel{ model = "radial", normal = n } end,
        "wire 'wire1': normal = .* must not be zero or along the wire at s = 0%.0353553 m")
      assert.equal("rod", wire.model)
    end
    local words = "normal goes with a rod or string that becomes a mesh"
    assert.error_matches(function() wire:remodel{ model = "rod", normal = { 0, 0, 1 } } end, words)
    wire:remodel{ model = "radial" }
    assert.error_matches(function() wire:remodel{ model = "tube", normal = { 0, 0, 1 } } end, words)
    assert.equal("radial", wire.model)
  end)
end)
