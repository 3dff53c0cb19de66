-- SPDX-License-Identifier: GPL-3.0-or-later
-- Perfectly straight wires under a push: nothing bends them to a side, and the run says so.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local EI, L = 0.02, 1
local euler = math.pi ^ 2 * EI / L ^ 2 -- Euler load of a strut pinned at both ends [N]

-- A strut, clamped at one end, free at the other and pushed there by P [N]. bent: how far its drawn shape
-- leaves the line [m].
local function strut(P, o)
  o = o or {}
  local scene = sw.scene{ gravity = o.gravity or { 0, 0, 0 } }
  local points = {}
  for i = 0, 40 do
    local z = L * i / 40
    points[#points + 1] = { (o.bent or 0) * (1 - math.cos(math.pi * z / (2 * L))), 0, z }
  end
  local wire = scene:wire{ name = "strut", EA = 1e5, EI = EI, mass_per_length = 0.1, radius = 0.005,
    path = points, segments = 40, rest = o.bent and "path" or nil }
  scene:clamp(wire, { s = 0 })
  if P > 0 then scene:force{ kind = "point", on = wire, s = wire.length, force = { 0, 0, -P } } end
  scene:force{ kind = "damping", mass = 10 }
  return scene, wire
end

local function buckling(scene)
  local list = {}
  for _, event in ipairs(scene:events()) do
    if event.kind == "buckling" then list[#list + 1] = event end
  end
  return list
end

describe("a perfectly straight wire", function()
  -- In whole steps: parts (substeps) follow how the push first runs to and fro along the wire, up to twice
  -- as large.
  it("pushed beyond buckling gives an event, once a run", function()
    for _, times in ipairs{ 1.5, 100, 5e5 } do
      local P = times * euler / 4
      local scene, wire = strut(P)
      for _ = 1, 2 do
        local run = t.fine(scene:run{ duration = 1, dt = 0.01, parts = false })
        local told = buckling(scene)
        assert.equal(1, #told)
        assert.equal("strut", told[1].object)
        t.share(P, told[1].value, 1e-3, "push")
        assert.matches("wire 'strut' stays straight under a push of .* N, but is unstable in %d+ directions?"
          .. ": a real wire would buckle", told[1].text)
        assert.matches("draw it bent", told[1].text)
        local text = {}
        run:summary{ write = function(_, s) text[#text + 1] = s end }
        assert.matches("would buckle", table.concat(text))
      end
      t.near(0, wire:position(0.5)[1], 1e-12, "place across")
    end
  end)

  it("gives none where it does not buckle, or does bend", function()
    local function run(P, o)
      local scene, wire = strut(P, o)
      if o and o.clamped then scene:clamp(wire, { s = L }) end
      if o and o.hung then scene:gravity{ 0, 0, 9.81 } end
      t.fine(scene:run{ duration = 2, dt = 0.01 })
      return #buckling(scene), wire
    end
    assert.equal(0, (run(0.9 * euler / 4)))
    assert.equal(1, (run(1.1 * euler / 4)))
    assert.equal(0, (run(0)))
    assert.equal(0, (run(0, { hung = true })))
    local told, wire = run(10 * euler / 4, { bent = 1e-3 })
    assert.equal(0, told)
    t.above(0.05, wire:position(L)[1], "the end's place across")
  end)

  it("gives an event when it stands on a clamp, too high for its weight", function()
    -- stable up to a weight m g = 7.837 EI / L^2
    for _, share in ipairs{ 0.9, 1.15 } do
      local scene = strut(0, { gravity = { 0, 0, -share * 7.837 * EI / (0.1 * L ^ 3) } })
      t.fine(scene:run{ duration = 2, dt = 0.01 })
      assert.equal(share > 1 and 1 or 0, #buckling(scene))
    end
  end)

  it("moves with the same bits however often a process looks at it", function()
    local seen
    for _, every in ipairs{ false, true } do
      local scene, wire = strut(10 * euler)
      scene:process(function(p)
        if every then p:wait_until(function() return false end, { timeout = 0.5 }) else p:wait(0.5) end
        scene:force{ kind = "point", on = wire, s = L, force = { 1e-3, 0, 0 } }
        p:wait(0.2)
      end)
      t.fine(scene:run{ dt = 0.002 })
      local x = (wire:positions())
      seen = seen or x
      assert.same(seen, x)
    end
  end)
end)

describe("wire:frequencies of an unstable rest", function()
  it("explains it in words", function()
    local scene, wire = strut(4 * euler / 4)
    t.fine(scene:run{ duration = 1, dt = 0.01 })
    local f = wire:frequencies{ tolerance = 1 }
    assert.equal(2, f.unstable)
    assert.matches("^unstable in 2 directions: the wire would buckle or tip over, growing e%-fold in .* s",
        f.note)
    t.share(1 / f.growth, tonumber(f.note:match("e%-fold in ([%d.e-]+) s")), 0.06, "time to grow")
    scene, wire = strut(0.5 * euler / 4)
    t.fine(scene:settle())
    assert.is_nil(wire:frequencies().note)
  end)
end)

-- An arch between two clamps that point upwards, in a plane turned by `turn` [rad]: half a circle on legs.
local function arch(cable, length, apart, o)
  local c, d = math.cos(o.turn), math.sin(o.turn)
  local scene = sw.scene{ gravity = { -9.81 * o.tilt * d, 9.81 * o.tilt * c, -9.81 } }
  local points, r = {}, apart / 2
  local leg = (length - math.pi * r) / 2
  local function add(x, z) points[#points + 1] = { x * c, x * d, z } end
  for k = 0, 10 do add(0, leg * k / 10) end
  for k = 1, 20 do add(r - r * math.cos(math.pi * k / 20), leg + r * math.sin(math.pi * k / 20)) end
  for k = 1, 10 do add(apart, leg * (1 - k / 10)) end
  local wire = scene:wire{ name = "arch", cable = cable, path = points, segments = o.segments or 60,
    rest = "straight" }
  scene:force{ kind = "damping", on = wire, mass = 4, stiffness = 1e-3 }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = wire.length })
  t.fine(scene:run{ duration = 4, dt = o.dt or 0.01 })
  local top = 0
  for k = 0, 50 do top = math.max(top, wire:position(wire.length * k / 50)[3]) end
  return top, buckling(scene)
end

describe("an arch in a plane", function()
  -- With gravity tilted by 1 % tall arches fall to a side and low ones stand; without a tilt all stand in
  -- their plane.
  for _, case in ipairs{ { "GXL 1.5", 1.0, 0.3, falls = true }, { "H07V-K 10", 1.6, 0.5, falls = true },
    { "GXL 1.5", 0.6, 0.2 }, { "H07V-K 10", 0.6, 0.2 } } do
    local cable, length, apart = table.unpack(case)
    it(("of %s, %g m, is told of if it stands only for nothing tilts it"):format(cable, length), function()
      local real, silent = arch(cable, length, apart, { tilt = 0.01, turn = 0 })
      assert.equal(0, #silent)
      local others = { { turn = 0 }, { turn = 0.7 }, { turn = 0, segments = 47 }, { turn = 0, dt = 0.004 } }
      for _, o in ipairs(others) do
        o.tilt = 0
        local top, told = arch(cable, length, apart, o)
        assert.equal(case.falls or false, real < 0.5 * top)
        assert.equal(case.falls and 1 or 0, #told)
        if told[1] then
          assert.matches("stays in a plane under a push of .* a real wire would fall to a side", told[1].text)
        end
      end
    end)
  end
end)

-- A straight cable between two clamps, turned to a torsion of `times` EI/L and pulled by o.pull EI/L^2.
-- Returns the events and the torsion [N m].
local function twisted(cable, times, o)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local length, turn = 0.4, o.turn or 0
  local along = { math.cos(turn), 0, math.sin(turn) }
  local far = { length * along[1], 0, length * along[3] }
  local wire = scene:wire{ name = "wire", cable = cable, from = { 0, 0, 0 }, to = far,
    segments = o.segments or 60, rolls = o.rolls }
  local bend, torsion = wire.beam.EI, wire.beam.GJ
  scene:clamp(wire, { s = 0 })
  local hand = scene:clamp(wire, { s = length })
  local stretch = (o.pull or 0) * bend / length ^ 2 / wire.beam.EA
  hand:follow{ points = { { 0, 0, 0 }, { stretch * far[1] + 1e-12, 0, stretch * far[3] } }, relative = true,
    turn = { axis = along, angle = times * bend / torsion }, duration = 1 }
  scene:force{ kind = "damping", mass = 10, stiffness = 1e-3 }
  t.fine(scene:run{ duration = 1.5, dt = o.dt or 0.01 })
  return buckling(scene), times * bend / length
end

describe("a perfectly straight wire that is twisted", function()
  -- Greenhill: between clamps at rest it buckles at M = 8.987 EI/L. A tension T raises this: a long wire
  -- buckles at 2 (EI T)^0.5, for T = 100 EI/L^2 at 20 EI/L, and between clamps at 20.98.
  it("is told of from its critical torsion on", function()
    for _, o in ipairs{ {}, { rolls = true }, { segments = 41, dt = 0.02, turn = 0.7 }, { pull = 100 } } do
      for _, cable in ipairs{ "GXL 1.5", "H07V-K 4", "FLRY-B 0.5" } do
        local critical = o.pull and 20.98 or 8.987
        assert.equal(0, #(twisted(cable, 0.95 * critical, o)))
        local told, moment = twisted(cable, 1.15 * critical, o)
        assert.equal(1, #told)
        t.share(moment, told[1].value, 1e-3, "torsion")
        assert.matches("stays .* under a torsion of .* N m, but is unstable", told[1].text)
      end
    end
  end)
end)
