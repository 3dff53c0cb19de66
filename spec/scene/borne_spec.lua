-- SPDX-License-Identifier: GPL-3.0-or-later
-- A straight cable on a table with friction stays straight under a push that would buckle it if it were bent
-- by a thousandth of its length. The run says so, with the push that a real cable bears.
local sw = require "softworld"
local t = require "physics.tools"

local L, mm = 0.4, sw.units.mm

-- A cable on a table; one end is clamped. o: cable, friction, segments, dt [s], quasistatic; bent: over its
-- length, as (1 - cos)/2; turn of the scene [rad]; start: how far the cable is moved along itself [m];
-- swap: ends swapped.
local function lying(o)
  local scene = sw.scene{}
  local c, s, n, path = math.cos(o.turn or 0), math.sin(o.turn or 0), o.segments or 50, {}
  local function place(x, y) return { c * x - s * y, s * x + c * y, 0 } end
  for i = 0, n do
    local k = o.swap and n - i or i
    path[i + 1] = place(L * k / n + (o.start or 0), (o.bent or 0) * L * math.sin(math.pi * k / n) ^ 2)
  end
  local wire = scene:wire{ name = "w", cable = o.cable, path = path, model = o.model,
    spacing = o.model and 1.5e-3 or nil, segments = not o.model and n or nil,
    rest = o.bent and "path" or nil }
  scene:obstacle{ shape = "plane", at = { 0, 0, -wire.radius }, friction = o.friction }
  scene:force{ kind = "damping", mass = 4, stiffness = 0.003 }
  local sign = o.swap and -1 or 1
  local direction = { sign * c, sign * s, 0 }
  local ends = { 0, wire.length }
  if o.swap then ends = { wire.length, 0 } end
  local fixed = scene:clamp(wire, { s = ends[2], direction = direction })
  local euler = 4 * math.pi ^ 2 * wire.beam.EI / L ^ 2 -- of a strut with clamped ends [N]
  return { scene = scene, wire = wire, fixed = fixed, near = ends[1], place = place, euler = euler,
    direction = direction, way = (o.times or 0) * euler * L / wire.beam.EA, friction = o.friction }
end

-- Largest push that a cable bears: in its middle (P - EI k^2) k^2 a/2 = mu m g, a = L/1000, k = 2 pi/L [N].
local function bound(lay, length)
  length = length or L
  local k, beam = 2 * math.pi / length, lay.wire.beam
  return beam.EI * k ^ 2 + lay.friction * beam.mass_per_length * 9.81 / (0.5 * k ^ 2 * 1e-3 * length)
end

