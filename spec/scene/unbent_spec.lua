-- SPDX-License-Identifier: GPL-3.0-or-later
-- A straight cable on a table, pushed between two clamps, buckles when rounding lets it: at 10 to 9000 N,
-- as turn, step and edges have it. Bent by a thousandth of its length it bears 1.3 to 12 N, at any step.
local sw = require "softworld"
local t = require "physics.tools"

local L = 0.4

-- One clamp comes nearer by `way` [m] in 0.5 s. o: bent [m], across the wire on the table; turn of the scene
-- [rad]; segments; dt [s]; free = true: no table; lift: how far that clamp goes up [m]. Returns the peak of
-- the clamp's force [N], the events `buckling` about a wire that was straight, or in a plane, for a time.
local function pushed(cable, way, o)
  local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
  if not o.free then scene:obstacle{ shape = "plane", friction = 0.3 } end
  local c, s, path = math.cos(o.turn or 0), math.sin(o.turn or 0), {}
  for i = 0, 40 do
    local x, y = L * i / 40, (o.bent or 0) * math.sin(math.pi * i / 40) ^ 2
    path[i + 1] = { c * x - s * y, s * x + c * y, r }
  end
  local wire = scene:wire{ name = "w", cable = cable, path = path, segments = o.segments or 50 }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
  local fixed = scene:clamp(wire, { s = 0, direction = { c, s, 0 } })
  scene:clamp(wire, { s = wire.length, direction = { c, s, 0 } }):follow{ relative = true, duration = 0.5,
    points = { { 0, 0, 0 }, { -way * c, -way * s, o.lift or 0 } } }
  local told = {}
  for _, e in ipairs(t.fine(scene:run{ dt = o.dt or 0.01, duration = 0.6 }).events) do
    if e.kind == "buckling" and e.text:find "until rounding" then told[#told + 1] = e end
  end
  return fixed:over().peak_force, told, wire.beam.EI
end

describe("a straight cable that is pushed between two clamps", function()
  for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    it("is told of when it buckles far too late: " .. cable, function()
      local real, silent, EI = pushed(cable, 0.03, { bent = L / 1000 })
      assert.equal(0, #silent)
      for _, o in ipairs{ {}, { turn = 0.7, segments = 57 }, { dt = 0.002 },
        { turn = 2, segments = 31, dt = 0.005 } } do
        local peak, told = pushed(cable, 0.03, o)
        t.above(5 * real, peak, "push of the straight cable [N]")
        assert.equal(1, #told)
        assert.equal("w", told[1].object)
        assert.matches("stayed straight up to .* draw it bent by a thousandth of its length$", told[1].text)
        -- The event has the largest push of a step, without damping; the peak is a mean over 10 ms. Over
        -- steps of 2 to 10 ms the push grows by up to a half.
        t.near(1, told[1].value / peak, 0.5, "push told, of the peak")
        -- What is said to be the most that a real cable bears is more than what one bent by a thousandth of
        -- its length bears, and than its Euler load; and it is far below what this one bore.
        local most = tonumber(told[1].text:match "buckles under ([%d.e+-]+) N at most")
        t.above(math.max(real, 4 * math.pi ^ 2 * EI / L ^ 2), most, "most that a real one bears [N]")
        t.below(0.5 * peak, most, "most that a real one bears [N]")
      end
    end)
  end

  it("is not told of if it is bent, does not buckle, or sags between the clamps", function()
    for _, dt in ipairs{ 0.01, 0.002 } do
      local straight = sw.cable "GXL 1.5"
      -- half the Euler load of a strut clamped at both ends: a way of P L/EA
      local low = 0.5 * 4 * math.pi ^ 2 * straight.EI.value / L / straight.EA.value
      assert.equal(0, #select(2, pushed("GXL 1.5", low, { dt = dt })))
      assert.equal(0, #select(2, pushed("GXL 1.5", 0.03, { dt = dt, free = true })))
      assert.equal(0, #select(2, pushed("GXL 1.5", 0.03, { dt = dt, bent = L / 1000, segments = 57 })))
    end
  end)
end)

-- The clamp lifts as it pushes, so the cable is bent upwards, where its weight and the table hold it, and is
-- still perfectly straight to the sides.
describe("a cable that is pushed and lifted by a clamp", function()
  for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    it("is told of when it buckles to a side far too late: " .. cable, function()
      local real, silent = pushed(cable, 0.02, { bent = L / 1000, lift = 0.006 })
      assert.equal(0, #silent)
      for _, o in ipairs{ {}, { turn = 0.7, segments = 57, dt = 0.004 }, { dt = 0.002 },
        { turn = 2, segments = 41, dt = 0.005 } } do
        o.lift = 0.006
        local peak, told = pushed(cable, 0.02, o)
        t.above(1.5 * real, peak, "push of the cable in a plane [N]")
        assert.equal(1, #told)
        assert.matches("stayed in a plane up to .* bent out of that plane by a thousandth of its length$",
          told[1].text)
        t.near(1, told[1].value / peak, 0.5, "push told, of the peak")
        local most = tonumber(told[1].text:match "buckles under ([%d.e+-]+) N at most")
        t.above(real, most, "most that a real one bears [N]")
        t.below(told[1].value / 1.5, most, "most that a real one bears [N]")
      end
    end)
  end
end)
