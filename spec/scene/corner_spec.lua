-- SPDX-License-Identifier: GPL-3.0-or-later
-- A path goes straight from point to point. Where it turns by a, a wire with edges h has a bend of h/a, whose
-- radius gets smaller with the edges. If this is the run's smallest radius, the event `corner` says so, and
-- gives that of a smooth curve through points p apart: p/a.
local sw = require "softworld"
local t = require "physics.tools"

local RADIUS, STRAIGHT = 0.04, 0.08

-- A path with a quarter of a circle in `parts`, turned by `turn` about z. Returns it and its length [m].
local function bow(parts, turn)
  local path, c, s = {}, math.cos(turn), math.sin(turn)
  local function add(x, y) path[#path + 1] = { c * x - s * y, s * x + c * y, 0 } end
  add(0, 0)
  for i = 0, parts do
    local b = 0.5 * math.pi * i / parts
    add(STRAIGHT + RADIUS * math.sin(b), RADIUS * (1 - math.cos(b)))
  end
  add(STRAIGHT + RADIUS, STRAIGHT + RADIUS)
  return path, 2 * STRAIGHT + 0.5 * math.pi * RADIUS
end

-- A cable between two clamps without weight, drawn along a bow. Returns the events `corner`, its smallest
-- bend radius [m], the run and the wire.
local function drawn(o)
  local scene = sw.scene{}
  local path, length = bow(o.parts, o.turn or 0)
  local wire = scene:wire{ name = "w", cable = o.cable, path = path, rest = o.rest,
    segments = math.floor(length / o.edge + 0.5) }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = wire.length })
  scene:gravity{ 0, 0, 0 }
  scene:force{ kind = "damping", mass = 5, stiffness = 1e-3 }
  if o.settle then assert.is_true(scene:settle().ok) end
  local run, told = t.fine(scene:run{ dt = o.dt or 0.01, duration = 0.02 }), {}
  for _, e in ipairs(run.events) do if e.kind == "corner" then told[#told + 1] = e end end
  return told, wire:min_bend_radius(), run, wire
end

local cables = { "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" }

describe("a bend that is a corner of the path", function()
  for k, cable in ipairs(cables) do
    it(("is told of with the radius of a smooth curve: %s"):format(cable), function()
      for _, rest in ipairs{ "path", "straight" } do
        local last
        for _, edge in ipairs{ 0.004, 0.0025 } do
          local told, radius = drawn{ cable = cable, parts = 9, edge = edge, rest = rest, turn = 0.7 * k,
            dt = 0.01 / k }
          assert.equal(1, #told)
          assert.equal("w", told[1].object)
          -- Points on a circle: a chord over the turn is 2 R sin(a/2)/a, here 0.1 % below R; at its ends the
          -- turn is half of that and the way beside it longer.
          t.near(RADIUS, told[1].value, 0.01 * RADIUS, "radius of the smooth curve told [m]")
          t.near(radius, 1e-3 * tonumber(told[1].text:match ", ([%d.]+) mm at s"), 0.01 * radius,
            "radius told [m]")
          assert.matches(rest == "path" and "every [%d.]+ mm$" or "call scene:settle first$", told[1].text)
          -- Why it is told: by a quarter too small at least, and smaller with shorter edges.
          t.below(0.85 * (last or RADIUS), radius, "radius with these edges [m]")
          last = radius
        end
      end
    end)
  end

  it("is not told of a curve with points every edge", function()
    for _, rest in ipairs{ "path", "straight" } do
      for _, edge in ipairs{ 0.008, 0.004 } do
        local told = drawn{ cable = "GXL 1.5", parts = math.floor(0.5 * math.pi * RADIUS / edge + 0.5),
          edge = edge, rest = rest, turn = 0.3 }
        assert.equal(0, #told)
      end
    end
    local _, radius = drawn{ cable = "GXL 1.5", parts = 16, edge = 0.004, rest = "path" }
    -- Nodes do not lie on the points, so a turn of two corners may meet in one hinge, or less.
    t.near(RADIUS, radius, 0.05 * RADIUS, "radius with points every edge [m]")
  end)

  it("is not told of a wire that came to rest before", function()
    for _, edge in ipairs{ 0.004, 0.002 } do
      assert.equal(0, #drawn{ cable = "GXL 1.5", parts = 9, edge = edge, settle = true })
    end
  end)

  it("gives the row of run:check a range up to that of the smooth curve", function()
    local told, radius, run, wire = drawn{ cable = "GXL 1.5", parts = 9, edge = 0.004, rest = "path" }
    local function verdict(limit)
      return run:check{ trial = true, limits = { min_bend_radius = { min = limit, sure = true } } }
        :row "w.min_bend_radius"
    end
    assert.equal("open", verdict(0.5 * (radius + RADIUS) - wire.radius).verdict:lower())
    assert.equal("fail", verdict(1.05 * told[1].value - wire.radius).verdict:lower())
  end)
end)
