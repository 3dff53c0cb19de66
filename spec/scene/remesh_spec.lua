-- SPDX-License-Identifier: GPL-3.0-or-later
-- New meshes of the same scene: a wire that has not moved is drawn anew, a moved one is carried over, and a
-- snapshot brings everything back.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local cases = require "softworld.cases"
local t = require "spec.physics.tools"
local core = sw.core

local PI = math.pi

-- Returns the largest difference between an edge's strain and its tension over EA.
local function strain_error(wire)
  local x, s = wire:positions()
  local worst = 0
  for i = 1, #s - 1 do
    local a, b = { x[3 * i - 2], x[3 * i - 1], x[3 * i] }, { x[3 * i + 1], x[3 * i + 2], x[3 * i + 3] }
    local tension = wire:tension((s[i] + s[i + 1]) / 2)
    worst = math.max(worst, math.abs(t.distance(a, b) / (s[i + 1] - s[i]) - 1 - tension / wire.beam.EA))
  end
  return worst
end

local function state(scene, wire)
  local x, s = wire:positions()
  return { x = x, s = s, v = wire:velocities(), e = scene:energy().total, length = wire.length }
end

local function arc(radius, angle, count)
  local points = {}
  for i = 0, count do
    local u = angle * i / count
    points[i + 1] = { radius * math.sin(u), radius * (1 - math.cos(u)), 0 }
  end
  return points
end

describe("a wire that has not moved", function()
  local path = arc(1, PI / 2, 4096)
  local function make(segments, rest)
    local scene = sw.scene{ gravity = { 0, 0, -1 } }
    local wire = scene:wire{ EA = 1e4, EI = 1, GJ = 1, mass_per_length = 1, radius = 0.001, path = path,
      rest = rest, segments = segments }
    return scene, wire
  end

  local function one(segments, rest, inner)
    local scene, wire = make(segments, rest)
    local clamp = scene:clamp(wire, { s = 0 })
    if inner then
      scene:clamp(wire, { s = 0.3 * wire.length })
      scene:grip(wire, { s = 0.7 * wire.length, width = 0.05 })
    end
    scene:pin(wire, { s = wire.length })
    scene:force{ kind = "point", on = wire, s = 0.9 * wire.length, force = { 0, 0.2, 0 } }
    return { scene = scene, wire = wire, clamp = clamp }
  end

  for _, rest in ipairs{ "straight", "path" } do
    it("gets the mesh of a wire made with as many segments, with holds and forces, rest " .. rest, function()
      for _, n in ipairs{ 8, 16, 64 } do
        for _, inner in ipairs{ false, true } do
          local a, b = one(32, rest, inner), one(n, rest, inner)
          core.remesh(a.scene, { n })
          assert.are.equal(b.wire.segments, a.wire.segments)
          t.near(b.wire.length, a.wire.length, 1e-14, "length")
          local xa, sa = a.wire:positions()
          local xb, sb = b.wire:positions()
          t.below(1e-12, t.largest_difference(sa, sb), "arc lengths off")
          t.below(1e-12, t.largest_difference(xa, xb), "nodes off")
          if not inner then -- a hold inside sits on a chord of the first mesh
            t.fine(a.scene:settle())
            t.fine(b.scene:settle())
            t.below(1e-8, t.largest_difference((a.wire:positions()), (b.wire:positions())),
              "settled nodes off")
            t.below(1e-6, t.distance(a.clamp:force(), b.clamp:force()), "force off")
            t.below(1e-6, t.distance(a.clamp:moment(), b.clamp:moment()), "moment off")
          end
        end
      end
    end)
  end

  it("is restored by a snapshot, whatever was done with it", function()
    local scene, wire = make(20, "path")
    local clamp = scene:clamp(wire, { s = 0 })
    local snapshot = scene:snapshot()
    local here = state(scene, wire)
    for _, n in ipairs{ 5, 40, 20 } do
      core.remesh(scene, { n })
      clamp:pose{ 0, 0, 0.1 }
      t.fine(scene:settle())
      scene:restore(snapshot)
      assert.are.same(here, state(scene, wire))
      core.remesh(scene, { 40 }) -- still known to be as drawn
      local _, fresh = make(40, "path")
      t.below(1e-14, t.largest_difference((wire:positions()), (fresh:positions())), "nodes off")
      scene:restore(snapshot)
    end
    -- the same without a new mesh in between
    scene:clamp(wire, { s = wire.length }):release() -- makes a new system
    t.fine(scene:settle())
    scene:gravity{ 0, 0, -1 }
    scene:pin(wire, { s = wire.length }):release()
    scene:restore(snapshot)
    core.remesh(scene, { 40 })
    local _, fresh = make(40, "path")
    t.below(1e-14, t.largest_difference((wire:positions()), (fresh:positions())), "nodes off")
    scene:restore(snapshot)
    t.fine(scene:settle())
    local settled = state(scene, wire)
    local other, other_wire = make(20, "path")
    other:clamp(other_wire, { s = 0 })
    t.fine(other:settle())
    assert.are.same(state(other, other_wire), settled)
  end)
end)

