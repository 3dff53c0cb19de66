-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that turn together while they press each other. Friction between wires compares the speeds of their
-- axes, w R and w (R + 2 r) on a drum that turns at w, though the surfaces do not slide. Turns of a wire on
-- each other then bear up to exp(mu angle) times the tension that they came on with.
package.path = "./?.lua;" .. package.path
local doubted = require "softworld.check.doubted"
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, TIME, BRAKE = 0.03, 3, 3 -- [m], [s], [N]

-- FLRY-B 0.5 is wound in a plane, between two plates, against the brake. q turns the scene about x [rad].
local function wound(turns, friction, dt, q)
  local function turned(x, y, z)
    return { x, y * math.cos(q) - z * math.sin(q), y * math.sin(q) + z * math.cos(q) }
  end
  local scene, rotation = sw.scene { gravity = { 0, 0, 0 } }, { axis = { 1, 0, 0 }, angle = q }
  local r = sw.cable("FLRY-B 0.5").outer_diameter.value / 2
  local angle, length = 2 * math.pi * turns, 0.2 + 2 * math.pi * (R + r + turns * 2 * r) * turns
  local drum = scene:obstacle { shape = "cylinder", radius = R, length = 0.1, friction = 0.3,
    rotation = rotation }
  local wire = scene:wire { name = "w", cable = "FLRY-B 0.5", segments = math.ceil(length / 0.006),
    from = turned(0, -(R + r), 0), to = turned(-length, -(R + r), 0) }
  scene:force { kind = "damping", on = wire, mass = 2, stiffness = 0.001 }
  scene:wire_contact { friction = friction }
  scene:feed(wire, { s = 0.12, name = "spool", force = BRAKE })
  for side = -1, 1, 2 do
    scene:obstacle { shape = "box", size = { 0.3, 0.3, 0.004 }, at = turned(0, 0, side * (r * 1.02 + 0.002)),
      friction = 0, rotation = rotation }
  end
  local turn = { axis = turned(0, 0, 1), angle = angle }
  scene:clamp(wire, { s = 0, name = "tip" }):follow { about = { 0, 0, 0 }, turn = turn, duration = TIME,
    law = "linear" }
  drum:follow { turn = turn, duration = TIME, law = "linear" }
  local run = scene:run { duration = TIME, dt = dt }
  assert.is_true(run.ok, run.reason)
  return run, wire
end

local function told(run)
  for _, e in ipairs(run.events) do
    if e.kind == "together" then return e end
  end
end

describe("turns of a wire that lie on each other", function()
  for _, case in ipairs { { 0.01, 0 }, { 0.005, 0.7 } } do
    local dt, q = table.unpack(case)
    it(("are told if friction between them stretches them: dt = %g s, turned by %g"):format(dt, q), function()
      local run, wire = wound(1.8, 0.3, dt, q)
      t.above(3 * BRAKE, wire:max_tension()) -- 14 N; once this is right, the event must go
      local e = told(run)
      assert.is_not_nil(e)
      assert.are.equal("w", e.object)
      t.above(BRAKE, e.value)
      -- also with an error bar, which says nothing of it
      local member = { name = "max_tension", on = "wire", peaks = true }
      local why = doubted.why(member, { error = 0.1 }, { name = "w" }, run)
      assert.is_truthy(why and why:find("'together'", 1, true), why)
    end)
  end

  it("are right without friction between them, and within one turn", function()
    local run, wire = wound(1.8, 0, 0.01, 0)
    assert.is_nil(told(run))
    t.below(1.6 * BRAKE, wire:max_tension()) -- 4.5 N in a step of the start
    run, wire = wound(0.9, 0.3, 0.01, 0)
    assert.is_nil(told(run))
    t.below(1.3 * BRAKE, wire:max_tension())
  end)
end)

describe("a wire that slides over another one", function()
  -- It lies across a held wire and is drawn along itself: axes and surfaces slide alike.
  it("is not told", function()
    local scene = sw.scene {}
    local r = sw.cable("GXL 1.5").outer_diameter.value / 2
    local bar = scene:wire { name = "bar", cable = "GXL 1.5", from = { 0, -0.05, 0 }, to = { 0, 0.05, 0 },
      segments = 10 }
    scene:clamp(bar, { s = 0 })
    scene:clamp(bar, { s = bar.length })
    local wire = scene:wire { name = "w", cable = "GXL 1.5", from = { -0.3, 0, 2 * r },
      to = { 0.3, 0, 2 * r }, segments = 60 }
    scene:force { kind = "damping", mass = 4, stiffness = 0.002 }
    scene:wire_contact { friction = 0.3 }
    scene:clamp(wire, { s = wire.length }):follow { relative = true, points = { { 0, 0, 0 }, { 0.1, 0, 0 } },
      duration = 0.5 }
    local run = scene:run { duration = 0.6, dt = 0.005 }
    assert.is_true(run.ok, run.reason)
    assert.is_nil(told(run))
  end)
end)
