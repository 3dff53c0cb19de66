-- SPDX-License-Identifier: GPL-3.0-or-later
-- Holds whose direction points a wire into something. The held place itself stays where it was, so nothing is
-- deep there, but the first free edge h must bend out of the thing: with about 3 EI a/h^2 for the angle a,
-- without a limit as h gets shorter.
local sw = require "softworld"
local t = require "physics.tools"

-- A cable lies on a table, turned by o.turn [rad]. The clamp at its start lifts by o.up [m] and tilts down by
-- o.angle [rad]. Returns the events and the clamp's force at rest [N].
local function tilted(cable, o)
  local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local c, s = math.cos(o.turn or 0), math.sin(o.turn or 0)
  local wire = scene:wire{ name = "w", cable = cable, from = { 0, 0, r }, to = { 0.3 * c, 0.3 * s, r },
    segments = o.segments }
  scene:force{ kind = "damping", mass = 5, stiffness = 1e-3 }
  local hold = scene:clamp(wire, { name = "h", s = o.last and wire.length or 0 })
  hold:follow{ relative = true, points = { { 0, 0, 0 }, { 0, 0, o.up or 0 } }, duration = 0.2,
    turn = { axis = { -s, c, 0 }, angle = o.last and -o.angle or o.angle } }
  local run = t.fine(scene:run{ dt = o.dt or 0.01, duration = 0.4 })
  local f, told = hold:force(), {}
  for _, e in ipairs(run.events) do if e.kind == "pressed" then told[#told + 1] = e end end
  return told, math.sqrt(f[1] ^ 2 + f[2] ^ 2 + f[3] ^ 2), wire
end

describe("a clamp that points a cable into a table", function()
  for _, case in ipairs{ { "GXL 1.5", 0.005 }, { "FLRY-B 0.5", 0.02 }, { "H07V-K 4", 0.003 } } do
    local cable, angle = case[1], case[2]
    it(("is told of with the force: %s"):format(cable), function()
      local forces = {}
      for _, o in ipairs{ { segments = 30 }, { segments = 60, dt = 0.002, turn = 0.8 },
        { segments = 75, dt = 0.005, last = true } } do
        o.angle = angle
        local told, force, wire = tilted(cable, o)
        assert.equal(1, #told)
        assert.equal("h", told[1].object)
        t.near(o.last and wire.length or 0, told[1].s, 1e-6, "place [m]")
        -- Told as it is when the force is largest. That may be before the tilt is complete, because the wire
        -- lifts off further out.
        local depth = tonumber(told[1].text:match "direction, ([%d.e-]+) mm within an edge, into 'table'")
        local whole = 1e3 * angle * wire.length / o.segments
        t.near(0.8 * whole, depth, 0.21 * whole, "depth of the first edge told [mm]")
        -- Besides the table the clamp bears the weight of what it lifts off, less than the whole.
        t.near(force, told[1].value, 0.05 * force + 9.81 * wire.length * wire.beam.mass_per_length,
          "force told [N]")
        forces[#forces + 1] = force
      end
      -- Why it is told: 3 EI a/h^2 grows by (75/30)^2 = 6.3; half of that is asked for.
      t.above(3.1 * forces[1], forces[3], "force with shorter edges [N]")
    end)
  end

  it("is not told of where edges do not decide the force", function()
    -- The cable touches the table 20 and 10 mm from the clamp, two edges or more. Edges of half the length
    -- change the force by 1 % at 20 mm and by 5 % at 10 mm.
    for _, case in ipairs{ { up = 0.002, within = 0.03 }, { up = 0.001, within = 0.1 } } do
      local first
      for _, segments in ipairs{ 30, 60 } do
        local told, force = tilted("GXL 1.5", { angle = 0.1, up = case.up, segments = segments, turn = 0.8 })
        assert.equal(0, #told)
        first = first or force
        t.near(first, force, case.within * first, "force [N]")
      end
    end
    for _, angle in ipairs{ 1e-4, -0.02 } do
      assert.equal(0, #tilted("GXL 1.5", { angle = angle, segments = 60 }))
    end
  end)
end)
