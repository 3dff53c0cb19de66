-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable is drawn along itself across two fixed ones, and its hold stops softly. Friction then is what it
-- was at the end of the slide, as on obstacles. In steps of 10 ms it had turned round: 0.7 mN for -17 mN,
-- without an event.
local sw = require "softworld"
local t = require "physics.tools"

-- Returns the pull on the hold along the cable over mu m g.
local function drawn(o, dt)
  local scene = sw.scene{}
  local upper, lower = sw.cable(o.upper).outer_diameter.value / 2, sw.cable(o.lower).outer_diameter.value / 2
  local c, s = math.cos(o.turn), math.sin(o.turn)
  local function at(x, y, z) return { c * x - s * y, s * x + c * y, z } end
  scene:force{ kind = "damping", mass = 1, stiffness = 1e-3 }
  for _, x in ipairs{ 0.05, 0.25 } do
    local rail = scene:wire{ cable = o.lower, from = at(x, -0.05, 0), to = at(x, 0.05, 0), segments = 10 }
    for k = 0, 10 do scene:clamp(rail, { s = 0.01 * k }) end
  end
  local wire = scene:wire{ cable = o.upper, from = at(0, 0, upper + lower), to = at(0.3, 0, upper + lower),
    segments = o.segments }
  scene:wire_contact{ friction = o.mu }
  local hold = scene:clamp(wire, { s = 0 })
  scene:settle()
  hold:follow{ relative = true, duration = 0.4, law = o.law, points = { { 0, 0, 0 }, at(-0.03, 0, 0) } }
  t.fine(scene:run{ dt = dt, duration = 0.7 })
  local f = hold:force()
  return (c * f[1] + s * f[2]) / (o.mu * 9.81 * wire.beam.mass_per_length * 0.3)
end

describe("a cable that is drawn across others and stops softly", function()
  for k, cables in ipairs{ { "GXL 1.5", "FLRY-B 10" }, { "H07V-K 4", "GXL 10" },
    { "FLRY-B 2.5", "FLRY-B 2.5" } } do
    it("is still held by its friction: " .. cables[1], function()
      for _, law in ipairs{ "minimum-jerk", "trapezoidal" } do
        local o = { upper = cables[1], lower = cables[2], law = law, mu = 0.2 + 0.1 * k, turn = 0.7 * k,
          segments = 28 + k }
        local fine = drawn(o, 5e-4)
        for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
          -- Chords that touch chords bear more and less as they slide: measured 0.05.
          local share = drawn(o, dt)
          print(("measured: %s %g ms %.3f for %.3f"):format(law, 1e3 * dt, share, fine))
          t.near(fine, share, 0.1, ("%s, %g ms: pull over mu m g"):format(law, 1e3 * dt))
        end
      end
    end)
  end
end)