local function told(scene)
  local list = {}
  for _, e in ipairs(scene:events()) do
    if e.kind == "buckling" then list[#list + 1] = e end
  end
  return list
end

-- The other clamp comes nearer until the push is o.times the Euler load; back: and goes back again.
local function pushed(o)
  local lay = lying(o)
  local points, w = { { 0, 0, 0 } }, lay.way
  points[2] = lay.place(w, 0)
  if o.back then points[3] = { 0, 0, 0 } end
  lay.scene:clamp(lay.wire, { s = lay.near, direction = lay.direction })
    :follow{ relative = true, duration = 0.5, law = "linear", points = points }
  t.fine(lay.scene:run{ duration = 0.8, dt = o.dt or 0.01, quasistatic = o.quasistatic })
  return lay.fixed:over().peak_force, told(lay.scene), lay
end

-- A gripper pushes the cable, 40 mm from its end.
local function handed(o)
  local lay = lying(o)
  local hand = lay.scene:gripper{ name = "A", at = { 0.04, 0, 0 },
    pads = { width = mm(12), friction = 0.5, opening = 4 * lay.wire.radius } }
  lay.scene:process(function(p)
    hand:grasp(lay.wire, { s = 0.04, approach = "plates", force = 10 })
    hand:move{ by = { lay.way, 0, 0 }, duration = 0.5 }
    p:wait(0.2)
    hand:move{ by = { -1.5 * lay.way, 0, 0 }, duration = 0.2 }
  end)
  t.fine(lay.scene:run{ dt = o.dt or 0.01, quasistatic = o.quasistatic })
  return lay.fixed:over().peak_force, told(lay.scene), lay
end

local cables = { { "GXL 1.5", 0.05, 5 }, { "GXL 1.5", 0.2, 6 }, { "FLRY-B 2.5", 0.2, 8 },
  { "H07V-K 4", 0.1, 6 } } -- friction [-]; push over the Euler load [-]

describe("a straight cable on a table with friction", function()
  for _, case in ipairs(cables) do
    local cable, friction, times = table.unpack(case)
    it(("is told of when it bears more than a real one: %s, %g"):format(cable, friction), function()
      local function with(o)
        o.cable, o.friction, o.times = cable, friction, times
        return o
      end
      for _, quasistatic in ipairs{ false, true } do
        local real, silent, lay = pushed(with{ bent = 1e-3, quasistatic = quasistatic })
        assert.equal(0, #silent)
        -- Vibrations help the cable to slide, so the formula is above what it bears: by 7 to 60 %.
        t.below(bound(lay), real, "push that a bent cable bears [N]")
        if quasistatic and cable == "GXL 1.5" and friction == 0.2 then t.share(0.94, real, 0.01) end
        for _, o in ipairs{ {}, { back = true, dt = 0.02 }, { dt = 0.002, turn = 0.7 },
          { segments = 57, start = L / 150, swap = true } } do
          o.quasistatic = quasistatic
          local peak, events = pushed(with(o))
          t.above(1.3 * bound(lay), peak, "push that the straight cable bears [N]")
          assert.equal(1, #events)
          assert.matches("stayed straight under a push of .*also with this friction: draw it bent",
            events[1].text)
          t.share(peak, events[1].value, 0.05, "push told")
          -- In motion, the push rises while the bend grows. The nodes at the clamps do not touch the table.
          local most = tonumber(events[1].text:match "buckles under ([%d.e+-]+) N at most")
          t.above(0.96 * bound(lay), most, "most that a real one bears [N]")
          t.below((quasistatic and 1.15 or 2.5) * bound(lay), most, "most that a real one bears [N]")
        end
      end
    end)
  end

  it("is told of when a gripper pushes it, for the part beside the pads", function()
    for _, o in ipairs{ {}, { dt = 0.02, segments = 43 }, { quasistatic = true } } do
      o.cable, o.friction, o.times = "GXL 1.5", 0.2, 6
      local _, events, lay = handed(o)
      assert.equal(1, #events)
      local most = tonumber(events[1].text:match "buckles under ([%d.e+-]+) N at most")
      t.above(0.95 * bound(lay, L - 0.04), most, "most that a real one bears [N]")
      o.bent = 1e-3
      local real, silent = handed(o)
      assert.equal(0, #silent)
      t.below(most, real, "push that a bent cable bears [N]")
    end
  end)

  it("is told of as a mesh too, with friction or without", function()
    for _, model in ipairs{ "tube", "radial" } do
      for _, friction in ipairs(model == "tube" and { 0, 0.05, 1 } or { 0.05 }) do
        local peak, events, lay = pushed{ cable = "GXL 1.5", model = model, friction = friction,
          times = friction == 1 and 20 or 6 }
        assert.equal(1, #events)
        assert.matches("stayed straight", events[1].text)
        local most = tonumber(events[1].text:match "buckles under ([%d.e+-]+) N at most")
        t.above(0.96 * bound(lay), most, "most that a real one bears [N]")
        t.below(peak, most, "most that a real one bears [N]")
      end
    end
  end)

  it("is not told of where friction holds a bent one too", function()
    for _, case in ipairs{ { "GXL 1.5", 0.3, 2.5 }, { "FLRY-B 2.5", 0.4, 4 }, { "H07V-K 4", 0.2, 2 } } do
      for _, quasistatic in ipairs{ false, true } do
        local o = { cable = case[1], friction = case[2], times = case[3], quasistatic = quasistatic }
        local peak, events, lay = pushed(o)
        t.below(bound(lay), peak, "push [N]")
        assert.equal(0, #events)
        o.bent = 1e-3
        t.share(peak, (pushed(o)), 0.1, "push of a bent cable, as large")
      end
    end
  end)
end)
