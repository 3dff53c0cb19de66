-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads in poses that find no equilibrium with the force that they are to keep.
local sw = require "softworld"
local t = require "spec.physics.tools"

local r = 0.003

-- A hand lifts a wire of 0.067 N from a table. Friction of 0.6 bears 1.2 times the force of its pads.
local function lift(force, run_args)
  local scene = sw.scene{}
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ E = 5e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r },
    to = { 0.2, 0, r } }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, friction = 0.6, opening = 3 * r } }
  local seen = { off = 0, height = 0 }
  scene:process(function()
    hand:grasp(wire, { s = 0.1, approach = "plates", force = force })
    hand:move{ by = { 0, 0, 0.05 }, duration = 1 }
  end)
  scene:process(function(p)
    while scene.time < 1.3 do
      p:wait(0.02)
      local state = hand:state()
      if state.jaws == "holds" then
        seen.off = math.max(seen.off, math.abs(state.squeeze / force - 1))
        seen.height = math.max(seen.height, wire:position(0.1)[3])
      end
    end
  end)
  local run = t.fine(scene:run(run_args))
  for _, e in ipairs(hand.events) do seen[e.kind] = e.time end
  for _, e in ipairs(run.events) do if e.kind == "unkept" then seen.told = e end end
  return seen, run
end

describe("pads in poses", function()
  -- They kept a force of up to 55 times the wanted one, and lifted the wire by up to 47 mm.
  it("lose a wire that is too heavy when motion does, and not with a larger force", function()
    local motion = lift(0.04, { dt = 0.005 })
    t.near(0.37, motion.lost, 0.02, "lost in motion")
    for _, row in ipairs{ { 0.04, 0.1 }, { 0.04, 0.05 }, { 0.04, 0.02 }, { 0.03, 0.02 } } do
      local seen = lift(row[1], { dt = row[2], quasistatic = true })
      t.near(motion.lost, seen.lost, 0.04, "lost with dt = " .. row[2])
      t.near(motion.height, seen.height, 1e-3, "height")
      t.below(0.5, seen.off, "force off")
      if seen.off > 0.1 then
        t.share(seen.off, math.abs(seen.told.value), 0.5, "told")
        assert.matches("the pads of 'hand' press with .* N instead of", seen.told.text)
      end
    end
  end)

  it("keep a wire that they can bear, with the wanted force", function()
    local seen = lift(0.06, { dt = 0.05, quasistatic = true })
    assert.is_nil(seen.lost)
    assert.is_nil(seen.told)
    t.below(2e-3, seen.off, "force off")
  end)

  it("with another force leave rows of margins open", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    local hand = scene:gripper{ name = "hand", pads = { friction = 0.5 } }
    scene:process(function()
      hand:grasp(wire, { s = 0.1, approach = "plates", force = 5 })
      scene:tell{ kind = "unkept", object = "hand", value = 0.2, text = "the pads press with another force" }
    end)
    local run = t.fine(scene:run{ dt = 0.05, quasistatic = true })
    local check = run:check{ limits = { peak_margin = 0.9 } }
    assert.equal("OPEN", check:row "hand.peak_margin".verdict)
    assert.matches("another force than the wanted one", check:row "hand.peak_margin".note)
  end)
end)
