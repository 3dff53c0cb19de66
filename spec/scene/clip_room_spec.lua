-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that begin in the wall or the floor of a clip are refused. The wall pushed them out, and its energy
-- came from nowhere; for a wire that was then drawn sideways the run said so only at its end.
local sw = require "softworld"
local vec = require "softworld.vec"

-- Top of the lips over the seat, in radii: the way of 1.5 radii is divided so that both flanks store the
-- same energy, insertion times one, retention times the other.
local INSERTION, RETENTION = 8, 25
local LIPS = 1.5 * INSERTION / (INSERTION + RETENTION)

-- Runs a wire that lies beside the seats of two clips, by shares of its radius, and returns what pcall does.
local function start(o)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local axis, side = { math.cos(o.turn), math.sin(o.turn), 0 }, { -math.sin(o.turn), math.cos(o.turn), 0 }
  local radius = sw.cable(o.cable).outer_diameter.value / 2
  local off = vec.add(vec.scale(side, (o.aside or 0) * radius), { 0, 0, 1 }, (o.up or 0) * radius)
  local wire = scene:wire{ name = "cable", cable = o.cable, from = vec.add(off, axis, -0.1),
    to = vec.add(off, axis, 0.1), segments = o.segments }
  scene:force{ kind = "damping", on = wire, mass = 8, stiffness = 1e-3 }
  for k, at in ipairs{ -0.05, 0.05 } do
    scene:clip{ name = "clip " .. k, at = vec.scale(axis, at), axis = axis, width = 0.008,
      insertion = INSERTION, retention = RETENTION, on = o.other and scene:wire{ cable = o.cable,
    from = { 1, 1, k }, to = { 1, 1.1, k } } }
  end
  local fine, why = pcall(scene.run, scene, { dt = 0.005, duration = 0.05 })
  scene:close()
  return fine, tostring(why), radius
end

describe("a wire that begins beside the seat of clips", function()
  -- Walls and floor are 2 pi strength / stiffness = 2 pi 20/50 = 2.51 radii thick. The wire is in by the
  -- shortest way out; a quarter of its radius, at least 0.1 mm, is allowed.
  local thick = 2 * math.pi * 20 / 50
  for _, o in ipairs{ { cable = "GXL 1.5", turn = 0, segments = 40 },
    { cable = "FLRY-B 10", turn = 0.7, segments = 33 }, { cable = "H07V-K 6", turn = -2, segments = 50 } } do
    it("is refused in a wall or the floor, with depth and remedy: " .. o.cable, function()
      for _, place in ipairs{ { "aside", 0.3 }, { "aside", -1 }, { "aside", 2 }, { "up", -1 } } do
        local case = { cable = o.cable, turn = o.turn, segments = o.segments, [place[1]] = place[2] }
        local fine, why, radius = start(case)
        local what = ("%s %g radii"):format(place[1], place[2])
        assert.is_false(fine, what)
        local part, deep = place[1] == "up" and "floor" or "wall", math.abs(place[2])
        local told = tonumber(why:match("clip 'clip 1': wire 'cable' begins (%S+) mm deep in its " .. part))
        local exact = math.min(deep, thick - deep, place[1] == "aside" and LIPS or deep)
        assert.is_true(told ~= nil, why)
        -- the message has three digits
        assert.is_true(math.abs(told / (1e3 * radius * exact) - 1) < 0.006, what .. ": " .. why)
        assert.matches("Put the wire into the seat", why)
      end
    end)

    it("is not refused in seat, mouth, beside the clips, or in those of other wires: " .. o.cable, function()
      for _, place in ipairs{ { "aside", 0 }, { "aside", 0.2 }, { "up", 4 }, { "aside", thick + 0.05 },
        { "up", -thick - 0.05 } } do
        local case = { cable = o.cable, turn = o.turn, segments = o.segments, [place[1]] = place[2] }
        local fine, why = start(case)
        assert.is_true(fine, ("%s %g radii: %s"):format(place[1], place[2], why))
      end
      local other = { cable = o.cable, turn = o.turn, segments = o.segments, aside = 1, other = true }
      assert.is_true((start(other)))
    end)
  end
end)