describe("a wire that has moved", function()
  it("keeps length, strains and shape, and its held places exactly", function()
    local c = cases.droop{ gamma = 10, segments = 40, axial = 1e6 }
    t.fine(c.run())
    local pin = c.scene:pin(c.wire, { s = 0.6131 })
    t.fine(c.scene:settle())
    local places = {}
    for i = 0, 20 do places[i] = c.wire:position(i / 20) end
    local length, held = c.wire.length, c.wire:position(0.6131)
    for _, n in ipairs{ 80, 160, 31 } do
      core.remesh(c.scene, { n })
      assert.are.equal(length, c.wire.length)
      assert.is_true(c.wire.segments >= n)
      t.below(1e-15, t.distance(held, c.wire:position(0.6131)), "held place moved by")
      t.below(1e-15, t.distance({ 0, 0, 0 }, c.wire:position(0)), "clamped place moved by")
      t.below(1e-9, strain_error(c.wire), "strains off")
      -- the other differences are of second order in the edges: (1/31)^2 = 1e-3
      for i = 0, 20 do t.below(5e-4, t.distance(places[i], c.wire:position(i / 20)), "shape off") end
    end
    t.fine(c.scene:settle())
    for i = 0, 20 do t.below(1e-3, t.distance(places[i], c.wire:position(i / 20)), "equilibrium off") end
    assert.is_true(pin:force()[3] ~= 0)
  end)

  it("keeps momentum, angular momentum and kinetic energy", function()
    local c = cases.release{ segments = 40 }
    t.fine(c.scene:run{ duration = 0.6, dt = 2e-3 })
    local p0, l0 = t.momentum(c.wire)
    local e0 = c.scene:energy()
    for _, n in ipairs{ 80, 40, 100 } do
      core.remesh(c.scene, { n })
      local p, l = t.momentum(c.wire)
      local e = c.scene:energy()
      local share = 1 / 40 ^ 2
      t.below(share * t.norm(p0), t.distance(p, p0), "momentum off")
      t.below(share * t.norm(l0), t.distance(l, l0), "angular momentum off")
      t.near(e0.kinetic, e.kinetic, 2 * share * e0.kinetic, "kinetic energy")
    end
  end)

  it("goes on as without the new mesh, the closer the finer the mesh", function()
    local function tip(n, m)
      local c = cases.release{ segments = n }
      t.fine(c.scene:run{ duration = 0.3, dt = 1e-3 })
      if m then core.remesh(c.scene, { m }) end
      t.fine(c.scene:run{ duration = 0.3, dt = 1e-3 })
      return c.wire:position(1)
    end
    t.below(2e-3, t.distance(tip(24), tip(24, 48)), "24 to 48")
    t.below(5e-4, t.distance(tip(96), tip(96, 192)), "96 to 192")
  end)

  it("comes back and goes on bit for bit", function()
    local c = cases.release{ segments = 15 }
    t.fine(c.scene:run{ duration = 0.2 })
    local snapshot = c.scene:snapshot()
    local here = state(c.scene, c.wire)
    t.fine(c.scene:run{ duration = 0.1 })
    local there = state(c.scene, c.wire)
    for _, n in ipairs{ 30, 7, 15 } do
      c.scene:restore(snapshot)
      core.remesh(c.scene, { n })
      t.fine(c.scene:run{ duration = 0.05 })
      c.scene:restore(snapshot)
      assert.are.same(here, state(c.scene, c.wire))
      t.fine(c.scene:run{ duration = 0.1 })
      assert.are.same(there, state(c.scene, c.wire))
    end
  end)

  it("keeps its twist", function()
    for _, rest in ipairs{ "straight", "path" } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ EA = 1e4, EI = 1, GJ = 0.8, mass_per_length = 1, radius = 0.001,
        from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 24, rest = rest }
      scene:clamp(wire, { s = 0 })
      local far = scene:clamp(wire, { s = 1 })
      local turn, parts = 7, 14 -- more than a whole turn [rad]
      for k = 1, parts do
        local half = turn * k / parts / 2
        far:pose({ 1, 0, 0 }, { math.cos(half), math.sin(half), 0, 0 })
        t.fine(scene:settle())
      end
      t.near(0.8 * turn, wire:twist_moment(0.5), 1e-6, "before")
      for _, n in ipairs{ 48, 12, 24 } do
        core.remesh(scene, { n })
        t.near(0.8 * turn, wire:twist_moment(0.5), 0.05, rest)
        t.fine(scene:settle())
        t.near(0.8 * turn, wire:twist_moment(0.5), 1e-6, rest .. ", settled")
      end
    end
  end)

  it("keeps a plastic bend", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e4, EI = 0.02, mass_per_length = 0.05, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 20 }
    scene:clamp(wire, { s = 0, direction = { 1, 0, 0 } })
    scene:force{ kind = "plastic", on = wire, yield_moment = 0.02, hardening = 0.005 }
    local pull = scene:force{ kind = "point", on = wire, s = 0.2, force = { 0, 0, -0.5 } }
    t.fine(scene:settle())
    pull:release()
    t.fine(scene:settle())
    local before = wire:position(0.2)
    assert.is_true(before[3] < -0.005)
    core.remesh(scene, { 40 })
    t.fine(scene:settle())
    t.below(0.02 * -before[3], t.distance(before, wire:position(0.2)), "bend off")
  end)

  it("stays in contact with what it lies on", function()
    local c = cases.laying{ segments = 60, duration = 1, distance = 0.6 }
    t.fine(c.run{ duration = 0.9 })
    local depth = c.scene:penetration()
    core.remesh(c.scene, { 120 })
    t.fine(c.scene:run{ duration = 0.1 })
    t.below(2 * depth + 1e-4, (c.scene:penetration()), "depth")
    assert.is_true(c.scene:contacts() > 0)
  end)
