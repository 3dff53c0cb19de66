-- SPDX-License-Identifier: GPL-3.0-or-later
-- The loop of a knot slips over a part of the wire in an imposed grip, which has no body: an event tells it.
local sw = require "softworld"
local t = require "spec.physics.tools"

local SIZE = 0.02 -- of the knot [m]
local GONE = 0.05 -- smallest bend radius; knots that are drawn have 3 to 20 mm [m]

-- Two hands at the ends draw a loose trefoil knot tight by a share of the wire's slack. Returns the run, the
-- texts of its events `passed`, and whether the knot is gone.
local function drawn(o)
  local scene = sw.scene{ name = "knot", gravity = { 0, 0, 0 } }
  local path = {}
  for k = 0, 80 do
    local u = -2.1 + 4.2 * k / 80
    path[k + 1] = { SIZE * (u ^ 3 - 3 * u), SIZE * (u ^ 4 - 4 * u ^ 2), SIZE * (u ^ 5 - 10 * u) / 12 }
  end
  local wire = scene:wire{ name = "wire", cable = "GXL 1.5", path = path, segments = 160 }
  scene:wire_contact{ friction = 0.1 }
  scene:force{ kind = "damping", mass = 10, stiffness = 0.001 }
  local one, two = scene:gripper{ name = "one" }, scene:gripper{ name = "two" }
  scene:process(function()
    one:grasp(wire, { s = o.s or 0.002 })
    two:grasp(wire, { s = wire.length - (o.s or 0.002) })
    local along = wire:position(wire.length) - wire:position(0)
    local way = (wire.length - along:norm()) * o.share / 2
    along = along / along:norm()
    scene:process(function() one:move{ by = along * -way, duration = 2 } end)
    two:move{ by = along * way, duration = 2 }
  end)
  local run, texts = t.fine(scene:run{ dt = o.dt or 0.01 }), {}
  for _, e in ipairs(run.events) do
    if e.kind == "passed" then texts[#texts + 1] = e.text end
  end
  return run, texts, wire:min_bend_radius{ now = true } > GONE
end

-- An imposed grip lifts a coil by a place of one of its three turns. The turns lie one on another, or (flat)
-- one in another. Returns the number of events `passed`.
local function carried(o)
  local scene = sw.scene{ name = "coil" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local path, R = {}, 0.0015
  for k = 0, 120 do
    local a, more = 2 * math.pi * k / 40, (2 * R + o.gap) * k / 40
    local r = 0.06 + (o.flat and more or 0)
    path[k + 1] = { r * math.cos(a), r * math.sin(a), R + 2e-5 + (o.flat and 0 or more) }
  end
  local wire = scene:wire{ name = "coil", cable = "GXL 1.5", path = path, segments = 180, rest = "path" }
  scene:wire_contact{ friction = 0.2 }
  scene:force{ kind = "damping", mass = 5, stiffness = 0.001 }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function(p)
    p:wait(0.1)
    hand:grasp(wire, { s = o.s * wire.length })
    hand:move{ by = { 0, 0, 0.15 }, duration = 0.5 }
    p:wait(0.2)
  end)
  local told = 0
  for _, e in ipairs(t.fine(scene:run{ dt = o.dt }).events) do
    if e.kind == "passed" then told = told + 1 end
  end
  return told
end

describe("a coil that an imposed grip carries", function()
  -- Turns that came to lie on the part in the grip were told as a loop: 3 of 24 such coils.
  it("may lie on the part in the grip, which is no loop round it", function()
    for _, o in ipairs{ { s = 0.002, gap = 5e-5, dt = 0.02 }, { s = 0.002, gap = 3e-4, dt = 0.005 },
      { s = 0.5, gap = 5e-5, dt = 0.005, flat = true } } do
      assert.equal(0, carried(o))
    end
  end)
end)

describe("a knot that is drawn tight by imposed grips", function()
  -- Small differences decide whether it comes off.
  it("comes off over a grip, which is told, or stays", function()
    local came_off, stayed = 0, 0
    for _, o in ipairs{ { share = 0.5 }, { share = 0.7 }, { share = 0.7, dt = 0.02 }, { share = 0.8 } } do
      local run, texts, gone = drawn(o)
      assert.equal(gone, #texts > 0)
      if gone then came_off = came_off + 1 else stayed = stayed + 1 end
      if gone then
        assert.matches("^wire 'wire' slips over its part in the grip of '%a+'", texts[1])
        local check = run:check{ limits = { max_tension = 80, min_bend_radius = 1e-3 } }
        assert.equal("OPEN", check:row "wire.max_tension".verdict)
        assert.equal("OPEN", check:row "wire.min_bend_radius".verdict)
      end
    end
    t.above(0, came_off, "knots that came off")
    t.above(0, stayed, "knots that stayed")
  end)
end)
