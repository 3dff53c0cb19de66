-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cables whose end a hand pushes, so that they buckle in a plane onto a peg with friction. A real cable is
-- bent by a thousandth of its length L across the plane. This bend grows like exp(r t) before the peg is
-- touched, and the push P on a bend a is about a (P - EI k^2) k^2 L/8, k = 2 pi/L. When this is above mu N
-- the cable slides off to the side, and bears half as much: a strut whose middle is free bears 4 pi^2
-- EI/L^2, one whose middle is held 8.18 pi^2 EI/L^2.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L = 0.24
local cables = { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" }

-- o.across: bend out of the plane [m]; o.way of the hand [m]; o.back: it goes back; o.quasistatic; o.turn:
-- of the scene [rad]; o.swap: ends swapped. Returns the hand's force at the end [N], the way out of the
-- plane [m], the events.
local function push(cable, o)
  local turn, points, sign = o.turn or 0, {}, o.swap and -1 or 1
  local scene = sw.scene{ gravity = t.turned({ 0, 0, -9.81 }, turn) }
  for i = 0, 40 do
    local bent = (o.across or 0) * math.sin(math.pi * i / 40) ^ 2
    points[i + 1] = t.turned({ sign * L * (i / 40 - 0.5), bent, 0 }, turn)
  end
  local wire = scene:wire{ name = "cable", cable = cable, path = points, segments = o.segments or 64,
    rest = o.across and "path" or nil }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.002 }
  local axis = t.turned({ 0, 1, 0 }, turn)
  scene:obstacle{ shape = "cylinder", radius = 0.01, friction = 0.3, length = 0.2,
    at = t.turned({ 0, 0, -0.0125 }, turn),
    rotation = { axis = { -axis[2], axis[1], 0 }, angle = math.acos(axis[3]) } }
  local hand = scene:gripper{}
  scene:clamp(wire, { s = 0 })
  scene:process(function(p)
    hand:grasp(wire, { s = 0.22 })
    p:wait(0.1)
    hand:move{ by = t.turned({ -sign * o.way, 0, 0 }, turn), speed = o.speed or 0.1 }
    if o.back then hand:move{ by = t.turned({ sign * o.way, 0, 0 }, turn), speed = o.speed or 0.1 } end
    p:wait(0.1)
  end)
  t.fine(scene:run{ dt = o.dt or 0.004, quasistatic = o.quasistatic })
  local normal, most, told = t.turned({ 0, 1, 0 }, turn), 0, {}
  for i = 0, 40 do
    most = math.max(most, math.abs(wire:position(wire.length * i / 40):dot(normal)))
  end
  for _, e in ipairs(scene:events()) do if e.kind == "buckling" then told[#told + 1] = e end end
  return hand:force():norm(), most, told, hand.peak_force
end

describe("a cable that is pushed onto a peg with friction", function()
  for _, cable in ipairs{ "GXL 1.5", "H07V-K 4" } do
    it("is told of when only friction keeps it in its plane: " .. cable, function()
      local real, aside, silent = push(cable, { across = L / 1000, way = 0.002 })
      t.above(0.01, aside, "way out of the plane [m]")
      assert.equal(0, #silent)
      for _, o in ipairs{ {}, { dt = 0.002 }, { dt = 0.008, segments = 57 }, { turn = 0.7 },
        { swap = true, dt = 0.001 }, { speed = 0.5 }, { quasistatic = true },
        { quasistatic = true, dt = 0.002, swap = true } } do
        o.way = 0.002
        local force, out, told = push(cable, o)
        t.below(1e-6, out, "way out of the plane [m]")
        t.above(1.6 * real, force, "force of the hand [N]")
        assert.equal(1, #told)
        assert.matches("stays in a plane under a push", told[1].text)
      end
    end)
  end

  for _, cable in ipairs(cables) do
    -- A way of P L/EA with P below the buckling load.
    it("is not told of when it does not buckle: " .. cable, function()
      for _, way in ipairs{ 1e-5, 2e-6 } do
        for _, across in ipairs{ false, L / 1000 } do
          local _, _, told = push(cable, { across = across or nil, way = way, back = true })
          assert.equal(0, #told)
        end
      end
    end)
  end
end)