end)

describe("core.remesh", function()
  it("refuses invalid numbers of segments", function()
    local c = cases.droop{ segments = 10 }
    for _, bad in ipairs{ {}, { 1 }, { -3 }, { 0 }, { 20000000 }, { 10, 10 } } do
      assert.has_error(function() core.remesh(c.scene, bad) end)
    end
    assert.has_error(function() core.remesh(c.scene) end)
    assert.has_error(function() core.remesh(c.scene, { 2.5 }) end)
    assert.are.equal(10, c.wire.segments)
  end)
end)

describe("any mesh after any other", function()
  -- Holds at random places; wires moved or not, framed or not; coarser and finer meshes: everything stays
  -- in its place, and the scene runs.
  it("keeps holds in place, and the length of a moved wire", function()
    local random = t.random(17)
    local function pick(n) return 1 + math.floor((random() + 1) / 2 * n * 0.999999) end
    for round = 1, 40 do
      local scene = sw.scene{}
      local framed, moved = pick(2) == 1, pick(2) == 1
      local wire = scene:wire{ EA = 1e4, EI = 0.02, GJ = 0.015, mass_per_length = 0.05, radius = 0.002,
        path = moved and { { 0, 0, 0 }, { 1, 0, 0 } } or arc(0.6, 1 + random() / 2, 100),
        segments = 3 + pick(40),
        rest = framed and "path" or "straight" }
      local length, holds, at = wire.length, {}, 0
      for k = 1, pick(4) do
        at = at + (0.02 + 0.2 * (random() + 1) / 2) * length
        if at > 0.97 * length then break end
        local kind = ({ "clamp", "pin", "grip" })[pick(3)]
        local width = kind == "grip" and 0.03 * length or nil
        holds[k] = scene[kind](scene, wire, { s = at, width = width })
        at = at + 0.04 * length
      end
      if moved then t.fine(scene:run{ duration = 0.05, dt = 0.005 }) end
      local snapshot = scene:snapshot()
      local before = state(scene, wire)
      local forces = {}
      for k, hold in ipairs(holds) do forces[k] = hold:pose() end
      for _ = 1, 3 do
        core.remesh(scene, { 1 + pick(60) })
        if moved then assert.are.equal(length, wire.length) end
        local _, s = wire:positions()
        for i = 2, #s do assert.is_true(s[i] > s[i - 1], "arc lengths in order, round " .. round) end
        for k, hold in ipairs(holds) do
          t.below(1e-12, t.distance(forces[k], hold:pose()), "hold moved by")
        end
        if pick(3) == 1 then
          local r = scene:run{ duration = 0.01, dt = 0.002 }
          assert.is_true(r.ok, ("round %d: %s"):format(round, r.reason))
        end
      end
      scene:restore(snapshot)
      assert.are.same(before, state(scene, wire))
      scene:close()
    end
  end)
end)
