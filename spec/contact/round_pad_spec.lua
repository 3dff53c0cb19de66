-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that turn between round pads. A wire at depth d presses on a pad along 2 z, z^2 = 2 R d, with R the
-- sum of both radii; d is 20 um at the wanted force. Its depth falls as a parabola, so a wire across two
-- pads turns about their common normal at the moment 2 mu F (3/8) z.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH, RADIUS = 0.2, 0.004 -- of the wire and of the pads [m]
local FORCE = 10                  -- per pad [N]

-- A wire between round pads at s, which nothing else holds.
local function gripped(p)
  local scene = sw.scene{ gravity = p.gravity }
  local wire = scene:wire{ cable = p.cable or "GXL 1.5", segments = p.segments, from = { 0, 0, 0 },
    to = { LENGTH, 0, 0 } }
  scene:force{ kind = "damping", mass = p.damping, stiffness = 0.002 }
  local rest = { scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = LENGTH }) }
  local hand = scene:gripper{ pads = { shape = "round", radius = RADIUS, height = 0.06,
    friction = p.friction, opening = 3 * wire.radius } }
  scene:process(function() hand:grasp(wire, { s = p.s, approach = "plates", force = FORCE }) end)
  t.fine(scene:run{ dt = p.dt })
  for _, clamp in ipairs(rest) do clamp:release() end
  return scene, wire
end

-- Angle of the wire at s from where it was gripped [rad].
local function angle(wire, s)
  local a, b = wire:position(s - 0.02), wire:position(s + 0.02)
  return math.atan(b[3] - a[3], b[1] - a[1])
end

describe("round pads", function()
  -- With 0.8 of that moment the friction springs give way by less than 3 degrees; with 1.3 the wire turns
  -- by 22 and more in half a second, damped. The places of samples matter by 5 %.
  it("hold a wire across them up to the moment of friction", function()
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 2.5" } do
      for _, at in ipairs{ { 8, 0.1 }, { 20, 0.103 }, { 31, 0.1 } } do
        for _, share in ipairs{ 0.8, 1.3 } do
          local scene, wire = gripped{ cable = cable, segments = at[1], s = at[2], friction = 0.4,
            damping = 20, dt = 0.01, gravity = { 0, 0, 0 } }
          local z = math.sqrt(2 * (RADIUS + wire.radius) * 20e-6)
          local pull = share * 0.75 * 0.4 * FORCE * z / LENGTH
          scene:force{ kind = "point", on = wire, s = 0, force = { 0, 0, -pull } }
          scene:force{ kind = "point", on = wire, s = LENGTH, force = { 0, 0, pull } }
          t.fine(scene:run{ duration = 0.5, dt = 0.01 })
          local turned = math.deg(angle(wire, at[2]))
          local what = ("turn at %g of the moment [degrees]"):format(share)
          if share < 1 then t.below(3.5, turned, what) else t.above(20, turned, what) end
        end
      end
    end
  end)

  -- A wire held beside its middle swings down until it lies along the pads, more slowly with friction.
  -- Regression: its nearest places pressed twice where they came beside each other or beside a node; half of
  -- such scenes made 7 to 30 % of their energy from nowhere, or did not converge. Now the gap is below
  -- 2e-5, and the place of the end is the same from 20 to 2 ms and from 20 to 100 segments within 1 mm.
  it("let a wire swing down with the energy that it has", function()
    local first
    for _, at in ipairs{ { 0.02, 20 }, { 0.005, 40 }, { 0.002, 100 } } do
      local scene, wire = gripped{ segments = at[2], s = 0.12, friction = 0.1, damping = 4, dt = at[1] }
      local run = t.fine(scene:run{ duration = 1.5, dt = at[1] })
      local ledger = run:ledger()
      t.near(0, ledger.gap / ledger.play, 1e-3, "gap, of the energy in play")
      for _, event in ipairs(run.events) do assert.are_not.equal("energy", event.kind) end
      first = first or wire:position(0)
      t.near(0, t.distance(first, wire:position(0)), 1e-3, "place of the end [m]")
      assert.is_true(math.deg(angle(wire, 0.12)) > 40)
    end
  end)

  -- With hardly any friction it passes along the pads, and falls out below them.
  it("let a wire through that lies along them", function()
    for _, dt in ipairs{ 0.02, 0.005 } do
      local scene, wire = gripped{ segments = 20, s = 0.12, friction = 0.02, damping = 4, dt = dt }
      local run = t.fine(scene:run{ duration = 1.5, dt = dt })
      local ledger = run:ledger()
      t.near(0, ledger.gap / ledger.play, 1e-3, "gap, of the energy in play")
      assert.is_true(wire:position(0.12)[3] < -0.1)
    end
  end)

  -- Without a force there is no wanted depth, and the touch is as stiff as the section: 0.84 E per length and
  -- side, F = 4/3 0.84 E d z. Samples are z/2 apart or less; their sum is within 5 %. Regression: the first
  -- touch ended the run with "singular matrix".
  it("close to a distance without a force", function()
    local r, E, deep = 0.003, 2e7, 1e-4
    local expected = 4 / 3 * 0.84 * E * deep * math.sqrt(2 * (RADIUS + r) * deep)
    for _, dt in ipairs{ 0.01, 0.002, 0.0005 } do
      for _, turn in ipairs{ 0, 0.2 } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        scene:force{ kind = "damping", mass = 8 }
        local wire = scene:wire{ E = E, nu = 0.4, density = 1200, radius = r, from = { 0, 0, 0 },
          to = { LENGTH, 0, 0 }, segments = 20 }
        local hand = scene:gripper{ at = { 0.103, 0, 0 }, rotation = { axis = { 0, 0, 1 }, angle = turn },
          pads = { shape = "round", radius = RADIUS, height = 0.06, opening = 0.01 } }
        scene:process(function(p)
          hand:grasp(wire, { s = 0.103, approach = "plates", distance = 2 * (r - deep) })
          p:wait(0.3)
        end)
        t.fine(scene:run{ dt = dt })
        t.share(expected, hand:state().squeeze, 0.05, ("squeeze at %g s, turned by %g"):format(dt, turn))
      end
    end
  end)
end)
