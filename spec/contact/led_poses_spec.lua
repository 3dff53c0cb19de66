-- SPDX-License-Identifier: GPL-3.0-or-later
-- Poses: a wire that lies across a wire drawn along a table goes with it. Friction of 0.3 bears far more than
-- what keeps it back: nothing, if it touches only the drawn wire; if its ends lie on the table, friction
-- under the part of its weight there. A cantilever of 50 mm sags by less than the 6 mm to the table, one
-- of 100 mm by more: its ends bear 4 % of the weight, so friction on the drawn wire bears 20 times what the
-- ends need.
local sw = require "softworld"
local t = require "physics.tools"

local R, WAY = 0.003, 0.01
local SECTION = { E = 1e7, nu = 0.4, density = 1200, radius = R }

local function wire(scene, name, model, from, to)
  local a = { name = name, model = model, from = from, to = to, segments = model == "rod" and 20 or nil }
  for k, v in pairs(SECTION) do a[k] = v end
  return scene:wire(a)
end

-- o: models below and across, half length across, angle of the scene, swapped ends, dt. Returns how far both
-- went along the draw.
local function drawn(o)
  local c, s = math.cos(o.angle or 0), math.sin(o.angle or 0)
  local function at(x, y, z) return { c * x - s * y, s * x + c * y, z } end
  local function along(p) return c * p[1] + s * p[2] end
  local scene = sw.scene{ name = "led" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local tail, head = at(0, 0, R), at(0.2, 0, R)
  local lower = wire(scene, "lower", o.lower, o.swapped and head or tail, o.swapped and tail or head)
  local upper = wire(scene, "upper", o.upper, at(0.1, -o.half, 3 * R + 1e-4), at(0.1, o.half, 3 * R + 1e-4))
  scene:wire_contact{ friction = 0.3 }
  scene:settle()
  local before = { lower = along(lower:position(0.1)), upper = along(upper:position(o.half)) }
  local hand = scene:clamp(lower, { s = o.swapped and 0 or lower.length })
  hand:follow{ relative = true, duration = 0.3, points = { { 0, 0, 0 }, at(WAY, 0, 0) } }
  t.fine(scene:run{ duration = 0.3, dt = o.dt or 0.02, quasistatic = true, progress = false })
  return along(lower:position(0.1)) - before.lower, along(upper:position(o.half)) - before.upper
end

-- friction's springs and the sag between ring and ring take up to 30 um
local EXACT = 5e-5

describe("a wire across a drawn wire, in poses", function()
  for _, pair in ipairs{ { "rod", "rod" }, { "tube", "rod" }, { "rod", "tube" } } do
    it(("goes with it: a %s, a %s across"):format(pair[1], pair[2]), function()
      local lower, upper = drawn{ lower = pair[1], upper = pair[2], half = 0.05 }
      t.near(WAY, lower, EXACT)
      t.near(lower, upper, EXACT)
    end)
  end

  for _, case in ipairs{ { "with its ends on the table", half = 0.1 },
    { "with its ends on the table, longer poses", half = 0.1, dt = 0.05 },
    { "in a turned scene with swapped ends", half = 0.05, angle = 1.1, swapped = true } } do
    it("goes with a tube: " .. case[1], function()
      case.lower, case.upper = "tube", "rod"
      local lower, upper = drawn(case)
      t.near(lower, upper, EXACT)
    end)
  end

  -- Both wires are clamped at both ends, and the upper one is lowered across the middle of the lower one. By
  -- symmetry friction is 0. A touch that begins in the search has moved freely: had friction kept this as a
  -- slide, the forces across would be up to 1.2 mN.
  it("has no force across if it is pressed on the middle of the other one", function()
    for _, case in ipairs{ { 6, 0.25 }, { 8, 0.25 }, { 10, 0.1 }, { 24, 0.1 } } do
      local scene = sw.scene{ name = "crossed" }
      local function placed(name, from, to)
        return scene:wire{ name = name, E = 5e6, density = 1500, radius = 0.0025, from = from, to = to,
          segments = case[1] }
      end
      local a = placed("a", { -0.2, 0, 0 }, { 0.2, 0, 0 })
      local b = placed("b", { 0, -0.2, 0.02 }, { 0, 0.2, 0.02 })
      scene:wire_contact{ friction = 0.3 }
      local hands = {}
      for i, s in ipairs{ 0, 0.4 } do
        scene:clamp(a, { s = s })
        hands[i] = scene:clamp(b, { s = s })
        hands[i]:follow{ relative = true, duration = 1, points = { { 0, 0, 0 }, { 0, 0, -0.08 } } }
      end
      scene:settle()
      t.fine(scene:run{ duration = 1, dt = case[2], quasistatic = true, progress = false })
      for i = 1, 2 do t.near(0, hands[i]:force()[1], 1e-5, case[1] .. " edges") end
      t.below(-1.2, hands[1]:force()[2]) -- it is stretched by the lower one
    end
  end)
end)
